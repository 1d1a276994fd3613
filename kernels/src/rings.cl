// The rings of a block in local memory. Stages 1 and 2 of the schedule per-ring begin with them.
// This file follows common.cl.
//
// rings.wgsl is the twin of this file.

// The rings of a block, each with its side and its roll. The rest of the basis is not stored:
// `up_of` works it out. The less memory a workgroup takes, the more workgroups run at a time.
typedef struct {
    // Centre, half width.
    float4 centre[BLOCK_RINGS];
    // Unit tangent, growth of the half width.
    float4 tangent[BLOCK_RINGS];
    // The side of `side_of`, and the half height.
    float4 side[BLOCK_RINGS];
    float height_growth[BLOCK_RINGS];
    // Sine and cosine of the roll less the lean. They have values only at rings that are not round.
    float2 sin_cos[BLOCK_RINGS];
    uint roll[BLOCK_RINGS];
    // Sums of the turns of eight rings each.
    uint eights[BLOCK_RINGS / 8];
} BlockRings;

// The lean of ring `ring` of a yarn. If any yarn leans, `rolls` holds the leans of all rings behind
// the rolls of blocks.
uint lean_of(const Params *params, const YarnRow *yarn, __global const uint *rolls, uint ring) {
    return params->leans == 0u ? 0u : rolls[params->leans + yarn->first_block * BLOCK_RINGS + ring];
}

// Makes the rings of `block`, with one lane for each ring. The workgroup has at least BLOCK_RINGS
// lanes, and every lane must call this function.
void block_rings(__global const uint4 *points, const Params *params, const YarnRow *yarn, const Block *block,
                 __global const uint *rolls, __global const uint *whole, uint lane,
                 __local BlockRings *rings) {
    RingSample here;
    uint roll = 0u;
    uint lean = 0u;
    if (lane < block->rings) {
        here = ring_sample(points, params, yarn, block, lane);
        rings->tangent[lane] = (float4)(here.sample.tangent, here.sample.width_growth);
        // The offset is stored for the step from the ring before. Later the side is stored in its
        // place.
        rings->side[lane] = (float4)(here.sample.offset, 0.0f);
    }
    if (params->rolled != 0u) {
        barrier(CLK_LOCAL_MEM_FENCE);
        uint turn = 0u;
        if (lane + 1u < block->rings) {
            float3 chord = chord_to(&here, rings->side[lane + 1u].xyz);
            turn = frame_step(yarn->frame, here.sample.tangent, rings->tangent[lane + 1u].xyz, chord, yarn->twist);
        }
        if (lane < BLOCK_RINGS) {
            rings->roll[lane] = turn;
        }
        // An inclusive scan of the steps, first within eight lanes, then across the eights.
        barrier(CLK_LOCAL_MEM_FENCE);
        uint sum = 0u;
        if (lane < BLOCK_RINGS) {
            for (uint before = lane / 8u * 8u; before <= lane; before++) {
                sum += rings->roll[before];
            }
            if (lane % 8u == 7u) {
                rings->eights[lane / 8u] = sum;
            }
        }
        barrier(CLK_LOCAL_MEM_FENCE);
        if (lane < block->rings) {
            for (uint before = 0u; before < lane / 8u; before++) {
                sum += rings->eights[before];
            }
            uint start = rolls[yarn->first_block + block->first_ring / BLOCK_RINGS];
            roll = closed_up(yarn, block->first_ring + lane, start + sum - turn, whole[block->yarn]);
            lean = lean_of(params, yarn, rolls, block->first_ring + lane);
            // An upright section turns by the lean of its ring. A section in a rotation minimising
            // frame starts with the lean of its yarn's first ring.
            roll += yarn->frame == ROTATION_MINIMIZING ? lean_of(params, yarn, rolls, 0u) : lean;
        }
    }
    if (lane < block->rings) {
        rings->centre[lane] = (float4)(here.sample.centre, here.sample.half_width);
        bool round = is_round((float2)(here.sample.half_width, here.sample.width_growth),
                              (float2)(here.sample.half_height, here.sample.height_growth));
        rings->side[lane] = (float4)(side_of(here.sample.tangent, roll, lean, round), here.sample.half_height);
        rings->height_growth[lane] = here.sample.height_growth;
        rings->roll[lane] = roll;
        if (!round) {
            rings->sin_cos[lane] = turn_sin_cos(roll - lean);
        }
    }
    barrier(CLK_LOCAL_MEM_FENCE);
}

// How a section stands on ring `ring`.
Stance stance_of(__local const BlockRings *rings, uint ring) {
    float4 side = rings->side[ring];
    float2 height = (float2)(side.w, rings->height_growth[ring]);
    return stance_new(rings->centre[ring], rings->tangent[ring], side.xyz, height, rings->sin_cos[ring]);
}
