//! The paper's evaluation again: its tables 1, 2 and 3 and its figures 5 and 6, with ours beside them.

mod markdown;
mod plot;

use std::error::Error;
use std::path::Path;
use std::time::{Duration, Instant};

use texere::{Counts, DeviceInfo, Settings};
use texere_core::StageTimings;

use crate::measure::{Bench, median_time};
use crate::paper_cloth;

/// One device's work on one cloth.
#[derive(Debug)]
struct Run {
    /// Opening the device: context, queues, kernels. By the host's clock.
    opening: Duration,
    /// Memory and tables, by the host's clock.
    creation: Duration,
    /// Control points to the device, by the host's clock.
    upload: Duration,
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
    runs: Vec<Run>,
}

/// A cloth of the tables.
#[derive(Debug)]
struct Cloth {
    name: String,
    counts: Counts,
}

/// Measures `devices` on the paper's cloth in `sizes` (ends, picks), the median of `rounds` each, and writes
/// `BENCHMARKS.md`, `figure-5.svg` and `figure-6.svg` to `folder`.
///
/// # Errors
///
/// Whatever a device or the file system says.
pub fn write(
    devices: &[String],
    sizes: &[(usize, usize)],
    rounds: usize,
    folder: &Path,
) -> Result<(), Box<dyn Error>> {
    let mut cloths = Vec::new();
    for &(ends, picks) in sizes {
        let yarns = paper_cloth(ends, picks)?.yarns()?;
        let counts = *texere::Pipeline::new(&yarns).settings(Settings::default()).plan()?.counts();
        cloths.push(Cloth { name: format!("{ends} x {picks}"), counts });
    }
    let mut columns = Vec::new();
    for device in devices {
        let start = Instant::now();
        let backend = texere::open(device)?;
        let opening = start.elapsed();
        let mut runs = Vec::new();
        for &(ends, picks) in sizes {
            let yarns = paper_cloth(ends, picks)?.yarns()?;
            let mut bench = Bench::new(&*backend, yarns, Settings::default())?;
            runs.push(run(&mut bench, backend.info(), rounds, opening)?);
            eprintln!("{device} {ends}x{picks}");
            if let Some(run) = runs.last_mut() {
                run.clean_up = bench.clean_up();
            }
        }
        columns.push(Column { info: backend.info().clone(), runs });
    }
    std::fs::create_dir_all(folder)?;
    std::fs::write(folder.join("BENCHMARKS.md"), markdown::report(&cloths, &columns, rounds))?;
    plot::figure_5(&folder.join("figure-5.svg"), &cloths, &columns)?;
    plot::figure_6(&folder.join("figure-6.svg"), &cloths, &columns)
}

fn run(
    bench: &mut Bench,
    info: &DeviceInfo,
    rounds: usize,
    opening: Duration,
) -> Result<Run, Box<dyn Error>> {
    // What a first run allocates and compiles is none of a run's work.
    bench.staged()?;
    let (mut trajectory, mut mesh, mut whole) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..rounds {
        let staged = bench.staged()?;
        trajectory.push(staged.trajectory);
        mesh.push(staged.mesh);
        let fused = bench.fused()?;
        whole.push(fused.trajectory + fused.mesh);
    }
    let fuses = info.schedule == texere::Schedule::PerRing.to_string();
    let staged = StageTimings {
        trajectory: median_time(&trajectory),
        mesh: median_time(&mesh),
        ..StageTimings::default()
    };
    bench.read()?;
    Ok(Run {
        opening,
        creation: bench.creation,
        upload: bench.upload,
        staged: (!fuses).then_some(staged),
        whole: median_time(&whole),
        readback: if info.timed_by_device { Some(bench.read()?) } else { None },
        clean_up: Duration::ZERO,
    })
}
