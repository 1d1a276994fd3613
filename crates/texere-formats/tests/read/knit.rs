//! The `[knit]` table of design files, and knitout files as designs.

use std::path::Path;

use image::{Rgb, RgbImage};
use tempfile::TempDir;
use texere_fabric::weft::{Knitted, LoopKind};
use texere_formats::{Design, ReadError, read};

use crate::chain;

const YARNS: &str = "[yarns.red]\ndiameter_mm = 0.2\ncolor = \"#c81020\"\n[yarns.white]\ntex = 20\n";

fn read_in(folder: &Path, knit: &str) -> Result<Design, ReadError> {
    let path = folder.join("a.toml");
    std::fs::write(&path, format!("[knit]\n{knit}\n{YARNS}")).unwrap();
    read(path)
}

fn knit(text: &str) -> Result<Design, ReadError> {
    read_in(TempDir::new().unwrap().path(), text)
}

fn knitted(design: &Design) -> &Knitted {
    design.structure.knitted().unwrap()
}

/// The message of a refusal, with its causes.
fn refusal(text: &str) -> String {
    chain(&knit(text).unwrap_err())
}

const CLOSE: &str = "wales_per_cm = 10\ncourses_per_cm = 12.5\n";

#[test]
fn a_chart_in_symbols() {
    let design = knit(&format!(
        "chart = \"\"\"\nk p\n\nk k\n\"\"\"\nrepeat = [3, 2]\nyarns = [\"2 red\", \"white\"]\ncompression = 0.9\n{CLOSE}"
    ))
    .unwrap();
    let cloth = knitted(&design);
    // Two rows in three yarns repeat after six courses.
    assert_eq!((cloth.stitches().repeat, cloth.copies(), cloth.size()), (Some([2, 6]), [3, 2], [6, 12]));
    assert_eq!(cloth.stitches().loops.len(), 12);
    assert_eq!((cloth.gauge().wale_mm, cloth.gauge().course_mm), (1.0, 0.8));
    assert_eq!(cloth.carriers().len(), 2);
    assert!((cloth.carriers()[0].radius_mm - 0.09).abs() < 1e-7);
    let yarns = design.yarns().unwrap();
    assert_eq!(yarns.layout().yarns().len(), 12);
    let names: Vec<_> = yarns.materials().iter().map(|material| material.name.as_str()).collect();
    assert_eq!(names, ["red", "white"]);
    assert!(design.settle && design.warnings().is_empty());
    // Source 3 is the purl, in row 1 from the top and column 2. The lowest row of a chart is
    // knitted first.
    let place = design.program_place(3).unwrap();
    assert!(place.place.ends_with("a.toml, row 1 from the top, column 2"), "{}", place.place);
    assert!(place.instructions.contains(&"knit - b1 red".into()), "{:?}", place.instructions);
}

#[test]
fn gauge_by_inch_or_by_loop_length() {
    let gauge =
        |text: &str| *knitted(&knit(&format!("chart = \"k\"\nyarns = [\"red\"]\n{text}")).unwrap()).gauge();
    let by_inch = gauge("needles_per_inch = 12.7\ncourses_per_cm = 20");
    assert!((by_inch.wale_mm - 2.0).abs() < 1e-12 && by_inch.course_mm == 0.5);
    let munden = gauge("loop_length_mm = 4.2");
    assert!((munden.wale_mm - 1.0).abs() < 1e-12 && munden.loop_length_mm == Some(4.2));
    let given = gauge(&format!("{CLOSE}loop_length_mm = 4.2"));
    assert_eq!((given.wale_mm, given.loop_length_mm), (1.0, Some(4.2)));
}

#[test]
fn a_picture_is_jacquard_or_a_chart() {
    let folder = TempDir::new().unwrap();
    let (red, white) = (Rgb([200, 16, 32]), Rgb([255, 255, 255]));
    let mut picture = RgbImage::from_pixel(3, 2, white);
    picture.put_pixel(1, 1, red);
    picture.save(folder.path().join("motif.png")).unwrap();
    let colors = |red: &str, white: &str| {
        format!("[knit.colors]\n\"#c81020\" = \"{red}\"\n\"#ffffff\" = \"{white}\"\n")
    };
    let read = |more: &str, colors: &str| {
        read_in(folder.path(), &format!("image = \"motif.png\"\n{CLOSE}{more}\n{colors}"))
    };
    // The lower row is knitted in two courses, one for each yarn, and the upper row in one course.
    let single = read("", &colors("red", "white")).unwrap();
    assert_eq!(knitted(&single).size(), [3, 2]);
    assert_eq!(single.yarns().unwrap().layout().yarns().len(), 3);
    assert_eq!(knitted(&single).stitches().loops.len(), 6);
    assert_eq!(single.files().len(), 2);
    let place = single.program_place(1).unwrap();
    assert!(place.place.ends_with("motif.png, row 2 from the top, column 2"), "{}", place.place);
    let upside_down = read("rows = \"first-pick-first\"", &colors("red", "white")).unwrap();
    let place = upside_down.program_place(4).unwrap();
    assert!(place.place.ends_with("motif.png, row 2 from the top, column 2"), "{}", place.place);
    for (backing, loops) in [("birdseye", 10), ("ladder", 12)] {
        let double = read(&format!("backing = \"{backing}\""), &colors("red", "white")).unwrap();
        assert_eq!(knitted(&double).stitches().loops.len(), loops, "{backing}");
    }
    let chart = read("yarns = [\"red\"]\nbeds = 1", &colors("t", "k")).unwrap();
    let kinds: Vec<_> = knitted(&chart).stitches().loops.iter().map(|stitch| stitch.kind).collect();
    assert_eq!(kinds.iter().filter(|kind| **kind == LoopKind::Tuck).count(), 1);

    let refused = |more: &str, colors: &str| chain(&read(more, colors).unwrap_err());
    assert!(refused("", &colors("red", "k")).contains("a symbol of a chart, or of all of them a yarn"));
    assert!(refused("", "").contains("knit.colors is missing"));
    assert!(
        refused("", "[knit.colors]\n\"#c81020\" = \"red\"")
            .contains("colour #ffffff, expected one of [knit.colors]")
    );
    assert!(
        refused("yarns = [\"red\"]\nbacking = \"ladder\"", &colors("t", "k"))
            .contains("knit.backing is given without yarns")
    );
    assert!(
        refused("backing = \"plain\"", &colors("red", "white")).contains("line 5: knit.backing is \"plain\"")
    );
    assert!(refused("beds = 2", &colors("red", "white")).contains("given without symbols in [knit.colors]"));
    let unused = read("", &(colors("red", "white") + "\"#000000\" = \"red\"\n")).unwrap();
    assert!(unused.warnings()[0].contains("a colour that no pixel of"), "{:?}", unused.warnings());
}

const JERSEY: &str = ";!knitout-2\n;;Carriers: 1 2 3\n;;Gauge: 12.7\n;;Yarn-3: 2-30 red\ninhook 3\ntuck - f2 3\ntuck - f1 3\n\
                      releasehook 3\nx-stitch-number 60\nknit + f1 3\nknit + f2 3\nouthook 3\ndrop f1\ndrop f2\n";

#[test]
fn a_knitout_file_alone_or_named_by_a_design() {
    let folder = TempDir::new().unwrap();
    for name in ["a.k", "a.knitout", "A.K"] {
        let path = folder.path().join(name);
        std::fs::write(&path, JERSEY).unwrap();
        let design = read(&path).unwrap();
        let cloth = knitted(&design);
        assert_eq!((design.name.to_lowercase().as_str(), cloth.size()), ("a", [2, 2]));
        assert_eq!((cloth.gauge().wale_mm, cloth.stitches().loops.len()), (2.0, 4));
        let yarns = design.yarns().unwrap();
        assert_eq!((yarns.layout().yarns().len(), yarns.materials()[2].name.as_str()), (1, "3: 2-30 red"));
        assert_eq!(design.files().len(), 1);
        // Warnings for a risky cast-on and for loops that are dropped at the end, with their lines.
        let warnings = design.warnings();
        assert!(
            warnings.len() == 3 && warnings[1].contains("line 13: a loop falls off needle f1"),
            "{warnings:?}"
        );
        assert!(warnings[0].contains("line 7: needles f2 and f1 hold nothing"), "{warnings:?}");
        assert!(design.faults().iter().all(|fault| !fault.is_error));
        let place = design.program_place(10).unwrap();
        assert!(place.place.ends_with(", line 10") && place.instructions == ["knit + f1 3"], "{place:?}");
    }
    let design = read_in(
        folder.path(),
        &format!("knitout = \"a.k\"\nyarns = [\"white\"]\n{CLOSE}[knit.stitch_lengths_mm]\n60 = 5.5\n"),
    )
    .unwrap();
    let cloth = knitted(&design);
    assert_eq!(cloth.gauge().wale_mm, 1.0);
    assert_eq!(cloth.stitches().loops[3].length_mm, Some(5.5));
    assert_eq!(design.yarns().unwrap().materials()[0].name, "white");
    assert_eq!(design.files().len(), 2);
    // A design without a gauge has the gauge of the file.
    let plain = read_in(folder.path(), "knitout = \"a.k\"\nyarns = [\"red\"]\n").unwrap();
    assert_eq!(knitted(&plain).gauge().wale_mm, 2.0);
    let repeated =
        read_in(folder.path(), "knitout = \"a.k\"\nyarns = [\"red\"]\nrepeat = [2, 2]\n").unwrap_err();
    assert!(repeated.to_string().contains("knit.repeat is given without knit.chart or knit.image"));
    std::fs::write(folder.path().join("b.k"), "knit + f1\nknit + g1 1\n").unwrap();
    let fault = chain(&read_in(folder.path(), "knitout = \"b.k\"\nyarns = [\"red\"]\n").unwrap_err());
    assert!(fault.contains("line 2: knit.knitout can't be taken"), "{fault}");
    assert!(fault.contains("b.k, line 2, column 8: \"g1\", expected a needle"), "{fault}");
}

#[test]
fn faults_of_a_machine_are_told_by_place() {
    let folder = TempDir::new().unwrap();
    let text = ";!knitout-2\n;;Carriers: 1 2\ninhook 1\ninhook 2\nknit + f1 1\nknit + f2 2\nrack 9\nxfer f1 b1\nouthook 1\n";
    std::fs::write(folder.path().join("a.k"), text).unwrap();
    let design = read(folder.path().join("a.k")).unwrap();
    let errors: Vec<_> = design.faults().iter().filter(|fault| fault.is_error).collect();
    for (line, said) in [(4, "the hook takes carrier 2"), (7, "rack 9"), (8, "does not lie opposite")] {
        let place = format!("a.k, line {line}: ");
        assert!(
            errors.iter().any(|fault| fault.message.contains(&place) && fault.message.contains(said)),
            "{errors:?}"
        );
    }
    // A float of eight needles is warned of, with its place in the picture or the chart.
    let float = format!("chart = \"\"\"\nkkkkkkkkkk\nkmmmmmmmmk\n\"\"\"\nyarns = [\"red\"]\n{CLOSE}");
    let warnings = knit(&float).unwrap().warnings();
    assert!(warnings.len() == 1 && warnings[0].contains("row 2 from the top"), "{warnings:?}");
    assert!(warnings[0].contains("carrier red floats past 8 needles"), "{warnings:?}");
    assert!(knit(&format!("{float}float_max = 8\n")).unwrap().warnings().is_empty());
}

#[test]
fn what_is_wrong_is_named_with_its_line() {
    let chart = "chart = \"k\"\nyarns = [\"red\"]\n";
    for (text, said) in [
        (CLOSE.to_owned(), "give exactly one of knit.chart, knit.image and knit.knitout"),
        (format!("{chart}image = \"a.png\"\n{CLOSE}"), "give exactly one of knit.chart"),
        (
            format!("chart = \"kx\"\nyarns = [\"red\"]\n{CLOSE}"),
            "line 2: knit.chart is no chart: row 1, column 2",
        ),
        (format!("chart = \"k\"\n{CLOSE}"), "knit.yarns is missing"),
        (
            format!("chart = \"k\"\nyarns = []\n{CLOSE}"),
            "line 3: knit.yarns is \"[]\", expected at least one yarn",
        ),
        (
            format!("chart = \"k\"\nyarns = [\"blue\"]\n{CLOSE}"),
            "line 3: knit.yarns is \"blue\", expected a yarn of [yarns]",
        ),
        (format!("{chart}beds = 3\n{CLOSE}"), "line 4: knit.beds is \"3\", expected 1 or 2"),
        (
            format!("{chart}repeat = [1]\n{CLOSE}"),
            "line 4: knit.repeat is \"[1]\", expected two whole numbers",
        ),
        (format!("{chart}repeat = [0, 1]\n{CLOSE}"), "line 4: knit.repeat is 0, outside 1 to 1000000"),
        (format!("{chart}compression = 0.5\n{CLOSE}"), "line 4: knit.compression is 0.5, outside 0.8 to 1"),
        (
            format!("{chart}cells = \"odd\"\n{CLOSE}"),
            "line 4: knit.cells is \"odd\", expected \"round\" or \"even\"",
        ),
        (
            format!("{chart}rows = \"first-pick-first\"\n{CLOSE}"),
            "line 4: knit.rows is given without knit.image",
        ),
        (format!("{chart}float_max = 0\n{CLOSE}"), "line 4: knit.float_max is 0"),
        (format!("{chart}{CLOSE}[knit.stitch_lengths_mm]\n1 = 2\n"), "given without knit.knitout"),
        (chart.into(), "knit.wales_per_cm is missing"),
        (format!("{chart}wales_per_cm = 8"), "knit.courses_per_cm is missing"),
        (format!("{chart}courses_per_cm = 8"), "knit.wales_per_cm is missing"),
        (
            format!("{chart}{CLOSE}needles_per_inch = 9"),
            "give exactly one of knit.wales_per_cm and knit.needles_per_inch",
        ),
        (
            format!("{chart}wales_per_cm = 0\ncourses_per_cm = 8"),
            "line 4: knit.wales_per_cm is 0, outside 0.01 to 1000",
        ),
        (format!("{chart}{CLOSE}colour = 3"), "did you mean \"colors\"?"),
        (format!("{chart}{CLOSE}[warp]\nyarns = [\"red\"]\nper_cm = 3"), "warp is given without [weave]"),
        (format!("{chart}{CLOSE}[cloth]\njam = \"report\""), "cloth.jam is given without [weave]"),
        (
            format!("{chart}{CLOSE}[weave]\nnotation = \"plain\""),
            "give exactly one of [weave], [knit] and [warp_knit]",
        ),
    ] {
        assert!(refusal(&text).contains(said), "{text}\n{}", refusal(&text));
    }
}

/// Stitches that can't be knitted are named by their line or by their place in the picture, not by
/// internal numbers.
#[test]
fn what_no_machine_takes_is_named_by_its_place() {
    let folder = TempDir::new().unwrap();
    let tucks = "tuck + f1 1\n".repeat(257);
    std::fs::write(folder.path().join("a.k"), format!(";!knitout-2\n;;Carriers: 1\nin 1\n{tucks}")).unwrap();
    let said = chain(&read(folder.path().join("a.k")).unwrap_err());
    assert!(said.ends_with("a.k, line 260 can't be knitted: 257 loops on a needle in a knitting program; 256 are taken at most"), "{said}");

    // A stitch of the back bed in the top row, which may be the first course or the last.
    let colors = [[255, 0, 0], [0, 0, 255]].map(Rgb);
    RgbImage::from_fn(2, 3, |x, y| colors[usize::from(x == 1 && y == 0)])
        .save(folder.path().join("a.png"))
        .unwrap();
    for rows in ["", "rows = \"first-pick-first\"\n"] {
        let knit = format!(
            "image = \"a.png\"\nyarns = [\"red\"]\n{rows}{CLOSE}[knit.colors]\n\"#ff0000\" = \"k\"\n\"#0000ff\" = \"b\""
        );
        let said = chain(&read_in(folder.path(), &knit).unwrap_err());
        assert!(said.contains("row 1, column 2 of the chart"), "{rows}: {said}");
    }
}

#[test]
fn stitch_sizes_are_compared_as_numbers() {
    let folder = TempDir::new().unwrap();
    let text = ";!knitout-2\n;;Carriers: 1\nin 1\nx-stitch-number 070\nknit + f1 1\nx-stitch-number 71\nknit + f2 1\n";
    std::fs::write(folder.path().join("a.k"), text).unwrap();
    let sized = |sizes: &str| {
        read_in(
            folder.path(),
            &format!("knitout = \"a.k\"\nyarns = [\"red\"]\n{CLOSE}[knit.stitch_lengths_mm]\n{sizes}"),
        )
    };
    let design = sized("70 = 5.5\n\"71.0\" = 6\n\"10 20\" = 7\n").unwrap();
    let lengths: Vec<_> = knitted(&design).stitches().loops.iter().map(|stitch| stitch.length_mm).collect();
    assert_eq!(lengths, [Some(5.5), Some(6.0)]);
    let about = |design: &Design, said: &str| design.warnings().iter().any(|warning| warning.contains(said));
    assert!(about(&design, "a.k does not: 10 20"), "{:?}", design.warnings());
    let partly = sized("70 = 5.5\n").unwrap();
    assert!(about(&partly, "line 6: stitch size 71 has no length"), "{:?}", partly.warnings());
    for (sizes, said) in
        [("70 = 5\n070 = 6\n", "each stitch size once"), ("big = 5\n", "knit.stitch_lengths_mm.\"big\"")]
    {
        let refusal = chain(&sized(sizes).unwrap_err());
        assert!(refusal.contains(said), "{refusal}");
    }
}
