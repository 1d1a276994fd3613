//! Yarns of a warp knit that hold one another: by loops drawn through those of the course below,
//! and by yarns laid in between.

use texere_core::Origin;

use super::laps::laps;
use super::{LapKind, PlacedLap, WarpKnitted};
use crate::Pieces;
use crate::diagnosis::Joined;

/// A loop: the number of its guide among all guides of the repeat, and the number of repeats by
/// which its needle lies to the right of the repeat that the guide belongs to.
type Loop = (usize, i64);

impl WarpKnitted {
    /// The pieces into which the cloth falls, the yarns that nothing holds, and the needles that
    /// never have a loop.
    ///
    /// A loop is held if a loop of the next course is drawn through it on the same needle. A needle
    /// that gets no yarn at a course casts off its loops. An underlap or an inlay is held where it
    /// passes between the loops of a bar further forward and the yarn which that bar lays from
    /// course to course.
    #[must_use]
    pub fn pieces(&self) -> Pieces {
        let [wales, courses] = self.repeat_size();
        let placed: Vec<PlacedLap> = laps(self.bars(), wales, courses).collect();
        let guides: Vec<&[PlacedLap]> = placed.chunks(courses as usize).collect();
        let needle =
            |number: i32| (number.rem_euclid(wales as i32), i64::from(number.div_euclid(wales as i32)));
        let place =
            |needle: i32, course: usize| needle as usize * courses as usize + course % courses as usize;
        let mut hanging: Vec<Vec<Loop>> = vec![Vec::new(); wales as usize * courses as usize];
        for (guide, laps) in guides.iter().enumerate() {
            for lap in *laps {
                for (own, copy) in lap.lap.needles().map(needle) {
                    hanging[place(own, lap.course as usize)].push((guide, copy));
                }
            }
        }
        let mut joined = Joined::new(guides.len());
        let mut hold = |(one, at): Loop, (other, there): Loop| joined.hold(one, other, [at - there, 0]);
        for own in 0..wales as i32 {
            for course in 0..courses as usize {
                let [below, above] = [course, course + 1].map(|course| &hanging[place(own, course)]);
                if let ([first, ..], [next, ..]) = (&below[..], &above[..]) {
                    above.iter().for_each(|drawn| hold(*first, *drawn));
                    below.iter().for_each(|through| hold(*through, *next));
                }
            }
        }
        // Bars come in order from the front. The first yarn found to pass a space is therefore the
        // foremost one.
        let mut behind: Vec<Option<Loop>> = vec![None; hanging.len()];
        for (guide, laps) in guides.iter().enumerate() {
            for (lap, next) in laps.iter().zip(laps.iter().cycle().skip(1)) {
                for (own, copy) in spaces(lap, next).map(needle) {
                    behind[place(own, lap.course as usize)].get_or_insert((guide, copy));
                }
            }
        }
        for (guide, laps) in guides.iter().enumerate() {
            for (lap, next) in laps.iter().zip(laps.iter().cycle().skip(1)) {
                for (own, copy) in crossed(lap, next).map(needle) {
                    let before = hanging[place(own, lap.course as usize)].iter();
                    let before = before.filter(|(other, _)| guides[*other][0].bar < lap.bar);
                    before.for_each(|other| hold((guide, copy), *other));
                }
                let (own, copy) = needle(lap.lap.to);
                if lap.kind() == LapKind::Inlay
                    && let Some(foremost) = behind[place(own, lap.course as usize)]
                    && guides[foremost.0][0].bar < lap.bar
                {
                    hold((guide, copy), foremost);
                }
            }
        }
        let empty = (0..wales as i32)
            .filter(|own| (0..courses as usize).all(|course| hanging[place(*own, course)].is_empty()));
        let empty: Vec<u64> = empty.map(|own| own as u64).collect();
        let origin = |number: usize, copy: u32| {
            let PlacedLap { bar, guide, .. } = guides[number][0];
            Origin::Guide { bar: bar + 1, guide: guide + 1 + copy * wales }
        };
        let copies = [0, 1].map(|axis| self.size()[axis] / self.repeat_size()[axis]);
        // A guide's yarn goes through all courses.
        Pieces::of_knit(&mut joined, [copies[0], 1], origin, &empty, wales)
    }
}

/// The needles that a yarn crosses on its way to its next lap, except the needles of its own loops.
fn crossed(lap: &PlacedLap, next: &PlacedLap) -> std::ops::Range<i32> {
    let [from, to] = [lap.lap.to, lap.lap.to + lap.underlap];
    let [low, high] = [from.min(to), from.max(to)];
    let own = |needle: i32| lap.lap.needles().chain(next.lap.needles()).any(|own| own == needle);
    low + i32::from(low < high && own(low))..high - i32::from(low < high && own(high - 1))
}

/// The spaces that a yarn passes behind the needles on its way from a loop to the next one. Space n
/// lies between the needles n - 1 and n.
fn spaces(lap: &PlacedLap, next: &PlacedLap) -> std::ops::Range<i32> {
    let [one, other] = [lap, next].map(|lap| lap.lap.needle());
    if lap.kind() == LapKind::Inlay || next.kind() == LapKind::Inlay {
        return 0..0;
    }
    one.min(other) + 1..one.max(other) + 1
}
