// The caps at the ends of yarns, after the tube vertices. After common.cl.
//
// The twin of caps.wgsl and of texere-cpu's caps.rs.

#define CAPS_GROUP 64

// The vertices and triangles of caps. A lane for each cap vertex repeats the end ring's position
// with the end's own normal; all lanes of a cap but two also write one of its sides - 2 triangles.
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
