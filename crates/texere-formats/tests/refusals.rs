//! Cloth that can't be made or can't come to rest is refused with file, line and key, whatever found that out.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test may panic")]

use std::error::Error;
use std::iter::successors;
use std::ops::ControlFlow;

use texere_cpu::ParallelBackend;
use texere_formats::read;

const YARN: &str = "[yarns.a]\ndiameter_mm = 0.1\n";

/// What is said of a design that is read, stretched and settled.
fn said(design: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("design.toml");
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
    let backend = ParallelBackend::open().unwrap();
    let on = |_| ControlFlow::Continue(());
    let (finish, stretch) = (design.finish, design.stretch);
    if let Some(stretch) = stretch
        && let Err(error) = design.structure.stretch(&finish, stretch, 0.0, &backend, on)
    {
        return said(&design.refused(error));
    }
    match design.structure.settle(&finish, 0.0, &backend, on) {
        Ok(_) => "taken".into(),
        Err(error) => said(&design.refused(error)),
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
