//! The backend trait: object-safe, blocking where it must wait, free of any GPU type.

mod error;

use std::fmt;
use std::sync::Arc;

use crate::Limits;
use crate::backend::{Engine, Plan};
use crate::crossings::{CrossingsPlan, CrossingsSettler};
use crate::settling::{Settler, SettlingPlan};

pub use self::error::BackendError;

/// What kind of machine a device is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum DeviceKind {
    /// A graphics processor with memory of its own.
    DiscreteGpu,
    /// A graphics processor that shares the host's memory.
    IntegratedGpu,
    /// A processor, also behind a GPU programming interface.
    Cpu,
    /// Anything else, or nothing at all.
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

/// How a backend maps the work onto its device.
///
/// ```
/// use texere_core::backend::{NullBackend, Schedule};
/// use texere_core::Backend;
/// assert_eq!(NullBackend::default().info().schedule, Schedule::Serial);
/// assert_eq!(Schedule::PerRing.to_string(), "per-ring");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Schedule {
    /// One ring after the other on one thread: the paper's algorithms 1 and 3.
    Serial,
    /// A lane a ring: of a GPU's workgroup, or of a processor's vector.
    #[default]
    PerRing,
    /// A lane a yarn: the paper's algorithms 2 and 4, to measure against. Upright, untwisted, open
    /// yarns without caps only.
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

/// What a device does beside making meshes, which all of them do. What it can't is refused with the
/// error that stands here.
///
/// The default is a device that makes meshes alone.
///
/// ```
/// use texere_core::Backend;
/// use texere_core::backend::NullBackend;
/// let can = NullBackend::default().info().can;
/// assert!(can.edit && !can.settle);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Capabilities {
    /// Yarns come to rest by their contacts: [`Backend::settler`]. Else
    /// [`BackendError::NoSettling`].
    pub settle: bool,
    /// Woven cloth comes to rest by its crossings: [`Backend::crossings_settler`]. Else
    /// [`BackendError::NoCrossings`].
    pub settle_crossings: bool,
    /// A mesh stays on the device and is edited there: [`LiveMesh`](crate::backend::LiveMesh). Else
    /// [`BackendError::NoEditing`].
    pub edit: bool,
    /// Vertices have attributes: [`Session::attributes`](crate::backend::Session::attributes). Else
    /// [`BackendError::NoAttributes`].
    pub attributes: bool,
    /// Vertices are packed: [`Session::packed`](crate::backend::Session::packed). Else
    /// [`BackendError::NoPacking`].
    pub pack: bool,
    /// Pictures are drawn on the device, by the crate `texere-render`. To open another one for them
    /// is [`BackendError::NoDevice`].
    pub draw: bool,
}

/// A device's name, kind, limits and capabilities.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DeviceInfo {
    /// The name that opens it, such as `cpu`.
    pub name: String,
    /// The device as its maker calls it.
    pub device: String,
    /// Driver or implementation, with its version.
    pub driver: String,
    /// How the work is mapped onto the device, fixed when the backend was opened.
    /// [`Schedule::PerYarn`] leaves yarns out.
    pub schedule: Schedule,
    /// What kind of machine it is.
    pub kind: DeviceKind,
    /// Bytes of memory that the device has, where it says so.
    pub memory_bytes: Option<u64>,
    /// The limits that chunks are cut to; `binding_bytes` is the longest buffer.
    pub limits: Limits,
    /// What the device does beside making meshes.
    pub can: Capabilities,
    /// Whether the device's own clock measures the
    /// [`Session::timings`](crate::backend::Session::timings) of scan, trajectory and mesh, from
    /// the start of the work to its end. Otherwise the host's clock does.
    pub timed_by_device: bool,
}

/// An open device. [`Session::new`](crate::backend::Session::new) starts work on it.
pub trait Backend: fmt::Debug + Send + Sync {
    /// Backend, device, driver, schedule, limits and capabilities.
    fn info(&self) -> &DeviceInfo;

    /// Opens an engine for a plan. The engine owns all the device memory that the work needs.
    ///
    /// **Errors**: [`BackendError`] where memory, the device or the schedule does not allow it.
    fn engine(&self, plan: Arc<Plan>) -> Result<Box<dyn Engine>, BackendError>;

    /// Opens a settler for a plan. It owns all the device memory that the work needs.
    ///
    /// **Errors**: [`BackendError::NoSettling`] where the backend has none, and other ones where
    /// memory or the device does not allow it.
    fn settler(&self, plan: Arc<SettlingPlan>) -> Result<Box<dyn Settler>, BackendError> {
        let _ = plan;
        Err(BackendError::NoSettling { name: self.info().name.clone() })
    }

    /// Opens a settler of crossings for a plan. It owns all the device memory that the work needs.
    ///
    /// **Errors**: [`BackendError::NoCrossings`] where the backend has none, and other ones where
    /// memory or the device does not allow it.
    fn crossings_settler(&self, plan: Arc<CrossingsPlan>) -> Result<Box<dyn CrossingsSettler>, BackendError> {
        let _ = plan;
        Err(BackendError::NoCrossings { name: self.info().name.clone() })
    }
}

const _: () = {
    const fn sends<T: Send + ?Sized>() {}
    sends::<dyn Backend>();
};
