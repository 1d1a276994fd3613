//! A file that is not yet whole: under a name of its own, in the folder of the place that it is to take.
//!
//! Nothing of it stays behind. After an error or a panic it goes with its owner; before a signal ends the program,
//! [`abandon`] removes it; and what a kill has left is removed by the next write in that folder. A file that has a writer
//! is told from one that has none by the writer's lock, which the system takes away with the process.

use std::collections::BTreeSet;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, ErrorKind, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use same_file::Handle;
use tempfile::NamedTempFile;

use super::WriteError;
use super::output::Place;

/// Names are this, [`RANDOM`] letters or digits, and an ending that nobody gives a file of their own.
const PREFIX: &str = ".texere-";
const RANDOM: usize = 16;
const ENDING: &str = ".unfinished";

/// How often a new file may be taken for a left one, and swept, by others that start at the same moment.
const ATTEMPTS: usize = 100;

/// The unfinished files of this process.
struct Registry {
    files: BTreeSet<PathBuf>,
    abandoned: bool,
}

static REGISTRY: Mutex<Registry> = Mutex::new(Registry { files: BTreeSet::new(), abandoned: false });

fn registry() -> MutexGuard<'static, Registry> {
    REGISTRY.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The registry, unless all files were abandoned. While it is held they can't be.
fn registry_in_use() -> io::Result<MutexGuard<'static, Registry>> {
    let registry = registry();
    if registry.abandoned {
        return Err(io::Error::new(ErrorKind::Interrupted, "the program is about to end"));
    }
    Ok(registry)
}

/// Removes every file that this process has not finished writing, and lets none be started or finished any more: for
/// a program that is about to end, say by a signal.
///
/// A file is either whole when this returns, or as it was before. Writers that are at work fail with
/// [`WriteError::Io`].
///
/// ```no_run
/// // On Ctrl-C, in a thread that waits for it:
/// texere_formats::write::abandon();
/// std::process::exit(130);
/// ```
pub fn abandon() {
    let mut registry = registry();
    registry.abandoned = true;
    for file in std::mem::take(&mut registry.files) {
        // What can't be removed is left for the next write to try.
        let _ = fs::remove_file(file);
    }
}

/// A file that becomes the one at its place with [`Unfinished::finish`].
#[derive(Debug)]
pub(super) struct Unfinished {
    // The file goes before its entry, so that there is no moment in which nobody would remove it.
    file: NamedTempFile,
    entry: Entry,
    place: Place,
}

/// A line of the registry.
#[derive(Debug)]
struct Entry(PathBuf);

impl Drop for Entry {
    fn drop(&mut self) {
        registry().files.remove(&self.0);
    }
}

impl Unfinished {
    /// An empty file beside `place`, since only within one file system a rename is a single step.
    pub(super) fn beside(place: Place) -> Result<Self, WriteError> {
        let failed = |source| WriteError::io("create", place.path(), source);
        let permissions = place.check()?.map(|old| old.permissions());
        let folder = place.real.parent().unwrap_or(Path::new("."));
        sweep(folder, &place);
        for _ in 0..ATTEMPTS {
            let mut registry = registry_in_use().map_err(failed)?;
            let file = new_file(folder).map_err(failed)?;
            if hold(&file).map_err(failed)? {
                let entry = Entry(file.path().to_owned());
                registry.files.insert(entry.0.clone());
                drop(registry);
                let made = permissions.map_or(Ok(()), |same| file.as_file().set_permissions(same));
                made.map_err(failed)?;
                return Ok(Self { file, entry, place });
            }
        }
        Err(failed(ErrorKind::ResourceBusy.into()))
    }

    /// The path that was asked for.
    pub(super) fn path(&self) -> &Path {
        self.place.path()
    }

    /// Puts the file in its place, in one step that can't be seen half done. Gives its length in bytes.
    pub(super) fn finish(self) -> Result<u64, WriteError> {
        let Self { place, entry, file } = self;
        let failed = |action, source| WriteError::io(action, place.path(), source);
        // A name must not reach the disk before the bytes that it stands for.
        let synced = file.as_file().sync_all().and_then(|()| file.as_file().metadata());
        let bytes = synced.map_err(|source| failed("write", source))?.len();
        // Much may have happened to the folder since the file was started.
        place.check()?;
        let renamed =
            registry_in_use().and_then(|_held| file.persist(&place.real).map_err(|error| error.error));
        renamed.map_err(|source| failed("rename", source))?;
        drop(entry);
        Ok(bytes)
    }
}

impl Write for Unfinished {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Seek for Unfinished {
    fn seek(&mut self, position: SeekFrom) -> io::Result<u64> {
        self.file.seek(position)
    }
}

/// An empty file with a name of ours.
fn new_file(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX).rand_bytes(RANDOM).suffix(ENDING);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // What any new file has, less the umask: the result is no secret, as temporary files are by default.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}

/// Takes a new file's lock. Gives `false` where another process was quicker to take it for a left one, and removes it:
/// it holds the lock, or the name is gone by now. From here on nobody sweeps it.
fn hold(file: &NamedTempFile) -> io::Result<bool> {
    match file.as_file().try_lock() {
        Ok(()) => Ok(is_named(file.path(), file.as_file().try_clone()?)),
        Err(TryLockError::WouldBlock) => Ok(false),
        // Where a file system has no locks, nobody else gets this one either.
        Err(TryLockError::Error(_)) => Ok(true),
    }
}

/// Removes what writers have left in `folder` that live no more.
fn sweep(folder: &Path, place: &Place) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let is_ours = entry.file_name().to_str().is_some_and(is_name)
            && entry.file_type().is_ok_and(|kind| kind.is_file());
        if is_ours {
            // A left file harms nobody: where it can't be looked at or removed, it stays.
            let _ = remove_left(&entry.path(), place);
        }
    }
}

fn is_name(name: &str) -> bool {
    let random = name.strip_prefix(PREFIX).and_then(|rest| rest.strip_suffix(ENDING)).unwrap_or_default();
    random.len() == RANDOM && random.bytes().all(|byte| byte.is_ascii_alphanumeric())
}

/// Removes a file of our name if no writer has it.
fn remove_left(path: &Path, place: &Place) -> io::Result<()> {
    let file = OpenOptions::new().read(true).write(true).open(path)?;
    file.try_lock()?;
    // While the lock was got, its writer may have finished it: then the name is gone, or another file's.
    let handle = Handle::from_file(file)?;
    if Handle::from_path(path)? == handle && !place.spares(&handle) {
        fs::remove_file(path)?;
    }
    Ok(())
}

/// Whether `path` is a name of the open `file`.
fn is_named(path: &Path, file: File) -> bool {
    Handle::from_file(file).and_then(|file| Ok(Handle::from_path(path)? == file)).unwrap_or(false)
}
