//! Half lines that find the place on a yarn that a user points at.

/// A half line.
///
/// ```
/// use texere_core::Ray;
/// let down = Ray { origin: [1.0, 2.0, 10.0], direction: [0.0, 0.0, -2.0] };
/// assert_eq!(down.at(4.5), [1.0, 2.0, 1.0]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// The start, mm.
    pub origin: [f64; 3],
    /// The direction, of any length but 0.
    pub direction: [f64; 3],
}

impl Ray {
    /// The start plus `distance` times the direction: a point, mm. If the direction has length 1,
    /// `distance` is in mm.
    #[must_use]
    pub fn at(&self, distance: f64) -> [f64; 3] {
        std::array::from_fn(|axis| self.origin[axis] + distance * self.direction[axis])
    }
}
