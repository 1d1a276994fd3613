//! The host memory that is taken stays within the bound that is told beforehand. The allocator
//! counts what is taken, so memory of a GPU's driver is left out.

use std::io;
use std::ops::ControlFlow;

use peak_alloc::PeakAlloc;
use texere::Pipeline;
use texere::write::{Format, MeshForm, VertexAttribute};
use texere_conformance::cases;
use texere_core::{ControlPoint, Frame, Limits, Origin, Topology, Yarn, Yarns};

#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

/// All checks are one test, so that no other test allocates at the same time.
#[test]
fn what_is_taken_is_what_was_told() {
    a_mesh_peaks_within_five_per_cent_of_the_plan();
    a_stream_peaks_at_two_chunks();
    a_file_peaks_at_two_chunks_in_any_format();
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

/// A mesh of 350 MB is streamed. The bound counts the control points and two chunks with their
/// tables. A chunk has two buffers of 64 MiB at most.
fn a_stream_peaks_at_two_chunks() {
    let yarns = cases::winding(600_000, Yarn::default());
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

/// A mesh of 2,000 yarns and 38 MB of vertices is written with chunks of 8 MiB. Besides the
/// control points and two chunks, a writer may take 3 kB for each yarn. Most of this is the
/// document of glTF.
fn a_file_peaks_at_two_chunks_in_any_format() {
    let mut yarns = Yarns::builder();
    for end in 0..2000 {
        let place = |pick: u32| ControlPoint::new(end as f32, pick as f32, (pick % 2) as f32 * 0.3, 0.2);
        yarns.yarn(
            Yarn { origin: Origin::End(end + 1), ..Yarn::default() },
            &(0..40).map(place).collect::<Vec<_>>(),
        );
    }
    let yarns = yarns.build().unwrap();
    let device = texere::open("cpu").unwrap();
    let limits = Limits { binding_bytes: 8 << 20, ..Limits::NONE };
    let told = size_of_val(yarns.points()) + 2 * (2 * (8 << 20) + (1 << 20)) + 2000 * 3000;
    let forms = [Format::PackedGlb, Format::CompressedGlb, Format::KhrCompressedGlb, Format::InstancedGlb];
    let formats = Format::ALL.into_iter().chain(forms);
    let with = [Format::Glb, Format::CompressedGlb, Format::Ply, Format::Usda]
        .map(|format| format.with(VertexAttribute::ALL));
    for format in formats.map(MeshForm::from).chain(with) {
        let write = || {
            let pipeline = Pipeline::new(&yarns).sides(10).subdivisions(1).caps(true).limits(limits);
            texere::write::stream_to(pipeline, &*device, format, io::empty()).unwrap()
        };
        let peak = peak_of(write);
        assert!(peak <= told as f64, "{format:?}: {peak} bytes, told {told}");
    }
}

fn a_mesh_peaks_within_five_per_cent_of_the_plan() {
    let yarns = cases::winding(60_000, Yarn::default());
    // The serial reference is left out, because it also keeps the rings of a chunk, as the paper
    // does.
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
