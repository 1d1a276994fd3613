// Lengths along yarns up to each block's start, and the attributes of vertices. This file follows
// common.cl.
//
// Its twins are attributes.wgsl and texere-cpu's attributes.rs. Lengths are whole steps of 2^-32 mm
// (Rust: ArcLength), so the order of the sums does not matter.

#define ATTRIBUTES_GROUP 64
#define YARN_LENGTHS_GROUP 256

// An attribute (Rust: Attribute) is three uint2: the yarn and the bits of the angle; the bits of
// the length and of the tangent's x; the bits of the tangent's y and z.

// A length in mm as whole steps.
ulong length_from_mm(float mm) {
    float whole = floor(max(mm, 0.0f));
    float part = max(mm, 0.0f) - whole;
    return ((ulong)convert_uint_sat(min(whole, LENGTH_MM_MAX)) << 32) | convert_uint_sat(part * LENGTH_STEPS);
}

float length_mm(ulong length) {
    return (float)(uint)(length >> 32) + (float)(uint)length / LENGTH_STEPS;
}

// The speed of the spline at t.
float segment_speed(const Segment *segment, float t) {
    float3 velocity = segment->c1.xyz + (segment->c2.xyz * 2.0f + segment->c3.xyz * (3.0f * t)) * t;
    return sqrt(dot3(velocity, velocity));
}

// A length by the Gauss-Legendre rule, and the lowest and the highest speed at the rule's nodes and
// in the middle.
typedef struct {
    float length;
    float slowest;
    float fastest;
} Rule;

// Adds a pair of nodes, `reach` to either side of the middle.
void rule_add(Rule *rule, const Segment *segment, float middle, float reach, float weight) {
    float before = segment_speed(segment, middle - reach);
    float behind = segment_speed(segment, middle + reach);
    rule->length += weight * (before + behind);
    rule->slowest = min(min(rule->slowest, before), behind);
    rule->fastest = max(max(rule->fastest, before), behind);
}

// The length between two parameters, by the Gauss-Legendre rule with eight nodes.
Rule length_by_rule(const Segment *segment, float from, float to) {
    float middle = (from + to) * 0.5f;
    float half_way = (to - from) * 0.5f;
    Rule rule;
    rule.length = 0.0f;
    rule.slowest = segment_speed(segment, middle);
    rule.fastest = rule.slowest;
    rule_add(&rule, segment, middle, half_way * ARC_NODE_1, ARC_WEIGHT_1);
    rule_add(&rule, segment, middle, half_way * ARC_NODE_2, ARC_WEIGHT_2);
    rule_add(&rule, segment, middle, half_way * ARC_NODE_3, ARC_WEIGHT_3);
    rule_add(&rule, segment, middle, half_way * ARC_NODE_4, ARC_WEIGHT_4);
    rule.length *= half_way;
    return rule;
}

// The length between two parameters. If the speed is uneven, the interval between them is split
// into parts, whose lengths are added up.
float segment_length(const Segment *segment, float from, float to) {
    Rule rule = length_by_rule(segment, from, to);
    if (rule.slowest >= ARC_EVEN * rule.fastest) {
        return rule.length;
    }
    float part = (to - from) / (float)ARC_PANELS;
    float sum = 0.0f;
    for (uint panel = 0u; panel < ARC_PANELS; panel++) {
        float start = from + (float)panel * part;
        sum += length_by_rule(segment, start, start + part).length;
    }
    return sum;
}

// The length from ring number `k` of the block to the next ring. The ring must not be the yarn's
// last. `points` begin at the chunk's window.
ulong step_length(__global const uint4 *points, const Params *params, const Block *block, uint k) {
    uint per_interval = params->subdivisions + 1u;
    uint place = block->first_ring % per_interval + k;
    uint interval = quotient(place, per_interval);
    uint part = place - interval * per_interval;
    Segment segment = segment_new(points + block->first_point + interval, params->s);
    // At the interval's end this is set to 1, since the last multiple of the step may differ
    // slightly from 1.
    float end = part + 1u == per_interval ? 1.0f : (float)(part + 1u) * params->step;
    return length_from_mm(segment_length(&segment, (float)part * params->step, end));
}

// The sum of the lengths of all lanes up to this one, inclusive. Until the next barrier the last of
// `sums` is the sum of all `lanes`. Every lane must call this function.
inline ulong running_length(__local ulong *sums, uint lane, uint lanes, ulong length) {
    sums[lane] = length;
    for (uint reach = 1u; reach < lanes; reach *= 2u) {
        barrier(CLK_LOCAL_MEM_FENCE);
        ulong further = lane >= reach ? sums[lane - reach] : 0ul;
        barrier(CLK_LOCAL_MEM_FENCE);
        sums[lane] += further;
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    return sums[lane];
}

// The length from ring `lane` of a block to the next ring, or 0 if no quads start from ring `lane`.
inline ulong lane_length(__global const uint4 *points, const Params *params, const Block *block, uint lane) {
    return lane < block->quads ? step_length(points, params, block, lane) : 0ul;
}

// Writes the length of each block of a chunk, from its first ring to the next block's first ring,
// or to the yarn's last ring. It runs with one workgroup of ATTRIBUTES_GROUP lanes for each row of
// the block table.
__kernel __attribute__((reqd_work_group_size(ATTRIBUTES_GROUP, 1, 1)))
void block_lengths(const Params params, const ulong window, __global const uint4 *points,
                   __global const YarnRow *yarns, __global const Block *blocks, __global ulong *lengths) {
    __local ulong sums[ATTRIBUTES_GROUP];
    size_t row = get_global_id(0) / ATTRIBUTES_GROUP;
    uint lane = get_local_id(0);
    Block block = blocks[row];
    ulong sum = running_length(sums, lane, ATTRIBUTES_GROUP, lane_length(points + window, &params, &block, lane));
    if (lane == ATTRIBUTES_GROUP - 1) {
        lengths[yarns[block.yarn].first_block + block.first_ring / BLOCK_RINGS] = sum;
    }
}

// Replaces the length of each block of a yarn by the total length of the blocks before it, one tile
// of YARN_LENGTHS_GROUP blocks after the other. It runs with one workgroup of YARN_LENGTHS_GROUP
// lanes for each yarn.
__kernel __attribute__((reqd_work_group_size(YARN_LENGTHS_GROUP, 1, 1)))
void yarn_lengths(__global const YarnRow *yarns, __global ulong *lengths) {
    __local ulong sums[YARN_LENGTHS_GROUP];
    size_t number = get_global_id(0) / YARN_LENGTHS_GROUP;
    uint lane = get_local_id(0);
    uint blocks = (yarns[number].rings - 1u) / BLOCK_RINGS + 1u;
    __global ulong *own = lengths + yarns[number].first_block;

    ulong before = 0ul;
    for (uint tile = 0u; tile < blocks; tile += YARN_LENGTHS_GROUP) {
        uint block = tile + lane;
        ulong length = block < blocks ? own[block] : 0ul;
        ulong sum = running_length(sums, lane, YARN_LENGTHS_GROUP, length);
        if (block < blocks) {
            own[block] = before + sum - length;
        }
        before += sums[YARN_LENGTHS_GROUP - 1];
        barrier(CLK_LOCAL_MEM_FENCE);
    }
}

// Writes the attributes of the vertices of a chunk's tubes. It runs with one workgroup of
// ATTRIBUTES_GROUP lanes for each row of the block table.
__kernel __attribute__((reqd_work_group_size(ATTRIBUTES_GROUP, 1, 1)))
void attributes(const Params params, const ulong window, __global const uint4 *points,
                __global const YarnRow *yarns, __global const Block *blocks, __global const ulong *lengths,
                __global uint2 *out) {
    __local ulong sums[ATTRIBUTES_GROUP];
    // For each ring, the length along the yarn, mm, and the tangent.
    __local float4 rings[ATTRIBUTES_GROUP];
    size_t row = get_global_id(0) / ATTRIBUTES_GROUP;
    uint lane = get_local_id(0);
    Block block = blocks[row];
    YarnRow yarn = yarns[block.yarn];

    ulong length = lane_length(points + window, &params, &block, lane);
    ulong sum = running_length(sums, lane, ATTRIBUTES_GROUP, length);
    if (lane < block.rings) {
        RingSample here = ring_sample(points + window, &params, &yarn, &block, lane);
        ulong along = lengths[yarn.first_block + block.first_ring / BLOCK_RINGS] + sum - length;
        rings[lane] = (float4)(length_mm(along), here.sample.tangent);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    // Three stores of 8 bytes a vertex, contiguous across lanes.
    out += 3 * (size_t)block.first_vertex;
    for (uint piece = lane; piece < 3u * params.sides * block.rings; piece += ATTRIBUTES_GROUP) {
        uint vertex = piece / 3u;
        uint ring = vertex / params.sides;
        float4 here = rings[ring];
        if (piece % 3u == 0u) {
            float angle = (float)(vertex - ring * params.sides) * (FULL_TURN / (float)params.sides);
            out[piece] = (uint2)(block.yarn, as_uint(angle));
        } else if (piece % 3u == 1u) {
            out[piece] = as_uint2(here.xy);
        } else {
            out[piece] = as_uint2(here.zw);
        }
    }
}

// Writes the attributes of caps, which equal those of the end rings. It runs with one lane for each
// cap vertex.
__kernel __attribute__((reqd_work_group_size(ATTRIBUTES_GROUP, 1, 1)))
void cap_attributes(const Params params, __global const CapRow *rows, __global uint2 *out) {
    size_t number = get_global_id(0);
    if (number >= (size_t)params.caps * params.sides) {
        return;
    }
    CapRow cap = rows[number / params.sides];
    uint corner = number % params.sides;
    for (uint piece = 0u; piece < 3u; piece++) {
        out[3 * (size_t)(cap.first_vertex + corner) + piece] = out[3 * (size_t)(cap.ring_vertex + corner) + piece];
    }
}
