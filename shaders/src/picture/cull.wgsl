// The blocks of a chunk that a picture may show, as a list. This file follows fabric.wgsl.

const CULL_GROUP = 64u;

// Slack of the boxes, as a share of the largest coordinate and of the reach that is added to them.
const BOX_SLACK = 1e-5;

@group(1) @binding(2) var<storage, read_write> listed: Listed;
// The workgroups of three dispatches: over all listed blocks, over blocks with FEW quads, and over
// blocks with MANY quads.
@group(1) @binding(3) var<storage, read_write> groups: array<array<u32, 3>, 3>;

struct Box {
    low: vec3<f32>,
    high: vec3<f32>,
}

// The number of lanes that share a block, so that they read points side by side.
const BLOCK_LANES = 8u;

// For each lane, the box round the Bezier hulls of its intervals, and the largest half width or
// half height.
var<workgroup> lows: array<vec3<f32>, CULL_GROUP>;
var<workgroup> highs: array<vec3<f32>, CULL_GROUP>;
var<workgroup> sizes: array<f32, CULL_GROUP>;

// Finds the box and the size of the intervals of one lane, which is lane `part` of the block's
// lanes.
fn find_hull(block: Block, lane: u32, part: u32) {
    let per_interval = params.subdivisions + 1u;
    let last = block.first_ring % per_interval + block.quads;
    let intervals = (last + per_interval - 1u) / per_interval;
    let third = params.s / 3.0;
    var low = vec3(1e38);
    var high = vec3(-1e38);
    var size = 0.0;
    for (var interval = part; interval < intervals; interval += BLOCK_LANES) {
        let before = points[block.first_point + interval];
        let here = points[block.first_point + interval + 1u];
        let next = points[block.first_point + interval + 2u];
        let after = points[block.first_point + interval + 3u];
        let start = bitcast<vec3<f32>>(here.xyz);
        let end = bitcast<vec3<f32>>(next.xyz);
        let leans = start + (end - bitcast<vec3<f32>>(before.xyz)) * third;
        let leads = end - (bitcast<vec3<f32>>(after.xyz) - start) * third;
        low = min(low, min(min(start, end), min(leans, leads)));
        high = max(high, max(max(start, end), max(leans, leads)));
        let sizes_here = unpack2x16float(here.w);
        let sizes_next = unpack2x16float(next.w);
        let first = sizes_here + (sizes_next - unpack2x16float(before.w)) * third;
        let second = sizes_next - (unpack2x16float(after.w) - sizes_here) * third;
        let most = max(max(sizes_here, sizes_next), max(first, second));
        size = max(size, max(most.x, most.y));
    }
    lows[lane] = low;
    highs[lane] = high;
    sizes[lane] = size;
}

// A box that holds the tube of the block whose lanes begin at `first`: the box of their hulls, made
// larger by as much as the section may reach out.
fn box_of(first: u32) -> Box {
    var low = lows[first];
    var high = highs[first];
    var size = sizes[first];
    for (var lane = first + 1u; lane < first + BLOCK_LANES; lane++) {
        low = min(low, lows[lane]);
        high = max(high, highs[lane]);
        size = max(size, sizes[lane]);
    }
    let largest = max(abs(low), abs(high));
    let reach = size * sweep.reach * (1.0 + BOX_SLACK) + sweep.hair_reach + BOX_SLACK * max(largest.x, max(largest.y, largest.z));
    return Box(low - reach, high + reach);
}

// Whether all of the box lies beyond one side of the view.
fn is_outside(bounds: Box) -> bool {
    // A box counts as outside only if it lies further out than this, because corners are rounded:
    // two pixels, in clip space.
    let spare = 4.0 / view.size;
    let top = 1.0 - 2.0 * f32(sweep.first_row) / view.size.y + spare.y;
    let bottom = 1.0 - 2.0 * f32(sweep.first_row + sweep.rows) / view.size.y - spare.y;
    var left_of = true;
    var right_of = true;
    var above = true;
    var below = true;
    var before = true;
    var behind = true;
    for (var corner = 0u; corner < 8u; corner++) {
        let is_high = vec3((corner & 1u) != 0u, (corner & 2u) != 0u, (corner & 4u) != 0u);
        let clip = clip_of(select(bounds.low, bounds.high, is_high));
        left_of &= clip.x < -(1.0 + spare.x) * clip.w;
        right_of &= clip.x > (1.0 + spare.x) * clip.w;
        above &= clip.y > top * clip.w;
        below &= clip.y < bottom * clip.w;
        before &= clip.z < -1e-5 * abs(clip.w);
        behind &= clip.z > clip.w + 1e-5 * abs(clip.w);
    }
    return left_of || right_of || above || below || before || behind;
}

// Lists the blocks that the view may show, with BLOCK_LANES lanes for each row of the chunk's block
// table. A row without quads is listed only for the roll of a ring that a cap closes.
@compute @workgroup_size(CULL_GROUP)
fn cull(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
        @builtin(local_invocation_index) lane: u32) {
    let row = ((group.y * grid.x + group.x) * CULL_GROUP + lane) / BLOCK_LANES;
    if row < params.blocks {
        find_hull(blocks[row], lane, lane % BLOCK_LANES);
    }
    workgroupBarrier();
    if row >= params.blocks || lane % BLOCK_LANES != 0u {
        return;
    }
    let is_listed = select(!is_outside(box_of(lane)), params.rolled != 0u, blocks[row].quads == 0u);
    if is_listed {
        listed.rows[atomicAdd(&listed.count, 1u)] = row;
    }
}

// Lists all blocks, for a view that shows all of the fabric, with one lane for each row. Culling
// would take a tenth of the time of drawing.
@compute @workgroup_size(CULL_GROUP)
fn list_all(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
            @builtin(local_invocation_index) lane: u32) {
    let row = (group.y * grid.x + group.x) * CULL_GROUP + lane;
    if row < params.blocks {
        listed.rows[row] = row;
    }
    if row == 0u {
        atomicStore(&listed.count, params.blocks);
    }
}

fn groups_of(count: u32) -> array<u32, 3> {
    let rows = (count + 65534u) / 65535u;
    return array((count + max(rows, 1u) - 1u) / max(rows, 1u), rows, 1u);
}

// Writes the workgroups for all listed blocks, in columns and rows. It runs as a single lane.
@compute @workgroup_size(1)
fn count_listed() {
    atomicStore(&listed.few_count, 0u);
    atomicStore(&listed.many_count, 0u);
    groups[0] = groups_of(atomicLoad(&listed.count));
}

// Writes the workgroups for the blocks that were left to later passes, in columns and rows. It runs
// as a single lane.
@compute @workgroup_size(1)
fn count_left() {
    groups[1] = groups_of(atomicLoad(&listed.few_count));
    groups[2] = groups_of(atomicLoad(&listed.many_count) * BLOCK_RINGS);
}
