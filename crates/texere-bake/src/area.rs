//! The rectangle of cloth that is baked, and its texels.

use crate::BakeError;

/// The most texels along a side of a map. Graphics programs load maps up to this size.
pub(crate) const SIDE_MOST: u32 = 16_384;

/// The most texels of a map. All maps of one side of the cloth take 52 bytes a texel. Making them
/// takes some 140 bytes a texel, 4.7 GB at this limit.
const TEXELS_MOST: u64 = 1 << 25;

/// A rectangle of cloth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Area {
    /// The lower left corner (x, y), mm.
    pub(crate) low: [f64; 2],
    /// Width and height, mm.
    pub(crate) size: [f64; 2],
    /// Whether the rectangle tiles: what leaves it at one edge comes in at the opposite one.
    pub(crate) tiles: bool,
}

impl Area {
    /// **Errors**: [`BakeError::Area`].
    pub(crate) fn check(&self) -> Result<(), BakeError> {
        let Self { low, size, .. } = *self;
        let is_finite = low.iter().chain(&size).all(|number| number.is_finite());
        if is_finite && size.iter().all(|&side| side > 0.0) {
            Ok(())
        } else {
            Err(BakeError::Area { low, size })
        }
    }

    /// The width and height of the area's maps, in texels of about `mm`. A whole number of texels
    /// fits the area, so texels are not quite square.
    ///
    /// **Errors**: [`BakeError::Area`], [`BakeError::Texel`], [`BakeError::TooLarge`].
    pub(crate) fn texels(&self, mm: f64) -> Result<[u32; 2], BakeError> {
        self.check()?;
        if !(mm.is_finite() && mm > 0.0) {
            return Err(BakeError::Texel { mm });
        }
        // A number that is too large for a `u64` becomes the largest `u64`.
        let [width, height] = self.size.map(|side| (side / mm).round().max(1.0) as u64);
        let side = u64::from(SIDE_MOST);
        if width > side || height > side || width * height > TEXELS_MOST {
            return Err(BakeError::TooLarge { width, height, side: SIDE_MOST, limit: TEXELS_MOST });
        }
        Ok([width as u32, height as u32])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texels_fit_the_area() {
        let area = Area { low: [1.0, 2.0], size: [3.0, 0.5], tiles: true };
        assert_eq!(area.texels(0.1).ok(), Some([30, 5]));
        assert_eq!(area.texels(0.4).ok(), Some([8, 1]));
        assert_eq!(area.texels(100.0).ok(), Some([1, 1]));
        assert!(matches!(area.texels(1e-4), Err(BakeError::TooLarge { width: 30_000, height: 5_000, .. })));
        assert!(matches!(area.texels(1e-300), Err(BakeError::TooLarge { .. })));
        for mm in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(area.texels(mm), Err(BakeError::Texel { .. })), "{mm}");
        }
        for size in [[0.0, 1.0], [1.0, -1.0], [f64::NAN, 1.0]] {
            assert!(matches!(Area { size, ..area }.texels(0.1), Err(BakeError::Area { .. })));
        }
    }
}
