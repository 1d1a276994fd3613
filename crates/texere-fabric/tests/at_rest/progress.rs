//! Progress of cloth that comes to rest.

use std::ops::ControlFlow;

use texere_cpu::ParallelBackend;
use texere_fabric::{FabricError, Finish, FinishError};

use crate::cloths;

/// Once surfaces are measured, the threads of the whole cloth are placed, which takes longest for a
/// large cloth of a small repeat. Placing reports its progress, and nothing after `Break`.
#[test]
fn placing_threads_tells_its_progress_and_ends_within_a_thread() {
    let sheeting = cloths().swap_remove(2).woven;
    let device = ParallelBackend::open().unwrap();
    let mut told = 0;
    let refused = sheeting.at_rest(&Finish::default(), 0.0, &device, |share| {
        told += u32::from(share > 0.951 && share < 1.0);
        if told == 3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert!(matches!(refused, Err(FinishError::Fabric(FabricError::Cancelled))), "{refused:?}");
    assert_eq!(told, 3);
}
