//! Host memory against the plan's bound, counted in the allocator. Memory of a GPU's driver is not
//! counted.

use std::ops::ControlFlow;

use peak_alloc::PeakAlloc;
use texere::Pipeline;
use texere_conformance::cases;
use texere_core::{Frame, Limits, Topology, Yarn};

#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

/// A single test, so that no other one allocates at the same time.
#[test]
fn what_is_taken_is_what_was_told() {
    a_mesh_peaks_within_five_per_cent_of_the_plan();
    a_stream_peaks_at_two_chunks();
}

/// Peak memory of `work`, bytes, beyond the memory that was in use before.
fn peak_of<T>(work: impl FnOnce() -> T) -> f64 {
    let before = ALLOCATOR.current_usage();
    ALLOCATOR.reset_peak_usage();
    let made = work();
    let peak = (ALLOCATOR.peak_usage() - before) as f64;
    drop(made);
    peak
}

/// A mesh of 600 MB is streamed. The bound counts the control points and two chunks with their
/// tables. A chunk has two buffers of 64 MiB at most.
fn a_stream_peaks_at_two_chunks() {
    let yarns = cases::winding(1_000_000, Yarn::default());
    let points = size_of_val(yarns.points());
    let two_chunks = 2 * (2 * (64 << 20) + (1 << 20));
    for device in texere::devices().found.into_iter().filter(|device| device.name != "cpu-serial") {
        let device = texere::open(&device.name).unwrap();
        let stream =
            || Pipeline::new(&yarns).stream(&*device, |_, _| ControlFlow::<()>::Continue(())).unwrap();
        let _ = stream();
        let peak = peak_of(stream);
        let told = (points + two_chunks) as f64;
        assert!(peak <= 1.05 * told, "{}: {peak} bytes, told {told}", device.info().name);
    }
}

fn a_mesh_peaks_within_five_per_cent_of_the_plan() {
    let yarns = cases::winding(60_000, Yarn::default());
    // The serial reference also keeps the rings of a chunk, as the paper does.
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
            let planned =
                if on_cpu { plan.host_bytes() } else { texere_gpu::host_bytes_beside_gpu(&plan) } as f64;
            // Threads and pipelines are set up once, and exist after the first run.
            pipeline().mesh(&*device).unwrap();
            let peak = peak_of(|| pipeline().mesh(&*device).unwrap());
            assert!(
                (peak / planned - 1.0).abs() < 0.05,
                "{name}, {topology:?}, {blocks} blocks: {peak} bytes, planned {planned}"
            );
        }
    }
}
