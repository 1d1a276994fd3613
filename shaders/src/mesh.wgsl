// Stage 2 with stage 1 in it: the vertices and indices of a chunk's tubes. After common.wgsl and rings.wgsl.
//
// The twin of mesh.cl and of texere-cpu's serial/mesh.rs. Memory is what limits this stage, so lanes store 16 bytes
// at a time, contiguous across the workgroup. To get there a lane works a vertex out again, where mesh.cl takes vertices
// through local memory: Vulkan runs the fewer workgroups at a time the more such memory each one has.

const MESH_GROUP = 128u;

@group(0) @binding(5) var<storage, read> outlines: array<vec4<f32>>;
// The indices of a ring's quads. These three lie four by four where sides are even in number, so that every block starts
// at 16 bytes, and else two by two, at 8.
@group(0) @binding(6) var<storage, read> pattern: array<vec4<u32>>;
@group(0) @binding(7) var<storage, read_write> vertices: array<vec4<f32>>;
@group(0) @binding(8) var<storage, read_write> indices: array<vec4<u32>>;
@group(0) @binding(6) var<storage, read> pattern_pairs: array<vec2<u32>>;
@group(0) @binding(7) var<storage, read_write> vertex_pairs: array<vec2<f32>>;
@group(0) @binding(8) var<storage, read_write> index_pairs: array<vec2<u32>>;

// `at` / `per_ring`, exactly: neither is so large that half of one for safety would not do, and it takes a fraction of
// the time of a division of integers.
fn ring_of(at: u32, per_ring: u32) -> u32 {
    return u32((f32(at) + 0.5) * (1.0 / f32(per_ring)));
}

// Vertex `number` of a block, whose section's outline starts at `outline`.
fn block_vertex(outline: u32, number: u32) -> Vertex {
    let ring = ring_of(number, params.sides);
    return vertex_at(standing.centre[ring], standing.tangent[ring], standing.side[ring], standing.up[ring],
                     outlines[outline + number - ring * params.sides]);
}

// Four floats of a block's vertices from float `at` on, which is even: so they hold no more than one normal, or the end
// of one, and one position, or the start of one.
fn four_floats(outline: u32, at: u32) -> vec4<f32> {
    let normal = block_vertex(outline, at / 6u).normal;
    let position = block_vertex(outline, (at + 2u) / 6u).position;
    switch at % 6u {
        case 0u: { return vec4(position, normal.x); }
        case 2u: { return vec4(position.z, normal); }
        default: { return vec4(normal.yz, position.xy); }
    }
}

// Two floats likewise.
fn two_floats(outline: u32, at: u32) -> vec2<f32> {
    let vertex = block_vertex(outline, at / 6u);
    switch at % 6u {
        case 0u: { return vertex.position.xy; }
        case 2u: { return vec2(vertex.position.z, vertex.normal.x); }
        default: { return vertex.normal.yz; }
    }
}

// A workgroup of MESH_GROUP a row of the chunk's block table. Indices first: they wait for nothing, and are on their way
// while the points are fetched.
@compute @workgroup_size(MESH_GROUP)
fn mesh(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let row = group.y * GRID_WIDTH + group.x;
    if row >= params.blocks {
        return;
    }
    let block = blocks[row];
    let yarn = yarns[block.yarn];
    if params.indexed != 0u {
        let per_ring = 6u * params.sides;
        for (var at = 4u * lane; at < block.quads * per_ring; at += 4u * MESH_GROUP) {
            let ring = ring_of(at, per_ring);
            let first_vertex = block.first_vertex + ring * params.sides;
            indices[(block.first_index + at) / 4u] = pattern[(at - ring * per_ring) / 4u] + first_vertex;
        }
    }
    block_rings(yarn, block, row, lane);
    let outline = yarn.section * params.sides;
    let out = 6u * block.first_vertex / 4u;
    for (var at = 4u * lane; at < 6u * block.rings * params.sides; at += 4u * MESH_GROUP) {
        vertices[out + at / 4u] = four_floats(outline, at);
    }
}

// The same for an odd number of sides.
@compute @workgroup_size(MESH_GROUP)
fn mesh_odd(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let row = group.y * GRID_WIDTH + group.x;
    if row >= params.blocks {
        return;
    }
    let block = blocks[row];
    let yarn = yarns[block.yarn];
    if params.indexed != 0u {
        let per_ring = 6u * params.sides;
        for (var at = 2u * lane; at < block.quads * per_ring; at += 2u * MESH_GROUP) {
            let ring = ring_of(at, per_ring);
            let first_vertex = block.first_vertex + ring * params.sides;
            index_pairs[(block.first_index + at) / 2u] = pattern_pairs[(at - ring * per_ring) / 2u] + first_vertex;
        }
    }
    block_rings(yarn, block, row, lane);
    let outline = yarn.section * params.sides;
    let out = 6u * block.first_vertex / 2u;
    for (var at = 2u * lane; at < 6u * block.rings * params.sides; at += 2u * MESH_GROUP) {
        vertex_pairs[out + at / 2u] = two_floats(outline, at);
    }
}
