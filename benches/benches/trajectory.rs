//! Stage 1: rings from control points, into the session's own memory.
#![allow(
    missing_docs,
    clippy::unwrap_used,
    reason = "criterion's macros make undocumented items; a bench may panic"
)]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use texere_bench::{DEVICES, SIZES, paper_cloth, paper_plan, session};

fn trajectory(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("trajectory/paper");
    group.sample_size(10);
    for (ends, picks) in SIZES {
        let yarns = paper_cloth(ends, picks).unwrap().yarns().unwrap();
        let (plan, chunks) = paper_plan(&yarns).unwrap();
        group.throughput(Throughput::ElementsAndBytes {
            elements: plan.counts().rings,
            bytes: plan.trajectory_bytes(),
        });
        for device in DEVICES {
            let device = texere::open(device).unwrap();
            let mut session = session(&*device, &plan, &yarns).unwrap();
            let id = BenchmarkId::new(format!("{ends}x{picks}"), &device.info().name);
            group.bench_function(id, |bencher| {
                bencher.iter(|| {
                    // An upload makes the session forget its rings; one point costs next to nothing.
                    session.upload(0, &yarns.points()[..1]).unwrap();
                    session.trajectory(&chunks[0]).unwrap();
                });
            });
        }
    }
    group.finish();
}

criterion_group!(benches, trajectory);
criterion_main!(benches);
