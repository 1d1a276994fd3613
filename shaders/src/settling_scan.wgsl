// Counts to where each begins: an exclusive scan in place, in tiles of SCAN_TILE. It needs no other file.
//
// settling_scan.cl is the twin of this file. Sums stay at the largest number where they would exceed it, so that the host sees
// that there are too many.

const SCAN_GROUP = 256u;
const SCAN_TILE = 4u * SCAN_GROUP;
const SCAN_MOST = 0xffffffffu;

// Bound as long as they are: one number more than what is counted; one a tile.
@group(0) @binding(26) var<storage, read_write> numbers: array<u32>;
@group(0) @binding(27) var<storage, read_write> tile_sums: array<u32>;

var<workgroup> lane_sums: array<u32, SCAN_GROUP>;

fn saturating(a: u32, b: u32) -> u32 {
    let sum = a + b;
    return select(sum, SCAN_MOST, sum < a);
}

// A workgroup of SCAN_GROUP a tile: its numbers become the sums of those before them in the tile, and all together one of
// `tile_sums`.
@compute @workgroup_size(SCAN_GROUP)
fn settling_scan(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
                 @builtin(local_invocation_index) lane: u32) {
    let tile = group.y * grid.x + group.x;
    let count = arrayLength(&numbers);
    let first = tile * SCAN_TILE + 4u * lane;
    var own: array<u32, 4>;
    var sum = 0u;
    for (var k = 0u; k < 4u; k++) {
        own[k] = 0u;
        if first + k < count {
            own[k] = numbers[first + k];
        }
        sum = saturating(sum, own[k]);
    }
    lane_sums[lane] = sum;
    for (var reach = 1u; reach < SCAN_GROUP; reach *= 2u) {
        workgroupBarrier();
        var further = 0u;
        if lane >= reach {
            further = lane_sums[lane - reach];
        }
        workgroupBarrier();
        lane_sums[lane] = saturating(lane_sums[lane], further);
    }
    workgroupBarrier();
    var before = 0u;
    if lane > 0u {
        before = lane_sums[lane - 1u];
    }
    for (var k = 0u; k < 4u; k++) {
        if first + k < count {
            numbers[first + k] = before;
        }
        before = saturating(before, own[k]);
    }
    if lane == SCAN_GROUP - 1u && tile < arrayLength(&tile_sums) {
        tile_sums[tile] = before;
    }
}

// A workgroup of SCAN_GROUP a tile: adds what comes before the tile to each of its numbers.
@compute @workgroup_size(SCAN_GROUP)
fn settling_scan_add(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
                     @builtin(local_invocation_index) lane: u32) {
    let tile = group.y * grid.x + group.x;
    if tile >= arrayLength(&tile_sums) {
        return;
    }
    let before = tile_sums[tile];
    for (var k = 0u; k < 4u; k++) {
        let number = tile * SCAN_TILE + k * SCAN_GROUP + lane;
        if number < arrayLength(&numbers) {
            numbers[number] = saturating(numbers[number], before);
        }
    }
}
