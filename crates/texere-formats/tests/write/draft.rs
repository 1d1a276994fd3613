//! Pictures of drafts, read back square by square.

use std::path::Path;

use image::{Rgb, RgbImage};
use tempfile::TempDir;
use texere_core::{Material, Section};
use texere_fabric::{Draft, Drawdown, Shedding, Thread, Weave, Woven};
use texere_formats::WriteError;
use texere_formats::write::{Side, draft};

const WARP: [u8; 3] = [10, 120, 30];
const WEFT: [u8; 3] = [200, 40, 90];

/// Places in the picture of a draft with six ends, four picks, four shafts and three treadles.
/// Squares have 16 pixels. There is a margin of 12, a gap of 16 between blocks, and a line that
/// closes each block.
const LEFT: u32 = 12;
const BAR_TOP: u32 = 12;
const THREADING_TOP: u32 = 12 + 17 + 16;
const CLOTH_TOP: u32 = THREADING_TOP + 65 + 16;
const TREADLES_LEFT: u32 = LEFT + 97 + 16;
const WEFT_LEFT: u32 = TREADLES_LEFT + 49 + 16;

fn cloth(drawdown: Drawdown) -> Woven {
    let (ends, picks) = (drawdown.ends(), drawdown.picks());
    let material = |srgb| Material { srgb, ..Material::default() };
    let warp = vec![Thread::new(0.6, 0.1); ends];
    // The first pick has the yarn of the warp.
    let mut weft = vec![Thread { material: 1, ..Thread::new(0.6, 0.1) }; picks];
    weft[0].material = 0;
    Woven::new(drawdown, warp, weft, vec![material(WARP), material(WEFT)], vec![Section::Circle]).unwrap()
}

/// Six ends on four shafts, and four picks by three treadles, without any symmetry.
fn shafts() -> Draft {
    Draft {
        threading: vec![vec![1], vec![2], vec![3], vec![4], vec![2], vec![0, 1]],
        shedding: Shedding::TieUp {
            tie_up: vec![vec![1, 2], vec![3], vec![2, 4], vec![], vec![]],
            treadling: vec![vec![1], vec![2], vec![3], vec![1, 2]],
        },
        rising_shed: true,
    }
}

fn drawn(cloth: &Woven, shafts: Option<&Draft>, side: Side) -> RgbImage {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("draft.png");
    let size = draft(cloth, shafts, side, &path).unwrap();
    let picture = image::open(&path).unwrap().to_rgb8();
    assert_eq!(size, [picture.width(), picture.height()]);
    picture
}

/// The squares of 16 pixels from a place on: `#` for black, `.` for white, `?` for a colour.
fn squares(picture: &RgbImage, left: u32, top: u32, columns: u32, rows: u32) -> Vec<String> {
    let sign = |column, row| match picture.get_pixel(left + column * 16 + 8, top + row * 16 + 8).0 {
        [0, 0, 0] => '#',
        [255, 255, 255] => '.',
        _ => '?',
    };
    (0..rows).map(|row| (0..columns).map(|column| sign(column, row)).collect()).collect()
}

#[test]
fn a_draft_lies_as_weavers_draw_it() {
    let shafts = shafts();
    let cloth = cloth(shafts.drawdown().unwrap());
    let picture = drawn(&cloth, Some(&shafts), Side::Face);
    // Shaft 1 is at the bottom, next to the cloth; treadle 1 on the left; pick 1 at the bottom.
    assert_eq!(squares(&picture, LEFT, THREADING_TOP, 6, 4), ["...#..", "..#...", ".#..#.", "#....#"]);
    assert_eq!(squares(&picture, TREADLES_LEFT, THREADING_TOP, 3, 4), ["..#", ".#.", "#.#", "#.."]);
    assert_eq!(squares(&picture, TREADLES_LEFT, CLOTH_TOP, 3, 4), ["##.", "..#", ".#.", "#.."]);
    // From the top, picks use treadles 1 and 2, 3, 2, 1.
    assert_eq!(squares(&picture, LEFT, CLOTH_TOP, 6, 4), ["###.##", ".#.##.", "..#...", "##..##"]);
    for end in 0..6 {
        assert_eq!(*picture.get_pixel(LEFT + end * 16 + 8, BAR_TOP + 8), Rgb(WARP));
    }
    for (row, color) in [(0, WEFT), (1, WEFT), (2, WEFT), (3, WARP)] {
        assert_eq!(*picture.get_pixel(WEFT_LEFT + 8, CLOTH_TOP + row * 16 + 8), Rgb(color));
    }
    // There are lines between squares, and nothing between blocks.
    assert_ne!(*picture.get_pixel(LEFT + 16, CLOTH_TOP + 8), Rgb([255; 3]));
    assert_eq!(*picture.get_pixel(LEFT + 40, CLOTH_TOP - 8), Rgb([255; 3]));
}

#[test]
fn a_lift_plan_stands_where_the_treadling_would() {
    let shafts = Draft {
        shedding: Shedding::LiftPlan(vec![vec![1], vec![2, 4], vec![3], vec![]]),
        rising_shed: false,
        ..shafts()
    };
    let cloth = cloth(shafts.drawdown().unwrap());
    let picture = drawn(&cloth, Some(&shafts), Side::Face);
    assert_eq!(squares(&picture, TREADLES_LEFT, CLOTH_TOP, 4, 4), ["....", "..#.", ".#.#", "#..."]);
    assert_eq!(squares(&picture, TREADLES_LEFT, THREADING_TOP, 4, 4), ["...."; 4]);
    // The shed is a sinking one: marked shafts go down.
    assert_eq!(squares(&picture, LEFT, CLOTH_TOP, 6, 4), ["######", "##.###", "#.#..#", ".####."]);
}

#[test]
fn the_back_is_turned_over_sideways() {
    let shafts = shafts();
    let mut cloth = cloth(shafts.drawdown().unwrap());
    for side in [Side::Face, Side::Back] {
        // Point paper: the drawdown follows the colour bar of the warp.
        let picture = drawn(&cloth, None, side);
        let rows = squares(&picture, LEFT, THREADING_TOP, 6, 4);
        match side {
            Side::Face => assert_eq!(rows, ["###.##", ".#.##.", "..#...", "##..##"]),
            Side::Back => assert_eq!(rows, ["..#...", "#..#.#", "###.##", "..##.."]),
        }
        assert_eq!(*picture.get_pixel(TREADLES_LEFT + 8, THREADING_TOP + 3 * 16 + 8), Rgb(WARP));
    }
    // A draft describes the face, so the back is drawn without it.
    let back = drawn(&cloth, Some(&shafts), Side::Back);
    assert_eq!(back, drawn(&cloth, None, Side::Back));
    // End 1 is on the right.
    let mut warp = cloth.warp().to_vec();
    warp[0].material = 1;
    let (drawdown, weft) = (cloth.drawdown().clone(), cloth.weft().to_vec());
    cloth = Woven::new(drawdown, warp, weft, cloth.materials().to_vec(), vec![Section::Circle]).unwrap();
    assert_eq!(*drawn(&cloth, None, Side::Face).get_pixel(LEFT + 8, BAR_TOP + 8), Rgb(WEFT));
    assert_eq!(*drawn(&cloth, None, Side::Back).get_pixel(LEFT + 88, BAR_TOP + 8), Rgb(WEFT));
}

#[test]
fn squares_shrink_with_the_cloth_down_to_a_pixel() {
    let weave = Weave::parse("satin 8(3)").unwrap();
    for (ends, picks, square) in [(8, 8, 16), (300, 100, 8), (600, 599, 4), (700, 900, 2), (3000, 900, 1)] {
        let cloth = cloth(weave.drawdown(ends, picks).unwrap());
        let picture = drawn(&cloth, None, Side::Face);
        let (bar, line) = (square.max(8), u32::from(square >= 4));
        let top = 12 + bar + line + bar;
        for (end, pick) in
            [(0, 0), (7, 0), (ends - 1, 0), (ends - 1, picks - 1), (2, 1), (3, 1), (0, picks - 1)]
        {
            let (x, y) = (12 + end as u32 * square, top + (picks - 1 - pick) as u32 * square);
            let color = if weave.up(end, pick) { [0; 3] } else { [255; 3] };
            assert_eq!(
                *picture.get_pixel(x + square / 2, y + square / 2),
                Rgb(color),
                "{end}, {pick} of {ends}"
            );
        }
    }
}

#[test]
fn what_no_loom_has_is_not_drawn() {
    let mut shafts = shafts();
    shafts.threading[3] = vec![101];
    let cloth = cloth(shafts.drawdown().unwrap());
    assert_eq!(drawn(&cloth, Some(&shafts), Side::Face), drawn(&cloth, None, Side::Face));
    // A draft of another cloth is drawn as it is.
    shafts.threading.truncate(2);
    shafts.shedding = Shedding::LiftPlan(vec![vec![1]]);
    let picture = drawn(&cloth, Some(&shafts), Side::Face);
    assert_eq!(squares(&picture, LEFT, THREADING_TOP, 6, 2), [".#....", "#....."]);
}

#[track_caller]
fn refused(cloth: &Woven, path: &Path) -> WriteError {
    draft(cloth, None, Side::Face, path).unwrap_err()
}

#[test]
fn what_can_not_be_drawn_leaves_nothing_behind() {
    let folder: TempDir = tempfile::tempdir().unwrap();
    let plain = Weave::parse("plain").unwrap();
    let (small, long) = (cloth(plain.drawdown(4, 4).unwrap()), cloth(plain.drawdown(2, 40_000).unwrap()));
    let error = refused(&small, &folder.path().join("draft.jpg"));
    assert!(matches!(error, WriteError::NotPng { .. }) && error.to_string().contains("draft.jpg"), "{error}");
    let path = folder.path().join("draft.png");
    std::fs::write(&path, "as it was").unwrap();
    let error = refused(&long, &path);
    assert!(matches!(error, WriteError::DraftTooLarge { picks: 40_000, limit: 32_767, .. }), "{error}");
    assert_eq!(std::fs::read(&path).unwrap(), b"as it was");
    assert!(matches!(refused(&small, &folder.path().join("no/folder/draft.png")), WriteError::Io { .. }));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    draft(&small, None, Side::Face, &path).unwrap();
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    assert!(image::open(&path).is_ok());
}
