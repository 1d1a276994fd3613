// The rings of a block in screen space, in workgroup memory, in place of their stances. This file
// follows axes.wgsl and rings.wgsl. axes_level.wgsl is used in its place if no section turns, and
// takes less memory.

fn held_axes(ring: u32) -> Axes {
    return Axes(standing.centre[ring], standing.tangent[ring], standing.side[ring]);
}

// Writes the rings of a block, with one lane for each ring, and returns the lane's own ring. Every
// lane must call this function, and a barrier must come before the rings of other lanes are read.
fn project_block(block: Block, lane: u32) -> Axes {
    var own: Axes;
    block_rings(yarns[block.yarn], block, lane);
    if lane < rings_made(block) {
        ring_rolls[block.chunk_ring + lane] = vec2(standing.roll[lane], lean_of(yarns[block.yarn], block.first_ring + lane));
        own = axes_of(stance_of(lane));
        standing.centre[lane] = own.centre;
        standing.tangent[lane] = own.x;
        standing.side[lane] = own.y;
    }
    return own;
}
