// Scans: each count is replaced by the sum of all counts before it. This file needs no other.
//
// settling_scan.cl is the twin of this file. Sums saturate at the largest number, so that too large
// a sum is noticed.

const SETTLING_SCAN_GROUP = 256u;
// The number of counts that a lane scans.
const SCAN_VALUES = 4u;

// The values. The binding is as long as the values are, since there is no other count of them.
@group(0) @binding(26) var<storage, read_write> values: array<u32>;
@group(0) @binding(27) var<storage, read_write> sums: array<u32>;

var<workgroup> lane_sums: array<u32, SETTLING_SCAN_GROUP>;

fn add_sat(a: u32, b: u32) -> u32 {
    let sum = a + b;
    return select(sum, 0xffffffffu, sum < a);
}

// Each workgroup scans SETTLING_SCAN_GROUP * SCAN_VALUES values in place, and writes their sum to
// `sums`.
@compute @workgroup_size(SETTLING_SCAN_GROUP)
fn settling_scan(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
                 @builtin(local_invocation_index) lane: u32) {
    let number = group.y * grid.x + group.x;
    let first = SCAN_VALUES * (number * SETTLING_SCAN_GROUP + lane);
    var own: array<u32, SCAN_VALUES>;
    var sum = 0u;
    for (var k = 0u; k < SCAN_VALUES; k++) {
        own[k] = sum;
        if first + k < arrayLength(&values) {
            sum = add_sat(sum, values[first + k]);
        }
    }
    lane_sums[lane] = sum;
    for (var reach = 1u; reach < SETTLING_SCAN_GROUP; reach *= 2u) {
        workgroupBarrier();
        var further = 0u;
        if lane >= reach {
            further = lane_sums[lane - reach];
        }
        workgroupBarrier();
        lane_sums[lane] = add_sat(lane_sums[lane], further);
    }
    workgroupBarrier();
    var before = 0u;
    if lane > 0u {
        before = lane_sums[lane - 1u];
    }
    for (var k = 0u; k < SCAN_VALUES; k++) {
        if first + k < arrayLength(&values) {
            values[first + k] = add_sat(before, own[k]);
        }
    }
    if lane == 0u && number < arrayLength(&sums) {
        sums[number] = lane_sums[SETTLING_SCAN_GROUP - 1u];
    }
}

// Each workgroup adds the sum of all workgroups before it to its values.
@compute @workgroup_size(SETTLING_SCAN_GROUP)
fn settling_scan_add(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
                     @builtin(local_invocation_index) lane: u32) {
    let number = group.y * grid.x + group.x;
    if number >= arrayLength(&sums) {
        return;
    }
    let first = SCAN_VALUES * (number * SETTLING_SCAN_GROUP + lane);
    for (var k = first; k < min(first + SCAN_VALUES, arrayLength(&values)); k++) {
        values[k] = add_sat(values[k], sums[number]);
    }
}
