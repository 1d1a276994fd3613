//! The code that the benchmarks of all stages share: the benchmark cloth of the paper that texere
//! implements (README.md), and sessions that are ready to run.

#[cfg(feature = "gpu")]
pub mod crossings;
#[cfg(feature = "gpu")]
pub mod edits;
#[cfg(feature = "gpu")]
pub mod figure_7;
#[cfg(feature = "gpu")]
pub mod fill;
#[cfg(feature = "gpu")]
pub mod floor;
#[cfg(feature = "gpu")]
pub mod measure;
#[cfg(feature = "gpu")]
pub mod phases;
#[cfg(feature = "gpu")]
pub mod pictures;
#[cfg(feature = "gpu")]
pub mod settling;
#[cfg(feature = "gpu")]
pub mod stages;
pub mod stream;
#[cfg(feature = "gpu")]
pub mod tables;

use std::sync::Arc;

use texere::backend::Plan;
use texere::mesh::{Limits, PlanError};
use texere::woven::{Shape, Thread, Weave, Woven};
use texere::yarn::{Material, Section, YarnError};
use texere::{Backend, FabricError, Settings, Yarn, Yarns};
use texere_core::backend::{Chunk, Session, SessionError};

/// The sizes that are benchmarked, (ends, picks): the paper's smallest cloth, its third of six, and
/// its largest.
pub const SIZES: [(usize, usize); 3] = [(163, 150), (815, 750), (2880, 1840)];

/// The sizes of this run: all [`SIZES`] under `cargo bench`, and the smallest under `cargo test`,
/// which only checks that the benches run.
pub fn sizes() -> impl Iterator<Item = (usize, usize)> {
    let measured = std::env::args().any(|argument| argument == "--bench");
    SIZES.into_iter().take(if measured { SIZES.len() } else { 1 })
}

/// The size, (ends, picks), of the cloth on which settings, fabrics and backends are compared.
pub const SWEEP: (usize, usize) = (489, 450);

/// The CPU backends that are benchmarked: the serial one, then the parallel one.
pub const DEVICES: [&str; 2] = ["cpu-serial", "cpu"];

/// The paper's cloth: 3/1 twill, a pitch of three diameters, and one control point at each
/// crossing.
///
/// **Errors**: [`FabricError`] for a size that no cloth has.
pub fn paper_cloth(ends: usize, picks: usize) -> Result<Woven, FabricError> {
    let thread = Thread::new(0.75, 0.125);
    let drawdown = Weave::parse("3/1")?.drawdown(ends, picks)?;
    let (warp, weft) = (vec![thread; ends], vec![thread; picks]);
    let mut cloth = Woven::new(drawdown, warp, weft, vec![Material::default()], vec![Section::Circle])?;
    cloth.set_shape(Shape::Crossing);
    Ok(cloth)
}

/// All control points of `yarns` in a single yarn.
///
/// **Errors**: [`YarnError`] for more control points than one yarn may have.
pub fn one_yarn(yarns: &Yarns) -> Result<Yarns, YarnError> {
    let mut one = Yarns::builder();
    one.yarn(Yarn::default(), yarns.points());
    one.build()
}

/// A copy of `yarns` with a twist of `twist` rad/mm. Round sections become `flatness` times as wide
/// as high, and keep their area.
///
/// **Errors**: [`YarnError`] for a size or a twist that no yarn may have.
pub fn shaped(yarns: &Yarns, twist: f32, flatness: f32) -> Result<Yarns, YarnError> {
    let mut shaped = Yarns::builder();
    let widen = flatness.sqrt();
    for (number, yarn) in yarns.layout().yarns().iter().enumerate() {
        let points = yarns.yarn_points(number).unwrap_or_default();
        let points: Vec<_> = points
            .iter()
            .map(|point| point.flattened(point.half_width() * widen, point.half_height() / widen))
            .collect();
        shaped.yarn(Yarn { twist, ..*yarn }, &points);
    }
    shaped.build()
}

/// The plan for `yarns`, and its chunks for a device without limits. With the default settings, a
/// cloth no larger than the paper's largest is one chunk.
///
/// **Errors**: [`PlanError`] for settings that are not allowed, or more rings than a plan can have.
pub fn plan(yarns: &Yarns, settings: Settings) -> Result<(Arc<Plan>, Vec<Chunk>), PlanError> {
    let plan = Arc::new(Plan::new(yarns.layout().clone(), settings)?);
    let chunks = plan.chunks(&Limits::NONE)?.collect();
    Ok((plan, chunks))
}

/// A session on `device` that holds `yarns`, uploaded and scanned.
///
/// **Errors**: [`SessionError`] for yarns that do not fit `plan`, or a device that fails.
pub fn session(device: &dyn Backend, plan: &Arc<Plan>, yarns: &Yarns) -> Result<Session, SessionError> {
    let mut session = Session::new(device, plan.clone())?;
    session.upload(0, yarns.points())?;
    session.scan()?;
    Ok(session)
}

/// The median of some times or ratios.
#[must_use]
pub fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}
