//! The mesh stage against the floor: a plain fill of the same bytes on the same device, side by side.

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

/// Prints a row for each device, size (ends, picks) and case: medians of `rounds` warm runs, by the device's clock.
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
    Ok(())
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
    let (whole, rest) = (counts.bytes() / BUFFER, counts.bytes() % BUFFER);
    let buffers: Vec<_> = (0..whole).map(|_| BUFFER).chain([rest]).filter(|bytes| *bytes > 0).collect();
    let mut rig = rig(device, &buffers)?;
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
