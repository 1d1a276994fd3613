//! One loop: where its yarn goes.

use glam::DVec3;

use super::layers::{Layers, held_until};
use super::shape::{
    ARC, FOOT, FOOT_WIDE, HEAD, LEG, LEG_WIDE, LOWER, Node, SHOULDER, SHOULDER_WIDE, Shape, UPPER,
};
use super::{Bed, Fate, LoopKind, Stitches};

/// How far legs that cross over others are lifted from where they lie else, in diameters; those
/// under them lie one lower.
const CROSSING: f64 = 0.7;

/// How far the legs of a loop that is moved lean where they come out of the loop before, of the way
/// to the next needle.
const LEANS: f64 = 0.1;

/// What nothing holds falls in front of what it is drawn through, below the feet of the next
/// course; what is drawn through nothing either is a float.
const FALLEN_LEG: Node = Node { up: 0.4, ..LEG };
const FALLEN_SHOULDER: Node = Node { up: 0.5, ..LEG };
const FALLEN_HEAD: Node = Node { up: 0.54, z: 0.8 };

/// How far the feet of two layers of cloth that lie face to face are from the middle between them,
/// in diameters; and where yarns float there.
const APART: f64 = 0.55;
const FLOATS_APART: f64 = 1.0;

/// +1 for what is drawn to the face, -1 to the back.
pub(super) fn side(bed: Bed) -> f64 {
    if bed == Bed::Front { 1.0 } else { -1.0 }
}

/// A loop's place among those that it is drawn through and that are drawn through it, in mm.
///
/// A loop comes through what hangs on its needle: its feet pass behind the upper legs of that, its
/// own legs in front of the heads. So its lower half follows the side to which it is drawn itself,
/// and its upper half that of the loop which is drawn through it. Where these differ, its legs go
/// through the plane of the cloth.
#[derive(Debug, Clone, Copy)]
pub(super) struct Form<'a> {
    shape: &'a Shape,
    /// Its middle.
    x: f64,
    /// Its course.
    y: f64,
    /// How far its feet lie above that.
    lift: f64,
    lower: Half,
    upper: Half,
    /// How much further back its feet are than behind one loop, because of others that lie between,
    /// mm.
    behind: f64,
    /// How far its legs come forward, so that those of the hindmost of several yarns still lie in
    /// front of the heads that they are drawn through, mm.
    forward: f64,
    /// How far to the right its head is.
    lean: f64,
    /// For how many courses its needle does not knit.
    held: u32,
    /// How far its legs are lifted over those of others that they cross.
    over: f64,
    /// Whether it is drawn through nothing: a tuck, or a loop on an empty needle.
    is_arch: bool,
    /// Whether nothing holds it.
    is_dropped: bool,
}

/// What one half of a loop has in common.
#[derive(Debug, Clone, Copy)]
struct Half {
    /// To which side the loop is drawn: 1 to the face, -1 to the back.
    side: f64,
    /// z of the plane about which it lies.
    middle: f64,
    /// How much further back than that it lies, because of others in front.
    back: f64,
}

impl Half {
    /// The upper half of a loop: it follows the loop that is drawn through it.
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

/// z of the plane about which loops of a bed lie, whose opposite needles hold loops or do not.
fn middle(shape: &Shape, layers: &Layers, bed: Bed, opposite: bool) -> f64 {
    let apart = if layers.has_floats() { FLOATS_APART } else { APART };
    if opposite { side(bed) * (ARC.z.abs() * shape.depth + apart * shape.diameter) } else { 0.0 }
}

/// The bed to which a loop's head is drawn, and whether needles opposite hold loops then.
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

/// How many yarns the stitch of a loop has.
fn plates(stitches: &Stitches, number: u32) -> u16 {
    let following = stitches.loops[number as usize..].windows(2);
    let last = following.take_while(|pair| pair[1].plate == pair[0].plate + 1).count();
    stitches.loops[number as usize].plate + 1 + last as u16
}

/// How many control points [`Form::points`] has for the loop `number`.
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

/// For how many courses the needle of a loop does not knit.
fn held(stitches: &Stitches, number: u32) -> u32 {
    let stitch = &stitches.loops[number as usize];
    let held = held_until(stitches, stitch.fate).unwrap_or(0) - i64::from(stitch.course) - 1;
    u32::try_from(held).unwrap_or(0)
}

impl<'a> Form<'a> {
    /// The loop `number`, its needle at `x` and its course at height `y`, its feet `lift` above
    /// that.
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
        // A tuck lies as the loop that is drawn through it and through what else hangs there. So
        // does an arch on an empty needle: what hangs opposite may have come later.
        let is_arch = is_tuck || stitch.parents.is_empty();
        let (next, _) = drawn_through(stitches, number);
        let middle = if is_arch { upper.middle } else { middle(shape, layers, stitch.bed, stitch.opposite) };
        let own = if is_tuck { next } else { stitch.bed };
        let lower = Half { side: side(own), middle, back: f64::from(stitch.plate) * shape.diameter };
        let behind = if is_tuck {
            f64::from(stitch.head.layer.saturating_sub(1)) * shape.diameter
        } else {
            // Behind the legs of all that it is drawn through, wherever these go.
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

    /// z of the arcs from which its feet come.
    pub(super) fn arc_z(&self) -> f64 {
        self.z(self.lower, ARC) - self.lower.side * self.behind
    }

    fn z(&self, half: Half, node: Node) -> f64 {
        half.z(self.shape, node)
    }

    /// Its control points from foot to foot, as the yarn takes them that comes from the left
    /// (`direction` 1) or from the right (-1); and which of them is the head.
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

    /// From foot to head, `hand` -1 the left one, 1 the right one.
    fn half(&self, hand: f64) -> Vec<DVec3> {
        let Shape { wale, course, .. } = *self.shape;
        let narrow = self.shape.narrow();
        // How far along the way from the own needle to the one that it is moved to.
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
            let leg = Node { up: 0.4, ..LEG };
            points.push(at(LEG_WIDE * wale, 0.0, self.height(leg), self.z(upper, leg) + self.over));
        } else {
            points.push(at(FOOT_WIDE * wale, 0.0, self.height(FOOT) + self.lift, foot_z));
            // It has to come out between the shoulders of what it is drawn through, and in front of
            // them, before it leans.
            let leans = LEANS * self.lean.clamp(-wale, wale);
            let over = lower.side * f64::max(lower.side * self.over, 0.0);
            let z = self.z(lower, LOWER) + forward + 0.6 * over;
            points.push(DVec3::new(self.x + hand * narrow + leans, self.height(LOWER), z));
            if self.is_dropped {
                for (node, across) in [(FALLEN_LEG, LEG_WIDE), (FALLEN_SHOULDER, SHOULDER_WIDE)] {
                    points.push(at(across * wale, 0.5, self.height(node), self.z(lower, node) + forward));
                }
                return points;
            }
            if lower.side == upper.side {
                // Of a loop that is moved, the leg on the side that it leaves has nothing in front
                // of it.
                let leaves = hand * self.lean < 0.0;
                let plated = self.forward > 0.0;
                let z = if leaves || plated { self.z(lower, LEG) + forward } else { self.z(upper, LEG) };
                points.push(at(LEG_WIDE * wale, 0.5, self.height(LEG), z + self.over));
            } else {
                // The leg goes through the plane of the cloth between what it came through and what
                // comes through it.
                for (half, across, up, forward) in [(lower, 0.2, 0.42, forward), (upper, 0.3, 0.58, 0.0)] {
                    let node = Node { up, z: 0.6 };
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
        points.push(at(0.5 * wale - narrow, 1.0, high(UPPER), self.z(upper, UPPER) + 0.6 * self.over));
        points.push(at(SHOULDER_WIDE * wale, 1.0, high(SHOULDER), self.z(upper, SHOULDER)));
        points
    }
}
