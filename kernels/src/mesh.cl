// Stage 2 with stage 1 in it: the vertices and indices of a chunk's tubes. After common.cl and rings.cl.
//
// The twin of mesh.wgsl and of texere-cpu's serial/mesh.rs. Memory is what limits this stage, so lanes store 16 bytes
// at a time, contiguous across the workgroup, and work a vertex out again rather than stride.

#define MESH_GROUP 128

// Vertex `number` of a block, whose section is `outline`.
Vertex block_vertex(__local const BlockRings *rings, __global const float4 *outline, uint sides, uint number) {
    uint ring = number / sides;
    return vertex_at(rings->centre[ring], rings->tangent[ring], rings->side[ring].xyz, rings->up[ring].xyz,
                     outline[number % sides]);
}

// Four floats of a block's vertices from float `at` on, which is even: so they hold no more than one normal, or the end
// of one, and one position, or the start of one.
float4 four_floats(__local const BlockRings *rings, __global const float4 *outline, uint sides, uint at) {
    float3 normal = block_vertex(rings, outline, sides, at / 6u).normal;
    float3 position = block_vertex(rings, outline, sides, (at + 2u) / 6u).position;
    switch (at % 6u) {
        case 0u: return (float4)(position, normal.x);
        case 2u: return (float4)(position.z, normal);
        default: return (float4)(normal.yz, position.xy);
    }
}

// Two floats likewise.
float2 two_floats(__local const BlockRings *rings, __global const float4 *outline, uint sides, uint at) {
    Vertex vertex = block_vertex(rings, outline, sides, at / 6u);
    switch (at % 6u) {
        case 0u: return vertex.position.xy;
        case 2u: return (float2)(vertex.position.z, vertex.normal.x);
        default: return vertex.normal.yz;
    }
}

// Writes the `count` floats of a block's vertices. They start `head` floats, 0 or 2, before a multiple of 16 bytes;
// what is left at either end goes by two.
void write_vertices(__local const BlockRings *rings, __global const float4 *outline, uint sides, uint count,
                    uint head, uint lane, __global float *vertices) {
    uint tail = head + (count - head) / 4u * 4u;
    for (uint at = head + 4u * lane; at < tail; at += 4u * MESH_GROUP) {
        *(__global float4 *)(vertices + at) = four_floats(rings, outline, sides, at);
    }
    if (lane == 0u && head != 0u) {
        vstore2(two_floats(rings, outline, sides, 0u), 0, vertices);
    }
    if (lane == 1u && tail < count) {
        vstore2(two_floats(rings, outline, sides, tail), 0, vertices + tail);
    }
}

// Four indices of a block from index `at` on. `pattern` holds those of a ring's quads and of the next ring's.
uint4 four_indices(__global const uint *pattern, uint sides, uint first_vertex, uint at) {
    uint per_ring = 6u * sides;
    return vload4(0, pattern + at % per_ring) + (first_vertex + at / per_ring * sides);
}

// Writes the `count` indices of a block, as `write_vertices` does its floats.
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
    size_t row = get_global_id(0) / MESH_GROUP;
    uint lane = get_local_id(0);
    Block block = blocks[row];
    YarnRow yarn = yarns[block.yarn];
    uint start = params.rolled != 0u ? rolls[params.first_block + row] : 0u;
    uint turned = params.rolled != 0u ? whole[block.yarn] : 0u;
    block_rings(points + window, &params, &yarn, &block, start, turned, lane, &rings);

    // A vertex is 24 bytes, so every other one starts at a multiple of 16; indices come in pairs.
    __global const float4 *outline = outlines + yarn.section * params.sides;
    write_vertices(&rings, outline, params.sides, 6u * block.rings * params.sides, 2u * (block.first_vertex % 2u), lane,
                   vertices + 6 * (size_t)block.first_vertex);
    if (params.indexed != 0u && block.quads != 0u) {
        write_indices(pattern, params.sides, block.first_vertex, 6u * block.quads * params.sides,
                      block.first_index % 4u, lane, indices + block.first_index);
    }
}
