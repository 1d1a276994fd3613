//! Yarns of a weft knit that hold one another: by loops that are drawn through other loops, by
//! yarns that go from bed to bed past one another, and by floats between two beds.

use std::collections::{HashMap, HashSet};

use texere_core::Origin;

use super::knitted::{Knitted, first_course};
use super::stitches::HALVES;
use super::{Bed, Fate, Step};
use crate::Pieces;
use crate::diagnosis::Joined;

impl Knitted {
    /// The pieces into which the cloth falls, the yarns that nothing holds, and the needles that
    /// never have a loop.
    ///
    /// Two yarns hold one another if a loop of one is drawn through a loop of the other, or if both
    /// go from bed to bed past one another. A yarn without loops is held if it passes between loops
    /// of both beds. A loop that hangs on a needle when the program ends also holds its yarn.
    #[must_use]
    pub fn pieces(&self) -> Pieces {
        let stitches = self.stitches();
        let mut owner = vec![None; stitches.loops.len()];
        let mut joined = Joined::new(stitches.strands.len());
        for (strand, each) in stitches.strands.iter().enumerate() {
            for step in &each.steps {
                if let Step::Loop { number, .. } = step {
                    owner[*number as usize] = Some(strand);
                }
            }
            if let Some([right, up]) = each.onward {
                joined.join(strand, strand, [i64::from(right), i64::from(up)]);
            }
        }
        let half = |at: f32| (at * HALVES as f32).round() as i64;
        let mut needles: HashMap<i64, [Option<usize>; 2]> = HashMap::new();
        for (number, stitch) in (0..).zip(&stitches.loops) {
            let Some(own) = owner[number as usize] else { continue };
            needles.entry(half(stitch.at)).or_default()[usize::from(stitch.bed == Bed::Back)] = Some(own);
            for parent in stitches.parents_of(number) {
                if let Some(through) = owner[parent.number as usize] {
                    joined.hold(own, through, parent.repeat.map(i64::from));
                }
            }
            if stitch.fate == Fate::OnNeedle {
                joined.hold(own, own, [0, 0]);
            }
        }
        let making: HashSet<usize> = owner.iter().flatten().copied().collect();
        for (strand, each) in
            stitches.strands.iter().enumerate().filter(|(strand, _)| !making.contains(strand))
        {
            for step in &each.steps {
                let at = half(stitches.visit(step).at);
                let beside = |bed: usize| (at - 1..=at + 1).find_map(|at| needles.get(&at)?[bed]);
                if let (Some(front), Some(_)) = (beside(0), beside(1)) {
                    joined.hold(strand, front, [0, 0]);
                }
            }
        }
        let (first, last) =
            needles.keys().fold((i64::MAX, i64::MIN), |(low, high), at| (low.min(*at), high.max(*at)));
        let (first, wales) = match stitches.repeat {
            Some([wales, _]) => (0, i64::from(wales)),
            None => (first, last.saturating_sub(first) / HALVES + 1),
        };
        let around = |at: i64| if stitches.repeat.is_some() { at.rem_euclid(wales * HALVES) } else { at };
        let knitting: HashSet<i64> = needles.keys().map(|at| around(*at)).collect();
        // Two ribs whose yarns go from bed to bed past one another can't be taken apart. Interlock
        // is two such ribs.
        let mut crossing: HashMap<i64, (usize, i64)> = HashMap::new();
        for (strand, each) in stitches.strands.iter().enumerate() {
            for pair in each.steps.windows(2) {
                let [one, other] = [&pair[0], &pair[1]].map(|step| stitches.visit(step));
                if one.bed == other.bed || one.number.is_none() || other.number.is_none() {
                    continue;
                }
                let [one, other] = [half(one.at), half(other.at)];
                for between in one.min(other)..one.max(other) {
                    let copy = if stitches.repeat.is_some() { between.div_euclid(wales * HALVES) } else { 0 };
                    let (first, at) = *crossing.entry(around(between)).or_insert((strand, copy));
                    joined.hold(strand, first, [copy - at, 0]);
                }
            }
        }
        // A needle of a bed that is racked by half a pitch stands half a wale further.
        let has =
            |wale: &i64| (0..HALVES).any(|half| knitting.contains(&around(first + wale * HALVES + half)));
        let empty: Vec<u64> = (0..wales).filter(|wale| !has(wale)).map(|wale| wale as u64).collect();
        let origin = |number: usize, _| {
            let strand = &stitches.strands[number];
            match strand.onward {
                Some(_) => Origin::Course(first_course(stitches, strand) + 1),
                None => Origin::Carrier(strand.carrier + 1),
            }
        };
        let wales = u32::try_from(wales).unwrap_or(u32::MAX);
        Pieces::of_knit(&mut joined, self.copies(), origin, &empty, wales)
    }
}
