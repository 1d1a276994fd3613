//! Host memory against the plan's word, by the count of the allocator. What a GPU's driver takes is
//! not in it.

use std::ops::ControlFlow;

use peak_alloc::PeakAlloc;
use texere::Pipeline;
use texere_conformance::cases;
use texere_core::{Frame, Limits, Topology, Yarn};

#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

/// One test, so that no other allocates beside it.
#[test]
fn what_is_taken_is_what_was_told() {
    a_mesh_peaks_within_five_per_cent_of_the_plan();
    a_stream_peaks_at_two_chunks();
}

/// Bytes at the peak of `work`, beside what was there before.
fn peak_of<T>(work: impl FnOnce() -> T) -> f64 {
    let before = ALLOCATOR.current_usage();
    ALLOCATOR.reset_peak_usage();
    let made = work();
    let peak = (ALLOCATOR.peak_usage() - before) as f64;
    drop(made);
    peak
}

/// A mesh of 600 MB, streamed: the control points and two chunks, each of two buffers of 64 MiB at
/// most, with their tables.
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
            let planned =
                if on_cpu { plan.host_bytes() } else { texere_gpu::host_bytes_beside_gpu(&plan) } as f64;
            // What is set up once, threads and pipelines, is there after the first.
            pipeline().mesh(&*device).unwrap();
            let peak = peak_of(|| pipeline().mesh(&*device).unwrap());
            assert!(
                (peak / planned - 1.0).abs() < 0.05,
                "{name}, {topology:?}, {blocks} blocks: {peak} bytes, planned {planned}"
            );
        }
    }
}
