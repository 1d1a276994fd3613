// A chunk's mesh as pictures read it. After view.wgsl.

// Rust: texere_render's Run, 16 bytes. A block of the chunk's rings and the quads that start from them, or a yarn's cap.
struct Run {
    yarn: u32,
    // Of the yarn.
    first_ring: u32,
    // Rings that quads start from: none of a cap.
    gaps: u32,
    first_vertex: u32,
}

// Marks a cap's triangles, in the number of their run.
const CAP = 0x80000000u;

// Positions and normals.
@group(1) @binding(1) var<storage, read> vertices: array<f32>;
@group(1) @binding(2) var<storage, read> runs: array<Run>;

fn position_of(number: u32) -> vec3<f32> {
    let at = 6u * number;
    return vec3(vertices[at], vertices[at + 1u], vertices[at + 2u]);
}

fn clip_of(position: vec3<f32>) -> vec4<f32> {
    return view.clip_from_local * vec4(position - view.target_point, 1.0);
}
