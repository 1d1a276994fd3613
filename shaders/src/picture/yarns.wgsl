// The yarns themselves: what is nearest in each sample, unlit. After view.wgsl, chunk.wgsl and kept.wgsl.

struct Seen {
    @builtin(position) position: vec4<f32>,
    @location(0) normal: vec3<f32>,
    // Along the facet, as its first corner has it: the fibres' direction, since a twisted yarn's corners turn with its
    // twist. A facet's own, so that it does not depend on where a chunk is cut.
    @location(1) @interpolate(flat) fibre: vec3<f32>,
    // Where on the yarn: cosine and sine round it, rings along it.
    @location(2) around: vec2<f32>,
    @location(3) along: f32,
    @location(4) @interpolate(flat) yarn: u32,
}

// Three vertices and the run, for each triangle.
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
    let angle = f32(inside % view.sides) * (TAU / f32(view.sides));
    var seen: Seen;
    seen.position = clip_of(position);
    seen.normal = normal;
    // To the next ring. Past a run's last ring there is another run or nothing, but no facet's first corner lies there.
    seen.fibre = normal;
    if !is_cap && inside < run.gaps * view.sides {
        seen.fibre = position_of(number + view.sides) - position;
    }
    seen.around = vec2(cos(angle), sin(angle));
    seen.along = f32(inside / view.sides + run.first_ring);
    seen.yarn = select(run.yarn, run.yarn | CUT, is_cap);
    return seen;
}

@fragment
fn yarn_sample(seen: Seen, @builtin(front_facing) is_front: bool) -> Kept {
    let angle = fract(atan2(seen.around.y, seen.around.x) / TAU);
    return kept_of(seen.normal, seen.fibre, angle, seen.along, seen.yarn, is_front);
}
