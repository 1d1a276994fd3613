//! The file that some formats have beside the mesh file: for OBJ, the file of materials.

use texere_core::Material;

use super::target::Target;
use super::unfinished::Unfinished;
use super::{Format, Output, WriteError};

/// A file that is to appear together with a mesh file, or none.
#[derive(Debug)]
pub(super) struct Beside(Option<Target<Unfinished>>);

impl Beside {
    /// Writes the file that belongs to a mesh file of `format` at `output`. The file keeps a
    /// temporary name until [`commit`](Self::commit).
    ///
    /// **Errors**: [`WriteError::Spared`], [`WriteError::Io`].
    pub(super) fn of(format: Format, output: &Output, materials: &[Material]) -> Result<Self, WriteError> {
        match format {
            #[cfg(feature = "obj")]
            Format::Obj => {
                let mut target = Target::create(output.beside(super::obj::LIBRARY))?;
                target.write(super::obj::library(materials).as_bytes())?;
                Ok(Self(Some(target)))
            }
            _ => {
                let _ = (output, materials);
                Ok(Self(None))
            }
        }
    }

    /// Puts both files in their places, the mesh last. Returns the length of the mesh file, bytes.
    ///
    /// **Errors**: [`WriteError::Io`], [`WriteError::Spared`].
    pub(super) fn commit(self, mut mesh: Target<Unfinished>) -> Result<u64, WriteError> {
        if let Some(beside) = self.0 {
            // If the mesh file still fails, it fails here, before the other file gets its name.
            mesh.settle()?;
            beside.commit()?;
        }
        mesh.commit()
    }
}
