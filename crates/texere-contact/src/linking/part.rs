//! The control intervals that a cell of the search holds.

use glam::{UVec3, Vec3A};

use super::images::{Image, Images, shifted};
use super::motion::Chord;
use super::shapes::{Motion, Shape, Shapes, room};
use crate::grid::{Bounds, Grid};

/// One copy of an interval, in both shapes.
#[derive(Debug)]
pub(super) struct Part {
    pub(super) yarn: usize,
    pub(super) interval: usize,
    pub(super) image: Image,
    pub(super) motion: Motion,
    pub(super) bounds: [Bounds; 2],
    /// The first cell that the copy's box reaches into.
    pub(super) cell: UVec3,
    /// The copy's start, middle and end before and after.
    corners: [[Vec3A; 3]; 2],
    /// Upper bound of the centreline's distance from the chords between the corners, with all
    /// rounding, mm.
    sagitta: f32,
    /// How far the ends lie from the middle before, how far after, and how far the motion of either
    /// end differs from that of the middle, mm.
    spread: [f32; 3],
}

impl Part {
    /// The copy of interval `number` that begins `back` repeats before the first repeat. `grid`
    /// holds the boxes in `shape`.
    pub(super) fn new(
        shapes: &Shapes<'_>,
        (number, back): (usize, [u64; 2]),
        images: &Images,
        (grid, shape): (&Grid, Shape),
    ) -> Self {
        let ((yarn, interval), motion) = (shapes.yarn_of(number), shapes.motion(number));
        let hulls = shapes.strands(yarn).map(|strand| strand.hull(interval));
        let rooms = hulls.map(|hull| room(hull.bounds(), motion.margin));
        let image = images.image(&rooms[shape as usize], back);
        let offset = images.offset(image.moved).as_vec3a();
        let bounds = rooms.map(|room| shifted(room, offset));
        let corners = hulls.map(|hull| hull.chords().map(|corner| corner + offset));
        let [before, after] = corners;
        let spread = |[start, middle, end]: [Vec3A; 3]| {
            start.distance_squared(middle).max(end.distance_squared(middle)).sqrt()
        };
        let furthest = |each: &Bounds| each.low.abs().max(each.high.abs()).max_element();
        let rounding = 4.0 * f32::EPSILON * furthest(&bounds[0]).max(furthest(&bounds[1]));
        let moved = [0, 1, 2].map(|corner| after[corner] - before[corner]);
        Self {
            yarn,
            interval,
            image,
            motion,
            bounds,
            cell: grid.cell(bounds[shape as usize].low),
            corners,
            sagitta: hulls[0].sagitta().max(hulls[1].sagitta()) + rounding,
            spread: [spread(before), spread(after), spread(moved)],
        }
    }

    /// Whether one interval has moved so far against the other that their distances before and
    /// after don't tell whether they met on the way.
    fn is_afar(&self, other: &Self, motion: f32) -> bool {
        motion > 2.0 * (self.motion.margin + other.motion.margin)
    }

    /// Whether the two intervals may have met on a straight way from the one shape to the other, or
    /// have moved too far for their distances to tell.
    pub(super) fn may_have_passed(&self, other: &Self) -> bool {
        let apart = self.sagitta + other.sagitta;
        let [before, after] = [0, 1].map(|shape| self.corners[shape][1] - other.corners[shape][1]);
        let motion = (after - before).length() + self.spread[2] + other.spread[2];
        let gap =
            |shape: usize, way: Vec3A| (way.length() - self.spread[shape] - other.spread[shape]).max(0.0);
        if gap(0, before) + gap(1, after) > motion + 2.0 * apart && !self.is_afar(other, motion) {
            return false;
        }
        [0, 1].into_iter().any(|half| {
            [0, 1].into_iter().any(|other_half| {
                let (one, two) = (self.chord(half), other.chord(other_half));
                let motion = one.motion(&two);
                self.is_afar(other, motion) || one.may_meet(&two, motion, apart)
            })
        })
    }

    /// The chord over the copy's first or second half.
    fn chord(&self, half: usize) -> Chord {
        let [before, after] = self.corners.map(|corners| [corners[half], corners[half + 1]]);
        Chord { before, after }
    }
}
