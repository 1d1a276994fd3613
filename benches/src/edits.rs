//! Measures edits of a fabric whose mesh stays on its device, beside the whole mesh.

use std::error::Error;
use std::sync::Arc;
use std::time::{Duration, Instant};

use texere::backend::{LiveMesh, Plan};
use texere::mesh::Frame;
use texere::woven::Shape;
use texere::{Backend, Live, Settings, Yarns};
use texere_core::ControlPoint;

use crate::measure::median_time;
use crate::{paper_cloth, shaped};

/// The times and the bytes of an edit.
#[derive(Debug, Clone, Copy, Default)]
struct Took {
    /// The time by the host's clock, until the device was done.
    host: Duration,
    /// The time of scan and mesh, by the device's clock if it has one.
    device: Duration,
    /// The bytes of control points that were sent.
    bytes: u64,
}

/// Prints for each device the times of editing one yarn, without twist and with it, and one lift,
/// beside the time of the whole mesh. `yarns` and `lifts` are the numbers of ends and picks of the
/// two cloths. Times are medians of `rounds` runs, but the whole mesh beside a lift is made only
/// once.
///
/// # Errors
///
/// The errors of the device.
pub fn print(
    devices: &[String],
    yarns: (usize, usize),
    lifts: (usize, usize),
    rounds: usize,
) -> Result<(), Box<dyn Error>> {
    println!(
        "| device | cloth | edit | whole, ms | edit, ms | whole on the device, ms | edit there, ms | whole / edit | bytes sent |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    for name in devices {
        let device: Arc<dyn Backend> = Arc::from(texere::open(name)?);
        let cloth = paper_cloth(yarns.0, yarns.1)?.yarns()?;
        let turned = Settings { frame: Frame::RotationMinimizing, ..Settings::default() };
        for (what, cloth, settings) in [
            ("a yarn", cloth.clone(), Settings::default()),
            ("a twisted yarn", shaped(&cloth, 1.0, 1.0)?, turned),
        ] {
            row(name, yarns, what, a_yarn(&*device, &cloth, settings, rounds)?);
        }
        row(name, lifts, "a lift", a_lift(&device, lifts, rounds)?);
    }
    Ok(())
}

fn row(name: &str, (ends, picks): (usize, usize), what: &str, [whole, edit]: [Took; 2]) {
    let ms = |time: Duration| time.as_secs_f64() * 1e3;
    println!(
        "| {name} | {ends} x {picks} | {what} | {:.3} | {:.4} | {:.3} | {:.4} | {:.0} | {} |",
        ms(whole.host),
        ms(edit.host),
        ms(whole.device),
        ms(edit.device),
        whole.host.as_secs_f64() / edit.host.as_secs_f64(),
        edit.bytes,
    );
}

/// Times of the whole mesh, and of the edit of a pick in the middle that moves up and down.
fn a_yarn(
    device: &dyn Backend,
    yarns: &Yarns,
    settings: Settings,
    rounds: usize,
) -> Result<[Took; 2], Box<dyn Error>> {
    let mut mesh = LiveMesh::new(device, Arc::new(Plan::new(yarns.layout().clone(), settings)?))?;
    let edited = yarns.layout().yarns().len() * 3 / 4;
    let first = yarns.layout().offsets()[edited];
    let points = yarns.yarn_points(edited).unwrap_or_default();
    mesh.upload(0, yarns.points())?;
    mesh.update()?;
    let whole = median((0..rounds).map(|_| {
        timed(&mut mesh, |mesh| {
            mesh.upload(0, yarns.points())?;
            Ok(mesh.update().map(drop)?)
        })
    }))?;
    let edit = median((0..rounds).map(|round| {
        let z = if round % 2 == 0 { 0.1 } else { 0.0 };
        let moved: Vec<_> = points.iter().map(|point| ControlPoint { z: point.z + z, ..*point }).collect();
        timed(&mut mesh, |mesh| {
            mesh.upload(first, &moved)?;
            Ok(mesh.update().map(drop)?)
        })
    }))?;
    Ok([whole, edit])
}

/// Times of the whole mesh of a cloth, and of a lift in its middle that changes back and forth.
/// Both times include laying the threads by the drawdown. The cloth has the shape [`Shape::Round`].
fn a_lift(
    device: &Arc<dyn Backend>,
    (ends, picks): (usize, usize),
    rounds: usize,
) -> Result<[Took; 2], Box<dyn Error>> {
    let mut cloth = paper_cloth(ends, picks)?;
    cloth.set_shape(Shape::Round);
    let (end, pick) = (ends / 2, picks / 2);
    let before = cloth.drawdown().up(end, pick);
    let began = Instant::now();
    let mut live = Live::weave(device.clone(), cloth, Settings::default())?;
    live.update()?;
    let stages = live.mesh_mut().timings();
    let whole = Took { host: began.elapsed(), device: stages.scan + stages.mesh, bytes: 0 };
    let edit = median((0..rounds).map(|round| {
        let (sent, stages) = (live.mesh().traffic().uploaded, live.mesh_mut().timings());
        let began = Instant::now();
        live.set_lift(end, pick, (round % 2 == 0) != before)?;
        live.update()?;
        let after = live.mesh_mut().timings();
        Ok(Took {
            host: began.elapsed(),
            device: after.scan + after.mesh - stages.scan - stages.mesh,
            bytes: live.mesh().traffic().uploaded - sent,
        })
    }))?;
    Ok([whole, edit])
}

fn timed(
    mesh: &mut LiveMesh,
    work: impl FnOnce(&mut LiveMesh) -> Result<(), Box<dyn Error>>,
) -> Result<Took, Box<dyn Error>> {
    let (sent, before) = (mesh.traffic().uploaded, mesh.timings());
    let began = Instant::now();
    work(mesh)?;
    let after = mesh.timings();
    Ok(Took {
        host: began.elapsed(),
        device: after.scan + after.mesh - before.scan - before.mesh,
        bytes: mesh.traffic().uploaded - sent,
    })
}

fn median(took: impl Iterator<Item = Result<Took, Box<dyn Error>>>) -> Result<Took, Box<dyn Error>> {
    let all = took.collect::<Result<Vec<_>, _>>()?;
    let of = |time: fn(&Took) -> Duration| median_time(&all.iter().map(time).collect::<Vec<_>>());
    let bytes = all.iter().map(|took| took.bytes).max().unwrap_or(0);
    Ok(Took { host: of(|took| took.host), device: of(|took| took.device), bytes })
}
