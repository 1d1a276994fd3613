//! The measurements of the tables.

use std::time::Duration;

use texere::backend::Plan;
use texere::mesh::{Counts, PlanError};
use texere::{DeviceInfo, Settings, Yarns};
use texere_core::backend::StageTimings;

/// The times of one device for one cloth.
#[derive(Debug)]
pub(super) struct Run {
    /// Allocating memory and sending tables, by the host's clock.
    pub(super) creation: Duration,
    /// Sending control points to the device, by the host's clock.
    pub(super) upload: Duration,
    /// From the open device to the first mesh in its memory, by the host's clock.
    pub(super) first: Duration,
    /// Stage 1 and stage 2 one after the other, by the device's clock if it has one. None if stages
    /// are fused.
    pub(super) staged: Option<StageTimings>,
    /// Both stages as fast as the device makes them, by the device's clock if it has one.
    pub(super) whole: Duration,
    /// Copying the mesh to the host, by the host's clock. None if it is in the host's memory
    /// already.
    pub(super) readback: Option<Duration>,
    /// Freeing memory, by the host's clock.
    pub(super) clean_up: Duration,
}

/// A device, and its runs on all cloths.
#[derive(Debug)]
pub(super) struct Column {
    pub(super) info: DeviceInfo,
    /// Making a context of the device, by the host's clock. The first context of a driver also
    /// loads the driver. None for the devices `cpu` and `cpu-serial`.
    pub(super) context: Option<Duration>,
    /// Compiling the kernels, by the host's clock: the time of opening the device less that of a
    /// context.
    pub(super) build: Duration,
    pub(super) runs: Vec<Run>,
}

/// A cloth of the tables.
#[derive(Debug)]
pub(super) struct Cloth {
    pub(super) name: String,
    pub(super) yarns: Yarns,
    pub(super) counts: Counts,
}

/// The width and height of the picture that is drawn, pixels.
pub(super) const PICTURE: [u32; 2] = [1600, 1200];

impl Cloth {
    /// A cloth and its counts at the default settings.
    pub(super) fn new(name: String, yarns: Yarns) -> Result<Self, PlanError> {
        let counts = *Plan::new(yarns.layout().clone(), Settings::default())?.counts();
        Ok(Self { name, yarns, counts })
    }
}
