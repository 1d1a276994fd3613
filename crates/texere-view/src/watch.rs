//! The files of a design, which may change while the window shows the design.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// When a file was written last, and its length in bytes. None if there is no such file.
type Stamp = Option<(SystemTime, u64)>;

/// The files of a design, as they were when it was read.
#[derive(Debug)]
pub(crate) struct Watch {
    files: Vec<(PathBuf, Stamp)>,
}

impl Watch {
    /// Watches `files` from now on. Read the design after this call, so that no change is missed.
    pub(crate) fn new(files: impl IntoIterator<Item = PathBuf>) -> Self {
        let mut watch = Self { files: Vec::new() };
        watch.follow(files);
        watch
    }

    /// Watches `files` from now on. A file that was watched before is still compared with its last
    /// state.
    pub(crate) fn follow(&mut self, files: impl IntoIterator<Item = PathBuf>) {
        let before = std::mem::take(&mut self.files);
        let known = |file: &PathBuf| before.iter().find(|(known, _)| known == file).map(|(_, stamp)| *stamp);
        self.files = files
            .into_iter()
            .map(|file| {
                let stamp = known(&file).unwrap_or_else(|| stamp(&file));
                (file, stamp)
            })
            .collect();
    }

    /// Whether a file differs from its state at the last call of [`Watch::changed`].
    pub(crate) fn is_stale(&self) -> bool {
        self.files.iter().any(|(file, before)| stamp(file) != *before)
    }

    /// Whether a file differs from its state at the last call.
    pub(crate) fn changed(&mut self) -> bool {
        let mut changed = false;
        for (file, before) in &mut self.files {
            let now = stamp(file);
            changed |= now != *before;
            *before = now;
        }
        changed
    }
}

fn stamp(file: &Path) -> Stamp {
    let data = fs::metadata(file).ok()?;
    Some((data.modified().ok()?, data.len()))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may panic")]

    use super::*;

    #[test]
    fn a_change_is_seen_once_and_none_is_missed_while_a_design_is_read() {
        let folder = std::env::temp_dir().join(format!("texere-watch-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let [design, image] = ["cloth.toml", "motif.png"].map(|name| folder.join(name));
        fs::write(&design, "one").unwrap();
        let mut watch = Watch::new([design.clone()]);
        assert!(!watch.changed());
        // The design has changed while it was read, and names another file now.
        fs::write(&design, "one and two").unwrap();
        watch.follow([design.clone(), image.clone()]);
        assert!(watch.changed() && !watch.changed());
        fs::write(&image, "three").unwrap();
        assert!(watch.changed() && !watch.changed());
        fs::remove_file(&design).unwrap();
        assert!(watch.changed() && !watch.changed());
        fs::remove_dir_all(&folder).unwrap();
    }
}
