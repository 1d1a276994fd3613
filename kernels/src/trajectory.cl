// Stage 1: the rings of a chunk. This file follows common.cl and rings.cl.
//
// Its twins are trajectory.wgsl and texere-cpu's serial/trajectory.rs.

#define TRAJECTORY_GROUP 64

// Writes the rings of a chunk, with one workgroup of TRAJECTORY_GROUP lanes for each row of its
// block table.
__kernel __attribute__((reqd_work_group_size(TRAJECTORY_GROUP, 1, 1)))
void trajectory(const Params params, const ulong window, __global const uint4 *points,
                __global const YarnRow *yarns, __global const Block *blocks, __global const uint *rolls,
                __global const uint *whole, __global uint4 *rings) {
    __local BlockRings standing;
    size_t row = get_global_id(0) / TRAJECTORY_GROUP;
    uint lane = get_local_id(0);
    Block block = blocks[row];
    YarnRow yarn = yarns[block.yarn];
    block_rings(points + window, &params, &yarn, &block, rolls, whole, lane, &standing);

    // Three stores of 16 bytes a ring, contiguous across lanes.
    __global uint4 *out = rings + 3 * (size_t)block.chunk_ring;
    for (uint piece = lane; piece < 3u * block.rings; piece += TRAJECTORY_GROUP) {
        uint ring = piece / 3u;
        float4 centre = standing.centre[ring];
        float4 tangent = standing.tangent[ring];
        if (piece % 3u == 0u) {
            out[piece] = as_uint4(centre);
        } else if (piece % 3u == 1u) {
            out[piece] = (uint4)(as_uint(tangent.x), as_uint(tangent.y), as_uint(tangent.z), standing.roll[ring]);
        } else {
            uint lean = lean_of(&params, &yarn, rolls, block.first_ring + ring);
            out[piece] = (uint4)(as_uint(standing.side[ring].w), as_uint(tangent.w),
                                 as_uint(standing.height_growth[ring]), lean);
        }
    }
}
