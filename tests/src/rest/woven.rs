//! Starts of weaves, with one point at each crossing, and three more at each change of sides.

use glam::DVec3;

use super::{Ends, Length, Start, StartYarn};

/// The repeat of a weave. Both sets have the same round yarn at the same pitch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weave {
    /// Number of ends and of picks in a repeat.
    pub size: usize,
    /// If an end lies under a pick, the next end lies under the pick that is this many picks
    /// further up.
    pub step: usize,
    /// The number of picks after which an end lies under a pick again.
    pub order: usize,
    /// Distance from yarn to yarn, mm. The diameter is 1 mm.
    pub pitch: f64,
}

impl Weave {
    /// Whether the end lies over the pick.
    fn end_is_up(&self, end: usize, pick: usize) -> bool {
        !(pick + self.order - end * self.step % self.order).is_multiple_of(self.order)
    }
}

/// The radius of all yarns of this file, mm.
const RADIUS: f64 = 0.5;

/// A repeat of `weave`.
///
/// # Panics
///
/// If its size is not a multiple of its order.
#[must_use]
pub fn woven(name: &str, weave: Weave, length: Length) -> Start {
    assert!(weave.size.is_multiple_of(weave.order), "{name} does not repeat");
    let ends = (0..weave.size).map(|end| StartYarn {
        points: points(weave, end, true).collect(),
        radius: RADIUS,
        ends: Ends::Repeats([0, 1]),
    });
    let picks = (0..weave.size).map(|pick| StartYarn {
        points: points(weave, pick, false).collect(),
        radius: RADIUS,
        ends: Ends::Repeats([1, 0]),
    });
    let side = weave.size as f64 * weave.pitch;
    Start {
        name: name.to_owned(),
        yarns: ends.chain(picks).collect(),
        repeat: [side; 2],
        pinned: Vec::new(),
        length,
    }
}

/// The ends and picks of a repeat, cut off. Each begins and ends a pitch beyond its outermost
/// crossings, at their height, and is pinned there.
///
/// # Panics
///
/// If the size is not a multiple of the weave's order, as in [`woven`].
#[must_use]
pub fn woven_piece(name: &str, weave: Weave, length: Length) -> Start {
    let mut start = woven(name, weave, length);
    start.repeat = [0.0; 2];
    for (number, yarn) in start.yarns.iter_mut().enumerate() {
        let along = if number < weave.size { DVec3::Y } else { DVec3::X };
        // A change of sides after the last crossing leads to the next repeat.
        let crossings =
            yarn.points.iter().rposition(|point| point.z.abs() == RADIUS).map_or(0, |last| last + 1);
        yarn.points.truncate(crossings);
        let (first, last) = (yarn.points[0], yarn.points[crossings - 1]);
        yarn.points.insert(0, first - along * weave.pitch);
        yarn.points.push(last + along * weave.pitch);
        yarn.ends = Ends::Open;
        start.pinned.extend([(number, 0), (number, yarn.points.len() - 1)]);
    }
    start
}

/// Control points of an end (or else a pick) from crossing to crossing.
fn points(weave: Weave, number: usize, warp: bool) -> impl Iterator<Item = DVec3> {
    let Weave { size, pitch, .. } = weave;
    let up = move |crossing: usize| {
        let crossing = crossing % size;
        if warp { weave.end_is_up(number, crossing) } else { !weave.end_is_up(crossing, number) }
    };
    let at = move |along: f64, z: f64| {
        let across = (number as f64 + 0.5) * pitch;
        if warp { DVec3::new(across, along, z) } else { DVec3::new(along, across, z) }
    };
    (0..size).flat_map(move |crossing| {
        let (here, along) = (if up(crossing) { 1.0 } else { -1.0 }, (crossing as f64 + 0.5) * pitch);
        let mut points = vec![at(along, here * RADIUS)];
        if up(crossing) != up(crossing + 1) {
            let (offset, shoulder) = (RADIUS.min(pitch / 3.0), here * (RADIUS - 0.075 * 2.0 * RADIUS));
            points.extend([
                at(along + offset, shoulder),
                at(along + pitch / 2.0, 0.0),
                at(along + pitch - offset, -shoulder),
            ]);
        }
        points
    })
}
