//! Cloth that is stretched in one direction.

use std::ops::ControlFlow;

use texere_core::crossings::Set;
use texere_cpu::ParallelBackend;
use texere_fabric::{FabricError, Finish, FinishError, Stretch, Woven};

use crate::surfaces::Surfaces;
use crate::{cloths, finished};

fn stretched(cloth: &Woven, along: Set, by: f64) -> Result<(Woven, Finish), FinishError> {
    let device = ParallelBackend::open().unwrap();
    cloth.stretched(&Finish::default(), Stretch { along, by }, 0.0, &device, |_| ControlFlow::Continue(()))
}

/// Threads keep their lengths, which the test measures along yarns at rest. Cloth that is pulled
/// longer becomes narrower, because the threads across need more length for their crimp. Cloth that
/// is made shorter becomes wider.
#[test]
fn threads_keep_their_length() {
    for (name, along, by) in [
        ("sheeting", Set::Warp, 1.03),
        ("sheeting", Set::Weft, 1.03),
        ("poplin", Set::Warp, 1.05),
        ("poplin", Set::Weft, 0.99),
        ("drill", Set::Warp, 1.04),
    ] {
        let cloth = cloths().into_iter().find(|cloth| cloth.name == name).unwrap().woven;
        let (pulled, finish) = stretched(&cloth, along, by).unwrap();
        let before = Surfaces::new(&finished(&cloth, &Finish::default()).yarns).crimp();
        let rest = finished(&pulled, &finish);
        let surfaces = Surfaces::new(&rest.yarns);
        let (after, clearance) = (surfaces.crimp(), surfaces.clearance());
        let [size, pulled_size] = [&cloth, &pulled].map(Woven::size_mm);
        // Ends run along y, picks along x.
        let longer = [pulled_size[1] / size[1], pulled_size[0] / size[0]];
        println!(
            "{name} {along:?} {by}: {longer:?}, crimp {before:?} to {after:?}, {clearance:.3}, taut {:?}",
            finish.taut
        );
        let set = along as usize;
        assert!((longer[set] - by).abs() < 1e-9);
        assert!((longer[1 - set] < 1.0) == (by > 1.0), "{name}: {longer:?}");
        for set in 0..2 {
            let kept = longer[set] * (1.0 + after[set]) / (1.0 + before[set]);
            assert!((kept - 1.0).abs() < 2e-3, "{name}: {kept} of their length");
        }
        assert!(clearance >= 0.98, "{name}: {clearance}");
    }
}

/// Cloth is stretched neither beyond straight threads nor by factors outside the limits. The error
/// says at which factor threads are straight.
#[test]
fn straight_threads_stretch_no_further() {
    let sheeting = cloths().swap_remove(2).woven;
    for by in [1.09, 0.4, f64::NAN, f64::INFINITY, -1.0] {
        let refused = stretched(&sheeting, Set::Warp, by).unwrap_err().to_string();
        assert!(refused.contains("straight at 1.07"), "{refused}");
    }
}

/// Progress is reported long before the cloth is first at rest, and never goes back. `Break` ends
/// the call at once.
#[test]
fn stretching_tells_its_progress_and_ends_within_a_pass() {
    let sheeting = cloths().swap_remove(2).woven;
    let device = ParallelBackend::open().unwrap();
    let pull = Stretch { along: Set::Warp, by: 1.03 };
    let mut shares = Vec::new();
    let refused = sheeting.stretched(&Finish::default(), pull, 0.0, &device, |share| {
        shares.push(share);
        if shares.len() == 5 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert!(matches!(refused, Err(FinishError::Fabric(FabricError::Cancelled))), "{refused:?}");
    assert_eq!(shares.len(), 5);
    // The first report comes within the first pass.
    assert!(shares[0] == 0.0 && shares[1] > 0.0 && shares[4] < 0.01 && shares.is_sorted(), "{shares:?}");
    let mut last = 0.0;
    let whole = sheeting.stretched(&Finish::default(), pull, 0.0, &device, |share| {
        assert!((last..=1.0 + 1e-9).contains(&share), "{share} after {last}");
        last = share;
        ControlFlow::Continue(())
    });
    whole.unwrap();
}
