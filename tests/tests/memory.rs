//! Host memory against the plan's word, by the count of the allocator. What a GPU's driver takes is not in it.

use peak_alloc::PeakAlloc;
use texere::Pipeline;
use texere_conformance::cases;
use texere_core::{Frame, Limits, Topology, Yarn};

#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

/// One test, so that no other allocates beside it.
#[test]
fn a_mesh_peaks_within_five_per_cent_of_the_plan() {
    let yarns = cases::winding(60_000, Yarn::default());
    // The serial reference keeps a chunk's rings besides, as the paper does.
    let devices = texere::devices().found.into_iter().map(|device| device.name);
    for name in devices.filter(|name| name != "cpu-serial") {
        let device = texere::open(&name).unwrap();
        for (topology, blocks) in
            [(Topology::Indexed, u64::MAX), (Topology::Shared, u64::MAX), (Topology::Indexed, 100)]
        {
            let pipeline = || {
                let limits = Limits { blocks, ..Limits::NONE };
                Pipeline::new(&yarns).frame(Frame::RotationMinimizing).topology(topology).limits(limits)
            };
            let plan = pipeline().plan().unwrap();
            let on_cpu = name == "cpu";
            let planned = if on_cpu { plan.host_bytes() } else { plan.host_bytes_beside_gpu() } as f64;
            // What is set up once, threads and pipelines, is there after the first.
            pipeline().mesh(&*device).unwrap();
            let before = ALLOCATOR.current_usage();
            ALLOCATOR.reset_peak_usage();
            let mesh = pipeline().mesh(&*device).unwrap();
            let peak = (ALLOCATOR.peak_usage() - before) as f64;
            drop(mesh);
            assert!(
                (peak / planned - 1.0).abs() < 0.05,
                "{name}, {topology:?}, {blocks} blocks: {peak} bytes, planned {planned}"
            );
        }
    }
}
