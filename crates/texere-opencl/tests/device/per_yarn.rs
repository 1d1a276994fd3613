//! The schedule per-yarn. Its meshes agree with the oracle, and it refuses plans that it can't
//! make.

use crate::support::{device, plan};
use texere_conformance::{cases, check};
use texere_core::{Backend, BackendError, ControlPoint, Settings, Topology, Yarn, Yarns};
use texere_opencl::Schedule;

/// Open, untwisted yarns of 2 to 200 points with slubs and bends, none of them steep.
fn open_yarns() -> Yarns {
    let mut yarns = Yarns::builder();
    for points in [2, 3, 33, 65, 200] {
        let points: Vec<_> = (0..points)
            .map(|k| {
                let (sin, cos) = (0.7 * k as f32).sin_cos();
                ControlPoint::new(
                    k as f32,
                    points as f32 + sin,
                    0.02 * cos,
                    0.2 + 0.1 * (1.3 * k as f32).sin(),
                )
            })
            .collect();
        yarns.yarn(Yarn::default(), &points);
    }
    yarns.build().unwrap()
}

#[test]
fn what_it_does_agrees_with_the_oracle() {
    let device = device(Schedule::PerYarn);
    assert_eq!(
        (device.info().name.as_str(), device.info().schedule),
        ("opencl:0/per-yarn", Schedule::PerYarn)
    );
    for (subdivisions, sides) in [(0, 3), (1, 6), (2, 7), (3, 16), (8, 5)] {
        for topology in [Topology::Indexed, Topology::Shared, Topology::None] {
            let settings = Settings { subdivisions, sides, topology, ..Settings::default() };
            let report = check(&open_yarns(), settings, &device, false).unwrap();
            assert!(report.is_clean(), "{settings:?}: {report}");
        }
    }
}

#[test]
fn a_lane_cut_at_a_yarns_last_ring_takes_that_ring_alone() {
    // There are 65 rings: a block of 64, and a block of the last ring. Among the chunks that
    // `check` makes are some of two rows, which leave the last ring to a chunk of its own.
    let yarns = cases::winding(65, Yarn::default());
    let settings = Settings { subdivisions: 0, ..Settings::default() };
    let report = check(&yarns, settings, &device(Schedule::PerYarn), false).unwrap();
    assert!(report.is_clean(), "{report}");
}

#[test]
fn it_refuses_under_its_own_name() {
    let plan = plan(&cases::winding(10, Yarn::default()), Settings { caps: true, ..Settings::default() });
    let refused = device(Schedule::PerYarn).engine(plan).map(|_| ());
    let Err(error @ BackendError::Unsupported { .. }) = refused else { panic!("{refused:?}") };
    assert_eq!(error.to_string(), "opencl:0/per-yarn does not do caps");
}
