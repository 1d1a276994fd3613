// Stage 2 with stage 1 in it: the vertices and indices of a chunk's tubes. After common.cl and rings.cl.
//
// The twin of mesh.wgsl and of texere-cpu's serial/mesh.rs. Memory is what limits this stage, so lanes store 16 bytes
// at a time, contiguous across the workgroup. To get there vertices go through local memory, a tile of rings at a time,
// where mesh.wgsl works a vertex out again.

#define MESH_GROUP 128

// Vertices of a tile at most: a whole block of six-sided rings, and more than a ring has sides.
#define TILE_VERTICES 384u

// Works out the vertices of `count` rings from ring `first` on, three pairs of floats each. A lane keeps to one ring of
// the tile's `tile`, which it reads once, and shares its corners with the other lanes of that ring.
void stage_vertices(__local const BlockRings *rings, __global const float4 *outline, uint sides, uint first, uint count,
                    uint tile, uint lane, __local float2 *staged) {
    uint ring = lane % tile;
    uint lanes_a_ring = MESH_GROUP / tile;
    if (ring >= count || lane / tile >= lanes_a_ring) {
        return;
    }
    float4 centre = rings->centre[first + ring];
    float4 tangent = rings->tangent[first + ring];
    float3 side = rings->side[first + ring].xyz;
    float3 up = rings->up[first + ring].xyz;
    for (uint corner = lane / tile; corner < sides; corner += lanes_a_ring) {
        Vertex vertex = vertex_at(centre, tangent, side, up, outline[corner]);
        __local float2 *pairs = staged + 3u * (ring * sides + corner);
        pairs[0] = vertex.position.xy;
        pairs[1] = (float2)(vertex.position.z, vertex.normal.x);
        pairs[2] = vertex.normal.yz;
    }
}

// Writes `count` pairs of floats from where they are staged. They start `head` pairs, 0 or 1, before a multiple of 16
// bytes; what is left at either end goes alone.
void write_vertices(__local const float2 *staged, uint count, uint head, uint lane, __global float *vertices) {
    uint tail = head + (count - head) / 2u * 2u;
    for (uint at = head + 2u * lane; at < tail; at += 2u * MESH_GROUP) {
        *(__global float4 *)(vertices + 2u * at) = (float4)(staged[at], staged[at + 1u]);
    }
    if (lane == 0u && head != 0u) {
        vstore2(staged[0], 0, vertices);
    }
    if (lane == 1u && tail < count) {
        vstore2(staged[tail], 0, vertices + 2u * tail);
    }
}

// `at` / `per_ring`, exactly: neither is so large that half of one for safety would not do, and it takes a fraction of
// the time of a division of integers.
uint ring_of(uint at, uint per_ring) {
    return (uint)(((float)at + 0.5f) * (1.0f / (float)per_ring));
}

// Four indices of a block from index `at` on. `pattern` holds those of a ring's quads and of the next ring's.
uint4 four_indices(__global const uint *pattern, uint sides, uint first_vertex, uint at) {
    uint ring = ring_of(at, 6u * sides);
    return vload4(0, pattern + (at - ring * 6u * sides)) + (first_vertex + ring * sides);
}

// Writes the `count` indices of a block; they start `head` indices before a multiple of 16 bytes, 0 or 2.
void write_indices(__global const uint *pattern, uint sides, uint first_vertex, uint count, uint head, uint lane,
                   __global uint *indices) {
    uint tail = head + (count - head) / 4u * 4u;
    for (uint at = head + 4u * lane; at < tail; at += 4u * MESH_GROUP) {
        *(__global uint4 *)(indices + at) = four_indices(pattern, sides, first_vertex, at);
    }
    if (lane == 0u && head != 0u) {
        vstore2(four_indices(pattern, sides, first_vertex, 0u).lo, 0, indices);
    }
    if (lane == 1u && tail < count) {
        vstore2(four_indices(pattern, sides, first_vertex, tail).lo, 0, indices + tail);
    }
}

// A workgroup of MESH_GROUP a row of the chunk's block table.
__kernel __attribute__((reqd_work_group_size(MESH_GROUP, 1, 1)))
void mesh(const Params params, const ulong window, __global const float4 *points, __global const YarnRow *yarns,
          __global const Block *blocks, __global const uint *rolls, __global const uint *whole,
          __global const float4 *outlines, __global const uint *pattern, __global float *vertices,
          __global uint *indices) {
    __local BlockRings rings;
    __local float2 staged[3u * TILE_VERTICES];
    size_t row = get_global_id(0) / MESH_GROUP;
    uint lane = get_local_id(0);
    Block block = blocks[row];
    YarnRow yarn = yarns[block.yarn];
    uint start = params.rolled != 0u ? rolls[params.first_block + row] : 0u;
    uint turned = params.rolled != 0u ? whole[block.yarn] : 0u;
    block_rings(points + window, &params, &yarn, &block, start, turned, lane, &rings);

    // A vertex is 24 bytes, so every other one starts at a multiple of 16; indices come in pairs.
    __global const float4 *outline = outlines + yarn.section * params.sides;
    uint tile = min((uint)BLOCK_RINGS, TILE_VERTICES / params.sides);
    for (uint first = 0u; first < block.rings; first += tile) {
        uint count = min(tile, block.rings - first);
        uint first_vertex = block.first_vertex + first * params.sides;
        stage_vertices(&rings, outline, params.sides, first, count, tile, lane, staged);
        barrier(CLK_LOCAL_MEM_FENCE);
        write_vertices(staged, 3u * count * params.sides, first_vertex % 2u, lane,
                       vertices + 6 * (size_t)first_vertex);
        barrier(CLK_LOCAL_MEM_FENCE);
    }
    if (params.indexed != 0u && block.quads != 0u) {
        write_indices(pattern, params.sides, block.first_vertex, 6u * block.quads * params.sides,
                      block.first_index % 4u, lane, indices + block.first_index);
    }
}
