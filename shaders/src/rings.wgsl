// The rings of a block in workgroup memory. Stages 1 and 2 of the schedule per-ring begin with
// them. This file follows common.wgsl and the constant RINGS_BEYOND, which is 1 if the ring that
// the block's last quads lead to is wanted, too, and otherwise 0.
//
// rings.cl is the twin of this file.

// The number of rings that there is room for. It is a multiple of eight, as the scan requires.
const RINGS_HELD = BLOCK_RINGS + 8u * RINGS_BEYOND;

// The total turn of each yarn, then the roll at each block's start, then, if any yarn leans, the
// leans of all rings. They share one buffer, because WebGPU guarantees only eight.
@group(0) @binding(4) var<storage, read> rolls: array<u32>;

// The rings of a block, each with its side and its roll. The rest of the basis is not stored:
// `up_of` works it out. The less memory a workgroup takes, the more workgroups run at a time.
struct BlockRings {
    // Centre, half width.
    centre: array<vec4<f32>, RINGS_HELD>,
    // Unit tangent, growth of the half width.
    tangent: array<vec4<f32>, RINGS_HELD>,
    // The side of `side_of`, and the half height.
    side: array<vec4<f32>, RINGS_HELD>,
    height_growth: array<f32, RINGS_HELD>,
    // Sine and cosine of the roll less the lean. They have values only at rings that are not round.
    sin_cos: array<vec2<f32>, RINGS_HELD>,
    roll: array<u32, RINGS_HELD>,
    // Sums of the turns of eight rings each.
    eights: array<u32, RINGS_HELD / 8u>,
}

var<workgroup> standing: BlockRings;

// The number of rings that are made for `block`.
fn rings_made(block: Block) -> u32 {
    return min(block.rings + RINGS_BEYOND, max(block.rings, block.quads + 1u));
}

// The lean of ring `ring` of a yarn.
fn lean_of(yarn: YarnRow, ring: u32) -> u32 {
    if params.leans == 0u {
        return 0u;
    }
    return rolls[params.yarns + params.leans + yarn.first_block * BLOCK_RINGS + ring];
}

// Makes the rings of `block`, with one lane for each ring. The workgroup has at least RINGS_HELD
// lanes, and every lane must call this function.
fn block_rings(yarn: YarnRow, block: Block, lane: u32) {
    let rings = rings_made(block);
    var here: RingSample;
    var roll = 0u;
    var lean = 0u;
    if lane < rings {
        here = ring_sample(yarn, block, lane);
        standing.tangent[lane] = vec4(here.sample.tangent, here.sample.width_growth);
        // The offset is stored for the step from the ring before. Later the side is stored in its
        // place.
        standing.side[lane] = vec4(here.sample.offset, 0.0);
    }
    if params.rolled != 0u {
        workgroupBarrier();
        var turn = 0u;
        if lane + 1u < rings {
            let chord = chord_to(here, standing.side[lane + 1u].xyz);
            turn = frame_step(yarn.frame, here.sample.tangent, standing.tangent[lane + 1u].xyz, chord, yarn.twist);
        }
        if lane < RINGS_HELD {
            standing.roll[lane] = turn;
        }
        // An inclusive scan of the steps, first within eight lanes, then across the eights.
        workgroupBarrier();
        var sum = 0u;
        if lane < RINGS_HELD {
            for (var before = lane / 8u * 8u; before <= lane; before++) {
                sum += standing.roll[before];
            }
            if lane % 8u == 7u {
                standing.eights[lane / 8u] = sum;
            }
        }
        workgroupBarrier();
        if lane < rings {
            for (var before = 0u; before < lane / 8u; before++) {
                sum += standing.eights[before];
            }
            let start = rolls[params.yarns + yarn.first_block + block.first_ring / BLOCK_RINGS];
            roll = closed_up(yarn, block.first_ring + lane, start + sum - turn, rolls[block.yarn]);
            lean = lean_of(yarn, block.first_ring + lane);
            // An upright section turns by the lean of its ring. A section in a rotation minimising
            // frame starts with the lean of its yarn's first ring.
            if yarn.frame == ROTATION_MINIMIZING {
                roll += lean_of(yarn, 0u);
            } else {
                roll += lean;
            }
        }
    }
    if lane < rings {
        standing.centre[lane] = vec4(here.sample.centre, here.sample.half_width);
        let round = is_round(vec2(here.sample.half_width, here.sample.width_growth),
                             vec2(here.sample.half_height, here.sample.height_growth));
        standing.side[lane] = vec4(side_of(here.sample.tangent, roll, lean, round), here.sample.half_height);
        standing.height_growth[lane] = here.sample.height_growth;
        standing.roll[lane] = roll;
        if !round {
            standing.sin_cos[lane] = turn_sin_cos(roll - lean);
        }
    }
    workgroupBarrier();
}

// How a section stands on ring `ring`.
fn stance_of(ring: u32) -> Stance {
    let side = standing.side[ring];
    let height = vec2(side.w, standing.height_growth[ring]);
    return stance_new(standing.centre[ring], standing.tangent[ring], side.xyz, height, standing.sin_cos[ring]);
}
