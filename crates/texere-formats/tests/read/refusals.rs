//! Cloth that can't be made, or that can't come to rest, is refused with file, line and key,
//! whichever part of texere finds the fault.

use std::error::Error;
use std::iter::successors;

use texere_cpu::ParallelBackend;
use texere_formats::{Cloth, RestReport, read};

const YARN: &str = "[yarns.a]\ndiameter_mm = 0.1\n";

/// The message for a design file that is read, stretched and settled.
fn said(design: &str) -> String {
    said_of("design.toml", design, "")
}

/// The message for a design of any name in a folder with `draft.wif`.
fn said_of(name: &str, design: &str, draft: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(folder.path().join("draft.wif"), draft).unwrap();
    std::fs::write(&path, design).unwrap();
    image::GrayImage::from_pixel(1, 1, image::Luma([0])).save(folder.path().join("one.png")).unwrap();
    let said = |error: &(dyn Error + 'static)| {
        let all = successors(Some(error), |error: &&(dyn Error + 'static)| (*error).source());
        all.map(ToString::to_string).collect::<Vec<_>>().join(": ")
    };
    let mut design = match read(&path) {
        Ok(design) => design,
        Err(error) => return said(&error),
    };
    design.settle = true;
    let cloth = design.rest(&ParallelBackend::open().unwrap()).run();
    match cloth.as_ref().map(Cloth::report) {
        Err(reason) | Ok(RestReport::Refused { reason, .. }) => said(reason),
        Ok(_) => "taken".into(),
    }
}

#[test]
fn refused_cloth_names_file_line_and_key() {
    let knit = |keys: &str| format!("[knit]\n{keys}\n{YARN}");
    let warp = |keys: &str, bars: &str| {
        format!("[warp_knit]\n{keys}\nwales_per_cm = 10\ncourses_per_cm = 13\n{bars}\n{YARN}")
    };
    let bar = |lapping: &str| format!("[[warp_knit.bars]]\nlapping = \"{lapping}\"");
    let woven = |weave: &str, warp: &str, rest: &str| {
        format!(
            "[weave]\n{weave}\n{rest}{YARN}[warp]\nyarns = [\"a\"]\n{warp}\n[weft]\nyarns = [\"a\"]\nspacing_mm = 0.4\n"
        )
    };
    let plain = "notation = \"plain\"\nends = 6\npicks = 6";
    let cable = format!("chart = \"\"\"\n{}\n{}{}\n\"\"\"", "k".repeat(80), "R".repeat(40), "r".repeat(40));
    let gauge = "wales_per_cm = 8\ncourses_per_cm = 10";
    let wide = format!(
        "{}\n[[warp_knit.bars]]\nlapping = \"2-0/1-2//\"\nimage = \"one.png\"\ncolors = {{ \"#000000\" = \"1-0/0-0\" }}",
        bar("1-0/1-2//")
    );
    for (design, key, why) in [
        (
            knit("chart = \"k\"\nwales_per_cm = 0.01\ncourses_per_cm = 1000"),
            "line 3: knit.wales_per_cm",
            "course 1",
        ),
        (
            knit("chart = \"k\"\nwales_per_cm = 10\ncourses_per_cm = 0.01"),
            "line 4: knit.courses_per_cm",
            "too long for its thickness",
        ),
        (
            knit("chart = \"\"\"\nkp\npk\n\"\"\"\ncourses_per_cm = 0.01\nwales_per_cm = 5"),
            "line 6: knit.courses_per_cm",
            "too long for its thickness",
        ),
        (
            knit("chart = \"k\"\nrepeat = [20, 20]\nloop_length_mm = 1000"),
            "line 4: knit.loop_length_mm",
            "too long",
        ),
        (knit(&format!("{gauge}\n{cable}")), "line 4: knit.chart", "too many yarns lie in one place"),
        (
            knit("chart = \"k\"\nwales_per_cm = 40\ncourses_per_cm = 10\nrepeat = [1, 4]"),
            "line 3: knit.wales_per_cm",
            "copy it until",
        ),
        (
            knit(&format!("chart = \"k\"\n{gauge}\nrepeat = [499, 499]")),
            "line 5: knit.repeat",
            "multiples of 4",
        ),
        (warp("wales = 4\ncourses = 4", "bars = []"), "line 6: warp_knit.bars", "0 guide bars"),
        (
            warp("wales = 4\ncourses = 4", &bar("0-0/1-1//")),
            "line 7: warp_knit.bars, bar 1: lapping",
            "no guide makes a loop",
        ),
        (
            warp("wales = 4\ncourses = 4", &wide),
            "line 11: warp_knit.bars, bar 2: colors",
            "guide bar 2's Jacquard makes its lap 3-0 at course 1",
        ),
        (
            warp("wales = 4\ncourses = 4", &bar("0-1/511-512//")),
            "bar 1: lapping",
            "too many yarns lie in one place",
        ),
        (
            warp("wales = 4\ncourses = 4", &format!("{}\n{}", bar("1-0/1-2//"), bar("0-1/511-512//"))),
            "line 6: warp_knit.bars asks",
            "too many yarns lie in one place",
        ),
        (
            warp("wales = 16384\ncourses = 32768", &format!("{0}\n{0}", bar("1-0/1-2//"))),
            "line 2: warp_knit.wales",
            "1073741824 laps",
        ),
        (woven(plain, "spacing_mm = 0.001", ""), "line 9: warp.spacing_mm", "pitch of end 1 is 0.001"),
        (
            woven(plain, "per_cm = 10", "[finish]\nstretch_warp = 1.9\n"),
            "line 6: finish.stretch_warp",
            "1.9 times",
        ),
        (
            woven("notation = \"plain\"\nends = 1000000\npicks = 1000000", "per_cm = 10", ""),
            "line 3: weave.ends",
            "1000000",
        ),
    ] {
        let said = said(&design);
        let place = said.split_once("design.toml, ").map_or("", |(_, rest)| rest);
        assert!(place.contains(key) && said.contains(why), "{key}, {why}: {said}\n{design}");
    }
}

#[test]
fn refused_drafts_name_line_section_and_key() {
    let draft = |ends: u32, picks: u32, warp: &str, rest: &str| {
        format!(
            "[WARP]\nThreads={ends}\nUnits=cm\n{warp}\n[WEFT]\nThreads={picks}\nSpacing=0.06\n[THREADING]\n1=1\n2=2\n3=1\n4=2\n\
             [LIFTPLAN]\n1=1\n2=2\n3=1\n4=2\n{rest}"
        )
    };
    let close = "[WARP SPACING]\n1=0.0001\n2=0.0001\n3=0.0001\n4=0.0001";
    let wide = "[WARP SPACING]\n1=100";
    for (draft, key, why) in [
        (draft(1_000_000, 1_000_000, "", ""), "line 2: [WARP] threads", "1000000"),
        (draft(4, 4, "Spacing=100", ""), "line 4: [WARP] spacing", "pitch of end 1"),
        (draft(4, 4, "Spacing=0.06", close), "line 7: [WEFT] spacing", "pitch of pick 1"),
        (draft(4, 4, "Spacing=0.06", wide), "line 19: [WARP SPACING] 1", "pitch of end 1"),
    ] {
        let said = said_of("draft.wif", &draft, &draft);
        assert!(said.contains(&format!("draft.wif, {key}")) && said.contains(why), "{key}: {said}");
        // The message for a design that names the draft has the place in the draft, too.
        let named = said_of("design.toml", &format!("weave.wif = \"draft.wif\"\n{YARN}"), &draft);
        assert!(named.contains(&format!("draft.wif, {key}")) && named.contains(why), "{key}: {named}");
    }
}

#[test]
fn a_yarn_that_goes_too_far_names_its_line() {
    let far = "knit + f60000 3\nknit - f1 3\n".repeat(3);
    let knitout =
        format!(";!knitout-2\n;;Carriers: 1 3\ninhook 3\nknit + f1 3\nknit + f2 3\n{far}outhook 3\n");
    let said = said_of("design.k", &knitout, "");
    // Several ways of the yarn are equally long. The first of them goes from needle 60000 back to
    // needle 1.
    assert!(said.contains("design.k, line 7") && said.contains("yarns pass"), "{said}");
}

/// A cable in which 40 loops cross over 40 others. The error names a line that knits, for a file
/// that is the design and for a file that a design names.
#[test]
fn a_knitout_file_that_is_too_crowded_to_settle_names_its_line() {
    let row = |way: char| {
        let needles: Vec<i32> = if way == '+' { (1..=80).collect() } else { (1..=80).rev().collect() };
        needles.iter().map(|needle| format!("knit {way} f{needle} 1\n")).collect::<String>()
    };
    let moved = |needles: std::ops::RangeInclusive<i32>, by: i32| {
        let moved = needles.map(|needle| format!("xfer b{needle} f{}\n", needle + by));
        format!("rack {by}\n{}", moved.collect::<String>())
    };
    let back: String = (1..=80).map(|needle| format!("xfer f{needle} b{needle}\n")).collect();
    let knitout = format!(
        ";!knitout-2\n;;Carriers: 1\nin 1\n{0}{1}{back}{2}{3}rack 0\n{0}{1}",
        row('+'),
        row('-'),
        moved(1..=40, 40),
        moved(41..=80, -40)
    );
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("cable.k"), &knitout).unwrap();
    let design = "[knit]\nknitout = \"cable.k\"\nwales_per_cm = 5\ncourses_per_cm = 7\n[yarns.a]\ndiameter_mm = 0.35\n";
    std::fs::write(folder.path().join("cable.toml"), design).unwrap();
    for name in ["cable.k", "cable.toml"] {
        let mut design = read(folder.path().join(name)).unwrap();
        design.settle = true;
        let error = design.rest(&ParallelBackend::open().unwrap()).run().unwrap_err();
        let said = error.to_string();
        let line = said.split_once("cable.k, line ").and_then(|(_, rest)| rest.split_once(": "));
        let (line, rest) = line.unwrap_or_else(|| panic!("{name}: {said}"));
        let text = knitout.lines().nth(line.parse::<usize>().unwrap() - 1).unwrap();
        assert!(rest.starts_with(text) && text.starts_with("knit"), "{name}: {said}, where {text} stands");
        assert!(error.source().unwrap().to_string().contains("too many yarns lie in one place"));
    }
}

#[test]
fn a_knitout_file_without_loops_names_a_line() {
    let said = said_of("design.k", ";!knitout-2\n;;Carriers: 1\nin 1\nmiss + f3 1\nout 1\n", "");
    assert!(said.contains("design.k, line 3: in 1") && said.contains("no loops"), "{said}");
}
