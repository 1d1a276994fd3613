// The code that the shaders of settling share: tables, places, intervals and chords. It stands
// before each of them but the scan.
//
// The formulas, the thresholds and the order of operations are those of texere-core (settling/),
// and settling.cl is the twin of this file. This file is core WGSL, and requires no feature.
// texere-gpu writes two things before this file: the core's constants, and FLATTENED, which is true
// if the code for yarns that are not round is needed.

// Rust: texere_gpu::PlaceRow, 16 bytes.
struct PlaceRow {
    tags: u32,
    yarn: u32,
    first_chord: u32,
    start_length: f32,
}

// Rust: texere_gpu::StrandRow, 32 bytes.
struct StrandRow {
    first: u32,
    points: u32,
    goes_on: u32,
    shift_x: i32,
    shift_y: i32,
    length: u32,
    padding: vec2<u32>,
}

// Rust: texere_gpu::SettlingParams, 96 bytes.
struct SettlingParams {
    places: u32,
    chords: u32,
    yarns: u32,
    flags: u32,
    unit: f32,
    per_mm: f32,
    s: f32,
    growth: f32,
    ease: f32,
    momentum: f32,
    half_gap: f32,
    tension: f32,
    period_x: i32,
    period_y: i32,
    frequency_x: f32,
    frequency_y: f32,
    diameter: f32,
    along: f32,
    low_x: i32,
    low_y: i32,
    size_x: u32,
    size_y: u32,
    count_x: u32,
    count_y: u32,
}

// Rust: texere_gpu::ExtentRow, 32 bytes.
struct ExtentRow {
    low_x: i32,
    low_y: i32,
    high_x: i32,
    high_y: i32,
    longest: f32,
    padding: array<u32, 3>,
}

// Rust: texere_gpu::SeenRow, 16 bytes.
struct SeenRow {
    clearance: f32,
    radius: f32,
    length: f32,
    step: f32,
}

// A place (Rust: Place) is a vec4<i32>: x, y and z, units, and two half floats, half width and half
// height. A row of the chord table (Rust: texere_gpu::ChordRow) is a vec4<u32>: the place of its
// interval, where along the yarn it begins and ends, and the bits of the largest half width or half
// height of its interval. A chord, in the form that passes read, is two vec4<u32>. The first has
// the point where the chord begins and the place of its interval, the second the bits of the
// chord's span, mm, and of the largest half width or half height of the interval.

@group(0) @binding(12) var<uniform> settling: SettlingParams;
@group(0) @binding(13) var<storage, read> place_rows: array<PlaceRow>;

fn dot3(a: vec3<f32>, b: vec3<f32>) -> f32 {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

fn length3(a: vec3<f32>) -> f32 {
    return sqrt(dot3(a, a));
}

// `value`, limited to the range from 0 to 1.
fn share(value: f32) -> f32 {
    return min(max(value, 0.0), 1.0);
}

// The way `units`, converted to mm.
fn to_mm(units: vec3<i32>) -> vec3<f32> {
    return vec3<f32>(units) * settling.unit;
}

// The step `step`, mm, in whole units.
fn to_units(step: vec3<f32>) -> vec3<i32> {
    return vec3<i32>(floor(step * settling.per_mm + 0.5));
}

// Half width (x) and half height (y) at a place.
fn halves(place: vec4<i32>) -> vec2<f32> {
    return unpack2x16float(bitcast<u32>(place.w));
}

// ---- Interval: the spline between two places, from the first of them on ----

struct Interval {
    start: vec3<i32>,
    // Coefficients of u, u^2 and u^3, mm.
    c1: vec3<f32>,
    c2: vec3<f32>,
    c3: vec3<f32>,
    // Half width and half height at the interval's beginning, and the growth of both to its end.
    halves: vec2<f32>,
    growth: vec2<f32>,
}

// The interval that begins at the second of four places.
fn interval_of(before: vec4<i32>, here: vec4<i32>, next: vec4<i32>, behind: vec4<i32>) -> Interval {
    let a = to_mm(before.xyz - here.xyz);
    let b = to_mm(next.xyz - here.xyz);
    let c = to_mm(behind.xyz - here.xyz);
    let s = settling.s;
    var interval: Interval;
    interval.start = here.xyz;
    interval.c1 = (b - a) * s;
    interval.c2 = a * (2.0 * s) + b * (3.0 - 2.0 * s) - c * s;
    interval.c3 = (c - a) * s + b * (s - 2.0);
    interval.halves = halves(here);
    interval.growth = halves(next) - interval.halves;
    return interval;
}

fn interval_offset(interval: Interval, u: f32) -> vec3<f32> {
    return (interval.c1 + (interval.c2 + interval.c3 * u) * u) * u;
}

fn interval_velocity(interval: Interval, u: f32) -> vec3<f32> {
    return interval.c1 + (interval.c2 * 2.0 + interval.c3 * (3.0 * u)) * u;
}

fn interval_acceleration(interval: Interval, u: f32) -> vec3<f32> {
    return interval.c2 * 2.0 + interval.c3 * (6.0 * u);
}

// How far the yarn reaches from its centreline at `u` towards a unit vector, mm.
fn interval_reach(interval: Interval, u: f32, towards: vec3<f32>) -> f32 {
    let width = interval.halves.x + interval.growth.x * u;
    if !FLATTENED {
        return width;
    }
    let height = interval.halves.y + interval.growth.y * u;
    let tangent = interval_velocity(interval, u);
    let level = tangent.x * tangent.x + tangent.y * tangent.y;
    let square = level + tangent.z * tangent.z;
    if width == height || level <= VERTICAL * square {
        return width;
    }
    // Side is (-y, x, 0), and up is tangent x side, both divided by their lengths.
    let aside = (towards.y * tangent.x - towards.x * tangent.y) * width;
    let up = (towards.z * level - (towards.x * tangent.x + towards.y * tangent.y) * tangent.z) * height;
    return sqrt((aside * aside + up * up / square) / level);
}

// The length of an interval by Gauss's rule of three nodes, mm.
fn interval_arc(interval: Interval) -> f32 {
    let outer = length3(interval_velocity(interval, GAUSS_1)) + length3(interval_velocity(interval, GAUSS_3));
    return outer * GAUSS_OUTER + length3(interval_velocity(interval, GAUSS_2)) * GAUSS_MIDDLE;
}

// ---- Chord ----

struct Chord {
    at: vec3<i32>,
    place: u32,
    span: vec3<f32>,
    thickest: f32,
}

fn chord_of(first: vec4<u32>, second: vec4<u32>) -> Chord {
    return Chord(bitcast<vec3<i32>>(first.xyz), first.w, bitcast<vec3<f32>>(second.xyz), bitcast<f32>(second.w));
}

// The middle of a chord, units.
fn chord_middle(chord: Chord) -> vec3<i32> {
    return chord.at + to_units(chord.span * 0.5);
}

// The number of repeats to the image of chord `other` that is nearest to chord `one`. Chord `other`
// begins `way` from the beginning of chord `one`.
fn nearest_image(one: vec3<f32>, other: vec3<f32>, way: vec3<i32>) -> vec2<i32> {
    let apart = to_mm(way) + (other - one) * 0.5;
    let frequency = vec2(settling.frequency_x, settling.frequency_y);
    return -vec2<i32>(floor(apart.xy * frequency + 0.5));
}

// The way to an image: `way`, moved by `image` repeats.
fn to_image(way: vec3<i32>, image: vec2<i32>) -> vec3<i32> {
    return vec3(way.x + image.x * settling.period_x, way.y + image.y * settling.period_y, way.z);
}

// The places where two chords come nearest to one another, as shares of the chords. The second
// chord begins `way` from the beginning of the first.
fn chords_nearest(one: vec3<f32>, other: vec3<f32>, way: vec3<f32>) -> vec2<f32> {
    let a = max(dot3(one, one), SHORT);
    let e = max(dot3(other, other), SHORT);
    let b = dot3(one, other);
    let c = -dot3(one, way);
    let f = -dot3(other, way);
    let determinant = a * e - b * b;
    // On parallel chords no place of the first is better than another, so its middle is taken.
    var first = 0.5;
    if determinant > PARALLEL * (a * e) {
        first = share((b * f - c * e) / determinant);
    }
    let second = share((b * first + f) / e);
    return vec2(share((b * second - c) / a), second);
}
