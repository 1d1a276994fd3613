//! Files that claim more than they hold. Each is read or refused, in time and memory that grow only
//! with the file.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test may panic")]

use std::error::Error;
use std::io::Write;
use std::path::Path;
use std::sync::mpsc;
use std::time::Duration;

use image::RgbImage;
use peak_alloc::PeakAlloc;
use tempfile::TempDir;
use texere_fabric::{Drawdown, Shedding, Woven};
use texere_formats::{Design, ReadError, read};

#[global_allocator]
static HEAP: PeakAlloc = PeakAlloc;

const THREADS: &str = "[yarns.a]\ndiameter_mm = 0.2\n[warp]\nyarns = [\"a\"]\nspacing_mm = 0.6\n\
    [weft]\nyarns = [\"a\"]\nspacing_mm = 0.6\n";

/// The result of `work`. It has to come before a user would think that the program hangs.
fn soon<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> T {
    let (done, wait) = mpsc::channel();
    std::thread::spawn(move || done.send(work()));
    wait.recv_timeout(Duration::from_secs(30)).expect("hangs")
}

/// A folder of its own with the file `name`.
fn file(name: &str, bytes: impl AsRef<[u8]>) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(name), bytes).unwrap();
    folder
}

fn toml(text: &str) -> Result<Design, ReadError> {
    let folder = file("design.toml", text);
    soon(move || read(folder.path().join("design.toml")))
}

fn wif(text: &str) -> Result<Design, ReadError> {
    let folder = file("draft.wif", text);
    soon(move || read(folder.path().join("draft.wif")))
}

fn woven(design: Design) -> Woven {
    design.structure.woven().unwrap().cloth().clone()
}

/// The messages of an error and of its causes. Asserts that each is shorter than 400 characters.
fn message(error: &dyn Error) -> String {
    let mut chain = vec![error.to_string()];
    let mut cause = error.source();
    while let Some(error) = cause {
        chain.push(error.to_string());
        cause = error.source();
    }
    for message in &chain {
        assert!(message.chars().count() < 400, "{} characters: {message:.300}…", message.chars().count());
    }
    chain.join(" because ")
}

/// The most memory that `work` takes at a time, MiB. The memory of the whole program is counted, so
/// only one such measurement may run at a time.
fn peak_mib(work: impl FnOnce()) -> f32 {
    static ALONE: std::sync::Mutex<()> = std::sync::Mutex::new(());
    let _alone = ALONE.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    HEAP.reset_peak_usage();
    let before = HEAP.current_usage_as_mb();
    work();
    HEAP.peak_usage_as_mb() - before
}

#[test]
fn work_grows_with_the_file_and_memory_with_the_picture() {
    // A single test, so that its parts do not take memory at the same time.
    thousands_of_weaves();
    profile_that_inflates();
    short_file_of_many_pixels();
    lists_that_repeat();
    long_names();
    unused_yarns();
}

fn thousands_of_weaves() {
    let colors: String = (0..5_000)
        .map(|number| format!("\"#{number:06x}\" = \"satin 4095({})\"\n", 2 << (number % 3)))
        .collect();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("motif.png");
    RgbImage::from_fn(4, 4, |x, y| image::Rgb([0, 0, (x + 4 * y) as u8])).save(path).unwrap();
    let text = format!("[weave]\nimage = \"motif.png\"\n[weave.colors]\n{colors}{THREADS}");
    let path = folder.path().join("design.toml");
    std::fs::write(&path, text).unwrap();
    let peak = peak_mib(move || {
        let design = soon(move || read(path)).unwrap();
        // The cloth has only four ends and four picks of each large weave, so it falls apart into
        // layers. The second warning says so.
        let [warning, layers] = &design.warnings()[..] else { panic!("{:?}", design.warnings()) };
        assert!(layers.contains("layers (") && layers.chars().count() < 300, "{layers}");
        assert!(warning.contains("4984 colours") && warning.chars().count() < 300, "{warning}");
    });
    assert!(peak < 64.0, "{peak} MiB");
}

/// A PNG of 4 × 4 pixels with a colour profile, or else a compressed text, of 200 MiB of zeros. It
/// takes some 200 kB in the file.
fn profile_that_inflates() {
    let mut zeros = flate2::write::ZlibEncoder::new(b"p\0\0".to_vec(), flate2::Compression::best());
    for _ in 0..200 {
        zeros.write_all(&vec![0; 1 << 20]).unwrap();
    }
    let profile = zeros.finish().unwrap();
    for kind in [png::chunk::iCCP, png::chunk::zTXt] {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 4, 4);
        encoder.set_color(png::ColorType::Grayscale);
        let mut writer = encoder.write_header().unwrap();
        writer.write_chunk(kind, &profile).unwrap();
        writer.write_image_data(&[0, 255, 0, 255].repeat(4)).unwrap();
        drop(writer);
        let folder = file("motif.png", bytes);
        let path = folder.path().join("design.toml");
        std::fs::write(&path, format!("[weave]\nimage = \"motif.png\"\n{THREADS}")).unwrap();
        let peak = peak_mib(move || {
            assert!(woven(soon(move || read(path)).unwrap()).drawdown().up(0, 0));
        });
        assert!(peak < 64.0, "{kind:?}: {peak} MiB");
    }
}

/// A PNG that claims 268 million pixels and has none.
fn short_file_of_many_pixels() {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 4096, 65_535);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header().unwrap().write_chunk(png::chunk::IDAT, &[]).unwrap();
    let folder = file("motif.png", bytes);
    let path = folder.path().join("design.toml");
    std::fs::write(&path, format!("[weave]\nimage = \"motif.png\"\n{THREADS}")).unwrap();
    let peak = peak_mib(move || {
        let error = soon(move || read(path)).unwrap_err();
        assert!(message(&error).contains("bytes are too few for 4096 × 65535 pixels"), "{}", message(&error));
    });
    assert!(peak < 64.0, "{peak} MiB");
}

fn lists_that_repeat() {
    let again = "1,2,".repeat(500_000);
    let text = format!(
        "[WEAVING]\nShafts=2\n[WARP]\nThreads=2\nSpacing=0.1\nUnits=cm\n[WEFT]\nThreads=2\n\
         [THREADING]\n1=1\n2={again}\n[TIEUP]\n1={again}\n[TREADLING]\n1={again}\n2=1\n[LIFTPLAN]\n1={again}\n2=1,2\n"
    );
    let design = wif(&text).unwrap();
    let draft = design.structure.woven().unwrap().draft().unwrap();
    let Shedding::TieUp { tie_up, treadling } = &draft.shedding else { panic!("no tie-up") };
    assert_eq!((&draft.threading[1], &tie_up[0], &treadling[0]), (&vec![1, 2], &vec![1, 2], &vec![1, 2]));
}

fn long_names() {
    // A section of 20,000 keys, whose long name must not be kept once for each key.
    let keys: String = (0..20_000).map(|key| format!("{key}=1\n")).collect();
    let text = format!("[{}]\n{keys}", "x".repeat(1 << 18));
    let peak = peak_mib(move || assert!(wif(&text).is_err()));
    assert!(peak < 64.0, "{peak} MiB");
    // A key of 2 MiB, which must not be compared letter by letter with the known keys.
    let text = format!("{} = 1\n{THREADS}", "x".repeat(1 << 21));
    let peak = peak_mib(move || {
        assert!(message(&toml(&text).unwrap_err()).contains("line 1"));
    });
    assert!(peak < 64.0, "{peak} MiB");
}

fn unused_yarns() {
    let unused: String = (0..100_000)
        .map(|yarn| format!("[yarns.y{yarn}]\ndiameter_mm = 0.3\nsection = {{ shape = \"ellipse\", aspect = 1.{yarn:06} }}\n"))
        .collect();
    let text = format!("{unused}[weave]\nnotation = \"plain\"\nends = 4\npicks = 4\n{THREADS}");
    let cloth = woven(toml(&text).unwrap());
    assert_eq!((cloth.materials().len(), cloth.sections().len()), (1, 1));
    let again = "\"1000000 a\", ".repeat(10_000);
    let text = format!(
        "[weave]\nnotation = \"plain\"\nends = 4\npicks = 4\n{}",
        THREADS.replacen("[\"a\"]", &format!("[{again}]"), 1)
    );
    assert_eq!(woven(toml(&text).unwrap()).warp().len(), 4);
}

#[test]
fn a_picture_that_repeats_is_worked_out_once() {
    let folder = tempfile::tempdir().unwrap();
    let draw = |x: u32, y: u32| image::Rgb([if (x + y).is_multiple_of(3) { 0 } else { 255 }; 3]);
    RgbImage::from_fn(3, 5, draw).save(folder.path().join("motif.png")).unwrap();
    let path = folder.path().join("design.toml");
    let table = "[weave.colors]\n\"#000000\" = \"3/1\"\n\"#ffffff\" = \"sateen 5\"\n";
    for (colors, shown) in [("", false), (table, true)] {
        std::fs::write(&path, format!("[weave]\nimage = \"motif.png\"\nrepeat = [7, 4]\n{colors}{THREADS}"))
            .unwrap();
        let cloth = woven(read(&path).unwrap());
        let [twill, sateen] = ["3/1", "sateen 5"]
            .map(|weave| texere_fabric::Weave::parse(weave).unwrap().drawdown(21, 20).unwrap());
        let expected = Drawdown::from_fn(21, 20, |end, pick| {
            let black = draw(end as u32 % 3, 4 - pick as u32 % 5).0 == [0; 3];
            if !shown {
                black
            } else if black {
                twill.up(end, pick)
            } else {
                sateen.up(end, pick)
            }
        });
        assert_eq!(*cloth.drawdown(), expected.unwrap());
    }
}

/// Values of a megabyte or more, and long lists, in places that errors quote.
#[test]
fn an_error_is_never_longer_than_a_line_or_two() {
    let long = "ä\\u001b\\n".repeat(200_000);
    let plain = "x".repeat(1 << 20);
    let design = |weave: &str, rest: &str| format!("[weave]\n{weave}\n{rest}{THREADS}");
    let small = "notation = \"plain\"\nends = 4\npicks = 4";
    for text in [
        design(&format!("notation = \"{long}\"\nends = 4\npicks = 4"), ""),
        design(&format!("image = \"{plain}\""), ""),
        design(&format!("wif = \"{long}\""), ""),
        design(&format!("ends = \"{long}\""), ""),
        design(&format!("{small}\n\"{long}\" = 1"), ""),
        design(small, &format!("[yarns.\"{long}\"]\ntex = -1.0\n")),
        design(small, &format!("[yarns.\"{long}\"]\n")),
        design(small, &format!("[yarns.b]\ntex = 1.0\ncolor = \"{long}\"\n")),
        design(small, &format!("[yarns.b]\ntex = 1.0\nsection = {{ shape = \"{long}\" }}\n")),
        design(small, &format!("[cloth]\nshape = \"{long}\"\n")),
        design(small, &format!("[cloth]\njam = [{}]\n", "1, ".repeat(10_000))),
        design(small, "").replacen("[\"a\"]", &format!("[\"{long}\"]"), 1),
        design(small, &(0..5_000).map(|yarn| format!("[yarns.y{yarn}]\ntex = 9\n")).collect::<String>())
            .replacen("[\"a\"]", "[\"none\"]", 1),
        design(small, "").replacen("0.6", &format!("[{}]", "\"a\", ".repeat(10_000)), 1),
        format!("a = {}1", "[".repeat(100_000)),
        format!("{}\n", "a.".repeat(100_000)),
        plain.clone(),
    ] {
        let error = toml(&text).expect_err(&text[..200]);
        let message = message(&error);
        assert!(!message.contains(['\u{1b}', '\n']), "{message:?}");
    }
    let draft = |line: &str| {
        format!(
            "[WARP]\nThreads=2\nColor=1\n[WEFT]\nThreads=2\n[THREADING]\n1=1\n2=2\n[LIFTPLAN]\n1=1\n2=2\n[COLOR TABLE]\n1=0,0,0\n{line}\n"
        )
    };
    for line in [
        format!("[WEAVING]\nShafts={plain}"),
        format!("[WEAVING]\nRising Shed=\u{1b}{plain}"),
        format!("[LIFTPLAN]\n2=1,{plain}"),
        format!("[COLOR TABLE]\n{plain}=1,2,3"),
        format!("[WARP]\nUnits={plain}\nSpacing={plain}"),
        format!("[WARP COLORS]\n1={plain}"),
    ] {
        let message = message(&wif(&draft(&line)).expect_err(&line[..30]));
        assert!(!message.contains(['\u{1b}', '\n']), "{message:?}");
    }
}

#[cfg(unix)]
mod unix {
    use std::os::unix::fs::symlink;
    use std::process::Command;

    use super::*;

    /// Pipes without a writer, and links to them, under names that a design may have or refer to.
    fn pipes() -> TempDir {
        let folder = tempfile::tempdir().unwrap();
        for name in ["pipe.toml", "pipe.wif", "pipe.png"] {
            assert!(Command::new("mkfifo").arg(folder.path().join(name)).status().unwrap().success());
            symlink(name, folder.path().join(format!("link-{name}"))).unwrap();
        }
        folder
    }

    fn refused(folder: &Path, name: &str, kind: &str) {
        let path = folder.join(name);
        let message = message(&soon(move || read(path)).unwrap_err());
        assert!(message.contains(kind), "{name}: {message}");
    }

    #[test]
    fn what_is_no_regular_file_is_refused_at_once() {
        let folder = pipes();
        let folder = folder.path();
        for name in ["pipe.toml", "pipe.wif", "link-pipe.toml", "link-pipe.wif"] {
            refused(folder, name, "is a pipe");
        }
        std::fs::create_dir(folder.join("folder.toml")).unwrap();
        refused(folder, "folder.toml", "is a folder");
        symlink("/dev/zero", folder.join("zero.wif")).unwrap();
        refused(folder, "zero.wif", "is a device");
        for (key, name, kind) in [
            ("image", "pipe.png", "is a pipe"),
            ("image", "link-pipe.png", "is a pipe"),
            ("wif", "pipe.wif", "is a pipe"),
            ("image", "folder.toml", "is a folder"),
            ("wif", "zero.wif", "is a device"),
        ] {
            std::fs::write(folder.join("design.toml"), format!("[weave]\n{key} = \"{name}\"\n{THREADS}"))
                .unwrap();
            refused(folder, "design.toml", kind);
        }
    }

    /// The work of a child process with little memory. Run by itself it does nothing.
    #[test]
    fn child_that_is_short_of_memory() {
        let Ok(path) = std::env::var("TEXERE_SHORT_OF_MEMORY") else { return };
        match read(path) {
            Err(ReadError::OutOfMemory(_)) => {}
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn refused_memory_has_a_name() {
        let folder = tempfile::tempdir().unwrap();
        let picture = image::GrayImage::from_fn(16_000, 16_000, |x, _| image::Luma([(x % 2) as u8 * 255]));
        picture.save(folder.path().join("motif.png")).unwrap();
        picture.save(folder.path().join("motif.tif")).unwrap();
        let mut designs = vec![(
            "notation.toml".to_owned(),
            "[weave]\nnotation = \"plain\"\nends = 65536\npicks = 65536\n".to_owned(),
            300_000,
        )];
        // The limits leave too little memory for the pixels, or enough for the pixels but not for
        // the cloth.
        for (image, kilobytes) in [("motif.png", 200_000), ("motif.png", 450_000), ("motif.tif", 500_000)] {
            designs.push((
                format!("{image}-{kilobytes}.toml"),
                format!("[weave]\nimage = \"{image}\"\n"),
                kilobytes,
            ));
        }
        for (name, weave, kilobytes) in designs {
            let path = folder.path().join(name);
            std::fs::write(&path, weave + THREADS).unwrap();
            let program = std::env::current_exe().unwrap();
            let limited = format!(
                "ulimit -v {kilobytes}; exec \"$0\" --exact unix::child_that_is_short_of_memory --nocapture"
            );
            let child = Command::new("sh")
                .args(["-c", &limited])
                .arg(program)
                .env("TEXERE_SHORT_OF_MEMORY", &path)
                .output()
                .unwrap();
            assert!(child.status.success(), "{path:?}: {child:?}");
        }
    }
}
