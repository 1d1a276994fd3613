//! Misuse of a session gives the same error on every backend, and leaves the session unchanged.

use std::ops::ControlFlow;
use std::sync::Arc;

use texere_conformance::schedule::able_devices;
use texere_core::backend::{Chunk, MeshMut, NullBackend, Plan, Session, SessionError, Slot};
use texere_core::{
    Backend, BackendError, ControlPoint, Frame, Limits, Pipeline, Settings, Vertex, Yarn, Yarns,
};

/// Control points a millimetre apart.
fn straight(points: usize) -> Vec<ControlPoint> {
    (0..points).map(|k| ControlPoint::new(k as f32, 0.0, 0.0, 0.1)).collect()
}

/// Calls `check` for a twisted yarn of several blocks, on every device that can make its mesh and
/// on the null device. The session has the yarn's points, but no scan yet.
fn on_every_device(check: impl Fn(&dyn Backend, &Arc<Plan>, &[Chunk], Session)) {
    let points = straight(200);
    let mut yarns = Yarns::builder();
    yarns.yarn(Yarn { twist: 1.0, ..Yarn::default() }, &points);
    let yarns = yarns.build().unwrap();
    let settings = Settings { frame: Frame::RotationMinimizing, ..Settings::default() };
    let plan = Arc::new(Plan::new(yarns.layout().clone(), settings).unwrap());
    let null: Arc<dyn Backend> = Arc::new(NullBackend::default());
    for device in able_devices(&yarns, &settings).chain([null]) {
        let limits = device.info().limits.min(&Limits { blocks: 2, ..Limits::NONE });
        let chunks: Vec<_> = plan.chunks(&limits).unwrap().collect();
        let mut session = Session::new(&*device, plan.clone()).unwrap();
        session.upload(0, &points).unwrap();
        check(&*device, &plan, &chunks, session);
    }
}

fn read_nothing(session: &mut Session, chunk: &Chunk) -> [Result<ControlFlow<()>, SessionError>; 2] {
    [
        session.read_trajectory(chunk, &mut |_| panic!("lent rings")),
        session.read_mesh(chunk, &mut |_| panic!("lent a mesh")),
    ]
}

#[test]
fn an_upload_past_the_last_point() {
    on_every_device(|device, _, _, mut session| {
        for (first, count) in [(0, 201), (199, 2), (200, 1), (u64::MAX, 2), (1 << 40, 1)] {
            let error = session.upload(first, &straight(count)).unwrap_err();
            assert!(
                matches!(error, SessionError::UploadRange { first: named, points: 200, .. } if named == first),
                "{}: {error:?}",
                device.info().name
            );
        }
        session.upload(200, &[]).unwrap();
    });
}

#[test]
fn a_stage_before_its_scan() {
    on_every_device(|device, _, chunks, mut session| {
        let name = &device.info().name;
        let mut vertices = vec![Vertex::default(); chunks[0].vertices() as usize];
        let mut indices = vec![0; chunks[0].indices() as usize];
        let out = MeshMut { vertices: &mut vertices, indices: &mut indices };
        let calls = [
            ("trajectory", session.trajectory(&chunks[0])),
            ("mesh", session.mesh(&chunks[0])),
            ("mesh", session.mesh_into(&chunks[0], out)),
        ];
        for (named, result) in calls {
            let error = result.unwrap_err();
            assert!(
                matches!(error, SessionError::OutOfOrder { call, needed: "scan" } if call == named),
                "{name}: {error:?}"
            );
        }
        // New points make the old scan invalid.
        session.scan().unwrap();
        session.mesh(&chunks[0]).unwrap();
        session.upload(3, &straight(2)).unwrap();
        let error = session.mesh(&chunks[0]).unwrap_err();
        assert!(matches!(error, SessionError::OutOfOrder { needed: "scan", .. }), "{name}: {error:?}");
    });
}

#[test]
fn a_chunk_that_is_not_in_flight() {
    on_every_device(|device, _, chunks, mut session| {
        let name = &device.info().name;
        session.scan().unwrap();
        for result in read_nothing(&mut session, &chunks[1]) {
            assert!(matches!(result, Err(SessionError::NotInFlight { chunk: 1 })), "{name}: {result:?}");
        }
        // Rings alone are no mesh.
        session.trajectory(&chunks[2]).unwrap();
        let result = session.read_mesh(&chunks[2], &mut |_| panic!("lent a mesh"));
        assert!(matches!(result, Err(SessionError::NotInFlight { chunk: 2 })), "{name}: {result:?}");
    });
}

#[test]
fn slices_of_another_length() {
    on_every_device(|device, _, chunks, mut session| {
        session.scan().unwrap();
        let (chunk, name) = (&chunks[0], &device.info().name);
        let (right_vertices, right_indices) = (chunk.vertices() as usize, chunk.indices() as usize);
        for (vertices, indices, wrong) in [
            (right_vertices - 1, right_indices, "vertices"),
            (right_vertices + 1, right_indices, "vertices"),
            (0, right_indices, "vertices"),
            (right_vertices, right_indices - 1, "indices"),
            (right_vertices, right_indices + 1, "indices"),
        ] {
            let (mut vertices, mut indices) = (vec![Vertex::default(); vertices], vec![7; indices]);
            let out = MeshMut { vertices: &mut vertices, indices: &mut indices };
            let error = session.mesh_into(chunk, out).unwrap_err();
            assert!(
                matches!(error, SessionError::OutputLength { what, .. } if what == wrong),
                "{name}: {error:?}"
            );
            let untouched = vertices.iter().all(|&vertex| vertex == Vertex::default());
            assert!(untouched && indices.iter().all(|&index| index == 7), "{name}: half-written");
        }
    });
}

/// The third chunk takes the place of the first one, whichever chunk was read between.
#[test]
fn two_chunks_are_in_flight_and_a_third_takes_the_oldest_place() {
    on_every_device(|device, _, chunks, mut session| {
        let name = &device.info().name;
        session.scan().unwrap();
        session.mesh(&chunks[0]).unwrap();
        session.mesh(&chunks[1]).unwrap();
        let mut take = |_: texere_core::MeshPiece<'_>| ControlFlow::Continue(());
        let _ = session.read_mesh(&chunks[0], &mut take).unwrap();
        session.mesh(&chunks[2]).unwrap();
        let gone = session.read_mesh(&chunks[0], &mut take);
        assert!(matches!(gone, Err(SessionError::NotInFlight { chunk: 0 })), "{name}: {gone:?}");
        let _ = session.read_mesh(&chunks[1], &mut take).unwrap();
        // Output that an upload makes out of date can't be read.
        session.upload(0, &straight(1)).unwrap();
        let outdated = session.read_mesh(&chunks[1], &mut take);
        assert!(matches!(outdated, Err(SessionError::NotInFlight { chunk: 1 })), "{name}: {outdated:?}");
    });
}

/// A chunk of another plan is refused, even if both plans have the same yarns and settings: a chunk
/// carries its plan's identity, and tables are not compared.
#[test]
fn a_chunk_of_another_plan() {
    on_every_device(|device, plan, chunks, mut session| {
        let name = &device.info().name;
        session.scan().unwrap();
        session.mesh(&chunks[0]).unwrap();
        session.mesh(&chunks[1]).unwrap();
        let finer = Settings { sides: 7, ..*plan.settings() };
        for settings in [*plan.settings(), finer] {
            let other = Plan::new(plan.layout().clone(), settings).unwrap();
            let foreign = other.chunks(&Limits { blocks: 2, ..Limits::NONE }).unwrap().next().unwrap();
            let mut vertices = vec![Vertex::default(); foreign.vertices() as usize];
            let mut indices = vec![0; foreign.indices() as usize];
            let out = MeshMut { vertices: &mut vertices, indices: &mut indices };
            let mut refused = vec![
                session.trajectory(&foreign),
                session.mesh(&foreign),
                session.mesh_into(&foreign, out),
                session.slot_of_mesh(&foreign).map(|_| ()),
            ];
            refused.extend(read_nothing(&mut session, &foreign).map(|result| result.map(|_| ())));
            for result in refused {
                assert!(matches!(result, Err(SessionError::ForeignChunk { chunk: 0 })), "{name}: {result:?}");
            }
        }
        // A refused chunk takes no place: the third chunk still takes that of the first one.
        session.mesh(&chunks[2]).unwrap();
        session.slot_of_mesh(&chunks[1]).unwrap();
        let gone = session.slot_of_mesh(&chunks[0]);
        assert!(matches!(gone, Err(SessionError::NotInFlight { chunk: 0 })), "{name}: {gone:?}");
        // A clone of a plan is the same plan.
        let clone = plan.as_ref().clone();
        session.mesh(&clone.chunks(&Limits { blocks: 2, ..Limits::NONE }).unwrap().next().unwrap()).unwrap();
    });
}

#[test]
fn the_backend_that_does_nothing_streams_any_number_of_chunks() {
    let mut yarns = Yarns::builder();
    yarns.yarn(Yarn { twist: 1.0, ..Yarn::default() }, &straight(2_000));
    let yarns = yarns.build().unwrap();
    let mut steps = 0;
    let ended = Pipeline::new(&yarns)
        .limits(Limits { blocks: 2, ..Limits::NONE })
        .progress(|_| {
            steps += 1;
            ControlFlow::Continue(())
        })
        .stream(&NullBackend::default(), |_, _| ControlFlow::<()>::Continue(()));
    assert!(ended.unwrap().is_continue());
    // One step for the upload, and one for each block except the last, which shares a chunk with
    // the block before.
    assert_eq!(steps, 1 + 3999u32.div_ceil(64) - 1);
}

/// Safe code may call an engine without a session. Its kernels stay within their memory even then.
#[test]
fn an_engine_refuses_what_it_has_not_loaded() {
    let mut yarns = Yarns::builder();
    yarns.yarn(Yarn::default(), &straight(400));
    let yarns = yarns.build().unwrap();
    let plan = Arc::new(Plan::new(yarns.layout().clone(), Settings::default()).unwrap());
    let other = Plan::new(yarns.layout().clone(), Settings { sides: 12, ..Settings::default() }).unwrap();
    let first =
        |plan: &Plan, blocks| plan.chunks(&Limits { blocks, ..Limits::NONE }).unwrap().next().unwrap();
    let (small, large, foreign) = (first(&plan, 2), first(&plan, 8), first(&other, 2));
    // Only GPUs with a clock are tested. The CPU's engines check their bounds by themselves.
    let gpus = |device: &Arc<dyn Backend>| device.info().timed_by_device;
    for device in able_devices(&yarns, plan.settings()).filter(gpus) {
        let name = &device.info().name;
        let mut engine = device.engine(plan.clone()).unwrap();
        let refused = |result: Result<(), BackendError>| {
            assert!(matches!(result, Err(BackendError::NotLoaded { chunk: 0 })), "{name}: {result:?}");
        };
        refused(engine.mesh(Slot::BOTH[0], &small));
        engine.load(Slot::BOTH[0], &large).unwrap();
        refused(engine.mesh(Slot::BOTH[0], &small));
        refused(engine.trajectory(Slot::BOTH[0], &small));
        refused(engine.mesh(Slot::BOTH[1], &large));
        refused(engine.load(Slot::BOTH[0], &foreign));
        // A refused chunk leaves no work behind.
        refused(engine.mesh(Slot::BOTH[0], &large));
        let mut session = Session::with_engine(engine, Limits::NONE, Arc::new(other.clone()));
        let result = session.mesh(&foreign);
        assert!(
            matches!(result, Err(SessionError::Backend(BackendError::NotLoaded { .. }))),
            "{name}: {result:?}"
        );
    }
}
