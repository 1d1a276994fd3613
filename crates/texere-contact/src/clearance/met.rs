//! What the search has worked out for one interval of a cell.

use std::cell::OnceCell;

use super::chords::{SAGITTA, Usual};
use super::extent::Extent;
use super::interval::Cubic;
use super::part::Part;
use super::passing::Passing;
use super::rolls::{IntervalRolls, Rolls};
use super::support::Support;

/// What the comparisons of an interval with others need. Each part is worked out when it is first
/// needed.
#[derive(Default)]
pub(super) struct Met {
    curve: OnceCell<Curve>,
    chords: OnceCell<Usual>,
    extent: OnceCell<Extent>,
}

impl Met {
    pub(super) fn curve(&self, part: &Part<'_>, rolls: &Rolls) -> &Curve {
        self.curve.get_or_init(|| Curve::new(part, rolls))
    }

    pub(super) fn chords(&self, curve: &Curve) -> &Usual {
        self.chords.get_or_init(|| Usual::of(&curve.cubic, SAGITTA))
    }

    pub(super) fn extent(&self, curve: &Curve, support: &Support) -> &Extent {
        self.extent.get_or_init(|| Extent::new(&curve.cubic, support))
    }
}

/// An interval's curve, section sizes and rolls.
pub(super) struct Curve {
    pub(super) cubic: Cubic,
    pub(super) passing: Passing,
    /// How far the yarn's surface may lie from its centreline, mm.
    pub(super) reach: f64,
    /// Whether sections are circles, so that the distance of the centrelines counts.
    pub(super) round: bool,
    /// Whether all sections are circles of one size.
    pub(super) even: bool,
    /// The rolls of the interval, from [`Rolls::of_interval`].
    pub(super) rolls: IntervalRolls,
}

impl Curve {
    fn new(part: &Part<'_>, rolls: &Rolls) -> Self {
        let (cubic, support) = (part.line.cubic(part.point), part.line.support);
        let reach = cubic.half_bound() * support.extent();
        let round = support.is_circle() && cubic.is_round();
        let (point, line) = (part.point, &part.line);
        let rolls = rolls.of_interval(line.yarn, point, line.window(point), line.window_after(point));
        Self { passing: Passing::new(&cubic), reach, round, even: round && cubic.is_even(), rolls, cubic }
    }
}
