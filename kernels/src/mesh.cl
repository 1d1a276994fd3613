// Stage 2 with stage 1 in it: the vertices and indices of a chunk's tubes. This file follows
// common.cl, rings.cl and share.cl.
//
// Its twins are mesh.wgsl and texere-cpu's serial/mesh.rs. The speed of memory limits this stage.
// Lanes therefore store 16 bytes at a time (8 if the number of sides is odd), contiguous across the
// workgroup.

// Four consecutive floats of ring `ring`'s vertices. `first` is the number of the first float in
// its vertex, and is even. The four hold floats of at most one normal and one position.
float4 four_floats(__local const BlockRings *rings, uint ring, uint first, float4 normal_point, float4 position_point) {
    Stance stance = stance_of(rings, ring);
    float3 normal = normal_at(&stance, normal_point);
    float3 position = position_at(&stance, position_point);
    if (first == 0u) {
        return (float4)(position, normal.x);
    }
    return first == 2u ? (float4)(position.z, normal) : (float4)(normal.yz, position.xy);
}

// Two consecutive floats of ring `ring`'s vertex at `point`. `first` is the number of the first
// float in the vertex, and is even.
float2 two_floats(__local const BlockRings *rings, uint ring, uint first, float4 point) {
    Stance stance = stance_of(rings, ring);
    float3 normal = normal_at(&stance, point);
    float3 position = position_at(&stance, point);
    if (first == 0u) {
        return position.xy;
    }
    return first == 2u ? (float2)(position.z, normal.x) : normal.yz;
}

// Meshes a chunk with an even number of sides, in which every block starts at a multiple of 16
// bytes. It runs with one workgroup of at least BLOCK_RINGS lanes for each row of the chunk's block
// table.
__kernel void mesh(const Params params, const ulong window, __global const uint4 *points,
                   __global const YarnRow *yarns, __global const Block *blocks, __global const uint *rolls,
                   __global const uint *whole, __global const float4 *outlines, __global const uint4 *pattern,
                   __global float4 *vertices, __global uint4 *indices) {
    __local BlockRings rings;
    size_t row = get_global_id(0) / get_local_size(0);
    uint lane = get_local_id(0);
    Block block = blocks[row];
    YarnRow yarn = yarns[block.yarn];
    block_rings(points + window, &params, &yarn, &block, rolls, whole, lane, &rings);

    uint stores = 3u * params.sides / 2u;
    Share share = share_of(lane, (uint)get_local_size(0), stores);
    __global const float4 *outline = outlines + yarn.section * params.sides;
    __global float4 *out = vertices + 3 * (size_t)block.first_vertex / 2;
    for (uint store = share.store; store < stores; store += share.across) {
        uint first = 4u * store % 6u;
        float4 normal_point = outline[4u * store / 6u];
        float4 position_point = outline[(4u * store + 2u) / 6u];
        for (uint ring = share.ring; ring < block.rings; ring += share.step) {
            out[ring * stores + store] = four_floats(&rings, ring, first, normal_point, position_point);
        }
    }
    if (params.indexed == 0u) {
        return;
    }
    for (uint store = share.store; store < stores; store += share.across) {
        uint4 own = pattern[store] + block.first_vertex;
        for (uint ring = share.ring; ring < block.quads; ring += share.step) {
            indices[block.first_index / 4u + ring * stores + store] = own + ring * params.sides;
        }
    }
}

// Meshes a chunk with an odd number of sides, 8 bytes at a time.
__kernel void mesh_odd(const Params params, const ulong window, __global const uint4 *points,
                       __global const YarnRow *yarns, __global const Block *blocks, __global const uint *rolls,
                       __global const uint *whole, __global const float4 *outlines, __global const uint2 *pattern,
                       __global float2 *vertices, __global uint2 *indices) {
    __local BlockRings rings;
    size_t row = get_global_id(0) / get_local_size(0);
    uint lane = get_local_id(0);
    Block block = blocks[row];
    YarnRow yarn = yarns[block.yarn];
    block_rings(points + window, &params, &yarn, &block, rolls, whole, lane, &rings);

    uint stores = 3u * params.sides;
    Share share = share_of(lane, (uint)get_local_size(0), stores);
    __global const float4 *outline = outlines + yarn.section * params.sides;
    __global float2 *out = vertices + 3 * (size_t)block.first_vertex;
    for (uint store = share.store; store < stores; store += share.across) {
        uint first = 2u * store % 6u;
        float4 point = outline[store / 3u];
        for (uint ring = share.ring; ring < block.rings; ring += share.step) {
            out[ring * stores + store] = two_floats(&rings, ring, first, point);
        }
    }
    if (params.indexed == 0u) {
        return;
    }
    for (uint store = share.store; store < stores; store += share.across) {
        uint2 own = pattern[store] + block.first_vertex;
        for (uint ring = share.ring; ring < block.quads; ring += share.step) {
            indices[block.first_index / 2u + ring * stores + store] = own + ring * params.sides;
        }
    }
}
