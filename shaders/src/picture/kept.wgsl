// The encoding of a sample until it is lit. This file follows view.wgsl.

const TAU = 6.2831853;

// Two numbers of 16 bits in one of 32 bits.
fn pair_of(both: vec2<u32>) -> u32 {
    return both.x | both.y << 16u;
}

// Four numbers: the normal and the direction of fibres, each as an octahedron; the yarn's number;
// and the place on the yarn. The place is the angle round the yarn, 65,535 to a turn, and the
// distance along the yarn, in eighths of rings, of which the lowest 16 bits are kept.
//
// `fibre` is the direction along the facet, `angle` the angle round the yarn in turns, and `along`
// the distance along it in rings. `yarn` is the yarn's number, marked CUT on a cap and HAIR on a
// fibre that stands off.
fn kept_of(normal: vec3<f32>, fibre: vec3<f32>, angle: f32, along: f32, yarn: u32, is_front: bool) -> vec4<u32> {
    var facing = normalize(normal);
    var number = yarn;
    if !is_front {
        // The inside shows only where the yarn is cut. It is drawn as if filled with fibres that
        // end there, and it faces the eye.
        facing = normalize(view.eye.xyz);
        number |= CUT;
    }
    let across = fibre - facing * dot(fibre, facing);
    let is_level = dot(across, across) > 1e-12 * dot(fibre, fibre);
    let direction = select(facing, normalize(across), is_level && (number & CUT) == 0u);
    let place = vec2(u32(angle * 65535.0), u32(along * 8.0) & 0xffffu);
    return vec4(pair_of(octahedron(facing)), pair_of(octahedron(direction)), number, pair_of(place));
}
