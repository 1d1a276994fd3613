//! The weft's turns round the edge ends of cloth at rest.
//!
//! Seen from the face, a turn is about a half circle from one pick to the next. If picks lie so
//! close together that their yarn is too wide for that, the yarn becomes rounder in the turn, where
//! nothing presses it. If a round yarn has no room, either, the turn is a bulb: the yarn first
//! bends away from the next pick, then round by more than half a circle, and back. The curvature of
//! all bends grows and fades over several control points, because a spline swings out where
//! curvature jumps.

use std::array;
use std::f64::consts::{FRAC_PI_2, PI};

use texere_core::RADIUS_MIN;

use super::path::Station;
use super::stop::Stop;

/// Number of control points of a turn.
pub(super) const TURN_POINTS: usize = WAYS + 3;

/// Number of straight ways from point to point in the bends. With eight, the tightest bend of the
/// spline has 0.43 to 0.76 of the radius that is meant, with twelve 0.71 to 0.8, with sixteen 0.74
/// to 0.81. With eight `turns_do_not_fold` fails.
const BENDS: usize = 12;

/// Number of straight ways from point to point beside the bends, on each side. The bends are
/// smoothed into them. With half the value, `turns_do_not_fold` is red; with twice,
/// `turns_of_uneven_picks_do_not_touch`.
const BESIDE: usize = 2;

/// Number of straight ways of equal length in a turn.
const WAYS: usize = BENDS + 2 * BESIDE;

/// The number of times that each way's direction is averaged with those of its neighbours. Without
/// any, `turns_do_not_fold` fails; with one, the tightest bend has 0.57 of the radius or more.
const SMOOTHINGS: usize = 2;

/// The radius of the bends before they are smoothed, as a multiple of the yarn's half width. The
/// spline's tightest bend has 0.71 of this radius or more, whatever the distance of picks. With
/// 1.35, the bends of the tested cloths are wide enough, too, but with less to spare. With 1.2,
/// `turns_do_not_fold` fails.
const WIDE: f64 = 1.45;

/// The largest distance of the yarn's middle from the middle between both picks, as a multiple of
/// the radius. It is more than 1, because the bends are smoothed. With half its difference to 1,
/// and with twice, no test is red.
const SWUNG: f64 = 1.03;

/// Number of halvings in the search for an angle.
const HALVINGS: usize = 40;

/// A turn from one pick to the next, at an edge of the cloth.
pub(super) struct Turn {
    /// Both picks at the edge end.
    picks: [Station; 2],
    /// 1 at the right edge, -1 at the left.
    outwards: f64,
    /// Where the first way begins and the last one ends, mm.
    edge: f64,
    /// The angle of each way to the direction outwards, radians.
    directions: [f64; WAYS],
    /// The length of a way, mm.
    way: f64,
    /// Half widths of the yarn where the turn begins and where it ends, mm.
    half_widths: [f64; 2],
}

impl Turn {
    /// The turn from one pick to the next, which lies at a larger `across`. `outwards` is 1 at the
    /// right edge and -1 at the left. `room` is the distance from the middle between both picks
    /// that the yarn may reach, mm.
    pub(super) fn new(picks: [Station; 2], outwards: f64, room: f64) -> Self {
        let [from, to] = &picks;
        let apart = (to.across - from.across).max(0.0);
        // The radius of a turn that nowhere bends away from the next pick.
        let least = apart / apart_at(0.0);
        let half_widths = picks.each_ref().map(|pick| {
            let round = (pick.drawn[0] * pick.drawn[1]).sqrt();
            (least / WIDE).max(round).min(pick.drawn[0])
        });
        let wanted = WIDE * half_widths[0].max(half_widths[1]);
        let radius = least.max(wanted.min(room / (SWUNG + 1.0 / WIDE)));
        let away = if radius > least { away(apart / radius) } else { 0.0 };
        let way = radius * (PI + 4.0 * away) / BENDS as f64;
        let end = if outwards > 0.0 { from.at.max(to.at) } else { from.at.min(to.at) };
        let touching = from.crossed[0].max(to.crossed[0]) + from.drawn[0].max(to.drawn[0]);
        Self {
            outwards,
            edge: end + outwards * (touching - BESIDE as f64 * way).max(2.0 * way),
            directions: directions(away),
            way,
            half_widths: half_widths.map(|half_width| half_width.min(radius / WIDE)),
            picks,
        }
    }

    /// The control points between the two picks.
    pub(super) fn stops(&self) -> impl Iterator<Item = Stop> {
        let mut place = [self.edge, self.picks[0].across];
        let bends: [Stop; WAYS + 1] = array::from_fn(|point| {
            if let Some(before) = point.checked_sub(1) {
                let (s, c) = self.directions[before].sin_cos();
                place = [place[0] + self.outwards * self.way * c, place[1] + self.way * s];
            }
            self.stop(place, point as f64 / WAYS as f64)
        });
        let beside = [(0, &bends[0]), (1, &bends[WAYS])].map(|(pick, bend)| {
            let pick = self.picks[pick].stop();
            pick.towards(bend, f64::midpoint(pick.along, bend.along))
        });
        std::iter::once(beside[0]).chain(bends).chain([beside[1]])
    }

    /// The control point at `place`, along and across the picks, mm. `gone` is the share of the way
    /// from the first pick to the second.
    fn stop(&self, place: [f64; 2], gone: f64) -> Stop {
        let [from, to] = &self.picks;
        let done = (FRAC_PI_2 * gone).sin().powi(2);
        let mix = |from: f64, to: f64| from + done * (to - from);
        let area = mix(from.drawn[0] * from.drawn[1], to.drawn[0] * to.drawn[1]);
        let half_width = mix(self.half_widths[0], self.half_widths[1]);
        Stop {
            along: place[0],
            across: place[1],
            z: mix(from.z, to.z),
            halves: [half_width, (area / half_width).max(f64::from(RADIUS_MIN))],
            crossing: None,
        }
    }
}

/// The directions of all ways of a turn, radians. The yarn first bends away from the next pick by
/// the angle `away`.
fn directions(away: f64) -> [f64; WAYS] {
    let whole = PI + 4.0 * away;
    let mut directions = array::from_fn(|way| {
        let bent = (way as f64 + 0.5 - BESIDE as f64) / BENDS as f64 * whole;
        if bent < 0.0 {
            0.0
        } else if bent < away {
            -bent
        } else if bent < whole - away {
            bent - 2.0 * away
        } else if bent < whole {
            PI + whole - bent
        } else {
            PI
        }
    });
    for _ in 0..SMOOTHINGS {
        let now: [f64; WAYS] = directions;
        directions = array::from_fn(|way| {
            let before = way.checked_sub(1).map_or(0.0, |before| now[before]);
            let after = now.get(way + 1).map_or(PI, |after| *after);
            (before + 2.0 * now[way] + after) / 4.0
        });
    }
    directions
}

/// The distance from the beginning of a turn to its end, as a multiple of the radius of its bends.
/// The yarn first bends away by the angle `away`, radians.
fn apart_at(away: f64) -> f64 {
    let across: f64 = directions(away).iter().map(|direction| direction.sin()).sum();
    across * (PI + 4.0 * away) / BENDS as f64
}

/// The angle by which the yarn first has to bend away, radians, so that the turn ends at this
/// distance from its beginning. `apart` is a multiple of the radius of the bends.
fn away(apart: f64) -> f64 {
    let [mut low, mut high] = [0.0, FRAC_PI_2];
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(low, high);
        if apart_at(middle) > apart { low = middle } else { high = middle }
    }
    low
}
