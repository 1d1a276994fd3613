//! Hides what drivers write to standard error while they are loaded, such as complaints about the
//! environment.

/// Does `work`, which loads drivers. Their output on standard error is shown only if `work` fails.
#[cfg(unix)]
pub(crate) fn quietly<T, E>(work: impl FnOnce() -> Result<T, E>) -> Result<T, E> {
    // If standard error can't be redirected, the drivers' output is shown.
    let aside = aside::Aside::begin().ok();
    let done = work();
    if let (Some(aside), Ok(_)) = (aside, &done) {
        aside.drop_quietly();
    }
    done
}

/// Does `work`. Drivers of other systems write nothing to standard error.
#[cfg(not(unix))]
pub(crate) fn quietly<T, E>(work: impl FnOnce() -> Result<T, E>) -> Result<T, E> {
    work()
}

#[cfg(unix)]
mod aside {
    use std::fs::File;
    use std::io::{self, Read, Seek, Write};
    use std::os::fd::OwnedFd;

    use crate::terminal::lines;

    /// Redirects standard error to a file without a name, and shows the file's text when dropped.
    pub(super) struct Aside {
        stderr: OwnedFd,
        written: File,
        shown: bool,
    }

    impl Aside {
        pub(super) fn begin() -> io::Result<Self> {
            let written = tempfile::tempfile()?;
            let stderr = rustix::io::dup(io::stderr())?;
            rustix::stdio::dup2_stderr(&written)?;
            Ok(Self { stderr, written, shown: true })
        }

        pub(super) fn drop_quietly(mut self) {
            self.shown = false;
        }
    }

    impl Drop for Aside {
        fn drop(&mut self) {
            // If standard error can't be restored, there is nowhere to report it.
            let _ = rustix::stdio::dup2_stderr(&self.stderr);
            let mut text = Vec::new();
            if self.shown && self.written.rewind().is_ok() && self.written.read_to_end(&mut text).is_ok() {
                let _ = io::stderr().write_all(lines(&String::from_utf8_lossy(&text)).as_bytes());
            }
        }
    }
}
