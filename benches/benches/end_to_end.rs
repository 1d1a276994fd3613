//! Measures how long it takes to get from a design file to its mesh, in newly allocated memory and
//! as a file.
#![allow(
    missing_docs,
    clippy::unwrap_used,
    reason = "criterion's macros make undocumented items; a bench may panic"
)]

mod stage;

use criterion::{Criterion, criterion_group, criterion_main};
use stage::{Bench, Floor, timed};
use texere::Pipeline;
use texere_bench::{DEVICES, SIZES, sizes};

fn end_to_end(criterion: &mut Criterion) {
    let mut floor = Floor::new();
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("paper.glb");
    let backend = DEVICES[1];
    let device = texere::open(backend).unwrap();
    for size in sizes() {
        let (ends, picks) = size;
        let path = format!("{}/../designs/paper/{ends}x{picks}.toml", env!("CARGO_MANIFEST_DIR"));
        let yarns = || texere::read(&path).unwrap().yarns().unwrap();
        let counts = *Pipeline::new(yarns()).plan().unwrap().counts();
        let (elements, bytes) = (counts.triangles, counts.bytes());
        let bench = Bench { stage: "end_to_end", fabric: "paper", size, backend, elements, bytes };
        floor.bench(criterion, &bench, || timed(|| Pipeline::new(yarns()).mesh(&*device).unwrap()));
        if size != SIZES[0] {
            continue;
        }
        let written = || texere::write::stream(Pipeline::new(yarns()), &*device, &file).unwrap();
        written();
        let bytes = std::fs::metadata(&file).unwrap().len();
        floor.bench(criterion, &Bench { fabric: "paper-glb", bytes, ..bench }, || timed(written));
    }
}

criterion_group!(benches, end_to_end);
criterion_main!(benches);
