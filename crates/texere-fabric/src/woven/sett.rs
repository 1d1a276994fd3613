//! The greatest sett of a weave and its yarns.

use super::Woven;

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
        [0, 1].map(|set| Sett {
            per_cm: 10.0 * sets[set].len() as f64 / size[set],
            interlacings: interlacings[set],
            greatest_per_cm: 10.0 / (diameters[set] + interlacings[set] * diameters[1 - set]),
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
