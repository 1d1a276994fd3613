//! The greatest sett of a weave and its yarns.

use super::{Thread, Woven};

/// How close the threads of a set lie, and how close they may lie in their weave, threads to the cm.
///
/// ```
/// use texere_core::{Material, Section};
/// use texere_fabric::{Thread, Weave, Woven};
/// // 8/2 cotton: 52 diameters to the inch.
/// let threads = vec![Thread::new(25.4 / 30.0, 0.5 * 25.4 / 52.0); 16];
/// let twill = Weave::parse("2/2")?.drawdown(16, 16)?;
/// let cloth = Woven::new(twill, threads.clone(), threads, vec![Material::default()], vec![Section::Circle])?;
/// let [ends, _] = cloth.setts();
/// assert!((2.54 * ends.per_cm - 30.0).abs() < 1e-6);
/// // Ashenhurst has 34 ends to the inch for it.
/// assert_eq!((2.54 * ends.greatest_per_cm) as u32, 34);
/// # Ok::<(), texere_fabric::FabricError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sett {
    /// Threads to the cm, in the mean.
    pub per_cm: f64,
    /// How often a thread of the other set changes sides on its way over one of this set, 0 to 1: 1 in plain weave, 2/n in a satin of n.
    pub interlacings: f64,
    /// The greatest sett by the rule of ends and intersections: where a thread changes sides it takes the room of one more thread.
    ///
    /// **Source**: T. R. Ashenhurst, "A treatise on textile calculations and the structure of fabrics", 1884: diameters to the inch × ends
    /// of a repeat / (ends + intersections). J. T. Taylor, "Cotton weaving and designing", 6th edition 1909, counts "firmness" so.
    pub greatest_per_cm: f64,
    /// The sett at which the threads of plain weave jam as they lie between those of the other set at its own sett; none in other weaves.
    ///
    /// **Source**: F. T. Peirce, "The geometry of cloth structure", Journal of the Textile Institute 28, 1937, of round threads; A. Kemp, "An extension
    /// of Peirce's cloth geometry to the treatment of non-circular threads", the same 49, 1958, of flat ones ([`Thread::flatness`](crate::Thread)): as
    /// round ones that are as thick as they are high, further apart by what is left of their width.
    pub jammed_per_cm: Option<f64>,
}

impl Sett {
    /// The sett as a share of the greatest one: above 1 the cloth is jammed unless its yarns flatten.
    #[must_use]
    pub fn share(&self) -> f64 {
        self.per_cm / self.greatest_per_cm
    }
}

impl Woven {
    /// The setts of warp and weft. Diameters are those of the round yarns.
    #[must_use]
    pub fn setts(&self) -> [Sett; 2] {
        let size = self.size_mm();
        let sets = [self.warp(), self.weft()];
        let diameters = sets.map(|threads| {
            let sum: f64 = threads.iter().map(|thread| 2.0 * f64::from(thread.radius_mm)).sum();
            sum / threads.len() as f64
        });
        let interlacings = self.interlacings();
        let is_plain = interlacings.iter().all(|share| *share == 1.0);
        let pitches = [0, 1].map(|set| size[set] / sets[set].len() as f64);
        [0, 1].map(|set| Sett {
            per_cm: 10.0 / pitches[set],
            interlacings: interlacings[set],
            greatest_per_cm: 10.0 / (diameters[set] + interlacings[set] * diameters[1 - set]),
            jammed_per_cm: is_plain.then(|| 10.0 / jammed(sets[set], sets[1 - set], pitches[1 - set])),
        })
    }

    /// How often picks change sides between one end and the next, and ends between picks.
    fn interlacings(&self) -> [f64; 2] {
        let [ends, picks] = self.repeat();
        // A cloth of one thread is its own neighbour.
        let up = |end: usize, pick: usize| {
            self.drawdown().up(end % ends % self.warp().len(), pick % picks % self.weft().len())
        };
        let mut changes = [0_u64; 2];
        for (end, pick) in (0..picks).flat_map(|pick| (0..ends).map(move |end| (end, pick))) {
            changes[0] += u64::from(up(end, pick) != up(end + 1, pick));
            changes[1] += u64::from(up(end, pick) != up(end, pick + 1));
        }
        changes.map(|changes| changes as f64 / (ends * picks) as f64)
    }
}

/// The pitch at which threads of plain weave jam between those of the other set, mm: cos θ₁ + cos θ₂ = 1, where each set's pitch is the sum of both
/// heights times sin θ, and what it is wider than high.
fn jammed(threads: &[Thread], others: &[Thread], pitch: f64) -> f64 {
    let [[wide, high], [other_wide, other_high]] = [threads, others].map(|threads| {
        let halves = threads.iter().map(|thread| thread.halves_mm().map(f64::from));
        let sum = halves.fold([0.0; 2], |sum, halves| [0, 1].map(|half| sum[half] + 2.0 * halves[half]));
        sum.map(|sum| sum / threads.len() as f64)
    });
    let both = high + other_high;
    // The other set's threads lie so far apart that these may lie side by side.
    let other = ((pitch - other_wide + other_high) / both).clamp(0.0, 1.0);
    let left = 1.0 - (1.0 - other * other).sqrt();
    (wide - high + both * (1.0 - left * left).sqrt()).max(wide)
}
