// Stage 1: the rings of a chunk. This file follows common.wgsl and rings.wgsl.
//
// Its twins are trajectory.cl and texere-cpu's serial/trajectory.rs.

const TRAJECTORY_GROUP = 64u;

@group(0) @binding(9) var<storage, read_write> rings: array<vec4<u32>>;

// Writes the rings of a chunk, with one workgroup of TRAJECTORY_GROUP lanes for each row of its
// block table.
@compute @workgroup_size(TRAJECTORY_GROUP)
fn trajectory(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
              @builtin(local_invocation_index) lane: u32) {
    let row = group.y * grid.x + group.x;
    if row >= params.blocks {
        return;
    }
    let block = blocks[row];
    let yarn = yarns[block.yarn];
    block_rings(yarn, block, lane);

    // Three stores of 16 bytes a ring, contiguous across lanes.
    let out = 3u * block.chunk_ring;
    for (var piece = lane; piece < 3u * block.rings; piece += TRAJECTORY_GROUP) {
        let ring = piece / 3u;
        let centre = standing.centre[ring];
        let tangent = standing.tangent[ring];
        if piece % 3u == 0u {
            rings[out + piece] = bitcast<vec4<u32>>(centre);
        } else if piece % 3u == 1u {
            rings[out + piece] = vec4(bitcast<vec3<u32>>(tangent.xyz), standing.roll[ring]);
        } else {
            let sizes = vec3(standing.side[ring].w, tangent.w, standing.height_growth[ring]);
            rings[out + piece] = vec4(bitcast<vec3<u32>>(sizes), lean_of(yarn, block.first_ring + ring));
        }
    }
}
