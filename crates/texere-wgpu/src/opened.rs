//! An open device, which all sessions of a backend share.

use std::sync::{Arc, OnceLock};

use texere_core::BackendError;
use texere_core::backend::Schedule;

use crate::attributes::AttributeKernels;
use crate::crossings::CrossingsKernels;
use crate::gpu::Gpu;
use crate::kernels::Kernels;
use crate::packed::PackedKernels;
use crate::settling::SettlingKernels;

/// A device with its schedule and its compiled shaders.
#[derive(Debug)]
pub(crate) struct Opened {
    pub(crate) gpu: Gpu,
    pub(crate) schedule: Schedule,
    /// The schedule's shaders for round yarns alone.
    pub(crate) round: Arc<Kernels>,
    /// The schedule's shaders for all yarns, compiled at their first use.
    flattened: OnceLock<Arc<Kernels>>,
    /// The shaders that make attributes, compiled at their first use.
    attributes: OnceLock<Arc<AttributeKernels>>,
    /// The shaders that pack vertices, for round yarns alone and for all yarns, each compiled at
    /// their first use.
    packing: [OnceLock<Arc<PackedKernels>>; 2],
    /// The shaders that bring yarns to rest, for round yarns alone and for all yarns, each compiled
    /// at their first use.
    settling: [OnceLock<Arc<SettlingKernels>>; 2],
    /// The shaders that bring crossings to rest, compiled at their first use.
    crossings: OnceLock<Arc<CrossingsKernels>>,
}

impl Opened {
    /// Compiles the shaders for round yarns.
    ///
    /// **Errors**: [`BackendError::Compile`]; [`BackendError::DeviceLost`];
    /// [`BackendError::Unsupported`] for [`Schedule::Serial`].
    pub(crate) fn new(gpu: Gpu, schedule: Schedule) -> Result<Self, BackendError> {
        let round = Arc::new(Kernels::new(&gpu, schedule, false)?);
        Ok(Self {
            gpu,
            schedule,
            round,
            flattened: OnceLock::new(),
            attributes: OnceLock::new(),
            packing: <_>::default(),
            settling: <_>::default(),
            crossings: OnceLock::new(),
        })
    }

    /// The shaders for all yarns.
    ///
    /// **Errors**: [`BackendError::Compile`], [`BackendError::DeviceLost`].
    pub(crate) fn flattened(&self) -> Result<Arc<Kernels>, BackendError> {
        compiled(&self.flattened, || Kernels::new(&self.gpu, self.schedule, true))
    }

    /// The shaders that make attributes.
    ///
    /// **Errors**: [`BackendError::NoAttributes`] in the schedule per-yarn,
    /// [`BackendError::Compile`], [`BackendError::DeviceLost`].
    pub(crate) fn attributes(&self) -> Result<Arc<AttributeKernels>, BackendError> {
        if self.schedule != Schedule::PerRing {
            return Err(BackendError::NoAttributes);
        }
        compiled(&self.attributes, || AttributeKernels::new(&self.gpu))
    }

    /// The shaders that pack vertices, for round yarns alone, or, with `flattened`, for all yarns.
    ///
    /// **Errors**: [`BackendError::NoPacking`] in the schedule per-yarn, [`BackendError::Compile`],
    /// [`BackendError::DeviceLost`].
    pub(crate) fn packing(&self, flattened: bool) -> Result<Arc<PackedKernels>, BackendError> {
        if self.schedule != Schedule::PerRing {
            return Err(BackendError::NoPacking);
        }
        let place = &self.packing[usize::from(flattened)];
        compiled(place, || PackedKernels::new(&self.gpu, flattened))
    }

    /// The shaders that bring yarns to rest, for round yarns alone, or, with `flattened`, for all
    /// yarns.
    ///
    /// **Errors**: [`BackendError::Compile`], [`BackendError::DeviceLost`].
    pub(crate) fn settling(&self, flattened: bool) -> Result<Arc<SettlingKernels>, BackendError> {
        let place = &self.settling[usize::from(flattened)];
        compiled(place, || SettlingKernels::new(&self.gpu, flattened))
    }

    /// The shaders that bring crossings to rest.
    ///
    /// **Errors**: [`BackendError::Compile`], [`BackendError::DeviceLost`].
    pub(crate) fn crossings(&self) -> Result<Arc<CrossingsKernels>, BackendError> {
        compiled(&self.crossings, || CrossingsKernels::new(&self.gpu))
    }
}

/// The compiled shaders, from `place`. They are compiled if `place` is empty.
fn compiled<T>(
    place: &OnceLock<Arc<T>>,
    compile: impl FnOnce() -> Result<T, BackendError>,
) -> Result<Arc<T>, BackendError> {
    if let Some(compiled) = place.get() {
        return Ok(compiled.clone());
    }
    let compiled = Arc::new(compile()?);
    // Another engine or settler may have compiled the shaders meanwhile.
    Ok(place.get_or_init(|| compiled).clone())
}
