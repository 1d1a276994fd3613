//! Places that hold more yarn than fits there, or more parts of yarns than are compared.

use std::cmp::Ordering;

use texere_core::YarnPlace;

use super::part::Part;
use crate::grid::Bounds;

/// A place that is not measured because its yarns lie in one another many times over.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crowd {
    /// The place on the thickest yarn there that is nearest to the middle of the crowd's box.
    pub place: YarnPlace,
    /// Thickness of that yarn, mm: its diameter, or the larger of width and height.
    pub thickness_mm: f64,
    /// Number of control intervals there.
    pub intervals: usize,
    /// The volume of the yarns over that of the box that holds them. Above 1 they must pierce one
    /// another or fold, and the least [ratio](crate::Contact::ratio) there is 1/√fill at most. If
    /// it is 1 or less, only the number of intervals is too high (see
    /// [`CLEARANCE_BESIDE`](crate::CLEARANCE_BESIDE)): control points lie much closer than the
    /// yarns are thick, or very long intervals lie side by side.
    pub fill: f64,
}

impl Crowd {
    /// The crowd that `parts` make, or none without parts. `place` makes a place of a part.
    pub(super) fn of<'p, 'a: 'p>(
        parts: &'p [Part<'a>],
        place: impl FnOnce(&'p Part<'a>) -> YarnPlace,
    ) -> Option<Self> {
        let mut room = Bounds::NOTHING;
        let mut volume = 0.0;
        let mut thickest: f64 = 0.0;
        for part in parts {
            let line = &part.line;
            let cubic = line.cubic(part.point);
            room = room.joined(line.bounds(part.point, 1.0));
            // A lower bound of the interval's volume: the interval is no shorter than its chord,
            // and nowhere thinner than these half sizes.
            let [width, height] = std::array::from_fn(|side| {
                let bounds = cubic.half_bounds()[side];
                bounds.into_iter().fold(f64::INFINITY, f64::min).max(cubic.floors()[side])
            });
            let chord = cubic.position(0.0).distance(cubic.position(1.0));
            volume += line.support.area() * width * height * chord;
            thickest = thickest.max(cubic.at(0.0).sizes().max_element());
        }
        let size = (room.high - room.low).as_dvec3();
        let middle = ((room.high + room.low) / 2.0).as_dvec3();
        let off_middle = |part: &Part<'_>| {
            let start = part.line.cubic(part.point).at(0.0);
            (start.sizes().max_element() == thickest).then(|| start.position.distance_squared(middle))
        };
        let nearest = parts
            .iter()
            .filter_map(|part| Some((part, off_middle(part)?)))
            .min_by(|one, other| one.1.total_cmp(&other.1));
        nearest.map(|(part, _)| Self {
            place: place(part),
            thickness_mm: 2.0 * thickest,
            intervals: parts.len(),
            fill: volume / size.element_product(),
        })
    }

    /// Upper bound of the least ratio in the crowd, infinite if no bound is known.
    pub(super) fn ratio_max(&self) -> f64 {
        if self.fill > 1.0 { self.fill.sqrt().recip() } else { f64::INFINITY }
    }

    /// The more crowded of two. If both are equally crowded, the first along the yarns counts.
    pub(super) fn worse(self, other: Self) -> Self {
        let place = |crowd: &Self| (crowd.place.yarn, crowd.place.interval);
        let order = self.fill.total_cmp(&other.fill).then(self.intervals.cmp(&other.intervals));
        if order.then_with(|| place(&other).cmp(&place(&self))) == Ordering::Less { other } else { self }
    }
}
