//! Measures the way from a design to its mesh on a device, stage by stage. The paper states about
//! ten seconds for each cloth of its figure 7.

use std::error::Error;
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use texere::backend::Plan;
use texere::mesh::Limits;
use texere::rest::{Finished, RestReport};
use texere::{Backend, Settings, Yarns};
use texere_core::backend::Session;

use crate::measure::Bench;
use crate::one_yarn;

/// The time of each stage of a design by the host's clock, and the design's counts.
#[derive(Debug, Clone, Default)]
pub struct Stages {
    /// The design's name.
    pub name: String,
    /// The number of yarns.
    pub yarns: usize,
    /// The number of control points of all yarns.
    pub points: u64,
    /// The number of triangles of the mesh.
    pub triangles: u64,
    /// Reading the file and making the structure.
    pub read: Duration,
    /// Placing the yarns, and letting them come to rest if the design asks for it:
    /// [`texere::Design::rest`].
    pub rest: Duration,
    /// The measures of the yarns after settling. None if the design does not settle.
    pub rests: Option<Rests>,
    /// Working out the tables of the mesh, and sending them.
    pub plan: Duration,
    /// Sending control points from the host to the session.
    pub take: Duration,
    /// Making the mesh of all chunks in the device's own memory, both stages.
    pub mesh: Duration,
}

/// The measures of yarns after settling, by their contacts or by their crossings.
#[derive(Debug, Clone, Copy)]
pub struct Rests {
    /// Whether the yarns are at rest.
    pub at_rest: bool,
    /// The least distance of two yarns, divided by the distance at which they would touch.
    pub clearance: f64,
    /// The least radius of curvature of a knit, in diameters. None for woven cloth.
    pub radius: Option<f32>,
}

impl Rests {
    fn of(finished: &Finished) -> Option<Self> {
        let at_rest = finished.is_at_rest();
        match finished {
            Finished::Knit(settled) => {
                let radius = Some(settled.rest.end.radius);
                Some(Self { at_rest, clearance: settled.clearance.min, radius })
            }
            Finished::Woven(rest) => Some(Self { at_rest, clearance: rest.clearance[1], radius: None }),
            _ => None,
        }
    }
}

impl Stages {
    /// The time of all stages together.
    #[must_use]
    pub fn whole(&self) -> Duration {
        let Self { read, rest, plan, take, mesh, .. } = *self;
        read + rest + plan + take + mesh
    }
}

/// Makes the mesh of the design in `path` in the memory of `device`, and returns the times of the
/// stages and the design's yarns.
///
/// # Errors
///
/// The errors of the reader, the structure and the device.
pub fn stages(path: &Path, device: &dyn Backend) -> Result<(Stages, Yarns), Box<dyn Error>> {
    let settings = Settings::default();
    let mut clock = Clock(Instant::now());
    let design = texere::read(path)?;
    let mut stages = Stages { name: design.name.clone(), read: clock.lap(), ..Stages::default() };
    let cloth = design.rest(device).run()?;
    stages.rest = clock.lap();
    if let RestReport::Finished(finished) = cloth.report() {
        stages.rests = Rests::of(finished);
    }
    let (_, yarns) = cloth.into_parts();
    let plan = Arc::new(Plan::new(yarns.layout().clone(), settings)?);
    // The devices that are measured have at least as much memory as this limit.
    let limits = device.info().limits.min(&Limits { memory_bytes: CHUNKS, ..Limits::NONE });
    let chunks: Vec<_> = plan.chunks(&limits)?.collect();
    let mut session = Session::new(device, plan.clone())?;
    stages.plan = clock.lap();
    session.upload(0, yarns.points())?;
    // Timings wait until the work has ended.
    session.timings();
    stages.take = clock.lap();
    session.scan()?;
    for chunk in &chunks {
        session.mesh(chunk)?;
    }
    session.timings();
    stages.mesh = clock.lap();
    (stages.yarns, stages.points) = (yarns.layout().yarns().len(), yarns.layout().point_count());
    stages.triangles = plan.counts().triangles;
    Ok((stages, yarns))
}

/// Prints a row for each design, with the times of a second run on the warm device.
///
/// # Errors
///
/// The errors of [`stages`].
pub fn print(designs: &[impl AsRef<Path>], device: &str) -> Result<(), Box<dyn Error>> {
    let backend = texere::open(device)?;
    println!(
        "| design, on {device} | yarns | control points | triangles | read, ms | rest | plan | points | mesh | whole | at rest, clearance, radius / d |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|");
    for path in designs {
        stages(path.as_ref(), &*backend)?;
        let (row, _) = stages(path.as_ref(), &*backend)?;
        let ms = |time: Duration| time.as_secs_f64() * 1e3;
        let rests = row.rests.map_or_else(
            || "-".into(),
            |Rests { at_rest, clearance, radius }| {
                let radius = radius.map_or_else(|| "-".into(), |radius| format!("{radius:.3}"));
                format!("{at_rest}, {clearance:.3}, {radius}")
            },
        );
        println!(
            "| {} | {} | {} | {} | {:.0} | {:.0} | {:.0} | {:.1} | {:.2} | {:.0} | {rests} |",
            row.name,
            row.yarns,
            row.points,
            row.triangles,
            ms(row.read),
            ms(row.rest),
            ms(row.plan),
            ms(row.take),
            ms(row.mesh),
            ms(row.whole()),
        );
    }
    Ok(())
}

/// Prints the time for a triangle of each design's mesh on a warm device, as it is, and with all
/// control points in one yarn, as in a knit of one carrier.
///
/// # Errors
///
/// The errors of the reader, the structure and the device.
pub fn print_one_yarn(designs: &[impl AsRef<Path>], device: &str) -> Result<(), Box<dyn Error>> {
    let backend = texere::open(device)?;
    println!("\n| mesh, on {device} | yarns | ps a triangle | in one yarn |\n|---|---|---|---|");
    for path in designs {
        let design = texere::read(path)?;
        let yarns = design.yarns()?;
        let each = |yarns: Yarns| -> Result<f64, Box<dyn Error>> {
            let mut bench = Bench::new(&*backend, yarns, Settings::default())?;
            bench.fused()?;
            let time = bench.fused()?.mesh.as_secs_f64();
            Ok(time * 1e12 / bench.plan.counts().triangles as f64)
        };
        let (count, one) = (yarns.layout().yarns().len(), one_yarn(&yarns)?);
        println!("| {} | {count} | {:.2} | {:.2} |", design.name, each(yarns)?, each(one)?);
    }
    Ok(())
}

/// The bytes of a device's memory that all control points and two chunks may take together.
const CHUNKS: u64 = 32 << 30;

/// A clock that measures the time from lap to lap.
#[derive(Debug)]
struct Clock(Instant);

impl Clock {
    /// The time since the lap before.
    fn lap(&mut self) -> Duration {
        let now = Instant::now();
        now.duration_since(std::mem::replace(&mut self.0, now))
    }
}
