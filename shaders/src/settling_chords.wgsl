// Chords from places, and how far they extend. After settling.wgsl.
//
// settling_chords.cl is the twin of this file.

const EXTENT_GROUP = 256u;

@group(0) @binding(15) var<storage, read> places: array<vec4<i32>>;
@group(0) @binding(16) var<storage, read> chord_rows: array<vec4<u32>>;
@group(0) @binding(17) var<storage, read_write> chords: array<vec4<u32>>;
@group(0) @binding(25) var<storage, read_write> extents: array<ExtentRow>;

// A lane a chord.
@compute @workgroup_size(64)
fn settling_chords(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
                   @builtin(local_invocation_index) lane: u32) {
    let number = (group.y * grid.x + group.x) * 64u + lane;
    if number >= settling.chords {
        return;
    }
    let row = chord_rows[number];
    let place = row.x;
    let interval = interval_new(places[place - 1u], places[place], places[place + 1u], places[place + 2u]);
    let first = place_rows[place].first_chord;
    let pieces = f32(place_rows[place + 1u].first_chord - first);
    let piece = number - first;
    let begins = interval_offset(interval, f32(piece) / pieces);
    let span = interval_offset(interval, f32(piece + 1u) / pieces) - begins;
    let at = interval.start + units_of(begins);
    chords[2u * number] = vec4(bitcast<vec3<u32>>(at), place);
    chords[2u * number + 1u] = vec4(bitcast<vec3<u32>>(span), row.w);
}

var<workgroup> lane_extents: array<ExtentRow, EXTENT_GROUP>;

fn both_extents(a: ExtentRow, b: ExtentRow) -> ExtentRow {
    return ExtentRow(
        min(a.low_x, b.low_x),
        min(a.low_y, b.low_y),
        max(a.high_x, b.high_x),
        max(a.high_y, b.high_y),
        max(a.longest, b.longest),
        array<u32, 3>(),
    );
}

// A workgroup of EXTENT_GROUP a row, of all chords that its lanes come to in strides.
@compute @workgroup_size(EXTENT_GROUP)
fn settling_extent(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
                   @builtin(local_invocation_index) lane: u32) {
    var extent = ExtentRow(2147483647, 2147483647, -2147483647, -2147483647, 0.0, array<u32, 3>());
    for (var number = group.x * EXTENT_GROUP + lane; number < settling.chords; number += grid.x * EXTENT_GROUP) {
        let chord = chord_of(chords[2u * number], chords[2u * number + 1u]);
        let middle = middle_of(chord);
        let squared = inner(chord.span, chord.span);
        extent = both_extents(extent, ExtentRow(middle.x, middle.y, middle.x, middle.y, squared, array<u32, 3>()));
    }
    lane_extents[lane] = extent;
    for (var reach = EXTENT_GROUP / 2u; reach > 0u; reach /= 2u) {
        workgroupBarrier();
        if lane < reach {
            lane_extents[lane] = both_extents(lane_extents[lane], lane_extents[lane + reach]);
        }
    }
    if lane == 0u {
        extents[group.x] = lane_extents[0];
    }
}
