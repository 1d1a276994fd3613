//! The paper's tables 1, 2 and 3 and its figures 5 and 6, with ours beside them.

mod markdown;
mod plot;

use std::error::Error;
use std::path::Path;
use std::time::{Duration, Instant};

use texere::{Counts, DeviceInfo, Phases, Settings, Yarns};
use texere_core::StageTimings;

use crate::fill::context;
use crate::measure::{Bench, median_time};
use crate::paper_cloth;

/// One device's work on one cloth.
#[derive(Debug)]
struct Run {
    /// Memory and tables, by the host's clock.
    creation: Duration,
    /// Control points to the device, by the host's clock.
    upload: Duration,
    /// From the open device to the first mesh in its memory, by the host's clock.
    first: Duration,
    /// Stage 1 and stage 2 one after the other, by the device's clock where it has one. None where stages are fused.
    staged: Option<StageTimings>,
    /// Both stages as fast as the device does them, likewise.
    whole: Duration,
    /// The mesh to the host, by the host's clock. None where it lies there already.
    readback: Option<Duration>,
    /// Giving memory back, by the host's clock.
    clean_up: Duration,
}

/// A device, and its runs on all cloths.
#[derive(Debug)]
struct Column {
    info: DeviceInfo,
    /// A context of the device's, by the host's clock; the first of a driver pays for the driver. None for a CPU.
    context: Option<Duration>,
    /// Compiling the kernels, by the host's clock: opening the device takes so much longer than a context does.
    build: Duration,
    runs: Vec<Run>,
}

/// A cloth of the tables.
#[derive(Debug)]
struct Cloth {
    name: String,
    yarns: Yarns,
    counts: Counts,
}

/// Pixels of the picture that is drawn.
const PICTURE: [u32; 2] = [1600, 1200];

/// Measures `devices` on the paper's cloth in `sizes` (ends, picks), the median of `rounds` each, and writes
/// `BENCHMARKS.md`, `figure-5.svg` and `figure-6.svg` to `folder`. `heading` says in the report how it was made.
///
/// # Errors
///
/// Whatever a device or the file system says.
pub fn write(
    devices: &[String],
    sizes: &[(usize, usize)],
    rounds: usize,
    heading: &str,
    folder: &Path,
) -> Result<(), Box<dyn Error>> {
    let mut cloths = Vec::new();
    for &(ends, picks) in sizes {
        let yarns = paper_cloth(ends, picks)?.yarns()?;
        let counts = *texere::Pipeline::new(&yarns).settings(Settings::default()).plan()?.counts();
        cloths.push(Cloth { name: format!("{ends} x {picks}"), yarns, counts });
    }
    let columns: Vec<_> =
        devices.iter().map(|device| column(device, &cloths, rounds)).collect::<Result<_, _>>()?;
    let phases = phases(devices, &cloths)?;
    std::fs::create_dir_all(folder)?;
    std::fs::write(
        folder.join("BENCHMARKS.md"),
        markdown::report(heading, &cloths, &columns, &phases, rounds),
    )?;
    if !phases.is_empty() {
        plot::figure_5(&folder.join("figure-5.svg"), &cloths, &phases)?;
    }
    plot::figure_6(&folder.join("figure-6.svg"), &cloths, &columns)
}

/// One device on all cloths.
fn column(device: &str, cloths: &[Cloth], rounds: usize) -> Result<Column, Box<dyn Error>> {
    let first_context = context(device)?;
    let next_context = context(device)?.unwrap_or_default();
    let start = Instant::now();
    let backend = texere::open(device)?;
    let build = start.elapsed().saturating_sub(next_context);
    let mut runs = Vec::new();
    for Cloth { name, yarns, .. } in cloths {
        let yarns = yarns.clone();
        let start = Instant::now();
        let mut bench = Bench::new(&*backend, yarns, Settings::default())?;
        bench.fused()?;
        let first = start.elapsed();
        let run = run(&mut bench, backend.info(), rounds)?;
        runs.push(Run { first, clean_up: bench.clean_up(), ..run });
        eprintln!("{device}: {name}");
    }
    Ok(Column { info: backend.info().clone(), context: first_context, build, runs })
}

/// Geometry, buffers and drawing of each cloth on the first of `devices` that draws; empty where none does.
fn phases(devices: &[String], cloths: &[Cloth]) -> Result<Vec<Phases>, Box<dyn Error>> {
    let Some(device) = devices.iter().find(|name| name.starts_with("wgpu:") && !name.contains('/')) else {
        return Ok(Vec::new());
    };
    let (renderer, serial) = (texere::open_renderer(device)?, texere::open("cpu-serial")?);
    let mut all = Vec::new();
    for Cloth { name, yarns, .. } in cloths {
        all.push(renderer.phases(yarns, &Settings::default(), &*serial, PICTURE)?);
        eprintln!("{device}: {name}, drawing");
    }
    Ok(all)
}

fn run(bench: &mut Bench, info: &DeviceInfo, rounds: usize) -> Result<Run, Box<dyn Error>> {
    // A first run, which allocates and compiles, is not counted.
    bench.staged()?;
    let (mut trajectory, mut mesh, mut whole) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..rounds {
        let staged = bench.staged()?;
        trajectory.push(staged.trajectory);
        mesh.push(staged.mesh);
        let fused = bench.fused()?;
        whole.push(fused.trajectory + fused.mesh);
    }
    let fuses = info.schedule == texere::Schedule::PerRing;
    let staged = StageTimings {
        trajectory: median_time(&trajectory),
        mesh: median_time(&mesh),
        ..StageTimings::default()
    };
    bench.read()?;
    Ok(Run {
        creation: bench.creation,
        upload: bench.upload,
        first: Duration::ZERO,
        staged: (!fuses).then_some(staged),
        whole: median_time(&whole),
        readback: if info.timed_by_device { Some(bench.read()?) } else { None },
        clean_up: Duration::ZERO,
    })
}
