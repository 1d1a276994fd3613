//! Output that a program abandons before it ends. The test has a process of its own, because no
//! file can be written after the call of `abandon`.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::fs;
use std::io::ErrorKind;
use std::ops::ControlFlow;
use std::sync::mpsc;

use texere_core::{ControlPoint, Pipeline, Yarn, Yarns};
use texere_cpu::SerialBackend;
use texere_formats::{WriteError, write};

fn interrupted(error: &WriteError) -> bool {
    matches!(error, WriteError::Io { source, .. } if source.kind() == ErrorKind::Interrupted)
}

#[test]
fn what_is_abandoned_is_gone_and_nothing_is_written_after_it() {
    let folder = tempfile::tempdir().unwrap();
    let (path, done) = (folder.path().join("cloth.ply"), folder.path().join("done.svg"));
    fs::write(&path, "old").unwrap();
    write::file(b"whole", &done).unwrap();
    let mut yarns = Yarns::builder();
    yarns.yarn(Yarn::default(), &[0.0, 1.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
    let yarns = yarns.build().unwrap();
    let (at_work, work) = mpsc::channel();
    let (go_on, wait) = mpsc::channel::<()>();
    let names = || fs::read_dir(folder.path()).unwrap().count();
    std::thread::scope(|scope| {
        let writer = scope.spawn(|| {
            let stopping = Pipeline::new(&yarns).progress(move |now| {
                // The file is begun once control points have been sent.
                if now.rings > 0 {
                    at_work.send(()).unwrap();
                    let _ = wait.recv();
                }
                ControlFlow::Continue(())
            });
            write::stream(stopping, &SerialBackend::new(), &path)
        });
        work.recv().unwrap();
        let (begun, is_begun) = mpsc::channel();
        let (fill_on, filling) = mpsc::channel::<()>();
        let maps = folder.path().join("maps");
        let filler = scope.spawn(move || {
            write::folder(maps, |unfinished| {
                fs::write(unfinished.join("one.png"), "half").unwrap();
                begun.send(()).unwrap();
                let _ = filling.recv();
                Ok::<(), WriteError>(())
            })
        });
        is_begun.recv().unwrap();
        assert_eq!(names(), 4);
        write::abandon();
        assert_eq!(names(), 2);
        drop((go_on, fill_on));
        assert!(interrupted(&writer.join().unwrap().unwrap_err()));
        // Whatever was left to do in the folder can't be done.
        assert!(filler.join().unwrap().is_err());
    });
    let folder_after = write::folder(folder.path().join("maps"), |_| Ok::<(), WriteError>(()));
    assert!(interrupted(&folder_after.unwrap_err()));
    assert!(interrupted(&write::file(b"more", &done).unwrap_err()));
    assert_eq!((fs::read(&path).unwrap(), fs::read(&done).unwrap()), (b"old".to_vec(), b"whole".to_vec()));
    assert_eq!(names(), 2);
}
