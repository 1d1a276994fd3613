//! The problem that texere-core settles: the crossings of a cloth's smallest repeat.

use std::collections::HashMap;
use std::hash::Hash;

use texere_core::crossings::{self, Crossings, Level};

use super::super::thread::pitches;
use crate::reach::Reach;
use crate::{BySet, Drawdown, Thread, Woven};

/// The part of a cloth that comes to rest: the ends and picks after which its threads and crossings
/// repeat. A cloth that does not repeat is its own repeat. In the problem the last threads of the
/// repeat lie beside the first ones, so that something holds its edges.
pub(super) struct Problem {
    pub(super) repeat: [usize; 2],
    pub(super) crossings: Crossings,
    /// Half width and half height of each thread's room, as multiples of the thread's half width
    /// and half height.
    pub(super) rooms: [Vec<[f32; 2]>; 2],
    /// The least area of each thread's section, as a share of its area.
    pub(super) least: [Vec<f32>; 2],
}

/// The area that sections keep while crossings settle, as a multiple of their least area. The
/// hundredth above the least area is left for clearance of the surfaces as they are drawn. 0.98 to
/// 1.03 were tried. With 1 and with 1.02, denim ends a hundredth short of its clearance
/// (`cloths_of_the_mills_come_to_rest`).
const RESERVE: f32 = 1.01;

/// The fewest threads of either set in a problem.
const THREADS_MIN: usize = 2;

impl Problem {
    pub(super) fn new(cloth: &Woven) -> Self {
        let rooms = rooms(cloth);
        let (drawdown, [ends, picks]) = (cloth.drawdown(), [cloth.warp().len(), cloth.weft().len()]);
        let repeat = cloth.repeat();
        let [across, along] = repeat;
        let ups =
            (0..across * along).map(|number| drawdown.up(number % across % ends, number / across % picks));
        let [warp, weft] = [cloth.warp(), cloth.weft()].map(gaps);
        let [warp_levels, weft_levels] = cloth.levels(repeat);
        let threads = |set: usize, threads: &[Thread], gaps: &[f64]| {
            let rooms: &[[f32; 2]] = &rooms[set];
            let thread = |number: usize| {
                let [width, height] = rooms[number % threads.len()];
                crossings::CrossingThread {
                    pitch: gaps[number % threads.len()] as f32,
                    diameter: 2.0 * threads[number % threads.len()].radius_mm * (width * height).sqrt(),
                    stiffness: threads[number % threads.len()].stiffness,
                    firmness: threads[number % threads.len()].firmness,
                    flatness: threads[number % threads.len()].flatness,
                    least_area: (RESERVE * threads[number % threads.len()].least_area).min(1.0),
                }
            };
            (0..repeat[set]).map(thread).collect()
        };
        let crossings =
            Crossings::new(ups.collect(), threads(0, cloth.warp(), &warp), threads(1, cloth.weft(), &weft))
                .levels(warp_levels, weft_levels);
        let least = [0, 1].map(|set: usize| {
            let threads = [cloth.warp(), cloth.weft()][set];
            (0..repeat[set]).map(|number| threads[number % threads.len()].least_area).collect()
        });
        Self { repeat, crossings, rooms, least }
    }
}

/// Half width and half height of the room that each thread's section takes, as multiples of the
/// thread's half width and half height.
pub(super) fn rooms(cloth: &Woven) -> [Vec<[f32; 2]>; 2] {
    let reaches: Vec<Reach> = cloth.sections().iter().map(Reach::new).collect();
    [cloth.warp(), cloth.weft()].map(|threads| {
        let room = |thread: &Thread| reaches[thread.section as usize].room(thread.twist);
        threads.iter().map(room).collect()
    })
}

impl Woven {
    /// The numbers of levels on which the ends and the picks lie ([`Drawdown::levels`]). Binders
    /// don't count.
    ///
    /// ```
    /// use texere_core::{Material, Section};
    /// use texere_fabric::{BySet, Thread, Weave, Woven};
    /// let threads = vec![Thread::new(0.5, 0.12); 16];
    /// let twill = Weave::parse("2/2")?.drawdown(16, 16)?;
    /// let cloth = Woven::new(twill, threads.clone(), threads, vec![Material::default()], vec![Section::Circle])?;
    /// assert_eq!(cloth.level_counts(), BySet { warp: 1, weft: 1 });
    /// # Ok::<(), texere_fabric::FabricError>(())
    /// ```
    #[must_use]
    pub fn level_counts(&self) -> BySet<u8> {
        let most = |levels: Vec<Level>| levels.into_iter().map(|level| level.of).fold(1, u8::max);
        BySet::of(self.levels(self.repeat()).map(most))
    }

    /// Levels at the crossings of the first `across` ends and the first `along` picks, which are a
    /// repeat of the cloth.
    pub(in crate::woven) fn levels(&self, [across, along]: [usize; 2]) -> [Vec<Level>; 2] {
        let (ends, picks) = (self.warp().len(), self.weft().len());
        Drawdown::from_fn(across, along, |end, pick| self.drawdown().up(end % ends, pick % picks))
            .map_or_else(
                |_| [0; 2].map(|_| vec![Level::SINGLE; across * along]),
                |repeat| repeat.levels().into_array(),
            )
    }

    /// Numbers of ends and picks after which threads lie and cross as before. Each number is at
    /// least two. If nothing repeats, it is the number of all threads of the set.
    pub(crate) fn repeat(&self) -> [usize; 2] {
        self.period_of(|_| None::<u32>)
    }

    /// Numbers of ends and picks that are left once whole repeats are cut out of the cloth, with
    /// both edges as they are. At least `fewest` are left, if the cloth has them.
    pub(crate) fn cropped(&self, repeat: [usize; 2], fewest: [usize; 2]) -> [usize; 2] {
        let counts = [self.warp().len(), self.weft().len()];
        [0, 1].map(|set| counts[set] - counts[set].saturating_sub(fewest[set]) / repeat[set] * repeat[set])
    }

    /// Numbers of ends and picks after which threads also weigh the same. A pattern of yarns may be
    /// longer than the weave's repeat.
    pub(in crate::woven) fn repeat_by_weight(&self) -> [usize; 2] {
        self.period_of(|thread| self.materials()[thread.material as usize].tex.map(f32::to_bits))
    }

    /// Numbers of ends and picks after which threads are also of the same materials and twist. A
    /// pattern of colours may be longer than the weave's repeat.
    pub(in crate::woven) fn repeat_by_look(&self) -> [usize; 2] {
        let twist = |thread: &Thread| u64::from(thread.twist.to_bits());
        self.period_of(|thread| Some(u64::from(thread.material) << 32 | twist(thread)))
    }

    /// Numbers of ends and picks after which threads are alike in what `also` says of them, too.
    fn period_of<T: Hash + Eq>(&self, also: impl Fn(&Thread) -> Option<T>) -> [usize; 2] {
        let (rooms, drawdown) = (rooms(self), self.drawdown());
        let [ends, picks] = [self.warp().len(), self.weft().len()];
        [
            period(&kinds(self.warp(), &rooms[0], &also, |end| bits(picks, |pick| drawdown.up(end, pick)))),
            period(&kinds(self.weft(), &rooms[1], &also, |pick| bits(ends, |end| drawdown.up(end, pick)))),
        ]
    }
}

/// Distance from each thread to the next one, mm. For the last thread it is the distance to the
/// first thread of an equal cloth beside this one.
pub(super) fn gaps(threads: &[Thread]) -> Vec<f64> {
    let ends = [threads.first(), threads.last()].into_iter().flatten();
    let seam = ends.map(|thread| thread.spacing_mm / 2.0).sum();
    pitches(threads).chain([seam]).collect()
}

/// A number for each thread. Threads that are alike and cross alike have the same number.
fn kinds<T: Hash + Eq>(
    threads: &[Thread],
    rooms: &[[f32; 2]],
    also: impl Fn(&Thread) -> Option<T>,
    sides: impl Fn(usize) -> Vec<u64>,
) -> Vec<usize> {
    let mut known = HashMap::new();
    let kind = |number: usize| {
        let Thread { spacing_mm, radius_mm, flatness, stiffness, firmness, least_area, .. } = threads[number];
        let [width, height] = rooms[number];
        let sizes = [radius_mm, flatness, stiffness, firmness, least_area, width, height].map(f32::to_bits);
        (sizes, (spacing_mm as f32).to_bits(), also(&threads[number]), sides(number))
    };
    (0..threads.len())
        .map(|number| {
            let next = known.len();
            *known.entry(kind(number)).or_insert(next)
        })
        .collect()
}

fn bits(count: usize, up: impl Fn(usize) -> bool) -> Vec<u64> {
    let word = |first: usize| {
        (first..count.min(first + 64)).fold(0, |word, bit| word | u64::from(up(bit)) << (bit - first))
    };
    (0..count).step_by(64).map(word).collect()
}

/// Number of threads after which the list repeats, from the longest beginning of the list that is
/// also its end (Knuth, Morris and Pratt).
fn period(kinds: &[usize]) -> usize {
    let mut borders = vec![0; kinds.len()];
    for at in 1..kinds.len() {
        let mut border = borders[at - 1];
        while border > 0 && kinds[at] != kinds[border] {
            border = borders[border - 1];
        }
        borders[at] = border + usize::from(kinds[at] == kinds[border]);
    }
    let period = kinds.len() - borders.last().copied().unwrap_or(0);
    period.max(THREADS_MIN)
}

#[cfg(test)]
mod tests {
    use super::period;

    #[test]
    fn a_period_is_the_least_shift_that_fits() {
        assert_eq!(period(&[0, 1, 2, 0, 1, 2, 0]), 3);
        assert_eq!(period(&[0, 1, 2, 3]), 4);
        // One thread would be its own neighbour on both sides, so it counts twice.
        assert_eq!(period(&[0, 0, 0]), 2);
        assert_eq!(period(&[0]), 2);
        assert_eq!(period(&[0, 0, 1, 0, 0]), 3);
    }
}
