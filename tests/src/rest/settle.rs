//! Turns starts into settling problems, and settled yarns back into plain points.

use std::ops::ControlFlow;
use std::sync::Arc;

use glam::DVec3;
use texere_core::settling::{self, Pass, Rest, Settling, SettlingPlan, SettlingSeen, settle, settled};
use texere_core::{Backend, Boundary, ControlPoint, Yarn, Yarns};

use super::{Ends, Length, Start};

/// The yarns of a start.
///
/// # Panics
///
/// If the yarns are refused.
#[must_use]
pub fn yarns(start: &Start) -> Yarns {
    let mut yarns = Yarns::builder();
    for yarn in &start.yarns {
        let closed = yarn.ends == Ends::Closed;
        let point = |at: &DVec3| ControlPoint::new(at.x as f32, at.y as f32, at.z as f32, yarn.radius as f32);
        yarns.yarn(Yarn { closed, ..Yarn::default() }, &yarn.points.iter().map(point).collect::<Vec<_>>());
    }
    yarns.build().expect("a start's yarns")
}

/// The plan for settling a start.
///
/// # Panics
///
/// If the plan is refused.
#[must_use]
pub fn settling_plan(start: &Start) -> Arc<SettlingPlan> {
    let yarns = yarns(start);
    let ends = start.yarns.iter().map(|yarn| match yarn.ends {
        Ends::Open => texere_core::Ends::Open,
        Ends::Closed => texere_core::Ends::Closed,
        Ends::Repeats(shift) => texere_core::Ends::Repeats(shift),
    });
    let offsets = yarns.layout().offsets();
    let pinned = start.pinned.iter().map(|&(yarn, point)| offsets[yarn] + point as u64).collect();
    let length = match start.length {
        Length::Held => settling::Length::Held,
        Length::Given(factor) => settling::Length::Given(factor as f32),
        Length::Free => settling::Length::Free { tension: 0.0 },
    };
    let repeat = start.repeat.map(|repeat| repeat as f32);
    let boundary = Boundary::new(yarns.layout(), repeat, ends.collect()).expect("a start's boundary");
    let settling = Settling::new(&yarns).boundary(boundary).pinned(pinned).length(length);
    Arc::new(SettlingPlan::new(&settling).expect("a start's plan"))
}

/// Settles a start on a device, and calls `watch` after each pass. Returns the result and the
/// points of each yarn.
///
/// # Panics
///
/// If the device fails.
#[must_use]
pub fn settle_start(
    start: &Start,
    device: &dyn Backend,
    mut watch: impl FnMut(&Pass, &SettlingSeen),
) -> (Rest, Vec<Vec<DVec3>>) {
    let plan = settling_plan(start);
    let mut settler = device.settler(Arc::clone(&plan)).expect("a settler");
    let rest = settle(&plan, settler.as_mut(), |pass, seen| {
        if let Some(seen) = seen {
            watch(pass, seen);
        }
        ControlFlow::Continue(())
    });
    let rest = rest.expect("a settling");
    let points = settled(&plan, settler.as_mut(), yarns(start).points()).expect("points");
    let mut points = points.iter().map(|point| point.position().as_dvec3());
    let yarns = start.yarns.iter().map(|yarn| points.by_ref().take(yarn.points.len()).collect());
    (rest, yarns.collect())
}
