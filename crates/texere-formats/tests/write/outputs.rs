//! Files that no output may replace, and leftovers that are removed before writing.

use std::fs::{self, File};
use std::path::{Path, PathBuf};

use tempfile::TempDir;
use texere_formats::write::{self, Output};
use texere_formats::{Design, WriteError, read};

/// A design of an image, and one of a WIF draft.
fn designs(folder: &Path) -> [Design; 2] {
    let threads = "[yarns.a]\ndiameter_mm = 0.3\n[warp]\nyarns = [\"a\"]\nper_cm = 8.0\n\
                   [weft]\nyarns = [\"a\"]\nper_cm = 8.0\n";
    write::picture([2, 1], &[0, 0, 0, 255, 255, 255], folder.join("motif.png")).unwrap();
    let wif = "[WARP]\nThreads=2\n[WEFT]\nThreads=1\n[THREADING]\n1=1\n2=2\n[LIFTPLAN]\n1=1\n";
    fs::write(folder.join("draft.wif"), wif).unwrap();
    [("image", "motif.png"), ("wif", "draft.wif")].map(|(key, name)| {
        let path = folder.join(key).with_extension("toml");
        fs::write(&path, format!("[weave]\n{key} = \"{name}\"\n{threads}")).unwrap();
        read(&path).unwrap()
    })
}

fn names(folder: &TempDir) -> Vec<String> {
    let entries = fs::read_dir(folder.path()).unwrap();
    let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort_unstable();
    names
}

fn spared(path: impl AsRef<Path>, design: &Design) -> bool {
    let before = fs::read(path.as_ref()).unwrap();
    let answer = write::file(b"lost", Output::to(path.as_ref()).sparing(design.files()));
    assert_eq!(fs::read(path).unwrap(), before, "{answer:?}");
    matches!(answer, Err(WriteError::Spared { .. }))
}

#[test]
fn a_design_knows_the_files_that_it_was_read_from() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let [image, wif] = designs(folder.path());
    let sorted = |design: &Design| {
        let mut files = design.files().to_vec();
        files.sort_unstable();
        files
    };
    assert_eq!(sorted(&image), [at("image.toml"), at("motif.png")]);
    assert_eq!(sorted(&wif), [at("draft.wif"), at("wif.toml")]);
    assert_eq!(read(at("draft.wif")).unwrap().files(), [at("draft.wif")]);
}

#[test]
fn no_input_is_replaced_under_any_name() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let [image, wif] = designs(folder.path());
    for (design, names) in [(&image, ["image.toml", "motif.png"]), (&wif, ["wif.toml", "draft.wif"])] {
        for name in names {
            assert!(spared(at(name), design), "{name}");
            assert!(spared(
                at(&format!("../{}/./{name}", folder.path().file_name().unwrap().display())),
                design
            ));
            fs::hard_link(at(name), at("hard.ply")).unwrap();
            assert!(spared(at("hard.ply"), design), "{name} by a hard link");
            fs::remove_file(at("hard.ply")).unwrap();
            #[cfg(unix)]
            {
                std::os::unix::fs::symlink(at(name), at("soft.ply")).unwrap();
                assert!(spared(at("soft.ply"), design), "{name} by a symbolic link");
                fs::remove_file(at("soft.ply")).unwrap();
            }
        }
    }
    // Files of another design may be replaced.
    write::file(b"new", Output::to(at("draft.wif")).sparing(image.files())).unwrap();
    assert_eq!(fs::read(at("draft.wif")).unwrap(), b"new");
}

#[test]
fn an_input_that_comes_to_lie_at_the_output_is_not_replaced() {
    use std::ops::ControlFlow;
    let folder = tempfile::tempdir().unwrap();
    let [image, _] = designs(folder.path());
    let (path, motif) = (folder.path().join("cloth.ply"), folder.path().join("motif.png"));
    let yarns = image.yarns().unwrap();
    let pipeline = texere_core::Pipeline::new(&yarns).progress(|_| {
        let _ = fs::hard_link(&motif, &path);
        ControlFlow::Continue(())
    });
    let device = texere_cpu::SerialBackend::new();
    let error = write::stream(pipeline, &device, Output::to(&path).sparing(image.files())).unwrap_err();
    assert!(matches!(error, WriteError::Spared { .. }), "{error}");
    assert!(fs::read(&motif).unwrap().starts_with(b"\x89PNG"));
    assert_eq!(names(&folder), ["cloth.ply", "draft.wif", "image.toml", "motif.png", "wif.toml"]);
}

#[test]
fn what_a_dead_writer_left_is_removed_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let others = [
        ".texere-config",
        ".texere-0123456789abcdef",
        ".texere-0123456789-abcde.unfinished",
        ".texere-0123456789abcdefg.unfinished",
        "texere-0123456789abcdef.unfinished",
    ];
    for name in others.iter().chain(&[
        ".texere-dEad010123456789.unfinished",
        ".texere-aLive10123456789.unfinished",
        ".texere-motif10123456789.unfinished",
    ]) {
        fs::write(at(name), name).unwrap();
    }
    fs::create_dir(at(".texere-folder0123456789.unfinished")).unwrap();
    let alive = File::open(at(".texere-aLive10123456789.unfinished")).unwrap();
    alive.try_lock().unwrap();
    let output = || Output::to(at("out")).sparing([at(".texere-motif10123456789.unfinished")]);
    write::file(b"new", output()).unwrap();
    let mut expected: Vec<_> = others.iter().map(ToString::to_string).collect();
    expected.extend(
        [
            ".texere-aLive10123456789.unfinished",
            ".texere-folder0123456789.unfinished",
            ".texere-motif10123456789.unfinished",
            "out",
        ]
        .map(String::from),
    );
    expected.sort_unstable();
    assert_eq!(names(&folder), expected);
    // The writer of the unfinished file ends.
    drop(alive);
    write::file(b"new", output()).unwrap();
    assert!(!at(".texere-aLive10123456789.unfinished").exists());
}

/// Each writer removes leftovers while others start and finish.
#[test]
fn writers_in_one_folder_do_not_sweep_one_another() {
    let folder = tempfile::tempdir().unwrap();
    let path = |writer: usize| folder.path().join(format!("out-{writer}"));
    std::thread::scope(|scope| {
        for writer in 0..8 {
            scope.spawn(move || {
                for round in 0..50 {
                    write::file(format!("{writer} {round}").as_bytes(), path(writer)).unwrap();
                }
            });
        }
    });
    let all: Vec<PathBuf> = (0..8).map(path).collect();
    assert!(all.iter().all(|path| fs::read(path).unwrap().ends_with(b" 49")));
    assert_eq!(names(&folder).len(), 8);
}

#[test]
fn what_can_be_a_path_can_be_an_output() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out");
    let text = path.to_str().unwrap();
    write::file(b"1", text).unwrap();
    write::file(b"2", text.to_owned()).unwrap();
    write::file(b"3", path.as_path()).unwrap();
    write::file(b"4", &path).unwrap();
    write::file(b"5", path.as_os_str()).unwrap();
    write::file(b"6", path.clone()).unwrap();
    assert_eq!(fs::read(&path).unwrap(), b"6");
}

#[cfg(unix)]
#[test]
fn links_that_lead_nowhere_are_refused_and_stay() {
    use std::os::unix::fs::symlink;
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    symlink("nowhere.ply", at("dangling.ply")).unwrap();
    symlink("loop.ply", at("loop.ply")).unwrap();
    for name in ["dangling.ply", "loop.ply"] {
        let error = write::file(b"new", at(name)).unwrap_err();
        let source = std::error::Error::source(&error).unwrap().to_string();
        assert!(source.contains("a symbolic link that leads nowhere"), "{source}");
        assert!(fs::symlink_metadata(at(name)).unwrap().is_symlink(), "{name}");
    }
    assert_eq!(names(&folder), ["dangling.ply", "loop.ply"]);
}

/// The check comes before any work. The system refuses such a name only when it is used.
#[test]
fn a_name_that_is_too_long_is_refused_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let error = write::file(b"new", folder.path().join("x".repeat(300))).unwrap_err();
    assert!(matches!(error, WriteError::Io { action: "create", .. }), "{error:?}");
    assert!(names(&folder).is_empty());
}
