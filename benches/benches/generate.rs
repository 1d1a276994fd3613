//! Times the making of the control points of a cloth's yarns, into new memory each time.
#![allow(
    missing_docs,
    clippy::unwrap_used,
    reason = "criterion's macros make undocumented items; a bench may panic"
)]

mod stage;

use criterion::{Criterion, criterion_group, criterion_main};
use stage::{Bench, Floor, timed};
use texere::ControlPoint;
use texere::woven::Shape;
use texere_bench::{paper_cloth, sizes};

fn generate(criterion: &mut Criterion) {
    let mut floor = Floor::new();
    for (fabric, shape) in [("paper", Shape::Crossing), ("round", Shape::Round)] {
        for size in sizes() {
            let mut cloth = paper_cloth(size.0, size.1).unwrap();
            cloth.set_shape(shape);
            let elements = cloth.point_count();
            // The bytes of a control point and of its source.
            let bytes = elements * (size_of::<ControlPoint>() + size_of::<u32>()) as u64;
            let bench = Bench { stage: "generate", fabric, size, backend: "cpu", elements, bytes };
            floor.bench(criterion, &bench, || timed(|| cloth.yarns().unwrap()));
        }
    }
}

criterion_group!(benches, generate);
criterion_main!(benches);
