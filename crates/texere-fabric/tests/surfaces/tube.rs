//! The surface of a yarn between its rings, and how far sections have to grow to reach a point.

use std::f64::consts::TAU;
use std::ops::RangeInclusive;
use std::rc::Rc;

use glam::{DVec2, DVec3};
use texere_core::definitions::Ring;

use crate::outline::Outline;

/// A ring of a yarn, in f64.
struct Station {
    centre: DVec3,
    tangent: DVec3,
    halves: DVec2,
    roll: f64,
}

/// The tube of one yarn.
pub(crate) struct Tube {
    stations: Vec<Station>,
    pub(crate) outline: Rc<Outline>,
    /// The largest distance of the tube's surface from its centreline, mm.
    pub(crate) reach: f64,
    /// The largest distance from a ring to the next, mm.
    stride: f64,
}

/// The frame of a section at one place of a yarn.
pub(crate) struct Stance {
    pub(crate) centre: DVec3,
    side: DVec3,
    up: DVec3,
    halves: DVec2,
    turned: DVec2,
}

impl Stance {
    /// The vector from the centre to the surface, for a point of the outline.
    pub(crate) fn outward(&self, point: DVec2) -> DVec3 {
        let turned = self.turned.rotate(point) * self.halves;
        self.side * turned.x + self.up * turned.y
    }

    /// The point in the section's plane that `outward` takes to `offset`.
    fn within(&self, offset: DVec3) -> DVec2 {
        let turned = DVec2::new(offset.dot(self.side), offset.dot(self.up)) / self.halves;
        DVec2::new(self.turned.x, -self.turned.y).rotate(turned)
    }
}

impl Tube {
    pub(crate) fn new(rings: &[Ring], outline: Rc<Outline>) -> Self {
        let wide = |vector: [f32; 3]| DVec3::from_array(vector.map(f64::from));
        let station = |ring: &Ring| Station {
            centre: wide(ring.centre),
            tangent: wide(ring.tangent),
            halves: DVec2::new(ring.half_width.into(), ring.half_height.into()),
            roll: ring.roll.radians(),
        };
        let stations: Vec<_> = rings.iter().map(station).collect();
        let most = |lengths: &mut dyn Iterator<Item = f64>| lengths.fold(0.0, f64::max);
        let reach = outline.greatest * most(&mut stations.iter().map(|ring| ring.halves.max_element()));
        let stride = most(&mut stations.windows(2).map(|two| two[0].centre.distance(two[1].centre)));
        Self { stations, outline, reach, stride }
    }

    /// Number of rings.
    pub(crate) fn rings(&self) -> usize {
        self.stations.len()
    }

    /// The centre between ring `ring` and the next one, on the cubic through both with their
    /// tangents.
    fn centre(&self, ring: usize, share: f64) -> DVec3 {
        let (from, to) = (&self.stations[ring], &self.stations[ring + 1]);
        let chord = to.centre - from.centre;
        let length = chord.length();
        let (leave, arrive) = (from.tangent * length - chord, to.tangent * length - chord);
        let (left, gone) = (1.0 - share, share);
        from.centre + chord * gone + leave * (gone * left * left) - arrive * (gone * gone * left)
    }

    /// The frame of the section at `centre`, which lies `share` of the way from ring `ring` to the
    /// next.
    fn stance_at(&self, ring: usize, share: f64, centre: DVec3) -> Stance {
        let (from, to) = (&self.stations[ring], &self.stations[ring + 1]);
        let tangent = from.tangent.lerp(to.tangent, share).normalize();
        let halves = from.halves.lerp(to.halves, share);
        let turns = (to.roll - from.roll) / TAU;
        let roll = from.roll + share * (turns - turns.round()) * TAU;
        // A vertical tangent would have no side. The one yarn of these tests that passes through
        // the vertical does so between two rings.
        let side = DVec3::Z.cross(tangent).normalize();
        Stance { centre, side, up: tangent.cross(side), halves, turned: DVec2::from_angle(roll) }
    }

    /// The frame of the section at `at`, counted in rings.
    pub(crate) fn stance(&self, at: f64) -> Stance {
        let ring = (at as usize).min(self.rings() - 2);
        let share = at - ring as f64;
        self.stance_at(ring, share, self.centre(ring, share))
    }

    /// Stretches of rings within `distance` of `point`, with one more ring at both ends.
    pub(crate) fn near(&self, point: DVec3, distance: f64) -> Vec<RangeInclusive<usize>> {
        let mut stretches: Vec<RangeInclusive<usize>> = Vec::new();
        let mut ring = 0;
        while let Some(station) = self.stations.get(ring) {
            let beyond = station.centre.distance(point) - distance;
            if beyond > 0.0 {
                ring += (beyond / self.stride).floor().max(1.0) as usize;
                continue;
            }
            let (first, last) = (ring.saturating_sub(1), (ring + 1).min(self.rings() - 1));
            match stretches.last_mut() {
                Some(stretch) if *stretch.end() >= first => *stretch = *stretch.start()..=last,
                _ => stretches.push(first..=last),
            }
            ring += 1;
        }
        stretches
    }

    /// The factor by which sections in `stretch` have to grow to reach `point`. A factor of at most
    /// `most` is exact. A larger one may be given too small, but is still above `most`. Beyond the
    /// stretch's ends the factor is infinite. The search starts at `ring`, which becomes the ring
    /// of the result.
    ///
    /// No bend is so tight that the point lies between more than one pair of rings.
    pub(crate) fn gauge(
        &self,
        point: DVec3,
        stretch: &RangeInclusive<usize>,
        ring: &mut usize,
        most: f64,
    ) -> f64 {
        let ahead = |ring: usize| (point - self.stations[ring].centre).dot(self.stations[ring].tangent);
        while ahead(*ring) < 0.0 {
            if *ring == *stretch.start() {
                return f64::INFINITY;
            }
            *ring -= 1;
        }
        while ahead(*ring + 1) >= 0.0 {
            if *ring + 2 > *stretch.end() {
                return f64::INFINITY;
            }
            *ring += 1;
        }
        let (behind, before) = (ahead(*ring), ahead(*ring + 1));
        let share = behind / (behind - before);
        let centre = self.centre(*ring, share);
        let least = point.distance(centre) / self.reach;
        if least > most {
            return least;
        }
        let stance = self.stance_at(*ring, share, centre);
        self.outline.gauge(stance.within(point - centre))
    }
}
