//! The schedule per-yarn: what it does agrees with the oracle, and the rest it refuses.

use crate::support::{device, plan};
use texere_conformance::{cases, check};
use texere_core::{Backend, BackendError, ControlPoint, Frame, Settings, Topology, Yarn, Yarns};
use texere_opencl::Schedule;

/// Open, untwisted yarns of 2 to 200 points with slubs and bends.
fn open_yarns() -> Yarns {
    let mut yarns = Yarns::builder();
    for points in [2, 3, 33, 65, 200] {
        let points: Vec<_> = (0..points)
            .map(|k| {
                let (sin, cos) = (0.7 * k as f32).sin_cos();
                ControlPoint::new(
                    k as f32,
                    points as f32 + sin,
                    0.5 * cos,
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
        (device.info().name.as_str(), device.info().schedule.as_str()),
        ("opencl:0/per-yarn", "per-yarn")
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
    // 65 rings: a block of 64, and one of the last ring. Two rows a chunk leave the last ring for a chunk of its own.
    let yarns = cases::winding(65, Yarn::default());
    let settings = Settings { subdivisions: 0, ..Settings::default() };
    let report = check(&yarns, settings, &device(Schedule::PerYarn), false).unwrap();
    assert!(report.is_clean(), "{report}");
}

#[test]
fn what_it_does_not_do_is_refused_by_name() {
    let device = device(Schedule::PerYarn);
    let refused = |yarn: Yarn, settings: Settings| {
        let yarns = cases::winding(10, yarn);
        match device.session(plan(&yarns, settings)) {
            Err(BackendError::Unsupported { schedule, what }) => {
                assert_eq!(schedule, "opencl:0/per-yarn");
                what
            }
            other => panic!("{other:?}"),
        }
    };
    let (plain, usual) = (Yarn::default(), Settings::default());
    let turning = Settings { frame: Frame::RotationMinimizing, ..usual };
    assert_eq!(refused(plain, turning), "the rotation-minimising frame");
    assert_eq!(refused(plain, Settings { caps: true, ..usual }), "caps");
    assert_eq!(refused(Yarn { closed: true, ..plain }, usual), "closed yarns, such as yarn 0");
    assert_eq!(refused(Yarn { twist: 1.0, ..plain }, usual), "twist, such as that of yarn 0");
}
