// Chords by cells of a grid over x and y. After settling.wgsl.
//
// settling_cells.cl is the twin of this file. The order of chords within a cell is not always the same; lists are put in order
// where they are made.

@group(0) @binding(17) var<storage, read> chords: array<vec4<u32>>;
// Where each cell's chords begin, and the end of the last one's. While they are counted, and until they are filled in, a cell's
// number stands one further.
@group(0) @binding(18) var<storage, read_write> cell_starts: array<atomic<u32>>;
@group(0) @binding(19) var<storage, read_write> cell_chords: array<u32>;

// A lane a chord: counts the chords of each cell.
@compute @workgroup_size(64)
fn settling_cell_count(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
                       @builtin(local_invocation_index) lane: u32) {
    let number = (group.y * grid.x + group.x) * 64u + lane;
    if number < settling.chords {
        let cell = cell_number(cell_of(middle_of(chord_of(chords[2u * number], chords[2u * number + 1u]))));
        atomicAdd(&cell_starts[cell + 1u], 1u);
    }
}

// A lane a chord: puts each into its cell.
@compute @workgroup_size(64)
fn settling_cell_fill(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
                      @builtin(local_invocation_index) lane: u32) {
    let number = (group.y * grid.x + group.x) * 64u + lane;
    if number < settling.chords {
        let cell = cell_number(cell_of(middle_of(chord_of(chords[2u * number], chords[2u * number + 1u]))));
        let slot = atomicAdd(&cell_starts[cell + 1u], 1u);
        cell_chords[min(slot, settling.chords - 1u)] = number;
    }
}
