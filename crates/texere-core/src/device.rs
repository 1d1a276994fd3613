//! The backend trait and the description of a device. The trait is object-safe and names no GPU
//! type.

mod error;

use std::fmt;
use std::sync::Arc;

use crate::Limits;
use crate::backend::{Engine, Plan};
use crate::crossings::{CrossingsPlan, CrossingsSettler};
use crate::relaxation::{RelaxationPlan, Relaxer};
use crate::settling::{Settler, SettlingPlan};

pub use self::error::BackendError;

/// The kind of machine behind a device.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum DeviceKind {
    /// A graphics processor with memory of its own.
    DiscreteGpu,
    /// A graphics processor that shares the host's memory.
    IntegratedGpu,
    /// A processor, with or without a GPU programming interface in front of it.
    Cpu,
    /// Any other machine, or none at all.
    Other,
}

impl fmt::Display for DeviceKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::DiscreteGpu => "discrete GPU",
            Self::IntegratedGpu => "integrated GPU",
            Self::Cpu => "CPU",
            Self::Other => "other",
        })
    }
}

/// The mapping of the work onto the device.
///
/// ```
/// use texere_core::backend::{NullBackend, Schedule};
/// use texere_core::Backend;
/// assert_eq!(NullBackend::default().info().schedule, Schedule::Serial);
/// assert_eq!(Schedule::PerRing.to_string(), "per-ring");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Schedule {
    /// Ring after ring on one thread: the paper's algorithms 1 and 3.
    Serial,
    /// One lane per ring, in a GPU's workgroup or in a processor's vector.
    #[default]
    PerRing,
    /// One lane per yarn: the paper's algorithms 2 and 4, kept to compare with. This schedule makes
    /// only open, untwisted yarns without caps, whose sections stand upright.
    PerYarn,
}

impl fmt::Display for Schedule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Serial => "serial",
            Self::PerRing => "per-ring",
            Self::PerYarn => "per-yarn",
        })
    }
}

/// The capabilities of a device beyond making meshes. A call for a capability that the device lacks
/// fails with the error named at the field.
///
/// The default is a device that only makes meshes.
///
/// ```
/// use texere_core::Backend;
/// use texere_core::backend::NullBackend;
/// let can = NullBackend::default().info().can;
/// assert!(can.edit && !can.settle);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Capabilities {
    /// Whether yarns can be settled by their contacts with [`Backend::settler`]. If not, the call
    /// fails with [`BackendError::NoSettling`].
    pub settle: bool,
    /// Whether woven cloth can be settled by its crossings with [`Backend::crossings_settler`]. If
    /// not, the call fails with [`BackendError::NoCrossings`].
    pub settle_crossings: bool,
    /// Whether yarns can be relaxed with [`Backend::relaxer`]. If not, the call fails with
    /// [`BackendError::NoRelaxation`].
    pub relax: bool,
    /// Whether a mesh can stay on the device and be edited there, as a
    /// [`LiveMesh`](crate::backend::LiveMesh). If not, opening one fails with
    /// [`BackendError::NoEditing`].
    pub edit: bool,
    /// Whether vertices can have attributes, by
    /// [`Session::attributes`](crate::backend::Session::attributes). If not, the call fails with
    /// [`BackendError::NoAttributes`].
    pub attributes: bool,
    /// Whether vertices can be packed, by [`Session::packed`](crate::backend::Session::packed). If
    /// not, the call fails with [`BackendError::NoPacking`].
    pub pack: bool,
    /// Whether the crate `texere-render` can draw pictures on the device. If not, opening the
    /// device for pictures fails with [`BackendError::NoDevice`].
    pub draw: bool,
}

/// A device's name, kind, limits and capabilities.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DeviceInfo {
    /// The name that opens the device, such as `cpu`.
    pub name: String,
    /// The maker's name for the device.
    pub device: String,
    /// Driver or implementation, with its version.
    pub driver: String,
    /// The mapping of the work onto the device, fixed when the backend was opened.
    /// [`Schedule::PerYarn`] refuses some yarns.
    pub schedule: Schedule,
    /// The kind of machine.
    pub kind: DeviceKind,
    /// The device's memory in bytes, if it is known.
    pub memory_bytes: Option<u64>,
    /// The limits that chunks are cut to. `binding_bytes` is the largest length that a buffer may
    /// have.
    pub limits: Limits,
    /// The capabilities of the device beyond making meshes.
    pub can: Capabilities,
    /// Whether the device's own clock measures the
    /// [`Session::timings`](crate::backend::Session::timings) of scan, trajectory and mesh, from
    /// the start of the work to its end. If not, the host's clock measures them.
    pub timed_by_device: bool,
}

/// An open device. [`Session::new`](crate::backend::Session::new) starts work on it.
pub trait Backend: fmt::Debug + Send + Sync {
    /// The device's names, kind, schedule, limits and capabilities.
    fn info(&self) -> &DeviceInfo;

    /// Opens an engine for a plan. The engine owns all the device memory that its work needs.
    ///
    /// **Errors**: [`BackendError`] if memory is short, the device fails, or the device or its
    /// schedule can't do the work.
    fn engine(&self, plan: Arc<Plan>) -> Result<Box<dyn Engine>, BackendError>;

    /// Opens a settler for a plan. The settler owns all the device memory that its work needs.
    ///
    /// **Errors**: [`BackendError::NoSettling`] if the backend has no settler, and any other
    /// [`BackendError`] if memory is short or the device fails.
    fn settler(&self, plan: Arc<SettlingPlan>) -> Result<Box<dyn Settler>, BackendError> {
        let _ = plan;
        Err(BackendError::NoSettling { name: self.info().name.clone() })
    }

    /// Opens a settler of crossings for a plan. The settler owns all the device memory that its
    /// work needs.
    ///
    /// **Errors**: [`BackendError::NoCrossings`] if the backend has no settler of crossings, and
    /// any other [`BackendError`] if memory is short or the device fails.
    fn crossings_settler(&self, plan: Arc<CrossingsPlan>) -> Result<Box<dyn CrossingsSettler>, BackendError> {
        let _ = plan;
        Err(BackendError::NoCrossings { name: self.info().name.clone() })
    }

    /// Opens a relaxer for a plan. The relaxer owns all the device memory that its work needs.
    ///
    /// **Errors**: [`BackendError::NoRelaxation`] if the backend has no relaxer, and any other
    /// [`BackendError`] if memory is short or the device fails.
    fn relaxer(&self, plan: Arc<RelaxationPlan>) -> Result<Box<dyn Relaxer>, BackendError> {
        let _ = plan;
        Err(BackendError::NoRelaxation { name: self.info().name.clone() })
    }
}

const _: () = {
    const fn sends<T: Send + ?Sized>() {}
    sends::<dyn Backend>();
};
