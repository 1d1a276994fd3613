//! The shares of the crimp, which say how far warp and weft swing out of the cloth's middle.

use super::thread::Thread;
use crate::WovenError;

/// How warp and weft share the distance that they keep from one another where they cross.
///
/// At a crossing the two centrelines are apart by R, half the sum of the heights of both sections.
/// The warp lies `share × R` from the cloth's middle, and the weft lies at the rest of R on the
/// other side. All crossings of a cloth have the same share. If the threads that a thread crosses
/// are alike, it therefore has the same distance from the middle at all crossings, as a thread
/// under tension does.
///
/// A change of the share is called crimp interchange. If a cloth is pulled along the warp, the warp
/// straightens, so that its share falls, and the weft takes more crimp. The pitches change, too.
/// The caller gives them as the threads' spacings.
///
/// **Source**: Peirce, "The geometry of cloth structure", Journal of the Textile Institute 28,
/// 1937: h₁ + h₂ = D, with the crimp heights h₁ and h₂ of warp and weft, and D the sum of both
/// diameters.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub enum Crimp {
    /// The shares follow from the threads' stiffness in bending, taken as the fourth power of the
    /// radius. [`Thread::stiffness`] does not count. The stiffer set stays straighter. The share is
    /// a half if both sets are alike, and is kept between 20 and 80 %. A greater share than 80 %
    /// would need a pitch that few cloths have. Thin yarns do not hold thick ones quite straight,
    /// either.
    #[default]
    Stiffness,
    /// The warp's share, from 0 (straight ends) to 1 (straight picks).
    WarpShare(f32),
}

/// The least share that [`Crimp::Stiffness`] gives either set.
pub(super) const SHARE_MIN: f32 = 0.2;

impl Crimp {
    /// **Errors**: [`WovenError::Crimp`] for a share outside \[0, 1\].
    pub(super) fn validate(self) -> Result<(), WovenError> {
        match self {
            Self::WarpShare(share) if !(0.0..=1.0).contains(&share) => {
                Err(WovenError::Crimp { share, low: 0.0, high: 1.0 })
            }
            _ => Ok(()),
        }
    }

    /// The warp's share in a cloth of these threads.
    pub(super) fn warp_share(self, warp: &[Thread], weft: &[Thread]) -> f32 {
        match self {
            Self::WarpShare(share) => share,
            Self::Stiffness => {
                let stiffness = |threads: &[Thread]| {
                    let sum: f64 = threads.iter().map(|thread| f64::from(thread.radius_mm).powi(4)).sum();
                    sum / threads.len() as f64
                };
                let (warp, weft) = (stiffness(warp), stiffness(weft));
                ((weft / (warp + weft)) as f32).clamp(SHARE_MIN, 1.0 - SHARE_MIN)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stiffer_set_stays_the_straighter() {
        let [thin, thick] = [0.1, 0.12].map(|radius| vec![Thread::new(1.0, radius); 3]);
        assert_eq!(Crimp::Stiffness.warp_share(&thin, &thin), 0.5);
        // 1.2⁴ = 2.0736 to 1.
        let share = Crimp::Stiffness.warp_share(&thick, &thin);
        assert!((share - 1.0 / 3.0736).abs() < 1e-5, "{share}");
        assert!((Crimp::Stiffness.warp_share(&thin, &thick) + share - 1.0).abs() < 1e-6);
        let wire = vec![Thread::new(10.0, 2.0); 3];
        assert_eq!(Crimp::Stiffness.warp_share(&wire, &thin), SHARE_MIN);
        assert_eq!(Crimp::WarpShare(0.05).warp_share(&wire, &thin), 0.05);
    }

    #[test]
    fn a_share_outside_nought_to_one_is_refused() {
        for share in [-0.01, 1.01, f32::NAN, f32::INFINITY] {
            assert!(matches!(Crimp::WarpShare(share).validate(), Err(WovenError::Crimp { .. })));
        }
        assert!([0.0, 1.0].iter().all(|share| Crimp::WarpShare(*share).validate().is_ok()));
    }
}
