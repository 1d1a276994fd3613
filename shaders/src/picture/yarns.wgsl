// The yarns themselves: what is nearest in each sample, unlit. After view.wgsl and chunk.wgsl.

struct Seen {
    @builtin(position) position: vec4<f32>,
    @location(0) normal: vec3<f32>,
    // Along the facet, as its first corner has it: the fibres' direction, since a twisted yarn's corners turn with its
    // twist. A facet's own, so that it does not depend on where a chunk is cut.
    @location(1) @interpolate(flat) fibre: vec3<f32>,
    // Where on the yarn: cosine and sine round it, mm along it.
    @location(2) around: vec2<f32>,
    @location(3) along: f32,
    @location(4) @interpolate(flat) yarn: u32,
}

const TAU = 6.2831853;

// Three vertices and the run, for each triangle.
@group(0) @binding(3) var<storage, read> triangles: array<vec4<u32>>;

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
    seen.along = f32(inside / view.sides + run.first_ring) * run.ring_length;
    seen.yarn = select(run.yarn, run.yarn | CUT, is_cap);
    return seen;
}

struct Kept {
    // Normal and fibre direction, each as an octahedron.
    @location(0) directions: vec4<u32>,
    // The yarn's number, low and high; the angle round the yarn, 65,536 a turn; 1/32 mm along it.
    @location(1) place: vec4<u32>,
}

@fragment
fn yarn_sample(seen: Seen, @builtin(front_facing) is_front: bool) -> Kept {
    var normal = normalize(seen.normal);
    var yarn = seen.yarn;
    if !is_front {
        // The inside shows only where the yarn is cut: it is filled with fibre that ends there, and faces the eye.
        normal = normalize(view.eye.xyz);
        yarn |= CUT;
    }
    let across = seen.fibre - normal * dot(seen.fibre, normal);
    let is_level = dot(across, across) > 1e-12 * dot(seen.fibre, seen.fibre);
    let fibre = select(normal, normalize(across), is_level && (yarn & CUT) == 0u);
    let angle = fract(atan2(seen.around.y, seen.around.x) / TAU);
    var kept: Kept;
    kept.directions = vec4(octahedron(normal), octahedron(fibre));
    kept.place = vec4(yarn & 0xffffu, yarn >> 16u, u32(angle * 65535.0), u32(seen.along * 32.0) & 0xffffu);
    return kept;
}
