//! Files that the program writes, and files that it never replaces.

use std::fs;
use std::path::Path;

use tempfile::TempDir;

use crate::{design, stderr, texere};

const THREADS: &str = "[yarns.a]\ndiameter_mm = 0.3\n[warp]\nyarns = [\"a\"]\nper_cm = 8.0\n\
                       [weft]\nyarns = [\"a\"]\nper_cm = 8.0\n";

/// A folder with a design by an image, `motif.png`.
fn by_image() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    texere::write::picture([2, 2], &[0, 0, 0, 255, 255, 255, 255, 255, 255, 0, 0, 0], at("motif.png"))
        .unwrap();
    fs::write(at("cloth.toml"), format!("[weave]\nimage = \"motif.png\"\nrepeat = [6, 6]\n{THREADS}"))
        .unwrap();
    folder
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort_unstable();
    names
}

#[test]
fn no_command_replaces_what_the_design_was_read_from() {
    let folder = by_image();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    fs::hard_link(at("motif.png"), at("link.ply")).unwrap();
    let contents =
        || names(folder.path()).into_iter().map(|name| fs::read(at(&name)).unwrap()).collect::<Vec<_>>();
    let (before, cloth) = (contents(), at("cloth.toml"));
    for args in [
        vec!["draft", &cloth, "-o", &at("motif.png")],
        vec!["draft", &cloth, "--text", "-o", &at("motif.png")],
        vec!["mesh", &cloth, "-o", &at("link.ply"), "--device", "cpu"],
        vec!["render", &cloth, "-o", &at("motif.png"), "--size", "8x8"],
    ] {
        let output = texere(&args);
        assert_eq!(output.status.code(), Some(2), "{args:?}: {}", stderr(&output));
        assert!(stderr(&output).contains("which must stay"), "{args:?}: {}", stderr(&output));
        assert!(contents() == before, "{args:?}");
    }
}

#[test]
fn endings_are_looked_at_before_any_work() {
    let folder = tempfile::tempdir().unwrap();
    for (args, said) in [
        (["mesh", "no-such.toml", "-o", "cloth.fbx"], "glb, ply"),
        (["draft", "no-such.toml", "-o", "cloth.jpg"], "cloth.jpg does not end in .png"),
        (["render", "no-such.toml", "-o", "cloth.glb"], "cloth.glb does not end in .png"),
    ] {
        let output = texere(&args);
        assert_eq!(output.status.code(), Some(2), "{args:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(said), "{args:?}: {}", stderr(&output));
    }
    assert!(names(folder.path()).is_empty());
}

/// A missing folder is reported before yarns settle; these yarns can't settle.
#[test]
fn folders_are_looked_at_before_any_work() {
    let folder = tempfile::tempdir().unwrap();
    let cloth = folder.path().join("crowded.toml");
    fs::write(&cloth, crate::bounds::UNDERLAPS).unwrap();
    let nowhere = folder.path().join("no-such/cloth.glb");
    let output = texere(&["mesh", cloth.to_str().unwrap(), "-o", nowhere.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    assert!(stderr(&output).contains("can't create"), "{}", stderr(&output));
}

#[cfg(unix)]
mod unix {
    use std::os::unix::fs::{PermissionsExt, symlink};
    use std::os::unix::process::{CommandExt, ExitStatusExt};
    use std::process::{Child, Command, Stdio};
    use std::time::{Duration, Instant};

    use super::*;

    /// Waits until there is an unfinished file, which shows that the program is at work.
    fn at_work(folder: &Path, program: &mut Child) {
        let start = Instant::now();
        while !names(folder).iter().any(|name| name.starts_with(".texere-")) {
            assert!(program.try_wait().unwrap().is_none(), "it ended too soon");
            assert!(start.elapsed() < Duration::from_secs(60), "it never began");
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    /// The program while it writes a cloth to `name` in `folder`, which takes seconds for a mesh.
    fn writing(folder: &Path, name: &str, shell: &str) -> Child {
        writing_on("cpu-serial", folder, name, shell)
    }

    fn writing_on(device: &str, folder: &Path, name: &str, shell: &str) -> Child {
        // The tests may run with ignored signals, as jobs in a shell's background do.
        let heard =
            cfg!(target_os = "linux").then_some(["--default-signal=INT,TERM,HUP,QUIT,USR1,XCPU,XFSZ"]);
        let program = Command::new("env")
            .args(heard.into_iter().flatten())
            .args(["sh", "-c", &format!("{shell} exec \"$@\""), "sh", env!("CARGO_BIN_EXE_texere")])
            .args(["mesh", &design("paper/1630x1500.toml"), "--device", device, "-o"])
            .arg(folder.join(name))
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .process_group(0)
            .spawn();
        program.unwrap()
    }

    fn send(signal: &str, program: &Child) {
        let sent = Command::new("kill").args([&format!("-{signal}"), &program.id().to_string()]).status();
        assert!(sent.unwrap().success());
    }

    #[test]
    fn a_signal_leaves_nothing_and_is_what_the_program_dies_of() {
        let signals = [("INT", 2), ("TERM", 15), ("HUP", 1), ("USR1", 10), ("XFSZ", 25)];
        // LLVM, with which drivers of software devices compile kernels, sets handlers of its own.
        // With these handlers, the first signal of each of the following kinds does not end a
        // program.
        let passed_over = [("QUIT", 3), ("USR1", 10), ("XCPU", 24)];
        let cases = signals.map(|signal| ("cpu-serial", signal));
        for (device, (signal, number)) in cases.into_iter().chain(passed_over.map(|signal| ("auto", signal)))
        {
            let folder = tempfile::tempdir().unwrap();
            fs::write(folder.path().join("cloth.ply"), "old").unwrap();
            let mut program = writing_on(device, folder.path(), "cloth.ply", "");
            at_work(folder.path(), &mut program);
            send(signal, &program);
            let output = program.wait_with_output().unwrap();
            assert_eq!(output.status.signal(), Some(number), "{device}, {signal}: {:?}", output.status);
            assert_eq!(stderr(&output), "");
            assert_eq!(names(folder.path()), ["cloth.ply"], "{signal}");
            assert_eq!(fs::read(folder.path().join("cloth.ply")).unwrap(), b"old");
        }
    }

    /// The endings of all files that `mesh` writes.
    #[cfg(target_os = "linux")]
    const ENDINGS: [&str; 7] = ["glb", "ply", "stl", "obj", "yarns", "bcc", "usda"];

    /// Writes two old files of a cloth: one that ends in `extension`, and a library of materials.
    /// Returns the names of all files in the folder.
    fn old_files(folder: &Path, extension: &str) -> Vec<String> {
        for name in [&format!("cloth.{extension}"), "cloth.mtl"] {
            fs::write(folder.join(name), "old").unwrap();
        }
        names(folder)
    }

    fn assert_old(folder: &Path, before: &[String]) {
        assert_eq!(names(folder), before);
        for name in before {
            assert_eq!(fs::read(folder.join(name)).unwrap(), b"old", "{name}");
        }
    }

    #[test]
    fn a_signal_leaves_the_old_file_of_every_format() {
        for extension in ["glb", "stl", "obj"] {
            let folder = tempfile::tempdir().unwrap();
            let before = old_files(folder.path(), extension);
            let mut program = writing(folder.path(), &format!("cloth.{extension}"), "");
            at_work(folder.path(), &mut program);
            send("TERM", &program);
            assert_eq!(program.wait().unwrap().signal(), Some(15), "{extension}");
            assert_old(folder.path(), &before);
        }
    }

    /// A limit on the size of a file has the same effect as a disk that becomes full.
    #[cfg(target_os = "linux")]
    #[test]
    fn a_full_disk_leaves_the_old_file_of_every_format() {
        for extension in ENDINGS {
            let folder = tempfile::tempdir().unwrap();
            let before = old_files(folder.path(), extension);
            let name = format!("cloth.{extension}");
            let program = writing(folder.path(), &name, "ulimit -f 1000; trap '' XFSZ;");
            let output = program.wait_with_output().unwrap();
            assert_eq!(output.status.code(), Some(1), "{extension}: {}", stderr(&output));
            let said = stderr(&output);
            assert!(said.contains(&name) && said.contains("File too large"), "{extension}: {said}");
            assert_old(folder.path(), &before);
        }
    }

    #[cfg(target_os = "linux")]
    fn is_root() -> bool {
        Command::new("id").arg("-u").output().unwrap().stdout == b"0\n"
    }

    /// Makes a user who is not root write the cloth of `plain.toml` to `name` in `folder`. Asserts
    /// that the user lacks the permission.
    #[cfg(target_os = "linux")]
    fn refused_to_nobody(program: &Path, folder: &Path, name: &str) {
        let output = Command::new(program)
            .args(["mesh", "plain.toml", "-o", name, "--device", "cpu"])
            .current_dir(folder)
            .uid(65534)
            .gid(65534)
            .output()
            .unwrap();
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(1), "{name}: {said}");
        assert!(said.contains("Permission denied"), "{name}: {said}");
    }

    /// Nobody but root may write into the folder.
    #[cfg(target_os = "linux")]
    #[test]
    fn a_read_only_folder_keeps_the_old_file_of_every_format() {
        if !is_root() {
            // A folder of another user can't be made.
            return;
        }
        let (folder, program) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        fs::copy(env!("CARGO_BIN_EXE_texere"), program.path().join("texere")).unwrap();
        fs::copy(design("plain.toml"), folder.path().join("plain.toml")).unwrap();
        for path in [program.path(), folder.path()] {
            fs::set_permissions(path, fs::Permissions::from_mode(0o755)).unwrap();
        }
        for extension in ENDINGS {
            let name = format!("cloth.{extension}");
            fs::write(folder.path().join(&name), "old").unwrap();
            fs::set_permissions(folder.path().join(&name), fs::Permissions::from_mode(0o666)).unwrap();
            let before = names(folder.path());
            refused_to_nobody(&program.path().join("texere"), folder.path(), &name);
            assert_eq!(names(folder.path()), before);
            assert_eq!(fs::read(folder.path().join(&name)).unwrap(), b"old");
        }
    }

    /// The program is started as `nohup` starts it, with a signal ignored.
    #[cfg(target_os = "linux")]
    #[test]
    fn a_signal_that_was_ignored_stays_ignored() {
        let folder = tempfile::tempdir().unwrap();
        let mut program = writing(folder.path(), "cloth.ply", "trap '' HUP;");
        at_work(folder.path(), &mut program);
        send("HUP", &program);
        std::thread::sleep(Duration::from_millis(300));
        assert!(program.try_wait().unwrap().is_none());
        send("TERM", &program);
        assert_eq!(program.wait().unwrap().signal(), Some(15));
        assert!(names(folder.path()).is_empty());
    }

    #[test]
    fn what_a_kill_leaves_the_next_write_removes_and_no_more() {
        let folder = tempfile::tempdir().unwrap();
        let mut killed = writing(folder.path(), "cloth.ply", "");
        at_work(folder.path(), &mut killed);
        send("KILL", &killed);
        assert_eq!(killed.wait().unwrap().signal(), Some(9));
        assert_eq!(names(folder.path()).len(), 1);
        // Another program is at work: its file must stay, and the file of the killed program must
        // go.
        let left = names(folder.path());
        let mut working = writing(folder.path(), "cloth.ply", "");
        let start = Instant::now();
        while names(folder.path()) == left {
            assert!(start.elapsed() < Duration::from_secs(60) && working.try_wait().unwrap().is_none());
        }
        let plain = folder.path().join("plain.ply");
        let output =
            texere(&["mesh", &design("plain.toml"), "-o", plain.to_str().unwrap(), "--device", "cpu"]);
        assert!(output.status.success(), "{}", stderr(&output));
        let after = names(folder.path());
        assert!(after.len() == 2 && after[0].starts_with(".texere-") && after[0] != left[0], "{after:?}");
        send("TERM", &working);
        working.wait().unwrap();
        assert_eq!(names(folder.path()), ["plain.ply"]);
    }

    /// A user who is not root may not replace a file of root's.
    #[cfg(target_os = "linux")]
    #[test]
    fn a_file_that_its_user_may_not_write_is_not_replaced() {
        if !is_root() {
            // A file of another user can't be made.
            return;
        }
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        fs::copy(env!("CARGO_BIN_EXE_texere"), at("texere")).unwrap();
        fs::copy(design("plain.toml"), at("plain.toml")).unwrap();
        fs::write(at("cloth.ply"), "root's").unwrap();
        // Any user may write to the folder.
        for (name, mode) in [("cloth.ply", 0o644), (".", 0o777), ("texere", 0o755)] {
            fs::set_permissions(at(name), fs::Permissions::from_mode(mode)).unwrap();
        }
        refused_to_nobody(&at("texere"), folder.path(), "cloth.ply");
        assert_eq!(fs::read(at("cloth.ply")).unwrap(), b"root's");
        assert_eq!(names(folder.path()), ["cloth.ply", "plain.toml", "texere"]);
    }

    #[test]
    fn a_turntable_of_links_to_one_another_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        fs::write(at("turn-002.png"), "old").unwrap();
        symlink("turn-002.png", at("turn-001.png")).unwrap();
        let (cloth, out) = (design("plain.toml"), at("turn.png"));
        let args = [
            "render",
            &cloth,
            "-o",
            out.to_str().unwrap(),
            "--view",
            "turntable",
            "--frames",
            "2",
            "--size",
            "8x8",
        ];
        let output = texere(&args);
        assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
        assert_eq!(fs::read(at("turn-002.png")).unwrap(), b"old");
    }
}
