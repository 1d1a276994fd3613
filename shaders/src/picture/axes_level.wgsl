// The rings of a block of yarns that nowhere turn, in screen space in workgroup memory. After
// axes.wgsl; the twin of axes_rolled.wgsl.

var<workgroup> held: array<Axes, BLOCK_RINGS + 1u>;

fn held_axes(ring: u32) -> Axes {
    return held[ring];
}

// Puts the rings of a block there: a lane a ring, which it gives. A barrier must come before others
// are read.
fn project_block(block: Block, lane: u32) -> Axes {
    var own: Axes;
    if lane <= block.quads {
        own = axes_of(stance_of_sample(ring_sample(yarns[block.yarn], block, lane).sample, vec2(0u)));
        held[lane] = own;
    }
    return own;
}
