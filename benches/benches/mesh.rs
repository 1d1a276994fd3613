//! Times the making of a mesh from control points: the scan, if yarns need one, and both stages
//! (trajectory and mesh).
//!
//! `mesh` writes into the same slices of the caller each time. `mesh-cold` does so after the slices
//! have been pushed out of the caches. `mesh-fresh` writes into new memory each time, and its time
//! includes the plan, the session and the upload.
#![allow(
    missing_docs,
    clippy::unwrap_used,
    reason = "criterion's macros make undocumented items; a bench may panic"
)]

mod stage;

use criterion::{Criterion, criterion_group, criterion_main};
use stage::{Bench, Floor, timed};
use texere::mesh::{Frame, Topology};
use texere::{Pipeline, Settings, Yarns};
use texere_bench::{DEVICES, SWEEP, one_yarn, paper_cloth, plan, session, shaped, sizes};
use texere_core::backend::MeshMut;

const CPU: &str = DEVICES[1];

/// The number of `u32` values that fill the caches of a large processor: 256 MiB of them.
const CACHES: usize = 64 << 20;

fn mesh(criterion: &mut Criterion) {
    let floor = &mut Floor::new();
    let paper = Settings::default();
    for size in sizes() {
        let yarns = paper_cloth(size.0, size.1).unwrap().yarns().unwrap();
        reused(criterion, floor, ["mesh", "paper", CPU], size, &yarns, paper);
    }
    let yarns = &paper_cloth(SWEEP.0, SWEEP.1).unwrap().yarns().unwrap();
    let mut sweep = |stage, fabric: &str, backend, yarns: &Yarns, settings| {
        reused(criterion, floor, [stage, fabric, backend], SWEEP, yarns, settings);
    };
    sweep("mesh", "paper", DEVICES[0], yarns, paper);
    sweep("mesh-cold", "paper", CPU, yarns, paper);
    sweep("mesh", "one-yarn", CPU, &one_yarn(yarns).unwrap(), paper);
    let minimizing = Settings { frame: Frame::RotationMinimizing, ..paper };
    sweep("mesh", "paper-minimizing", CPU, yarns, minimizing);
    sweep("mesh", "one-yarn-minimizing", CPU, &one_yarn(yarns).unwrap(), minimizing);
    sweep("mesh", "paper-shared", CPU, yarns, Settings { topology: Topology::Shared, ..paper });
    sweep("mesh", "paper-flattened", CPU, &shaped(yarns, 0.0, 2.0).unwrap(), paper);
    for subdivisions in [0, 3, 7] {
        sweep("mesh", &format!("paper-k{subdivisions}"), CPU, yarns, Settings { subdivisions, ..paper });
    }
    for sides in [3, 12, 24] {
        sweep("mesh", &format!("paper-nc{sides}"), CPU, yarns, Settings { sides, ..paper });
    }
    fresh(criterion, floor, yarns);
}

fn reused(
    criterion: &mut Criterion,
    floor: &mut Floor,
    [stage, fabric, backend]: [&str; 3],
    size: (usize, usize),
    yarns: &Yarns,
    settings: Settings,
) {
    let (plan, chunks) = plan(yarns, settings).unwrap();
    let (chunk, elements) = (&chunks[0], plan.counts().triangles);
    let mut vertices = texere_core::backend::zeroed("vertices", chunk.vertices().into()).unwrap();
    let mut indices = texere_core::backend::zeroed("indices", chunk.indices().into()).unwrap();
    let bytes = (size_of_val(&vertices[..]) + size_of_val(&indices[..])) as u64;
    // Values that fill the caches, so that nothing of the mesh is cached when the time starts.
    let mut others = vec![0u32; if stage == "mesh-cold" { CACHES } else { 0 }];
    let device = texere::open(backend).unwrap();
    let mut session = session(&*device, &plan, yarns).unwrap();
    floor.bench(criterion, &Bench { stage, fabric, size, backend, elements, bytes }, || {
        // After an upload the session scans and computes its rings again. Only one point is
        // uploaded, which takes negligible time.
        session.upload(0, &yarns.points()[..1]).unwrap();
        others.iter_mut().for_each(|value| *value += 1);
        timed(|| {
            session.scan().unwrap();
            let out = MeshMut { vertices: &mut vertices, indices: &mut indices };
            session.mesh_into(chunk, out).unwrap();
        })
    });
}

fn fresh(criterion: &mut Criterion, floor: &mut Floor, yarns: &Yarns) {
    let counts = *Pipeline::new(yarns).plan().unwrap().counts();
    let (elements, bytes) = (counts.triangles, counts.bytes());
    for backend in DEVICES {
        let device = texere::open(backend).unwrap();
        let bench = Bench { stage: "mesh-fresh", fabric: "paper", size: SWEEP, backend, elements, bytes };
        floor.bench(criterion, &bench, || timed(|| Pipeline::new(yarns).mesh(&*device).unwrap()));
    }
}

criterion_group!(benches, mesh);
criterion_main!(benches);
