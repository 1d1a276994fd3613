//! From a design to its mesh on a device, stage by stage: what the paper's figure 7 takes about ten seconds for.

use std::error::Error;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use texere::{Backend, Finished, Limits, Piece, Plan, Settings, WovenRest, Yarns};
use texere_core::Session;
use texere_core::settling::{self, Settler, SettlingPlan, settle, settled};

use crate::measure::Bench;
use crate::one_yarn;

/// How long each stage of a design took, by the host's clock, and how large it is.
#[derive(Debug, Clone, Default)]
pub struct Stages {
    /// The design's name.
    pub name: String,
    /// Its yarns.
    pub yarns: usize,
    /// Their control points.
    pub points: u64,
    /// Triangles of the mesh.
    pub triangles: u64,
    /// The file is read, and the structure is made of it.
    pub read: Duration,
    /// The structure gives its yarns.
    pub generate: Duration,
    /// The tables of mesh and settling, counted and sent.
    pub plan: Duration,
    /// Yarns come to rest on the device; nothing where the design's don't settle.
    pub settle: Option<Duration>,
    /// How they rest then.
    pub rest: Option<Rest>,
    /// Control points to the session: from the host, or from where they settled.
    pub take: Duration,
    /// Both stages of the mesh, all chunks, in the device's own memory.
    pub mesh: Duration,
}

/// How yarns rest.
#[derive(Debug, Clone, Copy)]
pub struct Rest {
    /// Whether they do.
    pub at_rest: bool,
    /// The least distance of two yarns over both reaches.
    pub clearance: f64,
    /// The least radius of curvature of a knit, in diameters.
    pub radius: Option<f32>,
}

impl From<&settling::Rest> for Rest {
    fn from(rest: &settling::Rest) -> Self {
        let settling::Seen { clearance, radius, .. } = rest.end;
        Self { at_rest: rest.at_rest, clearance: f64::from(clearance), radius: Some(radius) }
    }
}

impl From<&WovenRest> for Rest {
    fn from(rest: &WovenRest) -> Self {
        Self { at_rest: rest.crossings.at_rest, clearance: rest.clearance[1], radius: None }
    }
}

impl Stages {
    /// All stages together.
    #[must_use]
    pub fn whole(&self) -> Duration {
        let Self { read, generate, plan, settle, take, mesh, .. } = *self;
        read + generate + plan + settle.unwrap_or_default() + take + mesh
    }
}

/// Takes the design in `path` to a mesh in the memory of `device`, and gives its yarns as they lie there, too. A knit that has settled stays on
/// the device where it is one piece; where it is one repeat, that is read, copied and sent. Woven cloth is drawn from its crossings on the host.
///
/// # Errors
///
/// Whatever the reader, the structure or the device says.
pub fn stages(path: &Path, device: &dyn Backend) -> Result<(Stages, Yarns), Box<dyn Error>> {
    let settings = Settings::default();
    let mut clock = Clock(Instant::now());
    let design = texere::read(path)?;
    let mut stages = Stages { name: design.name.clone(), read: clock.lap(), ..Stages::default() };
    let mut cloth = if design.settle && design.structure.woven().is_some() {
        let finished = design
            .structure
            .settle(&design.finish, settings.tension, device, |_| ControlFlow::Continue(()))?;
        stages.settle = Some(clock.lap());
        if let Finished::Woven(rest) = &finished {
            stages.rest = Some(rest.into());
        }
        Cloth::Laid(finished.into_yarns())
    } else if design.settle {
        let repeat = design.structure.repeat()?;
        stages.generate = clock.lap();
        let finish = design.structure.finish_of(&repeat, &design.finish, settings.tension);
        let plan = Arc::new(SettlingPlan::new(&repeat.piece.settling(&finish, settings.tension))?);
        let mut settler = device.settler(plan.clone())?;
        stages.plan = clock.lap();
        let rest = settle(&plan, &mut *settler, |_, _| ControlFlow::Continue(()))?;
        stages.rest = Some((&rest).into());
        stages.settle = Some(clock.lap());
        if repeat.copies == [1, 1] {
            Cloth::OnDevice(repeat.piece, plan, settler)
        } else {
            let points = settled(&plan, &mut *settler, repeat.piece.yarns.points())?;
            Cloth::Laid(design.structure.laid(&repeat, &repeat.piece.moved(&points)?)?)
        }
    } else {
        let yarns = design.yarns()?;
        stages.generate = clock.lap();
        Cloth::Laid(yarns)
    };
    stages.take += clock.lap();
    let plan = Arc::new(Plan::new(cloth.yarns().layout().clone(), settings)?);
    // Two chunks of this size fit beside a settler on the devices that are measured.
    let limits = device.info().limits.min(&Limits { memory_bytes: CHUNKS, ..Limits::NONE });
    let chunks: Vec<_> = plan.chunks(&limits)?.collect();
    let mut session = Session::new(device, plan.clone())?;
    stages.plan += clock.lap();
    match &mut cloth {
        Cloth::OnDevice(_, _, settler) => session.take_settled(&mut **settler)?,
        Cloth::Laid(yarns) => session.upload(0, yarns.points())?,
    }
    // Times are of work that has ended.
    session.timings();
    stages.take += clock.lap();
    session.scan()?;
    for chunk in &chunks {
        session.mesh(chunk)?;
    }
    session.timings();
    stages.mesh = clock.lap();
    let layout = cloth.yarns().layout();
    (stages.yarns, stages.points) = (layout.yarns().len(), layout.point_count());
    stages.triangles = plan.counts().triangles;
    Ok((stages, cloth.read()?))
}

/// A cloth whose mesh can be made.
enum Cloth {
    /// Its yarns lie on the host.
    Laid(Yarns),
    /// It is one piece, and rests where it has settled.
    OnDevice(Piece, Arc<SettlingPlan>, Box<dyn Settler>),
}

impl Cloth {
    /// Its yarns; of one that rests on a device, as they were before.
    const fn yarns(&self) -> &Yarns {
        match self {
            Self::Laid(yarns) => yarns,
            Self::OnDevice(piece, ..) => &piece.yarns,
        }
    }

    /// Its yarns as they lie.
    fn read(self) -> Result<Yarns, Box<dyn Error>> {
        match self {
            Self::Laid(yarns) => Ok(yarns),
            Self::OnDevice(piece, plan, mut settler) => {
                Ok(piece.moved(&settled(&plan, &mut *settler, piece.yarns.points())?)?)
            }
        }
    }
}

/// Prints a row for each design, each of a second run, when the device is warm.
///
/// # Errors
///
/// Those of [`stages`].
pub fn print(designs: &[impl AsRef<Path>], device: &str) -> Result<(), Box<dyn Error>> {
    let backend = texere::open(device)?;
    println!(
        "| design, on {device} | yarns | control points | triangles | read, ms | generate | plan | settle | points | mesh | whole | at rest, clearance, radius / d |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|---|");
    for path in designs {
        stages(path.as_ref(), &*backend)?;
        let (row, _) = stages(path.as_ref(), &*backend)?;
        let ms = |time: Duration| time.as_secs_f64() * 1e3;
        let settle = row.settle.map_or_else(|| "-".into(), |time| format!("{:.0}", ms(time)));
        let rest = row.rest.map_or_else(
            || "-".into(),
            |Rest { at_rest, clearance, radius }| {
                let radius = radius.map_or_else(|| "-".into(), |radius| format!("{radius:.3}"));
                format!("{at_rest}, {clearance:.3}, {radius}")
            },
        );
        println!(
            "| {} | {} | {} | {} | {:.0} | {:.0} | {:.0} | {settle} | {:.1} | {:.2} | {:.0} | {rest} |",
            row.name,
            row.yarns,
            row.points,
            row.triangles,
            ms(row.read),
            ms(row.generate),
            ms(row.plan),
            ms(row.take),
            ms(row.mesh),
            ms(row.whole()),
        );
    }
    Ok(())
}

/// Prints what a triangle of each design's mesh takes on a device that is warm, and what it takes where all its control points lie in
/// one yarn, as in a knit of one carrier.
///
/// # Errors
///
/// Whatever the reader, the structure or the device says.
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

/// Bytes that the chunks of a mesh may take.
const CHUNKS: u64 = 32 << 30;

/// Laps of one clock.
#[derive(Debug)]
struct Clock(Instant);

impl Clock {
    /// Time since the lap before.
    fn lap(&mut self) -> Duration {
        let now = Instant::now();
        now.duration_since(std::mem::replace(&mut self.0, now))
    }
}
