// The blocks of a chunk that a picture may show, as a list. After fabric.wgsl.

const CULL_GROUP = 64u;

// Slack of the boxes, as a share of the largest coordinate, and of what is added to them.
const BOX_SLACK = 1e-5;

@group(1) @binding(2) var<storage, read_write> listed: Listed;
// Workgroups of the dispatch that goes through the blocks, or through those that were left.
@group(1) @binding(3) var<storage, read_write> groups: array<u32, 3>;

struct Box {
    low: vec3<f32>,
    high: vec3<f32>,
}

// A box that holds the block's tube: the Bezier hull of its spline, made wider by as much as the section may reach out.
fn box_of(block: Block) -> Box {
    let per_interval = params.subdivisions + 1u;
    let last = block.first_ring % per_interval + block.quads;
    let intervals = (last + per_interval - 1u) / per_interval;
    let third = params.s / 3.0;
    var before = points[block.first_point];
    var here = points[block.first_point + 1u];
    var next = points[block.first_point + 2u];
    var low = vec3(1e38);
    var high = vec3(-1e38);
    var size = 0.0;
    for (var interval = 0u; interval < intervals; interval++) {
        let after = points[block.first_point + interval + 3u];
        let start = vec4(bitcast<vec3<f32>>(here.xyz), 0.0);
        let end = vec4(bitcast<vec3<f32>>(next.xyz), 0.0);
        let leaving = (end.xyz - bitcast<vec3<f32>>(before.xyz)) * third;
        let arriving = (bitcast<vec3<f32>>(after.xyz) - start.xyz) * third;
        let leans = start.xyz + leaving;
        let leads = end.xyz - arriving;
        low = min(low, min(min(start.xyz, end.xyz), min(leans, leads)));
        high = max(high, max(max(start.xyz, end.xyz), max(leans, leads)));
        let sizes_here = unpack2x16float(here.w);
        let sizes_next = unpack2x16float(next.w);
        let first = sizes_here + (sizes_next - unpack2x16float(before.w)) * third;
        let second = sizes_next - (unpack2x16float(after.w) - sizes_here) * third;
        let most = max(max(sizes_here, sizes_next), max(first, second));
        size = max(size, max(most.x, most.y));
        before = here;
        here = next;
        next = after;
    }
    let largest = max(abs(low), abs(high));
    let reach = size * sweep.reach * (1.0 + BOX_SLACK) + sweep.hair_reach + BOX_SLACK * max(largest.x, max(largest.y, largest.z));
    return Box(low - reach, high + reach);
}

// Whether all of the box lies beyond one side of the view.
fn is_outside(bounds: Box) -> bool {
    // Pixels of slack, for what corners are moved by.
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

// A lane a row of the chunk's block table. A row without quads only has the roll of a ring that a cap closes.
@compute @workgroup_size(CULL_GROUP)
fn cull(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
        @builtin(local_invocation_index) lane: u32) {
    let row = (group.y * grid.x + group.x) * CULL_GROUP + lane;
    if row >= params.blocks {
        return;
    }
    let block = blocks[row];
    if block.quads == 0u {
        if params.rolled == 0u {
            return;
        }
    } else if is_outside(box_of(block)) {
        return;
    }
    listed.rows[atomicAdd(&listed.count, 1u)] = row;
}

fn set_groups(count: u32) {
    let rows = (count + 65534u) / 65535u;
    groups[0] = (count + max(rows, 1u) - 1u) / max(rows, 1u);
    groups[1] = rows;
    groups[2] = 1u;
}

// A single lane: what the list takes, in columns and rows, before any block is left.
@compute @workgroup_size(1)
fn count_listed() {
    atomicStore(&listed.left_count, 0u);
    set_groups(atomicLoad(&listed.count));
}

// The same for those that were left.
@compute @workgroup_size(1)
fn count_left() {
    set_groups(atomicLoad(&listed.left_count) * LEFT_SHARES);
}
