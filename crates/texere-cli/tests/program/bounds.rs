//! Small designs that ask for far more than any cloth has are refused by name, and in little
//! memory.
#![cfg(target_os = "linux")]

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use crate::{stderr, texere};

/// A cloth of four wales with underlaps over 511 needles. In each course 128 yarns lie behind each
/// needle.
pub(crate) const UNDERLAPS: &str = "[warp_knit]\nwales = 4\ncourses = 4\nwales_per_cm = 10\ncourses_per_cm = 13\n\
                                    [[warp_knit.bars]]\nlapping = \"0-1/511-512//\"\n[yarns.a]\ndiameter_mm = 0.1\n";

/// The output of `command` for a design, with this many kB of memory.
fn within(kilobytes: u32, command: &str, design: &str) -> Output {
    within_in(tempfile::tempdir().unwrap().path(), kilobytes, command, design)
}

/// The output of `command` for a design in `folder`, which has the files that the design names,
/// with this many kB of memory.
fn within_in(folder: &Path, kilobytes: u32, command: &str, design: &str) -> Output {
    let path = folder.join("design.toml");
    fs::write(&path, design).unwrap();
    // One thread, because each has a stack of its own.
    Command::new("sh")
        .args(["-c", &format!("ulimit -v {kilobytes}; exec \"$0\" {command} \"$1\"")])
        .args([env!("CARGO_BIN_EXE_texere"), path.to_str().unwrap()])
        .env("RAYON_NUM_THREADS", "1")
        // One arena of the C library, because each reserves up to 128 MiB, and a thread takes a new
        // one while another allocates.
        .env("MALLOC_ARENA_MAX", "1")
        .output()
        .unwrap()
}

/// A design of a cable in which `half` loops cross over `half` other loops.
fn cable(half: usize) -> String {
    let (plain, right, left) = ("k".repeat(2 * half), "R".repeat(half), "r".repeat(half));
    format!(
        "[knit]\nchart = \"\"\"\n{plain}\n{right}{left}\n\"\"\"\nwales_per_cm = 8\ncourses_per_cm = 10\n[yarns.a]\n\
         diameter_mm = 0.1\n"
    )
}

#[test]
fn what_is_out_of_proportion_is_refused_in_little_memory() {
    let long =
        "[knit]\nchart = \"k\"\nrepeat = [20, 20]\nloop_length_mm = 1000\n[yarns.a]\ndiameter_mm = 0.1\n";
    let many =
        "[knit]\nchart = \"k\"\nrepeat = [499, 499]\nloop_length_mm = 3\n[yarns.a]\ndiameter_mm = 0.1\n";
    let bars = "[[warp_knit.bars]]\nlapping = \"tricot\"\n".repeat(2);
    let laps = format!(
        "[warp_knit]\nwales = 16384\ncourses = 32768\nwales_per_cm = 10\ncourses_per_cm = 13\n{bars}[yarns.a]\n\
         diameter_mm = 0.1\n"
    );
    let across = "[warp_knit]\nwales = 2000\ncourses = 2000\nwales_per_cm = 10\ncourses_per_cm = 13\n\
                  [[warp_knit.bars]]\nlapping = \"0-1/511-512//\"\nthreading = [\"2000 a\"]\n[yarns.a]\ndiameter_mm = 0.1\n";
    for (design, said) in [
        (cable(200), "too long for their thickness"),
        (cable(300), "moves by 300 needles; 256 are taken at most"),
        (UNDERLAPS.into(), "too many yarns lie in one place"),
        (long.into(), "too long for their thickness"),
        (many.into(), "65536 are taken at most: take multiples of 4"),
        (laps, "make 1073741824 laps; 67108864 are taken at most"),
        (across.into(), "yarns pass"),
    ] {
        let output = within(1_000_000, "inspect", &design);
        let error = stderr(&output);
        assert_eq!(output.status.code(), Some(3), "{said}: {error}");
        assert!(error.contains(said) && error.contains("design.toml, line "), "{said}: {error}");
    }
}

/// Designs with a picture of `side` pixels a side, white with one black pixel: a weft-knitted
/// Jacquard, a chart of one yarn, and a warp-knitted Jacquard.
fn pictured(side: usize) -> [String; 3] {
    let sett = "wales_per_cm = 9\ncourses_per_cm = 13\n";
    let yarns = "[yarns.a]\ndiameter_mm = 0.1\n[yarns.b]\ndiameter_mm = 0.1\n";
    let knit = |black: &str, white: &str, more: &str| {
        format!(
            "[knit]\nimage = \"motif.png\"\n{more}{sett}[knit.colors]\n\"#000000\" = \"{black}\"\n\"#ffffff\" = \"{white}\"\n{yarns}"
        )
    };
    let warp = format!(
        "[warp_knit]\nwales = {side}\ncourses = {}\n{sett}[[warp_knit.bars]]\nlapping = \"1-0/1-2//\"\nthreading = [\"a\"]\n\
         image = \"motif.png\"\n[warp_knit.bars.colors]\n\"#000000\" = \"0-0/0-0\"\n\"#ffffff\" = \"0-0/1-1\"\n{yarns}",
        2 * side
    );
    [knit("a", "b", ""), knit("p", "k", "yarns = [\"a\"]\n"), warp]
}

/// A folder with a picture of `side` pixels a side, white with one black pixel.
fn picture(side: usize) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let mut pixels = vec![255; 3 * side * side];
    pixels[..3].fill(0);
    let output = texere::write::Output::to(folder.path().join("motif.png"));
    texere::write::picture([side as u32; 2], &pixels, output).unwrap();
    folder
}

#[test]
fn a_repeat_that_no_gigabyte_holds_is_refused_before_it_is_laid() {
    for side in [1448, 2048, 4096] {
        let folder = picture(side);
        for design in pictured(side) {
            let output = within_in(folder.path(), 1_000_000, "inspect --counts", &design);
            let error = stderr(&output);
            assert_eq!(output.status.code(), Some(3), "{error}");
            let named = error.contains("a repeat of ") || error.contains("a chart of ");
            assert!(error.contains("design.toml, line ") && named, "{error}");
        }
    }
    // Without any picture: a threading that repeats after 4,096 guides, and a chain as long.
    let chain = "1-0/1-2/".repeat(2048);
    let long = format!(
        "[warp_knit]\nwales = 4096\ncourses = 4096\nwales_per_cm = 9\ncourses_per_cm = 13\n[[warp_knit.bars]]\nlapping = \"{chain}/\"\n\
         threading = [\"4095 a\", \"b\"]\n[yarns.a]\ndiameter_mm = 0.1\n[yarns.b]\ndiameter_mm = 0.1\n"
    );
    let output = within(1_000_000, "inspect --counts", &long);
    let error = stderr(&output);
    assert!(output.status.code() == Some(3) && error.contains("a repeat of "), "{error}");
}

/// A Jacquard of two yarns on 1,024 needles and rows. One of the yarns knits a single stitch. The
/// Jacquard takes less than a gigabyte beside the memory that threads reserve.
#[test]
fn a_repeat_that_a_gigabyte_holds_is_laid() {
    let folder = picture(1024);
    let [jacquard, ..] = pictured(1024);
    let output = within_in(folder.path(), 1_150_000, "inspect --counts", &jacquard);
    assert!(output.status.success(), "{}", stderr(&output));
}

#[test]
fn pictures_of_400_wales_and_courses_are_knitted() {
    let folder = picture(400);
    for design in pictured(400) {
        let output = within_in(folder.path(), 1_000_000, "inspect --counts", &design);
        assert!(output.status.success(), "{}", stderr(&output));
    }
}

/// A chart of one wale and 65,536 rows with several sizes of memory: it is read, or the program
/// reports that memory ran out.
#[test]
fn memory_that_is_refused_is_a_failure_of_the_machine() {
    let rows = "k\np\n".repeat(32_768);
    let tall = format!(
        "[knit]\nchart = \"\"\"\n{rows}\"\"\"\nwales_per_cm = 8\ncourses_per_cm = 10\n[yarns.a]\ndiameter_mm = 0.1\n"
    );
    let mut refused = 0;
    for kilobytes in (60_000..300_000).step_by(12_000) {
        let output = within(kilobytes, "inspect --counts", &tall);
        let error = stderr(&output);
        match output.status.code() {
            Some(0) => {}
            Some(1) => {
                refused += 1;
                assert!(error.contains("memory"), "{kilobytes}: {error}");
            }
            code => panic!("{kilobytes}: {code:?}, {error}"),
        }
    }
    assert!(refused > 0);
}

#[test]
fn help_that_can_t_be_written_is_a_failure() {
    for args in ["help", "--version", "mesh --help"] {
        let run = format!("exec \"$0\" {args} > /dev/full");
        let output = Command::new("sh").args(["-c", &run, env!("CARGO_BIN_EXE_texere")]).output().unwrap();
        assert_eq!(output.status.code(), Some(1), "{args}: {}", stderr(&output));
        assert!(texere(&args.split(' ').collect::<Vec<_>>()).status.success());
    }
}

/// A file that is no knitting program may hold a secret, so its text is not printed.
#[test]
fn a_file_that_is_no_program_is_not_quoted() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("notes.txt"), "hunter2 is mine\n").unwrap();
    let path = folder.path().join("design.toml");
    let knit = "[knit]\nknitout = \"notes.txt\"\nwales_per_cm = 8\ncourses_per_cm = 10\n[yarns.a]\ndiameter_mm = 0.1\n";
    fs::write(&path, knit).unwrap();
    let output = texere(&["inspect", path.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(3));
    let error = stderr(&output);
    assert!(error.contains("line 2: knit.knitout") && error.contains(".k or .knitout"), "{error}");
    assert!(!error.contains("hunter2"), "{error}");
}
