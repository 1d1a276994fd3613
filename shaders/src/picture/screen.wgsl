// Reads back what each sample of the screen shows. This file follows view.wgsl.

// The textures have a layer for each sample of a pixel. They hold its depth, which is 1 if there is
// no yarn; its normal and the direction of fibres; and the yarn's number with the place on the
// yarn. kept.wgsl encodes all but the depth.
@group(1) @binding(1) var depths: texture_2d_array<f32>;
@group(1) @binding(2) var directions: texture_2d_array<u32>;
@group(1) @binding(3) var places: texture_2d_array<u32>;

fn depth_at(pixel: vec2<i32>, sample: i32) -> f32 {
    return textureLoad(depths, pixel, sample, 0).x;
}

fn halves(both: u32) -> vec2<u32> {
    return vec2(both & 0xffffu, both >> 16u);
}

fn local_at(pixel: vec2<f32>, depth: f32) -> vec3<f32> {
    let across = pixel / view.size * vec2(2.0, -2.0) + vec2(-1.0, 1.0);
    let local = view.local_from_clip * vec4(across, depth, 1.0);
    return local.xyz / local.w;
}

// The direction from `local` towards the eye.
fn to_eye(local: vec3<f32>) -> vec3<f32> {
    return normalize(view.eye.xyz - local * view.eye.w);
}

// What a sample shows: a yarn, the ground, or neither.
struct Surface {
    local: vec3<f32>,
    normal: vec3<f32>,
    is_yarn: bool,
    is_ground: bool,
}

// The ground where the line of sight through `pixel` meets it.
fn ground_at(pixel: vec2<f32>) -> Surface {
    let near = local_at(pixel, 0.0);
    let sight = -to_eye(near);
    let fall = dot(view.ground.xyz, sight);
    let way = (view.ground.w - dot(view.ground.xyz, near)) / fall;
    let meets = view.has_ground != 0u && fall < -1e-4;
    return Surface(near + sight * select(0.0, way, meets), view.ground.xyz, false, meets);
}

// What one sample of a pixel shows.
fn surface_at(pixel: vec2<i32>, sample: i32) -> Surface {
    let middle = vec2<f32>(pixel) + 0.5;
    let depth = depth_at(pixel, sample);
    if depth >= 1.0 {
        return ground_at(middle);
    }
    let normal = from_octahedron(halves(textureLoad(directions, pixel, sample, 0).x));
    return Surface(local_at(middle, depth), normal, true, false);
}

// A number from 0 to 15 that differs for all pixels of any square of four by four (Bayer 1973). A
// mean over any such square therefore covers all sixteen numbers.
fn phase(pixel: vec2<u32>) -> u32 {
    let mixed = pixel.x ^ pixel.y;
    return (mixed & 1u) << 3u | (pixel.y & 1u) << 2u | (mixed & 2u) | (pixel.y & 2u) >> 1u;
}
