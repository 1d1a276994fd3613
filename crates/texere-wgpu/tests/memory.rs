//! The device memory that a plan announces, against the report of wgpu's allocator.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod support;

use std::sync::Arc;

use texere_core::backend::PaddedPoints;
use texere_core::{Backend, Bounds, Frame, Limits, Settings, Topology, Yarn};
use texere_wgpu::{Schedule, WgpuBackend};

use support::{INSTALL, plan, waves};

/// Buffers that the plan does not count: parameters, time stamps, and host memory through which
/// results are read.
const BESIDES: [&str; 3] = ["parameters", "timestamps", "readback"];

/// The length of every buffer is a multiple of this, bytes.
const STEP: u64 = 16;

/// The most bytes that a driver may add to a buffer to align it. A buffer that holds nothing has at
/// most as many bytes.
const ALIGNED: u64 = 128;

#[test]
fn buffers_are_those_of_the_plan() {
    let yarns = waves(3, 700, Yarn { twist: 0.3, ..Yarn::default() });
    // The last case is a region whose scan goes over the whole plan in one chunk.
    for (frame, caps, blocks, is_region) in [
        (Frame::Upright, false, u64::MAX, false),
        (Frame::RotationMinimizing, true, 5, false),
        (Frame::RotationMinimizing, true, u64::MAX, true),
    ] {
        for topology in [Topology::Indexed, Topology::Shared] {
            // Each case has a device of its own, so that the buffers of other tests are not
            // counted.
            let backend = WgpuBackend::open(0, Schedule::PerRing).expect(INSTALL);
            let backend = backend.with_limits(Limits { blocks, ..Limits::NONE });
            let plan = plan(&yarns, Settings { frame, caps, topology, sides: 5, ..Settings::default() });
            let plan = if is_region {
                let mut points = PaddedPoints::new(&plan).unwrap();
                points.upload(&plan, 0, yarns.points());
                Arc::new(plan.within(&points, &Bounds::rectangle([10.0, -100.0], [20.0, 100.0])))
            } else {
                plan
            };
            let limits = backend.info().limits;
            let mut session = backend.lending_session(plan.clone()).unwrap();
            session.upload(0, yarns.points()).unwrap();
            session.scan().unwrap();
            for chunk in plan.chunks(&limits).unwrap() {
                session.mesh(&chunk).unwrap();
            }
            session.timings();
            // The device is polled twice. Buffers that were replaced by new ones are freed by the
            // first poll.
            for _ in 0..2 {
                backend.device().poll(wgpu::PollType::wait_indefinitely()).unwrap();
            }
            let buffers = texere_gpu::device_buffers(&plan, &limits).unwrap();
            let planned: u64 = buffers.iter().map(|(_, bytes)| bytes.next_multiple_of(STEP)).sum();
            assert_eq!(session.device_bytes(), planned);
            let Some(report) = backend.device().generate_allocator_report() else { continue };
            let held = report
                .allocations
                .iter()
                .filter(|one| !BESIDES.contains(&one.name.as_str()) && !one.name.starts_with("(wgpu"));
            let (count, held) = held.fold((0, 0), |(count, bytes), one| (count + 1, bytes + one.size));
            assert!(held >= planned && held <= planned + ALIGNED * count, "{report:#?}");
        }
    }
}
