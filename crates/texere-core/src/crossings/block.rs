//! The eight equations of a crossing.

/// The unknowns of a crossing: shift, height, half width and half height of the end, then of the
/// pick.
const UNKNOWNS: usize = 8;

/// The damping of the equations. Each diagonal element grows by this share of itself. The number
/// itself is added, too, so that the equations have a solution even if no term depends on an
/// unknown. 1e-3 and 1e-5 were tried as well. With more damping, threads that contacts hold creep
/// along these contacts.
pub const DAMPING: f32 = 1e-4;

/// The least pivot of Cholesky's method. Without it, rounding could make a pivot zero or negative.
/// With half the value, and with twice, no test is red.
pub const PIVOT: f32 = 1e-9;

/// The energy's gradient and curvature in the eight unknowns of a crossing, for a step of the
/// Gauss-Newton method. Every term of the energy is a weight times the square of a residual.
#[derive(Debug, Clone, PartialEq)]
pub struct CrossingBlock {
    /// Half the energy's gradient.
    pub gradient: [f32; UNKNOWNS],
    /// An upper bound on half the energy's curvature while neighbouring crossings step as well. It
    /// is symmetric, and only the lower triangle is filled.
    pub curvature: [[f32; UNKNOWNS]; UNKNOWNS],
    /// The least distance of two threads at this crossing, divided by the distance that they need.
    /// It is 1 if they touch.
    pub clearance: f32,
}

impl CrossingBlock {
    pub(crate) const NOTHING: Self =
        Self { gradient: [0.0; UNKNOWNS], curvature: [[0.0; UNKNOWNS]; UNKNOWNS], clearance: f32::INFINITY };

    /// Adds the term `weight` times `residual` squared. `slopes` are the residual's derivatives by
    /// unknowns of this crossing, each with the unknown's number.
    ///
    /// All crossings step at once. `share` is the factor by which this crossing's step must be
    /// shorter than if it stepped alone, so that the term does not grow. The reciprocals of the
    /// shares of all crossings in the term add up to 1.
    pub(crate) fn add<const N: usize>(
        &mut self,
        weight: f32,
        share: f32,
        residual: f32,
        slopes: [(usize, f32); N],
    ) {
        for (row, slope) in slopes {
            self.gradient[row] += weight * residual * slope;
            for (column, other) in slopes {
                if column <= row {
                    self.curvature[row][column] += weight * share * slope * other;
                }
            }
        }
    }

    /// Takes unknown number `held` out of the equations: its step is 0. If it stayed, a step that
    /// can't be made would lead the other unknowns to values at which the energy is not least.
    pub(crate) fn hold(&mut self, held: usize) {
        self.gradient[held] = 0.0;
        self.curvature[held] = [0.0; UNKNOWNS];
        for row in &mut self.curvature {
            row[held] = 0.0;
        }
        self.curvature[held][held] = 1.0;
    }

    /// Notes a distance of two threads, divided by the distance that they need. The least is kept.
    pub(crate) const fn see(&mut self, clearance: f32) {
        self.clearance = self.clearance.min(clearance);
    }

    /// The step that solves these equations, by Cholesky's method.
    #[must_use]
    pub fn step(&self) -> [f32; UNKNOWNS] {
        let mut lower = [[0.0_f32; UNKNOWNS]; UNKNOWNS];
        for row in 0..UNKNOWNS {
            for column in 0..=row {
                let known = lower[row][..column].iter().zip(&lower[column][..column]);
                let left = known.fold(self.curvature[row][column], |left, (one, other)| left - one * other);
                lower[row][column] = if row == column {
                    (left + DAMPING + DAMPING * self.curvature[row][row]).max(PIVOT).sqrt()
                } else {
                    left / lower[column][column]
                };
            }
        }
        let mut step = self.gradient.map(|slope| -slope);
        for (row, known) in lower.iter().enumerate() {
            let left = known[..row]
                .iter()
                .zip(&step[..row])
                .fold(step[row], |left, (one, other)| left - one * other);
            step[row] = left / known[row];
        }
        for row in (0..UNKNOWNS).rev() {
            let known = lower[row + 1..].iter().zip(&step[row + 1..]);
            let left = known.fold(step[row], |left, (below, other)| left - below[row] * other);
            step[row] = left / lower[row][row];
        }
        step
    }
}
