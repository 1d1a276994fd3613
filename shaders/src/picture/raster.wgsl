// Draws a chunk of the fabric from its control points, without writing a mesh. This file follows
// draw.wgsl, and axes_level.wgsl or axes_rolled.wgsl.
//
// Compute shaders draw (Schuetz, Kerbl and Wimmer 2021, "Rendering point clouds with compute
// shaders and vertex order optimization"; Karis et al. 2021, "Nanite"), because yarns have several
// triangles for each sample, and rasterisers are made for large triangles. Here a triangle without
// samples takes only the time of one test. A triangle with samples takes an atomic maximum for each
// sample.

// The lanes of a workgroup: one for each ring of a block and for the ring after it, rounded up to a
// multiple of eight for the scan of rolls. The less memory a workgroup takes, the more workgroups
// run at a time.
const RASTER_GROUP = BLOCK_RINGS + 8u;
// The number of lanes that draw the quads found. GPUs run 32 lanes in step, and all would wait in
// each round for the few lanes beyond 64.
const DRAWING_LANES = 64u;
const MANY_GROUP = 128u;
const CAP_GROUP = 64u;

// The number of sides that a lane tests before the quads found are drawn.
const SIDES_LOOKED = 6u;

@group(0) @binding(10) var<storage, read> cap_rows: array<CapRow>;
@group(0) @binding(11) var<storage, read> cap_pattern: array<u32>;
@group(1) @binding(2) var<storage, read_write> listed: Listed;

// The quads of the block that are to be drawn: their numbers, and from bit FOUND_SHIFT on the
// samples that SMALL quads may have. In `raster_many`, the sides of the ring whose quads are to be
// drawn.
const FOUND_SHIFT = 16u;
const FOUND_MOST = RASTER_GROUP * SIDES_LOOKED;
var<workgroup> found: array<u32, FOUND_MOST>;
var<workgroup> found_count: atomic<u32>;
// Sections have up to 256 sides.
const_assert BLOCK_RINGS * 256u <= 1u << FOUND_SHIFT && FOUND_MOST >= 256u && SIDES_LOOKED <= 6u;
// The sizes of the quads that `raster` leaves to other passes.
var<workgroup> other_sizes: atomic<u32>;

// The corner at a section's `point`, in screen space.
fn tube_at(axes: Axes, point: vec2<f32>) -> vec4<f32> {
    return axes.centre + (axes.x * point.x + axes.y * point.y);
}

// The corner of a ring in clip space.
fn tube_clip(ring: u32, point: vec2<f32>) -> vec4<f32> {
    return tube_at(held_axes(ring), point) / screen_scale();
}

// One of `lanes` lanes that draw a triangle together, in eight columns.
fn lanes_of(lane: u32, lanes: u32) -> Lanes {
    return Lanes(i32(lane % 8u), i32(lane / 8u), 8, i32(lanes / 8u));
}

// A ring on the screen: its middle, and the greatest distance of its corners from there.
struct Disc {
    place: vec2<f32>,
    reach: f32,
}

fn disc_of(axes: Axes) -> Disc {
    let spread = (abs(axes.x) + abs(axes.y)) * sweep.reach;
    let least = axes.centre.w - spread.w;
    let place = axes.centre.xy / axes.centre.w;
    let across = (spread.xy + spread.w * abs(place)) / least;
    return Disc(place, select(2.0 * REACHED, max(across.x, across.y), least > 1e-6));
}

// Whether all corners of two rings have a place, and are less than EXTENT apart.
fn are_near(one: Disc, other: Disc) -> bool {
    let farthest = max(abs(one.place), abs(other.place));
    let apart = abs(one.place - other.place);
    let reach = one.reach + other.reach;
    return max(farthest.x, farthest.y) + reach < REACHED && max(apart.x, apart.y) + reach < f32(EXTENT) - 2.0;
}

// The place of a corner in whole units of 1/256 pixel.
fn near_place(axes: Axes, point: vec2<f32>) -> vec2<f32> {
    let xyw = axes.centre.xyw + (axes.x.xyw * point.x + axes.y.xyw * point.y);
    return place_of(xyw.xy, xyw.z);
}

fn quad_of(outline: u32, ring: u32, side: u32, beside: u32) -> Quad {
    let here = held_axes(ring);
    let next = held_axes(ring + 1u);
    let own = outlines[outline + side].xy;
    let other = outlines[outline + beside].xy;
    return Quad(corner_of(tube_at(here, own)), corner_of(tube_at(here, other)), corner_of(tube_at(next, own)),
                corner_of(tube_at(next, other)));
}

// Notes quads of some sides of a ring in `found`: the SMALL quads that have samples if `size` is
// SMALL, otherwise the FEW quads. If `size` is SMALL, the sizes of all other quads go into
// `other_sizes`. `here` are the ring's axes.
fn note_alone(outline: u32, ring: u32, first_side: u32, end_side: u32, here: Axes, size: u32) {
    if first_side >= end_side {
        return;
    }
    let next = held_axes(ring + 1u);
    if !are_near(disc_of(here), disc_of(next)) {
        atomicOr(&other_sizes, MANY);
        return;
    }
    // The samples found, 16 bits for each side, two sides in a number. `noted` has a bit for each
    // side that is noted.
    var samples = vec3(0u);
    var noted = 0u;
    var sizes = 0u;
    let point = outlines[outline + first_side].xy;
    var p = near_place(here, point);
    var r = near_place(next, point);
    for (var k = 0u; k < end_side - first_side; k++) {
        let point = outlines[outline + side_beside(first_side + k)].xy;
        let q = near_place(here, point);
        let s = near_place(next, point);
        let box = near_box_of(p, q, r, s);
        if size == SMALL {
            let own_size = size_of(box, ALONE);
            sizes |= own_size;
            if own_size == SMALL {
                let own = samples_of(box);
                samples |= select(vec3(0u), vec3(own << (16u * (k & 1u))), vec3(k / 2u) == vec3(0u, 1u, 2u));
                noted |= select(0u, 1u << k, own != 0u);
            }
        } else if size_of(wider(box), ALONE + 128) == FEW {
            noted |= 1u << k;
        }
        p = q;
        r = s;
    }
    if (sizes & (FEW | MANY)) != 0u {
        atomicOr(&other_sizes, sizes);
    }
    var place = atomicAdd(&found_count, countOneBits(noted));
    for (; noted != 0u; noted &= noted - 1u) {
        let k = firstTrailingBit(noted);
        let pair = select(select(samples.x, samples.y, k >= 2u), samples.z, k >= 4u);
        let own = (pair >> (16u * (k & 1u))) & 0xffffu;
        found[place] = (ring * params.sides + first_side + k) | (own << FOUND_SHIFT);
        place++;
    }
}

// Whether a quad may have MANY samples. If its rings are not near one another, the number is
// unknown.
fn may_have_many(outline: u32, ring: u32, side: u32) -> bool {
    let here = held_axes(ring);
    let next = held_axes(ring + 1u);
    let beside = side_beside(side);
    if !are_near(disc_of(here), disc_of(next)) {
        return may_show(quad_of(outline, ring, side, beside));
    }
    let own = outlines[outline + side].xy;
    let other = outlines[outline + beside].xy;
    let box = near_box_of(near_place(here, own), near_place(here, other), near_place(next, own), near_place(next, other));
    return size_of(box, ALONE - 128) == MANY;
}

// Empties `found`. Every lane must call this function when it no longer needs the quads in `found`.
fn empty_found(lane: u32) {
    workgroupBarrier();
    if lane == 0u {
        atomicStore(&found_count, 0u);
    }
    workgroupBarrier();
}

// Draws the SMALL quads of a block and returns the other sizes that it has, or draws its FEW quads.
// A workgroup of RASTER_GROUP lanes calls this function.
fn draw_block(row: u32, lane: u32, size: u32) -> u32 {
    let own = project_block(blocks[row], lane);
    if lane == 0u {
        atomicStore(&other_sizes, 0u);
        atomicStore(&found_count, 0u);
    }
    workgroupBarrier();
    let outline = yarns[blocks[row].yarn].section * params.sides;
    let base = row * numbers_of_block();
    // Lanes that have no ring test no sides.
    let sides = select(0u, params.sides, lane < blocks[row].quads);
    for (var first_side = 0u; first_side < params.sides; first_side += SIDES_LOOKED) {
        let end_side = min(sides, first_side + SIDES_LOOKED);
        note_alone(outline, lane, first_side, end_side, own, size);
        workgroupBarrier();
        let count = atomicLoad(&found_count);
        for (var k = select(count, lane, lane < DRAWING_LANES); k < count; k += DRAWING_LANES) {
            let number = found[k] & ((1u << FOUND_SHIFT) - 1u);
            let at = quad_at(number);
            let quad = quad_of(outline, at.x, at.y, at.z);
            if size == SMALL {
                draw_small(quad, found[k] >> FOUND_SHIFT, base + 2u * number);
            } else {
                draw_few(quad, base + 2u * number);
            }
        }
        if first_side + SIDES_LOOKED < params.sides {
            empty_found(lane);
        }
    }
    return atomicLoad(&other_sizes);
}

// Draws the SMALL quads of listed blocks, with one workgroup for each block. Blocks with other
// quads are left for later passes.
@compute @workgroup_size(RASTER_GROUP)
fn raster(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
          @builtin(local_invocation_index) lane: u32) {
    let number = group.y * grid.x + group.x;
    if number >= atomicLoad(&listed.count) {
        return;
    }
    let row = listed.rows[number];
    let others = draw_block(row, lane, SMALL);
    if lane == 0u && (others & FEW) != 0u {
        listed.rows[params.blocks + atomicAdd(&listed.few_count, 1u)] = row;
    }
    if lane == 0u && (others & MANY) != 0u {
        listed.rows[2u * params.blocks + atomicAdd(&listed.many_count, 1u)] = row;
    }
}

// Draws the FEW quads of blocks that have some, with one workgroup for each block.
@compute @workgroup_size(RASTER_GROUP)
fn raster_few(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
              @builtin(local_invocation_index) lane: u32) {
    let number = group.y * grid.x + group.x;
    if number < atomicLoad(&listed.few_count) {
        _ = draw_block(listed.rows[params.blocks + number], lane, FEW);
    }
}

// Draws the MANY quads, with one workgroup of MANY_GROUP lanes for each ring of a block that has
// some. All lanes draw each quad together.
@compute @workgroup_size(MANY_GROUP)
fn raster_many(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
               @builtin(local_invocation_index) lane: u32) {
    let number = group.y * grid.x + group.x;
    if number >= atomicLoad(&listed.many_count) * BLOCK_RINGS {
        return;
    }
    let row = listed.rows[2u * params.blocks + number / BLOCK_RINGS];
    let ring = number % BLOCK_RINGS;
    if ring >= blocks[row].quads {
        return;
    }
    _ = project_block(blocks[row], lane);
    if lane == 0u {
        atomicStore(&found_count, 0u);
    }
    workgroupBarrier();
    let outline = yarns[blocks[row].yarn].section * params.sides;
    for (var side = lane; side < params.sides; side += MANY_GROUP) {
        if may_have_many(outline, ring, side) {
            found[atomicAdd(&found_count, 1u)] = side;
        }
    }
    workgroupBarrier();
    let count = atomicLoad(&found_count);
    for (var k = 0u; k < count; k++) {
        let side = found[k];
        let beside_side = side_beside(side);
        let quad = quad_of(outline, ring, side, beside_side);
        let triangle = row * numbers_of_block() + 2u * (ring * params.sides + side);
        if ((quad.p.sides | quad.q.sides | quad.r.sides | quad.s.sides) & BEYOND) == 0u {
            draw_together(quad.p, quad.q, quad.r, triangle, lanes_of(lane, MANY_GROUP));
            draw_together(quad.s, quad.r, quad.q, triangle + 1u, lanes_of(lane, MANY_GROUP));
        } else {
            let own = outlines[outline + side].xy;
            let other = outlines[outline + beside_side].xy;
            let beside = tube_clip(ring, other);
            let over = tube_clip(ring + 1u, own);
            draw_beyond(tube_clip(ring, own), beside, over, triangle, lane, MANY_GROUP);
            draw_beyond(beside, tube_clip(ring + 1u, other), over, triangle + 1u, lane, MANY_GROUP);
        }
    }
}

// Corner `corner` of a cap in clip space.
fn cap_clip(cap: CapRow, stance: Stance, corner: u32) -> vec4<f32> {
    return clip_of(position_at(stance, outlines[yarns[cap.yarn].section * params.sides + corner]));
}

fn cap_corner(cap: CapRow, stance: Stance, corner: u32) -> Corner {
    return corner_of(screen_of(cap_clip(cap, stance, corner)));
}

// Draws caps, with one workgroup of CAP_GROUP lanes for each cap.
@compute @workgroup_size(CAP_GROUP)
fn raster_caps(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
               @builtin(local_invocation_index) lane: u32) {
    let number = group.y * grid.x + group.x;
    if number >= params.caps {
        return;
    }
    let cap = cap_rows[number];
    var roll = vec2(0u);
    if params.rolled != 0u {
        roll = ring_rolls[cap.ring_vertex / params.sides];
    }
    let stance = cap_stance(cap, roll);
    let first_triangle = (params.blocks + number) * numbers_of_block();
    for (var triangle = 0u; triangle < params.sides - 2u; triangle++) {
        let first_corner = cap.first_corner + 3u * triangle;
        let at = vec3(cap_pattern[first_corner], cap_pattern[first_corner + 1u], cap_pattern[first_corner + 2u]);
        let p = cap_corner(cap, stance, at.x);
        let q = cap_corner(cap, stance, at.y);
        let r = cap_corner(cap, stance, at.z);
        if !may_show(Quad(p, q, r, r)) {
            continue;
        }
        if ((p.sides | q.sides | r.sides) & BEYOND) == 0u {
            draw_together(p, q, r, first_triangle + triangle, lanes_of(lane, CAP_GROUP));
        } else {
            draw_beyond(cap_clip(cap, stance, at.x), cap_clip(cap, stance, at.y), cap_clip(cap, stance, at.z),
                        first_triangle + triangle, lane, CAP_GROUP);
        }
    }
}
