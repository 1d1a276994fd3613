//! The steps of a run, as `Pipeline` promises them: bounded by default, reported one by one, and
//! ended by a stop.

use std::ops::ControlFlow;

use texere_conformance::cases;
use texere_core::backend::Chunk;
use texere_core::{
    Backend, ControlPoint, Limits, MeshPiece, Pipeline, PipelineError, Progress, Topology, Vertex, Yarn,
    Yarns,
};

/// A yarn whose mesh takes half a gigabyte in each of its two buffers.
fn yarns() -> Yarns {
    cases::winding(1_800_000, Yarn::default())
}

/// The default limit of a chunk's buffer, bytes, by the docs of `Limits`.
const CHUNK_BUFFER: u64 = 64 << 20;

/// The number of rings of six sides that fit [`CHUNK_BUFFER`]. A ring has 36 indices of 4 bytes, or
/// 6 vertices of 24 bytes.
const STEP_RINGS: u64 = CHUNK_BUFFER / 144;

fn device() -> Box<dyn Backend> {
    texere::open("cpu").unwrap()
}

/// All reports of progress, in order.
fn reported(run: impl FnOnce(Pipeline<'_>, &dyn Backend)) -> Vec<Progress> {
    let (yarns, mut reported) = (yarns(), Vec::new());
    run(
        Pipeline::new(&yarns).progress(|progress| {
            reported.push(progress);
            ControlFlow::Continue(())
        }),
        &*device(),
    );
    reported
}

#[test]
fn chunks_are_bounded_unless_asked_otherwise() {
    let (yarns, device) = (yarns(), device());
    let mut bytes = Vec::new();
    let mut note = |chunk: &Chunk, _: MeshPiece<'_>| {
        let vertices = u64::from(chunk.vertices()) * size_of::<Vertex>() as u64;
        bytes.push(vertices.max(u64::from(chunk.indices()) * 4));
        ControlFlow::<()>::Continue(())
    };
    let _ = Pipeline::new(&yarns).stream(&*device, &mut note).unwrap();
    assert!(bytes.len() > 8 && bytes.iter().all(|bytes| *bytes <= CHUNK_BUFFER), "{bytes:?}");

    let mesh = Pipeline::new(&yarns).topology(Topology::None).mesh(&*device).unwrap();
    assert!(mesh.chunks.len() > 4);
    let whole = Pipeline::new(&yarns).topology(Topology::None).limits(Limits::NONE).mesh(&*device).unwrap();
    assert_eq!(whole.chunks.len(), 1);
}

#[test]
fn progress_is_told_after_each_chunk() {
    let runs: [fn(Pipeline<'_>, &dyn Backend); 3] = [
        |pipeline, device| drop(pipeline.mesh(device).unwrap()),
        |pipeline, device| {
            let _ = pipeline.stream(device, |_, _| ControlFlow::<()>::Continue(())).unwrap();
        },
        |pipeline, device| drop(pipeline.trajectory(device).unwrap()),
    ];
    for run in runs {
        let reported = reported(run);
        let total = reported[0].total;
        assert!(reported.iter().all(|progress| progress.total == total));
        assert_eq!((reported[0].rings, reported[reported.len() - 1].rings), (0, total));
        let steps: Vec<_> =
            reported.windows(2).map(|pair| pair[1].rings.checked_sub(pair[0].rings)).collect();
        assert!(steps.iter().all(|step| step.is_some_and(|rings| rings <= STEP_RINGS)), "{steps:?}");
    }
}

/// The sink or progress stops the run half way. At most one more chunk is handed over.
#[test]
fn a_stop_is_heard_at_the_next_chunk() {
    let (yarns, device) = (yarns(), device());
    let total = Pipeline::new(&yarns).plan().unwrap().counts().rings;
    let mut rings = 0;
    let answer = Pipeline::new(&yarns)
        .stream(&*device, |chunk, piece| match piece {
            MeshPiece::Vertices { first: 0, .. } if rings > total / 2 => ControlFlow::Break(rings),
            MeshPiece::Vertices { first: 0, .. } => {
                rings += u64::from(chunk.rings());
                ControlFlow::Continue(())
            }
            _ => ControlFlow::Continue(()),
        })
        .unwrap();
    let ControlFlow::Break(heard) = answer else { panic!("never heard") };
    assert!(heard > total / 2 && heard <= total / 2 + STEP_RINGS, "{heard} of {total}");

    let mut last = 0;
    let cancelled = Pipeline::new(&yarns)
        .progress(|progress| {
            last = progress.rings;
            if last > total / 2 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        })
        .mesh(&*device);
    assert!(matches!(cancelled, Err(PipelineError::Cancelled)));
    assert!(last > total / 2 && last <= total / 2 + STEP_RINGS, "{last} of {total}");
}

/// Six yarns with twist, each so long that a scan and the measurement of lengths report before it.
fn twisted() -> Yarns {
    let mut yarns = Yarns::builder();
    for y in 0..6 {
        let points: Vec<_> = (0..80_000).map(|x| ControlPoint::new(x as f32, y as f32, 0.0, 0.1)).collect();
        yarns.yarn(Yarn { twist: 0.5, ..Yarn::default() }, &points);
    }
    yarns.build().unwrap()
}

/// The number of reports that come before the first ring is delivered. The run is stopped at the
/// report for whose number `last` answers true.
fn early(device: &dyn Backend, yarns: &Yarns, last: impl Fn(usize) -> bool + Send + Sync) -> usize {
    let mut reports = 0;
    let pipeline = Pipeline::new(yarns).subdivisions(1).progress(|progress| {
        reports += usize::from(progress.rings == 0);
        if progress.rings > 0 || last(reports) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert!(matches!(pipeline.attributes(device), Err(PipelineError::Cancelled)));
    reports
}

#[test]
fn a_scan_is_watched_and_ends_where_it_is_asked_to() {
    let (yarns, points) = (twisted(), 480_000_usize.div_ceil(1 << 20));
    for name in ["cpu", "cpu-serial"] {
        let device = texere::open(name).unwrap();
        // A yarn has 160,000 rings, more than are worked on between two reports. The scan and the
        // measurement of lengths therefore report before each yarn.
        assert_eq!(early(&*device, &yarns, |_| false), points + 6 + 6, "{name}");
        for last in [points, points + 1, points + 6, points + 7] {
            assert_eq!(early(&*device, &yarns, |reports| reports == last), last, "{name}");
        }
    }
}
