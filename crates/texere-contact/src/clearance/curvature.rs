//! The tightest bend of an interval, by branch and bound.
//!
//! The coefficients of a part give a lower bound of its radius of curvature. A part whose bound is
//! not below the least radius so far is left out. Any other part is halved.

use glam::{DVec2, DVec3};

use super::interval::Cubic;
use super::support::Support;

/// The share by which the true tightest bend may be tighter than the one found. With half the
/// value, and with twice, no test is red.
const ACCURACY: f64 = 1e-3;

/// The most times that an interval is halved. If the velocity reverses within so short a part, the
/// yarn counts as turning straight back there. With half the value, and with twice, no test is red.
const HALVINGS: u32 = 20;

/// The number of halvings after which a section that is not a circle counts as reaching equally far
/// everywhere in a part. With half the value, and with twice, no test is red.
const HALVINGS_FLAT: u32 = 3;

/// A part of an interval as Bernstein coefficients. Each halving brings the coefficients four times
/// as close to the curve that they bound.
#[derive(Debug, Clone, Copy)]
struct Part {
    from: f64,
    length: f64,
    halvings: u32,
    velocity: [DVec3; 3],
    /// Half width and half height.
    halves: [[f64; 4]; 2],
}

impl Part {
    fn whole(cubic: &Cubic) -> Self {
        let (velocity, halves) = (cubic.velocities(), cubic.half_bounds());
        Self { from: 0.0, length: 1.0, halvings: 0, velocity, halves }
    }

    /// Both halves of the part, by de Casteljau's algorithm.
    fn halves(&self) -> [Self; 2] {
        let [u, v, w] = self.velocity;
        let (uv, vw) = ((u + v) / 2.0, (v + w) / 2.0);
        let middle = (uv + vw) / 2.0;
        let split = self.halves.map(|[a, b, c, d]| {
            let [ab, bc, cd] = [(a + b) / 2.0, (b + c) / 2.0, (c + d) / 2.0];
            let [abc, bcd] = [(ab + bc) / 2.0, (bc + cd) / 2.0];
            let middle = (abc + bcd) / 2.0;
            [[a, ab, abc, middle], [middle, bcd, cd, d]]
        });
        let (length, halvings) = (self.length / 2.0, self.halvings + 1);
        [
            Self {
                velocity: [u, uv, middle],
                halves: split.map(|[half, _]| half),
                length,
                halvings,
                ..*self
            },
            Self {
                from: self.from + length,
                length,
                halvings,
                velocity: [middle, vw, w],
                halves: split.map(|[_, half]| half),
            },
        ]
    }

    /// The squared speed, of degree four.
    fn speed_squared(&self) -> [f64; 5] {
        let [u, v, w] = self.velocity;
        let middle = (u.dot(w) + 2.0 * v.length_squared()) / 3.0;
        [u.length_squared(), u.dot(v), middle, v.dot(w), w.length_squared()]
    }

    /// The cross product of velocity and acceleration, of degree two. The lengths of the product's
    /// coefficients are the coefficients of an upper bound of the product's length.
    fn turn(&self) -> [DVec3; 3] {
        let [u, v, w] = self.velocity;
        [2.0 * u.cross(v), u.cross(w), 2.0 * v.cross(w)].map(|turn| turn / self.length)
    }

    /// Whether the radius of curvature is at least `least` all along the part: whether |v|³ ≥ least
    /// |v × a|.
    ///
    /// Two sufficient conditions are tried. First, the slowest place is fast enough for the
    /// sharpest turn. Second, |v|³ is a convex function of |v|² and lies above its tangent at the
    /// middle's `speed_squared`. It then suffices that a polynomial of degree four is not negative,
    /// which holds if none of its coefficients is. The second condition holds more often than the
    /// first.
    fn bends_less(&self, least: f64, speed_squared: f64) -> bool {
        let (squares, turn) = (self.speed_squared(), self.turn());
        let slowest = squares.into_iter().fold(f64::INFINITY, f64::min);
        let sharpest = turn.iter().map(|turn| turn.length_squared()).fold(0.0, f64::max);
        if slowest > 0.0 && slowest.powi(3) >= least * least * sharpest {
            return true;
        }
        let speed = speed_squared.sqrt();
        let [a, b, c] = turn.map(DVec3::length);
        let turn = [a, (a + b) / 2.0, (a + 4.0 * b + c) / 6.0, (b + c) / 2.0, c];
        let tangent = |square: f64| speed * (1.5 * square - 0.5 * speed_squared);
        speed > 0.0 && squares.iter().zip(turn).all(|(square, turn)| tangent(*square) >= least * turn)
    }

    /// Upper bound of |velocity| |acceleration| in the part.
    fn size(&self) -> f64 {
        let [u, v, w] = self.velocity;
        let fastest = self.velocity.iter().map(|velocity| velocity.length_squared()).fold(0.0, f64::max);
        let hardest = (v - u).length_squared().max((w - v).length_squared());
        2.0 * (fastest * hardest).sqrt() / self.length
    }

    /// The places at the beginning, in the middle and at the end of the part.
    fn places(&self) -> [Place; 3] {
        let [u, v, w] = self.velocity;
        let place = |share: f64, velocity, change: DVec3, half: fn([f64; 4]) -> f64| Place {
            t: self.from + share * self.length,
            velocity,
            acceleration: change / self.length,
            sizes: DVec2::from_array(self.halves.map(half)),
        };
        [
            place(0.0, u, 2.0 * (v - u), |[a, ..]| a),
            place(0.5, (u + 2.0 * v + w) / 4.0, w - u, |[a, b, c, d]| (a + 3.0 * (b + c) + d) / 8.0),
            place(1.0, w, 2.0 * (w - v), |[.., d]| d),
        ]
    }
}

/// One place of an interval.
struct Place {
    t: f64,
    velocity: DVec3,
    acceleration: DVec3,
    /// Half width and half height, before they are held at their floors.
    sizes: DVec2,
}

/// The search for an interval's tightest bend.
struct Search<'a> {
    cubic: &'a Cubic,
    support: &'a Support,
    turning: bool,
    floors: DVec2,
    /// Whether the interval runs along one line.
    straight: bool,
    /// The least ratio so far, and its parameter.
    best: (f64, Option<f64>),
}

impl Search<'_> {
    fn visit(&mut self, part: &Part) {
        let [start, middle, end] = part.places();
        let reach = self.reach(&middle);
        if self.straight {
            // The interval may still turn straight back.
            if part.speed_squared().iter().all(|square| *square > 0.0) {
                return;
            }
        } else {
            if part.halvings >= HALVINGS_FLAT && reach <= 0.0 {
                return;
            }
            let sizes = middle.sizes.max(self.floors);
            let furthest = if part.halvings < HALVINGS_FLAT {
                self.support.extent()
            } else {
                reach / sizes.max_element()
            };
            let bounds = part.halves.into_iter().flatten();
            let thickest = bounds.fold(self.floors.max_element(), f64::max) * furthest;
            let least = (1.0 - ACCURACY) * self.best.0 * thickest;
            if part.bends_less(least, middle.velocity.length_squared()) {
                return;
            }
            self.compare(&middle);
            if part.halvings == 0 {
                self.compare(&start);
                self.compare(&end);
            }
        }
        if part.halvings < HALVINGS {
            part.halves().iter().for_each(|half| self.visit(half));
        } else if start.velocity.dot(end.velocity) < 0.0 {
            self.best = (0.0, Some(middle.t));
        }
    }

    fn compare(&mut self, place: &Place) {
        let reach = self.reach(place);
        if reach <= 0.0 {
            return;
        }
        let turn = place.velocity.cross(place.acceleration).length();
        let ratio = place.velocity.length().powi(3) / (turn * reach);
        if ratio < self.best.0 {
            self.best = (ratio, Some(place.t));
        }
    }

    /// How far the section reaches into the bend, mm. It is 0 or less if the section is a polygon
    /// beside its axis, wholly on the outer side of the bend. The bend then can't fold the section.
    fn reach(&self, place: &Place) -> f64 {
        let sizes = place.sizes.max(self.floors);
        if self.support.is_circle() && sizes.x == sizes.y {
            return sizes.x;
        }
        let velocity = place.velocity;
        let inwards = velocity.cross(place.acceleration).cross(velocity).normalize_or_zero();
        let [side, up] = self.cubic.frame(place.t, velocity.normalize_or_zero());
        if self.turning {
            // The section turns within the circle round it, and is flattened afterwards.
            let across = DVec2::new(inwards.dot(side), inwards.dot(up)) * sizes;
            return across.length() * self.support.extent();
        }
        self.support.furthest([side, up], sizes, inwards).dot(inwards)
    }
}

/// The ratio and the parameter of the tightest bend of an interval. The ratio is the radius of
/// curvature divided by the section's reach into the bend. None unless the ratio is clearly less
/// than `within`. The ratio is exact to [`ACCURACY`], and 0 if the yarn turns straight back.
///
/// Sections stand upright, or by the yarn's up directions. With `turning` each section counts with
/// its furthest reach at any roll.
pub(super) fn tightest(cubic: &Cubic, support: &Support, turning: bool, within: f64) -> Option<(f64, f64)> {
    let whole = Part::whole(cubic);
    let [u, v, w] = whole.velocity;
    let least = (1.0 - ACCURACY) * within * cubic.half_bound() * support.extent();
    // Most intervals bend so little that the search ends here.
    if whole.bends_less(least, (u + 2.0 * v + w).length_squared() / 16.0)
        || whole.velocity == [DVec3::ZERO; 3]
    {
        return None;
    }
    // Rounding of a straight line's derivatives is no bend.
    let straight = whole.turn().iter().all(|turn| turn.length() <= 1e-9 * whole.size());
    let floors = DVec2::from_array(cubic.floors());
    let mut search = Search { cubic, support, turning, floors, straight, best: (within, None) };
    search.visit(&whole);
    search.best.1.map(|t| (search.best.0, t))
}
