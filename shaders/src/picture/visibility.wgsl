// Ambient occlusion and the key light's shadow at each pixel, both found on the screen. This file
// follows view.wgsl and screen.wgsl.

@group(1) @binding(4) var seen: texture_storage_2d<rgba8unorm, write>;

const OCCLUSION_TAPS = 14u;
const SHADOW_STEPS = 18u;

// The radius of the key light as seen from the cloth, radians: that of a soft box.
const LIGHT_RADIUS = 0.13;

// The number of turns of the spiral on which the taps lie. It has no common factor with the number
// of taps.
const SPIRAL_TURNS = 9.0;

// The depth of a yarn's body in a pixel; 1 if there is none. Single fibres don't count, because
// they are far thinner than the thickness that is assumed of what blocks light.
fn body_depth_at(pixel: vec2<i32>) -> f32 {
    let is_hair = view.has_hairs != 0u && (textureLoad(places, pixel, 0, 0).x & HAIR) != 0u;
    return select(depth_at(pixel, 0), 1.0, is_hair);
}

// Ambient visibility: McGuire, Mara and Luebke 2012, "Scalable ambient obscurance", the estimator
// of its equation 10 with the falloff of Alchemy (McGuire et al. 2011).
fn ambient(here: Surface, pixel: vec2<i32>, turn: f32) -> f32 {
    let last = vec2<i32>(view.size) - 1;
    let reach_squared = view.reach * view.reach;
    var sum = 0.0;
    for (var tap = 0u; tap < OCCLUSION_TAPS; tap++) {
        let share = (f32(tap) + 0.5) / f32(OCCLUSION_TAPS);
        let angle = (share * SPIRAL_TURNS + turn) * 6.2831853;
        let offset = vec2(cos(angle), sin(angle)) * share * view.reach_pixels;
        let there = clamp(pixel + vec2<i32>(round(offset)), vec2(0), last);
        let depth = body_depth_at(there);
        if depth >= 1.0 {
            continue;
        }
        let away = local_at(vec2<f32>(there) + 0.5, depth) - here.local;
        let squared = dot(away, away);
        let rise = dot(away, here.normal) - 0.02 * view.reach;
        let fade = max(reach_squared - squared, 0.0) / reach_squared;
        sum += fade * fade * max(rise, 0.0) * inverseSqrt(squared + 1e-4 * reach_squared);
    }
    return max(1.0 - 2.6 * sum / f32(OCCLUSION_TAPS), 0.0);
}

// Whether the key light is visible: 1 if it is, 0 if not. Steps go towards one of its sixteen
// points until something on the screen is in the way.
fn lit(here: Surface, phase: f32) -> f32 {
    // The points lie as seeds in a sunflower (Vogel 1979).
    let side = normalize(cross(view.light, vec3(0.31, 0.23, 0.92)));
    let spot = LIGHT_RADIUS * sqrt((phase + 0.5) / 16.0);
    let angle = phase * 2.39996323;
    let light = normalize(view.light + spot * (cos(angle) * side + sin(angle) * cross(view.light, side)));
    let start = here.local + here.normal * (0.03 * view.thickness);
    let last = vec2<i32>(view.size) - 1;
    for (var step = 0u; step < SHADOW_STEPS; step++) {
        let share = (f32(step) + 0.5 + fract(phase * 0.4375)) / f32(SHADOW_STEPS);
        // Steps are shorter near the start, where thin things cast the shadow.
        let local = start + light * (view.shadow * share * sqrt(share));
        let clip = view.clip_from_local * vec4(local, 1.0);
        let ndc = clip.xyz / clip.w;
        let pixel = vec2<i32>((ndc.xy * vec2(0.5, -0.5) + 0.5) * view.size);
        if any(pixel < vec2(0)) || any(pixel > last) {
            break;
        }
        let depth = body_depth_at(pixel);
        if depth < min(ndc.z, 1.0) {
            let before = dot(local_at(vec2<f32>(pixel) + 0.5, depth) - local, to_eye(local));
            if before > 0.02 * view.thickness && before < view.thickness {
                return 0.0;
            }
        }
    }
    return 1.0;
}

// Writes the visibilities, with one lane for each pixel.
@compute @workgroup_size(SCREEN_GROUP, SCREEN_GROUP)
fn visibility(@builtin(global_invocation_id) place: vec3<u32>) {
    let pixel = vec2<i32>(place.xy);
    if any(pixel >= vec2<i32>(view.size)) {
        return;
    }
    textureStore(seen, pixel, vec4(visibility_at(pixel), 0.0, 1.0));
}

fn visibility_at(pixel: vec2<i32>) -> vec2<f32> {
    let here = surface_at(pixel, 0);
    if !here.is_yarn && !here.is_ground {
        return vec2(1.0);
    }
    let phase = f32(phase(vec2<u32>(pixel)));
    return vec2(ambient(here, pixel, phase / 16.0), lit(here, phase));
}
