//! A thread that changes sides between two threads of the other set.

/// Newton's steps towards the best slope.
pub const STEPS: u32 = 5;

/// Newton's method is followed where the room curves by more than that share of the distance.
pub const CURVED: f32 = 0.1;

/// The longest turn of a step, radians.
pub const TURN: f32 = 0.5;

/// A straight passage over the first of two crossed threads and under the second one, at the slope
/// that leaves most room.
///
/// A line at slope t clears an upright ellipse by its support, sqrt((a sin t)² + (b cos t)²). So
/// between two ellipses that lie `across` and `rise` apart a thread of half thicknesses `b` fits
/// where across sin t + rise cos t is at least both supports and both half thicknesses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StraightPassage {
    /// Cosine and sine of the slope, 0 to a right angle.
    pub slope: [f32; 2],
    /// How far both ellipses reach across the slope.
    pub reach: [f32; 2],
    /// Between the middles of both ellipses, across the slope.
    pub between: f32,
    /// What is left when both ellipses and the thread have theirs; below 0 they pierce.
    pub room: f32,
}

impl StraightPassage {
    /// The passage between two ellipses `across` and `rise` apart (the second one's middle above
    /// the first one's counts as positive), with the half width and half height of each; `thread`
    /// is what the passing thread takes, both its half heights.
    ///
    /// ```
    /// use texere_core::crossings::StraightPassage;
    /// // Round threads of radius 1 in a row, jammed at a distance of √3 diameters (Peirce).
    /// let jammed = StraightPassage::new(3.0_f32.sqrt() * 2.0, 2.0, [[1.0; 2]; 2], 2.0);
    /// assert!(jammed.room.abs() < 1e-5);
    /// ```
    #[must_use]
    pub fn new(across: f32, rise: f32, halves: [[f32; 2]; 2], thread: f32) -> Self {
        let distance = (across * across + rise * rise).sqrt();
        let excess = halves.map(|[a, b]| a * a - b * b);
        // The best slope of round threads, level or upright: wide ellipses leave most room at one
        // of these.
        let round = if rise > 0.0 { [rise / distance, across / distance] } else { [0.0, 1.0] };
        let left = |[c, s]: [f32; 2]| {
            let [first, second] = reach(c, s, halves);
            across * s + rise * c - first - second
        };
        let better = |best: [f32; 2], slope: [f32; 2]| if left(slope) > left(best) { slope } else { best };
        let [mut c, mut s] = better(better(round, [1.0, 0.0]), [0.0, 1.0]);
        for _ in 0..STEPS {
            let [first, second] = reach(c, s, halves);
            let [p, q] = [excess[0] / first, excess[1] / second];
            let slope = across * c - rise * s - s * c * (p + q);
            let curve = -(across * s + rise * c) - (c * c - s * s) * (p + q)
                + s * s * c * c * (p * p / first + q * q / second);
            let turn = if curve < -CURVED * distance { -slope / curve } else { slope / distance };
            let turn = turn.clamp(-TURN, TURN);
            let (turned_c, turned_s) = (c - s * turn, s + c * turn);
            let length = (turned_c * turned_c + turned_s * turned_s).sqrt();
            (c, s) = (turned_c / length, turned_s / length);
            if c < 0.0 {
                (c, s) = (0.0, 1.0);
            }
            if s < 0.0 {
                (c, s) = (1.0, 0.0);
            }
        }
        let reach = reach(c, s, halves);
        let between = across * s + rise * c;
        Self { slope: [c, s], reach, between, room: between - reach[0] - reach[1] - thread }
    }

    /// The distance of both ellipses over what they and the thread need: 1 where they touch.
    #[must_use]
    pub fn clearance(&self) -> f32 {
        self.between / (self.between - self.room)
    }
}

/// How far ellipses reach across a slope.
fn reach(c: f32, s: f32, halves: [[f32; 2]; 2]) -> [f32; 2] {
    halves.map(|[a, b]| {
        let (x, z) = (a * s, b * c);
        (x * x + z * z).sqrt()
    })
}
