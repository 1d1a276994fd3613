//! Writes bytes to a file, unchanged.

use super::target::Target;
use super::{Output, WriteError};

/// Writes `bytes` unchanged, as safely as any other output: to a file beside the target, which then
/// replaces the target.
///
/// **Errors**: [`WriteError::Io`], [`WriteError::Spared`].
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("plot.svg");
/// texere_formats::write::file(b"<svg xmlns='http://www.w3.org/2000/svg'/>", &path)?;
/// assert!(std::fs::read(&path)?.starts_with(b"<svg"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn file(bytes: &[u8], output: impl Into<Output>) -> Result<(), WriteError> {
    let mut target = Target::create(output.into())?;
    target.write(bytes)?;
    target.commit()?;
    Ok(())
}
