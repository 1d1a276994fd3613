//! The paper's tables 1, 2 and 3 and its figures 5 and 6, with texere's beside them.

mod markdown;
mod plot;
mod results;

use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use texere::write::Output;
use texere::{DeviceInfo, Settings};
use texere_core::backend::StageTimings;

use crate::fill::context;
use crate::measure::{Bench, median_time};
use crate::paper_cloth;
use crate::phases::{PhaseTimer, Phases};
use results::{Cloth, Column, PICTURE, Run};

/// Measures `devices` on the paper's cloth in `sizes` (ends, picks), with the medians of `rounds`
/// runs, and writes `BENCHMARKS.md`, `figure-6.svg` and, if one of the devices draws,
/// `figure-5.svg` to `folder`. `heading` goes into the report, and says how the report was made.
///
/// # Errors
///
/// The errors of a device or the file system.
pub fn write(
    devices: &[String],
    sizes: &[(usize, usize)],
    rounds: usize,
    heading: &str,
    folder: &Path,
) -> Result<(), Box<dyn Error>> {
    let mut cloths = Vec::new();
    for &(ends, picks) in sizes {
        cloths.push(Cloth::new(format!("{ends} x {picks}"), paper_cloth(ends, picks)?.yarns()?)?);
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
        std::fs::write(folder.join("figure-5.svg"), plot::figure_5(&cloths, &phases)?)?;
    }
    std::fs::write(folder.join("figure-6.svg"), plot::figure_6(&cloths, &columns)?)?;
    Ok(())
}

/// Times geometry, buffers and drawing of `designs` on `device`, a name such as `wgpu:0`, and
/// geometry on one core of the CPU as well. Prints the times as a table, and draws the paper's
/// figure 5 of them to `output`, an SVG file. Fails before anything is timed if a design was read
/// from that file.
///
/// # Errors
///
/// The errors of a reader, a device or the file system.
pub fn figure_5(
    designs: &[PathBuf],
    device: &str,
    size: [u32; 2],
    output: &Path,
) -> Result<(), Box<dyn Error>> {
    let read: Vec<_> = designs.iter().map(texere::read).collect::<Result<_, _>>()?;
    let output = Output::to(output).sparing(read.iter().flat_map(|design| design.files()));
    output.check()?;
    let timer = PhaseTimer::open(device)?;
    let (mut cloths, mut phases) = (Vec::new(), Vec::new());
    for (path, design) in designs.iter().zip(&read) {
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        let cloth = Cloth::new(name.into(), design.yarns()?)?;
        phases.push(timer.phases(&cloth.yarns, &Settings::default(), size)?);
        cloths.push(cloth);
    }
    print!("{}:\n\n{}", timer.info().device, markdown::phases(&cloths, &phases));
    texere::write::file(plot::figure_5(&cloths, &phases)?.as_bytes(), output)?;
    Ok(())
}

/// Measures one device on all cloths.
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

/// The times of geometry, buffers and drawing of each cloth on the first of `devices` that draws.
/// Empty if none draws.
fn phases(devices: &[String], cloths: &[Cloth]) -> Result<Vec<Phases>, Box<dyn Error>> {
    let Some(device) = devices.iter().find(|name| name.starts_with("wgpu:") && !name.contains('/')) else {
        return Ok(Vec::new());
    };
    let timer = PhaseTimer::open(device)?;
    let mut all = Vec::new();
    for Cloth { name, yarns, .. } in cloths {
        all.push(timer.phases(yarns, &Settings::default(), PICTURE)?);
        eprintln!("{device}: {name}, drawing");
    }
    Ok(all)
}

fn run(bench: &mut Bench, info: &DeviceInfo, rounds: usize) -> Result<Run, Box<dyn Error>> {
    // A first run of the stages, which may allocate, is not counted.
    bench.staged()?;
    let (mut trajectory, mut mesh, mut whole) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..rounds {
        let staged = bench.staged()?;
        trajectory.push(staged.trajectory);
        mesh.push(staged.mesh);
        let fused = bench.fused()?;
        whole.push(fused.trajectory + fused.mesh);
    }
    let fuses = info.schedule == texere::backend::Schedule::PerRing;
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
