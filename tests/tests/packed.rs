//! Packed vertices on every backend, and the rounding of packing.

use std::ops::ControlFlow;
use std::sync::Arc;

use glam::DVec3;
use proptest::prelude::*;
use rayon::prelude::*;
use texere_conformance::cases::{self, Case};
use texere_conformance::{check_packed, near_devices};
use texere_core::backend::{Plan, Schedule, Session, SessionError};
use texere_core::{
    Backend, BackendError, ControlPoint, Limits, PackedVertex, Pipeline, PipelineError, Quantum, Settings,
    Vertex, Yarn, Yarns,
};
use texere_cpu::{ParallelBackend, SerialBackend};

/// The cases that are quick on each device.
fn small() -> Vec<Case> {
    cases::all().into_iter().filter(|case| case.yarns().points().len() <= 500).collect()
}

/// A quantum that is large enough to reach from one end of any yarn to the other, for any spline.
fn quantum(yarns: &Yarns) -> Quantum {
    let extent = |yarn: usize| {
        let points = yarns.yarn_points(yarn).unwrap_or_default();
        let middle = points[0].position();
        let reach = |point: &ControlPoint| {
            point.position().distance(middle) + 4.0 * point.half_width().max(point.half_height())
        };
        points.iter().map(reach).fold(0.0, f32::max)
    };
    Quantum::reaching(2.0 * (0..yarns.layout().yarns().len()).map(extent).fold(0.0, f32::max))
}

#[test]
fn packed_vertices_are_the_meshs_on_every_backend_and_however_it_is_cut() {
    let serial = SerialBackend::new();
    let cases = small();
    let in_chunks = |case: &Case| {
        let yarns = case.yarns();
        let settings = Settings { quantum: quantum(&yarns), ..case.settings };
        let plan = Plan::new(yarns.layout().clone(), settings).unwrap();
        let limits = case.tight.limits(&plan, 1);
        let check = |device: &dyn Backend, exact| {
            check_packed(&yarns, settings, &limits, device, exact)
                .unwrap_or_else(|error| panic!("{} on {}: {error}", case.name, device.info().name));
        };
        check(&serial, true);
        let packed = |device: &dyn Backend| Pipeline::new(&yarns).settings(settings).packed(device).unwrap();
        let gold = packed(&serial);
        for device in ParallelBackend::each() {
            assert!(packed(&device) == gold, "{} on {}", case.name, device.info().name);
        }
        near_devices().iter().for_each(|device| check(&**device, false));
        plan.chunks(&limits).unwrap().nth(1).is_some()
    };
    let cut = cases.par_iter().filter(|case| in_chunks(case)).count();
    assert!(cases.len() > 50 && cut > 10, "{} cases, {cut} of them in several chunks", cases.len());
}

/// A large cloth has runs of blocks whose vertices bypass the caches, and cache lines that two runs
/// share.
#[test]
fn a_large_cloth_is_packed_as_its_mesh() {
    let yarns = cases::design("paper/489x450.toml").yarns().unwrap();
    for sides in [6, 5] {
        let settings = Settings { sides, topology: texere_core::Topology::None, ..Settings::default() };
        let pipeline = || Pipeline::new(&yarns).settings(settings);
        let mesh = pipeline().mesh(&SerialBackend::new()).unwrap();
        let gold: Vec<_> =
            mesh.vertices.iter().map(|vertex| PackedVertex::pack(vertex, settings.quantum)).collect();
        assert!(size_of_val(&gold[..]) > 32 << 20, "no stores go past the caches");
        for device in ParallelBackend::each() {
            assert!(pipeline().packed(&device).unwrap() == gold, "{}", device.info().name);
        }
    }
}

/// A yarn of ten metres. Each block is unpacked near its own control point, and packed coordinates
/// wrap round many times along the yarn.
#[test]
fn a_cloth_may_be_larger_than_the_quantum_reaches() {
    let points: Vec<_> =
        (0..10_000).map(|x| ControlPoint::new(x as f32, (x as f32).sin(), 0.0, 0.25)).collect();
    let mut yarns = Yarns::builder();
    yarns.yarn(Yarn::default(), &points);
    let yarns = yarns.build().unwrap();
    let settings = Settings { quantum: Quantum::reaching(50.0), ..Settings::default() };
    assert!(settings.quantum.reach() < 100.0);
    let limits = Limits { blocks: 7, ..Limits::NONE };
    check_packed(&yarns, settings, &limits, &SerialBackend::new(), true).unwrap();
    for device in near_devices() {
        check_packed(&yarns, settings, &limits, &**device, false).unwrap();
    }
}

#[test]
fn what_packs_nothing_says_so_and_packed_vertices_are_read_once_they_are_made() {
    let device = SerialBackend::new();
    let yarns = cases::winding(100, Yarn { twist: 1.0, ..Yarn::default() });
    let plan = Arc::new(Plan::new(yarns.layout().clone(), Settings::default()).unwrap());
    let chunk = plan.chunks(&device.info().limits).unwrap().next().unwrap();
    let mut session = Session::new(&device, plan).unwrap();
    session.upload(0, yarns.points()).unwrap();
    let early = session.packed(&chunk);
    assert!(matches!(early, Err(SessionError::OutOfOrder { call: "packed", needed: "scan" })), "{early:?}");
    session.scan().unwrap();
    let read = |session: &mut Session| session.read_packed(&chunk, &mut |_, _| ControlFlow::Continue(()));
    session.mesh(&chunk).unwrap();
    assert!(matches!(read(&mut session), Err(SessionError::NotInFlight { .. })));
    session.packed(&chunk).unwrap();
    assert!(read(&mut session).is_ok());
    session.upload(0, &yarns.points()[..1]).unwrap();
    assert!(matches!(read(&mut session), Err(SessionError::NotInFlight { .. })));

    let plain = cases::winding(100, Yarn::default());
    let entries = texere_conformance::REGISTRY.iter().flat_map(|entry| entry.devices().0);
    for device in entries.filter(|device| device.info().schedule == Schedule::PerYarn) {
        let refused = Pipeline::new(&plain).packed(&*device).unwrap_err();
        assert!(matches!(refused, PipelineError::Backend(BackendError::NoPacking)), "{refused:?}");
    }
}

#[test]
fn the_finest_quantum_that_reaches_is_chosen() {
    for exponent in -24..=11 {
        let mm = 2f64.powi(exponent);
        let reach = mm * f64::from((1 << 20) - 2);
        let quantum = Quantum::reaching(reach as f32);
        assert_eq!((f64::from(quantum.mm()), f64::from(quantum.reach())), (mm, reach));
        assert_eq!(f64::from(quantum.per_mm()), 1.0 / mm);
    }
    assert_eq!(Quantum::reaching(-1.0).mm(), 2f32.powi(-24));
    assert_eq!(Quantum::reaching(f32::NAN).mm(), 2048.0);
    // The extent of all coordinates.
    assert!(Quantum::reaching(f32::INFINITY).reach() >= 2.0 * texere_core::COORDINATE_LIMIT);
}

/// The angle between a normal and its unpacked value, rad.
fn turned(normal: DVec3) -> f64 {
    let packed = PackedVertex::pack(
        &Vertex { position: [0.0; 3], normal: normal.as_vec3().to_array() },
        Quantum::USUAL,
    );
    let unpacked = DVec3::from(packed.unpack([0.0; 3], Quantum::USUAL).normal.map(f64::from));
    assert!((unpacked.length() - 1.0).abs() < 1e-6, "{normal} becomes {unpacked}");
    normal.cross(unpacked).length().atan2(normal.dot(unpacked))
}

/// Normals on the axes, edges and faces of the octahedron: on its folds, and where a step turns a
/// normal most.
#[test]
fn normals_at_the_folds_keep_their_direction() {
    let mut most = 0.0f64;
    for x in -50i32..=50 {
        for y in -50i32..=50 {
            for z in [-50, -1, 0, 1, 50] {
                for jitter in [0.0, 1e-6, -1e-6] {
                    let normal = DVec3::new(f64::from(x) + jitter, y.into(), z.into());
                    if normal.length() > 0.5 {
                        most = most.max(turned(normal.normalize()));
                    }
                }
            }
        }
    }
    // The error is not so small that nothing was rounded.
    assert!((5e-5..6.6e-5).contains(&most), "{most}");
    for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
        assert_eq!([turned(axis), turned(-axis)], [0.0; 2], "{axis}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 20_000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn normals_are_turned_by_no_more_than_is_said(x in -1.0f64..1.0, y in -1.0f64..1.0, z in -1.0f64..1.0) {
        let normal = DVec3::new(x, y, z);
        prop_assume!(normal.length() > 1e-3);
        let turned = turned(normal.normalize());
        prop_assert!(turned <= 6.6e-5, "{} is turned by {}", normal.normalize(), turned);
    }

    #[test]
    fn positions_are_rounded_by_half_a_quantum_and_alike_near_any_place(
        position in prop::array::uniform3(prop_oneof![-1e9f32..1e9, -300.0f32..300.0, -1e-3f32..1e-3]),
        // proptest 1.12 may fail an assertion of its own where the lower bound of a range has finer
        // binary digits than the upper one. The range therefore starts at 0.
        reach in prop_oneof![0.0f32..1e3, 0.0f32..1e9].prop_map(|reach| reach.max(1e-2)),
        shares in prop::array::uniform2(prop::array::uniform3(-1.0f64..1.0)),
    ) {
        let quantum = Quantum::reaching(reach);
        let packed = PackedVertex::pack(&Vertex { position, normal: [0.0, 0.0, 1.0] }, quantum);
        prop_assert_eq!(packed.position[1] >> 31, 0);
        // A place within the quantum's reach of the position. None if rounding to f32 takes it
        // beyond the reach.
        let near = |shares: [f64; 3]| {
            let near: [f32; 3] = std::array::from_fn(|axis| {
                (f64::from(position[axis]) + shares[axis] * f64::from(quantum.reach())) as f32
            });
            let apart = (0..3).map(|axis| (f64::from(near[axis]) - f64::from(position[axis])).abs());
            apart.fold(0.0, f64::max).le(&f64::from(quantum.reach())).then_some(near)
        };
        let unpacked: Vec<_> = shares.into_iter().filter_map(near).map(|near| packed.unpack(near, quantum)).collect();
        for vertex in &unpacked {
            for axis in 0..3 {
                let off = (f64::from(vertex.position[axis]) - f64::from(position[axis])).abs();
                prop_assert!(off <= 0.5 * f64::from(quantum.mm()), "{:?} becomes {:?}", position, vertex.position);
            }
        }
        if let [one, other] = unpacked[..] {
            prop_assert_eq!(one.position.map(f32::to_bits), other.position.map(f32::to_bits));
        }
    }
}
