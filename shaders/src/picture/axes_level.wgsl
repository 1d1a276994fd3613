// The rings of a block in screen space, in workgroup memory, for fabrics in which no section turns.
// This file follows axes.wgsl. axes_rolled.wgsl is used in its place if any section turns.

var<workgroup> held: array<Axes, BLOCK_RINGS + 1u>;

fn held_axes(ring: u32) -> Axes {
    return held[ring];
}

// Writes the rings of a block, with one lane for each ring, and returns the lane's own ring. A
// barrier must come before the rings of other lanes are read.
fn project_block(block: Block, lane: u32) -> Axes {
    var own: Axes;
    if lane <= block.quads {
        own = axes_of(stance_of_sample(ring_sample(yarns[block.yarn], block, lane).sample, vec2(0u)));
        held[lane] = own;
    }
    return own;
}
