// A block's rings in screen space, in workgroup memory, for fabrics in which no section turns.
// After axes.wgsl; the twin of axes_rolled.wgsl.

var<workgroup> held: array<Axes, BLOCK_RINGS + 1u>;

fn held_axes(ring: u32) -> Axes {
    return held[ring];
}

// Writes the rings of a block: a lane for each ring, which it also returns. A barrier must come
// before other lanes' rings are read.
fn project_block(block: Block, lane: u32) -> Axes {
    var own: Axes;
    if lane <= block.quads {
        own = axes_of(stance_of_sample(ring_sample(yarns[block.yarn], block, lane).sample, vec2(0u)));
        held[lane] = own;
    }
    return own;
}
