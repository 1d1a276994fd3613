// Stage 2 with stage 1 in it, as packed vertices. This file follows common.cl, rings.cl and
// share.cl.
//
// Its twins are packed.wgsl and texere-core's packed.rs. A packed vertex (Rust: PackedVertex) is
// three words. The first two hold x in bits 0 to 20, y in bits 21 to 41 and z in bits 42 to 62. The
// third holds both coordinates of the octahedral normal, 16 bits each. Lanes store two words at a
// time (one if the number of sides is odd), contiguous across the workgroup.

#define PACKED_GROUP 64

// The lowest bits of the number of whole quanta nearest to a coordinate. Factors are powers of two,
// so only the last step rounds.
uint packed_coordinate(float mm, float per_mm) {
    float quanta = mm * per_mm;
    float rest = quanta - rint(quanta * (1.0f / QUANTA_WRAP)) * QUANTA_WRAP;
    return as_uint(convert_int(rint(rest))) & ((1u << COORDINATE_BITS) - 1u);
}

// The two words of a position.
uint2 packed_position(float3 position, float per_mm) {
    uint x = packed_coordinate(position.x, per_mm);
    uint y = packed_coordinate(position.y, per_mm);
    uint z = packed_coordinate(position.z, per_mm);
    return (uint2)(x | (y << COORDINATE_BITS), (y >> (32u - COORDINATE_BITS)) | (z << (2u * COORDINATE_BITS - 32u)));
}

// The word of a normal, projected to the octahedron |x| + |y| + |z| = 1, whose lower half is folded
// outwards.
uint packed_normal(float3 normal) {
    float scale = 1.0f / (fabs(normal.x) + fabs(normal.y) + fabs(normal.z));
    float2 flat = normal.xy * scale;
    if (normal.z < 0.0f) {
        flat = (1.0f - fabs(flat.yx)) * (float2)(flat.x < 0.0f ? -1.0f : 1.0f, flat.y < 0.0f ? -1.0f : 1.0f);
    }
    int2 steps = convert_int2(rint(flat * NORMAL_STEPS));
    return (as_uint(steps.x) & 0xffffu) | (as_uint(steps.y) << 16);
}

// Two consecutive words of ring `ring`'s vertices. The first is word `first` of the vertex at
// `point`, the second belongs to the vertex at `next`. The two vertices differ only if the first
// word is that of a normal.
uint2 two_words(__local const BlockRings *rings, uint ring, uint first, float4 point, float4 next, float per_mm) {
    Stance stance = stance_of(rings, ring);
    uint2 position = packed_position(position_at(&stance, next), per_mm);
    if (first == 0u) {
        return position;
    }
    uint normal = packed_normal(normal_at(&stance, point));
    return first == 2u ? (uint2)(normal, position.x) : (uint2)(position.y, normal);
}

// Word `first` of ring `ring`'s vertex at `point`.
uint one_word(__local const BlockRings *rings, uint ring, uint first, float4 point, float per_mm) {
    Stance stance = stance_of(rings, ring);
    if (first == 2u) {
        return packed_normal(normal_at(&stance, point));
    }
    uint2 position = packed_position(position_at(&stance, point), per_mm);
    return first == 0u ? position.x : position.y;
}

// Packs a chunk with an even number of sides, in which every block starts at a multiple of 8 bytes.
// It runs with one workgroup of PACKED_GROUP lanes for each row of the chunk's block table.
__kernel __attribute__((reqd_work_group_size(PACKED_GROUP, 1, 1)))
void packed(const Params params, const ulong window, __global const uint4 *points, __global const YarnRow *yarns,
            __global const Block *blocks, __global const uint *rolls, __global const uint *whole,
            __global const float4 *outlines, __global uint2 *out) {
    __local BlockRings rings;
    size_t row = get_global_id(0) / PACKED_GROUP;
    uint lane = get_local_id(0);
    Block block = blocks[row];
    YarnRow yarn = yarns[block.yarn];
    block_rings(points + window, &params, &yarn, &block, rolls, whole, lane, &rings);

    uint stores = 3u * params.sides / 2u;
    Share share = share_of(lane, PACKED_GROUP, stores);
    __global const float4 *outline = outlines + yarn.section * params.sides;
    out += 3 * (size_t)block.first_vertex / 2;
    for (uint store = share.store; store < stores; store += share.across) {
        uint first = 2u * store % 3u;
        float4 point = outline[2u * store / 3u];
        float4 next = outline[(2u * store + 1u) / 3u];
        for (uint ring = share.ring; ring < block.rings; ring += share.step) {
            out[ring * stores + store] = two_words(&rings, ring, first, point, next, params.quanta_per_mm);
        }
    }
}

// Packs a chunk with an odd number of sides, 4 bytes at a time.
__kernel __attribute__((reqd_work_group_size(PACKED_GROUP, 1, 1)))
void packed_odd(const Params params, const ulong window, __global const uint4 *points, __global const YarnRow *yarns,
                __global const Block *blocks, __global const uint *rolls, __global const uint *whole,
                __global const float4 *outlines, __global uint *out) {
    __local BlockRings rings;
    size_t row = get_global_id(0) / PACKED_GROUP;
    uint lane = get_local_id(0);
    Block block = blocks[row];
    YarnRow yarn = yarns[block.yarn];
    block_rings(points + window, &params, &yarn, &block, rolls, whole, lane, &rings);

    uint stores = 3u * params.sides;
    Share share = share_of(lane, PACKED_GROUP, stores);
    __global const float4 *outline = outlines + yarn.section * params.sides;
    out += 3 * (size_t)block.first_vertex;
    for (uint store = share.store; store < stores; store += share.across) {
        float4 point = outline[store / 3u];
        for (uint ring = share.ring; ring < block.rings; ring += share.step) {
            out[ring * stores + store] = one_word(&rings, ring, store % 3u, point, params.quanta_per_mm);
        }
    }
}

// Writes the packed vertices of caps, with one lane for each cap vertex. The vertices have the
// positions of the end ring and the normal of the yarn's end.
__kernel __attribute__((reqd_work_group_size(PACKED_GROUP, 1, 1)))
void packed_caps(const Params params, const ulong window, __global const uint4 *points, __global const CapRow *rows,
                 __global uint *out) {
    size_t number = get_global_id(0);
    if (number >= (size_t)params.caps * params.sides) {
        return;
    }
    CapRow cap = rows[number / params.sides];
    uint corner = number % params.sides;
    __global const uint *ring = out + 3 * (size_t)(cap.ring_vertex + corner);
    __global uint *own = out + 3 * (size_t)(cap.first_vertex + corner);
    own[0] = ring[0];
    own[1] = ring[1];
    own[2] = packed_normal(cap_normal(points + window, &params, &cap));
}
