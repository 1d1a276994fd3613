//! The weft's turns round the edge ends, from one pick to the next.

use std::ops::Range;

use texere_core::{ControlPoint, Halves};

use super::thread::Thread;

/// Number of control points of a turn, which lie on a half circle.
pub(super) const TURN_POINTS: usize = 5;

/// The picks of each yarn. Without `selvedge` each pick is a yarn. With it, each run of picks alike
/// in material, section and twist is one yarn.
pub(super) fn runs(weft: &[Thread], selvedge: bool) -> Vec<Range<usize>> {
    let goes_on = |a: &Thread, b: &Thread| {
        selvedge && (a.material, a.section) == (b.material, b.section) && a.twist == b.twist
    };
    let mut first = 0;
    weft.chunk_by(goes_on)
        .map(|run| {
            first += run.len();
            first - run.len()..first
        })
        .collect()
}

/// Whether a pick runs to the left. With a selvedge every other pick runs to the left, whatever
/// yarn it belongs to.
pub(super) const fn runs_left(pick: usize, selvedge: bool) -> bool {
    selvedge && pick % 2 == 1
}

/// A turn that, seen from the face, is a half circle `from` one pick `to` the next. It begins and
/// ends at `x`. `outwards` is +1 at the right edge and -1 at the left. Heights and sizes change
/// steadily from those of one pick to those of the other.
///
/// If the two picks lie on different sides of the edge end, the turn is level with that end half
/// way round, where it is furthest from the end.
pub(super) fn turn(
    x: f32,
    outwards: f32,
    from: &ControlPoint,
    to: &ControlPoint,
) -> [ControlPoint; TURN_POINTS] {
    // Sines and cosines of 0 to 180 degrees in steps of 45 degrees.
    const SIN: [f32; TURN_POINTS] =
        [0.0, std::f32::consts::FRAC_1_SQRT_2, 1.0, std::f32::consts::FRAC_1_SQRT_2, 0.0];
    const COS: [f32; TURN_POINTS] =
        [1.0, std::f32::consts::FRAC_1_SQRT_2, 0.0, -std::f32::consts::FRAC_1_SQRT_2, -1.0];
    let reach = outwards * (to.y - from.y) / 2.0;
    std::array::from_fn(|step| {
        let done = (1.0 - COS[step]) / 2.0;
        let between = |from: f32, to: f32| from + done * (to - from);
        let (x, y, z) = (x + reach * SIN[step], between(from.y, to.y), between(from.z, to.z));
        let width = between(from.half_width(), to.half_width());
        let height = between(from.half_height(), to.half_height());
        ControlPoint { x, y, z, halves: Halves::new(width, height) }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_ends_where_the_yarn_changes() {
        let [a, b] = [0, 1].map(|material| Thread { material, ..Thread::new(1.0, 0.1) });
        let thick = Thread { radius_mm: 0.2, ..a };
        assert_eq!(runs(&[a, a, b, a, thick], true), [0..2, 2..3, 3..5]);
        assert_eq!(runs(&[a, a, b], false), [0..1, 1..2, 2..3]);
    }

    #[test]
    fn a_turn_is_a_half_circle() {
        let (from, to) = (ControlPoint::new(7.0, 1.0, 0.2, 0.1), ControlPoint::new(7.0, 3.0, -0.2, 0.3));
        for outwards in [-1.0, 1.0] {
            let turn = turn(10.0, outwards, &from, &to);
            for point in turn {
                assert!(((point.x - 10.0).hypot(point.y - 2.0) - 1.0).abs() < 1e-6, "{point:?}");
            }
            assert_eq!((turn[0].y, turn[0].z, turn[4].y, turn[4].z), (1.0, 0.2, 3.0, -0.2));
            assert_eq!((turn[2].x, turn[2].z), (10.0 + outwards, 0.0));
            assert!((turn[2].half_width() - 0.2).abs() < 1e-4);
        }
    }
}
