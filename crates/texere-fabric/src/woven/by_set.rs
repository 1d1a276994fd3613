//! A pair of values, one for the warp and one for the weft.

use std::ops::{Index, IndexMut};

use texere_core::crossings::Set;

/// A value for the warp, and a value for the weft.
///
/// ```
/// use texere_core::crossings::Set;
/// use texere_fabric::BySet;
/// let crimp = BySet { warp: 0.12, weft: 0.04 };
/// assert_eq!(crimp[Set::Weft], 0.04);
/// assert!(crimp.map(|share| share > 0.1).warp);
/// assert_eq!(crimp.into_array(), [0.12, 0.04]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct BySet<T> {
    /// The value for the ends.
    pub warp: T,
    /// The value for the picks.
    pub weft: T,
}

impl<T> BySet<T> {
    /// Applies a function to both values, the warp's first.
    #[must_use]
    pub fn map<U>(self, mut function: impl FnMut(T) -> U) -> BySet<U> {
        BySet { warp: function(self.warp), weft: function(self.weft) }
    }

    /// Both values, the warp's first.
    #[must_use]
    pub fn into_array(self) -> [T; 2] {
        [self.warp, self.weft]
    }

    /// A pair whose first value is for the warp, and whose second is for the weft.
    pub(crate) fn of([warp, weft]: [T; 2]) -> Self {
        Self { warp, weft }
    }
}

impl<T> Index<Set> for BySet<T> {
    type Output = T;

    fn index(&self, set: Set) -> &T {
        match set {
            Set::Warp => &self.warp,
            Set::Weft => &self.weft,
        }
    }
}

impl<T> IndexMut<Set> for BySet<T> {
    fn index_mut(&mut self, set: Set) -> &mut T {
        match set {
            Set::Warp => &mut self.warp,
            Set::Weft => &mut self.weft,
        }
    }
}
