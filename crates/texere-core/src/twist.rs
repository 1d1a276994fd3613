//! The number of rings that twist needs. It is worked out from the twist of yarns and the distances
//! of their control points, before anything is made.

use std::fmt;

use glam::DVec3;
use rayon::prelude::*;

use crate::backend::renew_virtual_ends;
use crate::definitions::tangent_factor;
use crate::sampling::SUBDIVISIONS_MAX;
use crate::{ControlPoint, Origin, Section, Settings, Yarn, Yarns};

/// The largest turn by twist from one ring to the next, for a section that shows its turn, radians:
/// 30 degrees.
///
/// A tube is then nowhere narrower between two rings than cos 15°, 0.97, of its width on them. If
/// rings turn by half the angle from ply to ply (90 degrees with two plies), the direction in which
/// plies lean is lost. If they turn by more, plies appear to lean the other way.
pub const TWIST_STEP: f64 = std::f64::consts::FRAC_PI_6;

/// The largest turn by twist from one ring to the next, for a round yarn in a mesh, radians: 90
/// degrees. A circle looks the same however it is turned. The only visible effect is that the tube
/// gets narrower between rings, at 90 degrees to cos 45°, 0.71. The command `check` counts a tube
/// as wrung from 120 degrees on.
const ROUND_STEP: f64 = std::f64::consts::FRAC_PI_2;

/// The most subdivisions that are chosen for twist alone. They are enough for 5.3 turns between two
/// control points. A three-ply sewing thread with 1,200 turns a metre needs as many if control
/// points lie 4.4 mm apart, and a woollen yarn of 300 turns a metre if they lie 18 mm apart.
pub const TWIST_SUBDIVISIONS_MAX: u32 = 63;

/// The most rings of a whole fabric that are chosen for twist alone. With six sides they are 600 MB
/// of mesh. Without this limit, a hostile twist would make a mesh of gigabytes from any cloth of a
/// few hundred threads.
const TWIST_RINGS_MAX: u64 = 1 << 21;

/// A warning: the rings of a mesh are too far apart for the twist of a yarn, so that its plies lean
/// the wrong way or its tube is wrung, that is, narrow between rings. The warning's text is one
/// line.
///
/// ```
/// use texere_core::{ControlPoint, Pipeline, Section, Settings, Undersampled, Yarn, Yarns};
/// // Two plies, 300 turns a metre, control points 2 mm apart: 216 degrees from one to the next.
/// let mut yarns = Yarns::builder();
/// yarns.section(Section::plied(2));
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
    /// Number of the yarn with the worst undersampling, counted from 0.
    pub yarn: usize,
    /// The yarn's origin.
    pub origin: Origin,
    /// The turn of the yarn by twist from one ring to the next, radians.
    pub step: f64,
    /// The largest turn that shows correctly, radians: [`TWIST_STEP`], and three times that for
    /// round yarns.
    pub step_max: f64,
    /// The fewest subdivisions that are enough. They may be more than a mesh can have.
    pub needed: u64,
}

impl Undersampled {
    /// The warning for a mesh of `yarns` with `settings`, if it undersamples their twist.
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
    /// The usual settings for a mesh of `yarns`: [`Settings::default`], with the subdivisions that
    /// [their twist needs](Settings::following) and the sides that a polygon's
    /// [corners](crate::Layout::corners) need.
    #[must_use]
    pub fn of(yarns: &Yarns) -> Self {
        Self::sided(yarns).following(yarns)
    }

    /// [`Settings::default`], with as many sides as a polygon among the sections has corners.
    pub(crate) fn sided(yarns: &Yarns) -> Self {
        let usual = Self::default();
        Self { sides: yarns.layout().corners().unwrap_or(usual.sides), ..usual }
    }

    /// These settings with enough subdivisions for the twist of all `yarns`. No yarn then turns by
    /// more than [`TWIST_STEP`] from one ring to the next. A round yarn may turn by 90 degrees,
    /// because its twist hardly shows.
    ///
    /// The number of subdivisions never falls. It is not raised above [`TWIST_SUBDIVISIONS_MAX`],
    /// or to more than two million rings in all. [`Undersampled::of`] reports the twist that is
    /// still undersampled.
    #[must_use]
    pub fn following(self, yarns: &Yarns) -> Self {
        self.with_steps(yarns, Turning::most(yarns, step_of_outline))
    }

    /// These settings with enough subdivisions for pictures. Pictures show fibres and therefore the
    /// twist of round yarns, so no yarn turns by more than [`TWIST_STEP`]. The bounds are those of
    /// [`Settings::following`].
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

/// The largest turn of a section from one ring to the next that shows its outline correctly,
/// radians.
fn step_of_outline(section: &Section) -> f64 {
    if *section == Section::Circle { ROUND_STEP } else { TWIST_STEP }
}

/// The turn of a yarn by twist.
#[derive(Debug, Clone, Copy)]
struct Turning {
    yarn: usize,
    /// The turn, radians, in the interval with most turn. All rings of the interval count as if
    /// they were as far apart as the two that are furthest apart.
    interval: f64,
    /// The largest allowed turn from ring to ring, radians.
    step_max: f64,
}

impl Turning {
    /// The twisted yarn that needs most rings per interval. If several need as many, it is the
    /// first.
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
        // Rounding may add a little to a whole number, which must not count as another step.
        ((self.share() - 1e-6).ceil() as u64).max(1)
    }
}

/// The largest turn of a yarn by twist within an interval, radians.
fn turn_of_interval(yarn: &Yarn, points: &[ControlPoint], tension: f32) -> f64 {
    let mut padded = Vec::with_capacity(points.len() + 4);
    padded.extend(points.first());
    padded.extend_from_slice(points);
    padded.resize(points.len() + if yarn.closed { 4 } else { 2 }, points[0]);
    renew_virtual_ends(&mut padded, yarn.closed);
    let s = f64::from(tangent_factor::<f32>(tension));
    let fastest = padded.windows(4).map(|window| fastest(window, s)).fold(0.0, f64::max);
    // In a closed yarn, up to half a turn is taken back along the whole yarn, so that its ends
    // meet.
    let closing = if yarn.closed { std::f64::consts::PI / points.len() as f64 } else { 0.0 };
    f64::from(yarn.twist.abs()) * fastest + closing
}

/// An upper bound on the spline's speed between the middle two of four points, mm per interval. The
/// bound is only a little too large. The velocity lies in the hull of its three Bézier points, and
/// each half of the interval is bounded by its own three points.
fn fastest(window: &[ControlPoint], s: f64) -> f64 {
    let at = |point: usize| window[point].position().as_dvec3();
    let (span, first, last) = (at(2) - at(1), (at(2) - at(0)) * s, (at(3) - at(1)) * s);
    let middle = span * 3.0 - first - last;
    let halves = [(first + middle) / 2.0, (middle + last) / 2.0];
    let velocities = [first, halves[0], (halves[0] + halves[1]) / 2.0, halves[1], last];
    velocities.into_iter().map(DVec3::length).fold(0.0, f64::max)
}
