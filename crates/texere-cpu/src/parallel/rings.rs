//! Stage 1 in lanes: consecutive rings of a yarn, a vector of them at a time.
//!
//! The formulas and their order are those of `Segment` and `Basis` in the core, so the bits are the
//! same. The core branches for rare cases: a place where the spline's velocity counts as zero, a
//! tangent along z, an open yarn's last ring. The lanes only detect a ring of the first two kinds,
//! and call the core's own functions for it. An open yarn's last ring gets a seat of its own. A
//! seat ([`Seats`]) is a ring's interval and its parameter there. The core makes the last ring only
//! if it is the first of a vector.

use texere_core::ControlPoint;
use texere_core::backend::{Block, PaddedPoints, Plan};
use texere_core::definitions::{Basis, Ring, Sample, VERTICAL};

use super::simd::{Floats, Integers, LANES_MAX, Mask, Simd, dot, plus, scale};
use super::spline::{Cubics, Seats, all_round, held_size, xyz};

/// The input that rings are made from.
#[derive(Debug, Clone, Copy)]
pub(super) struct Source<'a> {
    pub(super) plan: &'a Plan,
    pub(super) points: &'a PaddedPoints,
    /// For each place in an interval at which the first ring of a vector can lie: the seats of the
    /// vector's rings.
    pub(super) seats: &'a [Seats],
}

impl<'a> Source<'a> {
    /// The padded control points, from the first of `yarn` on.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn yarn(&self, yarn: usize) -> &'a [[f32; 4]] {
        let points = &self.points.points()[self.plan.padded_offsets()[yarn] as usize..];
        bytemuck::cast_slice::<ControlPoint, _>(points)
    }

    /// Whether no ring of `stretch` can be flattened.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn all_round(&self, stretch: Stretch) -> bool {
        let (points, per_interval) = (self.yarn(stretch.yarn), self.seats.len());
        let first = stretch.first as usize / per_interval;
        // The end of the points that the last ring reads: its interval's first point and the three
        // after it. An open yarn's last ring has no interval of its own.
        let end = (stretch.first + stretch.count - 1) as usize / per_interval + 4;
        all_round(&points[first..end.min(points.len())])
    }
}

/// Consecutive rings of one yarn.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stretch {
    pub(super) yarn: usize,
    pub(super) first: u32,
    pub(super) count: u32,
}

impl Stretch {
    /// The rings of `blocks`, consecutive blocks of one yarn.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn of(blocks: &[Block]) -> Self {
        let (yarn, first) = (blocks[0].yarn as usize, blocks[0].first_ring);
        Self { yarn, first, count: blocks.iter().map(|block| block.rings).sum() }
    }
}

/// A vector of consecutive rings, with all that their vertices need. Without `FLATTENED` all rings
/// are treated as round.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rings<S: Simd, const FLATTENED: bool> {
    pub(super) centre: [S::Floats; 3],
    pub(super) half_width: S::Floats,
    pub(super) half_height: S::Floats,
    pub(super) tangent: [S::Floats; 3],
    pub(super) width_growth: S::Floats,
    pub(super) height_growth: S::Floats,
    /// The side of the section's frame. The frame is turned by the roll if the ring is round, and
    /// upright if it is flattened.
    pub(super) side: [S::Floats; 3],
    /// The up of the section's frame.
    pub(super) up: [S::Floats; 3],
    /// Sine and cosine of the roll.
    pub(super) roll: (S::Floats, S::Floats),
    /// The centre relative to the interval's start, mm. Chords are made from `offset` and `span`.
    pub(super) offset: [S::Floats; 3],
    /// The end of the interval relative to its start, mm.
    pub(super) span: [S::Floats; 3],
    /// The parameter of the ring in its interval: zero where the interval starts.
    pub(super) t: S::Floats,
}

/// Goes along a stretch, a vector of upright rings at a time.
#[derive(Debug)]
pub(super) struct Walk<'a, S: Simd, const FLATTENED: bool> {
    simd: S,
    source: Source<'a>,
    stretch: Stretch,
    points: &'a [[f32; 4]],
    /// The number of rings of the stretch that are done.
    pub(super) done: u32,
    /// The interval of the next ring.
    interval: usize,
    /// The place of the next ring in its interval.
    place: usize,
    /// The intervals and places by which a vector advances.
    stride: (usize, usize),
    /// The cubics of the intervals from number `first_cubic` on.
    cubics: Cubics<S>,
    first_cubic: usize,
}

impl<'a, S: Simd, const FLATTENED: bool> Walk<'a, S, FLATTENED> {
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn new(simd: S, source: Source<'a>, stretch: Stretch) -> Self {
        let Source { plan, seats, .. } = source;
        let points = source.yarn(stretch.yarn);
        let per_interval = seats.len();
        let interval = stretch.first as usize / per_interval;
        Self {
            simd,
            source,
            stretch,
            points,
            done: 0,
            interval,
            place: stretch.first as usize % per_interval,
            stride: (S::LANES / per_interval, S::LANES % per_interval),
            cubics: Cubics::new::<FLATTENED>(simd, points, interval, plan.sampling().s()),
            first_cubic: interval,
        }
    }

    /// The number of rings in the next vector; 0 at the end.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn left(&self) -> usize {
        ((self.stretch.count - self.done) as usize).min(S::LANES)
    }

    /// The next vector of rings. Lanes past the end of the stretch have no meaning.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn next(&mut self) -> Rings<S, FLATTENED> {
        let (simd, Source { plan, seats: at_place, .. }) = (self.simd, self.source);
        let seats = &at_place[self.place];
        let last = (self.stretch.count - self.done <= S::LANES as u32)
            .then(|| seats_at_end(plan, self.stretch, self.done, seats));
        if self.interval + seats.interval[S::LANES - 1] as usize >= self.first_cubic + S::LANES {
            self.first_cubic = self.interval;
            self.cubics = Cubics::new::<FLATTENED>(simd, self.points, self.interval, plan.sampling().s());
        }
        let behind = simd.splat_integer((self.interval - self.first_cubic) as u32);
        let (taken, first_rare) = last.as_ref().map_or((seats, 0), |(at_end, rare)| (at_end, *rare));
        let interval = simd.load_integers(&taken.interval) + behind;
        let t = simd.load(&taken.t);
        let (mut rings, rare) = upright::<S, FLATTENED>(simd, &self.cubics, interval, t);
        rings.t = simd.load(&seats.t);
        if rare | first_rare != 0 {
            rings = self.mended(rings, rare | first_rare);
        }

        self.done += self.left() as u32;
        let (intervals, place) = self.stride;
        self.interval += intervals;
        self.place += place;
        if self.place >= at_place.len() {
            self.place -= at_place.len();
            self.interval += 1;
        }
        rings
    }

    /// Replaces each ring whose bit is set in `rare` by the ring that the core makes.
    #[cfg_attr(optimized, inline(always))]
    fn mended(&self, rings: Rings<S, FLATTENED>, rare: u32) -> Rings<S, FLATTENED> {
        let mut fields = rings.fields();
        let mut lanes = Lanes([[0.0; LANES_MAX]; FIELDS]);
        for (field, lane) in fields.iter().zip(&mut lanes.0) {
            field.store(lane);
        }
        // A copy is passed on, so that the walk itself need not lie in memory.
        let source = self.source;
        mend(&source, self.stretch, self.done, rare, &mut lanes);
        for (field, lane) in fields.iter_mut().zip(&lanes.0) {
            *field = self.simd.load(lane);
        }
        rings.with_fields(fields)
    }
}

/// The number of a ring's fields that are replaced if the core makes the ring.
const FIELDS: usize = 16;

/// The fields of a vector of rings in memory. They are aligned as vectors are. The compiler then
/// aligns the stack frame that holds them, and with it all vectors that it spills there.
#[repr(align(64))]
struct Lanes([[f32; LANES_MAX]; FIELDS]);

impl<S: Simd, const FLATTENED: bool> Rings<S, FLATTENED> {
    /// Writes the rings to the first `LANES` places of `out`.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn store(&self, simd: S, roll: S::Integers, out: &mut [Ring]) {
        const FLOATS: usize = size_of::<Ring>() / size_of::<f32>();
        let out: &mut [f32] = bytemuck::cast_slice_mut(out);
        let ([cx, cy, cz], [tx, ty, tz]) = (self.centre, self.tangent);
        let sizes = [self.half_height, self.width_growth, self.height_growth, simd.splat(0.0)];
        simd.scatter([cx, cy, cz, self.half_width], out, FLOATS);
        simd.scatter([tx, ty, tz, roll.bit_cast()], &mut out[FLOATS / 3..], FLOATS);
        simd.scatter(sizes, &mut out[FLOATS / 3 * 2..], FLOATS);
    }

    /// The rings that are round by the definition of `Ring::is_round` in the core.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn round(&self) -> S::Mask {
        let apart = (self.half_width - self.half_height).abs();
        (apart + (self.width_growth - self.height_growth).abs()).is_zero()
    }

    /// The rings whose half widths and half heights don't grow.
    #[cfg_attr(optimized, inline(always))]
    pub(super) fn steady(&self) -> S::Mask {
        (self.width_growth.abs() + self.height_growth.abs()).is_zero()
    }

    #[cfg_attr(optimized, inline(always))]
    fn fields(&self) -> [S::Floats; FIELDS] {
        let ([cx, cy, cz], [tx, ty, tz]) = (self.centre, self.tangent);
        let ([sx, sy, sz], [ux, uy, uz]) = (self.side, self.up);
        let Self { half_width, half_height, width_growth, height_growth, .. } = *self;
        [cx, cy, cz, half_width, half_height, tx, ty, tz, width_growth, height_growth, sx, sy, sz, ux, uy, uz]
    }

    #[cfg_attr(optimized, inline(always))]
    fn with_fields(self, fields: [S::Floats; FIELDS]) -> Self {
        let [cx, cy, cz, half_width, half_height, tx, ty, tz, width_growth, height_growth, frame @ ..] =
            fields;
        let ([sx, sy, sz, ux, uy, uz], centre, tangent) = (frame, [cx, cy, cz], [tx, ty, tz]);
        let (side, up) = ([sx, sy, sz], [ux, uy, uz]);
        let (half_height, height_growth) =
            if FLATTENED { (half_height, height_growth) } else { (half_width, width_growth) };
        Self { centre, half_width, half_height, tangent, width_growth, height_growth, side, up, ..self }
    }
}

/// The seats of the last vector of a stretch, and a bit for each ring that the core has to make. If
/// the vector ends an open yarn, the yarn's last ring is put at the end of the interval before its
/// seat. If this ring is the vector's first, the vector does not have that interval, and the ring's
/// bit is set instead. All other rings have `seats`.
#[cold]
#[inline(never)]
fn seats_at_end(plan: &Plan, stretch: Stretch, done: u32, seats: &Seats) -> (Seats, u32) {
    let mut seats = Seats { ..*seats };
    if plan.yarn(stretch.yarn).closed || stretch.first + stretch.count < plan.rings(stretch.yarn) {
        return (seats, 0);
    }
    let lane = (stretch.count - done - 1) as usize;
    if lane == 0 {
        return (seats, 1);
    }
    seats.interval[lane] -= 1;
    seats.t[lane] = 1.0;
    (seats, 0)
}

#[cold]
#[inline(never)]
fn mend(source: &Source<'_>, stretch: Stretch, done: u32, rare: u32, lanes: &mut Lanes) {
    let Source { plan, points, .. } = *source;
    let (yarn, rings) = (stretch.yarn, plan.rings(stretch.yarn));
    let (padded, closed) = (points.yarn(plan, yarn), plan.yarn(yarn).closed);
    for (lane, ring) in (done..stretch.count).take(LANES_MAX).map(|k| stretch.first + k).enumerate() {
        if rare >> lane & 1 == 1 {
            let sample = plan.sampling().sample(padded, ring, rings, closed).sample;
            let (c, t, basis) = (sample.centre, sample.tangent, Basis::upright(sample.tangent));
            let (s, u) = (basis.side, basis.up);
            let Sample { half_width, half_height, width_growth, height_growth, .. } = sample;
            let place = [c.x, c.y, c.z, half_width, half_height, t.x, t.y, t.z, width_growth, height_growth];
            let new = place.into_iter().chain([s.x, s.y, s.z, u.x, u.y, u.z]);
            for (field, value) in lanes.0.iter_mut().zip(new) {
                field[lane] = value;
            }
        }
    }
}

/// Upright rings at `t` of each lane's interval, which is number `interval` of `cubics`. A bit is
/// set for each ring that the core has to make.
#[cfg_attr(optimized, inline(always))]
fn upright<S: Simd, const FLATTENED: bool>(
    simd: S,
    cubics: &Cubics<S>,
    interval: S::Integers,
    t: S::Floats,
) -> (Rings<S, FLATTENED>, u32) {
    let (one, zero) = (simd.splat(1.0), simd.splat(0.0));
    let sampled = cubics.sample(simd, interval, t);
    let (offset, velocity) = (xyz(sampled.offset), xyz(sampled.velocity));

    let speed_squared = dot(velocity, velocity);
    let moves = sampled.at_rest.less(speed_squared);
    let speed_inverse = one / speed_squared.sqrt();
    let tangent = scale(velocity, speed_inverse);
    let size = sampled.start[3] + sampled.offset[3];
    let (half, growth) = held_size(simd, size, sampled.floor, sampled.velocity[3] * speed_inverse);

    let [x, y, z] = tangent;
    let level = x * x + y * y;
    let vertical = level.less(simd.splat(VERTICAL));
    let inverse = one / level.sqrt();
    let (side_x, side_y) = (-y * inverse, x * inverse);
    let mut rings = Rings {
        centre: plus(xyz(sampled.start), offset),
        half_width: half,
        half_height: half,
        tangent,
        width_growth: growth,
        height_growth: growth,
        side: [side_x, side_y, zero],
        up: [-z * side_y, z * side_x, x * side_y - y * side_x],
        roll: (zero, one),
        offset,
        span: sampled.span,
        t,
    };
    if FLATTENED {
        (rings.half_width, rings.width_growth) = cubics.half_width.sample(simd, interval, t, speed_inverse);
    }
    (rings, (moves.bits() ^ S::ALL) | vertical.bits())
}
