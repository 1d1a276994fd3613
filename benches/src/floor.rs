//! Compares a device with its floor. The mesh stage, also with packed vertices, stands beside a
//! plain fill of as many bytes. Reading and uploading stand beside plain copies to and from pinned
//! memory.

use std::error::Error;
use std::time::Duration;

use texere::mesh::{Frame, PackedVertex, Topology};
use texere::{Backend, Settings, Yarns};
use texere_core::backend::{SessionError, StageTimings};

use crate::fill::{Fill, Gpu};
use crate::measure::{Bench, median_time};
use crate::{one_yarn, paper_cloth, shaped};

/// A variant of the mesh stage.
#[derive(Debug, Clone, Copy)]
struct Case {
    name: &'static str,
    frame: Frame,
    topology: Topology,
    /// Whether all control points are in a single yarn.
    joined: bool,
    /// The twist of all yarns, rad/mm.
    twist: f32,
    /// The width of all yarns, divided by their height.
    flatness: f32,
    /// Whether the paper's schedule is used, in which a lane makes a yarn, instead of texere's.
    per_yarn: bool,
    /// Whether packed vertices are made instead of the mesh.
    packed: bool,
}

const PAPER: Case = Case {
    name: "upright, indexed",
    frame: Frame::Upright,
    topology: Topology::Indexed,
    joined: false,
    twist: 0.0,
    flatness: 1.0,
    per_yarn: false,
    packed: false,
};

const TWISTED: Case = Case { name: "upright, indexed, twisted", twist: 0.7, ..PAPER };

const PACKED: Case =
    Case { name: "upright, shared, packed", topology: Topology::Shared, packed: true, ..PAPER };

const CASES: [Case; 11] = [
    PAPER,
    Case { name: "upright, shared", topology: Topology::Shared, ..PAPER },
    PACKED,
    Case { name: "upright, shared, packed, flattened", flatness: 2.0, ..PACKED },
    Case { name: "upright, shared, packed, twisted", twist: 0.7, ..PACKED },
    Case { name: "rotation-minimising, indexed", frame: Frame::RotationMinimizing, ..PAPER },
    Case { name: "upright, indexed, in one yarn", joined: true, ..PAPER },
    Case { name: "upright, indexed, flattened", flatness: 2.0, ..PAPER },
    TWISTED,
    Case { name: "upright, indexed, twisted and flattened", flatness: 2.0, ..TWISTED },
    Case { name: "upright, indexed, a lane a yarn", per_yarn: true, ..PAPER },
];

/// The most bytes of one buffer of the fill.
const BUFFER: u64 = 1 << 30;

/// Prints two tables. The first has a row for each device, size (ends, picks) and case, with
/// medians of `rounds` warm runs by the device's clock. The second has a row for each device and
/// size with the speeds over the bus, by the host's clock.
///
/// # Errors
///
/// The errors of the device.
pub fn print(devices: &[String], sizes: &[(usize, usize)], rounds: usize) -> Result<(), Box<dyn Error>> {
    println!("| device | cloth | | fill, ms | GB/s | scan, ms | mesh, ms | times the fill | ps a triangle |");
    println!("|---|---|---|---|---|---|---|---|---|");
    let cloths = sizes
        .iter()
        .map(|&(ends, picks)| Ok((format!("{ends} x {picks}"), paper_cloth(ends, picks)?.yarns()?)));
    let cloths: Vec<_> = cloths.collect::<Result<_, Box<dyn Error>>>()?;
    // The devices are opened once, because drivers keep some memory of each context.
    let mut gpus = Vec::new();
    for name in devices {
        gpus.push((name, Gpu::open(name)?, texere::open(&format!("{name}/per-yarn"))?));
    }
    for (cloth, yarns) in &cloths {
        for (name, gpu, per_yarn) in &gpus {
            for case in CASES {
                let backend = if case.per_yarn { &**per_yarn } else { gpu.backend() };
                print_case(name, gpu, backend, cloth, yarns, case, rounds)?;
            }
        }
    }
    println!(
        "\nOver the bus, GB/s: plain copies of as many bytes to and from pinned memory, `read_mesh` and `upload` beside them\n"
    );
    println!("| device | cloth | to host | mesh | share | to device | control points | share |");
    println!("|---|---|---|---|---|---|---|---|");
    for (cloth, yarns) in &cloths {
        for (name, gpu, _) in &gpus {
            print_bus(name, gpu, cloth, yarns, rounds)?;
        }
    }
    Ok(())
}

fn print_bus(
    device: &str,
    gpu: &Gpu,
    cloth: &str,
    yarns: &Yarns,
    rounds: usize,
) -> Result<(), Box<dyn Error>> {
    let plan = texere::Pipeline::new(yarns).plan()?;
    let (mesh, points) = (plan.counts().bytes(), plan.resident_bytes());
    let (mut out_of_device, mut into_device) = (gpu.fill(&buffers(mesh))?, gpu.fill(&buffers(points))?);
    let mut bench = Bench::new(gpu.backend(), yarns.clone(), Settings::default())?;
    bench.read()?;
    let (mut copied_out, mut read, mut copied_in, mut sent) =
        (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for _ in 0..rounds {
        copied_out.push(out_of_device.copy_to_host()?);
        read.push(bench.read()?);
        copied_in.extend(into_device.copy_from_host()?);
        sent.push(bench.send()?);
    }
    let rate = |bytes: u64, times: &[Duration]| bytes as f64 / median_time(times).as_secs_f64() / 1e9;
    let (bus_out, read, sent) = (rate(mesh, &copied_out), rate(mesh, &read), rate(points, &sent));
    let (bus_in, share) = if copied_in.is_empty() {
        ("-".into(), "-".into())
    } else {
        let bus_in = rate(points, &copied_in);
        (format!("{bus_in:.1}"), format!("{:.2}", sent / bus_in))
    };
    println!(
        "| {device} | {cloth} | {bus_out:.1} | {read:.1} | {:.2} | {bus_in} | {sent:.1} | {share} |",
        read / bus_out,
    );
    Ok(())
}

/// The lengths of buffers that hold `bytes` together.
fn buffers(bytes: u64) -> Vec<u64> {
    let (whole, rest) = (bytes / BUFFER, bytes % BUFFER);
    (0..whole).map(|_| BUFFER).chain([rest]).filter(|bytes| *bytes > 0).collect()
}

fn print_case(
    device: &str,
    gpu: &Gpu,
    backend: &dyn Backend,
    cloth: &str,
    yarns: &Yarns,
    case: Case,
    rounds: usize,
) -> Result<(), Box<dyn Error>> {
    let settings = Settings { frame: case.frame, topology: case.topology, ..Settings::default() };
    let yarns = if case.joined { one_yarn(yarns)? } else { shaped(yarns, case.twist, case.flatness)? };
    let counts = *texere::Pipeline::new(&yarns).settings(settings).plan()?.counts();
    let bytes = if case.packed { counts.vertices * size_of::<PackedVertex>() as u64 } else { counts.bytes() };
    let mut fill = gpu.fill(&buffers(bytes))?;
    let stages = if case.packed { Bench::packed } else { Bench::fused };
    let bench = Bench::new(backend, yarns, settings)?;
    let (fill, scan, mesh) = beside_fill(&mut *fill, bench, stages, rounds)?;
    let ms = |time: Duration| time.as_secs_f64() * 1e3;
    println!(
        "| {device} | {cloth} | {} | {:.3} | {:.0} | {:.3} | {:.3} | {:.2} | {:.2} |",
        case.name,
        ms(fill),
        bytes as f64 / fill.as_secs_f64() / 1e9,
        ms(scan),
        ms(mesh),
        (scan + mesh).as_secs_f64() / fill.as_secs_f64(),
        (scan + mesh).as_secs_f64() / counts.triangles as f64 * 1e12,
    );
    Ok(())
}

/// Median times of the fill, of the scan, and of the mesh with stage 1. Each round runs the fill
/// first and then the stages.
fn beside_fill(
    fill: &mut dyn Fill,
    mut bench: Bench,
    stages: fn(&mut Bench) -> Result<StageTimings, SessionError>,
    rounds: usize,
) -> Result<(Duration, Duration, Duration), Box<dyn Error>> {
    stages(&mut bench)?;
    fill.run()?;
    let (mut fills, mut scans, mut meshes) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..rounds {
        fills.push(fill.run()?);
        let stages = stages(&mut bench)?;
        scans.push(stages.scan);
        meshes.push(stages.trajectory + stages.mesh);
    }
    Ok((median_time(&fills), median_time(&scans), median_time(&meshes)))
}
