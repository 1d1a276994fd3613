// A chunk of the fabric, drawn from control points without a mesh. This file follows common.wgsl
// and view.wgsl.
//
// Group 0 holds the session's tables of the chunk, each resource at its own number. Group 1 holds
// what pictures add.

// Rust: texere_render's Sweep, 32 bytes. A sweep goes through the chunk's blocks once.
struct Sweep {
    // The first row of the screen that has keys, and the number of such rows.
    first_row: u32,
    rows: u32,
    // If keys have 32 bits, sweep 0 finds depths and sweep 1 finds triangles.
    number: u32,
    // How far a section reaches from its centre, in half widths or half heights.
    reach: f32,
    // 1 if nothing was drawn before, else 0.
    is_first: u32,
    // How far fibres stand off, mm; 0 if none are drawn.
    hair_reach: f32,
}

// Three lists of row numbers. The first list has the blocks that the view may show. The second
// begins at params.blocks, and has the blocks with FEW quads (see cover.wgsl). The third begins at
// twice params.blocks, and has the blocks with MANY quads. The second and third lists are for later
// passes.
struct Listed {
    count: atomic<u32>,
    few_count: atomic<u32>,
    many_count: atomic<u32>,
    rows: array<u32>,
}

@group(0) @binding(5) var<storage, read> outlines: array<vec4<f32>>;
@group(1) @binding(1) var<uniform> sweep: Sweep;

// The number of triangles that a block of the table, or a cap, has numbers for.
fn numbers_of_block() -> u32 {
    return 2u * BLOCK_RINGS * params.sides;
}

// A quad of a block, from its number: its ring, its side and the next side.
fn quad_at(number: u32) -> vec3<u32> {
    let ring = quotient(number, params.sides);
    let side = number - ring * params.sides;
    return vec3(ring, side, side_beside(side));
}

fn side_beside(side: u32) -> u32 {
    return select(side + 1u, 0u, side + 1u == params.sides);
}

// The distance of the screen's middle from its left and upper edges, in units of 1/256 pixel.
fn middle() -> vec2<i32> {
    return vec2<i32>(view.size * 128.0);
}

// A sample of pixel `x` in row `row`, in units of 1/256 pixel from the middle.
fn sample_place(x: i32, row: i32) -> vec2<i32> {
    let pixel = vec2(x, row >> 2u);
    return pixel * 256 + sample_in(pixel, row & 3) - middle();
}

// The index of a sample's key. The pixel is number `x` in its row, and the row lies `row` rows
// below the first row that has keys.
fn key_at(x: u32, row: u32, sample: u32) -> u32 {
    return (row * u32(view.size.x) + x) * 4u + sample;
}

// How the section stands at the end that `cap` closes. `roll` is the roll and the lean of the ring
// there.
fn cap_stance(cap: CapRow, roll: vec2<u32>) -> Stance {
    let segment = segment_new(cap.first_point, params.s);
    let sample = segment_sample(segment, select(1.0, 0.0, cap.end == 0u));
    return stance_of_sample(sample, roll);
}

// How the section stands at a sample of the spline. `roll` is the roll and the lean of the ring
// there.
fn stance_of_sample(sample: Sample, roll: vec2<u32>) -> Stance {
    let centre = vec4(sample.centre, sample.half_width);
    let tangent = vec4(sample.tangent, sample.width_growth);
    let height = vec2(sample.half_height, sample.height_growth);
    let round = is_round(vec2(centre.w, tangent.w), height);
    let side = side_of(sample.tangent, roll.x, roll.y, round);
    return stance_new(centre, tangent, side, height, turn_sin_cos(roll.x - roll.y));
}
