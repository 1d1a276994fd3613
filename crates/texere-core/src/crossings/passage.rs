//! The passage of a thread that changes sides between two threads of the other set.

/// Number of steps of Newton's method towards the best slope.
pub const STEPS: u32 = 5;

/// How much the room, as a function of the slope angle, must curve downwards for Newton's step to
/// be used. It is a share of the distance between the ellipses' middles. If the room curves less,
/// the step is the room's first derivative, divided by that distance.
pub const CURVED: f32 = 0.1;

/// The longest turn of one step, radians.
pub const TURN: f32 = 0.5;

/// The straight passage of a thread over the first of two crossed threads and under the second, at
/// the slope that leaves most room.
///
/// A line at slope angle t touches an upright ellipse of half width a and half height b if its
/// distance from the ellipse's middle is the ellipse's support, sqrt((a sin t)² + (b cos t)²). Let
/// two ellipses lie `across` and `rise` apart. A thread fits between them if across sin t + rise
/// cos t is at least the sum of both supports and of the half heights that the thread has at the
/// two ellipses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StraightPassage {
    /// Cosine and sine of the slope angle, which lies between 0 and a right angle.
    pub slope: [f32; 2],
    /// How far each ellipse reaches at right angles to the slope.
    pub reach: [f32; 2],
    /// The distance between the middles of both ellipses, at right angles to the slope.
    pub between: f32,
    /// The room that both ellipses and the thread leave. Below 0 they pierce one another.
    pub room: f32,
}

impl StraightPassage {
    /// The passage between two ellipses `across` and `rise` apart. `rise` is positive if the second
    /// ellipse's middle lies above that of the first. `halves` are the half width and half height
    /// of each ellipse. `thread` is the sum of the passing thread's two half heights.
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
        // Newton's method starts at the best of three slopes: that of round threads, level, and
        // upright. Wide ellipses leave most room near level or upright.
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

    /// The distance of both ellipses, divided by the distance that they and the thread need. It is
    /// 1 if all three touch.
    #[must_use]
    pub fn clearance(&self) -> f32 {
        self.between / (self.between - self.room)
    }
}

/// How far ellipses reach at right angles to a slope with cosine `c` and sine `s`.
fn reach(c: f32, s: f32, halves: [[f32; 2]; 2]) -> [f32; 2] {
    halves.map(|[a, b]| {
        let (x, z) = (a * s, b * c);
        (x * x + z * z).sqrt()
    })
}
