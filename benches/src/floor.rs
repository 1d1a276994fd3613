//! What a device reaches against its floor, side by side: the mesh stage beside a plain fill of the same bytes, reading and
//! uploading beside plain copies from and to pinned memory.

use std::error::Error;
use std::time::Duration;

use texere::{Frame, Settings, Topology};

use crate::fill::rig;
use crate::measure::{Bench, median_time};
use crate::paper_cloth;

/// What is asked of the mesh stage.
const CASES: [(&str, Frame, Topology); 3] = [
    ("upright, indexed", Frame::Upright, Topology::Indexed),
    ("upright, shared", Frame::Upright, Topology::Shared),
    ("rotation-minimising, indexed", Frame::RotationMinimizing, Topology::Indexed),
];

/// Bytes that one buffer of the fill has at most: what Vulkan binds on the devices that bind least of the large ones.
const BUFFER: u64 = (1 << 31) - 16;

/// Prints two tables: a row for each device, size (ends, picks) and case, medians of `rounds` warm runs by the device's
/// clock; and a row for each device and size with what goes over the bus, by the host's.
///
/// # Errors
///
/// Whatever the device says.
pub fn print(devices: &[String], sizes: &[(usize, usize)], rounds: usize) -> Result<(), Box<dyn Error>> {
    println!("| device | cloth | | fill, ms | GB/s | scan, ms | mesh, ms | times the fill | G triangles/s |");
    println!("|---|---|---|---|---|---|---|---|---|");
    for device in devices {
        for &(ends, picks) in sizes {
            for (name, frame, topology) in CASES {
                let settings = Settings { frame, topology, ..Settings::default() };
                print_case(device, ends, picks, name, settings, rounds)?;
            }
        }
    }
    println!(
        "\nOver the bus, GB/s: plain copies to and from pinned memory, `read_mesh` and `upload` beside them\n"
    );
    println!("| device | cloth | to host | mesh | share | to device | control points | share |");
    println!("|---|---|---|---|---|---|---|---|");
    for device in devices {
        for &(ends, picks) in sizes {
            print_bus(device, ends, picks, rounds)?;
        }
    }
    Ok(())
}

fn print_bus(device: &str, ends: usize, picks: usize, rounds: usize) -> Result<(), Box<dyn Error>> {
    let yarns = paper_cloth(ends, picks)?.yarns()?;
    let plan = texere::Pipeline::new(&yarns).plan()?;
    let (mesh, points) = (plan.counts().bytes(), plan.resident_bytes());
    let mut rig = rig(device, &buffers(mesh))?;
    let mut bench = Bench::new(&*rig.backend, yarns, Settings::default())?;
    bench.read()?;
    let (mut copied_out, mut read, mut copied_in, mut sent) =
        (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for _ in 0..rounds {
        copied_out.push(rig.fill.copy_to_host()?);
        read.push(bench.read()?);
        copied_in.extend(rig.fill.copy_from_host()?);
        sent.push(bench.send()?);
    }
    let rate = |bytes: u64, times: &[Duration]| bytes as f64 / median_time(times).as_secs_f64() / 1e9;
    let (bus_out, read, sent) = (rate(mesh, &copied_out), rate(mesh, &read), rate(points, &sent));
    let (bus_in, share) = if copied_in.is_empty() {
        ("-".into(), "-".into())
    } else {
        let bus_in = rate(mesh, &copied_in);
        (format!("{bus_in:.1}"), format!("{:.2}", sent / bus_in))
    };
    println!(
        "| {device} | {ends} x {picks} | {bus_out:.1} | {read:.1} | {:.2} | {bus_in} | {sent:.1} | {share} |",
        read / bus_out,
    );
    Ok(())
}

/// Lengths of buffers that hold `bytes` together.
fn buffers(bytes: u64) -> Vec<u64> {
    let (whole, rest) = (bytes / BUFFER, bytes % BUFFER);
    (0..whole).map(|_| BUFFER).chain([rest]).filter(|bytes| *bytes > 0).collect()
}

fn print_case(
    device: &str,
    ends: usize,
    picks: usize,
    name: &str,
    settings: Settings,
    rounds: usize,
) -> Result<(), Box<dyn Error>> {
    let yarns = paper_cloth(ends, picks)?.yarns()?;
    let counts = *texere::Pipeline::new(&yarns).settings(settings).plan()?.counts();
    let mut rig = rig(device, &buffers(counts.bytes()))?;
    let mut bench = Bench::new(&*rig.backend, yarns, settings)?;
    bench.fused()?;
    rig.fill.run()?;
    let (mut fill, mut scan, mut mesh) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..rounds {
        fill.push(rig.fill.run()?);
        let stages = bench.fused()?;
        scan.push(stages.scan);
        mesh.push(stages.trajectory + stages.mesh);
    }
    let ms = |time: Duration| time.as_secs_f64() * 1e3;
    let (fill, scan, mesh) = (median_time(&fill), median_time(&scan), median_time(&mesh));
    println!(
        "| {device} | {ends} x {picks} | {name} | {:.3} | {:.0} | {:.3} | {:.3} | {:.2} | {:.1} |",
        ms(fill),
        counts.bytes() as f64 / fill.as_secs_f64() / 1e9,
        ms(scan),
        ms(mesh),
        (scan + mesh).as_secs_f64() / fill.as_secs_f64(),
        counts.triangles as f64 / (scan + mesh).as_secs_f64() / 1e9,
    );
    Ok(())
}
