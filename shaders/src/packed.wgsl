// Stage 2 with stage 1 in it, as packed vertices. This file follows common.wgsl, rings.wgsl and
// share.wgsl.
//
// Its twins are packed.cl and texere-core's packed.rs. A packed vertex (Rust: PackedVertex) is
// three words. The first two hold x in bits 0 to 20, y in bits 21 to 41 and z in bits 42 to 62. The
// third holds both coordinates of the octahedral normal, 16 bits each. Lanes store two words at a
// time (one if the number of sides is odd), contiguous across the workgroup.

const PACKED_GROUP = 64u;

@group(0) @binding(5) var<storage, read> packed_outlines: array<vec4<f32>>;
// Packed vertices in pairs of words, for an even number of sides: every block then starts at a
// multiple of 8 bytes.
@group(0) @binding(44) var<storage, read_write> packed_pairs: array<vec2<u32>>;
@group(0) @binding(44) var<storage, read_write> packed_words: array<u32>;
@group(0) @binding(10) var<storage, read> packed_cap_rows: array<CapRow>;

// The lowest bits of the number of whole quanta nearest to a coordinate. Factors are powers of two,
// so only the last step rounds.
fn packed_coordinate(mm: f32) -> u32 {
    let quanta = mm * params.quanta_per_mm;
    let rest = quanta - round(quanta * (1.0 / QUANTA_WRAP)) * QUANTA_WRAP;
    return bitcast<u32>(i32(round(rest))) & ((1u << COORDINATE_BITS) - 1u);
}

// The two words of a position.
fn packed_position(position: vec3<f32>) -> vec2<u32> {
    let x = packed_coordinate(position.x);
    let y = packed_coordinate(position.y);
    let z = packed_coordinate(position.z);
    return vec2(x | (y << COORDINATE_BITS), (y >> (32u - COORDINATE_BITS)) | (z << (2u * COORDINATE_BITS - 32u)));
}

// The word of a normal, projected to the octahedron |x| + |y| + |z| = 1, whose lower half is folded
// outwards.
fn packed_normal(normal: vec3<f32>) -> u32 {
    let scale = 1.0 / (abs(normal.x) + abs(normal.y) + abs(normal.z));
    var level = normal.xy * scale;
    if normal.z < 0.0 {
        level = (1.0 - abs(level.yx)) * select(vec2(1.0), vec2(-1.0), level < vec2(0.0));
    }
    let steps = vec2<i32>(round(level * NORMAL_STEPS));
    return (bitcast<u32>(steps.x) & 0xffffu) | (bitcast<u32>(steps.y) << 16u);
}

// Two consecutive words of ring `ring`'s vertices. The first is word `first` of the vertex at
// `point`, the second belongs to the vertex at `next`. The two vertices differ only if the first
// word is that of a normal.
fn two_words(ring: u32, first: u32, point: vec4<f32>, next: vec4<f32>) -> vec2<u32> {
    let stance = stance_of(ring);
    let position = packed_position(position_at(stance, next));
    if first == 0u {
        return position;
    }
    let normal = packed_normal(normal_at(stance, point));
    return select(vec2(position.y, normal), vec2(normal, position.x), first == 2u);
}

// Word `first` of ring `ring`'s vertex at `point`.
fn one_word(ring: u32, first: u32, point: vec4<f32>) -> u32 {
    let stance = stance_of(ring);
    if first == 2u {
        return packed_normal(normal_at(stance, point));
    }
    let position = packed_position(position_at(stance, point));
    return select(position.y, position.x, first == 0u);
}

// Packs a chunk with an even number of sides, with one workgroup of PACKED_GROUP lanes for each row
// of the chunk's block table.
@compute @workgroup_size(PACKED_GROUP)
fn packed(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
          @builtin(local_invocation_index) lane: u32) {
    let row = group.y * grid.x + group.x;
    if row >= params.blocks {
        return;
    }
    let block = blocks[row];
    let yarn = yarns[block.yarn];
    block_rings(yarn, block, lane);

    let stores = 3u * params.sides / 2u;
    let share = share_of(lane, PACKED_GROUP, stores);
    let outline = yarn.section * params.sides;
    let out = 3u * block.first_vertex / 2u;
    for (var store = share.store; store < stores; store += share.across) {
        let first = 2u * store % 3u;
        let point = packed_outlines[outline + 2u * store / 3u];
        let next = packed_outlines[outline + (2u * store + 1u) / 3u];
        for (var ring = share.ring; ring < block.rings; ring += share.step) {
            packed_pairs[out + ring * stores + store] = two_words(ring, first, point, next);
        }
    }
}

// Packs a chunk with an odd number of sides, 4 bytes at a time.
@compute @workgroup_size(PACKED_GROUP)
fn packed_odd(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
              @builtin(local_invocation_index) lane: u32) {
    let row = group.y * grid.x + group.x;
    if row >= params.blocks {
        return;
    }
    let block = blocks[row];
    let yarn = yarns[block.yarn];
    block_rings(yarn, block, lane);

    let stores = 3u * params.sides;
    let share = share_of(lane, PACKED_GROUP, stores);
    let outline = yarn.section * params.sides;
    let out = 3u * block.first_vertex;
    for (var store = share.store; store < stores; store += share.across) {
        let point = packed_outlines[outline + store / 3u];
        for (var ring = share.ring; ring < block.rings; ring += share.step) {
            packed_words[out + ring * stores + store] = one_word(ring, store % 3u, point);
        }
    }
}

// Writes the packed vertices of caps, with one lane for each cap vertex. The vertices have the
// positions of the end ring and the normal of the yarn's end.
@compute @workgroup_size(PACKED_GROUP)
fn packed_caps(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
               @builtin(local_invocation_index) lane: u32) {
    let number = (group.y * grid.x + group.x) * PACKED_GROUP + lane;
    if number >= params.caps * params.sides {
        return;
    }
    let cap = packed_cap_rows[number / params.sides];
    let corner = number % params.sides;
    let ring = 3u * (cap.ring_vertex + corner);
    let own = 3u * (cap.first_vertex + corner);
    packed_words[own] = packed_words[ring];
    packed_words[own + 1u] = packed_words[ring + 1u];
    packed_words[own + 2u] = packed_normal(cap_normal(cap));
}
