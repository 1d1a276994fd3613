//! Times the making of lists of neighbours, and passes of settling in the weighted and the block
//! form.
#![allow(
    missing_docs,
    clippy::unwrap_used,
    reason = "criterion's macros make undocumented items; a bench may panic"
)]

mod stage;

use std::sync::Arc;

use criterion::{Criterion, criterion_group, criterion_main};
use stage::{Bench, Floor, timed};
use texere_bench::DEVICES;
use texere_conformance::rest::{Chart, Gauge, Length, random_misses, settling_plan, weft_knit};
use texere_core::settling::{Form, Pass, Place, tag};

/// The number of wales, and of courses.
const SIZE: usize = 60;

fn settling(criterion: &mut Criterion) {
    let mut floor = Floor::new();
    let chart = Chart::new(&vec!["k".repeat(SIZE); SIZE]);
    let jersey = weft_knit("jersey", &chart, Gauge::new(5.0), Length::Held);
    for (fabric, start) in [("jersey", jersey), ("random-misses", random_misses(SIZE, 1))] {
        let plan = settling_plan(&start);
        let all = plan.places().iter().zip(plan.tags());
        let places: Vec<Place> =
            all.filter(|(_, tags)| **tags & tag::POINT != 0).map(|(place, _)| *place).collect();
        for backend in DEVICES {
            let mut settler = texere::open(backend).unwrap().settler(Arc::clone(&plan)).unwrap();
            settler.upload(&places).unwrap();
            let (elements, bytes) = (plan.counts().points, 4 * settler.list(1.0).unwrap());
            let list = Bench { stage: "list", fabric, size: (SIZE, SIZE), backend, elements, bytes };
            floor.bench(criterion, &list, || timed(|| settler.list(1.0).unwrap()));
            for (stage, form) in [("weighted-pass", Form::Weighted), ("block-pass", Form::Block)] {
                let bench = Bench { stage, bytes: size_of_val(&*places) as u64, ..list };
                floor.bench(criterion, &bench, || {
                    // The list of neighbours is still that of the start.
                    settler.upload(&places).unwrap();
                    timed(|| settler.pass(&Pass { form, growth: 1.0, ease: 0.5, momentum: 0.8 }).unwrap())
                });
            }
        }
    }
}

criterion_group!(benches, settling);
criterion_main!(benches);
