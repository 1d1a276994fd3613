// A block's rings in workgroup memory: what the stages of the schedule per-ring begin with. After common.wgsl.
//
// rings.cl is the twin of this file.

// The whole turn of each yarn, then the roll at each block's start: one buffer, since eight are all that WebGPU promises.
@group(0) @binding(4) var<storage, read> rolls: array<u32>;

// The rings of a block, each with its side and its roll. `up_of` works out the rest of the basis instead of storing it: the
// less memory a workgroup takes, the more of them run at a time.
struct BlockRings {
    // Centre, half width.
    centre: array<vec4<f32>, BLOCK_RINGS>,
    // Unit tangent, growth of the half width.
    tangent: array<vec4<f32>, BLOCK_RINGS>,
    // As `side_of` gives it, and the half height.
    side: array<vec4<f32>, BLOCK_RINGS>,
    height_growth: array<f32, BLOCK_RINGS>,
    // Sine and cosine of the roll: where yarns are FLATTENED.
    sin_cos: array<vec2<f32>, BLOCK_RINGS>,
    roll: array<u32, BLOCK_RINGS>,
    // The turns of each eight rings.
    eights: array<u32, BLOCK_RINGS / 8u>,
}

var<workgroup> standing: BlockRings;

// Makes the rings of `block`: one lane a ring. Every lane of the workgroup, which has
// at least BLOCK_RINGS, must come here.
fn block_rings(yarn: YarnRow, block: Block, lane: u32) {
    var here: RingSample;
    var roll = 0u;
    if lane < block.rings {
        here = ring_sample(yarn, block, lane);
        standing.tangent[lane] = vec4(here.sample.tangent, here.sample.width_growth);
        // The step from the ring before needs the offset; the side takes its place afterwards.
        standing.side[lane] = vec4(here.sample.offset, 0.0);
    }
    if params.rolled != 0u {
        workgroupBarrier();
        var turn = 0u;
        if lane + 1u < block.rings {
            let chord = chord_to(here, standing.side[lane + 1u].xyz);
            turn = frame_step(params.frame, here.sample.tangent, standing.tangent[lane + 1u].xyz, chord, yarn.twist);
        }
        if lane < BLOCK_RINGS {
            standing.roll[lane] = turn;
        }
        // An inclusive scan of the steps, first within eight lanes, then across the eights.
        workgroupBarrier();
        var sum = 0u;
        if lane < BLOCK_RINGS {
            for (var before = lane / 8u * 8u; before <= lane; before++) {
                sum += standing.roll[before];
            }
            if lane % 8u == 7u {
                standing.eights[lane / 8u] = sum;
            }
        }
        workgroupBarrier();
        if lane < block.rings {
            for (var before = 0u; before < lane / 8u; before++) {
                sum += standing.eights[before];
            }
            let start = rolls[params.yarns + yarn.first_block + block.first_ring / BLOCK_RINGS];
            roll = closed_up(yarn, block.first_ring + lane, start + sum - turn, rolls[block.yarn]);
        }
    }
    if lane < block.rings {
        standing.centre[lane] = vec4(here.sample.centre, here.sample.half_width);
        standing.side[lane] = vec4(side_of(here.sample.tangent, roll), here.sample.half_height);
        standing.height_growth[lane] = here.sample.height_growth;
        standing.roll[lane] = roll;
        if FLATTENED {
            standing.sin_cos[lane] = turn_sin_cos(roll);
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
