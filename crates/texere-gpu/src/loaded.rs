//! The chunk whose tables an engine holds in a slot.

use texere_core::BackendError;
use texere_core::backend::{Chunk, Plan, TablesId};

/// The chunk whose tables lie in a slot of an engine.
///
/// Kernels check no bounds, but rely on the tables of a chunk, whose counts come from its plan.
/// Before an engine runs kernels, it therefore checks that the chunk is of the engine's own plan
/// and is the one that was loaded.
///
/// ```
/// use texere_core::backend::Plan;
/// use texere_core::{BackendError, ControlPoint, Limits, Settings, Yarn, Yarns};
/// use texere_gpu::LoadedChunk;
/// # let mut yarns = Yarns::builder();
/// # yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
/// # let yarns = yarns.build()?;
/// let plan = Plan::new(yarns.layout().clone(), Settings::default())?;
/// let chunk = plan.chunks(&Limits::NONE)?.next().ok_or("no chunk")?;
/// let mut loaded = LoadedChunk::default();
/// assert!(matches!(loaded.check(&plan, &chunk), Err(BackendError::NotLoaded { .. })));
/// loaded.load(&plan, &chunk, || Ok(()))?; // the tables are sent
/// loaded.check(&plan, &chunk)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Default)]
pub struct LoadedChunk {
    tables: Option<TablesId>,
}

impl LoadedChunk {
    /// Calls `send` to send the tables of `chunk`, and notes that `chunk` is loaded instead of any
    /// other. If `send` fails, no chunk is loaded.
    ///
    /// **Errors**: [`BackendError::NotLoaded`] for a chunk of another plan, and the errors of
    /// `send`.
    pub fn load<T>(
        &mut self,
        plan: &Plan,
        chunk: &Chunk,
        send: impl FnOnce() -> Result<T, BackendError>,
    ) -> Result<T, BackendError> {
        self.tables = None;
        if !plan.owns(chunk) {
            return Err(BackendError::NotLoaded { chunk: chunk.index() });
        }
        let sent = send()?;
        self.tables = Some(chunk.tables().clone());
        Ok(sent)
    }

    /// Checks that `chunk` is of `plan` and that its tables are loaded.
    ///
    /// **Errors**: [`BackendError::NotLoaded`] if not.
    pub fn check(&self, plan: &Plan, chunk: &Chunk) -> Result<(), BackendError> {
        if plan.owns(chunk) && self.tables.as_ref() == Some(chunk.tables()) {
            Ok(())
        } else {
            Err(BackendError::NotLoaded { chunk: chunk.index() })
        }
    }
}
