// Lights samples, and maps tones. This file follows view.wgsl, screen.wgsl and lit.wgsl, and the
// constant FAR. FAR is true if everything that could take light from a place lies within one and a
// half pixels of the place. The screen then does not show the loss of light.

// Rust: texere_render's YarnLook, 32 bytes.
struct YarnLook {
    // Linear light.
    color: vec3<f32>,
    // The width of the highlight on a fibre's surface, and of the highlight from within the fibre,
    // radians.
    surface_width: f32,
    volume_width: f32,
    // How much single fibres stand out.
    grain: f32,
    // The share of light from within that is scattered evenly.
    diffuse: f32,
    // The distance from ring to ring, mm.
    ring_length: f32,
}

@group(1) @binding(4) var visibilities: texture_2d<f32>;
@group(1) @binding(5) var<storage, read> looks: array<YarnLook>;
@group(1) @binding(6) var lit_samples: texture_storage_2d<rgba32uint, write>;

const PI = 3.14159265;

// The colours of the key light, of the fill light, of the light from above and of the light from
// the ground, and then the colour of the ground itself.
const KEY = vec3(1.78, 1.72, 1.64);
const FILL = vec3(0.5, 0.54, 0.6);
const SKY = vec3(0.46, 0.48, 0.52);
const FLOOR = vec3(0.24, 0.23, 0.21);
const GROUND_COLOR = vec3(0.62, 0.61, 0.59);

// The refractive index of a fibre.
const ETA = 1.46;

fn gaussian(width: f32, x: f32) -> f32 {
    return exp(-0.5 * x * x / (width * width)) / (width * sqrt(2.0 * PI));
}

// Schlick 1994, "An inexpensive BRDF model for physically-based rendering", equation 15.
fn fresnel(cosine: f32) -> f32 {
    let straight = (ETA - 1.0) * (ETA - 1.0) / ((ETA + 1.0) * (ETA + 1.0));
    return straight + (1.0 - straight) * pow(1.0 - cosine, 5.0);
}

// The light from `light` that a fibre along `fibre` sends to `eye`, times the cosine of the light's
// angle of incidence. It is the sum of the surface and volume terms of section 3 of Sadeghi,
// Bisker, De Deken and Jensen 2013, "A practical microcylinder appearance model for cloth
// rendering". The highlight along the fibre goes back to Kajiya and Kay 1989, and its two lobes to
// Marschner et al. 2003.
fn microcylinder(look: YarnLook, color: vec3<f32>, fibre: vec3<f32>, light: vec3<f32>, eye: vec3<f32>) -> vec3<f32> {
    let sine_in = clamp(dot(fibre, light), -1.0, 1.0);
    let sine_out = clamp(dot(fibre, eye), -1.0, 1.0);
    let cosine_in = sqrt(1.0 - sine_in * sine_in);
    let cosine_out = sqrt(1.0 - sine_out * sine_out);
    let half_angle = 0.5 * (asin(sine_in) + asin(sine_out));
    let difference = 0.5 * (asin(sine_out) - asin(sine_in));
    let light_across = light - fibre * sine_in;
    let eye_across = eye - fibre * sine_out;
    let azimuth = dot(light_across, eye_across) / max(cosine_in * cosine_out, 1e-4);
    let half_azimuth = sqrt(clamp(0.5 + 0.5 * azimuth, 0.0, 1.0));
    let reflected = fresnel(cos(difference) * half_azimuth);
    let surface = reflected * half_azimuth * gaussian(look.surface_width, half_angle);
    let through = (1.0 - look.diffuse) * gaussian(look.volume_width, half_angle) + look.diffuse;
    let volume = color * ((1.0 - reflected) * (1.0 - reflected) * through / (cosine_in + cosine_out + 0.1));
    return (vec3(surface) + volume) * (cosine_in / (cos(difference) * cos(difference)));
}

fn hash(cell: vec2<u32>) -> f32 {
    var x = cell.x * 1597334677u ^ cell.y * 3812015801u;
    x = (x ^ (x >> 16u)) * 2246822519u;
    x = (x ^ (x >> 13u)) * 3266489917u;
    return f32((x ^ (x >> 16u)) >> 8u) / 16777216.0;
}

// A factor for the light of a point on a yarn, which shows single fibres. It follows from the
// point's place round the yarn and along it.
fn grain(look: YarnLook, yarn: u32, angle: f32, along: f32, fade: f32) -> f32 {
    let fibres = 26.0;
    let round = angle * fibres;
    let row = u32(round);
    let length = along * 0.9 + hash(vec2(row, yarn)) * 64.0;
    let cell = u32(length);
    let bright = mix(hash(vec2(cell, row * 977u + yarn)), hash(vec2(cell + 1u, row * 977u + yarn)), fract(length));
    let ridge = 1.0 - 2.0 * abs(fract(round) - 0.5);
    return 1.0 + look.grain * fade * (0.7 * (bright - 0.5) + 0.6 * (ridge - 0.5));
}

// Light from all round that falls on a surface: the sky from above, and the ground's reflection
// from below.
fn surroundings(normal: vec3<f32>) -> vec3<f32> {
    return mix(FLOOR, SKY, 0.5 + 0.5 * dot(normal, view.ground.xyz));
}

// The direction to the fill light, across from the key light and a little higher.
fn fill_direction() -> vec3<f32> {
    let up = view.ground.xyz;
    return normalize(2.0 * dot(view.light, up) * up - view.light + 0.3 * up);
}

fn shade_yarn(here: Surface, pixel: vec2<i32>, sample: i32, seen: vec2<f32>) -> vec3<f32> {
    let packed_place = textureLoad(places, pixel, sample, 0);
    let number = packed_place.x;
    let place = halves(packed_place.y);
    let yarn = number & ~MARKS;
    let look = looks[yarn];
    let fibre = from_octahedron(halves(textureLoad(directions, pixel, sample, 0).y));
    let eye = to_eye(here.local);
    if (number & CUT) != 0u {
        // Fibres seen end on absorb the light that falls between them. A view without ground is a
        // cut. Nothing lies in front of the cut's plane, and the depth kept is that of the yarn's
        // far side, so a cut has no occlusion.
        let open = select(seen.x, 1.0, view.has_ground == 0u);
        return look.color * (0.55 + 0.25 * max(dot(here.normal, view.light), 0.0)) * (0.4 + 0.6 * open);
    }
    let fade = clamp(view.reach_pixels / 120.0 - 0.25, 0.0, 1.0);
    let is_hair = (number & HAIR) != 0u;
    let share = grain(look, yarn, f32(place.x) / 65536.0, f32(place.y) * (look.ring_length / 8.0), fade);
    let color = look.color * select(share, 1.0, is_hair);
    let fill = fill_direction();
    // The yarn's body shades its own far side, softly, since light passes its outer fibres. A fibre
    // that stands off the yarn is lit all round.
    let facing = select(clamp((dot(here.normal, view.light) + 0.15) / 1.15, 0.0, 1.0), 1.0, is_hair);
    let fill_facing = select(clamp((dot(here.normal, fill) + 0.4) / 1.4, 0.0, 1.0), 1.0, is_hair);
    var light = KEY * microcylinder(look, color, fibre, view.light, eye) * (facing * seen.y);
    light += FILL * microcylinder(look, color, fibre, fill, eye) * (fill_facing * seen.x);
    // Light that yarns send on to each other takes on their colour, so deep places are not grey
    // (Jimenez et al. 2016, "Practical real-time strategies for accurate indirect occlusion",
    // equation 10).
    let a = 2.0404 * color - 0.3324;
    let b = -4.7951 * color + 0.6417;
    let c = 2.7552 * color + 0.6903;
    let open = max(vec3(seen.x), ((seen.x * a + b) * seen.x + c) * seen.x);
    return light + color * surroundings(here.normal) * open;
}

fn shade_ground(normal: vec3<f32>, seen: vec2<f32>) -> vec3<f32> {
    let key = KEY * (max(dot(normal, view.light), 0.0) * seen.y / PI);
    return GROUND_COLOR * (key + surroundings(normal) * seen.x);
}

// Khronos PBR neutral tone mapper (2024): colours keep their hue and, below four fifths, lose at
// most 0.04.
fn tone_mapped(light: vec3<f32>) -> vec3<f32> {
    let start = 0.8 - 0.04;
    let least = min(light.r, min(light.g, light.b));
    let offset = select(0.04, least - 6.25 * least * least, least < 0.08);
    let color = light - offset;
    let peak = max(color.r, max(color.g, color.b));
    if peak < start {
        return color;
    }
    let room = 1.0 - start;
    let pressed = 1.0 - room * room / (peak + room - start);
    let pale = 1.0 - 1.0 / (0.15 * (peak - pressed) + 1.0);
    return mix(color * (pressed / peak), vec3(pressed), pale);
}

// The mean visibility on yarns: of the light from all round, and of the key light.
const AVERAGE = vec2(0.8, 0.85);

// Both visibilities: means over the four by four pixels round `pixel`. Pixels that lie far from the
// surface's plane hardly count.
fn visibility_of(here: Surface, pixel: vec2<i32>) -> vec2<f32> {
    if FAR {
        return select(vec2(1.0), AVERAGE, here.is_yarn);
    }
    let last = vec2<i32>(view.size) - 1;
    var sum = vec2(0.0);
    var weights = 0.0;
    for (var y = -2; y < 2; y++) {
        for (var x = -2; x < 2; x++) {
            let there = clamp(pixel + vec2(x, y), vec2(0), last);
            let depth = depth_at(there, 0);
            var weight = 1.0;
            if depth < 1.0 {
                let away = local_at(vec2<f32>(there) + 0.5, depth) - here.local;
                let off = dot(away, here.normal) / (0.1 * view.reach);
                weight = exp(-off * off);
            } else if here.is_yarn {
                weight = 0.0;
            }
            weight += 1e-4;
            sum += textureLoad(visibilities, there, 0).xy * weight;
            weights += weight;
        }
    }
    return sum / weights;
}

// Colour and alpha of a sample.
fn sample_color(pixel: vec2<i32>, sample: i32) -> vec4<f32> {
    let here = surface_at(pixel, sample);
    if !here.is_yarn && view.background_kind != GROUND {
        return vec4(view.background, f32(view.background_kind == COLOR));
    }
    let seen = visibility_of(here, pixel);
    if here.is_yarn {
        return vec4(tone_mapped(shade_yarn(here, pixel, sample, seen)), 1.0);
    }
    return vec4(tone_mapped(shade_ground(here.normal, seen)), 1.0);
}

// The number of the yarn that a sample shows, or NO_YARN.
const NO_YARN = 0xffffffffu;

fn yarn_at(pixel: vec2<i32>, sample: i32) -> u32 {
    return select(textureLoad(places, pixel, sample, 0).x, NO_YARN, depth_at(pixel, sample) >= 1.0);
}

// Lights the screen, with one lane for each pixel. A lane lights the pixel's four samples. If they
// all show one yarn, or none, and threads are at least four pixels wide, it lights one for all
// four.
@compute @workgroup_size(SCREEN_GROUP, SCREEN_GROUP)
fn shade(@builtin(global_invocation_id) place: vec3<u32>) {
    let pixel = vec2<i32>(place.xy);
    if any(pixel >= vec2<i32>(view.size)) {
        return;
    }
    let first = yarn_at(pixel, 0);
    let alike = view.spread == 0.0 && yarn_at(pixel, 1) == first && yarn_at(pixel, 2) == first && yarn_at(pixel, 3) == first;
    var packed = vec4(lit_of(sample_color(pixel, 0)));
    if !alike {
        for (var sample = 1; sample < SAMPLES; sample++) {
            packed[sample] = lit_of(sample_color(pixel, sample));
        }
    }
    textureStore(lit_samples, place.xy, packed);
}
