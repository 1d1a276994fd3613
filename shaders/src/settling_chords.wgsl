// Chords from places. This file follows settling.wgsl. Its twin is a part of settling.cl.

@group(0) @binding(15) var<storage, read> places: array<vec4<i32>>;
@group(0) @binding(16) var<storage, read> chord_rows: array<vec4<u32>>;
@group(0) @binding(17) var<storage, read_write> chords: array<vec4<u32>>;

const SETTLING_CHORDS_GROUP = 64u;

// Works out all chords from places, with one lane for each chord.
@compute @workgroup_size(SETTLING_CHORDS_GROUP)
fn settling_chords(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
                   @builtin(local_invocation_index) lane: u32) {
    let number = (group.y * grid.x + group.x) * SETTLING_CHORDS_GROUP + lane;
    if number >= settling.chords {
        return;
    }
    let row = chord_rows[number];
    let place = row.x;
    let first = place_rows[place].first_chord;
    let pieces = f32(place_rows[place + 1u].first_chord - first);
    let piece = number - first;
    let interval = interval_of(places[place - 1u], places[place], places[place + 1u], places[place + 2u]);
    let begins = interval_offset(interval, f32(piece) / pieces);
    let span = interval_offset(interval, f32(piece + 1u) / pieces) - begins;
    chords[2u * number] = vec4(bitcast<vec3<u32>>(interval.start + to_units(begins)), place);
    chords[2u * number + 1u] = vec4(bitcast<vec3<u32>>(span), row.w);
}
