//! The cardinal spline in f64: the paper's equations 1 to 4, as printed.

use glam::DVec3;
use texere_core::ControlPoint;

/// A yarn's centreline.
pub(super) struct Curve<'a> {
    points: &'a [ControlPoint],
    closed: bool,
    /// Number of rings per control interval: K + 1.
    per_interval: u64,
    s: f64,
}

/// The centreline at one ring.
pub(super) struct Place {
    /// Centre, mm.
    pub(super) centre: DVec3,
    /// Half width and half height, mm.
    pub(super) halves: [f64; 2],
    /// Unit tangent.
    pub(super) tangent: DVec3,
    /// Growth of the half width and of the half height along the yarn.
    pub(super) growths: [f64; 2],
    /// Largest coordinate of the four control points, mm.
    pub(super) extent: f64,
}

/// Four control points, to which each order of derivative gives weights.
struct Interval {
    /// Positions relative to the interval's first point, so that coinciding points coincide
    /// exactly.
    positions: [DVec3; 4],
    /// The half widths of the four points, then their half heights.
    halves: [[f64; 4]; 2],
    start: DVec3,
}

/// The weights of the four points at t (equation 1), and their first three derivatives.
fn weights(s: f64, t: f64) -> [[f64; 4]; 4] {
    let (t2, t3) = (t * t, t * t * t);
    [
        [
            -s * t + 2.0 * s * t2 - s * t3,
            1.0 + (s - 3.0) * t2 + (2.0 - s) * t3,
            s * t + (3.0 - 2.0 * s) * t2 + (s - 2.0) * t3,
            -s * t2 + s * t3,
        ],
        [
            -s + 4.0 * s * t - 3.0 * s * t2,
            2.0 * (s - 3.0) * t + 3.0 * (2.0 - s) * t2,
            s + 2.0 * (3.0 - 2.0 * s) * t + 3.0 * (s - 2.0) * t2,
            -2.0 * s * t + 3.0 * s * t2,
        ],
        [
            4.0 * s - 6.0 * s * t,
            2.0 * (s - 3.0) + 6.0 * (2.0 - s) * t,
            2.0 * (3.0 - 2.0 * s) + 6.0 * (s - 2.0) * t,
            -2.0 * s + 6.0 * s * t,
        ],
        [-6.0 * s, 6.0 * (2.0 - s), 6.0 * (s - 2.0), 6.0 * s],
    ]
}

impl Interval {
    fn position(&self, weights: [f64; 4]) -> DVec3 {
        self.positions.iter().zip(weights).map(|(point, weight)| *point * weight).sum()
    }

    fn half(&self, which: usize, weights: [f64; 4]) -> f64 {
        self.halves[which].iter().zip(weights).map(|(half, weight)| half * weight).sum()
    }

    /// A half width or half height, and its growth along the yarn. The size is at least half of the
    /// smaller value at the two points that the interval joins. The growth is 0 where the size is
    /// raised to this least value, and where the yarn stands still.
    fn size(&self, which: usize, orders: [[f64; 4]; 4]) -> (f64, f64) {
        let (half, velocity) = (self.half(which, orders[0]), self.position(orders[1]));
        let least = 0.5 * self.halves[which][1].min(self.halves[which][2]);
        if half < least {
            (least, 0.0)
        } else if velocity.length_squared() > self.at_rest() {
            (half, (self.half(which, orders[1]) / velocity.length()).clamp(-1e4, 1e4))
        } else {
            (half, 0.0)
        }
    }

    /// The square up to which a derivative counts as zero, mm²: that of a millionth of the
    /// interval's size, but at least 1e-30, because f32 loses the squares of much shorter lengths.
    fn at_rest(&self) -> f64 {
        let size: f64 = self.positions.iter().map(|point| point.length_squared()).sum();
        (1e-12 * size).max(1e-30)
    }

    fn extent(&self) -> f64 {
        let furthest = |point: &DVec3| (self.start + *point).abs().max_element();
        self.positions.iter().map(furthest).fold(0.0, f64::max)
    }

    /// The tangent at t: the direction of the lowest derivative that is not zero, or +x if all
    /// three are zero. It is the limit from the right. At t = 1, where a yarn ends, it is the limit
    /// from the left: the second derivative changes its sign, and the others keep theirs.
    fn tangent(&self, orders: [[f64; 4]; 4], t: f64) -> DVec3 {
        let before = if t < 1.0 { 1.0 } else { -1.0 };
        for (order, sign) in [(1, 1.0), (2, before), (3, 1.0)] {
            let derivative = self.position(orders[order]);
            if derivative.length_squared() > self.at_rest() {
                return derivative.normalize() * sign;
            }
        }
        DVec3::X
    }
}

impl<'a> Curve<'a> {
    pub(super) fn new(points: &'a [ControlPoint], closed: bool, tension: f32, subdivisions: u32) -> Self {
        let s = (1.0 - f64::from(tension)) / 2.0;
        Self { points, closed, per_interval: u64::from(subdivisions) + 1, s }
    }

    /// Number of rings: one for the start of each control interval, one for each inserted point,
    /// and one for the end of the yarn.
    pub(super) fn ring_count(&self) -> u64 {
        let intervals = self.points.len() as u64 - u64::from(!self.closed);
        intervals * self.per_interval + 1
    }

    /// Position, half width and half height of control point `index`. It may be the virtual point
    /// before the first or after the last, whose sizes are half floats, too.
    fn point(&self, index: i64) -> (DVec3, [f64; 2]) {
        let count = self.points.len() as i64;
        let exact = |at: i64| {
            let point = &self.points[at as usize];
            let halves = [point.half_width(), point.half_height()].map(f64::from);
            (DVec3::new(point.x.into(), point.y.into(), point.z.into()), halves)
        };
        let reflect = |end: i64, inner: i64| {
            let ((end, end_halves), (inner, inner_halves)) = (exact(end), exact(inner));
            let far = |which: usize| 2.0 * end_halves[which] - inner_halves[which];
            (end * 2.0 - inner, [far(0), far(1)].map(|half| half::f16::from_f64(half).to_f64()))
        };
        match index {
            _ if self.closed => exact(index.rem_euclid(count)),
            -1 => reflect(0, 1),
            _ if index == count => reflect(count - 1, count - 2),
            _ => exact(index),
        }
    }

    fn interval(&self, number: u64) -> Interval {
        let points = [-1, 0, 1, 2].map(|step| self.point(number as i64 + step));
        let start = points[1].0;
        let halves = [0, 1].map(|which| points.map(|point| point.1[which]));
        Interval { positions: points.map(|point| point.0 - start), halves, start }
    }

    /// The interval in which a ring is evaluated, and t. An open yarn ends at t = 1 of its last
    /// interval.
    fn locate(&self, ring: u64) -> (u64, f64) {
        let (interval, step) = (ring / self.per_interval, ring % self.per_interval);
        if !self.closed && ring + 1 == self.ring_count() {
            (interval - 1, 1.0)
        } else {
            (interval, step as f64 / self.per_interval as f64)
        }
    }

    pub(super) fn at(&self, ring: u64) -> Place {
        let (number, t) = self.locate(ring);
        let (interval, orders) = (self.interval(number), weights(self.s, t));
        let [(half_width, width_growth), (half_height, height_growth)] =
            [0, 1].map(|which| interval.size(which, orders));
        Place {
            centre: interval.start + interval.position(orders[0]),
            halves: [half_width, half_height],
            tangent: interval.tangent(orders, t),
            growths: [width_growth, height_growth],
            extent: interval.extent(),
        }
    }

    /// The two control points between which a ring lies, by number and tangent, and its place
    /// between them from 0 to 1.
    pub(super) fn ends(&self, ring: u64) -> ([(usize, DVec3); 2], f64) {
        let (number, t) = self.locate(ring);
        let interval = self.interval(number);
        let end = |step: u8| {
            let t = f64::from(step);
            let point = (number as usize + usize::from(step)) % self.points.len();
            (point, interval.tangent(weights(self.s, t), t))
        };
        ([end(0), end(1)], t)
    }

    /// Vector from the centre of a ring to that of the next one.
    pub(super) fn chord(&self, ring: u64) -> DVec3 {
        let (number, step) = (ring / self.per_interval, ring % self.per_interval);
        let interval = self.interval(number);
        let at = |step: u64| interval.position(weights(self.s, step as f64 / self.per_interval as f64)[0]);
        at(step + 1) - at(step)
    }
}
