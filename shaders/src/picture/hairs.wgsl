// Draws the fibres that stand off the yarns of a chunk. This file follows rings.wgsl, fabric.wgsl,
// cover.wgsl and hair.wgsl.
//
// A fibre is drawn as a ribbon that faces the eye, at its true width. If the width is less than the
// distance between samples, the ribbon covers, on average, as many samples as correspond to its
// area. Thin fibres thus come out fainter, not thicker.

const HAIR_GROUP = 128u;

// The largest number below 1. A depth of 1 stands for a sample that shows nothing.
const DEEPEST = 0.99999994;

@group(1) @binding(2) var<storage, read_write> listed: Listed;
// The number of hairs on each mm of each yarn.
@group(1) @binding(6) var<storage, read> hair_density: array<f32>;

// The hairs of a block. Each entry is the number of the ring before the hair's gap, times
// HAIRS_OF_GAP, plus the hair's number in the gap.
var<workgroup> block_hairs: array<u32, BLOCK_RINGS * HAIRS_OF_GAP>;
var<workgroup> hair_count: atomic<u32>;

// Notes the hairs of the gap after ring `ring` of the block. Their number is the gap's length times
// the yarn's density of hairs, rounded up or down by chance, and HAIRS_OF_GAP at most.
fn note_hairs(block: Block, ring: u32) {
    let length = distance(standing.centre[ring].xyz, standing.centre[ring + 1u].xyz);
    let chance = drawn(seed_of(block.yarn, block.first_ring + ring, HAIRS_OF_GAP), 0u);
    let count = min(u32(length * hair_density[block.yarn] + chance), HAIRS_OF_GAP);
    let place = atomicAdd(&hair_count, count);
    for (var hair = 0u; hair < count; hair++) {
        block_hairs[place + hair] = ring * HAIRS_OF_GAP + hair;
    }
}

// Half a fibre's width where the clip space's fourth coordinate is `w`, in units of 1/256 pixel.
fn half_width_at(w: f32) -> f32 {
    let rows = view.clip_from_local;
    let pixels_of_mm = 0.5 * view.size.y * length(vec3(rows[0].y, rows[1].y, rows[2].y)) / w;
    return 0.5 * HAIR_WIDTH * SUBPIXELS * pixels_of_mm;
}

// Draws the part of a hair between two places of the fabric. Its ends are round, so that parts join
// up.
fn draw_part(start: vec3<f32>, end: vec3<f32>, number: u32) {
    let start_clip = clip_of(start);
    let end_clip = clip_of(end);
    let p = corner_of(screen_of(start_clip));
    let q = corner_of(screen_of(end_clip));
    if ((p.sides | q.sides) & BEYOND) != 0u {
        return;
    }
    // A part of a hair just before the eye would hide the cloth, so it is left out.
    let plane = 1.0 / (view.local_from_clip * vec4(0.0, 0.0, 0.0, 1.0)).w;
    if min(start_clip.w, end_clip.w) < 0.5 * plane {
        return;
    }
    // Parts of hairs nearer or farther than the view's range of depths are drawn at its limits.
    let depths = clamp(vec2(p.depth, q.depth), vec2(0.0), vec2(DEEPEST));
    let reach = half_width_at(0.5 * (start_clip.w + end_clip.w));
    let base = vec2<f32>(p.place);
    let way = vec2<f32>(q.place) - base;
    let squared = max(dot(way, way), 1.0);
    let corner = vec2<f32>(middle());
    let low = min(base.y, base.y + way.y) - reach + corner.y;
    let high = max(base.y, base.y + way.y) + reach + corner.y;
    let first_row = max(i32(ceil((low - f32(FIRST_SAMPLE_Y)) / f32(SAMPLE_ROW))), i32(4u * sweep.first_row));
    let end_row = min(i32(floor((high - f32(FIRST_SAMPLE_Y)) / f32(SAMPLE_ROW))), i32(4u * (sweep.first_row + sweep.rows)) - 1);
    for (var row = first_row; row <= end_row; row++) {
        // The shares of the part, from 0 to 1, between which it lies within reach of the row.
        let down = f32(sample_place(0, row).y) - base.y;
        let shares = select(vec2(0.0, 1.0), (vec2(down) + vec2(-reach, reach)) / way.y, abs(way.y) > 1.0);
        let ends = way.x * clamp(shares, vec2(0.0), vec2(1.0));
        let across = base.x + corner.x - f32(sample_x(row & 3));
        let first = max(i32(ceil((across + min(ends.x, ends.y) - reach) / SUBPIXELS)), 0);
        let last = min(i32(floor((across + max(ends.x, ends.y) + reach) / SUBPIXELS)), i32(view.size.x) - 1);
        for (var x = first; x <= last; x++) {
            let to = vec2<f32>(sample_place(x, row)) - base;
            let share = clamp(dot(to, way) / squared, 0.0, 1.0);
            let off = to - way * share;
            if dot(off, off) < reach * reach {
                let depth = clamp(mix(depths.x, depths.y, share), 0.0, DEEPEST);
                offer_at(x, row, depth, number);
            }
        }
    }
}

// Draws the hairs of all listed blocks, with one workgroup of HAIR_GROUP lanes for each block.
@compute @workgroup_size(HAIR_GROUP)
fn hairs(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
         @builtin(local_invocation_index) lane: u32) {
    let number = group.y * grid.x + group.x;
    if number >= atomicLoad(&listed.count) {
        return;
    }
    let row = listed.rows[number];
    let block = blocks[row];
    if hair_density[block.yarn] == 0.0 {
        return;
    }
    if lane == 0u {
        atomicStore(&hair_count, 0u);
    }
    block_rings(yarns[block.yarn], block, lane);
    if lane < block.quads {
        note_hairs(block, lane);
    }
    workgroupBarrier();
    let outline = yarns[block.yarn].section * params.sides;
    let parts = atomicLoad(&hair_count) * HAIR_PARTS;
    let first_number = first_hair() + row * hairs_of_block();
    for (var k = lane; k < parts; k += HAIR_GROUP) {
        let noted = block_hairs[k / HAIR_PARTS];
        let part = k % HAIR_PARTS;
        let ring = noted / HAIRS_OF_GAP;
        let seed = seed_of(block.yarn, block.first_ring + ring, noted % HAIRS_OF_GAP);
        let hair = hair_new(seed, outline, stance_of(ring), stance_of(ring + 1u));
        var start = hair.root;
        for (var before = 0u; before < part; before++) {
            start += hair_direction(hair, before) * hair.part;
        }
        draw_part(start, start + hair_direction(hair, part) * hair.part, first_number + noted * HAIR_PARTS + part);
    }
}
