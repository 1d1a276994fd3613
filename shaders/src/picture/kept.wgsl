// The encoding of a sample until it is lit. After view.wgsl.

const TAU = 6.2831853;

// A vector of 16-bit numbers in one of 32.
fn pair_of(both: vec2<u32>) -> u32 {
    return both.x | both.y << 16u;
}

// Four numbers: normal and fibre direction, each as an octahedron; the yarn's number; the angle
// round the yarn, 65,536 a turn, and 1/8 rings along it.
//
// `fibre` is the direction along the facet, `angle` the one round the yarn in turns, `along` in
// rings, `yarn` the yarn's number, marked CUT on a cap.
fn kept_of(normal: vec3<f32>, fibre: vec3<f32>, angle: f32, along: f32, yarn: u32, is_front: bool) -> vec4<u32> {
    var facing = normalize(normal);
    var number = yarn;
    if !is_front {
        // The inside shows only where the yarn is cut: it is filled with fibre that ends there, and
        // faces the eye.
        facing = normalize(view.eye.xyz);
        number |= CUT;
    }
    let across = fibre - facing * dot(fibre, facing);
    let is_level = dot(across, across) > 1e-12 * dot(fibre, fibre);
    let direction = select(facing, normalize(across), is_level && (number & CUT) == 0u);
    let place = vec2(u32(angle * 65535.0), u32(along * 8.0) & 0xffffu);
    return vec4(pair_of(octahedron(facing)), pair_of(octahedron(direction)), number, pair_of(place));
}
