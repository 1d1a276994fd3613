//! A file that is not yet complete. It has a temporary name in the folder of its target.
//!
//! Unfinished files do not stay behind. After an error or a panic the file is removed when its
//! owner is dropped. Before a signal ends the program, [`abandon`] removes the file. The next write
//! in a folder removes files that a killed process left there. A file without a lock is such a
//! leftover: a writer holds a lock on its file, and the system releases the lock when the process
//! ends. An unfinished folder has no lock, and stays if the process is killed.

use std::collections::BTreeSet;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, ErrorKind, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use same_file::Handle;
use tempfile::{NamedTempFile, TempDir};

use super::WriteError;
use super::output::FilePlace;

/// A temporary name is this prefix, [`RANDOM`] letters or digits, and [`ENDING`], which no user's
/// file has.
const PREFIX: &str = ".texere-";
const RANDOM: usize = 16;
const ENDING: &str = ".unfinished";

/// The most files that a writer starts for one output. The writer starts another file if a second
/// writer, which began at the same moment, took the first file for a leftover.
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

/// The registry, or an error once all files have been abandoned. Files can't be abandoned while the
/// registry is held.
fn registry_in_use() -> io::Result<MutexGuard<'static, Registry>> {
    let registry = registry();
    if registry.abandoned {
        return Err(io::Error::new(ErrorKind::Interrupted, "the program is about to end"));
    }
    Ok(registry)
}

/// Removes every file that this process has not finished writing. After the call no file can be
/// started or finished. The call is meant for a program that is about to end, for example by a
/// signal.
///
/// When the call returns, each target is either a whole new file or as it was before. Writers that
/// are at work fail with [`WriteError::Io`].
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
        // A later write removes a file that can't be removed now. A folder stays.
        let _ = if file.is_dir() { fs::remove_dir_all(file) } else { fs::remove_file(file) };
    }
}

/// A folder with a temporary name, which takes its place with [`UnfinishedFolder::finish`].
#[derive(Debug)]
pub(super) struct UnfinishedFolder {
    folder: TempDir,
    entry: Entry,
}

impl UnfinishedFolder {
    /// Starts an empty folder beside `path`.
    pub(super) fn beside(path: &Path) -> Result<Self, WriteError> {
        let failed = |source| WriteError::io("create", path, source);
        let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty());
        let mut registry = registry_in_use().map_err(failed)?;
        let mut builder = tempfile::Builder::new();
        builder.prefix(PREFIX).rand_bytes(RANDOM).suffix(ENDING);
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // The folder gets the permissions of any new folder, less the umask.
            builder.permissions(fs::Permissions::from_mode(0o777));
        }
        let folder = builder.tempdir_in(parent.unwrap_or(Path::new("."))).map_err(failed)?;
        let entry = Entry(folder.path().to_owned());
        registry.files.insert(entry.0.clone());
        Ok(Self { folder, entry })
    }

    /// The folder's path until it is finished.
    pub(super) fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Gives the folder its name.
    pub(super) fn finish(self, path: &Path) -> Result<(), WriteError> {
        let Self { folder, entry } = self;
        let renamed = registry_in_use().and_then(|_held| {
            fs::rename(folder.path(), path)?;
            // There is no folder of the temporary name left to remove.
            let _ = folder.keep();
            Ok(())
        });
        renamed.map_err(|source| WriteError::io("rename", path, source))?;
        drop(entry);
        Ok(())
    }
}

/// A file that takes its place with [`Unfinished::finish`].
#[derive(Debug)]
pub(super) struct Unfinished {
    // The file is dropped before its entry in the registry, so that at every moment either the drop
    // or [`abandon`] removes the file.
    file: NamedTempFile,
    entry: Entry,
    place: FilePlace,
}

/// An entry of the registry, which is removed when this value is dropped.
#[derive(Debug)]
struct Entry(PathBuf);

impl Drop for Entry {
    fn drop(&mut self) {
        let mut registry = registry();
        registry.files.remove(&self.0);
        if registry.files.is_empty() {
            // An emptied set keeps the memory of its last entry, a new one has none.
            registry.files = BTreeSet::new();
        }
    }
}

impl Unfinished {
    /// Starts an empty file beside `place`. The file is in the folder of `place` because a rename
    /// is atomic only within one file system.
    pub(super) fn beside(place: FilePlace) -> Result<Self, WriteError> {
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

    /// Brings all bytes to the disk, and looks whether the file may still take its place.
    pub(super) fn settle(&self) -> Result<(), WriteError> {
        let synced = self.file.as_file().sync_all();
        synced.map_err(|source| WriteError::io("write", self.place.path(), source))?;
        self.place.check().map(drop)
    }

    /// Puts the file in its place atomically. Returns the file's length in bytes.
    pub(super) fn finish(self) -> Result<u64, WriteError> {
        let Self { place, entry, file } = self;
        let failed = |action, source| WriteError::io(action, place.path(), source);
        // The bytes have to reach the disk before the name does.
        let synced = file.as_file().sync_all().and_then(|()| file.as_file().metadata());
        let bytes = synced.map_err(|source| failed("write", source))?.len();
        // The folder may have changed since the file was started.
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

/// An empty file with a temporary name.
fn new_file(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX).rand_bytes(RANDOM).suffix(ENDING);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // The file gets the permissions of any new file, less the umask. Temporary files would be
        // private by default.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}

/// Takes a new file's lock. With the lock, no other process removes the file. Returns `false` if
/// another process took the file for a leftover first, and holds the lock or has removed the name.
fn hold(file: &NamedTempFile) -> io::Result<bool> {
    match file.as_file().try_lock() {
        Ok(()) => Ok(is_named(file.path(), file.as_file().try_clone()?)),
        Err(TryLockError::WouldBlock) => Ok(false),
        // On a file system without locks no process gets a lock, so none removes the file.
        Err(TryLockError::Error(_)) => Ok(true),
    }
}

/// Removes leftovers of ended writers from `folder`.
fn sweep(folder: &Path, place: &FilePlace) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let is_ours = entry.file_name().to_str().is_some_and(is_name)
            && entry.file_type().is_ok_and(|kind| kind.is_file());
        if is_ours {
            // A leftover that can't be opened or removed stays. It does no harm.
            let _ = remove_left(&entry.path(), place);
        }
    }
}

fn is_name(name: &str) -> bool {
    let random = name.strip_prefix(PREFIX).and_then(|rest| rest.strip_suffix(ENDING)).unwrap_or_default();
    random.len() == RANDOM && random.bytes().all(|byte| byte.is_ascii_alphanumeric())
}

/// Removes a file with a temporary name if no writer holds its lock.
fn remove_left(path: &Path, place: &FilePlace) -> io::Result<()> {
    let file = OpenOptions::new().read(true).write(true).open(path)?;
    file.try_lock()?;
    // The writer may have finished the file before the lock was taken here. Then the name is gone,
    // or another file has it.
    let handle = Handle::from_file(file)?;
    if Handle::from_path(path)? == handle && !place.spares(&handle) {
        fs::remove_file(path)?;
    }
    Ok(())
}

/// Whether `path` leads to the open `file`.
fn is_named(path: &Path, file: File) -> bool {
    Handle::from_file(file).and_then(|file| Ok(Handle::from_path(path)? == file)).unwrap_or(false)
}
