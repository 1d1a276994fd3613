//! Neighbours of chords. Each chord's neighbours are listed in the order of their numbers, so that
//! the result does not depend on the way in which a device searches for them.

use std::f32::consts::FRAC_PI_2;

use glam::IVec3;

use super::plan::{SKIN, SettlingPlan};
use super::{Chord, Interval, MARGIN};

/// A chord with its interval, and the chord's place in the interval.
#[derive(Debug, Clone, Copy)]
pub struct Listed<'a> {
    /// The chord.
    pub chord: &'a Chord,
    /// The chord's interval.
    pub interval: &'a Interval,
    /// Number of the place at which the interval begins.
    pub place: usize,
    /// The chord's number within the interval.
    pub piece: u32,
    /// The number of chords of the interval.
    pub pieces: u32,
}

/// The least length of yarn between two chords of one yarn that count as neighbours, as a multiple
/// of the sum of both radii. A yarn that comes as near to itself as that sum has made at least a
/// half circle, with the sum as its diameter.
pub const LEADS_ON: f32 = FRAC_PI_2;

impl<'a> Listed<'a> {
    /// Chord number `number` of all chords, on the interval that begins at `place`.
    #[must_use]
    #[inline]
    pub fn new(
        plan: &SettlingPlan,
        number: u32,
        chord: &'a Chord,
        place: usize,
        interval: &'a Interval,
    ) -> Self {
        let [first, end] = [plan.chords()[place], plan.chords()[place + 1]];
        Self { chord, interval, place, piece: number - first, pieces: end - first }
    }
}

impl SettlingPlan {
    /// The nearest image of the second chord, as a number of repeats along x and y. `way` is the
    /// vector from the first chord's start to the second's, in units. The middles of the chords
    /// decide which image is nearest.
    #[must_use]
    #[inline]
    pub fn image(&self, [one, other]: [&Chord; 2], way: IVec3) -> [i32; 2] {
        let apart = self.scale().length(way) + (other.span - one.span) * 0.5;
        let inverse = self.frequency();
        [0, 1].map(|axis| -((apart[axis] * inverse[axis] + 0.5).floor() as i32))
    }

    /// The vector `way`, in units, to the image `image` repeats away.
    #[must_use]
    #[inline]
    pub(super) fn to_image(&self, way: IVec3, image: [i32; 2]) -> IVec3 {
        let [x, y] = self.period();
        IVec3::new(
            way.x.wrapping_add(image[0].wrapping_mul(x)),
            way.y.wrapping_add(image[1].wrapping_mul(y)),
            way.z,
        )
    }

    /// Whether two chords are neighbours while yarns have the share `growth` of their thickness.
    /// Neighbours are near one another, but not so close along one yarn that they can't be clear of
    /// one another.
    #[must_use]
    pub fn are_neighbours(&self, one: Listed<'_>, other: Listed<'_>, growth: f32) -> bool {
        let way = other.chord.at.wrapping_sub(one.chord.at);
        let image = self.image([one.chord, other.chord], way);
        let between = self.scale().length(self.to_image(way, image));
        let shares = one.chord.nearest(other.chord, between);
        let gap = between + other.chord.span * shares[1] - one.chord.span * shares[0];
        let thickness = one.interval.thickest() + other.interval.thickest();
        let within = MARGIN * growth * thickness + SKIN * self.spans().diameter;
        let [yarn, other_yarn] = [one, other].map(|listed| self.yarns()[listed.place]);
        let chords = [one, other].map(|listed| self.chords()[listed.place] + listed.piece);
        gap.length_squared() < within * within
            && !(yarn == other_yarn && self.leads_on(yarn, chords, image, thickness))
    }

    /// Whether two chords of a yarn lie so close along it that they can't be clear of one another,
    /// because less yarn than a half circle of diameter `thickness` lies between them. The second
    /// chord counts at its image `image` repeats away.
    #[must_use]
    pub fn leads_on(&self, yarn: u32, chords: [u32; 2], image: [i32; 2], thickness: f32) -> bool {
        let strand = &self.strands()[yarn as usize];
        let [one, other] = chords.map(|chord| self.along()[chord as usize]);
        let window = (LEADS_ON * thickness / self.spans().along) as i32;
        let between = |end: u32, start: u32| (-2..window).contains(&(start.wrapping_sub(end) as i32));
        let here = image == [0, 0] && (between(one[1], other[0]) || between(other[1], one[0]));
        let goes_on = strand.shift().is_some_and(|shift| {
            let ahead = image == shift && between(one[1], other[0].wrapping_add(strand.length));
            let back = image == shift.map(|repeats| -repeats);
            ahead || (back && between(other[1], one[0].wrapping_add(strand.length)))
        });
        here || goes_on
    }

    /// The size of cells, mm, for which all neighbours of a chord lie in its own cell or one beside
    /// it, if no chord is longer than `longest`.
    #[must_use]
    pub fn cell(&self, growth: f32, longest: f32) -> f32 {
        let spans = self.spans();
        1.001 * (2.0 * MARGIN * growth * spans.thickest + SKIN * spans.diameter + longest)
    }
}
