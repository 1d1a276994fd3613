// The roll at each block's start, summed over the blocks before it. This file follows common.cl.
//
// Its twins are scan.wgsl and texere-cpu's serial/scan.rs. The turn of a block is the sum of its
// steps. A running sum over a yarn's blocks then gives the roll at each block's first ring. Turns
// wrap, so the order of the sums does not matter.

#define TURNS_GROUP 64
#define ROLLS_GROUP 256

// Writes the turn of each block of a chunk. It runs with one workgroup of TURNS_GROUP lanes for
// each row of the chunk's block table.
__kernel __attribute__((reqd_work_group_size(TURNS_GROUP, 1, 1)))
void block_turns(const Params params, const ulong window, __global const float4 *points,
                 __global const YarnRow *yarns, __global const Block *blocks, __global uint *rolls) {
    __local float3 tangents[TURNS_GROUP];
    __local float3 offsets[TURNS_GROUP];
    __local uint sums[TURNS_GROUP];
    size_t row = get_global_id(0) / TURNS_GROUP;
    uint lane = get_local_id(0);
    Block block = blocks[row];
    YarnRow yarn = yarns[block.yarn];

    RingSample here;
    if (lane < block.rings) {
        here = ring_sample(points + window, &params, &yarn, &block, lane);
        tangents[lane] = here.sample.tangent;
        offsets[lane] = here.sample.offset;
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    // A step leads from a ring to the next. There are as many steps as rings from which quads
    // start, so the last step leads to the next block's first ring.
    uint turn = 0u;
    if (lane < block.quads) {
        float3 next_tangent;
        float3 next_offset;
        if (lane + 1u < block.rings) {
            next_tangent = tangents[lane + 1u];
            next_offset = offsets[lane + 1u];
        } else {
            RingSample next = ring_sample(points + window, &params, &yarn, &block, lane + 1u);
            next_tangent = next.sample.tangent;
            next_offset = next.sample.offset;
        }
        turn = frame_step(yarn.frame, here.sample.tangent, next_tangent, chord_to(&here, next_offset), yarn.twist);
    }
    sums[lane] = turn;
    barrier(CLK_LOCAL_MEM_FENCE);
    // Eight lanes add up eight turns each, then one lane adds up the eight sums.
    if (lane < TURNS_GROUP / 8) {
        for (uint further = lane + 8u; further < TURNS_GROUP; further += 8u) {
            turn += sums[further];
        }
        sums[lane] = turn;
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    if (lane == 0u) {
        for (uint further = 1u; further < TURNS_GROUP / 8; further++) {
            turn += sums[further];
        }
        rolls[yarn.first_block + block.first_ring / BLOCK_RINGS] = turn;
    }
}

// Replaces the turn of each block by the roll at the block's start, one tile of ROLLS_GROUP blocks
// after the other. The sum of all turns is the yarn's total turn. One workgroup of ROLLS_GROUP
// lanes runs for each yarn.
__kernel __attribute__((reqd_work_group_size(ROLLS_GROUP, 1, 1)))
void yarn_rolls(__global const YarnRow *yarns, __global uint *rolls, __global uint *whole) {
    __local uint sums[ROLLS_GROUP];
    size_t number = get_global_id(0) / ROLLS_GROUP;
    uint lane = get_local_id(0);
    YarnRow yarn = yarns[number];
    uint blocks = (yarn.rings - 1u) / BLOCK_RINGS + 1u;
    __global uint *own = rolls + yarn.first_block;

    uint before = 0u;
    for (uint tile = 0u; tile < blocks; tile += ROLLS_GROUP) {
        uint block = tile + lane;
        uint turn = block < blocks ? own[block] : 0u;
        sums[lane] = turn;
        for (uint reach = 1u; reach < ROLLS_GROUP; reach *= 2u) {
            barrier(CLK_LOCAL_MEM_FENCE);
            uint further = lane >= reach ? sums[lane - reach] : 0u;
            barrier(CLK_LOCAL_MEM_FENCE);
            sums[lane] += further;
        }
        barrier(CLK_LOCAL_MEM_FENCE);
        if (block < blocks) {
            own[block] = before + sums[lane] - turn;
        }
        before += sums[ROLLS_GROUP - 1];
        barrier(CLK_LOCAL_MEM_FENCE);
    }
    if (lane == 0u) {
        whole[number] = before;
    }
}
