// The paper's algorithms 2 and 4, in which a lane makes a yarn, or a part of a yarn. Measurements
// compare the schedule per-ring with them. This file follows common.cl.
//
// Its twin is per_yarn.wgsl. Both make only what the paper makes: upright, untwisted, open yarns
// without caps. A lane makes a part, which is a run of one yarn's rings in a chunk, so that a
// fabric may be larger than a device's buffers. Here `blocks` has one row for each part: the row of
// its first block, but with the number of all the part's rings.

#define PER_YARN_GROUP 64

// Algorithm 2: K + 1 rings for each control interval.
__kernel __attribute__((reqd_work_group_size(PER_YARN_GROUP, 1, 1)))
void trajectory_per_yarn(const Params params, const ulong window, __global const uint4 *points,
                         __global const YarnRow *yarns, __global const Block *blocks, __global uint4 *rings) {
    size_t number = get_global_id(0);
    if (number >= params.blocks) {
        return;
    }
    Block part = blocks[number];
    uint per_interval = params.subdivisions + 1u;
    uint intervals = (yarns[part.yarn].rings - 1u) / per_interval;
    uint interval = part.first_ring / per_interval;
    uint place = part.first_ring % per_interval;
    __global const uint4 *point = points + window + part.first_point;
    // The yarn's last ring is t = 1 of the last interval.
    if (interval == intervals) {
        interval -= 1u;
        point -= 1;
        place = per_interval;
    }
    for (uint ring = 0u; ring < part.rings; interval++, point++) {
        Segment segment = segment_new(point, params.s);
        uint end = interval + 1u == intervals ? per_interval + 1u : per_interval;
        for (; place < end && ring < part.rings; place++, ring++) {
            float t = place == per_interval ? 1.0f : (float)place * params.step;
            Sample sample = segment_sample(&segment, t);
            __global uint4 *out = rings + 3 * ((size_t)part.chunk_ring + ring);
            out[0] = as_uint4((float4)(sample.centre, sample.half_width));
            out[1] = as_uint4((float4)(sample.tangent, 0.0f));
            out[2] = as_uint4((float4)(sample.half_height, sample.width_growth, sample.height_growth, 0.0f));
        }
        place = 0u;
    }
}

// How an untwisted section stands on a ring of algorithm 2.
Stance stance_at(__global const uint4 *ring) {
    float4 centre = as_float4(ring[0]);
    float4 tangent = as_float4(ring[1]);
    float4 size = as_float4(ring[2]);
    return stance_new(centre, (float4)(tangent.xyz, size.y), side_of(tangent.xyz, 0u, 0u, true), size.xz, (float2)(0.0f, 1.0f));
}

// Algorithm 4: `sides` vertices for each ring, and the triangles to the next ring.
__kernel __attribute__((reqd_work_group_size(PER_YARN_GROUP, 1, 1)))
void mesh_per_yarn(const Params params, __global const YarnRow *yarns, __global const Block *blocks,
                   __global const uint4 *rings, __global const float4 *outlines, __global const uint *pattern,
                   __global float *vertices, __global uint *indices) {
    size_t number = get_global_id(0);
    if (number >= params.blocks) {
        return;
    }
    Block part = blocks[number];
    uint sides = params.sides;
    __global const float4 *outline = outlines + yarns[part.yarn].section * sides;
    for (uint ring = 0u; ring < part.rings; ring++) {
        Stance stance = stance_at(rings + 3 * ((size_t)part.chunk_ring + ring));
        uint first_vertex = part.first_vertex + ring * sides;
        for (uint k = 0u; k < sides; k++) {
            __global float *out = vertices + 6 * (size_t)(first_vertex + k);
            vstore3(position_at(&stance, outline[k]), 0, out);
            vstore3(normal_at(&stance, outline[k]), 0, out + 3);
        }
        if (params.indexed != 0u && ring < part.quads) {
            uint first_index = part.first_index + ring * 6u * sides;
            for (uint k = 0u; k < 6u * sides; k++) {
                indices[first_index + k] = first_vertex + pattern[k];
            }
        }
    }
}
