//! The stitch of a knit that a place on a yarn belongs to.

use texere_core::{YarnPlace, Yarns};

use super::knitted::{Knitted, extent};
use crate::StitchPlace;

impl Knitted {
    /// The stitch at a place on one of the cloth's `yarns`. None if no loop has the source of the
    /// place, as in most floats, and for yarns without sources. A float of a Jacquard chart has the
    /// source of another yarn's loop in the same cell, and the result is the stitch of that loop.
    ///
    /// The source of the place gives the stitch within a repeat. The copy of the repeat is the one
    /// whose stitch lies nearest, by the height of the feet and by the place's x. The search also
    /// works if stitches have moved a little as they settled.
    pub(crate) fn stitch_at(&self, yarns: &Yarns, place: &YarnPlace) -> Option<StitchPlace> {
        let source = place.source?;
        let (stitches, gauge) = (self.stitches(), self.gauge());
        let left = if stitches.repeat.is_some() { 0.0 } else { f64::from(extent(stitches).0) };
        let (wale, course) =
            (place.position[0] / gauge.wale_mm - 0.5, self.feet(yarns, place)? / gauge.course_mm);
        let repeat = stitches.repeat.map(|size| size.map(f64::from));
        // Coordinate, along one axis, of the copy of a stitch that lies nearest to `near`.
        let copy = |own: f64, axis: usize, near: f64| match repeat {
            Some(size) => {
                let copies = f64::from(self.size()[axis]) / size[axis];
                own + size[axis] * ((near - own) / size[axis]).round().clamp(0.0, copies - 1.0)
            }
            None => own,
        };
        let own = stitches.loops.iter().filter(|stitch| stitch.source == source);
        let copies = own.map(|stitch| {
            let at = [f64::from(stitch.at) - left, f64::from(stitch.course)];
            [copy(at[0], 0, wale), copy(at[1], 1, course)]
        });
        let off = |[x, y]: [f64; 2]| (x - wale).hypot(y - course);
        let [wale, course] = copies.min_by(|one, other| off(*one).total_cmp(&off(*other)))?;
        Some(StitchPlace { wale: wale.round().max(0.0) as u32 + 1, course: course as u32 + 1 })
    }

    /// Height of the feet of the stitch at a place, mm. It is the y of the lowest of the control
    /// points around the place that have the same source.
    fn feet(&self, yarns: &Yarns, place: &YarnPlace) -> Option<f64> {
        let (points, range) = (yarns.yarn_points(place.yarn)?, yarns.range(place.yarn)?);
        let sources = yarns.sources()?.get(range)?;
        let own = |&number: &usize| sources.get(number).copied() == place.source;
        let at = if own(&place.interval) { place.interval } else { place.interval + 1 };
        let after = (at..points.len()).take_while(own);
        let before = (0..at).rev().take_while(own);
        before.chain(after).map(|number| f64::from(points[number].y)).min_by(f64::total_cmp)
    }
}
