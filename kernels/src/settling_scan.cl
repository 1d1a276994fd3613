// Scans: each count is replaced by the sum of all counts before it. This file follows settling.cl.
//
// Its twin is settling_scan.wgsl. Sums saturate at the largest number, so that too large a sum is
// noticed.

#define SETTLING_SCAN_GROUP 256
// The number of counts that a lane scans.
#define SCAN_VALUES 4

// Each workgroup scans SETTLING_SCAN_GROUP * SCAN_VALUES values in place, and writes their sum to
// `sums`.
__kernel __attribute__((reqd_work_group_size(SETTLING_SCAN_GROUP, 1, 1)))
void settling_scan(const uint count, __global uint *values, __global uint *sums) {
    __local uint lanes[SETTLING_SCAN_GROUP];
    size_t group = get_global_id(0) / SETTLING_SCAN_GROUP;
    uint lane = get_local_id(0);
    size_t first = SCAN_VALUES * (size_t)get_global_id(0);
    uint own[SCAN_VALUES];
    uint sum = 0u;
    for (uint k = 0u; k < SCAN_VALUES; k++) {
        own[k] = sum;
        sum = add_sat(sum, first + k < count ? values[first + k] : 0u);
    }
    lanes[lane] = sum;
    for (uint reach = 1u; reach < SETTLING_SCAN_GROUP; reach *= 2u) {
        barrier(CLK_LOCAL_MEM_FENCE);
        uint further = lane >= reach ? lanes[lane - reach] : 0u;
        barrier(CLK_LOCAL_MEM_FENCE);
        lanes[lane] = add_sat(lanes[lane], further);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    uint before = lane > 0u ? lanes[lane - 1u] : 0u;
    for (uint k = 0u; k < SCAN_VALUES; k++) {
        if (first + k < count) {
            values[first + k] = add_sat(before, own[k]);
        }
    }
    if (lane == 0u) {
        sums[group] = lanes[SETTLING_SCAN_GROUP - 1];
    }
}

#define SETTLING_SCAN_ADD_GROUP 256

// Each workgroup adds the sum of all workgroups before it to its values.
__kernel __attribute__((reqd_work_group_size(SETTLING_SCAN_ADD_GROUP, 1, 1)))
void settling_scan_add(const uint count, __global uint *values, __global const uint *sums) {
    uint before = sums[get_global_id(0) / SETTLING_SCAN_ADD_GROUP];
    size_t first = SCAN_VALUES * (size_t)get_global_id(0);
    for (size_t k = first; k < min(first + SCAN_VALUES, (size_t)count); k++) {
        values[k] = add_sat(values[k], before);
    }
}
