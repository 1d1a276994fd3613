//! `texere render` as a user runs it. It draws on any Vulkan device; lavapipe suffices.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::fs::File;
use std::io::BufReader;
use std::path::PathBuf;
use std::process::{Command, Output};

const PLAIN: &str = "../../designs/plain.toml";

fn render(args: &[&str]) -> Output {
    let folder = env!("CARGO_MANIFEST_DIR");
    Command::new(env!("CARGO_BIN_EXE_texere")).current_dir(folder).arg("render").args(args).output().unwrap()
}

/// Width and height by the header of a PNG file.
fn png_size(path: &PathBuf) -> [u32; 2] {
    let bytes = std::fs::read(path).unwrap();
    assert_eq!(bytes[..8], *b"\x89PNG\r\n\x1a\n");
    [16, 20].map(|at| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap()))
}

#[test]
fn a_picture_has_the_size_that_was_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("plain.png");
    let out = path.to_str().unwrap();
    // Threads are round in shape: 64 ends of 191 points and 48 picks of 255. There are 24 triangles
    // an interval, and 4 for each cap.
    let output = render(&[
        PLAIN,
        "-o",
        out,
        "--size",
        "120x90",
        "--view",
        "back",
        "--supersampling",
        "1",
        "--no-settle",
    ]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success() && text.contains("585344 triangles"), "{text}");
    assert_eq!(png_size(&path), [120, 90]);
}

/// Saved cloth at rest looks like the cloth from its design, also if the weft is one yarn that
/// turns at the selvedges.
#[test]
fn saved_cloth_is_drawn_as_its_design_is() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let [design, saved] = ["poplin.toml", "poplin.yarns"].map(path);
    for selvedge in [false, true] {
        let text = format!(
            "weave = {{ notation = \"plain\", ends = 6, picks = 6 }}\nyarns.a.diameter_mm = 0.143\n\
             warp = {{ yarns = [\"a\"], spacing_mm = 0.19 }}\nweft = {{ yarns = [\"a\"], spacing_mm = 0.35 }}\n\
             cloth.selvedge = {selvedge}\n"
        );
        std::fs::write(&design, text).unwrap();
        let cloth = texere::read(&design).unwrap().rest(&*texere::open("cpu").unwrap()).run().unwrap();
        texere::write::yarns(cloth.yarns(), &saved).unwrap();
        for view in ["face", "cut-warp", "cut-weft"] {
            let [own, other] = ["own.png", "other.png"].map(path);
            for (input, output) in [(&design, &own), (&saved, &other)] {
                let done = render(&[input, "-o", output, "--size", "80x60", "--view", view]);
                assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
            }
            let same = std::fs::read(own).unwrap() == std::fs::read(other).unwrap();
            assert!(same, "{view}, selvedge {selvedge}: another picture");
        }
    }
    let settled = render(&[&saved, "-o", &path("x.png"), "--size", "80x60", "--settle"]);
    assert!(settled.status.success(), "{}", String::from_utf8_lossy(&settled.stderr));
}

#[test]
fn true_scale_makes_the_size() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("plain.png");
    // 64 ends and 48 picks, 15 to the centimetre: some 43 by 32 mm.
    let output = render(&[PLAIN, "-o", path.to_str().unwrap(), "--mm-per-pixel", "0.5"]);
    assert!(output.status.success());
    let [width, height] = png_size(&path);
    assert!((85..=90).contains(&width) && (64..=69).contains(&height), "{width} {height}");
}

#[test]
fn a_turntable_numbers_its_pictures() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("turn.png");
    let (out, size) = (path.to_str().unwrap(), "60x45");
    let output = render(&[PLAIN, "-o", out, "--view", "turntable", "--frames", "2", "--size", size]);
    assert!(output.status.success());
    let [first, second] =
        ["turn-001.png", "turn-002.png"].map(|name| std::fs::read(folder.path().join(name)));
    assert_ne!(first.unwrap(), second.unwrap());
    assert!(!path.exists());
}

#[test]
fn what_makes_no_picture_is_a_wrong_command_line() {
    for args in [
        &[PLAIN, "-o", "x.png", "--size", "0x10"][..],
        &[PLAIN, "-o", "x.png", "--size", "wide"],
        &[PLAIN, "-o", "x.png", "--device", "abacus"],
        &[PLAIN, "-o", "x.png", "--view", "close-up", "--width", "-1"],
        &[PLAIN, "-o", "x.png", "--view", "close-up", "--width", "NaN"],
        &[PLAIN, "-o", "x.png", "--width", "0"],
        &[PLAIN, "-o", "x.png", "--mm-per-pixel", "inf"],
        &[PLAIN, "-o", "x.jpg"],
        &[PLAIN, PLAIN, "-o", "x.png"],
        &[PLAIN],
    ] {
        let output = render(args);
        assert_eq!(output.status.code(), Some(2), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    }
}

#[test]
fn a_point_off_the_cloth_is_refused_with_the_cloths_limits() {
    for at in ["100,5", "5,-3", "5,1e30"] {
        let output = render(&[PLAIN, "-o", "x.png", "--view", "cut-warp", "--at", at]);
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{said}");
        // 64 ends and 48 picks, 15 to the centimetre.
        assert!(said.contains("is off the cloth, which reaches from") && said.contains("to 42."), "{said}");
    }
}

#[test]
fn supersampling_is_blamed_where_it_is_the_cause() {
    // lavapipe's textures have sides of at most 16,384 pixels.
    let output = render(&[PLAIN, "-o", "x.png", "--size", "16384x1"]);
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("supersampled 2 times") && said.contains("1 times is the most"), "{said}");
}

#[test]
fn what_is_seen_where_no_yarn_is_can_be_chosen() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("plain.png");
    let drawn = |background: &str| {
        let size = ["--size", "60x40", "--view", "oblique", "--background", background];
        let output = render(&[&[PLAIN, "-o", out.to_str().unwrap()], &size[..]].concat());
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        pixels(&out)
    };
    let (plum, nothing) = (drawn("#78285A"), drawn("none"));
    // The picture's corner lies beside the cloth.
    assert_eq!((plum.0, &plum.1[..3]), (png::ColorType::Rgb, &[0x78, 0x28, 0x5a][..]));
    assert_eq!((nothing.0, &nothing.1[..4]), (png::ColorType::Rgba, &[0; 4][..]));
    let middle = 4 * (20 * 60 + 30);
    assert!(nothing.1[middle + 3] > 150);
    for background in ["", "plum", "#78285", "#+8285A", "78285A", "#78285AFF"] {
        let refused = render(&[PLAIN, "-o", out.to_str().unwrap(), "--background", background]);
        assert_eq!(refused.status.code(), Some(2), "{background}");
    }
}

/// If the number of threads is even, the middle of the cloth lies between two threads.
#[test]
fn a_cut_goes_through_a_thread_if_it_is_not_told_where() {
    let folder = tempfile::tempdir().unwrap();
    let [design, cut, thread] = ["cloth.toml", "cut.png", "thread.png"].map(|name| folder.path().join(name));
    let text = "[weave]\nnotation = \"plain\"\nends = 8\npicks = 6\n[yarns.a]\ndiameter_mm = 0.4\n\
                [warp]\nyarns = [\"a\"]\nspacing_mm = 0.9\n[weft]\nyarns = [\"a\"]\nspacing_mm = 0.9\n";
    std::fs::write(&design, text).unwrap();
    let picture = |view, out: &PathBuf, at: &[&str]| {
        let args = [design.to_str().unwrap(), "-o", out.to_str().unwrap(), "--view", view, "--size", "80x40"];
        let output = render(&[&args[..], at].concat());
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        std::fs::read(out).unwrap()
    };
    // The middle is (3.6, 2.7). Pick 3 lies at 2.25, pick 4 at 3.15, end 4 at 3.15, and end 5 at
    // 4.05.
    for (view, either) in [("cut-warp", ["3.6,2.25", "3.6,3.15"]), ("cut-weft", ["3.15,2.7", "4.05,2.7"])] {
        let drawn = picture(view, &cut, &[]);
        assert!(either.iter().any(|at| picture(view, &thread, &["--at", at]) == drawn), "{view}");
        assert!(picture(view, &thread, &["--at", "3.6,2.7"]) != drawn, "{view}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_turntable_keeps_a_name_that_is_no_unicode() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let folder = tempfile::tempdir().unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_texere"))
        .args(["render", PLAIN, "--view", "turntable", "--frames", "1", "--size", "20x15", "-o"])
        .arg(folder.path().join(OsStr::from_bytes(b"t\xffrn.png")))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    assert!(output.status.success());
    assert!(folder.path().join(OsStr::from_bytes(b"t\xffrn-001.png")).exists());
}

/// A machine without drivers is a failure of the machine, not of the command line.
#[cfg(target_os = "linux")]
#[test]
fn no_vulkan_and_no_opencl_exit_alike() {
    let folder = tempfile::tempdir().unwrap();
    for (command, device, out) in
        [("render", "auto", "x.png"), ("mesh", "wgpu", "x.ply"), ("mesh", "opencl", "x.ply")]
    {
        let output = Command::new(env!("CARGO_BIN_EXE_texere"))
            .args([command, PLAIN, "--device", device, "-o"])
            .arg(folder.path().join(out))
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .envs([("OCL_ICD_VENDORS", "/nowhere"), ("OCL_ICD_FILENAMES", "")])
            .envs([("VK_DRIVER_FILES", "/nowhere.json"), ("VK_ICD_FILENAMES", "/nowhere.json")])
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{command} {device}: {said}");
    }
}

/// Colours of an opaque picture's pixels, row by row.
fn colors(path: &PathBuf) -> Vec<[u8; 3]> {
    let (kind, bytes) = pixels(path);
    assert_eq!(kind, png::ColorType::Rgb);
    bytes.as_chunks().0.to_vec()
}

/// The colour type of a picture, and the bytes of its pixels, row by row.
fn pixels(path: &PathBuf) -> (png::ColorType, Vec<u8>) {
    let mut reader = png::Decoder::new(BufReader::new(File::open(path).unwrap())).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    assert_eq!(info.bit_depth, png::BitDepth::Eight);
    bytes.truncate(info.buffer_size());
    (info.color_type, bytes)
}

/// Shares of warp, weft and ground in the middle of a weave of red warp and blue weft, seen
/// straight from above.
fn seen(weave: &str, [ends, picks]: [f64; 2], [warp, weft]: [f64; 2], mm_per_pixel: &str) -> [f64; 3] {
    let folder = tempfile::tempdir().unwrap();
    let [design, picture] = ["cloth.toml", "cloth.png"].map(|name| folder.path().join(name));
    let text = format!(
        "[weave]\nnotation = \"{weave}\"\nends = 40\npicks = 40\n\
         [yarns.warp]\ncotton_count = {warp}\ncolor = \"#ff0000\"\n[yarns.weft]\ncotton_count = {weft}\ncolor = \"#0000ff\"\n\
         [warp]\nyarns = [\"warp\"]\nper_inch = {ends}\n[weft]\nyarns = [\"weft\"]\nper_inch = {picks}\n"
    );
    std::fs::write(&design, text).unwrap();
    let [design, out] = [&design, &picture].map(|path| path.to_str().unwrap());
    let scale = ["--mm-per-pixel", mm_per_pixel, "--supersampling", "1"];
    let output = render(&[&[design, "-o", out], &scale[..]].concat());
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let [width, height] = png_size(&picture).map(|side| side as usize);
    let all = colors(&picture);
    let mut counts = [0_u32; 3];
    for row in height / 4..3 * height / 4 {
        for [red, green, blue] in &all[row * width + width / 4..row * width + 3 * width / 4] {
            // Ground is grey; threads keep their hue in light of any strength.
            let kind = match *green > 4 * (*red.max(blue) / 5) {
                true => 2,
                false => usize::from(blue > red),
            };
            counts[kind] += 1;
        }
    }
    counts.map(|count| f64::from(count) / f64::from(counts.iter().sum::<u32>()))
}

/// Denim hides the ground, sateen all but a hundredth of it, and both most of the weft on their
/// faces. An open cloth hides neither. The test counts pixels.
#[test]
fn denim_and_sateen_hide_the_ground() {
    for (name, [_, weft, ground], most, bare) in [
        ("denim", seen("3/1", [72.0, 56.0], [7.0, 10.0], "0.02"), 0.16, 2e-4),
        ("sateen", seen("satin 5(2)", [173.0, 120.0], [60.0, 60.0], "0.01"), 0.16, 0.01),
    ] {
        println!("{name}: weft {weft:.3}, ground {ground:.5}");
        assert!(ground < bare, "{name}: ground {ground}");
        assert!(weft < most, "{name}: weft {weft}");
    }
    let [_, weft, ground] = seen("plain", [30.0, 30.0], [20.0, 20.0], "0.03");
    assert!(ground > 0.2 && weft > 0.2, "{ground} {weft}");
}
