// What each sample shows, worked out again from the number of its triangle. After fabric.wgsl, weights.wgsl, kept.wgsl.

@group(0) @binding(10) var<storage, read> cap_rows: array<CapRow>;
@group(0) @binding(11) var<storage, read> cap_pattern: array<u32>;
// The triangle and the nearness of each sample: complements, 0 where there is none.
@group(1) @binding(4) var<storage, read> keys: array<vec2<u32>>;
@group(1) @binding(5) var<storage, read> ring_rolls: array<u32>;

@group(1) @binding(6) var depths: texture_storage_2d_array<r32float, read_write>;
@group(1) @binding(7) var directions: texture_storage_2d_array<rg32uint, write>;
@group(1) @binding(8) var places: texture_storage_2d_array<rg32uint, write>;

struct Vertex {
    clip: vec4<f32>,
    position: vec3<f32>,
    normal: vec3<f32>,
}

fn vertex_at(stance: Stance, point: vec4<f32>) -> Vertex {
    let position = position_at(stance, point);
    return Vertex(clip_of(position), position, normal_at(stance, point));
}

// How the section stands on ring `ring` of `block`, or on the one after its last.
fn ring_stance(yarn: YarnRow, block: Block, ring: u32) -> Stance {
    var roll = 0u;
    if params.rolled != 0u {
        roll = ring_rolls[block.chunk_ring + ring];
    }
    return stance_of_sample(ring_sample(yarn, block, ring).sample, roll);
}

// The share of each corner, and whether the triangle is seen from outside.
struct Shares {
    corners: vec3<f32>,
    is_front: bool,
}

fn shares_of(p: vec4<f32>, q: vec4<f32>, r: vec4<f32>, place: vec2<i32>) -> Shares {
    let weights = weights_at(p, q, r, place);
    let is_front = dot(weights, vec3(p.w, q.w, r.w)) > 0.0;
    // The pixel's middle may lie outside, and what is far from a small triangle is not to be made up.
    let inside = max(select(-weights, weights, is_front), vec3(0.0));
    let sum = inside.x + inside.y + inside.z;
    return Shares(select(vec3(1.0 / 3.0), inside / sum, sum > 0.0), is_front);
}

fn angle_of(side: u32) -> vec2<f32> {
    let angle = f32(side) * (TAU / f32(params.sides));
    return vec2(cos(angle), sin(angle));
}

fn tube_at(row: u32, number: u32, place: vec2<i32>) -> Kept {
    let block = blocks[row];
    let yarn = yarns[block.yarn];
    let quad = number / 2u;
    let ring = quad / params.sides;
    let side = quad - ring * params.sides;
    let beside = select(side + 1u, 0u, side + 1u == params.sides);
    let here = ring_stance(yarn, block, ring);
    let next = ring_stance(yarn, block, ring + 1u);
    let outline = yarn.section * params.sides;
    let own = outlines[outline + side];
    let other = outlines[outline + beside];
    let is_second = (number & 1u) != 0u;
    // A facet's first corner, the one beside it or on the next ring, and the one over its own.
    let first = select(side, beside, is_second);
    let p = vertex_at(here, select(own, other, is_second));
    var q: Vertex;
    if is_second {
        q = vertex_at(next, other);
    } else {
        q = vertex_at(here, other);
    }
    let r = vertex_at(next, own);
    let shares = shares_of(p.clip, q.clip, r.clip, place);
    let normal = mat3x3(p.normal, q.normal, r.normal) * shares.corners;
    // Along the facet, as its first corner has it: the fibres' direction, since a twisted yarn's corners turn with its twist.
    var fibre = r.position - p.position;
    if is_second {
        fibre = q.position - p.position;
    }
    let around = mat3x2(angle_of(first), angle_of(beside), angle_of(side)) * shares.corners;
    let past = shares.corners.z + select(0.0, shares.corners.y, is_second);
    let along = f32(block.first_ring + ring) + past;
    let angle = fract(atan2(around.y, around.x) / TAU);
    return kept_of(normal, fibre, angle, along, block.yarn, shares.is_front);
}

fn cap_at(number: u32, triangle: u32, place: vec2<i32>) -> Kept {
    let cap = cap_rows[number];
    var roll = 0u;
    if params.rolled != 0u {
        roll = ring_rolls[cap.ring_vertex / params.sides];
    }
    let stance = cap_stance(cap, roll);
    let outline = yarns[cap.yarn].section * params.sides;
    let first_corner = cap.first_corner + 3u * triangle;
    let p = vertex_at(stance, outlines[outline + cap_pattern[first_corner]]);
    let q = vertex_at(stance, outlines[outline + cap_pattern[first_corner + 1u]]);
    let r = vertex_at(stance, outlines[outline + cap_pattern[first_corner + 2u]]);
    let is_front = shares_of(p.clip, q.clip, r.clip, place).is_front;
    let normal = stance.tangent.xyz * select(1.0, -1.0, cap.end == 0u);
    return kept_of(normal, normal, 0.0, 0.0, cap.yarn | CUT, is_front);
}

fn kept_of_triangle(number: u32, place: vec2<i32>) -> Kept {
    let row = number / numbers_of_block();
    let triangle = number - row * numbers_of_block();
    if row < params.blocks {
        return tube_at(row, triangle, place);
    }
    return cap_at(row - params.blocks, triangle, place);
}

// A lane a sample, where that is nearer than what earlier chunks left.
@compute @workgroup_size(8, 8)
fn resolve(@builtin(global_invocation_id) place: vec3<u32>) {
    let pixel = vec2(place.x, place.y + sweep.first_row);
    if place.x >= u32(view.size.x) || place.y >= sweep.rows {
        return;
    }
    let key = keys[(place.y * u32(view.size.x) + place.x) * 4u + place.z];
    var nearest = 1.0;
    if sweep.is_first == 0u {
        nearest = textureLoad(depths, pixel, place.z).x;
    }
    let depth = select(bitcast<f32>(~key.y), 1.0, key.y == 0u);
    if depth < nearest {
        // In the pixel's middle, as rasterisers do: so samples of one triangle in a pixel are alike.
        let middle = vec2<i32>(pixel) * 256 + 128 - vec2<i32>(view.size * 128.0);
        let kept = packed(kept_of_triangle(~key.x, middle));
        textureStore(directions, pixel, place.z, vec4(kept.xy, 0u, 0u));
        textureStore(places, pixel, place.z, vec4(kept.zw, 0u, 0u));
    }
    if depth < nearest || sweep.is_first != 0u {
        textureStore(depths, pixel, place.z, vec4(min(depth, nearest), 0.0, 0.0, 0.0));
    }
}
