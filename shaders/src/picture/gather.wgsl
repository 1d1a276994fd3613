// The pixels of the picture, from the samples in and about each. This file follows view.wgsl and
// lit.wgsl.
//
// If threads are finer than pixels, the plain mean of the samples in a pixel shows false waves.
// Threads of two thirds of a pixel come out as waves of two pixels, a fifth as strong as the
// threads. More samples don't help, because the mean itself makes the waves. For fine threads each
// pixel is therefore a mean that falls off over three pixels, the quadratic B-spline (Unser 1999,
// "Splines: a perfect fit for signal and image processing"). It leaves a tenth of the waves.

@group(1) @binding(1) var lit_samples: texture_2d<u32>;
// Red, green, blue and alpha, sRGB.
@group(1) @binding(2) var picture: texture_storage_2d<rgba8unorm, write>;

// The places of the samples of a pixel of the screen, in pixels right of its corner or below it.
struct Places {
    right: vec4<f32>,
    down: vec4<f32>,
}

fn places_of(pixel: vec2<i32>) -> Places {
    let samples = array(sample_in(pixel, 0), sample_in(pixel, 1), sample_in(pixel, 2), sample_in(pixel, 3));
    let right = vec4(samples[0].x, samples[1].x, samples[2].x, samples[3].x);
    let down = vec4(samples[0].y, samples[1].y, samples[2].y, samples[3].y);
    return Places(vec4<f32>(right) / 256.0, vec4<f32>(down) / 256.0);
}

// The weights of the plain mean: 1 within half a pixel.
fn near(off: vec4<f32>) -> vec4<f32> {
    return select(vec4(0.0), vec4(1.0), abs(off) < vec4(0.5));
}

// The weights of the quadratic B-spline.
fn wide(off: vec4<f32>) -> vec4<f32> {
    let away = abs(off);
    let rest = max(1.5 - away, vec4(0.0));
    return select(0.5 * rest * rest, 0.75 - away * away, away < vec4(0.5));
}

fn srgb(light: vec3<f32>) -> vec3<f32> {
    let curved = 1.055 * pow(max(light, vec3(1e-9)), vec3(1.0 / 2.4)) - 0.055;
    return select(curved, light * 12.92, light <= vec3(0.0031308));
}

// Works out the picture, with one lane for each of its pixels.
@compute @workgroup_size(SCREEN_GROUP, SCREEN_GROUP)
fn gather(@builtin(global_invocation_id) place: vec3<u32>) {
    let factor = i32(view.supersampling);
    let last = vec2<i32>(view.size) - 1;
    let corner = vec2<i32>(place.xy) * factor;
    if any(corner > last) {
        return;
    }
    // One pixel of the picture more each way, if the wide mean counts at all.
    let margin = select(0, factor, view.spread > 0.0);
    let low = max(corner - margin, vec2(0));
    let high = min(corner + factor + margin - 1, last);
    var sum = vec4(0.0);
    var weights = 0.0;
    for (var y = low.y; y <= high.y; y++) {
        for (var x = low.x; x <= high.x; x++) {
            let places = places_of(vec2(x, y));
            let right = (f32(x - corner.x) + places.right) / f32(factor) - 0.5;
            let down = (f32(y - corner.y) + places.down) / f32(factor) - 0.5;
            let weight = mix(near(right) * near(down), wide(right) * wide(down), view.spread);
            let lit = textureLoad(lit_samples, vec2(x, y), 0);
            for (var sample = 0; sample < SAMPLES; sample++) {
                // A sample without alpha has no colour either, so it takes no part in the colour of
                // the pixel.
                let color = color_of(lit[sample]);
                sum += weight[sample] * color.a * vec4(color.rgb, 1.0);
            }
            weights += dot(weight, vec4(1.0));
        }
    }
    let color = clamp(sum.rgb / max(sum.a, 1e-6), vec3(0.0), vec3(1.0));
    textureStore(picture, place.xy, vec4(srgb(color), sum.a / weights));
}
