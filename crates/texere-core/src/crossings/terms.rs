//! The terms of the energy of crossings.
//!
//! The energy is a sum of terms. Each term is a weight times the square of a residual, which is 0
//! if a condition holds. The conditions are that a thread is straight, level and even, has its
//! shape and its area, and is clear of the threads beside it. A pass is one step of the
//! Gauss-Newton method for the sum of all terms, at every crossing at once.
//!
//! ```text
//! for each crossing:
//!     block = no equations                  8 unknowns: shift, height, half width, half height
//!                                                       of the end, then of the pick
//!     for the end, then the pick:
//!         own        section has the shape that it tends to; height is 0; area is the yarn's,
//!                    and no less than its fibres fill
//!         bends      second differences along the thread are 0
//!         steps      first differences along the thread are 0
//!         for the crossing before and the one after, and the next ones of the same level:
//!             meeting: on the same side     the thread clears the shoulder under its upper end
//!                      on the other side    it fits between the two threads that it passes
//!         for the nearest threads of its level, before and after:
//!             neighbour                     they are clear side by side
//!         for the threads beside it, if they have another level:
//!             stacked                       they are clear as ellipses
//!     contact        end and pick lie one on top of the other, and touch if they bend round one another
//! ```
//!
//! A term that depends on several crossings is computed at each of them. Each crossing keeps the
//! slopes by its own unknowns only, so that terms are gathered and nothing is scattered. In the
//! energy each term counts once.

use super::{
    CrossingBlock, CrossingState, CrossingsPass, CrossingsPlan, Row, Set, Site, StraightPassage, ThreadState,
};

/// The weight of second differences of heights, times the fourth power of a diameter over the third
/// power of a pitch.
pub const BEND: f32 = 1.0;
/// The weight of second differences of shifts, in the same units as [`BEND`]. It is higher than
/// [`BEND`] because skewed threads collide at corners that the passage term does not cover. 5, 20,
/// 80 and 120 were tried. With 80, denim lacks a hundredth of its room
/// (`cloths_of_the_mills_come_to_rest` of texere-fabric).
pub const SIDEWAYS_BEND: f32 = 120.0;

/// The weight of first differences of heights, times the square of a diameter over a pitch.
pub const TENSION: f32 = 1.0;
/// The weight of first differences of shifts, in the same units as [`TENSION`].
pub const SIDEWAYS_TENSION: f32 = 0.1;

/// The weight of heights, times the square of a diameter, by which a finish presses the cloth flat.
/// With 0, `energy_goes_down_while_penalties_stay` fails.
pub const PRESS: f32 = 0.6;

/// The weight of first differences of half widths and half heights along a thread, in radii. With
/// 0, a 2/2 twill does not come to rest (`cloths_of_the_mills_come_to_rest`).
pub const SMOOTH: f32 = 3.0;

/// The weight of area that a section has lost.
pub const AREA_LOSS: f32 = 6.0;
/// The weight of area that a section lacks to its least area, as a multiple of the weight of
/// penalties, so that contacts give way before fibres do. 1, 3 and 10 were tried, and differ
/// little.
pub const SOLID: f32 = 10.0;
/// The weight of area that a section has gained.
pub const AREA_GAIN: f32 = 100.0;

/// The distance by which threads are kept apart, in units, because penalties give way a little.
pub const MARGIN: f32 = 0.006;

/// The distance, in units, below which threads that do not touch yet make each other's steps
/// shorter. They do not push one another. With 0, contacts come and go and the threads keep
/// swinging: a plain weave at its jam does not come to rest (`cloths_of_the_mills_come_to_rest`,
/// `energy_goes_down_while_penalties_stay`).
pub const NEAR: f32 = 0.02;

/// The weight of the gap between the two threads of a crossing that bend round one another. Without
/// it, threads of dense cloth stand off one another where they cross, because a thread fits between
/// others more easily the further these are apart in height. On their way they then pierce one
/// another: 2/2 twill at 1.14 times Ashenhurst's sett comes to a clearance of 0.85, and with 100 to
/// 0.985. 10, 30, 100 and 300 were tried. With 30, denim folds where it binds
/// (`cloths_of_the_mills_come_to_rest` of texere-fabric).
pub const TOUCH: f32 = 100.0;

/// The slope of a layer's thread, divided by that of the straight line between two crossings. The
/// thread is steeper because it bends where it binds.
pub const STEEPER: f32 = 1.4;

// The unknowns of a thread, counted from the first of its set.
const SHIFT: usize = 0;
const HEIGHT: usize = 1;
const WIDTH: usize = 2;
const THICKNESS: usize = 3;

impl CrossingsPlan {
    /// The equations of the crossing at `site`, gathered from all terms that depend on the
    /// crossing. `crossings` are the states of all crossings.
    ///
    /// **Panics** if `crossings` has fewer crossings than the plan.
    #[must_use]
    pub fn block(&self, pass: &CrossingsPass, crossings: &[CrossingState], site: Site) -> CrossingBlock {
        let mut block = CrossingBlock::NOTHING;
        let both =
            Set::BOTH.map(|set| Here { plan: self, pass, all: crossings, site, set, row: set.first() });
        for here in both {
            let set = here.set;
            here.own(&mut block);
            here.bends(&mut block);
            here.steps(&mut block);
            for steps in [-1, 1] {
                here.meeting(&mut block, steps);
            }
            for (sign, steps) in here.of_level(set) {
                here.neighbour(&mut block, sign * steps);
                if steps != 1 {
                    here.stacked(&mut block, sign);
                }
            }
            for (sign, steps) in here.of_level(set.other()) {
                if steps > 1 {
                    here.meeting(&mut block, sign * steps);
                }
            }
        }
        contact(&both, &mut block);
        block
    }
}

/// Adds the contact of both threads of a crossing: one lies on top of the other. Threads that bend
/// round one another touch.
fn contact([warp, weft]: &[Here<'_>; 2], block: &mut CrossingBlock) {
    let Here { plan, pass, site, .. } = *warp;
    let [end, pick] = [warp, weft].map(|thread| thread.thread(site));
    let side = plan.side(site, Set::Warp);
    let apart = side * (end.height - pick.height);
    // Threads of two layers slope where they cross. Along the slope of the other thread an ellipse
    // reaches further.
    let reaches = [(end, weft), (pick, warp)].map(|(lie, other)| {
        Reach::new(lie, if plan.are_apart(site) { STEEPER * other.steepest() } else { 0.0 })
    });
    let need = reaches[0].reach + reaches[1].reach;
    block.see(apart / need);
    let room = apart - need - MARGIN;
    let (is_near, pull) = (room < NEAR, if plan.touch(site) { TOUCH } else { 0.0 });
    if is_near || pull > 0.0 {
        let weight = if is_near { pass.penalty } else { pull };
        let residual = if room < 0.0 { room } else { pull / weight * room };
        let [warp, weft] = [warp.row, weft.row];
        let slopes = [
            (warp + HEIGHT, side),
            (weft + HEIGHT, -side),
            (warp + WIDTH, -reaches[0].wider),
            (weft + WIDTH, -reaches[1].wider),
            (warp + THICKNESS, -reaches[0].thicker),
            (weft + THICKNESS, -reaches[1].thicker),
        ];
        block.add(weight, 1.0, residual, slopes);
    }
}

/// The upright reach of an ellipse under a slope, and its derivatives by the slope, the half width
/// and the half height.
struct Reach {
    reach: f32,
    steeper: f32,
    wider: f32,
    thicker: f32,
}

impl Reach {
    fn new(lie: &ThreadState, slope: f32) -> Self {
        let (x, z) = (lie.half_width * slope, lie.half_height);
        let reach = (x * x + z * z).sqrt();
        Self { reach, steeper: lie.half_width * x / reach, wider: x * slope / reach, thicker: z / reach }
    }
}

/// One thread at one crossing.
#[derive(Clone, Copy)]
struct Here<'a> {
    plan: &'a CrossingsPlan,
    pass: &'a CrossingsPass,
    all: &'a [CrossingState],
    site: Site,
    set: Set,
    /// Number of the thread's first unknown.
    row: usize,
}

impl Here<'_> {
    fn crossing(&self, site: Site) -> &CrossingState {
        &self.all[self.plan.number(site)]
    }

    fn thread(&self, site: Site) -> &ThreadState {
        self.crossing(site).thread(self.set)
    }

    fn along(&self, steps: i32) -> Option<Site> {
        self.plan.beside(self.site, self.set, steps, 0)
    }

    /// The distance from the crossing at `site` to the next one along the thread.
    fn pitch(&self, site: Site) -> f32 {
        self.way(self.set.other(), site, 1)
    }

    /// The distance from the thread of a set at `site` to the thread `steps` after it.
    fn way(&self, set: Set, site: Site, steps: i32) -> f32 {
        let rows = self.plan.rows(set);
        let mut way = rows[site.thread(set)].gap;
        for step in 1..steps {
            let next = self.plan.beside(site, set, 0, step);
            way += next.map_or(0.0, |next| rows[next.thread(set)].gap);
        }
        way
    }

    /// The nearest threads of `set` before (-1) and after (1) this crossing, on the level of the
    /// crossing's own thread of `set`. Each comes as the direction, and the distance in threads,
    /// which is 0 if there is no such thread.
    fn of_level(&self, set: Set) -> [(i32, i32); 2] {
        let [before, after] = self.plan.rows(set)[self.site.thread(set)].beside;
        [(-1, before), (1, after)]
    }

    /// The slope of the thread from the crossing to the one before or after, whichever is steeper.
    fn steepest(&self) -> f32 {
        let slope = |steps: i32| {
            self.along(steps).map_or(0.0, |other| {
                let pitch = self.pitch(if steps < 0 { other } else { self.site });
                ((self.thread(other).height - self.thread(self.site).height) / pitch).abs()
            })
        };
        slope(-1).max(slope(1))
    }

    fn thread_row(&self) -> &Row {
        &self.plan.rows(self.set)[self.site.thread(self.set)]
    }

    /// Adds the thread's own terms: shape, area, least area, and press.
    fn own(&self, block: &mut CrossingBlock) {
        let (lie, row) = (self.thread(self.site), self.row);
        let Row { radius, least_area, aspect, shape, .. } = *self.thread_row();
        let (wide, thick) = (lie.half_width / radius, lie.half_height / radius);
        let slopes = [(row + WIDTH, 1.0 / radius), (row + THICKNESS, -aspect / radius)];
        block.add(shape, 1.0, wide - aspect * thick, slopes);
        let gain = wide * thick - self.pass.area;
        // Near its full area a section grows no faster than a section above it shrinks. Otherwise
        // it would grow beyond its area in one pass, and shrink back in the next, without end.
        let weight = if gain < -NEAR { AREA_LOSS } else { AREA_GAIN };
        let residual = if gain < 0.0 { AREA_LOSS / weight * gain } else { gain };
        let slopes = [(row + WIDTH, thick / radius), (row + THICKNESS, wide / radius)];
        block.add(weight, 1.0, residual, slopes);
        let room = wide * thick - least_area * self.pass.area - MARGIN;
        if room < NEAR {
            block.add(SOLID * self.pass.penalty, 1.0, room.min(0.0), slopes);
        }
        let press = PRESS * self.plan.press() * 4.0 * radius * radius;
        block.add(press, 1.0, lie.height, [(row + HEIGHT, 1.0)]);
    }

    /// Adds bending: second differences along the thread, at this crossing and at the crossings
    /// before and after.
    fn bends(&self, block: &mut CrossingBlock) {
        let thread = self.thread_row();
        let square = 4.0 * thread.radius * thread.radius;
        for middle in [-1, 0, 1] {
            let sites = [middle - 1, middle, middle + 1].map(|steps| self.along(steps));
            let [Some(before), Some(at), Some(after)] = sites else { continue };
            let pitch = 0.5 * (self.pitch(before) + self.pitch(at));
            let stiff = thread.stiffness * square * square / (pitch * pitch * pitch);
            // The slopes of a second difference are 1, -2 and 1.
            let (slope, share) = if middle == 0 { (-2.0, 2.0) } else { (1.0, 4.0) };
            let [before, at, after] = [before, at, after].map(|site| self.thread(site));
            let bend = before.height - 2.0 * at.height + after.height;
            block.add(BEND * stiff, share, bend, [(self.row + HEIGHT, slope)]);
            let bend = before.shift - 2.0 * at.shift + after.shift;
            block.add(SIDEWAYS_BEND * stiff, share, bend, [(self.row + SHIFT, slope)]);
        }
    }

    /// Adds first differences along the thread: tension, and the evenness of sections. A taut
    /// thread that changes sides pulls apart the threads between which it does, so that ends and
    /// picks that work as one close up.
    fn steps(&self, block: &mut CrossingBlock) {
        let (lie, radius) = (self.thread(self.site), self.thread_row().radius);
        let tension = self.plan.tension(self.set) * 4.0 * radius * radius;
        let smooth = SMOOTH / (radius * radius);
        for steps in [-1, 1] {
            let Some(site) = self.along(steps) else { continue };
            let other = self.thread(site);
            let gap = self.pitch(if steps < 0 { site } else { self.site });
            let (taut, crossed, sign) = (tension / gap, self.set.other(), steps as f32);
            let [from, to] = [self.site, site].map(|site| self.crossing(site).thread(crossed).shift);
            let span = gap + sign * (to - from);
            let shorter = (gap / span).sqrt();
            let rise = shorter * (lie.height - other.height);
            let slopes = [(self.row + HEIGHT, shorter), (crossed.first() + SHIFT, 0.5 * sign * rise / span)];
            block.add(TENSION * taut, 2.0, rise, slopes);
            block.add(SIDEWAYS_TENSION * taut, 2.0, lie.shift - other.shift, [(self.row + SHIFT, 1.0)]);
            block.add(smooth, 2.0, lie.half_width - other.half_width, [(self.row + WIDTH, 1.0)]);
            block.add(smooth, 2.0, lie.half_height - other.half_height, [(self.row + THICKNESS, 1.0)]);
        }
    }

    /// Adds the clearance of the thread between this crossing and the one `steps` further along the
    /// thread.
    fn meeting(&self, block: &mut CrossingBlock, steps: i32) {
        let Some(other) = self.along(steps) else { return };
        let second = steps < 0;
        let sites = if second { [other, self.site] } else { [self.site, other] };
        let way = self.way(self.set.other(), sites[0], steps.abs());
        if self.plan.side(sites[0], self.set) == self.plan.side(sites[1], self.set) {
            self.shoulder(block, sites, way, second);
        } else {
            self.passage(block, sites, way, second);
        }
    }

    /// Adds the clearance of a thread that stays on its side between two crossings `way` apart. If
    /// it slopes, it must clear the shoulder of the thread under its upper end. `second` says
    /// whether this crossing is the second of the two.
    fn shoulder(&self, block: &mut CrossingBlock, sites: [Site; 2], way: f32, second: bool) {
        let crossed = self.set.other();
        let [first, last] = sites.map(|site| self.crossing(site));
        let side = self.plan.side(sites[0], self.set);
        let rise = side * (last.thread(self.set).height - first.thread(self.set).height);
        // A level thread clears the shoulder if it clears the thread where they cross. If rounding
        // chose one end of a level float as the upper one, mirrored cloth would not rest mirrored.
        if rise.abs() < NEAR {
            return;
        }
        let rises = rise > 0.0;
        let [upper, lower] = if rises { [last, first] } else { [first, last] };
        let (own, other, under) = (upper.thread(self.set), lower.thread(self.set), upper.thread(crossed));
        let across = way + last.thread(crossed).shift - first.thread(crossed).shift;
        let slope = side * (own.height - other.height) / across;
        // The thread's half height, measured upright, is longer by this factor than at right angles
        // to the slope.
        let length = (1.0 + slope * slope).sqrt();
        let Reach { reach, steeper, wider: widens, thicker: thickens } = Reach::new(under, slope);
        let above = side * (own.height - under.height);
        let need = reach + own.half_height * length;
        block.see(above / need);
        let room = above - need - MARGIN;
        if room < NEAR {
            let steeper = steeper + own.half_height * slope / length;
            let row = crossed.first();
            let wider = steeper * slope / across;
            let shift = (row + SHIFT, if second { wider } else { -wider });
            let rise = steeper / across;
            let (penalty, room) = (self.pass.penalty, room.min(0.0));
            if second == rises {
                let slopes = [
                    shift,
                    (self.row + HEIGHT, side * (1.0 - rise)),
                    (self.row + THICKNESS, -length),
                    (row + HEIGHT, -side),
                    (row + WIDTH, -widens),
                    (row + THICKNESS, -thickens),
                ];
                block.add(penalty, 2.0, room, slopes);
            } else {
                block.add(penalty, 2.0, room, [shift, (self.row + HEIGHT, side * rise)]);
            }
        }
    }

    /// Adds the clearance of a thread that changes sides between two crossings `way` apart.
    /// `second` says whether this crossing is the second of the two.
    fn passage(&self, block: &mut CrossingBlock, [first, last]: [Site; 2], way: f32, second: bool) {
        let side = self.plan.side(first, self.set);
        let crossed = self.set.other();
        let [one, two] = [first, last].map(|site| self.crossing(site).thread(crossed));
        let across = way + two.shift - one.shift;
        let rise = side * (two.height - one.height);
        let halves = [one, two].map(|lie| [lie.half_width, lie.half_height]);
        let thread = self.thread(first).half_height + self.thread(last).half_height;
        let passage = StraightPassage::new(across, rise, halves, thread);
        block.see(passage.clearance());
        let room = passage.room - MARGIN;
        if room < NEAR {
            let [c, s] = passage.slope;
            // The term's slopes by this crossing's unknowns.
            let (sign, lie, reach) =
                if second { (1.0, two, passage.reach[1]) } else { (-1.0, one, passage.reach[0]) };
            let row = crossed.first();
            let slopes = [
                (row + SHIFT, sign * s),
                (row + HEIGHT, sign * side * c),
                (row + WIDTH, -lie.half_width * s * s / reach),
                (row + THICKNESS, -lie.half_height * c * c / reach),
                (self.row + THICKNESS, -1.0),
            ];
            block.add(self.pass.penalty, 2.0, room.min(0.0), slopes);
        }
    }

    /// The distance from this thread's place to that of the thread `across` after it, or before it
    /// if `across` is negative.
    fn gap(&self, neighbour: Site, across: i32) -> f32 {
        let lower = if across < 0 { neighbour } else { self.site };
        self.way(self.set, lower, across.abs())
    }

    /// Adds the clearance of neighbours of one level. At a crossing they keep apart sideways,
    /// whatever their heights. Half way to the crossings beside it, they are clear as ellipses.
    fn neighbour(&self, block: &mut CrossingBlock, across: i32) {
        let Some(neighbour) = self.plan.beside(self.site, self.set, 0, across) else { return };
        if across == 0 {
            return;
        }
        let (lie, other, sign) = (self.thread(self.site), self.thread(neighbour), across.signum() as f32);
        let gap = self.gap(neighbour, across);
        let apart = gap + sign * (other.shift - lie.shift);
        let need = lie.half_width + other.half_width;
        block.see(apart / need);
        let room = apart - need - MARGIN;
        if room < NEAR {
            let slopes = [(self.row + SHIFT, -sign), (self.row + WIDTH, -1.0)];
            block.add(self.pass.penalty, 2.0, room.min(0.0), slopes);
        }
        for along in [-1, 1] {
            self.half_way(block, along, across, gap);
        }
    }

    /// Adds the clearance of neighbours of two levels: they lie side by side or one above the
    /// other, clear as ellipses.
    fn stacked(&self, block: &mut CrossingBlock, across: i32) {
        let Some(neighbour) = self.plan.beside(self.site, self.set, 0, across) else { return };
        let (lie, other, sign) = (self.thread(self.site), self.thread(neighbour), across as f32);
        let gap = self.gap(neighbour, across);
        let apart = gap + sign * (other.shift - lie.shift);
        let rise = other.height - lie.height;
        let ellipses = Ellipses {
            apart,
            rise,
            wide: lie.half_width + other.half_width,
            thick: lie.half_height + other.half_height,
        };
        self.keep_clear(block, &ellipses, sign, 1.0);
        for along in [-1, 1] {
            self.half_way(block, along, across, gap);
        }
    }

    /// Adds the clearance of neighbours `gap` apart half way between two crossings, where they are
    /// clear as ellipses.
    fn half_way(&self, block: &mut CrossingBlock, along: i32, across: i32, gap: f32) {
        let beside = |along, across| self.plan.beside(self.site, self.set, along, across);
        let sites = [beside(along, 0), beside(0, across), beside(along, across)];
        let [Some(next), Some(neighbour), Some(opposite)] = sites else { return };
        let lies = [self.site, next, neighbour, opposite].map(|site| *self.thread(site));
        let [own, next, neighbour, opposite] = lies;
        let sign = across.signum() as f32;
        let ellipses = Ellipses {
            apart: gap + sign * 0.5 * (neighbour.shift + opposite.shift - own.shift - next.shift),
            rise: 0.5 * (neighbour.height + opposite.height - own.height - next.height),
            wide: 0.5 * (own.half_width + next.half_width + neighbour.half_width + opposite.half_width),
            thick: 0.5 * (own.half_height + next.half_height + neighbour.half_height + opposite.half_height),
        };
        self.keep_clear(block, &ellipses, sign, 0.5);
    }

    /// Adds the clearance of two ellipses. `part` is the share of this crossing's thread in their
    /// sizes and places: 1 at the crossing, 0.5 half way to the next.
    fn keep_clear(&self, block: &mut CrossingBlock, ellipses: &Ellipses, sign: f32, part: f32) {
        let Ellipses { apart, rise, wide, thick } = *ellipses;
        let (x, z) = (apart / wide, rise / thick);
        let clearance = (x * x + z * z).sqrt();
        block.see(clearance);
        let room = (clearance - 1.0) * wide - MARGIN;
        if room < NEAR {
            let slopes = [
                (self.row + SHIFT, -sign * part * x / clearance),
                (self.row + HEIGHT, -part * z * wide / (thick * clearance)),
                (self.row + WIDTH, part * (clearance - 1.0 - x * x / clearance)),
                (self.row + THICKNESS, -part * z * z * wide / (thick * clearance)),
            ];
            // All crossings that the term depends on step at once.
            block.add(self.pass.penalty, 2.0 / part, room.min(0.0), slopes);
        }
    }
}

/// Two sections side by side: the way from the middle of one to that of the other, sideways
/// (`apart`) and upwards (`rise`), and the sums of both half widths (`wide`) and of both half
/// heights (`thick`).
struct Ellipses {
    apart: f32,
    rise: f32,
    wide: f32,
    thick: f32,
}
