//! The distance of each thread to the thread before it, and the distance that it needs.

use texere_core::Origin;

use super::jam::{Gap, ROUNDING};
use super::thread::pitches;
use super::{BySet, Woven};

/// Distance of a thread to the thread before it, and the least distances that it needs.
///
/// ```
/// use texere_core::{Material, Section};
/// use texere_fabric::{Thread, Weave, Woven};
/// let plain = Weave::parse("plain")?.drawdown(3, 3)?;
/// let (warp, weft) = (vec![Thread::new(0.3, 0.1); 3], vec![Thread::new(0.6, 0.1); 3]);
/// let cloth = Woven::new(plain, warp, weft, vec![Material::default()], vec![Section::Circle])?;
/// let pitches = cloth.pitches();
/// // Round threads alike need √3 diameters for those that cross to pass in between.
/// assert!((pitches.warp[0].passing_mm - 3f64.sqrt() * 0.2).abs() < 1e-6);
/// assert!(pitches.warp[0].is_jammed() && !pitches.warp[0].is_crowded());
/// assert!(!pitches.weft[0].is_jammed());
/// # Ok::<(), texere_fabric::FabricError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pitch {
    /// The thread.
    pub thread: Origin,
    /// Distance of the thread to the thread before it, mm.
    pub pitch_mm: f64,
    /// The least distance at which the two lie side by side without piercing, mm: half the sum of
    /// their widths.
    pub beside_mm: f64,
    /// The least distance at which crossing threads that change sides between the two can pass, mm;
    /// 0 if no thread changes sides there.
    pub passing_mm: f64,
}

impl Pitch {
    /// Whether the two threads pierce one another side by side.
    #[must_use]
    pub fn is_crowded(&self) -> bool {
        self.beside_mm > self.pitch_mm * (1.0 + ROUNDING)
    }

    /// Whether crossing threads are jammed between the two.
    #[must_use]
    pub fn is_jammed(&self) -> bool {
        self.passing_mm > self.pitch_mm * (1.0 + ROUNDING)
    }
}

impl Woven {
    /// The pitches of the ends and of the picks, each from the second thread on, in the cloth's
    /// present shape.
    ///
    /// **Source**: Peirce, "The geometry of cloth structure", Journal of the Textile Institute 28,
    /// 1937, for [`Shape::Round`](crate::Shape::Round). The values for
    /// [`Shape::Crossing`](crate::Shape::Crossing) were measured.
    #[must_use]
    pub fn pitches(&self) -> BySet<Vec<Pitch>> {
        let [warp, weft] = self.gaps();
        // The weft passes between ends, with its own share of the crimp.
        let share = self.warp_share();
        let all = |gaps: &[Gap], share: f32, origin: fn(u32) -> Origin| {
            let pitch = |gap: &Gap| Pitch {
                thread: origin(gap.thread),
                pitch_mm: gap.pitch,
                beside_mm: f64::from(gap.widths),
                passing_mm: gap.needed(self.shape(), share),
            };
            gaps.iter().map(pitch).collect()
        };
        BySet { warp: all(&warp, 1.0 - share, Origin::End), weft: all(&weft, share, Origin::Pick) }
    }

    /// Distance of an end or a pick to the thread before it, mm; for the first thread, its distance
    /// to the second.
    pub(crate) fn pitch_mm(&self, thread: Origin) -> Option<f64> {
        let (set, number) = match thread {
            Origin::End(number) => (self.warp(), number),
            Origin::Pick(number) => (self.weft(), number),
            _ => return None,
        };
        pitches(set).nth((number as usize).saturating_sub(2))
    }
}
