//! Settling on devices with little memory.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test may panic")]

mod support;

use std::sync::Arc;

use texere_conformance::rest::{settling_plan, starts};
use texere_core::settling::{Form, Pass, Place, SettlingPlan, tag};
use texere_core::{Backend, BackendError, Limits, OutOfMemory};
use texere_wgpu::{Schedule, WgpuBackend};

use support::INSTALL;

/// The number of neighbours that are listed at the start, and all places after three passes in the
/// block form.
fn course(device: &WgpuBackend, plan: &Arc<SettlingPlan>) -> Result<(u64, Vec<Place>), BackendError> {
    let points = plan.places().iter().zip(plan.tags()).filter(|(_, tags)| *tags & tag::POINT != 0);
    let mut places: Vec<Place> = points.map(|(place, _)| *place).collect();
    let mut settler = device.settler(Arc::clone(plan))?;
    settler.upload(&places)?;
    let neighbours = settler.list(1.0)?;
    for _ in 0..3 {
        settler.pass(&Pass { form: Form::Block, growth: 1.0, ease: 0.5, momentum: 0.8 })?;
    }
    settler.read(&mut places)?;
    Ok((neighbours, places))
}

/// If a buffer, or all buffers together, may have only little memory, a device settles to the same
/// places or says what is too large.
#[test]
fn small_memories_settle_the_same_or_are_refused_by_name() {
    let start = starts().into_iter().find(|start| start.name == "jersey-5-piece").unwrap();
    let plan = settling_plan(&start);
    let open = || WgpuBackend::open(0, Schedule::PerRing).expect(INSTALL);
    let whole = course(&open(), &plan).unwrap();
    let refused = |device: &WgpuBackend| match course(device, &plan) {
        Ok(found) => {
            assert!(found == whole, "another end");
            None
        }
        Err(BackendError::OutOfMemory(OutOfMemory { what, .. })) => Some(what),
        Err(error) => panic!("{error}"),
    };
    let mut device = open();
    let mut each = Vec::new();
    // The limit goes from 32 MiB down to 1 KiB, because `with_limits` can only make limits
    // stricter.
    for power in (10..26).rev() {
        device = device.with_limits(Limits { binding_bytes: 1 << power, ..Limits::NONE });
        each.extend(refused(&device));
    }
    assert_eq!((each.first(), each.last()), (Some(&"pulls of intervals"), Some(&"the place table")));
    // This is enough for each buffer, and too little for all together.
    let little = 1 << 17;
    let in_each = open().with_limits(Limits { binding_bytes: little, ..Limits::NONE });
    let in_all = open().with_limits(Limits { memory_bytes: little, ..Limits::NONE });
    assert!(refused(&in_each).is_none() && refused(&in_all).is_some());
}
