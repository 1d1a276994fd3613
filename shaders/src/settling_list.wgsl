// Lists of neighbours. This file follows settling.wgsl.
//
// settling_list.cl is the twin of this file, and texere-core's neighbours.rs is the definition.
// Chords lie in their cells in any order, but the neighbours of a chord are listed in the order of
// their numbers.

@group(0) @binding(14) var<storage, read> strands: array<StrandRow>;
@group(0) @binding(16) var<storage, read> chord_rows: array<vec4<u32>>;
@group(0) @binding(17) var<storage, read> chords: array<vec4<u32>>;
// The entry behind each cell is first the cell's count, then the position of its next chord, and at
// last the position where the cell ends.
@group(0) @binding(18) var<storage, read_write> cell_counts: array<atomic<u32>>;
@group(0) @binding(18) var<storage, read> cells: array<u32>;
@group(0) @binding(19) var<storage, read_write> to_sort: array<u32>;
@group(0) @binding(19) var<storage, read> sorted: array<u32>;
// At first the number of each chord's neighbours. Later the position of the first of them, and the
// number of all neighbours at the end.
@group(0) @binding(20) var<storage, read_write> starts: array<u32>;
@group(0) @binding(21) var<storage, read_write> neighbours: array<u32>;
@group(0) @binding(25) var<storage, read_write> extents: array<ExtentRow>;

fn chord(number: u32) -> Chord {
    return chord_of(chords[2u * number], chords[2u * number + 1u]);
}

const SETTLING_EXTENT_GROUP = 256u;

var<workgroup> lane_extents: array<ExtentRow, SETTLING_EXTENT_GROUP>;

fn extent_of_both(one: ExtentRow, other: ExtentRow) -> ExtentRow {
    return ExtentRow(
        min(one.low_x, other.low_x),
        min(one.low_y, other.low_y),
        max(one.high_x, other.high_x),
        max(one.high_y, other.high_y),
        max(one.longest, other.longest),
        array<u32, 3>(),
    );
}

// Finds the longest chord, and the box round the middles of all chords. Any number of workgroups
// share the chords, and each writes a row.
@compute @workgroup_size(SETTLING_EXTENT_GROUP)
fn settling_extent(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
                   @builtin(local_invocation_index) lane: u32) {
    var extent = ExtentRow(2147483647, 2147483647, -2147483647, -2147483647, 0.0, array<u32, 3>());
    let lanes = grid.x * SETTLING_EXTENT_GROUP;
    for (var number = group.x * SETTLING_EXTENT_GROUP + lane; number < settling.chords; number += lanes) {
        let own = chord(number);
        let at = chord_middle(own);
        let row = ExtentRow(at.x, at.y, at.x, at.y, dot3(own.span, own.span), array<u32, 3>());
        extent = extent_of_both(extent, row);
    }
    lane_extents[lane] = extent;
    for (var reach = SETTLING_EXTENT_GROUP / 2u; reach > 0u; reach /= 2u) {
        workgroupBarrier();
        if lane < reach {
            lane_extents[lane] = extent_of_both(lane_extents[lane], lane_extents[lane + reach]);
        }
    }
    if lane == 0u {
        extents[group.x] = lane_extents[0];
    }
}

// ---- Cells ----

// The number of a cell along one axis. `low` is 0 if the axis repeats.
fn cell_along(middle: i32, period: i32, low: i32, size: u32, count: u32) -> u32 {
    var beyond = bitcast<u32>(middle - low);
    if period > 0 {
        let rest = middle % period;
        beyond = bitcast<u32>(select(rest, rest + period, rest < 0));
    }
    return min(beyond / size, count - 1u);
}

fn cell_of(middle: vec3<i32>) -> vec2<u32> {
    return vec2(
        cell_along(middle.x, settling.period_x, settling.low_x, settling.size_x, settling.count_x),
        cell_along(middle.y, settling.period_y, settling.low_y, settling.size_y, settling.count_y),
    );
}

fn chord_cell(number: u32) -> u32 {
    let cell = cell_of(chord_middle(chord(number)));
    return cell.y * settling.count_x + cell.x;
}

const SETTLING_CELL_GROUP = 64u;

// Counts the chords of each cell, with one lane for each chord. The count lies in the entry behind
// the cell's own.
@compute @workgroup_size(SETTLING_CELL_GROUP)
fn settling_cell_count(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
                       @builtin(local_invocation_index) lane: u32) {
    let number = (group.y * grid.x + group.x) * SETTLING_CELL_GROUP + lane;
    if number < settling.chords {
        atomicAdd(&cell_counts[chord_cell(number) + 1u], 1u);
    }
}

// Sorts chords into cells, with one lane for each chord.
@compute @workgroup_size(SETTLING_CELL_GROUP)
fn settling_cell_fill(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
                      @builtin(local_invocation_index) lane: u32) {
    let number = (group.y * grid.x + group.x) * SETTLING_CELL_GROUP + lane;
    if number < settling.chords {
        let slot = atomicAdd(&cell_counts[chord_cell(number) + 1u], 1u);
        to_sort[min(slot, settling.chords - 1u)] = number;
    }
}

// ---- Neighbours ----

// Whether less than `window` of the yarn lies between an end and a start.
fn between(end: u32, start: u32, window: i32) -> bool {
    let units = bitcast<i32>(start - end);
    return units >= -2 && units < window;
}

// Whether two chords of one yarn lie so close along the yarn that they can't be clear of one
// another.
fn leads_on(one: vec4<u32>, other: vec4<u32>, image: vec2<i32>, window: i32, strand: StrandRow) -> bool {
    let shift = vec2(strand.shift_x, strand.shift_y);
    let here = all(image == vec2(0)) && (between(one.z, other.y, window) || between(other.z, one.y, window));
    let ahead = all(image == shift) && between(one.z, other.y + strand.length, window);
    let back = all(image == -shift) && between(other.z, one.y + strand.length, window);
    return here || (strand.goes_on != 0u && (ahead || back));
}

fn are_neighbours(number: u32, one: Chord, other_number: u32, other: Chord) -> bool {
    let way = other.at - one.at;
    let image = nearest_image(one.span, other.span, way);
    let apart = to_mm(to_image(way, image));
    let shares = chords_nearest(one.span, other.span, apart);
    let gap = apart + other.span * shares.y - one.span * shares.x;
    let thickness = one.thickest + other.thickest;
    let within = MARGIN * settling.growth * thickness + SKIN * settling.diameter;
    if dot3(gap, gap) >= within * within {
        return false;
    }
    let yarn = place_rows[one.place].yarn;
    if yarn != place_rows[other.place].yarn {
        return true;
    }
    let window = i32(LEADS_ON * thickness / settling.along);
    return !leads_on(chord_rows[number], chord_rows[other_number], image, window, strands[yarn]);
}

// The first cell to visit along an axis (x) and the number of cells (y): a chord's own cell and
// those beside it, each once.
fn cells_beside(cell: u32, period: i32, count: u32) -> vec2<u32> {
    if count < 3u {
        return vec2(0u, count);
    }
    if period > 0 {
        return vec2((cell + count - 1u) % count, 3u);
    }
    let first = max(cell, 1u) - 1u;
    return vec2(first, min(cell + 1u, count - 1u) - first + 1u);
}

// Finds the neighbours of chord `number`, and returns how many there are. The first `room` that are
// found are written to the list from `start` on, sorted by number.
fn find_neighbours(number: u32, start: u32, room: u32) -> u32 {
    let one = chord(number);
    let cell = cell_of(chord_middle(one));
    let columns = cells_beside(cell.x, settling.period_x, settling.count_x);
    let rows = cells_beside(cell.y, settling.period_y, settling.count_y);
    var found = 0u;
    for (var beside = 0u; beside < columns.y * rows.y; beside++) {
        let column = (columns.x + beside % columns.y) % settling.count_x;
        let row = (rows.x + beside / columns.y) % settling.count_y;
        let cell_number = row * settling.count_x + column;
        let end = min(cells[cell_number + 1u], settling.chords);
        for (var next = cells[cell_number]; next < end; next++) {
            let candidate = sorted[next];
            if candidate == number || !are_neighbours(number, one, candidate, chord(candidate)) {
                continue;
            }
            if found < room {
                var at = start + found;
                for (; at > start && neighbours[at - 1u] > candidate; at--) {
                    neighbours[at] = neighbours[at - 1u];
                }
                neighbours[at] = candidate;
            }
            found++;
        }
    }
    return found;
}

const SETTLING_LIST_GROUP = 64u;

// Counts the neighbours of each chord, with one lane for each chord.
@compute @workgroup_size(SETTLING_LIST_GROUP)
fn settling_count(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
                  @builtin(local_invocation_index) lane: u32) {
    let number = (group.y * grid.x + group.x) * SETTLING_LIST_GROUP + lane;
    if number < settling.chords {
        starts[number] = find_neighbours(number, 0u, 0u);
    }
}

// Lists the neighbours of each chord, with one lane for each chord. The compiler may round
// differently here than in the shader that counted. Entries that are left over for that reason get
// a number that is no chord's.
@compute @workgroup_size(SETTLING_LIST_GROUP)
fn settling_fill(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
                 @builtin(local_invocation_index) lane: u32) {
    let number = (group.y * grid.x + group.x) * SETTLING_LIST_GROUP + lane;
    if number < settling.chords {
        let start = starts[number];
        let end = min(starts[number + 1u], arrayLength(&neighbours));
        let room = max(end, start) - start;
        for (var next = start + find_neighbours(number, start, room); next < end; next++) {
            neighbours[next] = settling.chords;
        }
    }
}
