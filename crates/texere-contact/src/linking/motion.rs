//! Whether two chords meet while their ends move along straight lines.

use glam::Vec3A;

/// The most halvings of a stretch of time. Chords that may still meet in so short a stretch count
/// as meeting. With half the value, and with twice, no test is red.
const HALVINGS: u32 = 10;

/// A chord whose ends move along straight lines from one time to another.
#[derive(Debug, Clone, Copy)]
pub(super) struct Chord {
    pub(super) before: [Vec3A; 2],
    pub(super) after: [Vec3A; 2],
}

impl Chord {
    fn at(&self, time: f32) -> [Vec3A; 2] {
        [0, 1].map(|end| self.before[end].lerp(self.after[end], time))
    }

    /// Upper bound of how far the `other` chord moves against this one, mm.
    pub(super) fn motion(&self, other: &Self) -> f32 {
        let [one, two] = [self, other].map(|chord| [0, 1].map(|end| chord.after[end] - chord.before[end]));
        let squared = |a: usize, b: usize| one[a].distance_squared(two[b]);
        squared(0, 0).max(squared(0, 1)).max(squared(1, 0)).max(squared(1, 1)).sqrt()
    }

    /// Whether the two chords may come within `apart` mm of one another on the way. `motion` is an
    /// upper bound of how far they move against one another, mm.
    pub(super) fn may_meet(&self, other: &Self, motion: f32, apart: f32) -> bool {
        let distance = |time: f32| distance(self.at(time), other.at(time));
        let start = distance(0.0);
        start <= motion + apart
            && meets(&distance, motion, apart, [(0.0, start), (1.0, distance(1.0))], HALVINGS)
    }
}

/// Whether a distance may fall to `apart` between two times at which it is known. In the time from
/// 0 to 1 the distance changes by `motion` at most.
fn meets(
    distance: &impl Fn(f32) -> f32,
    motion: f32,
    apart: f32,
    [start, end]: [(f32, f32); 2],
    halvings: u32,
) -> bool {
    // From either end the distance falls by `motion` times the time at most. Its lower bound is
    // least at the time at which the bounds from both ends meet.
    if start.1 + end.1 - motion * (end.0 - start.0) > 2.0 * apart {
        return false;
    }
    if start.1.min(end.1) <= apart || halvings == 0 {
        return true;
    }
    let middle = (start.0 + end.0) / 2.0;
    let middle = (middle, distance(middle));
    meets(distance, motion, apart, [start, middle], halvings - 1)
        || meets(distance, motion, apart, [middle, end], halvings - 1)
}

/// The distance of two straight segments.
///
/// **Source**: Ericson, "Real-time collision detection", Morgan Kaufmann 2005, section 5.1.9.
fn distance([p, p_end]: [Vec3A; 2], [q, q_end]: [Vec3A; 2]) -> f32 {
    let share = |over: f32, under: f32| if under > 0.0 { (over / under).clamp(0.0, 1.0) } else { 0.0 };
    let (along, other, apart) = (p_end - p, q_end - q, p - q);
    let (a, e, f) = (along.length_squared(), other.length_squared(), other.dot(apart));
    let (c, b) = (along.dot(apart), along.dot(other));
    let s = share(b * f - c * e, a * e - b * b);
    // The best place on the other segment may lie beyond its end. Then the best place on the first
    // segment is the one for that end.
    let t = share(b * s + f, e);
    let s = share(b * t - c, a);
    (p + along * s).distance(q + other * t)
}
