//! The form of one loop among its neighbours: on which side of them each of its parts lies.
//!
//! [`Form::points`] lays a loop from foot to foot. It takes the plain loop of `shape.rs`, and puts
//! each part on the side, face or back, on which the part has to pass other loops.
//!
//! ```text
//! half a loop, from foot to shoulder (Form::half), and the head between both halves:
//!     foot       behind the upper legs of all loops that this one is drawn through
//!     lower leg  on the side to which this loop is drawn, which its bed says
//!     leg        one node; two where the lower and the upper leg lie on different sides
//!     held leg   one node for each course in which the needle does not knit
//!     upper leg  on the side to which the next loop is drawn
//!     shoulder   on that side, too
//! head           behind the legs of the next loop
//! ```
//!
//! Across, nodes are at the needle plus or minus the widths of `shape.rs`. The two nodes of a leg
//! that changes sides have widths of their own. The nodes of a loop that is transferred move
//! towards its new needle: the foot not at all, the leg half way, the head all the way.
//!
//! A tuck, and a loop on an empty needle, are drawn through nothing. They are arches, and have no
//! lower leg. A dropped loop has no upper leg. Its head lies just above the middle of its legs.
//!
//! At first loops need not be clear of one another, but they have to be linked as in the cloth
//! (`loops_are_drawn_through_what_the_chart_says`). Settling makes them clear
//! (`knits_come_to_rest`).

use glam::DVec3;

use super::layers::{Layers, held_until};
use super::shape::{
    ARC, FOOT, FOOT_WIDE, HEAD, LEG, LEG_WIDE, LOWER, Node, SHOULDER, SHOULDER_WIDE, Shape, UPPER,
};
use super::{Bed, Fate, LoopKind, Stitches};

/// Height to which the uppermost of several crossing legs is lifted, in diameters. Each leg below
/// it lies one diameter lower. By eye. With half the value, and with twice, no test is red.
const CROSSING: f64 = 0.7;

/// Lean of the lower legs of a transferred loop, as a share of the distance to its new needle. The
/// lower legs come out of the loop below, and have no room to lean further. By eye. With half the
/// value, and with twice, no test is red.
const LEANS: f64 = 0.1;

/// The leg of an arch. By eye.
const ARCH_LEG: Node = Node { up: 0.4, ..LEG };

/// The share of the lift over crossing legs that the lower and the upper end of a leg have. By eye.
/// With half the value, and with twice, no test is red.
const LIFTED_ENDS: f64 = 0.6;

/// The lower and the upper node of a leg that changes sides: their distance from the needle, in
/// wales, and their height and depth. By eye.
const CHANGES_SIDES: [(f64, Node); 2] = [(0.2, Node { up: 0.42, z: 0.6 }), (0.3, Node { up: 0.58, z: 0.6 })];

/// Nodes of a dropped loop. The loop falls in front of the loop that it is drawn through, below the
/// feet of the next course. A dropped arch has none of these nodes, and lies as a float does. By
/// eye.
const FALLEN_LEG: Node = Node { up: 0.4, ..LEG };
const FALLEN_SHOULDER: Node = Node { up: 0.5, ..LEG };
const FALLEN_HEAD: Node = Node { up: 0.54, z: 0.8 };

/// Distance of the feet of a layer from the middle between two layers that lie face to face, in
/// diameters. By eye. With twice the value, `interlock_is_twice_as_thick_as_jersey` is red; with
/// half, no test is.
const APART: f64 = 0.55;
/// [`APART`] in a cloth whose yarns float between the layers. By eye. With half the value,
/// `knits_come_to_rest` is red; with twice, no test is.
const FLOATS_APART: f64 = 1.0;

/// Sign of z on the side to which loops of a bed are drawn: 1 for the face, -1 for the back.
pub(super) fn side(bed: Bed) -> f64 {
    if bed == Bed::Front { 1.0 } else { -1.0 }
}

/// The form of one loop among its neighbours, in mm.
///
/// A loop comes through the loops that hang on its needle. Its feet pass behind the upper legs of
/// those loops, and its legs pass in front of their heads. The lower half of the loop therefore
/// lies on the side to which the loop itself is drawn, and the upper half on the side to which the
/// next loop is drawn. If the sides differ, the legs cross the plane of the cloth.
#[derive(Debug, Clone, Copy)]
pub(super) struct Form<'a> {
    shape: &'a Shape,
    /// x of the loop's needle, mm.
    x: f64,
    /// y of the loop's course, mm.
    y: f64,
    /// Height of the loop's feet above `y`, mm.
    lift: f64,
    lower: Half,
    upper: Half,
    /// Distance by which the feet lie further back than they would behind a single loop, mm. More
    /// loops then lie in front of them.
    behind: f64,
    /// Distance by which the legs come forward, mm. In a stitch of several yarns, the legs of the
    /// hindmost yarn then still lie in front of the heads that they are drawn through.
    forward: f64,
    /// Distance of the head to the right of the loop's needle, mm.
    lean: f64,
    /// Number of courses in which the loop's needle does not knit.
    held: u32,
    /// z by which the legs are lifted over legs that they cross, mm.
    over: f64,
    /// Whether the loop is drawn through nothing: a tuck, or a loop on an empty needle.
    is_arch: bool,
    /// Whether nothing holds the loop.
    is_dropped: bool,
}

/// What the nodes of the upper or of the lower half of a loop have in common.
#[derive(Debug, Clone, Copy)]
struct Half {
    /// The side on which this half lies: 1 for the face, -1 for the back.
    side: f64,
    /// z of the plane about which this half lies, mm.
    middle: f64,
    /// Distance by which this half lies further back, because other loops lie in front of it, mm.
    back: f64,
}

impl Half {
    /// The upper half of the loop `number`, on the side of the loop that is drawn through it.
    fn upper(shape: &Shape, stitches: &Stitches, layers: &Layers, number: u32) -> Self {
        let (next, opposite) = drawn_through(stitches, number);
        let layer = stitches.loops[number as usize].head.layer;
        let middle = middle(shape, layers, next, opposite);
        Self { side: side(next), middle, back: f64::from(layer) * shape.diameter }
    }

    fn z(self, shape: &Shape, node: Node) -> f64 {
        self.middle + self.side * (node.z * shape.depth - self.back)
    }
}

/// z of the plane about which the loops of a bed lie, mm. `opposite` says whether the needles
/// opposite hold loops, too.
fn middle(shape: &Shape, layers: &Layers, bed: Bed, opposite: bool) -> f64 {
    let apart = if layers.has_floats() { FLOATS_APART } else { APART };
    if opposite { side(bed) * (ARC.z.abs() * shape.depth + apart * shape.diameter) } else { 0.0 }
}

/// The bed to which the head of a loop is drawn, and whether the needle opposite holds loops at
/// that time.
fn drawn_through(stitches: &Stitches, number: u32) -> (Bed, bool) {
    let stitch = &stitches.loops[number as usize];
    match stitch.fate {
        Fate::Held(child) => {
            let child = &stitches.loops[child.number as usize];
            (child.bed, child.opposite)
        }
        Fate::OnNeedle => (stitch.head.bed, stitch.opposite),
        Fate::Dropped => (stitch.bed, stitch.opposite),
    }
}

/// Number of yarns in the stitch that a loop belongs to.
fn plates(stitches: &Stitches, number: u32) -> u16 {
    let following = stitches.loops[number as usize..].windows(2);
    let last = following.take_while(|pair| pair[1].plate == pair[0].plate + 1).count();
    stitches.loops[number as usize].plate + 1 + last as u16
}

/// Number of control points that [`Form::points`] gives for the loop `number`.
pub(super) fn point_count(stitches: &Stitches, number: u32) -> u64 {
    let stitch = &stitches.loops[number as usize];
    let is_arch = stitch.kind == LoopKind::Tuck || stitch.parents.is_empty();
    let half = match (is_arch, stitch.fate == Fate::Dropped) {
        (true, true) => 1,
        (false, true) => 4,
        (true, false) => 4 + u64::from(held(stitches, number)),
        (false, false) => {
            let changes = stitch.bed != drawn_through(stitches, number).0;
            5 + u64::from(changes) + u64::from(held(stitches, number))
        }
    };
    2 * half + 1
}

/// Number of courses in which the needle of a loop does not knit.
fn held(stitches: &Stitches, number: u32) -> u32 {
    let stitch = &stitches.loops[number as usize];
    let held = held_until(stitches, stitch.fate).unwrap_or(0) - i64::from(stitch.course) - 1;
    u32::try_from(held).unwrap_or(0)
}

impl<'a> Form<'a> {
    /// The form of the loop `number`. Its needle is at `x`, its course at height `y`, and its feet
    /// lie `lift` above that, all in mm.
    pub(super) fn new(
        shape: &'a Shape,
        stitches: &Stitches,
        layers: &Layers,
        number: u32,
        [x, y, lift]: [f64; 3],
    ) -> Self {
        let stitch = &stitches.loops[number as usize];
        let is_tuck = stitch.kind == LoopKind::Tuck;
        let upper = Half::upper(shape, stitches, layers, number);
        // A tuck lies about the plane of the loop that is drawn through it. An arch on an empty
        // needle does, too, because the loops opposite may have come later.
        let is_arch = is_tuck || stitch.parents.is_empty();
        let (next, _) = drawn_through(stitches, number);
        let middle = if is_arch { upper.middle } else { middle(shape, layers, stitch.bed, stitch.opposite) };
        let own = if is_tuck { next } else { stitch.bed };
        let lower = Half { side: side(own), middle, back: f64::from(stitch.plate) * shape.diameter };
        let behind = if is_tuck {
            f64::from(stitch.head.layer.saturating_sub(1)) * shape.diameter
        } else {
            // The loop's feet lie behind the legs of every loop that it is drawn through.
            let leg = lower.middle + lower.side * UPPER.z * shape.depth;
            let further = stitches.parents_of(number).iter().map(|parent| {
                let parent = Half::upper(shape, stitches, layers, parent.number);
                lower.side * (leg - parent.z(shape, UPPER))
            });
            further.fold(0.0, f64::max)
        };
        let over = |crossed| side(next) * (CROSSING - crossed) * shape.diameter;
        Self {
            shape,
            x,
            y,
            lift,
            lower,
            upper,
            behind,
            forward: f64::from(plates(stitches, number) - 1) * shape.diameter,
            lean: f64::from(stitch.head.at - stitch.at) * shape.wale,
            held: held(stitches, number),
            over: layers.crossed(number).map_or(0.0, over),
            is_arch,
            is_dropped: stitch.fate == Fate::Dropped,
        }
    }

    /// z of the arcs on both sides of the loop, mm.
    pub(super) fn arc_z(&self) -> f64 {
        self.z(self.lower, ARC) - self.lower.side * self.behind
    }

    fn z(&self, half: Half, node: Node) -> f64 {
        half.z(self.shape, node)
    }

    /// Control points from foot to foot, mm, and the index of the head among them. The yarn comes
    /// from the left if `direction` is 1, and from the right if it is -1.
    pub(super) fn points(&self, direction: f64) -> (Vec<DVec3>, usize) {
        let mut points = self.half(-direction);
        let head = points.len();
        let (top, z) = match (self.is_dropped, self.is_arch) {
            (true, true) => (self.height(FOOT) + self.lift, self.arc_z()),
            (true, false) => {
                let z = self.z(self.lower, FALLEN_HEAD) + self.lower.side * self.forward;
                (self.height(FALLEN_HEAD), z)
            }
            (false, _) => {
                let up = f64::from(self.held) * self.shape.course;
                (self.height(HEAD) + up, self.z(self.upper, HEAD))
            }
        };
        points.push(DVec3::new(self.x + self.lean, top, z));
        points.extend(self.half(direction).into_iter().rev());
        (points, head)
    }

    fn height(&self, node: Node) -> f64 {
        self.y + node.up * self.shape.height()
    }

    /// Control points of one half, from foot to shoulder, mm: the left half if `hand` is -1, the
    /// right half if it is 1.
    fn half(&self, hand: f64) -> Vec<DVec3> {
        let Shape { wale, course, .. } = *self.shape;
        let narrow = self.shape.narrow();
        // `way` is the share of the distance from the loop's first needle to the needle that it is
        // moved to.
        let at = |across: f64, way: f64, y: f64, z: f64| {
            DVec3::new(self.x + hand * across + way * self.lean, y, z)
        };
        let (lower, upper) = (self.lower, self.upper);
        let forward = lower.side * self.forward;
        let foot_z = self.z(lower, FOOT) - lower.side * self.behind;
        let mut points = Vec::with_capacity(8);
        if self.is_arch {
            points.push(at(SHOULDER_WIDE * wale, 0.0, self.height(FOOT) + self.lift, self.arc_z()));
            if self.is_dropped {
                return points;
            }
            let z = self.z(upper, ARCH_LEG) + self.over;
            points.push(at(LEG_WIDE * wale, 0.0, self.height(ARCH_LEG), z));
        } else {
            points.push(at(FOOT_WIDE * wale, 0.0, self.height(FOOT) + self.lift, foot_z));
            // The leg comes out between the shoulders of the loop below, and in front of them. It
            // can lean only further up.
            let leans = LEANS * self.lean.clamp(-wale, wale);
            let over = lower.side * f64::max(lower.side * self.over, 0.0);
            let z = self.z(lower, LOWER) + forward + LIFTED_ENDS * over;
            points.push(DVec3::new(self.x + hand * narrow + leans, self.height(LOWER), z));
            if self.is_dropped {
                for (node, across) in [(FALLEN_LEG, LEG_WIDE), (FALLEN_SHOULDER, SHOULDER_WIDE)] {
                    points.push(at(across * wale, 0.5, self.height(node), self.z(lower, node) + forward));
                }
                return points;
            }
            if lower.side == upper.side {
                // A moved loop leaves one side of its needle. Nothing lies in front of the leg on
                // that side.
                let leaves = hand * self.lean < 0.0;
                let plated = self.forward > 0.0;
                let z = if leaves || plated { self.z(lower, LEG) + forward } else { self.z(upper, LEG) };
                points.push(at(LEG_WIDE * wale, 0.5, self.height(LEG), z + self.over));
            } else {
                // The leg crosses the plane of the cloth between the loop below and the loop above.
                let halves = [(lower, forward), (upper, 0.0)];
                for ((half, forward), (across, node)) in halves.into_iter().zip(CHANGES_SIDES) {
                    let z = self.z(half, node) + forward + self.over;
                    points.push(at(across * wale, 0.5, self.height(node), z));
                }
            }
        }
        if let Some(&leg) = points.last() {
            points.extend((1..=self.held).map(|up| leg + DVec3::Y * (f64::from(up) * course)));
        }
        let up = f64::from(self.held) * course;
        let high = |node| self.height(node) + up;
        let z = self.z(upper, UPPER) + LIFTED_ENDS * self.over;
        points.push(at(0.5 * wale - narrow, 1.0, high(UPPER), z));
        points.push(at(SHOULDER_WIDE * wale, 1.0, high(SHOULDER), self.z(upper, SHOULDER)));
        points
    }
}
