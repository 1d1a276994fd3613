// The code that all stages share: tables, turns, the spline, frames and vertices.
//
// The formulas, the thresholds and the order of operations are those of texere-core (turn.rs,
// spline.rs, sampling.rs, frame.rs, ring.rs), and common.cl is the twin of this file. It is core
// WGSL, and requires no feature. texere-gpu writes two things before this file: the core's
// constants, such as BLOCK_RINGS, and FLATTENED, which is true if the code for yarns that are not
// round is needed.

// Rust: texere_core::Block, 32 bytes.
struct Block {
    yarn: u32,
    first_ring: u32,
    rings: u32,
    quads: u32,
    first_point: u32,
    chunk_ring: u32,
    first_vertex: u32,
    first_index: u32,
}

// Rust: texere_gpu::YarnRow, 24 bytes.
struct YarnRow {
    rings: u32,
    first_block: u32,
    section: u32,
    closed: u32,
    twist: f32,
    frame: u32,
}

// Rust: texere_gpu::CapRow, 32 bytes.
struct CapRow {
    yarn: u32,
    end: u32,
    first_point: u32,
    ring_vertex: u32,
    first_vertex: u32,
    first_index: u32,
    first_corner: u32,
    padding: u32,
}

// Rust: texere_gpu::Params, 48 bytes.
struct Params {
    blocks: u32,
    caps: u32,
    first_yarn: u32,
    yarns: u32,
    sides: u32,
    subdivisions: u32,
    leans: u32,
    indexed: u32,
    rolled: u32,
    s: f32,
    step: f32,
    quanta_per_mm: f32,
}

// A control point (Rust: ControlPoint) is a vec4<u32>: the bits of x, y, z, and two half floats,
// half width and half height. A section point (Rust: SectionPoint) is a vec4 of x, y, normal x,
// normal y. A ring (Rust: Ring) is three vec4<u32>: the bits of the centre and of the half width;
// the bits of the tangent, and the roll; the bits of the half height and of both growths, and the
// lean. A vertex (Rust: Vertex) is six floats: x y z nx ny nz.

// Points are bound from the start of the chunk's window.
@group(0) @binding(0) var<uniform> params: Params;
@group(0) @binding(1) var<storage, read> points: array<vec4<u32>>;
@group(0) @binding(2) var<storage, read> yarns: array<YarnRow>;
@group(0) @binding(3) var<storage, read> blocks: array<Block>;

// ---- Turn: an angle as a u32 fraction of a full turn ----

// An angle of `turns` full turns, reduced to one turn and rounded to the nearest step.
fn turn_from_turns(turns: f32) -> u32 {
    let wrapped = max(turns - floor(turns + 0.5), -0.5);
    return bitcast<u32>(i32(floor(wrapped * TURN_STEPS + 0.5)));
}

// Sine (x) and cosine (y) of a turn.
fn turn_sin_cos(turn: u32) -> vec2<f32> {
    let quarter = (turn + (1u << 29u)) >> 30u;
    let rest = bitcast<i32>(turn - (quarter << 30u));
    let x = f32(rest) * RADIANS_PER_STEP;
    let z = x * x;
    let sine = ((SINE_7 * z + SINE_5) * z + SINE_3) * z * x + x;
    let cosine = ((COSINE_8 * z + COSINE_6) * z + COSINE_4) * z * z - 0.5 * z + 1.0;
    switch quarter & 3u {
        case 0u: { return vec2(sine, cosine); }
        case 1u: { return vec2(cosine, -sine); }
        case 2u: { return vec2(-sine, -cosine); }
        default: { return vec2(-cosine, sine); }
    }
}

// The turn scaled by part / whole, rounded to the nearest step.
fn turn_share(turn: u32, part: u32, whole: u32) -> u32 {
    let steps = f32(bitcast<i32>(turn)) * (f32(part) / f32(whole));
    return bitcast<u32>(i32(floor(steps + 0.5)));
}

// The angle of (x, y) from the x axis as a fraction of a turn; 0 for (0, 0).
fn atan2_turns(y: f32, x: f32) -> f32 {
    let along = abs(x);
    let across = abs(y);
    let steep = across > along;
    let low = select(across, along, steep);
    let high = select(along, across, steep);
    if high == 0.0 {
        return 0.0;
    }
    let upper = low > TAN_EIGHTH * high;
    let numerator = select(low, low - high, upper);
    let denominator = select(high, low + high, upper);
    let eighth = select(0.0, 0.125, upper);
    let q = numerator / denominator;
    let z = q * q;
    let series = ((ARCTANGENT_9 * z + ARCTANGENT_7) * z + ARCTANGENT_5) * z + ARCTANGENT_3;
    let octant = eighth + (series * z * q + ARCTANGENT_1 * q);
    let quadrant = select(octant, 0.25 - octant, steep);
    let semicircle = select(quadrant, 0.5 - quadrant, x < 0.0);
    return select(semicircle, -semicircle, y < 0.0);
}

// ---- Segment: the spline between P[j] and P[j+1], relative to P[j] ----

struct Segment {
    // Position and half width of P[j].
    start: vec4<f32>,
    // P[j+1] - P[j].
    span: vec4<f32>,
    // Coefficients of t, t^2, t^3.
    c1: vec4<f32>,
    c2: vec4<f32>,
    c3: vec4<f32>,
    // The least half width.
    width_floor: f32,
    // Half height of P[j] with its coefficients, and the least half height. Both have values only
    // if yarns are FLATTENED.
    height: vec4<f32>,
    height_floor: f32,
    // A squared velocity up to this counts as zero.
    at_rest: f32,
}

struct Sample {
    // Centre relative to P[j].
    offset: vec3<f32>,
    centre: vec3<f32>,
    half_width: f32,
    half_height: f32,
    tangent: vec3<f32>,
    // Growth of the half width and of the half height along the yarn.
    width_growth: f32,
    height_growth: f32,
}

// Position and half width of a control point.
fn point_wide(point: vec4<u32>) -> vec4<f32> {
    return vec4(bitcast<vec3<f32>>(point.xyz), unpack2x16float(point.w).x);
}

// Half height of a control point.
fn point_height(point: vec4<u32>) -> f32 {
    return unpack2x16float(point.w).y;
}

// Coefficients of t (x), t^2 (y) and t^3 (z) for a size. `a`, `b` and `c` are the sizes at the
// point before, at the end and at the point after, each less the size at the start.
fn size_terms(a: f32, b: f32, c: f32, s: f32) -> vec3<f32> {
    return vec3((b - a) * s, a * (2.0 * s) + b * (3.0 - 2.0 * s) - c * s, (c - a) * s + b * (s - 2.0));
}

// The segment from its four control points, from number `first` on: before it, at its start, at its
// end, and after it.
fn segment_new(first: u32, s: f32) -> Segment {
    let before = points[first];
    let here = points[first + 1u];
    let next = points[first + 2u];
    let after = points[first + 3u];
    var segment: Segment;
    segment.start = point_wide(here);
    let a = point_wide(before) - segment.start;
    let b = point_wide(next) - segment.start;
    let c = point_wide(after) - segment.start;
    segment.span = b;
    segment.c1 = (b - a) * s;
    segment.c2 = a * (2.0 * s) + b * (3.0 - 2.0 * s) - c * s;
    segment.c3 = (c - a) * s + b * (s - 2.0);
    segment.width_floor = min(segment.start.w, point_wide(next).w) * RADIUS_FLOOR;
    if FLATTENED {
        let start = point_height(here);
        let end = point_height(next);
        segment.height =
            vec4(start, size_terms(point_height(before) - start, end - start, point_height(after) - start, s));
        segment.height_floor = min(start, end) * RADIUS_FLOOR;
    }
    segment.at_rest =
        max(ZERO_VELOCITY * (dot(a.xyz, a.xyz) + dot(b.xyz, b.xyz) + dot(c.xyz, c.xyz)), NO_LENGTH);
    return segment;
}

// A size at t (x), and its growth along the yarn (y). `inverse` is one over the spline's speed.
fn size_sample(start: f32, terms: vec3<f32>, least: f32, t: f32, inverse: f32) -> vec2<f32> {
    let size = start + (terms.x + (terms.y + terms.z * t) * t) * t;
    let growth = (terms.x + (terms.y * 2.0 + terms.z * (3.0 * t)) * t) * inverse;
    return select(vec2(size, clamp(growth, -SLOPE_LIMIT, SLOPE_LIMIT)), vec2(least, 0.0), size < least);
}

// The tangent where the velocity vanishes: the limit from the right, or from the left at t = 1.
fn direction_at_rest(segment: Segment, t: f32) -> vec3<f32> {
    let acceleration = (segment.c2.xyz + segment.c3.xyz * (3.0 * t)) * 2.0;
    let jerk = segment.c3.xyz * 6.0;
    let side = select(-1.0, 1.0, t < 1.0);
    let acceleration_squared = dot(acceleration, acceleration);
    let jerk_squared = dot(jerk, jerk);
    if acceleration_squared > segment.at_rest {
        return acceleration * (side / sqrt(acceleration_squared));
    }
    if jerk_squared > segment.at_rest {
        return jerk * (1.0 / sqrt(jerk_squared));
    }
    return vec3(1.0, 0.0, 0.0);
}

fn segment_sample(segment: Segment, t: f32) -> Sample {
    let offset = (segment.c1.xyz + (segment.c2.xyz + segment.c3.xyz * t) * t) * t;
    let velocity = segment.c1.xyz + (segment.c2.xyz * 2.0 + segment.c3.xyz * (3.0 * t)) * t;
    let speed_squared = dot(velocity, velocity);
    // If the spline stands still, nothing grows along it.
    var inverse = 0.0;
    var sample: Sample;
    if speed_squared > segment.at_rest {
        inverse = 1.0 / sqrt(speed_squared);
        sample.tangent = velocity * inverse;
    } else {
        sample.tangent = direction_at_rest(segment, t);
    }
    let width_terms = vec3(segment.c1.w, segment.c2.w, segment.c3.w);
    let width = size_sample(segment.start.w, width_terms, segment.width_floor, t, inverse);
    var height = width;
    if FLATTENED {
        height = size_sample(segment.height.x, segment.height.yzw, segment.height_floor, t, inverse);
    }
    sample.offset = offset;
    sample.centre = segment.start.xyz + offset;
    sample.half_width = width.x;
    sample.half_height = height.x;
    sample.width_growth = width.y;
    sample.height_growth = height.y;
    return sample;
}

// `part` / `whole`, rounded down. The result is exact for numbers as small as those of rings and
// sides. It takes much less time than an integer division.
fn quotient(part: u32, whole: u32) -> u32 {
    return u32((f32(part) + 0.5) * (1.0 / f32(whole)));
}

// ---- RingSample: the spline at a ring, with what the step to the next ring needs ----

struct RingSample {
    sample: Sample,
    // The interval's end relative to its start.
    span: vec3<f32>,
    // Whether the next ring is the first of the next interval.
    ends_interval: bool,
}

// The spline at ring number `k` of the block, counted from 0. `k` may also name the ring after the
// block's last.
fn ring_sample(yarn: YarnRow, block: Block, k: u32) -> RingSample {
    let per_interval = params.subdivisions + 1u;
    let place = block.first_ring % per_interval + k;
    let interval = quotient(place, per_interval);
    var point = block.first_point + interval;
    let part = place - interval * per_interval;
    var t = f32(part) * params.step;
    // The last ring of an open yarn is t = 1 of the interval before.
    if block.first_ring + k + 1u == yarn.rings && yarn.closed == 0u {
        point -= 1u;
        t = 1.0;
    }
    let segment = segment_new(point, params.s);
    var ring: RingSample;
    ring.sample = segment_sample(segment, t);
    ring.span = segment.span.xyz;
    ring.ends_interval = part + 1u == per_interval;
    return ring;
}

// The way from `here` to the next ring's centre, whose offset in its interval is `next_offset`.
fn chord_to(here: RingSample, next_offset: vec3<f32>) -> vec3<f32> {
    return select(next_offset, here.span, here.ends_interval) - here.sample.offset;
}

// The normal of a cap: the tangent at the yarn's end, pointing out of the yarn.
fn cap_normal(cap: CapRow) -> vec3<f32> {
    // The start is t = 0 of the first interval, the finish t = 1 of the last.
    let segment = segment_new(cap.first_point, params.s);
    let sample = segment_sample(segment, select(1.0, 0.0, cap.end == 0u));
    return sample.tangent * select(1.0, -1.0, cap.end == 0u);
}

// ---- Frame ----

struct Basis {
    side: vec3<f32>,
    up: vec3<f32>,
}

// The second axis of a section whose first axis is `side`: tangent x side.
fn up_of(tangent: vec3<f32>, side: vec3<f32>) -> vec3<f32> {
    return vec3(tangent.y * side.z - tangent.z * side.y, tangent.z * side.x - tangent.x * side.z,
                tangent.x * side.y - tangent.y * side.x);
}

// The upright basis: side is z x t, normalised, or +y if t is along z. up is t x side.
fn basis_upright(tangent: vec3<f32>) -> Basis {
    let level = tangent.x * tangent.x + tangent.y * tangent.y;
    var basis: Basis;
    if level < VERTICAL {
        basis.side = vec3(0.0, 1.0, 0.0);
    } else {
        let inverse = 1.0 / sqrt(level);
        basis.side = vec3(-tangent.y * inverse, tangent.x * inverse, 0.0);
    }
    basis.up = up_of(tangent, basis.side);
    return basis;
}

// The side of a section with the roll `roll`: the upright side, turned about the tangent towards
// up.
fn side_standing(tangent: vec3<f32>, roll: u32) -> vec3<f32> {
    let upright = basis_upright(tangent);
    if roll == 0u {
        return upright.side;
    }
    let sin_cos = turn_sin_cos(roll);
    return upright.side * sin_cos.y + upright.up * sin_cos.x;
}

// `v` mirrored in the plane at right angles to `mirror`.
fn mirrored(v: vec3<f32>, mirror: vec3<f32>, mirror_squared: f32) -> vec3<f32> {
    return v - mirror * (2.0 * dot(v, mirror) / mirror_squared);
}

// The angle, in turns, from the next ring's upright side to this ring's upright side carried there
// by double reflection (Wang, Juettler, Zheng and Liu 2008, table I).
fn transport_turns(tangent: vec3<f32>, next_tangent: vec3<f32>, chord: vec3<f32>) -> f32 {
    var side = basis_upright(tangent).side;
    let length_squared = dot(chord, chord);
    // If two rings coincide, the tangent is used in place of the chord.
    let apart = length_squared > NO_LENGTH;
    var mirror = select(tangent, chord, apart);
    var mirror_squared = select(1.0, length_squared, apart);
    side = mirrored(side, mirror, mirror_squared);
    let reflected_tangent = mirrored(tangent, mirror, mirror_squared);
    // At a hairpin the second reflection is the identity.
    mirror = next_tangent - reflected_tangent;
    mirror_squared = dot(mirror, mirror);
    if mirror_squared > NO_MIRROR {
        side = mirrored(side, mirror, mirror_squared);
    }
    let next = basis_upright(next_tangent);
    return atan2_turns(dot(side, next.up), dot(side, next.side));
}

// The change of roll from a ring to the next. `twist` is in turns per mm.
fn frame_step(frame: u32, tangent: vec3<f32>, next_tangent: vec3<f32>, chord: vec3<f32>, twist: f32) -> u32 {
    var turns = 0.0;
    if frame == ROTATION_MINIMIZING {
        turns = transport_turns(tangent, next_tangent, chord);
    }
    return turn_from_turns(turns + twist * sqrt(dot(chord, chord)));
}

// The roll of ring `ring`, if the steps up to it add up to `sum`. In a closed yarn each ring loses
// its share of the yarn's total turn, `whole`, so that the last ring has the roll of the first.
fn closed_up(yarn: YarnRow, ring: u32, sum: u32, whole: u32) -> u32 {
    let steps = yarn.rings - 1u;
    if yarn.closed == 0u {
        return sum;
    }
    return select(sum - turn_share(whole, ring, steps), 0u, ring == steps);
}

// ---- Vertex ----

// How a section stands on a ring. All vertices of the ring share it.
struct Stance {
    // Centre, half width.
    centre: vec4<f32>,
    // Unit tangent, growth of the half width.
    tangent: vec4<f32>,
    side: vec3<f32>,
    up: vec3<f32>,
    // Half height and its growth; sine and cosine of the roll less the lean. Both are used only if
    // yarns are FLATTENED.
    height: vec2<f32>,
    sin_cos: vec2<f32>,
    round: bool,
}

// Whether a yarn is round at a ring, and stays round there. `width` is the half width and its
// growth, `height` the half height and its growth. Round rings are worked out in the same way
// whether other yarns are FLATTENED or not, so that no vertex depends on other yarns.
fn is_round(width: vec2<f32>, height: vec2<f32>) -> bool {
    return !FLATTENED || all(width == height);
}

// The side of a section. A round section turns with the roll. The outline of a flattened section
// leans, and the section turns inside its outline.
fn side_of(tangent: vec3<f32>, roll: u32, lean: u32, round: bool) -> vec3<f32> {
    return side_standing(tangent, select(lean, roll, round));
}

// The stance of a section. `side` is the result of `side_of`, `height` is the half height and its
// growth, and `sin_cos` are the sine and cosine of the roll less the lean.
fn stance_new(centre: vec4<f32>, tangent: vec4<f32>, side: vec3<f32>, height: vec2<f32>, sin_cos: vec2<f32>) -> Stance {
    var stance: Stance;
    stance.centre = centre;
    stance.tangent = tangent;
    stance.side = side;
    stance.up = up_of(tangent.xyz, side);
    stance.height = height;
    stance.sin_cos = sin_cos;
    stance.round = is_round(vec2(centre.w, tangent.w), height);
    return stance;
}

// `q`, turned by the roll less the lean.
fn rolled(stance: Stance, q: vec2<f32>) -> vec2<f32> {
    return vec2(stance.sin_cos.y * q.x - stance.sin_cos.x * q.y, stance.sin_cos.x * q.x + stance.sin_cos.y * q.y);
}

// The position of the vertex at `point` of a section.
fn position_at(stance: Stance, point: vec4<f32>) -> vec3<f32> {
    if !stance.round {
        let q = rolled(stance, point.xy);
        return stance.centre.xyz + (stance.side * (q.x * stance.centre.w) + stance.up * (q.y * stance.height.x));
    }
    let outward = stance.side * point.x + stance.up * point.y;
    return stance.centre.xyz + outward * stance.centre.w;
}

// The normal of the vertex at `point` of a section.
fn normal_at(stance: Stance, point: vec4<f32>) -> vec3<f32> {
    let tangent = stance.tangent;
    if !stance.round {
        let q = rolled(stance, point.xy);
        // The x component is multiplied by the half height, the y component by the half width. This
        // is the inverse transpose of the scaling by both, times their product.
        let normal = rolled(stance, point.zw) * vec2(stance.height.x, stance.centre.w);
        let lean = tangent.w * q.x * normal.x + stance.height.y * q.y * normal.y;
        let inverse = 1.0 / sqrt(normal.x * normal.x + normal.y * normal.y + lean * lean);
        let across = stance.side * (normal.x * inverse) + stance.up * (normal.y * inverse);
        return across - tangent.xyz * (lean * inverse);
    }
    let across = stance.side * point.z + stance.up * point.w;
    // If the radius is constant, no square root is needed.
    if tangent.w == 0.0 {
        return across;
    }
    let lean = tangent.w * (point.x * point.z + point.y * point.w);
    return (across - tangent.xyz * lean) * (1.0 / sqrt(1.0 + lean * lean));
}
