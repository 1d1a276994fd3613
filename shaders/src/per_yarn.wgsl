// The paper's algorithms 2 and 4, one lane a yarn: the yardstick that the schedule per-ring is measured against. After
// common.wgsl.
//
// The twin of per_yarn.cl. Only what the paper does: upright, untwisted, open yarns without caps. A lane's share is a
// part, a run of one yarn's rings in a chunk, so that a fabric larger than a device's buffers can be made at all. Here
// `blocks` has one row a part: its first block's, with all of the part's rings.

const PER_YARN_GROUP = 64u;

@group(0) @binding(5) var<storage, read> outlines: array<vec4<f32>>;
@group(0) @binding(6) var<storage, read> pattern: array<u32>;
@group(0) @binding(7) var<storage, read_write> vertices: array<f32>;
@group(0) @binding(8) var<storage, read_write> indices: array<u32>;
@group(0) @binding(9) var<storage, read_write> rings: array<vec4<u32>>;
// The growth of the radius, for which a ring has no room.
@group(0) @binding(12) var<storage, read_write> slopes: array<f32>;

// Algorithm 2: for each control interval, K + 1 rings.
@compute @workgroup_size(PER_YARN_GROUP)
fn trajectory_per_yarn(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
                       @builtin(local_invocation_index) lane: u32) {
    let number = (group.y * grid.x + group.x) * PER_YARN_GROUP + lane;
    if number >= params.blocks {
        return;
    }
    let part = blocks[number];
    let per_interval = params.subdivisions + 1u;
    let intervals = (yarns[part.yarn].rings - 1u) / per_interval;
    var interval = part.first_ring / per_interval;
    var place = part.first_ring % per_interval;
    var point = part.first_point;
    // The yarn's last ring is t = 1 of the last interval.
    if interval == intervals {
        interval -= 1u;
        point -= 1u;
        place = per_interval;
    }
    var ring = 0u;
    while ring < part.rings {
        let segment = segment_new(points[point], points[point + 1u], points[point + 2u], points[point + 3u], params.s);
        let end = select(per_interval, per_interval + 1u, interval + 1u == intervals);
        while place < end && ring < part.rings {
            let t = select(f32(place) * params.step, 1.0, place == per_interval);
            let sample = segment_sample(segment, t);
            let at = part.chunk_ring + ring;
            rings[2u * at] = bitcast<vec4<u32>>(vec4(sample.centre, sample.radius));
            rings[2u * at + 1u] = bitcast<vec4<u32>>(vec4(sample.tangent, 0.0));
            slopes[at] = sample.slope;
            place++;
            ring++;
        }
        place = 0u;
        interval++;
        point++;
    }
}

// Algorithm 4: for each ring, `sides` vertices, and the triangles to the next ring.
@compute @workgroup_size(PER_YARN_GROUP)
fn mesh_per_yarn(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
                 @builtin(local_invocation_index) lane: u32) {
    let number = (group.y * grid.x + group.x) * PER_YARN_GROUP + lane;
    if number >= params.blocks {
        return;
    }
    let part = blocks[number];
    let sides = params.sides;
    let outline = yarns[part.yarn].section * sides;
    for (var ring = 0u; ring < part.rings; ring++) {
        let at = part.chunk_ring + ring;
        let centre = bitcast<vec4<f32>>(rings[2u * at]);
        let tangent = vec4(bitcast<vec3<f32>>(rings[2u * at + 1u].xyz), slopes[at]);
        let basis = basis_upright(tangent.xyz);
        let first_vertex = part.first_vertex + ring * sides;
        for (var k = 0u; k < sides; k++) {
            let position = position_at(centre, basis.side, basis.up, outlines[outline + k]);
            let normal = normal_at(tangent, basis.side, basis.up, outlines[outline + k]);
            let out = 6u * (first_vertex + k);
            for (var c = 0u; c < 3u; c++) {
                vertices[out + c] = position[c];
                vertices[out + 3u + c] = normal[c];
            }
        }
        if params.indexed != 0u && ring < part.quads {
            let first_index = part.first_index + ring * 6u * sides;
            for (var k = 0u; k < 6u * sides; k++) {
                indices[first_index + k] = first_vertex + pattern[k];
            }
        }
    }
}
