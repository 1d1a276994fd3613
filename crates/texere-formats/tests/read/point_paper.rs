//! Design files with an image as weave: the lift of each pixel, and faults that are named with
//! their places.

use std::error::Error;
use std::path::Path;

use image::{ImageFormat, Rgb, RgbImage, Rgba, RgbaImage};
use tempfile::TempDir;
use texere_fabric::{Weave, Woven};
use texere_formats::{Design, ReadError, read};

const BLACK: [u8; 3] = [0, 0, 0];
const WHITE: [u8; 3] = [255, 255, 255];
const RED: [u8; 3] = [200, 16, 32];

/// The text of every design in this file, except `[weave]`.
const THREADS: &str = "[yarns.a]\ndiameter_mm = 0.2\n[yarns.red]\ndiameter_mm = 0.2\ncolor = \"#c81020\"\n\
    [warp]\nyarns = [\"a\"]\nspacing_mm = 0.6\n[weft]\nyarns = [\"2 red\", \"a\"]\nspacing_mm = 0.6\n";

/// A folder with `motif.png`, drawn as a weaver draws it.
fn drawn(rows: &[&str]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    picture(rows).save(folder.path().join("motif.png")).unwrap();
    folder
}

/// A picture with `#` black, `.` white and `r` red.
fn picture(rows: &[&str]) -> RgbImage {
    RgbImage::from_fn(rows[0].len() as u32, rows.len() as u32, |column, row| {
        Rgb(match rows[row as usize].as_bytes()[column as usize] {
            b'#' => BLACK,
            b'r' => RED,
            _ => WHITE,
        })
    })
}

fn design(folder: &Path, weave: &str) -> Result<Design, ReadError> {
    let path = folder.join("design.toml");
    std::fs::write(&path, format!("[weave]\nimage = \"motif.png\"\n{weave}{THREADS}")).unwrap();
    read(&path)
}

fn cloth(folder: &Path, weave: &str) -> Woven {
    design(folder, weave).unwrap().structure.woven().unwrap().cloth().clone()
}

/// The drawdown as a weaver draws it, with `#` for warp up.
fn rows(woven: &Woven) -> Vec<String> {
    let drawdown = woven.drawdown();
    let sign = |end, pick| if drawdown.up(end, pick) { '#' } else { '.' };
    let row = |pick| (0..drawdown.ends()).map(|end| sign(end, pick)).collect();
    (0..drawdown.picks()).rev().map(row).collect()
}

/// The message of the refusal, or of its cause, has to have all of `parts`.
#[track_caller]
fn refused(folder: &Path, weave: &str, parts: &[&str]) {
    let error = design(folder, weave).expect_err(weave);
    let cause = error.source().map(ToString::to_string).unwrap_or_default();
    for part in parts {
        assert!(format!("{error}: {cause}").contains(part), "\"{error}: {cause}\" lacks \"{part}\"");
    }
}

const DRAWING: [&str; 3] = ["#..#.", "##...", "..###"];

#[test]
fn a_picture_of_two_colours_is_a_drawdown() {
    let folder = drawn(&DRAWING);
    assert_eq!(rows(&cloth(folder.path(), "")), DRAWING);
    assert_eq!(rows(&cloth(folder.path(), "ends = 5\npicks = 3\n")), DRAWING);
    let turned = cloth(folder.path(), "rows = \"first-pick-first\"\n");
    assert_eq!(rows(&turned), ["..###", "##...", "#..#."]);
    assert_eq!(rows(&cloth(folder.path(), "rows = \"last-pick-first\"\n")), DRAWING);
    // The darker colour is warp up, for any two colours in either order.
    let folder = drawn(&["r..r.", "rr...", "..rrr"]);
    assert_eq!(rows(&cloth(folder.path(), "")), DRAWING);
    let folder = drawn(&["#rr#r", "##rrr", "rr###"]);
    assert_eq!(rows(&cloth(folder.path(), "")), DRAWING);
}

#[test]
fn kinds_of_image_read_alike() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("motif.png");
    let picture = picture(&DRAWING);
    for format in [ImageFormat::Png, ImageFormat::Bmp, ImageFormat::Tiff] {
        picture.save_with_format(&path, format).unwrap();
        assert_eq!(rows(&cloth(folder.path(), "")), DRAWING, "{format:?}");
        let gray = image::DynamicImage::from(picture.clone()).to_luma8();
        gray.save_with_format(&path, format).unwrap();
        assert_eq!(rows(&cloth(folder.path(), "")), DRAWING, "{format:?}, grey");
    }
    // A palette with one bit a pixel. White is 0.
    let mut encoder = png::Encoder::new(std::fs::File::create(&path).unwrap(), 5, 3);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::One);
    encoder.set_palette([WHITE, BLACK].concat());
    let bits = [0b1001_0000, 0b1100_0000, 0b0011_1000];
    encoder.write_header().unwrap().write_image_data(&bits).unwrap();
    assert_eq!(rows(&cloth(folder.path(), "")), DRAWING);
    // The picture as an indexed BMP, made byte by byte: rows from the bottom, padded to four bytes.
    let mut bmp = b"BM".to_vec();
    for word in [74u32, 0, 62, 40, 5, 3, 1 | 1 << 16, 0, 12, 2835, 2835, 2, 2, 0x00ff_ffff, 0] {
        bmp.extend(word.to_le_bytes());
    }
    for row in bits.iter().rev() {
        bmp.extend([*row, 0, 0, 0]);
    }
    std::fs::write(&path, bmp).unwrap();
    assert_eq!(rows(&cloth(folder.path(), "")), DRAWING);
}

#[test]
fn areas_of_one_weave_join_up() {
    let drawing = ["##..rr##", "#....r##", "##.#..##", "##...rr#", "#.......", "##..rr##", "rr..##.."];
    let folder = drawn(&drawing);
    let table = "repeat = [2, 3]\n[weave.colors]\n\"#000000\" = \"satin 5(2)\"\n\"#FFFFFF\" = \"1/3\"\n\
                 \"#C81020\" = \"herringbone 2/2(6)\"\n";
    let woven = cloth(folder.path(), table);
    let drawdown = woven.drawdown();
    assert_eq!((drawdown.ends(), drawdown.picks()), (16, 21));
    let [black, white, red] =
        ["satin 5(2)", "1/3", "herringbone 2/2(6)"].map(|text| Weave::parse(text).unwrap());
    for end in 0..16 {
        for pick in 0..21 {
            let weave = match drawing[6 - pick % 7].as_bytes()[end % 8] {
                b'#' => &black,
                b'r' => &red,
                _ => &white,
            };
            assert_eq!(drawdown.up(end, pick), weave.up(end, pick), "end {end}, pick {pick}");
        }
    }
    assert!(design(folder.path(), table).unwrap().warnings().is_empty());
}

#[test]
fn picks_take_the_yarns_of_the_weft_in_turn() {
    let woven = cloth(drawn(&["#.", ".#", "#.", ".#", "#."]).path(), "");
    let names: Vec<_> =
        woven.weft().iter().map(|pick| woven.materials()[pick.material as usize].name.as_str()).collect();
    assert_eq!(names, ["red", "red", "a", "red", "red"]);
}

#[test]
fn a_picture_a_notation_and_a_wif_give_one_drawdown() {
    let folder = drawn(&["##.##.#", "#.##.##", ".##.##.", "##.##.#"]);
    let by_picture = cloth(folder.path(), "");
    let text = format!("[weave]\nnotation = \"2/1\"\nends = 7\npicks = 4\n{THREADS}");
    std::fs::write(folder.path().join("notation.toml"), text).unwrap();
    let wif = "[WARP]\nThreads=7\n[WEFT]\nThreads=4\n[THREADING]\n1=1\n2=2\n3=3\n4=1\n5=2\n6=3\n7=1\n\
               [TIEUP]\n1=1,2\n2=2,3\n3=3,1\n[TREADLING]\n1=1\n2=2\n3=3\n4=1\n";
    std::fs::write(folder.path().join("draft.wif"), wif).unwrap();
    std::fs::write(folder.path().join("by_wif.toml"), format!("[weave]\nwif = \"draft.wif\"\n{THREADS}"))
        .unwrap();
    for (name, draft) in [("notation.toml", false), ("draft.wif", true), ("by_wif.toml", true)] {
        let design = read(folder.path().join(name)).unwrap();
        assert_eq!(design.structure.woven().unwrap().draft().is_some(), draft, "{name}");
        let woven = design.structure.woven().unwrap().cloth().clone();
        assert_eq!(woven.drawdown(), by_picture.drawdown(), "{name}");
        if let Some(draft) = design.structure.woven().unwrap().draft() {
            assert_eq!(draft.drawdown().unwrap(), *woven.drawdown());
        }
    }
}

#[test]
fn a_colour_that_no_pixel_has_is_told() {
    let folder = drawn(&DRAWING);
    let table = "[weave.colors]\n\"#000000\" = \"3/1\"\n\"#ffffff\" = \"1/3\"\n\"#123456\" = \"plain\"\n";
    let warnings = design(folder.path(), table).unwrap().warnings();
    assert!(
        matches!(&warnings[..], [one] if one.contains("#123456") && one.contains("motif.png")),
        "{warnings:?}"
    );
}

#[test]
fn faults_are_named_with_their_place() {
    let folder = drawn(&["#.#.", "...#", "#rr#"]);
    let folder = folder.path();
    let two = "[weave.colors]\n\"#000000\" = \"3/1\"\n\"#ffffff\" = \"1/3\"\n";
    refused(folder, "", &["motif.png, column 2, row 3", "#c81020", "[weave.colors]"]);
    refused(folder, two, &["motif.png, column 2, row 3", "#c81020", "#000000, #ffffff"]);
    refused(folder, &format!("{two}\"#c8102\" = \"plain\"\n"), &["line 6", "\"#c8102\"", "a colour like"]);
    refused(folder, &format!("{two}\"#FFFFFF\" = \"plain\"\n"), &["line 5", "#ffffff", "once"]);
    refused(
        folder,
        &format!("{two}\"#c81020\" = \"3|1\"\n"),
        &["line 6: weave.colors.\"#c81020\"", "\"3|1\""],
    );
    refused(folder, "repeat = [0, 1]\n", &["line 3: weave.repeat is 0", "1 to"]);
    refused(folder, "repeat = [1, -1]\n", &["line 3: weave.repeat is -1"]);
    let two_numbers = "two whole numbers, across the ends and along the picks";
    refused(folder, "repeat = [1]\n", &["line 3: weave.repeat is \"[1]\"", two_numbers]);
    refused(folder, "repeat = [2, 3, 4]\n", &["line 3: weave.repeat is \"[2, 3, 4]\"", two_numbers]);
    refused(folder, "repeat = [2, 3, 4, \"x\"]\n", &["line 3: weave.repeat is \"x\"", "a whole number"]);
    refused(folder, "repeat = 2\n", &["line 3: weave.repeat is \"2\"", "a list"]);
    refused(
        folder,
        &format!("repeat = [1000000, 1000000]\n{two}\"#c81020\" = \"plain\"\n"),
        &["4000000 ends"],
    );
    refused(folder, "rows = \"top\"\n", &["line 3: weave.rows", "top", "last-pick-first"]);
    refused(folder, "ends = 5\n", &["line 3: weave.ends is \"5\"", "4, as the image"]);
    refused(folder, "repeat = [2, 2]\npicks = 3\n", &["line 4: weave.picks is \"3\"", "6, as the image"]);
    refused(folder, "notation = \"plain\"\n", &["exactly one", "weave.image"]);
    let path = folder.join("other.toml");
    for (key, line) in [("rows = \"last-pick-first\"", 5), ("repeat = [1, 1]", 5), ("colors = {}", 5)] {
        let text = format!("[weave]\nnotation = \"plain\"\nends = 4\npicks = 4\n{key}\n{THREADS}");
        std::fs::write(&path, text).unwrap();
        let error = read(&path).unwrap_err().to_string();
        assert!(error.contains(&format!("line {line}")) && error.contains("weave.image"), "{error}");
    }
}

#[test]
fn one_colour_alone_is_no_weave() {
    refused(drawn(&["##", "##"]).path(), "", &["column 1, row 1", "#000000", "two colours"]);
    // Two colours of equal brightness.
    let folder = tempfile::tempdir().unwrap();
    let alike = RgbImage::from_fn(2, 1, |column, _| Rgb(if column == 0 { [26, 0, 0] } else { [0, 8, 27] }));
    alike.save(folder.path().join("motif.png")).unwrap();
    refused(folder.path(), "", &["column 2, row 1", "#00081b", "two colours, the darker"]);
}

#[test]
fn a_pixel_that_is_not_opaque_has_no_weave() {
    let folder = tempfile::tempdir().unwrap();
    let glass = RgbaImage::from_fn(2, 2, |column, _| Rgba([0, 0, 0, if column == 0 { 255 } else { 128 }]));
    glass.save(folder.path().join("motif.png")).unwrap();
    refused(
        folder.path(),
        "[weave.colors]\n\"#000000\" = \"3/1\"\n",
        &["column 2, row 1", "#000000, partly transparent (alpha 128 of 255)"],
    );
}

#[test]
fn a_photograph_is_no_point_paper() {
    let folder = tempfile::tempdir().unwrap();
    RgbImage::from_fn(20, 20, |x, y| Rgb([x as u8, y as u8, 0]))
        .save(folder.path().join("motif.png"))
        .unwrap();
    refused(folder.path(), "", &["column 17, row 13", "#100c00", "256 colours"]);
}

#[test]
fn what_is_no_image_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("motif.png");
    let missing = design(folder.path(), "").unwrap_err();
    assert!(
        matches!(missing.innermost(), ReadError::Io { .. })
            && missing.innermost().to_string().contains("motif.png"),
        "{missing}"
    );
    // The error has the place in the design, and the decoder's message at the end of its causes.
    std::fs::write(&path, b"\x89PNG\r\n\x1a\n").unwrap();
    let broken = design(folder.path(), "rows = \"last-pick-first\"\n").unwrap_err();
    assert!(broken.to_string().contains("design.toml, line 2: weave.image can't be taken"), "{broken}");
    assert!(broken.innermost().source().is_some_and(|cause| !cause.to_string().is_empty()));
    for bytes in
        [&b""[..], b"not an image", b"\xff\xd8\xff\xe0\0\x10JFIF\0", b"\x89PNG\r\n\x1a\n", b"BM", b"II*\0"]
    {
        std::fs::write(&path, bytes).unwrap();
        refused(folder.path(), "", &["motif.png can't be read as a PNG, BMP or TIFF image"]);
    }
    // An image that is cut short anywhere is refused, and never taken for a smaller one.
    for format in [ImageFormat::Png, ImageFormat::Tiff] {
        picture(&DRAWING).save_with_format(&path, format).unwrap();
        let whole = std::fs::read(&path).unwrap();
        for length in 0..whole.len() - 16 {
            std::fs::write(&path, &whole[..length]).unwrap();
            let refused = design(folder.path(), "");
            assert!(
                refused.as_ref().is_err_and(|error| matches!(error.innermost(), ReadError::Image { .. })),
                "{format:?} cut to {length}: {refused:?}"
            );
        }
    }
}

#[test]
fn an_image_too_large_is_refused_before_it_is_decoded() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("motif.png");
    for (width, height) in [(60_000, 60_000), (1_000_001, 1), (16_385, 16_384)] {
        let mut encoder = png::Encoder::new(std::fs::File::create(&path).unwrap(), width, height);
        encoder.set_color(png::ColorType::Grayscale);
        encoder.set_depth(png::BitDepth::One);
        encoder.write_header().unwrap().write_chunk(png::chunk::IDAT, b"").unwrap();
        refused(folder.path(), "", &["motif.png", &width.to_string(), &height.to_string(), "268435456"]);

        let mut bmp = b"BM".to_vec();
        for word in [62u32, 0, 62, 40, width, height, 1 | 1 << 16, 0, 0, 0, 0, 2, 2, 0x00ff_ffff, 0] {
            bmp.extend(word.to_le_bytes());
        }
        std::fs::write(&path, bmp).unwrap();
        refused(folder.path(), "", &["motif.png"]);
    }
}
