//! Drives a file through everything that texere makes from a file.

use std::error::Error;
use std::io::sink;
use std::ops::ControlFlow;
use std::path::Path;

use texere_contact::clearance;
use texere_core::{Pipeline, PipelineError, PlanError, Section, Settings, Topology, Yarns};
use texere_cpu::ParallelBackend;
use texere_fabric::{FabricError, FinishError, Structure};
use texere_formats::read::{self, CurveScale, SavedYarns, read};
use texere_formats::write::{self, CurveFormat, Side};
use texere_formats::{Cloth, Design, Refusal, RestReport, WriteError};

/// The most crossings of a cloth whose yarns are made, and the most control points of a cloth whose
/// mesh is made.
const CROSSINGS: usize = 2_000;
const POINTS: usize = 10_000;

/// The outcome of an input.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Outcome {
    /// The design was refused, with this error and its causes.
    Refused(String),
    /// The design was read, but is too large to go on with.
    Large,
    /// The yarns were refused.
    NoYarns(String),
    /// The design was accepted, and passed through every step that its [`Depth`] asks for.
    Taken,
}

/// How far an accepted input goes on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Depth {
    /// It is written again, and its yarns are made.
    Yarns,
    /// Its draft is drawn as well, mesh, measures and clearance of its yarns are made, and the
    /// yarns begin to settle.
    Rest,
}

/// Reads the design in `path`, and goes on with it as far as `depth` says and its size allows.
///
/// # Panics
///
/// If a fault of texere shows: a message is long or would steer a terminal, an error of settling
/// does not name the file, a draft does not give its cloth, saved yarns or curves are written
/// otherwise than they were read, the number of points was counted wrongly, a mesh can't be made or
/// has numbers that are not finite, or a clearance can't be measured.
#[must_use]
pub fn drive(path: &Path, depth: Depth) -> Outcome {
    if path.extension().is_some_and(|ending| ending == "yarns") {
        return saved(path, depth);
    }
    if path
        .extension()
        .is_some_and(|ending| ["bcc", "obj", "usda", "tg3"].iter().any(|known| ending == *known))
    {
        return curves(path, depth);
    }
    let mut design = match read(path) {
        Ok(design) => design,
        Err(error) => return Outcome::Refused(chain(&error)),
    };
    for warning in design.warnings() {
        assert!(warning.chars().count() < 600, "a warning of {} characters", warning.chars().count());
    }
    let (weft, warp) = (design.structure.knitted(), design.structure.warp_knitted());
    if let Some(size) = weft.map(|knit| knit.size()).or(warp.map(|knit| knit.size())) {
        let size = size.map(|side| side as usize);
        if size[0].saturating_mul(size[1]) > CROSSINGS {
            return Outcome::Large;
        }
        sinks(&design, depth);
        return finished(&design, cloth(&design.structure, depth), depth);
    }
    let Some(woven) = design.structure.woven() else { return Outcome::Large };
    let (woven, draft) = (woven.cloth(), woven.draft());
    if woven.warp().len() * woven.weft().len() > CROSSINGS {
        return Outcome::Large;
    }
    if let Some(draft) = draft {
        assert_eq!(draft.drawdown().as_ref(), Ok(woven.drawdown()), "a draft that is another cloth's");
    }
    sinks(&design, depth);
    let outcome = finished(&design, cloth(&design.structure, depth), depth);
    // Replaces the section. If the design accepts it, makes the cloth once more.
    if design.structure.set_section(Section::Ellipse { aspect: 1.5 }).is_ok() {
        let _ = cloth(&design.structure, depth);
    }
    outcome
}

/// Writes all that `convert` and, if `depth` says so, `draft` write of a design, and drops what is
/// written.
fn sinks(design: &Design, depth: Depth) {
    let told = |outcome: Result<(), WriteError>| {
        if let Err(error) = outcome {
            let _ = chain(&error);
        }
    };
    told(write::toml_to(design, sink()).map(drop));
    told(write::wif_to(design, sink()).map(drop));
    told(write::knitout_to(design, sink()).map(drop));
    if depth == Depth::Yarns {
        return;
    }
    for side in [Side::Face, Side::Back] {
        match &design.structure {
            Structure::Woven(woven) => {
                told(write::draft_to(woven.cloth(), woven.draft(), side, sink()).map(drop));
            }
            Structure::Weft(knit) => {
                told(write::knit_draft_to(knit, side, sink()).map(drop));
                told(write::knit_rows(knit, side).map(|rows| assert!(rows.count() > 0)));
            }
            Structure::Warp(knit) => {
                told(write::warp_draft_to(knit, side, sink()).map(drop));
                let _ = write::warp_rows(knit);
            }
            _ => {}
        }
    }
}

/// The most control points of a cloth that settles, and the most passes of each form of settling,
/// weighted and block, that it gets.
const SETTLING_POINTS: usize = 300;
const PASSES: u32 = 3;

/// Passes after which stretching is stopped. A whole stretch settles a cloth up to 49 times, which
/// takes seconds.
const STRETCHING: u32 = 100;

/// The share of the progress at which stretching is done.
const STRETCHED: f64 = 0.5;

/// Begins to settle the cloth as its design says, if `depth` says so, and returns `outcome`. An
/// error has to name the design's file, or the draft that the design names.
fn finished(design: &Design, outcome: Outcome, depth: Depth) -> Outcome {
    let points = || design.yarns().map_or(0, |yarns| yarns.points().len());
    if depth == Depth::Yarns || outcome != Outcome::Taken || !design.settle || points() > SETTLING_POINTS {
        return outcome;
    }
    let mut design = design.clone();
    design.finish.passes = PASSES;
    let mut rested = rested(design.clone());
    if matches!(rested, Err(Refusal::Other(FinishError::Fabric(FabricError::Cancelled)))) {
        design.stretch = None;
        rested = self::rested(design);
    }
    let refusal = match &rested {
        Ok(cloth) => match cloth.report() {
            RestReport::Refused { reason, .. } => Some(reason),
            _ => None,
        },
        Err(refusal) => Some(refusal),
    };
    if let Some(refusal) = refusal {
        let said = chain(refusal);
        let names_file = ["design.", "draft."].iter().any(|file| said.contains(file));
        assert!(names_file, "an error without its file: {said}");
    }
    outcome
}

/// The cloth of the design at rest. The work is stopped if stretching takes more than
/// [`STRETCHING`] passes.
fn rested(design: Design) -> Result<Cloth, Refusal> {
    let backend = ParallelBackend::open().expect("the CPU's backend");
    let (is_stretched, mut passes) = (design.stretch.is_some(), 0..STRETCHING);
    let on = |share| {
        let stretches = is_stretched && share < STRETCHED;
        if stretches && passes.next().is_none() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    design.rest(&backend).progress(on).run()
}

/// Reads saved yarns and writes them again. If `depth` says so, makes their mesh and clearance.
fn saved(path: &Path, depth: Depth) -> Outcome {
    let SavedYarns { yarns, boundary } = match read::yarns(path) {
        Ok(saved) => saved,
        Err(error) => return Outcome::Refused(chain(&error)),
    };
    let mut again = Vec::new();
    write::repeat_to(&yarns, &boundary, &mut again).expect("a file in memory");
    assert!(
        std::fs::read(path).is_ok_and(|file| is_as_written(&yarns, &file, &again)),
        "a file that is another one when it is written again"
    );
    meshed(&yarns, depth)
}

/// Whether `file` equals `again`, which texere writes for the `yarns` of `file`. The number of a
/// valley between plies may differ. texere writes 0 if nothing presses the plies, and the file may
/// have the valley's own number, which means the same. The checksum may then differ, too.
fn is_as_written(yarns: &Yarns, file: &[u8], again: &[u8]) -> bool {
    const CHECKSUM: usize = 4;
    let differ = |one: &[u8], other: &[u8]| one.iter().zip(other).filter(|(a, b)| a != b).count();
    let named_by_a_number = |section: &&Section| matches!(**section, Section::Lobed { plies, .. } if **section == Section::plied(plies));
    let valleys = yarns.layout().sections().iter().filter(named_by_a_number).count();
    let checksum = file.len().saturating_sub(CHECKSUM);
    file == again
        || file.len() == again.len()
            && differ(&file[..checksum], &again[..checksum]) <= valleys * size_of::<f32>()
            && read::yarns_from("again", again)
                .is_ok_and(|read| read.yarns.layout().sections() == yarns.layout().sections())
}

/// Reads curves and writes them again. Read once more, they have to be the same. If `depth` says
/// so, makes their mesh and clearance.
fn curves(path: &Path, depth: Depth) -> Outcome {
    let given = CurveScale { unit_mm: Some(1.0), diameter_mm: Some(0.2) };
    // Files of USD and TexGen say both themselves.
    let says_both = path.extension().is_some_and(|ending| ending == "usda" || ending == "tg3");
    let yarns = match read::curves(path, if says_both { CurveScale::default() } else { given }) {
        // BCC holds splines of tension 0 alone.
        Ok(yarns) => yarns.with_tension(0.0).expect("a tension in range"),
        Err(error) => return Outcome::Refused(chain(&error)),
    };
    let mut again = Vec::new();
    write::curves_to(&yarns, CurveFormat::Bcc, &mut again).expect("a file in memory");
    let read = read::curves_from("again", &again, given).expect("a file of the house");
    let places =
        |yarns: &Yarns| yarns.points().iter().map(|point| [point.x, point.y, point.z]).collect::<Vec<_>>();
    assert!(
        places(&read) == places(&yarns) && read.layout().offsets() == yarns.layout().offsets(),
        "curves that are others when they are read again"
    );
    meshed(&yarns, depth)
}

/// Makes the yarns of a small cloth and, if `depth` says so, their mesh, measures and clearance.
fn cloth(structure: &Structure, depth: Depth) -> Outcome {
    let yarns = match structure.yarns() {
        Ok(yarns) => yarns,
        Err(error) => return Outcome::NoYarns(chain(&error)),
    };
    if let Some(woven) = structure.woven() {
        let counted = woven.cloth().point_count();
        assert_eq!(counted, yarns.points().len() as u64, "points that were not counted");
    }
    let outcome = meshed(&yarns, depth);
    if depth == Depth::Rest && outcome == Outcome::Taken {
        let _ = structure.measures(&yarns);
    }
    outcome
}

/// Makes mesh and clearance of a few yarns, if `depth` says so.
fn meshed(yarns: &Yarns, depth: Depth) -> Outcome {
    if yarns.points().len() > POINTS {
        return Outcome::Large;
    }
    if depth == Depth::Yarns {
        return Outcome::Taken;
    }
    let corners = yarns.layout().sections().iter().find_map(|section| match section {
        Section::Polygon(corners) => Some(corners.len() as u32),
        _ => None,
    });
    let pipeline = Pipeline::new(yarns)
        .sides(corners.unwrap_or(5))
        .subdivisions(1)
        .topology(Topology::Indexed)
        .caps(true);
    match pipeline.mesh(&ParallelBackend::open().expect("the CPU's backend")) {
        Ok(mesh) => {
            let whole = |vertex: &texere_core::Vertex| {
                vertex.position.iter().chain(&vertex.normal).all(|value| value.is_finite())
            };
            assert!(mesh.vertices.iter().all(whole), "a vertex that is no place");
        }
        Err(PipelineError::Plan(PlanError::PolygonSides { .. })) => {}
        Err(error) => panic!("a mesh that could not be made: {}", chain(&error)),
    }
    let report = clearance(yarns, &Settings::default()).expect("clearance of sound yarns");
    assert!(report.min >= 0.0 && report.curvature_min >= 0.0, "{report:?}");
    Outcome::Taken
}

/// An error and its causes, on one line. Checks that each cause has fewer than 400 characters, and
/// that no text holds codes that control a terminal.
fn chain(error: &dyn Error) -> String {
    let mut chain = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        let message = error.to_string();
        assert!(
            message.chars().count() < 400,
            "a message of {} characters: {message:.200}",
            message.chars().count()
        );
        chain = format!("{chain}: {message}");
        cause = error.source();
    }
    assert!(
        !chain.contains(|letter: char| letter.is_control()),
        "a message that steers a terminal: {chain:?}"
    );
    chain
}
