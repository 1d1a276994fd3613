// What every stage reads: the tables, the turn, the spline, the frame and the vertex.
//
// The formulas, the thresholds and the order of operations are those of texere-core (turn.rs, spline.rs, sampling.rs,
// frame.rs, ring.rs), and common.wgsl is the twin of this file. OpenCL C 1.2, no extension.
// Constants such as BLOCK_RINGS are the core's; texere-gpu writes them before this file.

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

// Rust: texere_gpu::YarnRow, 20 bytes.
typedef struct {
    uint rings;
    uint first_block;
    uint section;
    uint closed;
    float twist;
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
    uint first_block;
    uint yarns;
    uint sides;
    uint subdivisions;
    uint frame;
    uint indexed;
    uint rolled;
    float s;
    float step;
    uint padding;
} Params;

// A control point (Rust: ControlPoint) is a float4 of x, y, z, radius.
// A section point (Rust: SectionPoint) is a float4 of x, y, normal x, normal y.
// A ring (Rust: Ring) is two uint4: the bits of centre and radius, the bits of the tangent and the roll.
// A vertex (Rust: Vertex) is six floats: x y z nx ny nz.

float dot3(float3 a, float3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

// ---- Turn: an angle as a u32 fraction of a full turn ----

// `turns` full turns, reduced to one and rounded to the nearest step.
uint turn_from_turns(float turns) {
    float wrapped = max(turns - floor(turns + 0.5f), -0.5f);
    return as_uint(convert_int_sat(floor(wrapped * TURN_STEPS + 0.5f)));
}

// Sine (x) and cosine (y).
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
    float4 start;
    // P[j+1] - P[j].
    float4 span;
    // Coefficients of t, t^2, t^3.
    float4 c1;
    float4 c2;
    float4 c3;
    float radius_floor;
    // A squared velocity up to this counts as zero.
    float at_rest;
} Segment;

typedef struct {
    // Centre relative to the segment's first control point.
    float3 offset;
    float3 centre;
    float radius;
    float3 tangent;
    // dr/ds, the growth of the radius along the yarn.
    float slope;
} Sample;

Segment segment_new(float4 before, float4 start, float4 end, float4 after, float s) {
    float4 a = before - start;
    float4 b = end - start;
    float4 c = after - start;
    Segment segment;
    segment.start = start;
    segment.span = b;
    segment.c1 = (b - a) * s;
    segment.c2 = a * (2.0f * s) + b * (3.0f - 2.0f * s) - c * s;
    segment.c3 = (c - a) * s + b * (s - 2.0f);
    segment.radius_floor = min(start.w, end.w) * RADIUS_FLOOR;
    segment.at_rest =
        max(ZERO_VELOCITY * (dot3(a.xyz, a.xyz) + dot3(b.xyz, b.xyz) + dot3(c.xyz, c.xyz)), NO_LENGTH);
    return segment;
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
    float4 offset = (segment->c1 + (segment->c2 + segment->c3 * t) * t) * t;
    float4 velocity = segment->c1 + (segment->c2 * 2.0f + segment->c3 * (3.0f * t)) * t;
    float radius = segment->start.w + offset.w;
    float speed_squared = dot3(velocity.xyz, velocity.xyz);
    Sample sample;
    if (speed_squared > segment->at_rest) {
        float inverse = 1.0f / sqrt(speed_squared);
        sample.tangent = velocity.xyz * inverse;
        sample.slope = clamp(velocity.w * inverse, -SLOPE_LIMIT, SLOPE_LIMIT);
    } else {
        sample.tangent = direction_at_rest(segment, t);
        sample.slope = 0.0f;
    }
    bool held = radius < segment->radius_floor;
    sample.offset = offset.xyz;
    sample.centre = segment->start.xyz + offset.xyz;
    sample.radius = held ? segment->radius_floor : radius;
    sample.slope = held ? 0.0f : sample.slope;
    return sample;
}

// `part` / `whole`, rounded down: exact for numbers as small as these, and much faster than an integer division.
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

// Ring `k` from the block's first on; also the one after the block's last. `points` start at the window.
RingSample ring_sample(__global const float4 *points, const Params *params, const YarnRow *yarn, const Block *block,
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
    Segment segment = segment_new(points[point], points[point + 1u], points[point + 2u], points[point + 3u], params->s);
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

// ---- Frame ----

typedef struct {
    float3 side;
    float3 up;
} Basis;

// The other axis of a section whose first is `side`: tangent x side.
float3 up_of(float3 tangent, float3 side) {
    return (float3)(tangent.y * side.z - tangent.z * side.y, tangent.z * side.x - tangent.x * side.z,
                    tangent.x * side.y - tangent.y * side.x);
}

// side = z x t, normalised (+y where t is along z); up = t x side.
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

// The side of a section that stands with `roll`: the upright one turned about the tangent, towards up.
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

// The angle, in turns, from the next ring's upright side to this ring's upright side carried there by double
// reflection (Wang, Juettler, Zheng and Liu 2008, table I).
float transport_turns(float3 tangent, float3 next_tangent, float3 chord) {
    float3 side = basis_upright(tangent).side;
    float length_squared = dot3(chord, chord);
    // Where two rings coincide the tangent stands in for the chord.
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

// The change of roll from a ring to the next; `twist` in turns per mm.
uint frame_step(uint frame, float3 tangent, float3 next_tangent, float3 chord, float twist) {
    float turns = frame == ROTATION_MINIMIZING ? transport_turns(tangent, next_tangent, chord) : 0.0f;
    return turn_from_turns(turns + twist * sqrt(dot3(chord, chord)));
}

// The roll of ring `ring` whose steps so far add up to `sum`: a closed yarn gives back its share of its whole turn, so
// that its last ring meets its first.
uint closed_up(const YarnRow *yarn, uint ring, uint sum, uint whole) {
    uint steps = yarn->rings - 1u;
    if (yarn->closed == 0u) {
        return sum;
    }
    // Not `?:`, which PoCL 3.1 miscompiles: the last ring kept the rounding error of its share.
    return select(sum - turn_share(whole, ring, steps), 0u, ring == steps);
}

// ---- Vertex ----

// The position of the vertex at `point` of a section; `centre` has the radius as its fourth component.
float3 position_at(float4 centre, float3 side, float3 up, float4 point) {
    float3 outward = side * point.x + up * point.y;
    return centre.xyz + outward * centre.w;
}

// The vertex's normal; `tangent` has the slope of the radius as its fourth component.
float3 normal_at(float4 tangent, float3 side, float3 up, float4 point) {
    float3 across = side * point.z + up * point.w;
    // Most yarns have a constant radius, and need no square root.
    if (tangent.w == 0.0f) {
        return across;
    }
    float lean = tangent.w * (point.x * point.z + point.y * point.w);
    return (across - tangent.xyz * lean) * (1.0f / sqrt(1.0f + lean * lean));
}
