//! How many rings twist needs: from the twist of yarns and how far apart their control points lie,
//! before anything is made.

use std::fmt;

use glam::DVec3;
use rayon::prelude::*;

use crate::backend::renew_virtual_ends;
use crate::definitions::tangent_factor;
use crate::sampling::SUBDIVISIONS_MAX;
use crate::{ControlPoint, Origin, Section, Settings, Yarn, Yarns};

/// By how much twist turns a section from one ring to the next at most, radians, where it shows: 30
/// degrees.
///
/// A tube is then nowhere narrower between two rings than cos 15°, 0.97, of what it is on them. At
/// half a lobe's turn, 90 degrees of two plies, nobody can tell which way the plies lean; beyond
/// that they lean the other way.
pub const TWIST_STEP: f64 = std::f64::consts::FRAC_PI_6;

/// The same of round yarns in a mesh, radians: 90 degrees. A circle looks the same however it is
/// turned, so all that shows is that the tube gets narrower between rings, here to cos 45°, 0.71.
/// It would be wrung, as `check` has it, from 120 degrees on.
const ROUND_STEP: f64 = std::f64::consts::FRAC_PI_2;

/// The most subdivisions that twist alone leads to: 5.3 turns between two control points. A sewing
/// thread of three plies with 1,200 turns a metre has that where its control points lie 4.4 mm
/// apart, a woollen yarn of 300 turns a metre at 18 mm.
pub const TWIST_SUBDIVISIONS_MAX: u32 = 63;

/// The most rings that twist alone leads to in a whole fabric: of six sides 600 MB of mesh. Hostile
/// twist would else make gigabytes of any cloth of a few hundred threads.
const TWIST_RINGS_MAX: u64 = 1 << 21;

/// A yarn whose twist the rings of a mesh are too far apart for, so that its plies lean the wrong
/// way or its tube is wrung. Written out, it is a warning of one line.
///
/// ```
/// use texere_core::{ControlPoint, Pipeline, Section, Settings, Undersampled, Yarn, Yarns};
/// // Two plies, 300 turns a metre, control points 2 mm apart: 216 degrees from one to the next.
/// let mut yarns = Yarns::builder();
/// yarns.section(Section::Lobed { plies: 2 });
/// let twist = 0.3 * std::f32::consts::TAU;
/// yarns.yarn(Yarn { twist, ..Yarn::default() }, &[0.0, 2.0, 4.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.5)));
/// let yarns = yarns.build()?;
/// let fixed = Pipeline::new(&yarns).subdivisions(1);
/// let warning = fixed.undersampled().map(|found| found.to_string()).unwrap_or_default();
/// assert!(warning.starts_with("undersampled twist: yarn turns by 108 degrees from ring to ring"), "{warning}");
/// assert!(warning.ends_with("7 subdivisions do"), "{warning}");
/// assert_eq!(Settings::of(&yarns).subdivisions, 7);
/// assert_eq!(Pipeline::new(&yarns).undersampled(), None);
/// # Ok::<(), texere_core::YarnError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Undersampled {
    /// The yarn of which that is worst.
    pub yarn: usize,
    /// Where it comes from.
    pub origin: Origin,
    /// By how much twist turns it from one ring to the next, radians.
    pub step: f64,
    /// How much at most is drawn as it is, radians: [`TWIST_STEP`], and three times that for round
    /// yarns.
    pub step_max: f64,
    /// The fewest subdivisions that do. There may be more than a mesh can have.
    pub needed: u64,
}

impl Undersampled {
    /// What a mesh of `yarns` with `settings` does not show of their twist, if anything.
    #[must_use]
    pub fn of(yarns: &Yarns, settings: &Settings) -> Option<Self> {
        let most = Turning::most(yarns, step_of_outline)?;
        let steps = u64::from(settings.subdivisions) + 1;
        (most.steps() > steps).then(|| Self {
            yarn: most.yarn,
            origin: yarns.layout().yarns()[most.yarn].origin,
            step: most.interval / steps as f64,
            step_max: most.step_max,
            needed: most.steps() - 1,
        })
    }
}

impl fmt::Display for Undersampled {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { origin, step, step_max, needed, yarn: _ } = self;
        let (step, most) = (step.to_degrees(), step_max.to_degrees());
        write!(
            f,
            "undersampled twist: {origin} turns by {step:.0} degrees from ring to ring, more than the {most:.0} that show it as it is; "
        )?;
        if *needed > u64::from(SUBDIVISIONS_MAX) {
            write!(f, "not even {SUBDIVISIONS_MAX} subdivisions do, which are the most there can be")
        } else {
            write!(f, "{needed} subdivisions do")
        }
    }
}

impl Settings {
    /// The usual settings for a mesh of `yarns`: [`Settings::default`], but as many subdivisions as
    /// [their twist needs](Settings::following), and as many sides as a polygon has
    /// [corners](crate::Layout::corners).
    #[must_use]
    pub fn of(yarns: &Yarns) -> Self {
        Self::sided(yarns).following(yarns)
    }

    /// [`Settings::default`], but for as many sides as a polygon among the sections has corners.
    pub(crate) fn sided(yarns: &Yarns) -> Self {
        let usual = Self::default();
        Self { sides: yarns.layout().corners().unwrap_or(usual.sides), ..usual }
    }

    /// The same with so many subdivisions that rings follow the twist of all `yarns`: it turns none
    /// by more than [`TWIST_STEP`] from one ring to the next, and no round yarn, of which twist
    /// hardly shows, by more than 90 degrees.
    ///
    /// There are never fewer than before, and never more than [`TWIST_SUBDIVISIONS_MAX`] or than
    /// make two million rings in all, unless there were before. What is left then is told by
    /// [`Undersampled::of`].
    #[must_use]
    pub fn following(self, yarns: &Yarns) -> Self {
        self.with_steps(yarns, Turning::most(yarns, step_of_outline))
    }

    /// The same for pictures, which show fibres, and so the twist of round yarns too: no yarn is
    /// turned by more than [`TWIST_STEP`], within the same bounds.
    #[must_use]
    pub fn following_fibres(self, yarns: &Yarns) -> Self {
        self.with_steps(yarns, Turning::most(yarns, |_| TWIST_STEP))
    }

    fn with_steps(self, yarns: &Yarns, most: Option<Turning>) -> Self {
        let Some(most) = most else { return self };
        let affordable = (TWIST_RINGS_MAX / yarns.layout().point_count()).saturating_sub(1);
        let least = u64::from(self.subdivisions);
        let wanted = (most.steps() - 1).min(u64::from(TWIST_SUBDIVISIONS_MAX)).min(affordable);
        Self { subdivisions: wanted.max(least) as u32, ..self }
    }
}

/// By how much a section may be turned from one ring to the next so that its outline is drawn as it
/// is, radians.
fn step_of_outline(section: &Section) -> f64 {
    if *section == Section::Circle { ROUND_STEP } else { TWIST_STEP }
}

/// How far twist turns a yarn.
#[derive(Debug, Clone, Copy)]
struct Turning {
    yarn: usize,
    /// Radians in the interval between two control points in which that is most, if its rings lay
    /// there as densely as where they lie furthest apart.
    interval: f64,
    /// Radians that it may be from ring to ring.
    step_max: f64,
}

impl Turning {
    /// The yarn that needs most rings, of those that are twisted. Of equal ones the first.
    fn most(yarns: &Yarns, step_max: impl Fn(&Section) -> f64 + Sync) -> Option<Self> {
        let layout = yarns.layout();
        let turning = |(number, yarn): (usize, &Yarn)| {
            let points = yarns.yarn_points(number).filter(|_| yarn.twist != 0.0)?;
            let step_max = step_max(&layout.sections()[yarn.section as usize]);
            Some(Self { yarn: number, interval: turn_of_interval(yarn, points, layout.tension()), step_max })
        };
        let more = |one: Self, other: Self| if other.share() > one.share() { other } else { one };
        layout.yarns().par_iter().enumerate().filter_map(turning).reduce_with(more)
    }

    fn share(&self) -> f64 {
        self.interval / self.step_max
    }

    /// The fewest steps between two control points.
    fn steps(&self) -> u64 {
        // What rounding adds to a share that is whole is no step.
        ((self.share() - 1e-6).ceil() as u64).max(1)
    }
}

/// The most that twist turns a yarn within an interval, radians.
fn turn_of_interval(yarn: &Yarn, points: &[ControlPoint], tension: f32) -> f64 {
    let mut padded = Vec::with_capacity(points.len() + 4);
    padded.extend(points.first());
    padded.extend_from_slice(points);
    padded.resize(points.len() + if yarn.closed { 4 } else { 2 }, points[0]);
    renew_virtual_ends(&mut padded, yarn.closed);
    let s = f64::from(tangent_factor::<f32>(tension));
    let fastest = padded.windows(4).map(|window| fastest(window, s)).fold(0.0, f64::max);
    // A closed yarn gives back up to half a turn along its way, so that its ends meet.
    let closing = if yarn.closed { std::f64::consts::PI / points.len() as f64 } else { 0.0 };
    f64::from(yarn.twist.abs()) * fastest + closing
}

/// No less than the spline's greatest speed between the middle two of four points, mm an interval,
/// and no more than rings that lie evenly in it need by much: a cubic's velocity lies in the hull
/// of its three Bézier points, here of those of either half.
fn fastest(window: &[ControlPoint], s: f64) -> f64 {
    let at = |point: usize| window[point].position().as_dvec3();
    let (span, first, last) = (at(2) - at(1), (at(2) - at(0)) * s, (at(3) - at(1)) * s);
    let middle = span * 3.0 - first - last;
    let halves = [(first + middle) / 2.0, (middle + last) / 2.0];
    let velocities = [first, halves[0], (halves[0] + halves[1]) / 2.0, halves[1], last];
    velocities.into_iter().map(DVec3::length).fold(0.0, f64::max)
}
