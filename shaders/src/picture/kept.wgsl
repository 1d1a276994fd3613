// What is kept of a sample until it is lit. After view.wgsl.

const TAU = 6.2831853;

struct Kept {
    // Normal and fibre direction, each as an octahedron.
    @location(0) directions: vec4<u32>,
    // The yarn's number, low and high; the angle round the yarn, 65,536 a turn; 1/8 rings along it.
    @location(1) place: vec4<u32>,
}

// `fibre` is the direction along the facet, `angle` the one round the yarn in turns, `along` in rings, `yarn` the yarn's number,
// marked CUT on a cap.
fn kept_of(normal: vec3<f32>, fibre: vec3<f32>, angle: f32, along: f32, yarn: u32, is_front: bool) -> Kept {
    var facing = normalize(normal);
    var number = yarn;
    if !is_front {
        // The inside shows only where the yarn is cut: it is filled with fibre that ends there, and faces the eye.
        facing = normalize(view.eye.xyz);
        number |= CUT;
    }
    let across = fibre - facing * dot(fibre, facing);
    let is_level = dot(across, across) > 1e-12 * dot(fibre, fibre);
    let direction = select(facing, normalize(across), is_level && (number & CUT) == 0u);
    var kept: Kept;
    kept.directions = vec4(octahedron(facing), octahedron(direction));
    kept.place = vec4(number & 0xffffu, number >> 16u, u32(angle * 65535.0), u32(along * 8.0) & 0xffffu);
    return kept;
}

// The same in four numbers.
fn packed(kept: Kept) -> vec4<u32> {
    let directions = kept.directions;
    let place = kept.place;
    return vec4(directions.x | directions.y << 16u, directions.z | directions.w << 16u, place.x | place.y << 16u,
                place.z | place.w << 16u);
}
