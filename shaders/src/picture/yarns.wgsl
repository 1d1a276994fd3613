// The yarns themselves: what is nearest in each sample, unlit. After view.wgsl.

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

// `next` is the position one ring on; past a part's last ring it is of another part, or nothing, but no facet's first
// corner lies there. `yarn`, `first_ring`, `is_cap` and `ring_length` (mm) come with the draw.
@vertex
fn yarn_corner(
    @builtin(vertex_index) number: u32,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) next: vec3<f32>,
    @location(3) yarn: u32,
    @location(4) first_ring: u32,
    @location(5) is_cap: u32,
    @location(6) ring_length: f32,
) -> Seen {
    let angle = f32(number % view.sides) * (TAU / f32(view.sides));
    var seen: Seen;
    seen.position = view.clip_from_local * vec4(position - view.target_point, 1.0);
    seen.normal = normal;
    seen.fibre = select(next - position, normal, is_cap != 0u);
    seen.around = vec2(cos(angle), sin(angle));
    seen.along = f32(number / view.sides + first_ring) * ring_length;
    seen.yarn = select(yarn, yarn | CUT, is_cap != 0u);
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
