//! The part of woven cloth that is measured: whole repeats, so that small and large samples of a
//! cloth have the same numbers.

use std::borrow::Cow;

use texere_core::Yarns;

use super::{Drawdown, Woven};
use crate::FabricError;
use crate::own::Own;

/// A set of at least this many threads is measured as it is. The stretch from a thread's last
/// crossing to its first crossing in the next repeat then changes its crimp by a share of less than
/// 1 / `FEW`. A smaller set that has three repeats or fewer is woven with more repeats, which are
/// measured. With half the value, and with twice, no test is red.
const FEW: usize = 256;

/// Cloth to be measured, with its yarns.
pub(crate) struct Sample<'a> {
    cloth: Cow<'a, Woven>,
    yarns: Cow<'a, Yarns>,
    repeat: [usize; 2],
    middles: [Vec<f64>; 2],
}

impl Woven {
    /// For each set, the number of threads in whole repeats, and the width that these threads take,
    /// mm. After a repeat, threads lie and cross in the same way.
    pub(crate) fn whole(&self) -> [(usize, f64); 2] {
        self.whole_of(self.repeat())
    }

    /// [`Woven::whole`] for repeats after which the weights of the yarns repeat, too.
    pub(crate) fn whole_by_weight(&self) -> [(usize, f64); 2] {
        self.whole_of(self.repeat_by_weight())
    }

    fn whole_of(&self, repeat: [usize; 2]) -> [(usize, f64); 2] {
        let (middles, size) = (self.middles_mm().into_array(), self.size_mm());
        [0, 1].map(|set| {
            let count = middles[set].len();
            let whole = if count < repeat[set] { count } else { count / repeat[set] * repeat[set] };
            let extent = if whole < count { middles[set][whole] - middles[set][0] } else { size[set] };
            (whole, extent)
        })
    }
}

impl<'a> Sample<'a> {
    /// The sample of a cloth and its yarns. A small cloth with yarns as woven, whose weft does not
    /// turn at selvedges, is woven again with more repeats, because the bend of a thread at an edge
    /// depends on floats that are cut off there.
    ///
    /// **Errors**: the errors of [`Woven::new`] and of [`Woven::yarns`].
    pub(crate) fn new(cloth: &'a Woven, yarns: &'a Yarns) -> Result<Self, FabricError> {
        let repeat = cloth.repeat();
        let counts = [cloth.warp().len(), cloth.weft().len()];
        let lacks = |set: usize| counts[set] <= 3 * repeat[set] && counts[set] < FEW;
        if !cloth.selvedge() && (lacks(0) || lacks(1)) && yarns.points() == cloth.yarns()?.points() {
            let more = [0, 1].map(|set| if lacks(set) { 3 * repeat[set] + 1 } else { counts[set] });
            let place = |set: usize, thread: usize| {
                if thread < counts[set] { thread } else { thread % repeat[set] % counts[set] }
            };
            let up = |end, pick| cloth.drawdown().up(place(0, end), place(1, pick));
            let drawdown = Drawdown::from_fn(more[0], more[1], up)?;
            let [warp, weft] = [cloth.warp(), cloth.weft()];
            let warp = (0..more[0]).map(|end| warp[place(0, end)]).collect();
            let weft = (0..more[1]).map(|pick| weft[place(1, pick)]).collect();
            let cloth = cloth.like(drawdown, warp, weft)?;
            let (yarns, middles) =
                (cloth.yarns()?.with_tension(yarns.tension())?, cloth.middles_mm().into_array());
            return Ok(Self { cloth: Cow::Owned(cloth), yarns: Cow::Owned(yarns), repeat, middles });
        }
        Ok(Self {
            middles: cloth.middles_mm().into_array(),
            cloth: Cow::Borrowed(cloth),
            yarns: Cow::Borrowed(yarns),
            repeat,
        })
    }

    /// For each end and each pick, the length of yarn over the length of cloth. The outermost
    /// repeats are left out if other whole repeats remain. If none remains, and for a yarn of
    /// several picks, the whole yarn counts, with its turns at the selvedges.
    pub(crate) fn ratios(&self) -> [Vec<f64>; 2] {
        let threads: Vec<_> = self.cloth.yarns_of_threads().collect();
        let mut passes = vec![0_usize; self.yarns.layout().yarns().len()];
        threads.iter().for_each(|(_, yarn)| passes[*yarn] += 1);
        let size = self.cloth.size_mm();
        let (mut ratios, mut numbers) = ([Vec::new(), Vec::new()], [0, 0]);
        for (set, yarn) in threads {
            let round = if passes[yarn] == 1 { self.round(set, numbers[set], yarn) } else { None };
            let (own, along) = round.unwrap_or_else(|| {
                let count = self.yarns.yarn_points(yarn).map_or(0, <[_]>::len);
                let whole = Own { points: 0..count, onward: None };
                (whole, size[1 - set] * passes[yarn] as f64)
            });
            ratios[set].push(own.length_mm(&self.yarns, yarn) / along);
            numbers[set] += 1;
        }
        ratios
    }

    /// The part of a thread in all repeats but the outermost ones, and the length of this part in
    /// the cloth, mm. None if there are too few repeats.
    fn round(&self, set: usize, thread: usize, yarn: usize) -> Option<(Own, f64)> {
        let (across, repeat) = (&self.middles[1 - set], self.repeat[1 - set]);
        let repeats = (across.len().saturating_sub(1) / repeat).checked_sub(2)? * repeat;
        let ends = self.cloth.warp().len();
        let sources = self.yarns.sources()?.get(self.yarns.range(yarn)?)?;
        let at = |crossed: usize| {
            let source = if set == 0 { crossed * ends + thread } else { thread * ends + crossed };
            sources.iter().position(|own| *own as usize == source)
        };
        let points = at(repeat)?..at(repeat + repeats)?;
        let along = across[repeat + repeats] - across[repeat];
        let onward = if set == 0 { [0.0, along] } else { [along, 0.0] };
        (repeats > 0).then_some((Own { points, onward: Some(onward) }, along))
    }
}
