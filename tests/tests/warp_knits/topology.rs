//! Topology of warp knits: the number of times that a yarn goes through the surface that a loop
//! spans.

use glam::DVec3;
use texere_conformance::rest::{Span, piece_curve};
use texere_core::Yarns;
use texere_fabric::Piece;
use texere_fabric::warp::WarpKnitted;

/// Number of chords per interval of a spline.
const PARTS: usize = 6;

/// Control points of a loop, from foot to foot.
const LOOP: usize = 9;

/// A loop: its needle, its course, and its curve from foot to foot.
struct Loop {
    needle: i32,
    course: i32,
    curve: Vec<DVec3>,
}

/// Differences of `yarns` from the bars' laps. There are none if both legs of each loop go through
/// all loops on its needle in the course below, and through no others. `piece` is the whole of
/// `cloth`, and `yarns` are its yarns.
pub(crate) fn faults(cloth: &WarpKnitted, piece: &Piece, yarns: &Yarns) -> Vec<String> {
    let [wales, courses] = cloth.size().map(|count| count as i32);
    let gauge = cloth.gauge();
    let loops = loops(cloth, piece, yarns);
    let mut faults = Vec::new();
    for (number, below) in loops.iter().enumerate() {
        for [x, y] in (-2..=2).flat_map(|x| (-1..=1).map(move |y| [x, y])) {
            let shift = DVec3::new(
                f64::from(x * wales) * gauge.wale_mm,
                f64::from(y * courses) * gauge.course_mm,
                0.0,
            );
            let ring: Vec<_> = below.curve.iter().map(|point| *point + shift).collect();
            let span = Span::new(&ring, PARTS);
            for (other, above) in loops.iter().enumerate() {
                let apart =
                    [above.needle - below.needle - x * wales, above.course - below.course - y * courses];
                if apart == [0, 0] {
                    continue;
                }
                let head = above.curve.len() / 2;
                let through = [&above.curve[..=head], &above.curve[head..]].map(|leg| span.through(leg));
                let sound = match apart {
                    [0, 1] => through[0].abs() == 1 && through[1] == -through[0],
                    // The head of the loop below may lie in front of the surface or behind it,
                    // depending on how the surface is drawn.
                    [0, -1] => through[0] == -through[1],
                    _ => through == [0, 0],
                };
                if !sound {
                    let places = [below, above].map(|each| (each.needle, each.course));
                    faults.push(format!(
                        "loops {number} and {other} at {places:?}, {apart:?} apart: {through:?}"
                    ));
                }
            }
        }
    }
    faults
}

/// All loops. Loops that a guide makes in one course follow one another, with or without an
/// underlap between them.
fn loops(cloth: &WarpKnitted, piece: &Piece, yarns: &Yarns) -> Vec<Loop> {
    let sources = yarns.sources().expect("sources");
    let laps: Vec<_> = cloth.laps().collect();
    let courses = cloth.size()[1] as usize;
    assert_eq!(laps.len(), yarns.layout().yarns().len() * courses, "the piece is the whole cloth");
    let mut loops = Vec::new();
    for (yarn, laps) in laps.chunks(courses).enumerate() {
        let curve = piece_curve(piece, yarns, yarn, PARTS);
        let own = &sources[yarns.range(yarn).expect("a yarn")];
        for laid in laps {
            let first = own.iter().position(|source| *source == laid.course + 1).expect("a lap");
            let needles: Vec<_> = laid.lap.needles().collect();
            // Between the two loops of a lap the yarn has points as in an underlap.
            let next = if needles.len() == 2 { second(&curve, first + LOOP) } else { first };
            for (needle, point) in needles.into_iter().zip([first, next]) {
                let curve = curve[point * PARTS..=(point + LOOP - 1) * PARTS].to_vec();
                loops.push(Loop { needle, course: laid.course as i32, curve });
            }
        }
    }
    loops
}

/// The first control point of the second loop of a lap: the first point after the `end` of the
/// first loop that lies below its neighbours.
fn second(curve: &[DVec3], end: usize) -> usize {
    let y = |point: usize| curve[point * PARTS].y;
    (end..).find(|&point| y(point) < y(point - 1) && y(point) < y(point + 1)).expect("a second loop")
}
