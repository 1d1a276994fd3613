// Lists of neighbours. This file follows settling.cl.
//
// Its twins are settling_list.wgsl, and texere-core's neighbours.rs. Chords lie in their cells in
// any order, but the neighbours of a chord are listed in the order of their numbers.

// The extent of the chords of a workgroup (Rust: texere_gpu::ExtentRow, 32 bytes).
typedef struct {
    int low_x;
    int low_y;
    int high_x;
    int high_y;
    float longest;
    uint padding[3];
} ExtentRow;

#define SETTLING_EXTENT_GROUP 256

// Finds the longest chord, and the box round the middles of all chords. Any number of workgroups
// share the chords, and each writes a row.
__kernel __attribute__((reqd_work_group_size(SETTLING_EXTENT_GROUP, 1, 1)))
void settling_extent(const SettlingParams params, __global const uint4 *chords, __global ExtentRow *rows) {
    __local int4 ends[SETTLING_EXTENT_GROUP];
    __local float longests[SETTLING_EXTENT_GROUP];
    uint lane = get_local_id(0);
    int4 end = (int4)(INT_MAX, INT_MAX, INT_MIN, INT_MIN);
    float longest = 0.0f;
    for (size_t number = get_global_id(0); number < params.chords; number += get_global_size(0)) {
        Chord chord = chord_of(chords, number);
        uint3 middle = chord_middle(&params, &chord);
        int2 at = (int2)(as_int(middle.x), as_int(middle.y));
        end = (int4)(min(end.xy, at), max(end.zw, at));
        longest = fmax(longest, dot3(chord.span, chord.span));
    }
    ends[lane] = end;
    longests[lane] = longest;
    for (uint reach = SETTLING_EXTENT_GROUP / 2; reach > 0u; reach /= 2u) {
        barrier(CLK_LOCAL_MEM_FENCE);
        if (lane < reach) {
            int4 further = ends[lane + reach];
            ends[lane] = (int4)(min(ends[lane].xy, further.xy), max(ends[lane].zw, further.zw));
            longests[lane] = fmax(longests[lane], longests[lane + reach]);
        }
    }
    if (lane == 0u) {
        __global ExtentRow *row = rows + get_group_id(0);
        row->low_x = ends[0].x;
        row->low_y = ends[0].y;
        row->high_x = ends[0].z;
        row->high_y = ends[0].w;
        row->longest = longests[0];
    }
}

// ---- Cells ----

// The number of a cell along one axis. `low` is 0 if the axis repeats.
uint cell_along(uint middle, int period, int low, uint size, uint count) {
    uint from = middle - (uint)low;
    if (period > 0) {
        int rest = as_int(middle) % period;
        from = (uint)(rest < 0 ? rest + period : rest);
    }
    return min(from / size, count - 1u);
}

uint2 cell_of(const SettlingParams *params, uint3 middle) {
    return (uint2)(cell_along(middle.x, params->period_x, params->low_x, params->size_x, params->count_x),
                   cell_along(middle.y, params->period_y, params->low_y, params->size_y, params->count_y));
}

uint chord_cell(const SettlingParams *params, __global const uint4 *chords, size_t number) {
    Chord chord = chord_of(chords, number);
    uint2 cell = cell_of(params, chord_middle(params, &chord));
    return cell.y * params->count_x + cell.x;
}

#define SETTLING_CELL_COUNT_GROUP 64

// Counts the chords of each cell, with one lane for each chord. The count lies in the entry behind
// the cell's own.
__kernel __attribute__((reqd_work_group_size(SETTLING_CELL_COUNT_GROUP, 1, 1)))
void settling_cell_count(const SettlingParams params, __global const uint4 *chords, volatile __global uint *cells) {
    size_t number = get_global_id(0);
    if (number < params.chords) {
        atomic_inc(cells + chord_cell(&params, chords, number) + 1u);
    }
}

#define SETTLING_CELL_FILL_GROUP 64

// Sorts chords into cells, with one lane for each chord. The entry behind each cell is the position
// of its next chord, and at last the position where the cell ends.
__kernel __attribute__((reqd_work_group_size(SETTLING_CELL_FILL_GROUP, 1, 1)))
void settling_cell_fill(const SettlingParams params, __global const uint4 *chords, volatile __global uint *cells,
                        __global uint *sorted) {
    size_t number = get_global_id(0);
    if (number < params.chords) {
        sorted[atomic_inc(cells + chord_cell(&params, chords, number) + 1u)] = number;
    }
}

// ---- Neighbours ----

// Whether less than `window` of the yarn lies between an end and a start.
bool between(uint end, uint start, int window) {
    int units = as_int(start - end);
    return units >= -2 && units < window;
}

// Whether two chords of one yarn lie so close along the yarn that they can't be clear of one
// another.
bool leads_on(const ChordRow *one, const ChordRow *other, uint2 image, int window, const StrandRow *strand) {
    uint2 shift = (uint2)((uint)strand->shift_x, (uint)strand->shift_y);
    bool here = image.x == 0u && image.y == 0u &&
                (between(one->to, other->from, window) || between(other->to, one->from, window));
    bool ahead = image.x == shift.x && image.y == shift.y && between(one->to, other->from + strand->length, window);
    bool back = image.x == -shift.x && image.y == -shift.y && between(other->to, one->from + strand->length, window);
    return here || (strand->goes_on != 0u && (ahead || back));
}

bool are_neighbours(const SettlingParams *params, size_t number, const Chord *one, size_t other_number,
                    const Chord *other, __global const ChordRow *chord_rows, __global const PlaceRow *place_rows,
                    __global const StrandRow *strands) {
    uint3 way = other->at - one->at;
    uint2 image = nearest_image(params, one->span, other->span, way);
    float3 apart = to_mm(params, to_image(params, way, image));
    float2 shares = chords_nearest(one->span, other->span, apart);
    float3 gap = apart + other->span * shares.y - one->span * shares.x;
    float thickness = one->thickest + other->thickest;
    float within = MARGIN * params->growth * thickness + SKIN * params->diameter;
    if (!(dot3(gap, gap) < within * within)) {
        return false;
    }
    uint yarn = place_rows[one->place].yarn;
    if (yarn != place_rows[other->place].yarn) {
        return true;
    }
    ChordRow row = chord_rows[number];
    ChordRow other_row = chord_rows[other_number];
    StrandRow strand = strands[yarn];
    int window = convert_int_sat(LEADS_ON * thickness / params->along);
    return !leads_on(&row, &other_row, image, window, &strand);
}

// The first cell to visit along an axis (x) and the number of cells (y): a chord's own cell and
// those beside it, each once.
uint2 cells_beside(uint cell, int period, uint count) {
    if (count < 3u) {
        return (uint2)(0u, count);
    }
    if (period > 0) {
        return (uint2)((cell + count - 1u) % count, 3u);
    }
    uint first = max(cell, 1u) - 1u;
    return (uint2)(first, min(cell + 1u, count - 1u) - first + 1u);
}

// Finds the neighbours of chord `number`, and returns how many there are. The first `room` that are
// found are written to `list`, sorted by number.
uint find_neighbours(const SettlingParams *params, __global const uint4 *chords, __global const ChordRow *chord_rows,
                     __global const PlaceRow *place_rows, __global const StrandRow *strands,
                     __global const uint *cells, __global const uint *sorted, size_t number, __global uint *list,
                     uint room) {
    Chord one = chord_of(chords, number);
    uint2 cell = cell_of(params, chord_middle(params, &one));
    uint2 columns = cells_beside(cell.x, params->period_x, params->count_x);
    uint2 rows = cells_beside(cell.y, params->period_y, params->count_y);
    uint found = 0u;
    for (uint beside = 0u; beside < columns.y * rows.y; beside++) {
        uint column = (columns.x + beside % columns.y) % params->count_x;
        uint row = (rows.x + beside / columns.y) % params->count_y;
        uint cell_number = row * params->count_x + column;
        uint end = cells[cell_number + 1u];
        for (uint next = cells[cell_number]; next < end; next++) {
            uint candidate = sorted[next];
            Chord other = chord_of(chords, candidate);
            if (candidate == number ||
                !are_neighbours(params, number, &one, candidate, &other, chord_rows, place_rows, strands)) {
                continue;
            }
            if (found < room) {
                uint at = found;
                for (; at > 0u && list[at - 1u] > candidate; at--) {
                    list[at] = list[at - 1u];
                }
                list[at] = candidate;
            }
            found++;
        }
    }
    return found;
}

#define SETTLING_COUNT_GROUP 64

// Counts the neighbours of each chord, with one lane for each chord.
__kernel __attribute__((reqd_work_group_size(SETTLING_COUNT_GROUP, 1, 1)))
void settling_count(const SettlingParams params, __global const uint4 *chords, __global const ChordRow *chord_rows,
                    __global const PlaceRow *place_rows, __global const StrandRow *strands,
                    __global const uint *cells, __global const uint *sorted, __global uint *counts) {
    size_t number = get_global_id(0);
    if (number < params.chords) {
        counts[number] =
            find_neighbours(&params, chords, chord_rows, place_rows, strands, cells, sorted, number, 0, 0u);
    }
}

#define SETTLING_FILL_GROUP 64

// Lists the neighbours of each chord, with one lane for each chord.
__kernel __attribute__((reqd_work_group_size(SETTLING_FILL_GROUP, 1, 1)))
void settling_fill(const SettlingParams params, __global const uint4 *chords, __global const ChordRow *chord_rows,
                   __global const PlaceRow *place_rows, __global const StrandRow *strands,
                   __global const uint *cells, __global const uint *sorted, __global const uint *starts,
                   __global uint *neighbours) {
    size_t number = get_global_id(0);
    if (number < params.chords) {
        uint start = starts[number];
        find_neighbours(&params, chords, chord_rows, place_rows, strands, cells, sorted, number, neighbours + start,
                        starts[number + 1u] - start);
    }
}
