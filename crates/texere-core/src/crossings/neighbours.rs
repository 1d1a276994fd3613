//! How the threads of a crossing lie among the threads of their sets.

use super::level::LEVELS_MAX;
use super::rows::further;
use super::{Crossings, CrossingsError, Level, Set, Site};
use crate::backend::room;

/// The largest distance, in threads, at which threads of one level count as neighbours.
pub const BESIDE_MAX: usize = 16;

/// How the two threads of a crossing lie among the threads of their sets.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Neighbours {
    /// The levels of the end and of the pick.
    pub levels: [Level; 2],
    /// The distances, in threads, from the end to the nearest ends before and after it that lie on
    /// its level at this pick, and from the pick to the nearest picks on its level at this end. A
    /// distance is 0 if there is no such thread within 16 threads.
    pub beside: [[u8; 2]; 2],
}

impl Neighbours {
    /// Whether the end and the pick belong to different layers of the cloth. If warp and weft have
    /// the same number of levels here, each level is a layer. Otherwise there are no layers.
    #[must_use]
    pub const fn are_apart(&self) -> bool {
        self.is_layered() && self.levels[0].number != self.levels[1].number
    }

    /// Whether the end and the pick belong to one layer of the cloth. They then touch, whether they
    /// bend round one another or float.
    #[must_use]
    pub const fn touch(&self) -> bool {
        self.is_layered() && self.levels[0].number == self.levels[1].number
    }

    const fn is_layered(&self) -> bool {
        let [warp, weft] = self.levels;
        warp.of == weft.of && warp.of > 0
    }
}

/// The neighbours at each crossing of a problem.
pub(super) fn neighbours(problem: &Crossings) -> Result<Vec<Neighbours>, CrossingsError> {
    let [ends, picks] = [0, 1].map(|set| problem.threads[set].len());
    for (set, levels) in ["warp", "weft"].into_iter().zip(&problem.levels) {
        if ![0, ends * picks].contains(&levels.len()) {
            return Err(CrossingsError::Levels { set, levels: levels.len(), crossings: ends * picks });
        }
        if let Some(at) = levels.iter().position(|level| !level.is_known()) {
            let (Level { number, of }, [end, pick]) = (levels[at], [at % ends, at / ends]);
            return Err(CrossingsError::Level { set, end, pick, number, of, most: LEVELS_MAX });
        }
    }
    let level = |set: Set, site: Site| {
        problem.levels[set as usize].get(site.pick * ends + site.end).copied().unwrap_or(Level::SINGLE)
    };
    let mut all = room("neighbours", ends * picks)?;
    for number in 0..ends * picks {
        let site = Site { end: number % ends, pick: number / ends };
        let beside = |set: Set, forwards: i32| {
            let (count, repeats) = ([ends, picks][set as usize], problem.repeats[set as usize]);
            let is_level = |steps: &u8| {
                let other = further(site.thread(set), forwards * i32::from(*steps), count, repeats);
                other.is_some_and(|other| level(set, site.with(set, other)) == level(set, site))
            };
            (1..=BESIDE_MAX.min(count) as u8).find(is_level).unwrap_or(0)
        };
        all.push(Neighbours {
            levels: Set::BOTH.map(|set| level(set, site)),
            beside: Set::BOTH.map(|set| [beside(set, -1), beside(set, 1)]),
        });
    }
    Ok(all)
}
