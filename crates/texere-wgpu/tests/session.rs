//! Sessions on a device: readback, times and refusals. The conformance suite tests misuse and
//! edits.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may panic")]

mod support;

use std::ops::ControlFlow;
use std::time::Duration;

use texere_conformance::drive::Lent;
use texere_core::backend::{Chunk, MeshMut, Plan, Session, Traffic};
use texere_core::definitions::Ring;
use texere_core::{
    Backend, BackendError, Frame, Layout, Limits, MeshPiece, OutOfMemory, Quantum, Section, Settings, Vertex,
    Yarn,
};
use texere_cpu::SerialBackend;
use texere_wgpu::{Schedule, WgpuBackend};

use support::{INSTALL, backend, plan, waves};

const ROLLED: Settings = Settings {
    subdivisions: 1,
    sides: 6,
    frame: Frame::RotationMinimizing,
    topology: texere_core::Topology::Indexed,
    caps: true,
    quantum: Quantum::USUAL,
};

/// The only chunk of a small plan.
fn whole(plan: &Plan) -> Chunk {
    let mut chunks = plan.chunks(&Limits::NONE).unwrap();
    let chunk = chunks.next().unwrap();
    assert!(chunks.next().is_none());
    chunk
}

#[test]
fn reading_moves_the_results_and_no_more() {
    let yarns = waves(4, 100, Yarn::default());
    let plan = plan(&yarns, Settings::default());
    let chunk = whole(&plan);
    let mut session = backend().lending_session(plan).unwrap();
    session.upload(0, yarns.points()).unwrap();
    session.mesh(&chunk).unwrap();
    assert_eq!(session.traffic().read, 0);
    Lent::read(&mut session, &chunk).unwrap();
    let mesh = u64::from(chunk.vertices()) * 24 + u64::from(chunk.indices()) * 4;
    assert_eq!(session.traffic().read, mesh);
    let mut rings = 0;
    assert!(
        session
            .read_trajectory(&chunk, &mut |piece: &[Ring]| {
                rings += piece.len() as u32;
                ControlFlow::Continue(())
            })
            .unwrap()
            .is_continue()
    );
    assert_eq!(
        (rings, session.traffic().read),
        (chunk.rings(), mesh + u64::from(chunk.rings()) * size_of::<Ring>() as u64)
    );
    let Traffic { uploaded, .. } = session.traffic();
    assert_eq!(uploaded, 4 * 102 * 16);
}

#[test]
fn a_large_mesh_comes_in_pieces_and_a_break_ends_it() {
    // There are 130 MB of vertices and as much of indices, two pieces of each, so both buffers of
    // the readback are used again.
    let yarns = waves(45, 2_000, Yarn::default());
    let plan = plan(&yarns, Settings { subdivisions: 9, ..Settings::default() });
    let chunk = whole(&plan);
    let mut session = backend().lending_session(plan.clone()).unwrap();
    session.upload(0, yarns.points()).unwrap();
    session.mesh(&chunk).unwrap();

    let (mut pieces, mut vertices) = (0, 0);
    let answer = session.read_mesh(&chunk, &mut |piece| {
        let MeshPiece::Vertices { first, vertices: piece } = piece else { panic!("an index") };
        assert_eq!(first, vertices);
        (pieces, vertices) = (pieces + 1, vertices + piece.len() as u32);
        if pieces == 1 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert!(answer.unwrap().is_break());
    assert!(vertices < chunk.vertices());

    // The session still works.
    let mut vertices =
        vec![Vertex { position: [f32::NAN; 3], normal: [f32::NAN; 3] }; chunk.vertices() as usize];
    let mut indices = vec![u32::MAX; chunk.indices() as usize];
    session.mesh_into(&chunk, MeshMut { vertices: &mut vertices, indices: &mut indices }).unwrap();
    let mut gold = Session::new(&SerialBackend::new(), plan).unwrap();
    gold.upload(0, yarns.points()).unwrap();
    gold.mesh(&chunk).unwrap();
    let gold = Lent::read(&mut gold, &chunk).unwrap();
    assert_eq!(indices, gold.indices);
    for (ours, gold) in vertices.iter().zip(&gold.vertices) {
        for (ours, gold) in ours.position.iter().zip(gold.position) {
            assert!((ours - gold).abs() <= 2e-5 + 4.0 * f32::EPSILON * gold.abs(), "{ours} for {gold}");
        }
    }
}

#[test]
fn stages_are_timed_apart_however_often_they_run() {
    let yarns = waves(20, 500, Yarn { twist: 0.1, ..Yarn::default() });
    let plan = plan(&yarns, ROLLED);
    let chunk = whole(&plan);
    let mut session = backend().lending_session(plan).unwrap();
    session.upload(0, yarns.points()).unwrap();
    let uploaded = session.timings();
    assert_eq!([uploaded.scan, uploaded.trajectory, uploaded.mesh, uploaded.readback], [Duration::ZERO; 4]);
    session.scan().unwrap();
    // These are more launches than can be timed at once.
    for _ in 0..40 {
        session.mesh(&chunk).unwrap();
    }
    let meshed = session.timings();
    assert!(meshed.mesh > Duration::ZERO && meshed.trajectory == Duration::ZERO);
    session.trajectory(&chunk).unwrap();
    Lent::read(&mut session, &chunk).unwrap();
    let all = session.timings();
    assert!(all.trajectory > Duration::ZERO && all.mesh == meshed.mesh);
}

#[test]
fn more_points_than_a_buffer_holds_is_a_named_error() {
    let most = backend().device().limits().max_buffer_size;
    let points = most / 16 + 1;
    let layout = Layout::new(vec![Yarn::default()], vec![0, points], vec![Section::Circle]).unwrap();
    let plan = Plan::new(layout.into(), Settings { subdivisions: 0, ..Settings::default() }).unwrap();
    let Err(BackendError::OutOfMemory(OutOfMemory { what, bytes })) = backend().engine(plan.into()) else {
        panic!("no error")
    };
    assert_eq!((what, bytes), ("control points", (points + 2) * 16));
}

#[test]
fn the_schedule_per_yarn_refuses_under_its_own_name() {
    let plan = plan(&waves(1, 5, Yarn::default()), Settings { caps: true, ..Settings::default() });
    let refused = WgpuBackend::open(0, Schedule::PerYarn).expect(INSTALL).engine(plan).map(|_| ());
    let Err(error @ BackendError::Unsupported { .. }) = refused else { panic!("{refused:?}") };
    assert_eq!(error.to_string(), "wgpu:0/per-yarn does not do caps");
}
