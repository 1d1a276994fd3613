//! A folder of files that appears whole or not at all.

use std::fs::{self, File};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use super::WriteError;
use super::unfinished::UnfinishedFolder;

/// Makes a folder at `path`. `fill` gets the path of an unfinished folder, and writes the files
/// into it. The unfinished folder then takes the name `path`. If `fill` fails, or the program ends
/// first, `path` stays as it was: nothing is there, or an empty folder.
///
/// **Errors**: the error of `fill`; [`WriteError::Io`] if there is something at `path` already that
/// is not an empty folder, or if the file system refuses.
///
/// ```
/// # let parent = tempfile::tempdir()?;
/// # let path = parent.path().join("maps");
/// use texere_formats::WriteError;
/// texere_formats::write::folder(&path, |unfinished| {
///     std::fs::write(unfinished.join("color.txt"), "red")?;
///     Ok::<(), Box<dyn std::error::Error>>(())
/// })?;
/// assert_eq!(std::fs::read(path.join("color.txt"))?, b"red");
/// // A folder with files in it is not replaced.
/// let again = texere_formats::write::folder(&path, |_| Ok::<(), WriteError>(()));
/// assert!(matches!(again, Err(WriteError::Io { action: "create", .. })));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn folder<E: From<WriteError>>(
    path: impl AsRef<Path>,
    fill: impl FnOnce(&Path) -> Result<(), E>,
) -> Result<(), E> {
    let path = path.as_ref();
    vacant(path)?;
    let unfinished = UnfinishedFolder::beside(path)?;
    fill(unfinished.path())?;
    for file in files(unfinished.path()).map_err(|source| WriteError::io("write", path, source))? {
        // The bytes have to reach the disk before the folder's name does.
        let synced = File::open(&file).and_then(|open| open.sync_all());
        synced.map_err(|source| WriteError::io("write", path, source))?;
    }
    vacant(path)?;
    unfinished.finish(path)?;
    Ok(())
}

/// Makes sure that `path` is an empty folder, or that nothing is there and its parent is a folder.
/// The check is meant for a program that has much to do before it writes. [`folder`](fn@folder)
/// makes the check itself.
///
/// **Errors**: [`WriteError::Io`] if there is something else at `path`, or no folder for it.
pub fn vacant(path: impl AsRef<Path>) -> Result<(), WriteError> {
    let path = path.as_ref();
    free(path).map_err(|source| WriteError::io("create", path, source))
}

fn free(path: &Path) -> io::Result<()> {
    match fs::read_dir(path) {
        Err(error) if error.kind() == ErrorKind::NotFound && fs::symlink_metadata(path).is_err() => {
            let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty());
            if parent.is_none_or(Path::is_dir) { Ok(()) } else { Err(error) }
        }
        Err(error) => Err(error),
        Ok(mut entries) => match entries.next() {
            None => Ok(()),
            Some(_) => Err(io::Error::new(ErrorKind::DirectoryNotEmpty, "the folder has files in it")),
        },
    }
}

/// All files in a folder and in the folders within it.
fn files(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let (mut found, mut folders) = (Vec::new(), vec![folder.to_owned()]);
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder)? {
            let entry = entry?;
            if entry.file_type()?.is_dir() { folders.push(entry.path()) } else { found.push(entry.path()) }
        }
    }
    Ok(found)
}
