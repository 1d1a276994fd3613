// The roll at each block's start, summed over the blocks before it. This file follows common.wgsl.
//
// Its twins are scan.cl and texere-cpu's serial/scan.rs. The turn of a block is the sum of its
// steps. A running sum over a yarn's blocks then gives the roll at each block's first ring. Turns
// wrap, so the order of the sums does not matter.

const TURNS_GROUP = 64u;
const ROLLS_GROUP = 256u;

// The total turn of each yarn, then the roll at each block's start.
@group(0) @binding(4) var<storage, read_write> rolls: array<u32>;

var<workgroup> turn_tangents: array<vec3<f32>, TURNS_GROUP>;
var<workgroup> turn_offsets: array<vec3<f32>, TURNS_GROUP>;
var<workgroup> turn_sums: array<u32, TURNS_GROUP>;

// Writes the turn of each block of a chunk. It runs with one workgroup of TURNS_GROUP lanes for
// each row of the chunk's block table.
@compute @workgroup_size(TURNS_GROUP)
fn block_turns(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
               @builtin(local_invocation_index) lane: u32) {
    let row = group.y * grid.x + group.x;
    if row >= params.blocks {
        return;
    }
    let block = blocks[row];
    let yarn = yarns[block.yarn];

    var here: RingSample;
    if lane < block.rings {
        here = ring_sample(yarn, block, lane);
        turn_tangents[lane] = here.sample.tangent;
        turn_offsets[lane] = here.sample.offset;
    }
    workgroupBarrier();
    // A step leads from a ring to the next. There are as many steps as rings from which quads
    // start, so the last step leads to the next block's first ring.
    var turn = 0u;
    if lane < block.quads {
        var next_tangent: vec3<f32>;
        var next_offset: vec3<f32>;
        if lane + 1u < block.rings {
            next_tangent = turn_tangents[lane + 1u];
            next_offset = turn_offsets[lane + 1u];
        } else {
            let next = ring_sample(yarn, block, lane + 1u);
            next_tangent = next.sample.tangent;
            next_offset = next.sample.offset;
        }
        turn = frame_step(yarn.frame, here.sample.tangent, next_tangent, chord_to(here, next_offset), yarn.twist);
    }
    turn_sums[lane] = turn;
    workgroupBarrier();
    // Eight lanes add up eight turns each, then one lane adds up the eight sums.
    if lane < TURNS_GROUP / 8u {
        for (var further = lane + 8u; further < TURNS_GROUP; further += 8u) {
            turn += turn_sums[further];
        }
        turn_sums[lane] = turn;
    }
    workgroupBarrier();
    if lane == 0u {
        for (var further = 1u; further < TURNS_GROUP / 8u; further++) {
            turn += turn_sums[further];
        }
        rolls[params.yarns + yarn.first_block + block.first_ring / BLOCK_RINGS] = turn;
    }
}

var<workgroup> roll_sums: array<u32, ROLLS_GROUP>;

// Replaces the turn of each block by the roll at the block's start, one tile of ROLLS_GROUP blocks
// after the other. The sum of all turns is the yarn's total turn. One workgroup of ROLLS_GROUP
// lanes runs for each of `params.blocks` yarns from `params.first_yarn` on.
@compute @workgroup_size(ROLLS_GROUP)
fn yarn_rolls(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
              @builtin(local_invocation_index) lane: u32) {
    let row = group.y * grid.x + group.x;
    if row >= params.blocks {
        return;
    }
    let number = params.first_yarn + row;
    let yarn = yarns[number];
    let blocks = (yarn.rings - 1u) / BLOCK_RINGS + 1u;
    let own = params.yarns + yarn.first_block;

    var before = 0u;
    for (var tile = 0u; tile < blocks; tile += ROLLS_GROUP) {
        let block = tile + lane;
        var turn = 0u;
        if block < blocks {
            turn = rolls[own + block];
        }
        roll_sums[lane] = turn;
        for (var reach = 1u; reach < ROLLS_GROUP; reach *= 2u) {
            workgroupBarrier();
            var further = 0u;
            if lane >= reach {
                further = roll_sums[lane - reach];
            }
            workgroupBarrier();
            roll_sums[lane] += further;
        }
        workgroupBarrier();
        if block < blocks {
            rolls[own + block] = before + roll_sums[lane] - turn;
        }
        before += roll_sums[ROLLS_GROUP - 1u];
        workgroupBarrier();
    }
    if lane == 0u {
        rolls[number] = before;
    }
}
