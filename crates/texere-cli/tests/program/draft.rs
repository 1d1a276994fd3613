//! `texere draft` and designs by image, as a user runs them.

use std::path::Path;

use crate::{design, stderr, stdout, texere};

/// Width and height that a PNG file states.
pub(crate) fn png_size(path: &Path) -> [u32; 2] {
    let bytes = std::fs::read(path).unwrap();
    assert_eq!(bytes[..8], *b"\x89PNG\r\n\x1a\n");
    [16, 20].map(|at| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap()))
}

/// A BMP image of two colours, black where the drawing has `#`. Its first row is the bottom one.
fn bmp(drawing: &[&str]) -> Vec<u8> {
    let (width, height) = (drawing[0].len() as u32, drawing.len() as u32);
    let mut bytes = b"BM".to_vec();
    let size = width.next_multiple_of(4) * height;
    for word in [62 + size, 0, 62, 40, width, height, 1 | 8 << 16, 0, size, 2835, 2835, 2, 2, 0x00ff_ffff, 0]
    {
        bytes.extend(word.to_le_bytes());
    }
    for row in drawing.iter().rev() {
        bytes.extend(row.bytes().map(|sign| u8::from(sign == b'#')));
        bytes.extend(vec![0; (width.next_multiple_of(4) - width) as usize]);
    }
    bytes
}

#[test]
fn no_float_of_the_jacquards_is_longer_than_their_weaves() {
    for (name, size, float) in [("damask.toml", (480, 320), 7), ("paper/figure-7a.toml", (2880, 1840), 3)] {
        let text = stdout(&texere(&["draft", &design(name), "--text"]));
        let rows: Vec<&[u8]> = text.lines().map(str::as_bytes).collect();
        assert_eq!((rows[0].len(), rows.len()), size, "{name}");
        let longest = |line: &[u8]| line.chunk_by(|a, b| a == b).map(<[u8]>::len).max().unwrap();
        let column = |end: usize| rows.iter().map(|row| row[end]).collect::<Vec<_>>();
        let along = (0..size.0).map(|end| longest(&column(end))).max();
        assert_eq!(along.max(rows.iter().map(|row| longest(row)).max()), Some(float), "{name}");
        // The drawdown has a figure and its ground, not one weave all over.
        let up = text.bytes().filter(|&sign| sign == b'1').count() as f64 / (size.0 * size.1) as f64;
        assert!((0.3..0.6).contains(&up), "{name}: {up}");
    }
}

#[test]
fn an_image_a_notation_and_a_wif_draw_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let threads = "[yarns.a]\ndiameter_mm = 0.3\n[warp]\nyarns = [\"a\"]\nper_cm = 8.0\n\
                   [weft]\nyarns = [\"a\"]\nper_cm = 8.0\n";
    let drawing = ["##.###", "#.###.", ".###.#", "###.##"];
    std::fs::write(folder.path().join("motif.bmp"), bmp(&drawing)).unwrap();
    let wif = "[WARP]\nThreads=6\n[WEFT]\nThreads=4\n[THREADING]\n1=1\n2=2\n3=3\n4=4\n5=1\n6=2\n\
               [TIEUP]\n1=1,2,3\n2=2,3,4\n3=3,4,1\n4=4,1,2\n[TREADLING]\n1=1\n2=2\n3=3\n4=4\n";
    std::fs::write(folder.path().join("draft.wif"), wif).unwrap();
    let mut pictures = Vec::new();
    for (name, weave) in [
        ("image", "image = \"motif.bmp\""),
        ("notation", "notation = \"twill 3/1\"\nends = 6\npicks = 4"),
        ("wif", "wif = \"draft.wif\""),
    ] {
        let path = folder.path().join(name).with_extension("toml");
        std::fs::write(&path, format!("[weave]\n{weave}\n{threads}")).unwrap();
        let path = path.to_str().unwrap();
        let face = stdout(&texere(&["draft", path, "--text"]));
        assert_eq!(face, "110111\n101110\n011101\n111011\n", "{name}");
        // The back is the face turned over sideways: it is mirrored, and ends that were up are
        // down.
        let back = stdout(&texere(&["draft", path, "--text", "--back"]));
        assert_eq!(back, "000100\n100010\n010001\n001000\n", "{name}");
        let picture = folder.path().join(name).with_extension("png");
        texere(&["draft", path, "-o", picture.to_str().unwrap(), "--back"]);
        pictures.push(std::fs::read(picture).unwrap());
    }
    assert!(pictures[0] == pictures[1] && pictures[0] == pictures[2]);
}

#[test]
fn the_herringbone_has_its_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("herringbone.toml");
    let text = "[weave]\nnotation = \"herringbone 2/2(16)\"\nends = 192\npicks = 192\n[yarns.a]\ndiameter_mm = 0.3\n\
                [warp]\nyarns = [\"a\"]\nper_cm = 10.0\n[weft]\nyarns = [\"a\"]\nper_cm = 10.0\n";
    std::fs::write(&path, text).unwrap();
    let by_name = stdout(&texere(&["draft", path.to_str().unwrap(), "--text"]));
    assert_eq!(by_name, stdout(&texere(&["draft", &design("herringbone.wif"), "--text"])));
}

#[test]
fn a_picture_is_written_and_its_size_told() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("herringbone.png");
    let target = path.to_str().unwrap();
    let output = texere(&["draft", &design("herringbone.wif"), "-o", target]);
    let [width, height] = png_size(&path);
    assert_eq!(stdout(&output), format!("{target}: {width} × {height} pixels\n"));
    // Threading, tie-up and treadling need room; the back is point paper alone and needs none.
    let output = texere(&["draft", &design("herringbone.wif"), "--back", "-o", target]);
    assert!(output.status.success());
    let back = png_size(&path);
    assert!(back[0] < width && back[1] < height, "{back:?}");
    // With --text, standard output is the drawdown alone.
    let output = texere(&["draft", &design("plain.toml"), "--text", "-o", target]);
    assert_eq!(stdout(&output).lines().count(), 48);
    assert_ne!(png_size(&path), back);
}

#[test]
fn faults_have_their_exit_codes() {
    let folder = tempfile::tempdir().unwrap();
    let bad = folder.path().join("bad.toml");
    std::fs::write(&bad, "[weave]\nimage = \"motif.bmp\"\nrepeat = [0, 1]\n").unwrap();
    let odd = folder.path().join("odd.toml");
    std::fs::write(&odd, "[weave]\nimage = \"motif.bmp\"\n[weave.colors]\n\"#000000\" = \"3/1\"\n").unwrap();
    let lost = folder.path().join("lost.toml");
    std::fs::write(&lost, "[weave]\nimage = \"nowhere.png\"\n").unwrap();
    std::fs::write(folder.path().join("motif.bmp"), bmp(&["#.#", ".##"])).unwrap();
    let jpeg = folder.path().join("draft.jpg");
    let nowhere = folder.path().join("no").join("draft.png");
    let [bad, odd, lost, jpeg, nowhere] =
        [&bad, &odd, &lost, &jpeg, &nowhere].map(|path| path.to_str().unwrap());
    let plain = design("plain.toml");
    for (args, code, said) in [
        (vec!["draft", &plain], 2, "--text"),
        (vec!["draft", &plain, "--back"], 2, "--text"),
        (vec!["draft", &plain, "-o", jpeg], 2, "draft.jpg does not end in .png"),
        (vec!["draft", &plain, "-o", nowhere], 1, "draft.png"),
        (vec!["draft", bad, "--text"], 3, "line 3: weave.repeat is 0"),
        (vec!["draft", odd, "--text"], 3, "motif.bmp, column 2, row 1 from the top left: colour #ffffff"),
        (vec!["draft", lost, "--text"], 1, "nowhere.png"),
    ] {
        let output = texere(&args);
        assert_eq!(output.status.code(), Some(code), "{args:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(said), "{args:?}: {}", stderr(&output));
    }
    assert!(!Path::new(jpeg).exists());
}

#[test]
fn a_knits_draft_is_its_chart() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("tuck.png");
    let text = stdout(&texere(&["draft", &design("tuck.toml"), "--text", "-o", path.to_str().unwrap()]));
    assert_eq!(text, "kkkk\nkktk\nkkkk\ntkkk\n");
    let [width, height] = png_size(&path);
    // The needle diagram stands below the chart's squares of 16 pixels.
    assert!(width > 4 * 16 && height > 4 * 7 * 16, "{width} x {height}");
    let back = stdout(&texere(&["draft", &design("rib.toml"), "--text", "--back"]));
    assert_eq!(back, "kp\n");
}
