//! The places where two intervals of round yarns come nearest to one another, refined on the
//! spline. A knot is a control point, at which one interval ends and the next begins. A parameter
//! goes from 0 to 1 along an interval, so a difference of parameters is a length in intervals.

use glam::{DMat2, DVec2, Vec2Swizzles};

use super::interval::{At, Cubic};
use super::passing::LEVEL;
use super::support::Support;

/// A parameter that is no further from a knot than this counts as at the knot, in intervals. With
/// half the value, and with twice, no test is red.
const AT_KNOT: f64 = 1e-6;

/// How far refinement may leave an interval before the approach belongs to another one, in
/// intervals. With half the value, `a_crossing_on_a_control_point_is_one_contact` is red; with
/// twice, no test is.
pub(super) const MARGIN: f64 = 0.05;

/// The most steps of one refinement. With half the value, and with twice, no test is red.
pub(super) const STEPS: usize = 40;

/// The longest step, in intervals. With half the value, and with twice, no test is red.
pub(super) const STRIDE: f64 = 0.25;

/// The length of a step that ends refinement, in intervals. The place is then off by about as much,
/// which changes the ratio only by the square of that length. With half the value, and with twice,
/// no test is red.
pub(super) const SHORT: f64 = 1e-5;

/// The length of a step that counts as none, in intervals. With half the value, and with twice, no
/// test is red.
const CLOSE: f64 = 1e-7;

/// The least curvature of an approach that counts as the only one nearby. The curvature of an
/// approach of two straight lines is 1 minus the cosine of the angle between them.
///
/// At 0.06 `it_agrees_with_brute_force` fails in one of 30,000 tangles: the search missed an
/// approach whose ratio was 0.0024 lower, in a valley of curvature below 0.1. With half the value,
/// and with twice, no test is red.
const VALLEY: f64 = 0.2;

/// One interval of a yarn, with its section and its ends.
#[derive(Debug, Clone, Copy)]
pub(super) struct Side<'a> {
    pub(super) cubic: &'a Cubic,
    pub(super) support: &'a Support,
    /// Whether the interval's beginning and end are cut ends of an open yarn.
    pub(super) cut: [bool; 2],
}

impl Side<'_> {
    /// `t`, or the knot next to `t`, if that place belongs to this interval. A knot within a yarn
    /// belongs to the later interval.
    pub(super) fn own(&self, t: f64) -> Option<f64> {
        if t < AT_KNOT {
            (self.cut[0] || t > -AT_KNOT).then_some(0.0)
        } else if t > 1.0 - AT_KNOT {
            self.cut[1].then_some(1.0)
        } else {
            Some(t)
        }
    }

    /// Whether `t` has reached the margin outside the interval and would go further. The approach
    /// then belongs to another interval.
    pub(super) fn is_gone(&self, t: f64, direction: f64) -> bool {
        direction != 0.0 && self.held(t + CLOSE * direction.signum()) == t && self.own(t).is_none()
    }

    /// `t`, clamped to the interval. Beyond an end that is no cut end of the yarn, `t` may go on by
    /// [`MARGIN`].
    pub(super) fn held(&self, t: f64) -> f64 {
        let [low, high] =
            [if self.cut[0] { 0.0 } else { -MARGIN }, if self.cut[1] { 1.0 } else { 1.0 + MARGIN }];
        t.clamp(low, high)
    }
}

/// An approach of two round yarns: the place where they come nearest to one another, and their
/// distance there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Approach {
    /// The distance over the sum of the radii. If the place belongs to other intervals, the nearest
    /// place within both intervals counts.
    pub(super) ratio: f64,
    /// Parameters of the place, or none if the place belongs to other intervals.
    pub(super) own: Option<DVec2>,
    /// Whether the place lies in a valley, along which the distance hardly rises and may fall
    /// further on.
    pub(super) valley: bool,
}

/// The nearest approach of two round yarns close to parameters `start`.
pub(super) fn refine(one: Side<'_>, other: Side<'_>, start: DVec2) -> Approach {
    let (place, ratio, curved) = nearest(one, other, start);
    let own = own(one, other, place, ratio).zip(own(other, one, place.yx(), ratio)).map(DVec2::from);
    let ratio = if own.is_some() {
        ratio
    } else {
        let place = place.clamp(DVec2::ZERO, DVec2::ONE);
        ratio_of(&one.cubic.at(place.x), &other.cubic.at(place.y))
    };
    Approach { ratio, own, valley: curved < VALLEY }
}

/// The distance of two places over the sum of their radii.
fn ratio_of(a: &At, b: &At) -> f64 {
    (a.position - b.position).length() / (a.radius()[0] + b.radius()[0])
}

/// The parameter of an approach on the interval `side`, if the approach belongs to this interval.
///
/// At a knot within a yarn the earlier interval owns the approach if the distance clearly rises at
/// the knot, because the minimum then lies before the knot. Both intervals find the same slope
/// there, so exactly one of them owns the approach. An interval that
/// [`Passing::leaves_to_neighbours`](super::passing::Passing::leaves_to_neighbours) leaves out
/// never owns it.
fn own(side: Side<'_>, other: Side<'_>, place: DVec2, ratio: f64) -> Option<f64> {
    let knot = place.x.round();
    if (place.x - knot).abs() >= AT_KNOT || side.cut[usize::from(knot > 0.0)] {
        return side.own(place.x);
    }
    let (at, beside) = (side.cubic.at(knot), other.cubic.at(place.y));
    let (apart, radii) = (at.position - beside.position, at.radius()[0] + beside.radius()[0]);
    let slope = apart.dot(at.velocity) - ratio * ratio * radii * at.radius()[1];
    let rises = slope > 1.5 * LEVEL * radii * at.velocity.length();
    (rises == (knot > 0.0)).then_some(knot)
}

/// First and second derivatives of (|Δ|² - λ² (r₁ + r₂)²) / 2 at a place of two yarns.
///
/// Δ is the vector between both places, and r₁ and r₂ are the radii there. λ is the ratio at that
/// place, so the function itself is 0 there.
struct Slopes {
    gradient: DVec2,
    /// The mixed second derivative.
    across: f64,
    /// The second derivatives by each parameter, plus the addition that makes the function convex.
    bent: DVec2,
    /// The squared speeds of both curves.
    flat: [f64; 2],
    /// The least curvature. For two straight lines it is 1 minus the cosine of the angle between
    /// them.
    curved: f64,
    /// Whether the function is convex without an addition.
    convex: bool,
}

impl Slopes {
    fn new(a: &At, b: &At, lambda: f64) -> Self {
        let (apart, radii) = (a.position - b.position, a.radius()[0] + b.radius()[0]);
        let held = lambda * lambda;
        let gradient = DVec2::new(
            apart.dot(a.velocity) - held * radii * a.radius()[1],
            -apart.dot(b.velocity) - held * radii * b.radius()[1],
        );
        let across = -a.velocity.dot(b.velocity) - held * a.radius()[1] * b.radius()[1];
        let own = |at: &At, towards: f64| {
            let flat = at.velocity.length_squared();
            let bent = flat + towards * apart.dot(at.acceleration)
                - held * (at.radius()[1] * at.radius()[1] + radii * at.radius()[2]);
            (flat, bent)
        };
        let ((flat_a, bent_a), (flat_b, bent_b)) = (own(a, 1.0), own(b, -1.0));
        // If the function is not convex, its second derivatives by each parameter are enlarged
        // until it is, in proportion to the squared speeds. A little more keeps places on parallel
        // lines from moving.
        let scale = DVec2::new(flat_a, flat_b) + f64::MIN_POSITIVE;
        let (own, along) = (DVec2::new(bent_a, bent_b) / scale, across / (scale.x * scale.y).sqrt());
        let curved = (own.x + own.y - (own.x - own.y).hypot(2.0 * along)) / 2.0;
        let short = (-2.0 * curved).max(0.0);
        let added = scale * (short + 1e-9);
        Self {
            gradient,
            across,
            bent: DVec2::new(bent_a + added.x, bent_b + added.y),
            flat: [flat_a, flat_b],
            curved,
            convex: short == 0.0,
        }
    }

    /// Newton's step downhill, [`STRIDE`] at most. `held` says which parameters can't go on in a
    /// direction.
    fn step(&self, held: impl Fn(DVec2) -> [bool; 2]) -> DVec2 {
        let Self { gradient, across, bent, .. } = *self;
        // A parameter that is held stays, and only the other one steps.
        let alone = |fixed: [bool; 2]| {
            let step = DVec2::new(-gradient.x / bent.x, -gradient.y / bent.y);
            DVec2::select(fixed.into(), DVec2::ZERO, step)
        };
        let step = match held(-gradient) {
            [false, false] => {
                let hessian = DMat2::from_cols(DVec2::new(bent.x, across), DVec2::new(across, bent.y));
                let step = -(hessian.inverse() * gradient);
                match held(step) {
                    [false, false] => step,
                    fixed => alone(fixed),
                }
            }
            fixed => alone(fixed),
        };
        // If a yarn's velocity is 0, its parameter can't step, and only the other one does.
        let step =
            if step.is_finite() { step } else { alone(self.flat.map(|flat| flat < f64::MIN_POSITIVE)) };
        let step = if step.is_finite() { step } else { DVec2::ZERO };
        step * (STRIDE / step.abs().max_element()).min(1.0)
    }
}

/// Newton's method on (distance / sum of radii)². Returns the parameters, the ratio, and the least
/// curvature before the last step.
///
/// The method minimises |Δ|² - λ² (r₁ + r₂)² (see [`Slopes`]), whose least value is 0 if λ is the
/// least ratio (Dinkelbach, "On nonlinear fractional programming", Management Science 13, 1967).
fn nearest(one: Side<'_>, other: Side<'_>, start: DVec2) -> (DVec2, f64, f64) {
    let held_at = |place: DVec2| DVec2::new(one.held(place.x), other.held(place.y));
    let at = |place: DVec2| (one.cubic.at(place.x), other.cubic.at(place.y));
    let stays = |side: &Side<'_>, t: f64, towards: f64| {
        towards != 0.0 && side.held(t + CLOSE * towards.signum()) == t
    };
    let mut place = held_at(start);
    let (mut a, mut b) = at(place);
    let mut lambda = ratio_of(&a, &b);
    let mut curved = f64::INFINITY;
    for _ in 0..STEPS {
        let slopes = Slopes::new(&a, &b, lambda);
        curved = slopes.curved;
        if one.is_gone(place.x, -slopes.gradient.x) || other.is_gone(place.y, -slopes.gradient.y) {
            break;
        }
        let mut step =
            slopes.step(|towards| [stays(&one, place.x, towards.x), stays(&other, place.y, towards.y)]);
        // The step leads downhill, but perhaps too far: round a sharp bend it would go back and
        // forth without end. It is halved until the ratio falls.
        let moved = loop {
            let next = held_at(place + step);
            let moved = (next - place).abs().max_element();
            let (next_a, next_b) = at(next);
            let next_lambda = ratio_of(&next_a, &next_b);
            if next_lambda <= lambda || moved < CLOSE {
                (place, a, b, lambda) = (next, next_a, next_b, next_lambda);
                break moved;
            }
            step /= 2.0;
        };
        // If the function is convex by itself, the error after a step is about the step squared.
        if moved < if slopes.convex { SHORT } else { CLOSE } {
            break;
        }
    }
    (place, lambda, curved)
}
