//! One loop: where its yarn goes.

use glam::DVec3;

use super::layers::{Layers, held_until};
use super::shape::{
    ARC, FOOT, FOOT_WIDE, HEAD, LEG, LEG_WIDE, LOWER, Node, SHOULDER, SHOULDER_WIDE, Shape, UPPER,
};
use super::{Bed, Fate, LoopKind, Stitches};

/// How far legs that cross over others are lifted from where they lie else, in diameters; those under them lie one lower.
const CROSSING: f64 = 0.7;

/// How far the legs of a loop that is moved lean where they come out of the loop before, of the way to the next needle.
const LEANS: f64 = 0.1;

/// How far the feet of two layers of cloth that lie face to face are from the middle between them, in diameters; and where yarns
/// float there.
const APART: f64 = 0.55;
const FLOATS_APART: f64 = 1.0;

/// +1 for what is drawn to the face, -1 to the back.
pub(super) fn side(bed: Bed) -> f64 {
    if bed == Bed::Front { 1.0 } else { -1.0 }
}

/// A loop's place among those that it is drawn through and that are drawn through it, in mm.
///
/// A loop comes through what hangs on its needle: its feet pass behind the upper legs of that, its own legs in front of the
/// heads. So its lower half follows the side to which it is drawn itself, and its upper half that of the loop which is drawn
/// through it. Where these differ, its legs go through the plane of the cloth.
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
    /// How much further back its feet are than behind one loop, because of others that lie between.
    behind: f64,
    /// How far to the right its head is.
    lean: f64,
    /// For how many courses its needle does not knit.
    held: u32,
    /// How far its legs are lifted over those of others that they cross.
    over: f64,
    /// Whether it is drawn through nothing: a tuck, or a loop on an empty needle.
    is_arch: bool,
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

impl<'a> Form<'a> {
    /// The loop `number`, its needle at `x` and its course at height `y`, its feet `lift` above that.
    pub(super) fn new(
        shape: &'a Shape,
        stitches: &Stitches,
        layers: &Layers,
        number: u32,
        [x, y, lift]: [f64; 3],
    ) -> Self {
        let stitch = &stitches.loops[number as usize];
        let parents = stitch.parents.len();
        let (next, opposite) = match stitch.fate {
            Fate::Held(child) => {
                let child = &stitches.loops[child.number as usize];
                (child.bed, child.opposite)
            }
            Fate::OnNeedle => (stitch.head.bed, stitch.opposite),
            Fate::Dropped => (stitch.bed, stitch.opposite),
        };
        let is_tuck = stitch.kind == LoopKind::Tuck;
        let apart = if layers.has_floats() { FLOATS_APART } else { APART };
        let layer = ARC.z.abs() * shape.depth + apart * shape.diameter;
        let half = |bed, opposite, others: u16| {
            let side = side(bed);
            let middle = if opposite { side * layer } else { 0.0 };
            Half { side, middle, back: f64::from(others) * shape.diameter }
        };
        // A tuck lies as the loop that is drawn through it and through what else hangs there.
        let own = if is_tuck { next } else { stitch.bed };
        let between = if is_tuck { usize::from(stitch.head.layer) } else { parents };
        let held = held_until(stitches, stitch.fate).unwrap_or(0) - i64::from(stitch.course) - 1;
        let over = |crossed| side(next) * (CROSSING - crossed) * shape.diameter;
        // So does an arch on an empty needle: what hangs opposite may have come later.
        let is_arch = is_tuck || parents == 0;
        let own_opposite = if is_arch { opposite } else { stitch.opposite };
        Self {
            shape,
            x,
            y,
            lift,
            lower: half(own, own_opposite, stitch.plate),
            upper: half(next, opposite, stitch.head.layer),
            behind: between.saturating_sub(1) as f64 * shape.diameter,
            lean: f64::from(stitch.head.at - stitch.at) * shape.wale,
            held: u32::try_from(held).unwrap_or(0),
            over: layers.crossed(number).map_or(0.0, over),
            is_arch,
        }
    }

    /// z of the arcs from which its feet come.
    pub(super) fn arc_z(&self) -> f64 {
        self.z(self.lower, ARC) - self.lower.side * self.behind
    }

    fn z(&self, half: Half, node: Node) -> f64 {
        half.middle + half.side * (node.z * self.shape.depth - half.back)
    }

    /// Its control points from foot to foot, as the yarn takes them that comes from the left (`direction` 1) or from the right
    /// (-1); and which of them is the head.
    pub(super) fn points(&self, direction: f64) -> (Vec<DVec3>, usize) {
        let mut points = self.half(-direction);
        let head = points.len();
        let top = self.height(HEAD) + f64::from(self.held) * self.shape.course;
        points.push(DVec3::new(self.x + self.lean, top, self.z(self.upper, HEAD)));
        points.extend(self.half(direction).into_iter().rev());
        (points, head)
    }

    fn height(&self, node: Node) -> f64 {
        self.y + node.up * self.shape.height()
    }

    /// From foot to head, `hand` -1 the left one, 1 the right one.
    fn half(&self, hand: f64) -> Vec<DVec3> {
        let Shape { wale, course, diameter: _, depth: _ } = *self.shape;
        let narrow = self.shape.narrow();
        // How far along the way from the own needle to the one that it is moved to.
        let at = |across: f64, way: f64, y: f64, z: f64| {
            DVec3::new(self.x + hand * across + way * self.lean, y, z)
        };
        let (lower, upper) = (self.lower, self.upper);
        let foot_z = self.z(lower, FOOT) - lower.side * self.behind;
        let mut points = Vec::with_capacity(8);
        if self.is_arch {
            points.push(at(SHOULDER_WIDE * wale, 0.0, self.height(FOOT) + self.lift, self.arc_z()));
            let leg = Node { up: 0.4, ..LEG };
            points.push(at(LEG_WIDE * wale, 0.0, self.height(leg), self.z(upper, leg) + self.over));
        } else {
            points.push(at(FOOT_WIDE * wale, 0.0, self.height(FOOT) + self.lift, foot_z));
            // It has to come out between the shoulders of what it is drawn through, and in front of them, before it leans.
            let leans = LEANS * self.lean.clamp(-wale, wale);
            let forward = lower.side * f64::max(lower.side * self.over, 0.0);
            let z = self.z(lower, LOWER) + 0.6 * forward;
            points.push(DVec3::new(self.x + hand * narrow + leans, self.height(LOWER), z));
            if lower.side == upper.side {
                // Of a loop that is moved, the leg on the side that it leaves has nothing in front of it.
                let leaves = hand * self.lean < 0.0;
                let z = self.z(if leaves { lower } else { upper }, LEG);
                points.push(at(LEG_WIDE * wale, 0.5, self.height(LEG), z + self.over));
            } else {
                // The leg goes through the plane of the cloth between what it came through and what comes through it.
                for (half, across, up) in [(lower, 0.2, 0.42), (upper, 0.3, 0.58)] {
                    let node = Node { up, z: 0.6 };
                    points.push(at(across * wale, 0.5, self.height(node), self.z(half, node) + self.over));
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
