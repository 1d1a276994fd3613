//! Both stages: the mesh from control points, into the caller's own slices, used again and again.
#![allow(
    missing_docs,
    clippy::unwrap_used,
    reason = "criterion's macros make undocumented items; a bench may panic"
)]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use texere_bench::{DEVICES, SIZES, paper_cloth, paper_plan, session};
use texere_core::MeshMut;

fn mesh(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("mesh/paper");
    group.sample_size(10);
    for (ends, picks) in SIZES {
        let yarns = paper_cloth(ends, picks).unwrap().yarns().unwrap();
        let (plan, chunks) = paper_plan(&yarns).unwrap();
        let counts = plan.counts();
        group.throughput(Throughput::ElementsAndBytes { elements: counts.triangles, bytes: counts.bytes() });
        let mut vertices = texere_core::zeroed("vertices", counts.vertices).unwrap();
        let mut indices = texere_core::zeroed("indices", counts.indices).unwrap();
        for device in DEVICES {
            let device = texere::open(device).unwrap();
            let mut session = session(&*device, &plan, &yarns).unwrap();
            let id = BenchmarkId::new(format!("{ends}x{picks}"), &device.info().name);
            group.bench_function(id, |bencher| {
                bencher.iter(|| {
                    // An upload makes the session forget its rings; one point costs next to nothing.
                    session.upload(0, &yarns.points()[..1]).unwrap();
                    let out = MeshMut { vertices: &mut vertices, indices: &mut indices };
                    session.mesh_into(&chunks[0], out).unwrap();
                });
            });
        }
    }
    group.finish();
}

criterion_group!(benches, mesh);
criterion_main!(benches);
