// The code that all stages share: tables, turns, the spline, frames and vertices.
//
// The formulas, the thresholds and the order of operations are those of texere-core (turn.rs,
// spline.rs, sampling.rs, frame.rs, ring.rs), and common.wgsl is the twin of this file. It is
// OpenCL C 1.2 without extensions. texere-gpu writes two things before this file: the core's
// constants, such as BLOCK_RINGS, and FLATTENED, which is true if the code for yarns that are not
// round is needed.

#pragma OPENCL FP_CONTRACT OFF

// Rust: texere_core::Block, 32 bytes.
typedef struct {
    uint yarn;
    uint first_ring;
    uint rings;
    uint quads;
    uint first_point;
    uint chunk_ring;
    uint first_vertex;
    uint first_index;
} Block;

// Rust: texere_gpu::YarnRow, 24 bytes.
typedef struct {
    uint rings;
    uint first_block;
    uint section;
    uint closed;
    float twist;
    uint frame;
} YarnRow;

// Rust: texere_gpu::CapRow, 32 bytes.
typedef struct {
    uint yarn;
    uint end;
    uint first_point;
    uint ring_vertex;
    uint first_vertex;
    uint first_index;
    uint first_corner;
    uint padding;
} CapRow;

// Rust: texere_gpu::Params, 48 bytes.
typedef struct {
    uint blocks;
    uint caps;
    uint first_yarn;
    uint yarns;
    uint sides;
    uint subdivisions;
    uint leans;
    uint indexed;
    uint rolled;
    float s;
    float step;
    float quanta_per_mm;
} Params;

// A control point (Rust: ControlPoint) is a uint4: the bits of x, y, z, and two half floats, half
// width and half height. A section point (Rust: SectionPoint) is a float4 of x, y, normal x, normal
// y. A ring (Rust: Ring) is three uint4: the bits of the centre and of the half width; the bits of
// the tangent, and the roll; the bits of the half height and of both growths, and the lean. A
// vertex (Rust: Vertex) is six floats: x y z nx ny nz.

float dot3(float3 a, float3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

// ---- Turn: an angle as a u32 fraction of a full turn ----

// An angle of `turns` full turns, reduced to one turn and rounded to the nearest step.
uint turn_from_turns(float turns) {
    float wrapped = max(turns - floor(turns + 0.5f), -0.5f);
    return as_uint(convert_int_sat(floor(wrapped * TURN_STEPS + 0.5f)));
}

// Sine (x) and cosine (y) of a turn.
float2 turn_sin_cos(uint turn) {
    uint quarter = (turn + (1u << 29)) >> 30;
    int rest = as_int(turn - (quarter << 30));
    float x = (float)rest * RADIANS_PER_STEP;
    float z = x * x;
    float sine = ((SINE_7 * z + SINE_5) * z + SINE_3) * z * x + x;
    float cosine = ((COSINE_8 * z + COSINE_6) * z + COSINE_4) * z * z - 0.5f * z + 1.0f;
    switch (quarter & 3u) {
        case 0u: return (float2)(sine, cosine);
        case 1u: return (float2)(cosine, -sine);
        case 2u: return (float2)(-sine, -cosine);
        default: return (float2)(-cosine, sine);
    }
}

// The turn scaled by part / whole, rounded to the nearest step.
uint turn_share(uint turn, uint part, uint whole) {
    float steps = (float)as_int(turn) * ((float)part / (float)whole);
    return as_uint(convert_int_sat(floor(steps + 0.5f)));
}

// The angle of (x, y) from the x axis as a fraction of a turn; 0 for (0, 0).
float atan2_turns(float y, float x) {
    float along = fabs(x);
    float across = fabs(y);
    bool steep = across > along;
    float low = steep ? along : across;
    float high = steep ? across : along;
    if (high == 0.0f) {
        return 0.0f;
    }
    bool upper = low > TAN_EIGHTH * high;
    float numerator = upper ? low - high : low;
    float denominator = upper ? low + high : high;
    float eighth = upper ? 0.125f : 0.0f;
    float q = numerator / denominator;
    float z = q * q;
    float series = ((ARCTANGENT_9 * z + ARCTANGENT_7) * z + ARCTANGENT_5) * z + ARCTANGENT_3;
    float octant = eighth + (series * z * q + ARCTANGENT_1 * q);
    float quadrant = steep ? 0.25f - octant : octant;
    float semicircle = x < 0.0f ? 0.5f - quadrant : quadrant;
    return y < 0.0f ? -semicircle : semicircle;
}

// ---- Segment: the spline between P[j] and P[j+1], relative to P[j] ----

typedef struct {
    // Position and half width of P[j].
    float4 start;
    // P[j+1] - P[j].
    float4 span;
    // Coefficients of t, t^2, t^3.
    float4 c1;
    float4 c2;
    float4 c3;
    // The least half width.
    float width_floor;
    // Half height of P[j] with its coefficients, and the least half height. Both have values only
    // if yarns are FLATTENED.
    float4 height;
    float height_floor;
    // A squared velocity up to this counts as zero.
    float at_rest;
} Segment;

typedef struct {
    // Centre relative to P[j].
    float3 offset;
    float3 centre;
    float half_width;
    float half_height;
    float3 tangent;
    // Growth of the half width and of the half height along the yarn.
    float width_growth;
    float height_growth;
} Sample;

// Position and half width of a control point.
float4 point_wide(uint4 point) {
    uint halves = point.w;
    return (float4)(as_float(point.x), as_float(point.y), as_float(point.z), vload_half(0, (const half *)&halves));
}

// Half height of a control point.
float point_height(uint4 point) {
    uint halves = point.w;
    return vload_half(1, (const half *)&halves);
}

// Coefficients of t (x), t^2 (y) and t^3 (z) for a size. `a`, `b` and `c` are the sizes at the
// point before, at the end and at the point after, each less the size at the start.
float3 size_terms(float a, float b, float c, float s) {
    return (float3)((b - a) * s, a * (2.0f * s) + b * (3.0f - 2.0f * s) - c * s, (c - a) * s + b * (s - 2.0f));
}

// The segment from its four control points: before it, at its start, at its end, and after it.
Segment segment_new(__global const uint4 *points, float s) {
    uint4 before = points[0];
    uint4 here = points[1];
    uint4 next = points[2];
    uint4 after = points[3];
    Segment segment;
    segment.start = point_wide(here);
    float4 a = point_wide(before) - segment.start;
    float4 b = point_wide(next) - segment.start;
    float4 c = point_wide(after) - segment.start;
    segment.span = b;
    segment.c1 = (b - a) * s;
    segment.c2 = a * (2.0f * s) + b * (3.0f - 2.0f * s) - c * s;
    segment.c3 = (c - a) * s + b * (s - 2.0f);
    segment.width_floor = min(segment.start.w, point_wide(next).w) * RADIUS_FLOOR;
    if (FLATTENED) {
        float start = point_height(here);
        float end = point_height(next);
        segment.height =
            (float4)(start, size_terms(point_height(before) - start, end - start, point_height(after) - start, s));
        segment.height_floor = min(start, end) * RADIUS_FLOOR;
    }
    segment.at_rest =
        max(ZERO_VELOCITY * (dot3(a.xyz, a.xyz) + dot3(b.xyz, b.xyz) + dot3(c.xyz, c.xyz)), NO_LENGTH);
    return segment;
}

// A size at t (x), and its growth along the yarn (y). `inverse` is one over the spline's speed.
float2 size_sample(float start, float3 terms, float least, float t, float inverse) {
    float size = start + (terms.x + (terms.y + terms.z * t) * t) * t;
    float growth = (terms.x + (terms.y * 2.0f + terms.z * (3.0f * t)) * t) * inverse;
    return size < least ? (float2)(least, 0.0f) : (float2)(size, clamp(growth, -SLOPE_LIMIT, SLOPE_LIMIT));
}

// The tangent where the velocity vanishes: the limit from the right, or from the left at t = 1.
float3 direction_at_rest(const Segment *segment, float t) {
    float3 acceleration = (segment->c2.xyz + segment->c3.xyz * (3.0f * t)) * 2.0f;
    float3 jerk = segment->c3.xyz * 6.0f;
    float side = t < 1.0f ? 1.0f : -1.0f;
    float acceleration_squared = dot3(acceleration, acceleration);
    float jerk_squared = dot3(jerk, jerk);
    if (acceleration_squared > segment->at_rest) {
        return acceleration * (side / sqrt(acceleration_squared));
    }
    if (jerk_squared > segment->at_rest) {
        return jerk * (1.0f / sqrt(jerk_squared));
    }
    return (float3)(1.0f, 0.0f, 0.0f);
}

Sample segment_sample(const Segment *segment, float t) {
    float3 offset = (segment->c1.xyz + (segment->c2.xyz + segment->c3.xyz * t) * t) * t;
    float3 velocity = segment->c1.xyz + (segment->c2.xyz * 2.0f + segment->c3.xyz * (3.0f * t)) * t;
    float speed_squared = dot3(velocity, velocity);
    // If the spline stands still, nothing grows along it.
    float inverse = 0.0f;
    Sample sample;
    if (speed_squared > segment->at_rest) {
        inverse = 1.0f / sqrt(speed_squared);
        sample.tangent = velocity * inverse;
    } else {
        sample.tangent = direction_at_rest(segment, t);
    }
    float3 width_terms = (float3)(segment->c1.w, segment->c2.w, segment->c3.w);
    float2 width = size_sample(segment->start.w, width_terms, segment->width_floor, t, inverse);
    float2 height = width;
    if (FLATTENED) {
        height = size_sample(segment->height.x, segment->height.yzw, segment->height_floor, t, inverse);
    }
    sample.offset = offset;
    sample.centre = segment->start.xyz + offset;
    sample.half_width = width.x;
    sample.half_height = height.x;
    sample.width_growth = width.y;
    sample.height_growth = height.y;
    return sample;
}

// `part` / `whole`, rounded down. The result is exact for numbers as small as those of rings and
// sides. It takes much less time than an integer division.
uint quotient(uint part, uint whole) {
    return (uint)(((float)part + 0.5f) * (1.0f / (float)whole));
}

// ---- RingSample: the spline at a ring, with what the step to the next ring needs ----

typedef struct {
    Sample sample;
    // The interval's end relative to its start.
    float3 span;
    // Whether the next ring is the first of the next interval.
    bool ends_interval;
} RingSample;

// The spline at ring number `k` of the block, counted from 0. `k` may also name the ring after the
// block's last. `points` begin at the chunk's window.
RingSample ring_sample(__global const uint4 *points, const Params *params, const YarnRow *yarn, const Block *block,
                       uint k) {
    uint per_interval = params->subdivisions + 1u;
    uint place = block->first_ring % per_interval + k;
    uint interval = quotient(place, per_interval);
    uint point = block->first_point + interval;
    uint part = place - interval * per_interval;
    float t = (float)part * params->step;
    // The last ring of an open yarn is t = 1 of the interval before.
    if (block->first_ring + k + 1u == yarn->rings && yarn->closed == 0u) {
        point -= 1u;
        t = 1.0f;
    }
    Segment segment = segment_new(points + point, params->s);
    RingSample ring;
    ring.sample = segment_sample(&segment, t);
    ring.span = segment.span.xyz;
    ring.ends_interval = part + 1u == per_interval;
    return ring;
}

// The way from `here` to the next ring's centre, whose offset in its interval is `next_offset`.
float3 chord_to(const RingSample *here, float3 next_offset) {
    return (here->ends_interval ? here->span : next_offset) - here->sample.offset;
}

// The normal of a cap: the tangent at the yarn's end, pointing out of the yarn. `points` begin at
// the chunk's window.
float3 cap_normal(__global const uint4 *points, const Params *params, const CapRow *cap) {
    // The start is t = 0 of the first interval, the finish t = 1 of the last.
    Segment segment = segment_new(points + cap->first_point, params->s);
    Sample sample = segment_sample(&segment, cap->end == 0u ? 0.0f : 1.0f);
    return sample.tangent * (cap->end == 0u ? -1.0f : 1.0f);
}

// ---- Frame ----

typedef struct {
    float3 side;
    float3 up;
} Basis;

// The second axis of a section whose first axis is `side`: tangent x side.
float3 up_of(float3 tangent, float3 side) {
    return (float3)(tangent.y * side.z - tangent.z * side.y, tangent.z * side.x - tangent.x * side.z,
                    tangent.x * side.y - tangent.y * side.x);
}

// The upright basis: side is z x t, normalised, or +y if t is along z. up is t x side.
Basis basis_upright(float3 tangent) {
    float level = tangent.x * tangent.x + tangent.y * tangent.y;
    Basis basis;
    if (level < VERTICAL) {
        basis.side = (float3)(0.0f, 1.0f, 0.0f);
    } else {
        float inverse = 1.0f / sqrt(level);
        basis.side = (float3)(-tangent.y * inverse, tangent.x * inverse, 0.0f);
    }
    basis.up = up_of(tangent, basis.side);
    return basis;
}

// The side of a section with the roll `roll`: the upright side, turned about the tangent towards
// up.
float3 side_standing(float3 tangent, uint roll) {
    Basis upright = basis_upright(tangent);
    if (roll == 0u) {
        return upright.side;
    }
    float2 sin_cos = turn_sin_cos(roll);
    return upright.side * sin_cos.y + upright.up * sin_cos.x;
}

// `v` mirrored in the plane at right angles to `mirror`.
float3 mirrored(float3 v, float3 mirror, float mirror_squared) {
    return v - mirror * (2.0f * dot3(v, mirror) / mirror_squared);
}

// The angle, in turns, from the next ring's upright side to this ring's upright side carried there
// by double reflection (Wang, Juettler, Zheng and Liu 2008, table I).
float transport_turns(float3 tangent, float3 next_tangent, float3 chord) {
    float3 side = basis_upright(tangent).side;
    float length_squared = dot3(chord, chord);
    // If two rings coincide, the tangent is used in place of the chord.
    bool apart = length_squared > NO_LENGTH;
    float3 mirror = apart ? chord : tangent;
    float mirror_squared = apart ? length_squared : 1.0f;
    side = mirrored(side, mirror, mirror_squared);
    float3 reflected_tangent = mirrored(tangent, mirror, mirror_squared);
    // At a hairpin the second reflection is the identity.
    mirror = next_tangent - reflected_tangent;
    mirror_squared = dot3(mirror, mirror);
    if (mirror_squared > NO_MIRROR) {
        side = mirrored(side, mirror, mirror_squared);
    }
    Basis next = basis_upright(next_tangent);
    return atan2_turns(dot3(side, next.up), dot3(side, next.side));
}

// The change of roll from a ring to the next. `twist` is in turns per mm.
uint frame_step(uint frame, float3 tangent, float3 next_tangent, float3 chord, float twist) {
    float turns = frame == ROTATION_MINIMIZING ? transport_turns(tangent, next_tangent, chord) : 0.0f;
    return turn_from_turns(turns + twist * sqrt(dot3(chord, chord)));
}

// The roll of ring `ring`, if the steps up to it add up to `sum`. In a closed yarn each ring loses
// its share of the yarn's total turn, `whole`, so that the last ring has the roll of the first.
uint closed_up(const YarnRow *yarn, uint ring, uint sum, uint whole) {
    uint steps = yarn->rings - 1u;
    if (yarn->closed == 0u) {
        return sum;
    }
    // `?:` is not used, because PoCL 3.1 miscompiles it: the last ring kept the rounding error of
    // its share.
    return select(sum - turn_share(whole, ring, steps), 0u, ring == steps);
}

// ---- Vertex ----

// How a section stands on a ring. All vertices of the ring share it.
typedef struct {
    // Centre, half width.
    float4 centre;
    // Unit tangent, growth of the half width.
    float4 tangent;
    float3 side;
    float3 up;
    // Half height and its growth; sine and cosine of the roll less the lean. Both are used only if
    // yarns are FLATTENED.
    float2 height;
    float2 sin_cos;
    bool round;
} Stance;

// Whether a yarn is round at a ring, and stays round there. `width` is the half width and its
// growth, `height` the half height and its growth. Round rings are worked out in the same way
// whether other yarns are FLATTENED or not, so that no vertex depends on other yarns.
bool is_round(float2 width, float2 height) {
    return !FLATTENED || (width.x == height.x && width.y == height.y);
}

// The side of a section. A round section turns with the roll. The outline of a flattened section
// leans, and the section turns inside its outline.
float3 side_of(float3 tangent, uint roll, uint lean, bool round) {
    return side_standing(tangent, round ? roll : lean);
}

// The stance of a section. `side` is the result of `side_of`, `height` is the half height and its
// growth, and `sin_cos` are the sine and cosine of the roll less the lean.
Stance stance_new(float4 centre, float4 tangent, float3 side, float2 height, float2 sin_cos) {
    Stance stance;
    stance.centre = centre;
    stance.tangent = tangent;
    stance.side = side;
    stance.up = up_of(tangent.xyz, side);
    stance.height = height;
    stance.sin_cos = sin_cos;
    stance.round = is_round((float2)(centre.w, tangent.w), height);
    return stance;
}

// `q`, turned by the roll less the lean.
float2 rolled(const Stance *stance, float2 q) {
    return (float2)(stance->sin_cos.y * q.x - stance->sin_cos.x * q.y, stance->sin_cos.x * q.x + stance->sin_cos.y * q.y);
}

// The position of the vertex at `point` of a section.
float3 position_at(const Stance *stance, float4 point) {
    if (!stance->round) {
        float2 q = rolled(stance, point.xy);
        return stance->centre.xyz + (stance->side * (q.x * stance->centre.w) + stance->up * (q.y * stance->height.x));
    }
    float3 outward = stance->side * point.x + stance->up * point.y;
    return stance->centre.xyz + outward * stance->centre.w;
}

// The normal of the vertex at `point` of a section.
float3 normal_at(const Stance *stance, float4 point) {
    float4 tangent = stance->tangent;
    if (!stance->round) {
        float2 q = rolled(stance, point.xy);
        // The x component is multiplied by the half height, the y component by the half width. This
        // is the inverse transpose of the scaling by both, times their product.
        float2 normal = rolled(stance, point.zw) * (float2)(stance->height.x, stance->centre.w);
        float lean = tangent.w * q.x * normal.x + stance->height.y * q.y * normal.y;
        float inverse = 1.0f / sqrt(normal.x * normal.x + normal.y * normal.y + lean * lean);
        float3 across = stance->side * (normal.x * inverse) + stance->up * (normal.y * inverse);
        return across - tangent.xyz * (lean * inverse);
    }
    float3 across = stance->side * point.z + stance->up * point.w;
    // If the radius is constant, no square root is needed.
    if (tangent.w == 0.0f) {
        return across;
    }
    float lean = tangent.w * (point.x * point.z + point.y * point.w);
    return (across - tangent.xyz * lean) * (1.0f / sqrt(1.0f + lean * lean));
}
