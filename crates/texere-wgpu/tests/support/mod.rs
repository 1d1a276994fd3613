//! Helpers of the tests: an open device, and small fabrics.

#![allow(dead_code, clippy::expect_used, reason = "not every test needs all of it, and a test may panic")]

use std::sync::{Arc, OnceLock};

use texere_core::backend::Plan;
use texere_core::{ControlPoint, Settings, Yarn, Yarns};
use texere_wgpu::{Schedule, WgpuBackend};

/// The message of a test that finds no device: what to install.
pub(crate) const INSTALL: &str =
    "a wgpu device; on Linux install a Vulkan driver, such as mesa-vulkan-drivers";

/// The first device, opened once.
pub(crate) fn backend() -> &'static WgpuBackend {
    static BACKEND: OnceLock<WgpuBackend> = OnceLock::new();
    BACKEND.get_or_init(|| WgpuBackend::open(0, Schedule::PerRing).expect(INSTALL))
}

/// Waving yarns along x, of `points` points each.
pub(crate) fn waves(yarns: usize, points: usize, yarn: Yarn) -> Yarns {
    let mut builder = Yarns::builder();
    for number in 0..yarns {
        let point = |k: usize| {
            let (x, y) = (k as f32, 2.0 * number as f32);
            ControlPoint::new(
                x,
                y + (x * 0.7).sin() * 0.3,
                (x * 1.3).cos() * 0.4,
                0.2 + 0.05 * (x * 0.9).sin(),
            )
        };
        builder.yarn(yarn, &(0..points).map(point).collect::<Vec<_>>());
    }
    builder.build().expect("sound yarns")
}

pub(crate) fn plan(yarns: &Yarns, settings: Settings) -> Arc<Plan> {
    Arc::new(Plan::new(yarns.layout().clone(), settings).expect("a plan"))
}
