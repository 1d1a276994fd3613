//! The `[warp_knit]` table of design files.

use std::path::Path;

use image::{Rgb, RgbImage};
use tempfile::TempDir;
use texere_fabric::warp::WarpKnitted;
use texere_formats::write::{Side, warp_draft, warp_rows};
use texere_formats::{Design, ReadError, read};

use crate::chain;

const YARNS: &str = "[yarns.red]\ndiameter_mm = 0.1\n[yarns.white]\ndiameter_mm = 0.08\n";
const SIZE: &str = "wales = 6\ncourses = 4\nwales_per_cm = 10\ncourses_per_cm = 12.5\n";

fn read_in(folder: &Path, text: &str) -> Result<Design, ReadError> {
    let path = folder.join("a.toml");
    std::fs::write(&path, format!("{text}\n{YARNS}")).unwrap();
    read(path)
}

fn design(bars: &str) -> Result<Design, ReadError> {
    read_in(TempDir::new().unwrap().path(), &format!("[warp_knit]\n{SIZE}{bars}"))
}

fn knit(design: &Design) -> &WarpKnitted {
    design.structure.warp_knitted().unwrap()
}

#[test]
fn bars_with_all_their_keys() {
    let design = design(
        "repeat = [2, 3]\ncompression = 0.9\ncells = \"even\"\n[[warp_knit.bars]]\nlapping = \"2-0/4-6//\"\nstep = 2\nthreading = [\"2 red\", \"out\"]\n\
         offset = -1\nrun_in_mm = 1500\n[[warp_knit.bars]]\nlapping = \"open tricot\"\nthreading = [\"white\"]\n",
    )
    .unwrap();
    let cloth = knit(&design);
    assert_eq!((cloth.size(), cloth.copies()), ([12, 12], [2, 3]));
    assert_eq!((cloth.gauge().wale_mm, cloth.gauge().course_mm), (1.0, 0.8));
    let [front, back] = cloth.bars() else { panic!("two bars") };
    assert_eq!(
        (front.chain.to_string(), front.offset, front.run_in_mm),
        ("1-0/2-3//".into(), -1, Some(1500.0))
    );
    assert_eq!(front.threading.guides(), [Some(0), Some(0), None]);
    assert_eq!(back.threading.guides(), [Some(1)]);
    assert_eq!(warp_rows(cloth), ["bar 1: 1-0/2-3//", "bar 2: 0-1/2-1//"]);
    assert!((cloth.guide_yarns()[0].radius_mm - 0.045).abs() < 1e-6);
    assert!(design.settle && design.warnings().is_empty());
    // Eight of the front bar's twelve guides are threaded, and all of the back bar's. Each yarn has
    // 9 points a course.
    let yarns = design.yarns().unwrap();
    assert_eq!((yarns.layout().yarns().len(), yarns.points().len()), (20, 20 * 12 * 9));
}

#[test]
fn needles_to_the_inch_draw_in() {
    let text = "[warp_knit]\nwales = 2\ncourses = 2\nneedles_per_inch = 28\ndraw_in = 0.75\ncourses_per_cm = 20\n[[warp_knit.bars]]\n\
                lapping = \"tricot\"\nthreading = [\"red\"]\n";
    let design = read_in(TempDir::new().unwrap().path(), text).unwrap();
    assert!((knit(&design).gauge().wale_mm - 25.4 / 28.0 * 0.75).abs() < 1e-12);
}

#[test]
fn a_jacquard_bar() {
    let folder = TempDir::new().unwrap();
    let (plain, thick, mesh) = (Rgb([255, 255, 255]), Rgb([200, 16, 32]), Rgb([0, 0, 255]));
    // The bottom row is the first round: plain, thick, mesh.
    let image = RgbImage::from_fn(3, 2, |x, y| [[plain; 3], [plain, thick, mesh]][y as usize][x as usize]);
    image.save(folder.path().join("a.png")).unwrap();
    let bars = |colors: &str| {
        format!(
            "[warp_knit]\n{SIZE}[[warp_knit.bars]]\nlapping = \"1-0/1-2//\"\nthreading = [\"red\"]\nimage = \"a.png\"\n[warp_knit.bars.colors]\n{colors}"
        )
    };
    let colors = "\"#ffffff\" = \"0-0/0-0\"\n\"#c81020\" = \"0-0/1-1\"\n\"#0000ff\" = \"1-1/0-0\"\n";
    let design = read_in(folder.path(), &bars(colors)).unwrap();
    let laps = |guide, course| knit(&design).bars()[0].lap(guide, course).to_string();
    assert_eq!([laps(0, 0), laps(0, 1), laps(1, 0), laps(1, 1)], ["1-0", "1-2", "2-1", "3-4"]);
    assert_eq!([laps(2, 0), laps(2, 1), laps(2, 2), laps(2, 3)], ["4-3", "3-4", "3-2", "3-4"]);
    assert!(design.files().iter().any(|file| file.ends_with("a.png")));

    let refused = |colors: &str| chain(&read_in(folder.path(), &bars(colors)).unwrap_err());
    let known = "\"#ffffff\" = \"0-0/0-0\"\n\"#c81020\" = \"0-0/1-1\"\n";
    let said = refused(known);
    assert!(said.contains("#0000ff") && said.contains("column 3, row 2"), "{said}");
    let said = refused(&format!("{known}\"#0000ff\" = \"0-0/2-0\"\n"));
    assert!(said.contains("a.toml, line 13: warp_knit.bars, bar 1: colors"), "{said}");
    let said = refused(&format!("{known}\"#0000ff\" = \"0-0\"\n"));
    assert!(said.contains("2 laps"), "{said}");
    let said = refused(&format!("{known}\"#0000ff\" = \"0-0/1,1\"\n"));
    assert!(said.contains("column 6"), "{said}");
    // Four wales are no multiple of the image's three.
    let narrow = bars(colors).replace("wales = 6", "wales = 4");
    let said = chain(&read_in(folder.path(), &narrow).unwrap_err());
    assert!(said.contains("line 2: warp_knit.wales") && said.contains("a multiple of 3"), "{said}");
}

#[test]
fn what_no_bar_is_is_refused_where_it_stands() {
    let bar = "[[warp_knit.bars]]\nthreading = [\"red\"]\n";
    for (bars, expected) in [
        (
            format!("{bar}lapping = \"1-0/1~2//\""),
            "a.toml, line 8: warp_knit.bars, bar 1: lapping is no chain: chain, column 6",
        ),
        (format!("{bar}lapping = \"1-0/9-2//\""), "column 7"),
        (format!("{bar}lapping = \"1-0/2-4//\"\nstep = 2"), "column 1"),
        (format!("{bar}lapping = \"twill\""), "pillar, tricot, cord"),
        (format!("{bar}lapping = \"tricot\"\nstep = 3"), "step"),
        (format!("{bar}lapping = \"tricot\"\noffset = 70000"), "offset"),
        (format!("{bar}lapping = \"tricot\"\nrun_in_mm = 0"), "run_in_mm"),
        (format!("{bar}lapping = \"tricot\"\nimage = \"a.png\""), "image and colors"),
        (format!("{bar}lapping = \"tricot\"\nrunin = 3"), "key \"runin\""),
        ("[[warp_knit.bars]]\nlapping = \"tricot\"".into(), "bar 1: threading"),
        ("[[warp_knit.bars]]\nlapping = \"tricot\"\nthreading = [\"blue\"]".into(), "\"red\", \"white\""),
        ("[[warp_knit.bars]]\nlapping = \"tricot\"\nthreading = [\"2 out\"]".into(), "at least one yarn"),
        ("[[warp_knit.bars]]\nlapping = \"inlay 2\"\nthreading = [\"red\"]".into(), "no guide makes a loop"),
        (
            format!("{bar}lapping = \"atlas 3\""),
            "line 3: warp_knit.courses is \"4\", expected a multiple of 6",
        ),
        (format!("draw_in = 0.8\n{bar}lapping = \"tricot\""), "needles_per_inch"),
        (format!("needles_per_inch = 20\n{bar}lapping = \"tricot\""), "exactly one of"),
        ("bars = []".into(), "guide bars"),
        (format!("{bar}lapping = \"tricot\"\n[cloth]\nshape = \"round\""), "[weave]"),
    ] {
        let said = chain(&design(&bars).unwrap_err());
        assert!(said.contains(expected), "{bars}\n{said}");
    }
}

#[test]
fn lapping_diagrams_show_overlaps_and_underlaps() {
    let design = design("[[warp_knit.bars]]\nlapping = \"1-0/1-2//\"\nthreading = [\"red\"]\n").unwrap();
    let folder = TempDir::new().unwrap();
    let picture = |side, name: &str| {
        let path = folder.path().join(name);
        let size = warp_draft(knit(&design), side, &path).unwrap();
        let image = image::open(path).unwrap().to_rgb8();
        assert_eq!([image.width(), image.height()], size);
        image
    };
    let (face, back) = (picture(Side::Face, "face.png"), picture(Side::Back, "back.png"));
    let inked = |image: &RgbImage| image.pixels().filter(|pixel| pixel.0 != [255; 3]).count();
    assert!(inked(&face) > 1000);
    // The back is another picture: the face turned over.
    assert_ne!(face, back);
    assert!(matches!(
        warp_draft(knit(&design), Side::Face, folder.path().join("a.jpg")),
        Err(texere_formats::WriteError::NotPng { .. })
    ));
}
