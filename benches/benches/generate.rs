//! From a cloth to the control points of its yarns.
#![allow(
    missing_docs,
    clippy::unwrap_used,
    reason = "criterion's macros make undocumented items; a bench may panic"
)]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use texere_bench::{SIZES, paper_cloth};

fn generate(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("generate/paper");
    group.sample_size(10);
    for (ends, picks) in SIZES {
        let cloth = paper_cloth(ends, picks).unwrap();
        group.throughput(Throughput::Elements(cloth.point_count()));
        group.bench_function(BenchmarkId::from_parameter(format!("{ends}x{picks}")), |bencher| {
            bencher.iter(|| cloth.yarns().unwrap());
        });
    }
    group.finish();
}

criterion_group!(benches, generate);
criterion_main!(benches);
