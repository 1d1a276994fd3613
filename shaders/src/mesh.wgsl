// Stage 2 with stage 1 in it: the vertices and indices of a chunk's tubes. This file follows
// common.wgsl, rings.wgsl and share.wgsl.
//
// Its twins are mesh.cl and texere-cpu's serial/mesh.rs. The speed of memory limits this stage.
// Lanes therefore store 16 bytes at a time (8 if the number of sides is odd), contiguous across the
// workgroup.

const MESH_GROUP = 128u;

@group(0) @binding(5) var<storage, read> outlines: array<vec4<f32>>;
// The indices of a ring's quads, the chunk's vertices and the chunk's indices. Each of these
// buffers is bound twice. If the number of sides is even, every block starts at a multiple of 16
// bytes, and `pattern`, `vertices` and `indices` are used, with elements of 16 bytes. If the number
// is odd, `pattern_pairs`, `vertex_pairs` and `index_pairs` are used, with elements of 8 bytes.
@group(0) @binding(6) var<storage, read> pattern: array<vec4<u32>>;
@group(0) @binding(7) var<storage, read_write> vertices: array<vec4<f32>>;
@group(0) @binding(8) var<storage, read_write> indices: array<vec4<u32>>;
@group(0) @binding(6) var<storage, read> pattern_pairs: array<vec2<u32>>;
@group(0) @binding(7) var<storage, read_write> vertex_pairs: array<vec2<f32>>;
@group(0) @binding(8) var<storage, read_write> index_pairs: array<vec2<u32>>;

// Four consecutive floats of ring `ring`'s vertices. `first` is the number of the first float in
// its vertex, and is even. The four hold floats of at most one normal and one position.
fn four_floats(ring: u32, first: u32, normal_point: vec4<f32>, position_point: vec4<f32>) -> vec4<f32> {
    let stance = stance_of(ring);
    let normal = normal_at(stance, normal_point);
    let position = position_at(stance, position_point);
    let later = select(vec4(normal.yz, position.xy), vec4(position.z, normal), first == 2u);
    return select(later, vec4(position, normal.x), first == 0u);
}

// Two consecutive floats of ring `ring`'s vertex at `point`. `first` is the number of the first
// float in the vertex, and is even.
fn two_floats(ring: u32, first: u32, point: vec4<f32>) -> vec2<f32> {
    let stance = stance_of(ring);
    let normal = normal_at(stance, point);
    let position = position_at(stance, point);
    return select(select(normal.yz, vec2(position.z, normal.x), first == 2u), position.xy, first == 0u);
}

// Meshes a chunk with an even number of sides, with one workgroup of MESH_GROUP lanes for each row
// of the chunk's block table. Indices are written first: they do not depend on the points, and are
// stored while the points are fetched.
@compute @workgroup_size(MESH_GROUP)
fn mesh(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
        @builtin(local_invocation_index) lane: u32) {
    let row = group.y * grid.x + group.x;
    if row >= params.blocks {
        return;
    }
    let block = blocks[row];
    let yarn = yarns[block.yarn];
    let stores = 3u * params.sides / 2u;
    let share = share_of(lane, MESH_GROUP, stores);
    if params.indexed != 0u {
        for (var store = share.store; store < stores; store += share.across) {
            let own = pattern[store] + block.first_vertex;
            for (var ring = share.ring; ring < block.quads; ring += share.step) {
                indices[block.first_index / 4u + ring * stores + store] = own + ring * params.sides;
            }
        }
    }
    block_rings(yarn, block, lane);
    let outline = yarn.section * params.sides;
    let out = 3u * block.first_vertex / 2u;
    for (var store = share.store; store < stores; store += share.across) {
        let first = 4u * store % 6u;
        let normal_point = outlines[outline + 4u * store / 6u];
        let position_point = outlines[outline + (4u * store + 2u) / 6u];
        for (var ring = share.ring; ring < block.rings; ring += share.step) {
            vertices[out + ring * stores + store] = four_floats(ring, first, normal_point, position_point);
        }
    }
}

// Meshes a chunk with an odd number of sides, 8 bytes at a time.
@compute @workgroup_size(MESH_GROUP)
fn mesh_odd(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
            @builtin(local_invocation_index) lane: u32) {
    let row = group.y * grid.x + group.x;
    if row >= params.blocks {
        return;
    }
    let block = blocks[row];
    let yarn = yarns[block.yarn];
    let stores = 3u * params.sides;
    let share = share_of(lane, MESH_GROUP, stores);
    if params.indexed != 0u {
        for (var store = share.store; store < stores; store += share.across) {
            let own = pattern_pairs[store] + block.first_vertex;
            for (var ring = share.ring; ring < block.quads; ring += share.step) {
                index_pairs[block.first_index / 2u + ring * stores + store] = own + ring * params.sides;
            }
        }
    }
    block_rings(yarn, block, lane);
    let outline = yarn.section * params.sides;
    let out = 3u * block.first_vertex;
    for (var store = share.store; store < stores; store += share.across) {
        let first = 2u * store % 6u;
        let point = outlines[outline + store / 3u];
        for (var ring = share.ring; ring < block.rings; ring += share.step) {
            vertex_pairs[out + ring * stores + store] = two_floats(ring, first, point);
        }
    }
}
