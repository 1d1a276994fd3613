// The caps at the ends of yarns. Their vertices come after those of the tubes. This file follows
// common.wgsl.
//
// Its twins are caps.cl and texere-cpu's caps.rs.

const CAPS_GROUP = 64u;

@group(0) @binding(7) var<storage, read_write> vertices: array<f32>;
@group(0) @binding(8) var<storage, read_write> indices: array<u32>;
@group(0) @binding(10) var<storage, read> cap_rows: array<CapRow>;
@group(0) @binding(11) var<storage, read> cap_pattern: array<u32>;

// Writes the vertices and triangles of caps, with one lane for each vertex. A vertex has the
// position of the end ring's vertex and the normal of the yarn's end. A cap has two triangles fewer
// than sides, and all its lanes but two also write one triangle each.
@compute @workgroup_size(CAPS_GROUP)
fn caps(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
        @builtin(local_invocation_index) lane: u32) {
    let number = (group.y * grid.x + group.x) * CAPS_GROUP + lane;
    if number >= params.caps * params.sides {
        return;
    }
    let cap = cap_rows[number / params.sides];
    let corner = number % params.sides;

    let normal = cap_normal(cap);
    let ring_vertex = 6u * (cap.ring_vertex + corner);
    let out = 6u * (cap.first_vertex + corner);
    for (var k = 0u; k < 3u; k++) {
        vertices[out + k] = vertices[ring_vertex + k];
        vertices[out + 3u + k] = normal[k];
    }

    if params.indexed != 0u && corner < params.sides - 2u {
        for (var k = 3u * corner; k < 3u * corner + 3u; k++) {
            indices[cap.first_index + k] = cap.first_vertex + cap_pattern[cap.first_corner + k];
        }
    }
}
