//! Times the writing of a finished mesh to a file.
#![allow(
    missing_docs,
    clippy::unwrap_used,
    reason = "criterion's macros make undocumented items; a bench may panic"
)]

mod stage;

use criterion::{Criterion, criterion_group, criterion_main};
use stage::{Bench, Floor, timed};
use texere::Pipeline;
use texere_bench::{DEVICES, paper_cloth, sizes};

/// The number of ends of the largest cloth that is written: 0.35 GB as GLB, 0.78 GB as PLY.
const LARGEST_ENDS: usize = 815;

fn export(criterion: &mut Criterion) {
    let mut floor = Floor::new();
    let folder = tempfile::tempdir().unwrap();
    let backend = DEVICES[1];
    let device = texere::open(backend).unwrap();
    for size in sizes().filter(|(ends, _)| *ends <= LARGEST_ENDS) {
        let yarns = paper_cloth(size.0, size.1).unwrap().yarns().unwrap();
        let mesh = Pipeline::new(&yarns).mesh(&*device).unwrap();
        let elements = mesh.plan.counts().triangles;
        for fabric in ["paper-glb", "paper-ply"] {
            let file = folder.path().join(fabric.replace('-', "."));
            texere::write(&mesh, &file).unwrap();
            let bytes = std::fs::metadata(&file).unwrap().len();
            let bench = Bench { stage: "export", fabric, size, backend, elements, bytes };
            floor.bench(criterion, &bench, || timed(|| texere::write(&mesh, &file).unwrap()));
        }
    }
}

criterion_group!(benches, export);
criterion_main!(benches);
