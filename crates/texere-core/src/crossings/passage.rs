//! The passage of a thread that changes sides between two threads of the other set.

/// Number of steps of Newton's method towards the best slope. With 2,
/// `gradients_are_the_energys` is red; with 10, no test is.
pub const STEPS: u32 = 5;

/// Newton's step is used where the second derivative of the room ([`StraightPassage::room`]) by the
/// slope angle is less than minus this multiple of the distance between the ellipses' middles.
/// Elsewhere the step is the room's first derivative, divided by that distance. With twice the
/// value, `gradients_are_the_energys` is red; with half, no test is.
pub const CURVED: f32 = 0.1;

/// The longest turn of one step, radians. With half the value, and with twice, no test is red.
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
        let opening = Opening { across, rise, halves, thread };
        opening.straight(opening.start().0)
    }

    /// The distance between both ellipses at right angles to the slope, divided by the one that
    /// they and the thread need. It is 1 if all three touch.
    #[must_use]
    pub fn clearance(&self) -> f32 {
        self.between / (self.between - self.room)
    }
}

/// The opening between two ellipses, and the thread that passes through it. The fields are the
/// arguments of [`StraightPassage::new`].
#[derive(Clone, Copy)]
pub(super) struct Opening {
    pub(super) across: f32,
    pub(super) rise: f32,
    pub(super) halves: [[f32; 2]; 2],
    pub(super) thread: f32,
}

impl Opening {
    /// The best of three slopes as cosine and sine, and the room that the slope leaves. The three
    /// are the slope that is best for circles, level, and upright. Wide ellipses may leave most
    /// room near level or upright.
    pub(super) fn start(&self) -> ([f32; 2], f32) {
        let Self { across, rise, halves: [[a, b], [other_a, other_b]], thread } = *self;
        let distance = (across * across + rise * rise).sqrt();
        let [c, s] = if rise > 0.0 { [rise / distance, across / distance] } else { [0.0, 1.0] };
        let [first, second] = reach(c, s, self.halves);
        let mut best = ([c, s], across * s + rise * c - first - second);
        let (level, upright) = (rise - b - other_b, across - a - other_a);
        if level > best.1 {
            best = ([1.0, 0.0], level);
        }
        if upright > best.1 {
            best = ([0.0, 1.0], upright);
        }
        (best.0, best.1 - thread)
    }

    /// Upper bound of the distance that both ellipses and the thread need at any slope.
    pub(super) const fn need_most(&self) -> f32 {
        let [[a, b], [other_a, other_b]] = self.halves;
        a.max(b) + other_a.max(other_b) + self.thread
    }

    /// The straight passage, found by Newton's method from the slope `[c, s]`.
    pub(super) fn straight(&self, [mut c, mut s]: [f32; 2]) -> StraightPassage {
        let Self { across, rise, halves, thread } = *self;
        let distance = (across * across + rise * rise).sqrt();
        let [[a, b], [other_a, other_b]] = halves;
        let excess = [a * a - b * b, other_a * other_a - other_b * other_b];
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
        StraightPassage { slope: [c, s], reach, between, room: between - reach[0] - reach[1] - thread }
    }
}

/// How far ellipses reach at right angles to a slope with cosine `c` and sine `s`.
fn reach(c: f32, s: f32, [[a, b], [other_a, other_b]]: [[f32; 2]; 2]) -> [f32; 2] {
    let (x, z, other_x, other_z) = (a * s, b * c, other_a * s, other_b * c);
    [(x * x + z * z).sqrt(), (other_x * other_x + other_z * other_z).sqrt()]
}
