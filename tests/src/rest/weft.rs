//! Starts of weft knits: the stitches of a chart as paths of yarn.
//!
//! A plain loop has twelve points: round arcs, and legs that make a V. The points are given for
//! loops that are drawn to the face. For loops that are drawn to the back, z changes its sign.
//!
//! - A loop comes through the loops that hang on its needle. Its feet pass behind the upper legs of
//!   those loops, and its legs pass in front of their heads. The lower half of a loop therefore
//!   lies on the side to which the loop itself is drawn, and the upper half on the side to which
//!   the next loop is drawn.
//! - A needle that does not knit keeps its loop, whose upper half lies higher by the courses that
//!   the needle leaves out. The yarn of a missed course floats past behind that loop.
//! - A tuck is an arch that hangs on the needle behind the held loop. The next loop is drawn
//!   through both, and its feet pass behind the tuck. The legs of the tuck lie behind those of the
//!   held loop.
//! - A loop that is moved to the next needle lies behind the loop that hangs there, because the
//!   machine puts it nearer to the tip of the hook. The empty needle makes an arch that goes
//!   through nothing: the eyelet.

use glam::DVec3;

use super::chart::{Chart, Stitch};
use super::{Ends, Length, Start, StartYarn};

/// Wale spacing in diameters, and the depth at which loops of round yarn have a clearance of 1.
const DEPTHS: [(f64, f64); 6] =
    [(4.2, 0.70), (4.5, 0.68), (5.0, 0.67), (6.0, 0.65), (8.0, 0.64), (10.0, 0.64)];

/// The distances between stitches, and the depth of loops.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gauge {
    /// Distance of neighbouring wales, mm.
    pub wale: f64,
    /// Distance of neighbouring courses, mm.
    pub course: f64,
    /// Diameter of the yarn, mm.
    pub diameter: f64,
    /// Depth of loops, in diameters. Their centreline reaches from -0.84 to 0.98 times the depth
    /// out of the plane of the cloth.
    pub depth: f64,
}

impl Gauge {
    /// Wales `wale` diameters apart, of a yarn with a diameter of 1 mm. Courses are three quarters
    /// of the wales' distance apart.
    #[must_use]
    pub fn new(wale: f64) -> Self {
        let depth = DEPTHS.windows(2).find(|pair| wale <= pair[1].0).map_or(0.64, |pair| {
            let [(low, deep), (high, shallow)] = [pair[0], pair[1]];
            deep + (shallow - deep) * (wale - low).max(0.0) / (high - low)
        });
        Self { wale, course: 0.75 * wale, diameter: 1.0, depth }
    }

    /// Height of a loop from foot to head.
    fn height(&self) -> f64 {
        1.76 * self.course
    }

    /// Half the width of a loop where it is narrowest, above its feet; and half the space between
    /// two heads.
    fn narrow(&self) -> f64 {
        (0.53 * self.diameter).max(0.09 * self.wale)
    }
}

/// A repeat of `chart`.
#[must_use]
pub fn weft_knit(name: &str, chart: &Chart, gauge: Gauge, length: Length) -> Start {
    let yarn = |course| StartYarn {
        points: course_points(chart, gauge, course),
        radius: gauge.diameter / 2.0,
        ends: Ends::Repeats([1, 0]),
    };
    Start {
        name: name.to_owned(),
        yarns: (0..chart.courses() as i64).map(yarn).collect(),
        repeat: [chart.wales() as f64 * gauge.wale, chart.courses() as f64 * gauge.course],
        pinned: Vec::new(),
        length,
    }
}

/// A piece of `chart`. Each course begins and ends level, half a wale beyond its outer loops.
///
/// Points that no other yarn holds are pinned: both ends of each course, the arcs of the first
/// course and the heads of the last one.
#[must_use]
pub fn weft_knit_piece(name: &str, chart: &Chart, gauge: Gauge, length: Length) -> Start {
    let mut start = weft_knit(name, chart, gauge, length);
    let last_course = start.yarns.len() - 1;
    let head = start.yarns[last_course].points.iter().map(|point| point.y).fold(0.0, f64::max);
    for (number, yarn) in start.yarns.iter_mut().enumerate() {
        let (from, width) = (yarn.points[0], DVec3::X * start.repeat[0]);
        let out = DVec3::X * gauge.wale / 2.0;
        yarn.points.insert(0, from - out);
        yarn.points.extend([from + width, from + width + out]);
        yarn.ends = Ends::Open;
        let last = yarn.points.len() - 1;
        let pinned = yarn.points.iter().enumerate().filter(|(index, point)| {
            [0, 1, last - 1, last].contains(index)
                || number == 0 && point.y == 0.0
                || number == last_course && point.y == head
        });
        start.pinned.extend(pinned.map(|(index, _)| (number, index)));
    }
    start.repeat = [0.0; 2];
    start
}

/// One course from left to right. Each wale begins in the middle of the arc to its left.
fn course_points(chart: &Chart, gauge: Gauge, course: i64) -> Vec<DVec3> {
    let mut points = Vec::new();
    for wale in 0..chart.wales() as i64 {
        let cell = Cell { chart, gauge, course, wale };
        let left = Cell { wale: wale - 1, ..cell };
        points.push(cell.place(-0.5 * gauge.wale, 0.0, between(left.foot(), cell.foot())));
        match chart.stitch(course, wale) {
            Stitch::Miss => {
                points.extend([-1.0, 1.0].map(|side| cell.place(side * gauge.wale / 6.0, 0.0, cell.foot())));
            }
            Stitch::Face | Stitch::Back | Stitch::Tuck => {
                points.extend(cell.half(-1.0));
                points.push(cell.head());
                points.extend(cell.half(1.0).into_iter().rev());
            }
        }
    }
    points
}

/// z of the arc between two feet: z of the foot that lies further back, or half way between feet on
/// opposite sides.
fn between(left: f64, right: f64) -> f64 {
    if left * right < 0.0 {
        (left + right) / 2.0
    } else if left.abs() > right.abs() {
        left
    } else {
        right
    }
}

/// One stitch.
#[derive(Clone, Copy)]
struct Cell<'a> {
    chart: &'a Chart,
    gauge: Gauge,
    course: i64,
    wale: i64,
}

impl Cell<'_> {
    /// A point at `x` from the middle of the wale and `y` from the course.
    fn place(&self, x: f64, y: f64, z: f64) -> DVec3 {
        let Gauge { wale, course, .. } = self.gauge;
        DVec3::new((self.wale as f64 + 0.5) * wale + x, self.course as f64 * course + y, z)
    }

    /// The side to which the loop itself is drawn: 1 for the face, -1 for the back. For a tuck or a
    /// miss it is the side of the next loop.
    fn side(&self) -> f64 {
        match self.chart.stitch(self.course, self.wale) {
            Stitch::Face => 1.0,
            Stitch::Back => -1.0,
            Stitch::Tuck | Stitch::Miss => self.chart.next_side(self.course, self.wale),
        }
    }

    /// Whether a loop is drawn through nothing.
    fn is_arch(&self) -> bool {
        self.chart.stitch(self.course, self.wale) == Stitch::Tuck
            || self.chart.hanging(self.course, self.wale) == 0
    }

    /// Distance by which the feet lie further back than they would behind one loop, because they
    /// lie behind several loops.
    fn behind(&self) -> f64 {
        let loops = match self.chart.stitch(self.course, self.wale) {
            Stitch::Face | Stitch::Back => self.chart.hanging(self.course, self.wale),
            Stitch::Tuck => self.chart.fate(self.course, self.wale).layer,
            Stitch::Miss => 0,
        };
        loops.saturating_sub(1) as f64 * self.gauge.diameter
    }

    /// z of the loop's feet.
    fn foot(&self) -> f64 {
        -self.side() * (0.84 * self.gauge.depth * self.gauge.diameter + self.behind())
    }

    /// The middle of the loop's head.
    fn head(&self) -> DVec3 {
        let fate = self.chart.fate(self.course, self.wale);
        let Gauge { wale, course, diameter, depth } = self.gauge;
        let y = self.gauge.height() + fate.held as f64 * course;
        self.place(fate.moved as f64 * wale, y, fate.side * (-0.84 * depth - fate.layer as f64) * diameter)
    }

    /// One half of the stitch from foot to head: the left half if `hand` is -1, the right half if
    /// it is 1.
    fn half(&self, hand: f64) -> Vec<DVec3> {
        let Gauge { wale, course, diameter, depth } = self.gauge;
        let (height, narrow) = (self.gauge.height(), self.gauge.narrow());
        let fate = self.chart.fate(self.course, self.wale);
        let (own, next) = (self.side(), fate.side);
        let own_z = |z: f64| own * z * depth * diameter;
        let next_z = |z: f64| next * (z * depth - fate.layer as f64) * diameter;
        // `way` is the share of the distance from the loop's own needle to the needle that it is
        // moved to.
        let at = |across: f64, way: f64, y: f64, z: f64| {
            self.place(hand * across + way * fate.moved as f64 * wale, y * height, z)
        };
        let mut points = if self.is_arch() {
            let foot = self.place(hand * 0.31 * wale, 0.083 * height, self.foot());
            vec![foot, at(0.25 * wale, 0.0, 0.4, next_z(0.98))]
        } else {
            let foot = at(0.19 * wale, 0.0, 0.083, own_z(-0.48) - own * self.behind());
            let lower = at(narrow, 0.1, 0.285, own_z(0.41));
            if own == next {
                // If the loop is moved, one of its legs is further from the new needle. Nothing
                // lies in front of that leg, so it is not laid further back.
                let leaves = hand * (fate.moved as f64) < 0.0;
                vec![foot, lower, at(0.25 * wale, 0.5, 0.5, if leaves { own_z(0.98) } else { next_z(0.98) })]
            } else {
                // The leg crosses the plane of the cloth between the loop below and the loop above.
                vec![
                    foot,
                    lower,
                    at(0.2 * wale, 0.5, 0.42, own_z(0.6)),
                    at(0.3 * wale, 0.5, 0.58, next_z(0.6)),
                ]
            }
        };
        if let (Some(&leg), true) = (points.last(), fate.held > 0) {
            points.extend((1..=fate.held).map(|up| leg + DVec3::Y * (up as f64 * course)));
        }
        let up = fate.held as f64 * course / height;
        points.extend([
            at(0.5 * wale - narrow, 1.0, 0.715 + up, next_z(0.41)),
            at(0.31 * wale, 1.0, 0.917 + up, next_z(-0.48)),
        ]);
        points
    }
}
