// Draws a chunk of the fabric from its control points: no mesh is written. After rings.wgsl, fabric.wgsl, weights.wgsl and
// cover.wgsl.
//
// Drawing in compute (Schuetz, Kerbl and Wimmer 2021, "Rendering point clouds with compute shaders and vertex order
// optimization"; Karis et al. 2021, "Nanite"): yarns have several triangles for each sample, which a rasteriser made for large
// ones spends its time on. Here a triangle that has no sample costs no more than finding that out, and one that has some
// costs an atomic maximum in each.

const RASTER_GROUP = 128u;
const CAP_GROUP = 64u;

// Corners of whole rings, of 256 sides at most, that a workgroup holds at a time, and no fewer than the quads between them.
const HELD_CORNERS = 512u;

@group(0) @binding(10) var<storage, read> cap_rows: array<CapRow>;
@group(0) @binding(11) var<storage, read> cap_pattern: array<u32>;
@group(1) @binding(2) var<storage, read_write> listed: Listed;
// The roll of each ring of the chunk, for what is seen of it.
@group(1) @binding(5) var<storage, read_write> ring_rolls: array<u32>;

// Corners that are held, those of a side one after the other: 1/256 pixels right of the middle, with the sides of the view
// that they lie beyond in the lowest byte; below it; depth.
var<workgroup> held_x: array<i32, HELD_CORNERS>;
var<workgroup> held_y: array<i32, HELD_CORNERS>;
var<workgroup> held_depth: array<f32, HELD_CORNERS>;
// Quads that have samples.
var<workgroup> found: array<u32, HELD_CORNERS>;
var<workgroup> found_count: atomic<u32>;
// 1 where one of many samples is among them that were left out, else 0.
var<workgroup> is_left: atomic<u32>;

fn hold(at: u32, clip: vec4<f32>) {
    let corner = corner_of(clip);
    held_x[at] = (corner.place.x << 8u) | i32(corner.sides);
    held_y[at] = corner.place.y;
    held_depth[at] = corner.depth;
}

fn held(at: u32) -> Corner {
    let x = held_x[at];
    return Corner(vec2(x >> 8u, held_y[at]), held_depth[at], u32(x & 255));
}

// The corner that is held of a run of `rings` rings of quads.
fn held_at(ring: u32, side: u32, rings: u32) -> Corner {
    return held(side * (rings + 1u) + ring);
}

// Puts what is wanted of a ring in the place of its stance: in clip space its centre, and what a section's x and y are there.
fn project_ring(ring: u32) {
    let stance = stance_of(ring);
    var x_axis = stance.side * stance.centre.w;
    var y_axis = stance.up * stance.centre.w;
    if FLATTENED {
        let upward = stance.up * stance.height.x;
        y_axis = upward * stance.sin_cos.y - x_axis * stance.sin_cos.x;
        x_axis = x_axis * stance.sin_cos.y + upward * stance.sin_cos.x;
    }
    standing.centre[ring] = clip_of(stance.centre.xyz);
    standing.tangent[ring] = view.clip_from_local * vec4(x_axis, 0.0);
    standing.side[ring] = view.clip_from_local * vec4(y_axis, 0.0);
}

// Where the corner of `ring` at a section's `point` lies, in clip space.
fn tube_clip(ring: u32, point: vec2<f32>) -> vec4<f32> {
    return standing.centre[ring] + (standing.tangent[ring] * point.x + standing.side[ring] * point.y);
}

// A lane's share of rings: a ring, and some of its sides.
struct RingShare {
    ring: u32,
    first_side: u32,
    end_side: u32,
}

fn ring_share(lane: u32, rings: u32) -> RingShare {
    let parts = max(RASTER_GROUP / rings, 1u);
    let part = quotient(lane, rings);
    let first = part * params.sides / parts;
    let end = (part + 1u) * params.sides / parts;
    return RingShare(lane - part * rings, select(0u, first, part < parts), select(0u, end, part < parts));
}

// Holds the corners of `rings` rings from ring `first_ring` of the block on, and of the ring after them.
fn hold_corners(outline: u32, first_ring: u32, rings: u32, lane: u32) {
    let share = ring_share(lane, rings);
    let centre = standing.centre[first_ring + share.ring];
    let x_axis = standing.tangent[first_ring + share.ring];
    let y_axis = standing.side[first_ring + share.ring];
    for (var side = share.first_side; side < share.end_side; side++) {
        let point = outlines[outline + side];
        hold(side * (rings + 1u) + share.ring, centre + (x_axis * point.x + y_axis * point.y));
    }
    for (var side = lane; side < params.sides; side += RASTER_GROUP) {
        hold(side * (rings + 1u) + rings, tube_clip(first_ring + rings, outlines[outline + side].xy));
    }
}

// Notes the quads between these corners that have few samples, or many; and where it is few, whether some have many.
fn note_quads(rings: u32, lane: u32, wanted: u32) {
    let share = ring_share(lane, rings);
    let stride = rings + 1u;
    var p = held(share.first_side * stride + share.ring);
    var r = held(share.first_side * stride + share.ring + 1u);
    var others = 0u;
    // Thirty-two quads at a time, a bit each.
    for (var first = share.first_side; first < share.end_side; first += 32u) {
        let end = min(first + 32u, share.end_side);
        var noted = 0u;
        for (var side = first; side < end; side++) {
            let beside = select(side + 1u, 0u, side + 1u == params.sides);
            let q = held(beside * stride + share.ring);
            let s = held(beside * stride + share.ring + 1u);
            let look = look_of(p, q, r, s);
            noted |= select(0u, 1u << (side - first), look == wanted);
            others |= look;
            p = q;
            r = s;
        }
        var place = atomicAdd(&found_count, countOneBits(noted));
        while noted != 0u {
            found[place] = share.ring * params.sides + first + firstTrailingBit(noted);
            noted &= noted - 1u;
            place += 1u;
        }
    }
    if wanted == FEW && (others & MANY) != 0u {
        atomicStore(&is_left, 1u);
    }
}

// Finds the quads of `rings` rings from `first_ring` on that have few samples, or many: so many are in `found`. Every lane must
// come here, and to the barrier behind which they are no longer wanted.
fn find_quads(outline: u32, first_ring: u32, rings: u32, lane: u32, wanted: u32) -> u32 {
    // Nobody reads the count of the quads before any more.
    if lane == 0u {
        atomicStore(&found_count, 0u);
    }
    hold_corners(outline, first_ring, rings, lane);
    workgroupBarrier();
    note_quads(rings, lane, wanted);
    workgroupBarrier();
    return atomicLoad(&found_count);
}

// Puts the rings of a row's block in clip space. Every lane must come here.
fn project_block(row: u32, lane: u32) {
    let block = blocks[row];
    if lane == 0u {
        atomicStore(&is_left, 0u);
    }
    block_rings(yarns[block.yarn], block, lane);
    if lane < rings_made(block) {
        if params.rolled != 0u {
            ring_rolls[block.chunk_ring + lane] = standing.roll[lane];
        }
        project_ring(lane);
    }
    workgroupBarrier();
}

// A workgroup of RASTER_GROUP a listed block: its quads of few samples. Where it has others it is left for later.
@compute @workgroup_size(RASTER_GROUP)
fn raster(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
          @builtin(local_invocation_index) lane: u32) {
    let number = group.y * grid.x + group.x;
    if number >= atomicLoad(&listed.count) {
        return;
    }
    let row = listed.rows[number];
    project_block(row, lane);
    let outline = yarns[blocks[row].yarn].section * params.sides;
    let quads = blocks[row].quads;
    let most = HELD_CORNERS / params.sides - 1u;
    for (var ring = 0u; ring < quads; ring += most) {
        let rings = min(most, quads - ring);
        let count = find_quads(outline, ring, rings, lane, FEW);
        let base = row * numbers_of_block() + 2u * ring * params.sides;
        for (var k = lane; k < count; k += RASTER_GROUP) {
            let quad = found[k];
            let at = quad_at(quad);
            draw_alone(held_at(at.x, at.y, rings), held_at(at.x, at.z, rings), held_at(at.x + 1u, at.y, rings),
                       held_at(at.x + 1u, at.z, rings), base + 2u * quad);
        }
        workgroupBarrier();
    }
    if lane == 0u && atomicLoad(&is_left) != 0u {
        listed.rows[params.blocks + atomicAdd(&listed.left_count, 1u)] = row;
    }
}

// LEFT_SHARES workgroups of RASTER_GROUP a block that was left: its quads of many samples, each drawn by a whole workgroup.
@compute @workgroup_size(RASTER_GROUP)
fn raster_left(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
               @builtin(local_invocation_index) lane: u32) {
    let number = group.y * grid.x + group.x;
    if number >= atomicLoad(&listed.left_count) * LEFT_SHARES {
        return;
    }
    let row = listed.rows[params.blocks + number / LEFT_SHARES];
    let share = number % LEFT_SHARES;
    project_block(row, lane);
    let outline = yarns[blocks[row].yarn].section * params.sides;
    let quads = blocks[row].quads;
    let most = HELD_CORNERS / params.sides - 1u;
    let end = quads * (share + 1u) / LEFT_SHARES;
    for (var ring = quads * share / LEFT_SHARES; ring < end; ring += most) {
        let rings = min(most, end - ring);
        let count = find_quads(outline, ring, rings, lane, MANY);
        let base = row * numbers_of_block() + 2u * ring * params.sides;
        for (var k = 0u; k < count; k++) {
            let quad = found[k];
            let at = quad_at(quad);
            let p = held_at(at.x, at.y, rings);
            let q = held_at(at.x, at.z, rings);
            let r = held_at(at.x + 1u, at.y, rings);
            let s = held_at(at.x + 1u, at.z, rings);
            let triangle = base + 2u * quad;
            if ((p.sides | q.sides | r.sides | s.sides) & BEYOND) == 0u {
                draw_together(p, q, r, triangle, lane, RASTER_GROUP);
                draw_together(q, s, r, triangle + 1u, lane, RASTER_GROUP);
            } else {
                let own = outlines[outline + at.y].xy;
                let other = outlines[outline + at.z].xy;
                let beside = tube_clip(ring + at.x, other);
                let over = tube_clip(ring + at.x + 1u, own);
                draw_beyond(tube_clip(ring + at.x, own), beside, over, triangle, lane, RASTER_GROUP);
                draw_beyond(beside, tube_clip(ring + at.x + 1u, other), over, triangle + 1u, lane, RASTER_GROUP);
            }
        }
        workgroupBarrier();
    }
}

// Where corner `corner` of a cap lies.
fn cap_clip(cap: CapRow, stance: Stance, corner: u32) -> vec4<f32> {
    return clip_of(position_at(stance, outlines[yarns[cap.yarn].section * params.sides + corner]));
}

// A workgroup of CAP_GROUP a cap.
@compute @workgroup_size(CAP_GROUP)
fn raster_caps(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
               @builtin(local_invocation_index) lane: u32) {
    let number = group.y * grid.x + group.x;
    if number >= params.caps {
        return;
    }
    let cap = cap_rows[number];
    var roll = 0u;
    if params.rolled != 0u {
        roll = ring_rolls[cap.ring_vertex / params.sides];
    }
    let stance = cap_stance(cap, roll);
    for (var corner = lane; corner < params.sides; corner += CAP_GROUP) {
        hold(corner, cap_clip(cap, stance, corner));
    }
    workgroupBarrier();
    let first_triangle = (params.blocks + number) * numbers_of_block();
    for (var triangle = 0u; triangle < params.sides - 2u; triangle++) {
        let first_corner = cap.first_corner + 3u * triangle;
        let at = vec3(cap_pattern[first_corner], cap_pattern[first_corner + 1u], cap_pattern[first_corner + 2u]);
        let p = held(at.x);
        let q = held(at.y);
        let r = held(at.z);
        let look = look_of(p, q, r, r);
        if look == NONE {
            continue;
        }
        if ((p.sides | q.sides | r.sides) & BEYOND) == 0u {
            draw_together(p, q, r, first_triangle + triangle, lane, CAP_GROUP);
        } else {
            draw_beyond(cap_clip(cap, stance, at.x), cap_clip(cap, stance, at.y), cap_clip(cap, stance, at.z),
                        first_triangle + triangle, lane, CAP_GROUP);
        }
    }
}
