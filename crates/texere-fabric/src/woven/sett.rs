//! The greatest sett of a weave and its yarns.

use texere_core::crossings::Level;

use super::{BySet, Thread, Woven};

/// How close the threads of a set lie, and how close they may lie in their weave, in threads to the
/// cm.
///
/// ```
/// use texere_core::{Material, Section};
/// use texere_fabric::{Thread, Weave, Woven};
/// // 8/2 cotton: 52 diameters to the inch.
/// let threads = vec![Thread::new(25.4 / 30.0, 0.5 * 25.4 / 52.0); 16];
/// let twill = Weave::parse("2/2")?.drawdown(16, 16)?;
/// let cloth = Woven::new(twill, threads.clone(), threads, vec![Material::default()], vec![Section::Circle])?;
/// let ends = cloth.setts().warp;
/// assert!((2.54 * ends.per_cm - 30.0).abs() < 1e-6);
/// // Ashenhurst has 34 ends to the inch for it.
/// assert_eq!((2.54 * ends.greatest_per_cm) as u32, 34);
/// # Ok::<(), texere_fabric::FabricError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sett {
    /// Mean number of threads to the cm.
    pub per_cm: f64,
    /// How often a thread of the other set changes sides from one thread of this set to the next,
    /// from 0 to 1. It is 1 in plain weave and 2/n in a satin of n ends. In a cloth of several
    /// levels, it is the mean over the levels, and only changes within each level count. The
    /// binders of an orthogonal weave count as a level.
    pub interlacings: f64,
    /// The greatest sett by the rule of ends and intersections: where a thread of the other set
    /// changes sides, it takes the room of its own diameter. Each level of a cloth has this sett,
    /// so that a double cloth has room for twice as many threads
    /// ([`Drawdown::levels`](crate::Drawdown::levels)).
    ///
    /// **Source**: T. R. Ashenhurst, "A treatise on textile calculations and the structure of
    /// fabrics", 1884: diameters to the inch × ends of a repeat / (ends + intersections). J. T.
    /// Taylor, "Cotton weaving and designing", 6th edition 1909, counts "firmness" in the same way.
    pub greatest_per_cm: f64,
    /// The sett at which the threads of plain weave jam, if the other set keeps its own sett. None
    /// in other weaves and in a cloth of several levels.
    ///
    /// **Source**: F. T. Peirce, "The geometry of cloth structure", Journal of the Textile
    /// Institute 28, 1937, for round threads; A. Kemp, "An extension of Peirce's cloth geometry to
    /// the treatment of non-circular threads", Journal of the Textile Institute 49, 1958, for flat
    /// ones ([`Thread::flatness`](crate::Thread)). A flat thread counts as a round thread as thick
    /// as the flat one is high. The rest of its width is added to the pitch.
    pub jammed_per_cm: Option<f64>,
}

impl Sett {
    /// The sett as a share of the greatest sett. Above 1 the cloth is jammed unless its yarns
    /// flatten.
    #[must_use]
    pub fn share(&self) -> f64 {
        self.per_cm / self.greatest_per_cm
    }
}

impl Woven {
    /// The setts of warp and weft. Greatest setts follow from the mean diameters that the yarns
    /// have when they are round, and jammed setts from their widths and heights in the cloth.
    #[must_use]
    pub fn setts(&self) -> BySet<Sett> {
        let whole = self.whole();
        let sets = [self.warp(), self.weft()];
        let diameters = sets.map(|threads| {
            let sum: f64 = threads.iter().map(|thread| 2.0 * f64::from(thread.radius_mm)).sum();
            sum / threads.len() as f64
        });
        let levels = self.interlacings();
        let is_plain =
            levels.iter().all(|levels| matches!(levels[..], [LevelSett { interlacings: 1.0, .. }]));
        let pitches = [0, 1].map(|set| whole[set].1 / whole[set].0 as f64);
        BySet { warp: 0, weft: 1 }.map(|set: usize| {
            // Each level has its share of the threads.
            let greatest = levels[set]
                .iter()
                .map(|level| 10.0 / (diameters[set] + level.interlacings * diameters[1 - set]) / level.share);
            Sett {
                per_cm: 10.0 / pitches[set],
                interlacings: levels[set].iter().map(|level| level.share * level.interlacings).sum(),
                greatest_per_cm: greatest.fold(f64::INFINITY, f64::min),
                jammed_per_cm: is_plain.then(|| 10.0 / jammed(sets[set], sets[1 - set], pitches[1 - set])),
            }
        })
    }

    /// The interlacings of each level of each set: how often threads of the other set change sides
    /// between neighbours. Where both sets have equally many levels, a level of both is a layer,
    /// and only threads within the layer count.
    fn interlacings(&self) -> [Vec<LevelSett>; 2] {
        let [across, along] = self.repeat();
        let levels = self.levels([across, along]);
        let up =
            |end: usize, pick: usize| self.drawdown().up(end % self.warp().len(), pick % self.weft().len());
        [0, 1].map(|set| {
            let highest = levels[set].iter().map(|level| level.of).fold(1, u8::max);
            // Three counts of crossings for each level, and last for the binders: at how many a
            // thread lies in the level, how many of these crossings count, and at how many of those
            // that count the crossed thread changes sides before the next thread of the level.
            let mut counts = vec![[0_u64; 3]; usize::from(highest) + 1];
            // Crossings with one level are left out of a figured cloth: the cloth is single there,
            // or its layers change places.
            let counts_here = |(_, level): &(usize, &Level)| level.of != 1 || highest == 1;
            for (number, level) in levels[set].iter().enumerate().filter(counts_here) {
                let other = levels[1 - set][number];
                let of = if *level == Level::BINDER { highest } else { level.number };
                let [lying, counting, changing] = &mut counts[usize::from(of)];
                *lying += 1;
                if level.of == other.of && level.number != other.number {
                    continue;
                }
                *counting += 1;
                let (end, pick) = (number % across, number / across);
                // A single thread is its own neighbour.
                let next = |steps: usize| match set {
                    0 => [(end + steps) % across, pick],
                    _ => [end, (pick + steps) % along],
                };
                let is_level = |[end, pick]: &[usize; 2]| levels[set][pick * across + end] == *level;
                let next = (1..=[across, along][set]).map(next).find(is_level);
                *changing += u64::from(next.is_some_and(|[x, y]| up(x, y) != up(end, pick)));
            }
            let crossings = counts.iter().map(|[lying, ..]| lying).sum::<u64>() as f64;
            let level = |[lying, counting, changing]: [u64; 3]| LevelSett {
                share: lying as f64 / crossings,
                interlacings: changing as f64 / counting.max(1) as f64,
            };
            counts.into_iter().filter(|[lying, ..]| *lying > 0).map(level).collect()
        })
    }
}

/// A level of a set: its share of the threads, and how often threads of the other set change sides
/// between its neighbours.
struct LevelSett {
    share: f64,
    interlacings: f64,
}

/// The pitch at which `threads`, in plain weave, jam between the threads of the other set, mm.
/// `pitch` is the pitch of the other set. The steepest slopes θ₁ and θ₂ of both sets then have cos
/// θ₁ + cos θ₂ = 1. The pitch of each set is then the sum of both heights times the sine of the
/// slope of the threads that cross the set, plus the excess of the set's width over its height.
fn jammed(threads: &[Thread], others: &[Thread], pitch: f64) -> f64 {
    let [[wide, high], [other_wide, other_high]] = [threads, others].map(|threads| {
        let halves = threads.iter().map(|thread| thread.halves_mm().map(f64::from));
        let sum = halves.fold([0.0; 2], |sum, halves| [0, 1].map(|half| sum[half] + 2.0 * halves[half]));
        sum.map(|sum| sum / threads.len() as f64)
    });
    let both = high + other_high;
    // The sine of this set's slope. At 1, the threads of the other set lie so far apart that the
    // threads of this set may lie side by side.
    let other = ((pitch - other_wide + other_high) / both).clamp(0.0, 1.0);
    let left = 1.0 - (1.0 - other * other).sqrt();
    (wide - high + both * (1.0 - left * left).sqrt()).max(wide)
}
