//! Chords along an interval, and the places where the chords of two intervals come near each other.

use glam::{DVec2, DVec3};

use super::interval::{Cubic, closest};

/// How far an interval may lie from its chords, in radii of its yarn. The distance is small enough
/// that almost every approach of two yarns is also an approach of their chords, and that refinement
/// from there converges. With half the value, and with twice, no test is red.
pub(super) const SAGITTA: f64 = 0.1;

/// How far an interval may lie from its fine chords, in radii of its yarn. The clearance ratio at
/// the fine chords then differs by less than [`CLEARANCE_ACCURACY`](crate::CLEARANCE_ACCURACY) from
/// the ratio at the curves. With half the value, and with twice, no test is red.
pub(super) const SAGITTA_FINE: f64 = 0.0005;

/// Chords of usual size. An interval has 12 at most.
pub(super) type Usual = Chords<14>;

/// Fine chords. An interval has 64 at most.
pub(super) type Fine = Chords<66>;

/// The corners of chords along an interval. `ROW` is the length of a row in the table of pairs of
/// chords. A row has one entry for each chord and an empty one at each end, so an interval has
/// `ROW` - 2 chords at most.
#[derive(Debug, Clone, Copy)]
pub(super) struct Chords<const ROW: usize> {
    corners: [DVec3; ROW],
    lengths: [f64; ROW],
    count: usize,
}

impl<const ROW: usize> Chords<ROW> {
    /// Chords within `sagitta` radii of the curve, unless there would be too many.
    pub(super) fn of(cubic: &Cubic, sagitta: f64) -> Self {
        let most = ROW - 2;
        let [width, height] = cubic.floors();
        let sagitta = sagitta * width.min(height).max(f64::MIN_POSITIVE);
        let mut count = 1;
        while count < most {
            // n chords lie about 1/n² as far from a curve as one chord does.
            let times = (cubic.off_chords_squared(count).sqrt() / sagitta).sqrt();
            if times <= 1.0 {
                break;
            }
            count = ((count as f64 * times).ceil() as usize).clamp(count + 1, most);
        }
        let mut corners = [cubic.position(0.0); ROW];
        for (k, corner) in corners.iter_mut().enumerate().take(count + 1).skip(1) {
            *corner = cubic.position(k as f64 / count as f64);
        }
        let mut lengths = [0.0; ROW];
        for (length, ends) in lengths.iter_mut().zip(corners.windows(2)).take(count) {
            *length = ends[0].distance(ends[1]);
        }
        Self { corners, lengths, count }
    }

    /// Calls `start` for each approach of the two polygons. An approach is a pair of chords nearer
    /// than `within` and nearer than all pairs beside it. `start` gets the parameters at which the
    /// chords come nearest, and the parameters of the chords' middles. With `edges`, a pair at an
    /// end of an interval also counts if it is nearer than the pairs beside it along that end,
    /// because an approach may lie further in.
    pub(super) fn approaches(
        &self,
        other: &Self,
        within: f64,
        edges: bool,
        mut start: impl FnMut([DVec2; 2]),
    ) {
        let (rows, columns) = (self.count, other.count);
        let mut near = [[f64::INFINITY; ROW]; ROW];
        for row in 0..rows {
            let one = self.chord(row);
            for column in 0..columns {
                let two = other.chord(column);
                // `apart` is the square of twice the distance of the chords' middles. If the
                // middles are more than half of `reach` apart, the chords can't come nearer than
                // `within`.
                let apart = (one[0] + one[1] - two[0] - two[1]).length_squared();
                let reach = 2.0 * within + self.lengths[row] + other.lengths[column];
                if apart <= reach * reach {
                    near[row + 1][column + 1] = closest(one, two).0;
                }
            }
        }
        let near = near.as_flattened();
        for row in 0..rows {
            for column in 0..columns {
                let own = (row + 1) * ROW + column + 1;
                let here = near[own];
                // If two pairs are equally near, only the first of them counts.
                let before = [own - ROW - 1, own - ROW, own - ROW + 1, own - 1];
                let after = [own + 1, own + ROW - 1, own + ROW, own + ROW + 1];
                let least_of = |before: &[usize], after: &[usize]| {
                    before.iter().all(|place| near[*place] > here)
                        && after.iter().all(|place| near[*place] >= here)
                };
                let on_edge = |at: usize, count: usize| edges && (at == 0 || at + 1 == count);
                let least = least_of(&before, &after)
                    || (on_edge(row, rows) && least_of(&[own - 1], &[own + 1]))
                    || (on_edge(column, columns) && least_of(&[own - ROW], &[own + ROW]));
                if here <= within * within && least {
                    let (_, s, t) = closest(self.chord(row), other.chord(column));
                    let at = |s: f64, t: f64| {
                        DVec2::new((row as f64 + s) / rows as f64, (column as f64 + t) / columns as f64)
                    };
                    start([at(s, t), at(0.5, 0.5)]);
                }
            }
        }
    }

    fn chord(&self, number: usize) -> [DVec3; 2] {
        [self.corners[number], self.corners[number + 1]]
    }
}
