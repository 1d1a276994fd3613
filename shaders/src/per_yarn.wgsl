// The paper's algorithms 2 and 4, in which a lane makes a yarn, or a part of a yarn. Measurements
// compare the schedule per-ring with them. This file follows common.wgsl.
//
// Its twin is per_yarn.cl. Both make only what the paper makes: upright, untwisted, open yarns
// without caps. A lane makes a part, which is a run of one yarn's rings in a chunk, so that a
// fabric may be larger than a device's buffers. Here `blocks` has one row for each part: the row of
// its first block, but with the number of all the part's rings.

const PER_YARN_GROUP = 64u;

@group(0) @binding(5) var<storage, read> outlines: array<vec4<f32>>;
@group(0) @binding(6) var<storage, read> pattern: array<u32>;
@group(0) @binding(7) var<storage, read_write> vertices: array<f32>;
@group(0) @binding(8) var<storage, read_write> indices: array<u32>;
@group(0) @binding(9) var<storage, read_write> rings: array<vec4<u32>>;

// Algorithm 2: K + 1 rings for each control interval.
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
        let segment = segment_new(point, params.s);
        let end = select(per_interval, per_interval + 1u, interval + 1u == intervals);
        while place < end && ring < part.rings {
            let t = select(f32(place) * params.step, 1.0, place == per_interval);
            let sample = segment_sample(segment, t);
            let out = 3u * (part.chunk_ring + ring);
            rings[out] = bitcast<vec4<u32>>(vec4(sample.centre, sample.half_width));
            rings[out + 1u] = bitcast<vec4<u32>>(vec4(sample.tangent, 0.0));
            rings[out + 2u] =
                bitcast<vec4<u32>>(vec4(sample.half_height, sample.width_growth, sample.height_growth, 0.0));
            place++;
            ring++;
        }
        place = 0u;
        interval++;
        point++;
    }
}

// How an untwisted section stands on a ring of algorithm 2. The ring begins at element `at` of
// `rings`.
fn stance_at(at: u32) -> Stance {
    let centre = bitcast<vec4<f32>>(rings[at]);
    let size = bitcast<vec3<f32>>(rings[at + 2u].xyz);
    let tangent = bitcast<vec3<f32>>(rings[at + 1u].xyz);
    return stance_new(centre, vec4(tangent, size.y), side_of(tangent, 0u, 0u, true), size.xz, vec2(0.0, 1.0));
}

// Algorithm 4: `sides` vertices for each ring, and the triangles to the next ring.
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
        let stance = stance_at(3u * (part.chunk_ring + ring));
        let first_vertex = part.first_vertex + ring * sides;
        for (var k = 0u; k < sides; k++) {
            let position = position_at(stance, outlines[outline + k]);
            let normal = normal_at(stance, outlines[outline + k]);
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
