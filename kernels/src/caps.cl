// The caps at the ends of yarns. Their vertices come after those of the tubes. This file follows
// common.cl.
//
// Its twins are caps.wgsl and texere-cpu's caps.rs.

#define CAPS_GROUP 64

// Writes the vertices and triangles of caps, with one lane for each vertex. A vertex has the
// position of the end ring's vertex and the normal of the yarn's end. A cap has two triangles fewer
// than sides, and all its lanes but two also write one triangle each.
__kernel __attribute__((reqd_work_group_size(CAPS_GROUP, 1, 1)))
void caps(const Params params, const ulong window, __global const uint4 *points, __global const CapRow *rows,
          __global const uint *cap_pattern, __global float *vertices, __global uint *indices) {
    size_t number = get_global_id(0);
    if (number >= (size_t)params.caps * params.sides) {
        return;
    }
    CapRow cap = rows[number / params.sides];
    uint corner = number % params.sides;

    float3 normal = cap_normal(points + window, &params, &cap);
    float3 position = vload3(0, vertices + 6 * (size_t)(cap.ring_vertex + corner));
    __global float *out = vertices + 6 * (size_t)(cap.first_vertex + corner);
    vstore3(position, 0, out);
    vstore3(normal, 0, out + 3);

    if (params.indexed != 0u && corner < params.sides - 2u) {
        for (uint k = 3u * corner; k < 3u * corner + 3u; k++) {
            indices[cap.first_index + k] = cap.first_vertex + cap_pattern[cap.first_corner + k];
        }
    }
}
