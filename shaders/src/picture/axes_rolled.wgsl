// The rings of a block in screen space in workgroup memory, in the place of their stances. After axes.wgsl and rings.wgsl; the twin of
// axes_level.wgsl, which takes less memory.

fn held_axes(ring: u32) -> Axes {
    return Axes(standing.centre[ring], standing.tangent[ring], standing.side[ring]);
}

// Puts the rings of a block there: a lane a ring. Every lane must come here, and a barrier before they are read.
fn project_block(block: Block, lane: u32) {
    block_rings(yarns[block.yarn], block, lane);
    if lane < rings_made(block) {
        ring_rolls[block.chunk_ring + lane] = standing.roll[lane];
        let axes = axes_of(stance_of(lane));
        standing.centre[lane] = axes.centre;
        standing.tangent[lane] = axes.x;
        standing.side[lane] = axes.y;
    }
}
