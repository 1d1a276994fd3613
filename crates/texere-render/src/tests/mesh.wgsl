// Draws the mesh by a device's own rasteriser: what is nearest in each sample, unlit. This file
// follows texere_shaders::picture::KEPT and the constant SIDES.

// Rust: Run, 16 bytes. A run is a block of the chunk's rings with the quads that start from them,
// or a yarn's cap.
struct Run {
    yarn: u32,
    // The number of the run's first ring in its yarn.
    first_ring: u32,
    // The number of rings from which quads start; 0 for a cap.
    gaps: u32,
    first_vertex: u32,
}

// The bit of a triangle's run number that marks a triangle of a cap.
const CAP = 0x80000000u;

// The positions and normals of vertices.
@group(1) @binding(1) var<storage, read> vertices: array<f32>;
@group(1) @binding(2) var<storage, read> runs: array<Run>;

fn position_of(number: u32) -> vec3<f32> {
    let at = 6u * number;
    return vec3(vertices[at], vertices[at + 1u], vertices[at + 2u]);
}

struct Seen {
    @builtin(position) position: vec4<f32>,
    @location(0) normal: vec3<f32>,
    // The direction along the facet at its first corner. It is the direction of the fibres, because
    // a twisted yarn's corners turn with its twist. It is taken from the facet alone, so that it
    // does not depend on where a chunk is cut.
    @location(1) @interpolate(flat) fibre: vec3<f32>,
    // The place on the yarn: cosine and sine of the angle round it; `along` is the number of rings
    // along it.
    @location(2) around: vec2<f32>,
    @location(3) along: f32,
    @location(4) @interpolate(flat) yarn: u32,
}

// For each triangle, its three vertices and its run.
@group(1) @binding(3) var<storage, read> triangles: array<vec4<u32>>;

@vertex
fn yarn_corner(@builtin(vertex_index) corner: u32) -> Seen {
    let triangle = triangles[corner / 3u];
    let is_cap = (triangle.w & CAP) != 0u;
    let run = runs[triangle.w & ~CAP];
    let number = triangle[corner % 3u];
    let position = position_of(number);
    let normal = vec3(vertices[6u * number + 3u], vertices[6u * number + 4u], vertices[6u * number + 5u]);
    let inside = number - run.first_vertex;
    let angle = f32(inside % SIDES) * (TAU / f32(SIDES));
    var seen: Seen;
    seen.position = clip_of(position);
    seen.normal = normal;
    // The direction to the next ring. Behind a run's last ring there is another run or nothing, but
    // no facet's first corner lies on that ring.
    seen.fibre = normal;
    if !is_cap && inside < run.gaps * SIDES {
        seen.fibre = position_of(number + SIDES) - position;
    }
    seen.around = vec2(cos(angle), sin(angle));
    seen.along = f32(inside / SIDES + run.first_ring);
    seen.yarn = select(run.yarn, run.yarn | CUT, is_cap);
    return seen;
}

// The encoded sample in numbers of 16 bits, because a rasteriser has no targets of 32 bits for
// several samples a pixel.
struct Kept {
    @location(0) directions: vec4<u32>,
    @location(1) place: vec4<u32>,
}

fn halves(both: u32) -> vec2<u32> {
    return vec2(both & 0xffffu, both >> 16u);
}

@fragment
fn yarn_sample(seen: Seen, @builtin(front_facing) is_front: bool) -> Kept {
    let angle = fract(atan2(seen.around.y, seen.around.x) / TAU);
    let kept = kept_of(seen.normal, seen.fibre, angle, seen.along, seen.yarn, is_front);
    return Kept(vec4(halves(kept.x), halves(kept.y)), vec4(halves(kept.z), halves(kept.w)));
}
