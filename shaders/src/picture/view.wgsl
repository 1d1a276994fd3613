// The code that all picture shaders share: the view, the places of samples, and encodings.

// Rust: texere_render's ViewUniform, 256 bytes. All positions are relative to the camera's target,
// because at ten kilometres from the origin f32 can't resolve a tenth of a millimetre.
struct View {
    clip_from_local: mat4x4<f32>,
    local_from_clip: mat4x4<f32>,
    // The camera's target in the fabric's coordinates.
    target_point: vec3<f32>,
    // The reach of ambient occlusion, mm.
    reach: f32,
    // The eye's position, or with w = 0 the direction to the eye.
    eye: vec4<f32>,
    // The direction to the key light, and how far its shadows fall, mm.
    light: vec3<f32>,
    shadow: f32,
    // The ground: the plane of all points p with n . p = w, where n is x, y and z of this vector.
    ground: vec4<f32>,
    // Size of the screen, the picture before it is scaled down, pixels.
    size: vec2<f32>,
    // Pixels of the screen for each pixel of the picture, each way.
    supersampling: u32,
    // The length of `reach` at the target, pixels.
    reach_pixels: f32,
    // The thickness that is assumed of everything that casts a shadow, mm.
    thickness: f32,
    // 1 if there is a ground, else 0.
    has_ground: u32,
    // 1 if yarns may be seen from inside, else 0.
    sees_inside: u32,
    // The background: its kind, and its colour in linear light.
    background_kind: u32,
    background: vec3<f32>,
    // How far pixels of the picture reach for their samples: 0 if only for the samples in them, 1
    // if one pixel further each way.
    spread: f32,
    // 1 if fibres that stand off yarns are drawn, else 0.
    has_hairs: u32,
}

// Kinds of background. In Rust they are texere_render's Background. A third kind, 2, is nothing.
const GROUND = 0u;
const COLOR = 1u;

@group(1) @binding(0) var<uniform> view: View;

// The side of the squares of pixels that a workgroup works on, pixels.
const SCREEN_GROUP = 8u;

// The number of samples of a pixel of the screen. In Rust it is texere_render's SAMPLES.
const SAMPLES = 4;

// The place of the sample in each of a pixel's four rows: the pattern that WebGPU prescribes for
// four samples, in 1/256 pixels. The lowest byte belongs to the first row: 96, 224, 32, 160.
const SAMPLE_X = 0xa020e060u;
const SAMPLE_ROW = 64;
const FIRST_SAMPLE_Y = 32;

// The cyclic shifts of the pattern in this pixel, in units of 1/256 pixel: x to the right within
// the pixel, y down within each row of samples. Threads finer than pixels would beat with a pattern
// that is the same everywhere. For fine threads each pixel therefore has its own shifts, a hash of
// its place, and detail finer than samples comes out as fine grain (Cook 1986, "Stochastic sampling
// in computer graphics").
fn shift_of(pixel: vec2<i32>) -> vec2<i32> {
    if view.spread == 0.0 {
        return vec2(0);
    }
    let mixed = (bitcast<u32>(pixel.x) * 1597334677u) ^ (bitcast<u32>(pixel.y) * 3812015801u);
    let hash = (mixed ^ (mixed >> 16u)) * 2246822519u;
    return vec2<i32>(vec2(hash >> 24u, (hash >> 18u) & 63u));
}

// The place of sample `sample` in a pixel without a shift, in units of 1/256 pixel right of the
// pixel's left edge.
fn sample_x(sample: i32) -> i32 {
    return i32((SAMPLE_X >> (8u * u32(sample))) & 255u);
}

// A sample's place in its pixel, in units of 1/256 pixel right of the pixel's upper left corner and
// below it.
fn sample_in(pixel: vec2<i32>, sample: i32) -> vec2<i32> {
    let place = vec2(sample_x(sample), FIRST_SAMPLE_Y) + shift_of(pixel);
    return vec2(0, sample * SAMPLE_ROW) + (place & vec2(255, SAMPLE_ROW - 1));
}

// A point of the fabric in clip space.
fn clip_of(position: vec3<f32>) -> vec4<f32> {
    return view.clip_from_local * vec4(position - view.target_point, 1.0);
}

// The bit of a yarn's number that marks the inside of the yarn, which is seen where the yarn ends
// or is cut.
const CUT = 0x80000000u;

// The bit of a yarn's number that marks a fibre that stands off the yarn.
const HAIR = 0x40000000u;

// The bits of a yarn's number that are marks.
const MARKS = CUT | HAIR;

// A unit vector as two numbers of 16 bits (Meyer et al. 2010, "On floating-point normal vectors":
// the octahedron).
fn octahedron(v: vec3<f32>) -> vec2<u32> {
    let folded = v.xy / (abs(v.x) + abs(v.y) + abs(v.z));
    let turned = (1.0 - abs(folded.yx)) * select(vec2(-1.0), vec2(1.0), folded >= vec2(0.0));
    let flat_vector = select(turned, folded, v.z >= 0.0);
    return vec2<u32>(round((flat_vector * 0.5 + 0.5) * 65535.0));
}

fn from_octahedron(packed: vec2<u32>) -> vec3<f32> {
    let flat_vector = vec2<f32>(packed) / 65535.0 * 2.0 - 1.0;
    let z = 1.0 - abs(flat_vector.x) - abs(flat_vector.y);
    let turned = (1.0 - abs(flat_vector.yx)) * select(vec2(-1.0), vec2(1.0), flat_vector >= vec2(0.0));
    return normalize(vec3(select(turned, flat_vector, z >= 0.0), z));
}
