//! Sessions on a device: pieces, memory and refusals. The conformance suite tests misuse, edits and
//! times.

use std::ops::ControlFlow;
use std::process::Command;

use crate::support::{device, plan, read, waves};
use texere_conformance::cases;
use texere_core::backend::{Chunk, MeshMut, PaddedPoints, Session};
use texere_core::definitions::Ring;
use texere_core::{
    Backend, BackendError, Frame, Limits, MeshPiece, OutOfMemory, Quantum, Settings, Topology, Vertex, Yarn,
};
use texere_cpu::SerialBackend;
use texere_opencl::{OpenClBackend, OpenClError, Schedule};

const TURNING: Settings = Settings {
    subdivisions: 3,
    sides: 6,
    frame: Frame::RotationMinimizing,
    topology: Topology::Indexed,
    caps: true,
    quantum: Quantum::USUAL,
};

fn distance(a: [f32; 3], b: [f32; 3]) -> f32 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f32>().sqrt()
}

fn chunks(plan: &texere_core::backend::Plan, blocks: u64) -> Vec<Chunk> {
    plan.chunks(&Limits { blocks, ..Limits::NONE }).unwrap().collect()
}

#[test]
fn a_long_yarn_comes_in_pieces_and_equals_the_serial_backend() {
    // 100,001 rings with seven sides have 16.8 MB of vertices and as much of indices, slightly more
    // than a piece, so there are two pieces of each.
    let yarns = cases::winding(12_501, Yarn { twist: 0.3, ..Yarn::default() });
    let settings = Settings { subdivisions: 7, sides: 7, ..TURNING };
    let plan = plan(&yarns, settings);
    assert_eq!(plan.counts().rings, 100_001);
    let device = device(Schedule::PerRing);
    let chunk = &chunks(&plan, u64::MAX)[0];
    let mut session = Session::new(&device, plan.clone()).unwrap();
    session.upload(0, yarns.points()).unwrap();
    session.scan().unwrap();
    session.mesh(chunk).unwrap();
    let (vertices, indices, pieces) = read(&mut session, chunk);
    assert_eq!(pieces, 4);

    let nan = Vertex { position: [f32::NAN; 3], normal: [f32::NAN; 3] };
    let mut direct = (vec![nan; vertices.len()], vec![u32::MAX; indices.len()]);
    session.mesh_into(chunk, MeshMut { vertices: &mut direct.0, indices: &mut direct.1 }).unwrap();
    assert_eq!(direct, (vertices.clone(), indices.clone()));

    let mut gold = Session::new(&SerialBackend::new(), plan.clone()).unwrap();
    gold.upload(0, yarns.points()).unwrap();
    gold.scan().unwrap();
    gold.mesh(chunk).unwrap();
    let (gold_vertices, gold_indices, _) = read(&mut gold, chunk);
    assert_eq!(indices, gold_indices);
    let worst = vertices.iter().zip(&gold_vertices).flat_map(|(a, b)| {
        a.position.into_iter().chain(a.normal).zip(b.position.into_iter().chain(b.normal))
    });
    for (found, expected) in worst {
        // The bound is four units in the last place of a coordinate of 2,100 mm.
        assert!((found - expected).abs() < 1e-3, "{found} for {expected}");
    }
}

#[test]
fn more_rings_than_one_launch_takes_come_out_as_one() {
    // 2^24 rings fill a launch. These rings need a second launch.
    let yarns = cases::winding(16_500, Yarn::default());
    let plan = plan(&yarns, Settings { subdivisions: 1023, ..Settings::default() });
    let rings = plan.counts().rings as usize;
    assert!(rings > 1 << 24);
    let chunk = &chunks(&plan, u64::MAX)[0];
    let mut session = Session::new(&device(Schedule::PerRing), plan.clone()).unwrap();
    session.upload(0, yarns.points()).unwrap();
    session.trajectory(chunk).unwrap();

    let mut padded = PaddedPoints::new(&plan).unwrap();
    padded.upload(&plan, 0, yarns.points());
    let mut seen = 0;
    let _ = session
        .read_trajectory(chunk, &mut |piece| {
            for (number, ring) in (seen..).zip(piece).filter(|(number, _)| number % 997 == 0) {
                let expected =
                    plan.sampling().sample(padded.points(), number as u32, rings as u32, false).sample;
                let off = distance(ring.centre, expected.centre.to_array());
                assert!(off < 1e-2, "ring {number}: {ring:?} for {expected:?}");
            }
            seen += piece.len();
            ControlFlow::Continue(())
        })
        .unwrap();
    assert_eq!(seen, rings);
}

#[test]
fn control_points_are_zero_until_they_are_uploaded() {
    let yarns = cases::winding(100, Yarn::default());
    let plan = plan(&yarns, Settings::default());
    let chunk = &chunks(&plan, u64::MAX)[0];
    let mut session = Session::new(&device(Schedule::PerRing), plan).unwrap();
    session.mesh(chunk).unwrap();
    let (vertices, ..) = read(&mut session, chunk);
    assert!(vertices.iter().all(|vertex| vertex.position == [0.0; 3]));
}

#[test]
fn a_sink_may_break_off_at_any_piece() {
    let yarns = cases::winding(12_501, Yarn::default());
    let plan = plan(&yarns, Settings { subdivisions: 7, sides: 8, frame: Frame::Upright, ..TURNING });
    let chunk = &chunks(&plan, u64::MAX)[0];
    let mut session = Session::new(&device(Schedule::PerRing), plan).unwrap();
    session.upload(0, yarns.points()).unwrap();
    session.mesh(chunk).unwrap();
    let (vertices, indices, pieces) = read(&mut session, chunk);
    for last in 1..=pieces {
        let mut seen = 0;
        let flow = session.read_mesh(chunk, &mut |_| {
            seen += 1;
            if seen == last { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        assert_eq!((flow.unwrap(), seen), (ControlFlow::Break(()), last));
    }
    let mut rings = 0;
    let flow = session.read_trajectory(chunk, &mut |piece: &[Ring]| {
        rings += piece.len();
        ControlFlow::Break(())
    });
    assert!(flow.unwrap().is_break() && rings > 0);
    // A complete read afterwards gives the whole mesh.
    let again = read(&mut session, chunk);
    assert_eq!((again.0, again.1), (vertices, indices));
}

#[test]
fn control_points_beyond_one_buffer_are_refused() {
    let yarns = cases::winding(100, Yarn::default());
    let plan = plan(&yarns, Settings::default());
    let small = Limits { binding_bytes: plan.resident_bytes() - 1, ..Limits::NONE };
    let device = device(Schedule::PerRing).with_limits(small);
    assert_eq!(device.info().limits.binding_bytes, small.binding_bytes);
    let refused = device.engine(plan).map(|_| ());
    assert!(
        matches!(
            refused,
            Err(BackendError::OutOfMemory(OutOfMemory {
                what: "control points, all in one buffer",
                bytes: 1632
            }))
        ),
        "{refused:?}"
    );
}

#[test]
fn devices_have_names_that_open_them() {
    let devices = OpenClBackend::devices().unwrap();
    for (index, info) in devices.iter().enumerate() {
        assert_eq!(info.name, format!("opencl:{index}"));
        assert!(info.limits.binding_bytes <= info.memory_bytes.unwrap());
        assert_eq!(OpenClBackend::open(index, Schedule::PerRing).unwrap().info(), info);
    }
    let refused = OpenClBackend::open(0, Schedule::Serial).unwrap_err();
    assert_eq!(refused.to_string(), "opencl:0 does not do the serial schedule");
    let missing = OpenClBackend::open(devices.len(), Schedule::PerYarn).map(|_| ());
    let Err(BackendError::NoDevice { wanted, found }) = missing else { panic!("{missing:?}") };
    assert_eq!(wanted, format!("opencl:{}/per-yarn", devices.len()));
    assert!(found.contains(&"opencl:0/per-yarn".to_owned()));
}

#[test]
fn no_platform_is_an_error_with_a_name() {
    let child = Command::new(std::env::current_exe().unwrap())
        .args(["--ignored", "--exact", "session::without_a_platform"])
        .env("OCL_ICD_VENDORS", "/nowhere")
        .env("OCL_ICD_FILENAMES", "")
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&child.stdout);
    assert!(child.status.success() && said.contains("1 passed"), "{said}");
}

#[test]
#[ignore = "run by no_platform_is_an_error_with_a_name, in a process without a platform"]
fn without_a_platform() {
    let Err(BackendError::Driver { call: "clGetPlatformIDs", source }) = OpenClBackend::devices() else {
        panic!("a platform was found");
    };
    assert_eq!(source.downcast_ref(), Some(&OpenClError::NoPlatform));
}

#[test]
fn pieces_hold_vertices_first() {
    let yarns = cases::winding(10, Yarn::default());
    for topology in [Topology::Shared, Topology::None] {
        let plan = plan(&yarns, Settings { topology, ..Settings::default() });
        let chunk = &chunks(&plan, u64::MAX)[0];
        let mut session = Session::new(&device(Schedule::PerRing), plan).unwrap();
        session.upload(0, yarns.points()).unwrap();
        session.scan().unwrap();
        session.mesh(chunk).unwrap();
        let _ = session
            .read_mesh(chunk, &mut |piece| {
                assert!(matches!(piece, MeshPiece::Vertices { .. }), "{piece:?}");
                ControlFlow::Continue(())
            })
            .unwrap();
    }
}

#[test]
fn memory_is_what_the_plan_says() {
    let yarns = waves();
    for (frame, caps, blocks) in [(Frame::Upright, false, u64::MAX), (Frame::RotationMinimizing, true, 5)] {
        for topology in [Topology::Indexed, Topology::Shared] {
            let limits = Limits { blocks, ..Limits::NONE };
            let device = device(Schedule::PerRing).with_limits(limits);
            let limits = device.info().limits;
            let plan = plan(&yarns, Settings { frame, caps, topology, sides: 5, ..Settings::default() });
            let mut session = device.lending_session(plan.clone()).unwrap();
            session.upload(0, yarns.points()).unwrap();
            session.scan().unwrap();
            for chunk in plan.chunks(&limits).unwrap() {
                session.mesh(&chunk).unwrap();
            }
            let planned: u64 =
                texere_gpu::device_buffers(&plan, &limits).unwrap().iter().map(|(_, bytes)| bytes).sum();
            assert_eq!(session.device_bytes(), planned);
        }
    }
}
