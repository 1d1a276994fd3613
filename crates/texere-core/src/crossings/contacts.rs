//! The terms of the energy that keep threads clear of one another ([`super::terms`] lists them).

use super::here::{HEIGHT, Here, SHIFT, THICKNESS, WIDTH};
use super::passage::Opening;
use super::{CrossingBlock, Set, Site, ThreadState};

/// The distance by which threads are kept apart, in units, because penalties give way a little.
/// With half the value, `turns_do_not_fold` is red; with twice,
/// `plied_threads_rest_near_single_ones`.
pub const MARGIN: f32 = 0.006;

/// The distance, in units, below which threads that do not touch yet make each other's steps
/// shorter. They do not push one another. With 0, contacts come and go and the threads keep
/// swinging: a plain weave at its jam does not come to rest (`cloths_of_the_mills_come_to_rest`,
/// `energy_goes_down_while_penalties_stay`).
pub const NEAR: f32 = 0.02;

/// The weight of the gap between the two threads of a crossing, if both belong to one layer.
/// Without it, threads of dense cloth stand off one another where they cross, because a thread fits
/// between others more easily the further these are apart in height. The threads then pierce one
/// another on their way to the next crossing: 2/2 twill at 1.14 times Ashenhurst's sett comes to a
/// clearance of 0.85 without the weight, and to 0.985 with a weight of 100. 10, 30, 100 and 300
/// were tried. With 30, denim folds where it binds (`cloths_of_the_mills_come_to_rest` of
/// texere-fabric).
pub const TOUCH: f32 = 100.0;

/// The slope of a layer's thread, divided by that of the straight line between two crossings. The
/// thread is steeper because it bends where it binds. With half the value, and with twice,
/// `layers_lie_on_one_another` is red.
pub const STEEPER: f32 = 1.4;

/// The contact of both threads of a crossing: one lies on top of the other. If both belong to one
/// layer, they touch.
pub(super) struct Contact<'a> {
    threads: &'a [Here<'a>; 2],
    /// The side of the end, 1 on the face and -1 on the back.
    side: f32,
    /// How far the thread on top lies above the other.
    apart: f32,
    reaches: [Reach; 2],
}

impl<'a> Contact<'a> {
    pub(super) fn new(threads: &'a [Here<'a>; 2]) -> Self {
        let [warp, weft] = threads;
        let Here { plan, site, .. } = *warp;
        let (end, pick, side) = (warp.thread(site), weft.thread(site), plan.side(site, Set::Warp));
        // Threads of two layers slope where they cross. Along the slope of the other thread an
        // ellipse reaches further.
        let is_steep = plan.neighbours(site).are_apart();
        let reaches = [(end, weft), (pick, warp)]
            .map(|(lie, other)| Reach::new(lie, if is_steep { STEEPER * other.steepest() } else { 0.0 }));
        Self { threads, side, apart: side * (end.height - pick.height), reaches }
    }

    const fn need(&self) -> f32 {
        self.reaches[0].reach + self.reaches[1].reach
    }

    /// The distance of both threads, divided by the distance that they need.
    pub(super) const fn clearance(&self) -> f32 {
        self.apart / self.need()
    }

    /// Adds the contact's term, if both threads are near or touch.
    pub(super) fn add(&self, block: &mut CrossingBlock) {
        let Self { threads: [warp, weft], side, reaches, .. } = self;
        let Here { plan, pass, site, .. } = *warp;
        let room = self.apart - self.need() - MARGIN;
        let (is_near, pull) = (room < NEAR, if plan.neighbours(site).touch() { TOUCH } else { 0.0 });
        if is_near || pull > 0.0 {
            let weight = if is_near { pass.penalty } else { pull };
            let residual = if room < 0.0 { room } else { pull / weight * room };
            let [warp, weft] = [warp.row, weft.row];
            let slopes = [
                (warp + HEIGHT, *side),
                (weft + HEIGHT, -side),
                (warp + WIDTH, -reaches[0].wider),
                (weft + WIDTH, -reaches[1].wider),
                (warp + THICKNESS, -reaches[0].thicker),
                (weft + THICKNESS, -reaches[1].thicker),
            ];
            block.add(weight, 1.0, residual, slopes);
        }
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

impl Here<'_> {
    /// Adds the clearance of the thread between this crossing and the one `steps` further along the
    /// thread.
    pub(super) fn meeting(&self, block: &mut CrossingBlock, steps: i32) {
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
        let opening = Opening { across, rise, halves, thread };
        let (start, room) = opening.start();
        // Most passages leave plenty of room at the first slope, and Newton's method finds no less.
        // Such a passage adds no force. It is left out unless its clearance may be the least.
        let is_roomy = across > 0.0 && room - MARGIN > NEAR;
        if is_roomy && block.clearance < 1.0 + room / opening.need_most() {
            return;
        }
        let passage = opening.straight(start);
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
    pub(super) fn neighbour(&self, block: &mut CrossingBlock, across: i32) {
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
    pub(super) fn stacked(&self, block: &mut CrossingBlock, across: i32) {
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
    /// clear as ellipses. Two threads with others between them are neighbours only if they are of
    /// one level. They have to be so at both crossings, because levels change where layers change
    /// places.
    fn half_way(&self, block: &mut CrossingBlock, along: i32, across: i32, gap: f32) {
        let beside = |along, across| self.plan.beside(self.site, self.set, along, across);
        let Some(next) = beside(along, 0) else { return };
        let Some(neighbour) = beside(0, across) else { return };
        let Some(opposite) = beside(along, across) else { return };
        let listed = self.plan.neighbours(next).beside[self.set as usize][usize::from(across > 0)];
        if across.abs() > 1 && across.abs() != i32::from(listed) {
            return;
        }
        let (own, next) = (self.thread(self.site), self.thread(next));
        let (neighbour, opposite) = (self.thread(neighbour), self.thread(opposite));
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
        // Most neighbours have plenty of room side by side, whatever their heights.
        if apart > wide + MARGIN + NEAR && apart > block.clearance * wide {
            return;
        }
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
