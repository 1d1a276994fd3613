// Which chords are neighbours. After settling.wgsl.
//
// settling_neighbours.cl is the twin of this file, and neighbours.rs of texere-core the definition.

@group(0) @binding(14) var<storage, read> strands: array<StrandRow>;
@group(0) @binding(16) var<storage, read> chord_rows: array<vec4<u32>>;
@group(0) @binding(17) var<storage, read> chords: array<vec4<u32>>;
@group(0) @binding(18) var<storage, read> cell_starts: array<u32>;
@group(0) @binding(19) var<storage, read> cell_chords: array<u32>;
// How many neighbours each chord has; then where they begin, and the end of the last one's.
@group(0) @binding(20) var<storage, read_write> starts: array<u32>;
@group(0) @binding(21) var<storage, read_write> neighbours: array<u32>;

// Whether less than `window` units lie between the end of a chord and the start of one further along.
fn is_between(end: u32, start: u32, window: i32) -> bool {
    let way = bitcast<i32>(start - end);
    return way >= -2 && way < window;
}

// Whether two chords lie so close along one yarn that less than `window` mm are between them.
fn leads_on(number: u32, other: u32, one_place: u32, other_place: u32, image: vec2<i32>, window: f32) -> bool {
    let yarn = place_rows[one_place].yarn;
    if yarn != place_rows[other_place].yarn {
        return false;
    }
    let strand = strands[yarn];
    let one_row = chord_rows[number];
    let other_row = chord_rows[other];
    let most = i32(window / settling.along);
    let shift = vec2(strand.shift_x, strand.shift_y);
    let here = all(image == vec2(0)) && (is_between(one_row.z, other_row.y, most) || is_between(other_row.z, one_row.y, most));
    let ahead = all(image == shift) && is_between(one_row.z, other_row.y + strand.length, most);
    let back = all(image == -shift) && is_between(other_row.z, one_row.y + strand.length, most);
    return here || (strand.goes_on != 0u && (ahead || back));
}

// Whether two chords are neighbours.
fn are_neighbours(number: u32, one: Chord, other_number: u32, other: Chord) -> bool {
    let found = nearest(one, other);
    let thickness = one.thickest + other.thickest;
    let within = MARGIN * settling.growth * thickness + SKIN * settling.diameter;
    return inner(found.apart, found.apart) < within * within
        && !leads_on(number, other_number, one.place, other.place, found.image, LEADS_ON * thickness);
}

// Which cells along an axis lie beside number `cell` of `count` or are that one: the first, and how many, each once.
fn cells_beside(cell: u32, count: u32, repeats: bool) -> vec2<u32> {
    if repeats && count >= 3u {
        return vec2((cell + count - 1u) % count, 3u);
    }
    if repeats {
        return vec2(0u, count);
    }
    let first = max(cell, 1u) - 1u;
    return vec2(first, min(cell + 2u, count) - first);
}

// Goes over the neighbours of chord `number` and gives back how many there are. Where `fill` is set, it writes each to its place
// among those before it, from `begin` up to `end`.
fn list(number: u32, fill: bool, begin: u32, end: u32) -> u32 {
    let one = chord_of(chords[2u * number], chords[2u * number + 1u]);
    let own = cell_of(middle_of(one));
    let columns = cells_beside(own.x, settling.count_x, settling.period_x > 0);
    let rows = cells_beside(own.y, settling.count_y, settling.period_y > 0);
    var found = begin;
    for (var beside = 0u; beside < columns.y * rows.y; beside++) {
        let column = (columns.x + beside % columns.y) % settling.count_x;
        let cell = (rows.x + beside / columns.y) % settling.count_y * settling.count_x + column;
        let last = min(cell_starts[cell + 1u], settling.chords);
        for (var slot = cell_starts[cell]; slot < last; slot++) {
            let other = cell_chords[slot];
            if other == number
                || !are_neighbours(number, one, other, chord_of(chords[2u * other], chords[2u * other + 1u])) {
                continue;
            }
            if fill && found < end {
                var at = found;
                for (; at > begin && neighbours[at - 1u] > other; at--) {
                    neighbours[at] = neighbours[at - 1u];
                }
                neighbours[at] = other;
            }
            found++;
        }
    }
    return found;
}

// A lane a chord: how many neighbours it has.
@compute @workgroup_size(64)
fn settling_count(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
                  @builtin(local_invocation_index) lane: u32) {
    let number = (group.y * grid.x + group.x) * 64u + lane;
    if number < settling.chords {
        starts[number] = list(number, false, 0u, 0u);
    }
}

// A lane a chord: writes them in the order of their numbers. What is left of a chord's part, if this shader finds fewer than the
// one that counted, gets a number that is no chord's.
@compute @workgroup_size(64)
fn settling_fill(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
                 @builtin(local_invocation_index) lane: u32) {
    let number = (group.y * grid.x + group.x) * 64u + lane;
    if number < settling.chords {
        let end = min(starts[number + 1u], arrayLength(&neighbours));
        for (var slot = list(number, true, starts[number], end); slot < end; slot++) {
            neighbours[slot] = settling.chords;
        }
    }
}
