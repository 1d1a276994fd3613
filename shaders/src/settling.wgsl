// Settling: the tables, and what intervals and chords are. Stands before each of the other settling shaders.
//
// The formulas, the thresholds and the order of operations are those of texere-core's settling (place.rs, interval.rs,
// strand.rs), and settling.cl is the twin of this file. Constants are the core's; texere-gpu writes them before this file, and
// FLATTENED: false where all yarns are round, as wide as high everywhere.

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

// A place (Rust: Place) is a vec4<i32>: x, y and z, units, and two half floats, half width and half height.
// A row of chords (Rust: texere_gpu::ChordRow) is a vec4<u32>: the place of its interval, where along the yarn it begins and
// ends, and the bits of the interval's thickest half.
// A chord is two vec4<u32>: the bits of where it begins, and the place of its interval; the bits of its span and of the thickest
// half, mm.

@group(0) @binding(12) var<uniform> settling: SettlingParams;
@group(0) @binding(13) var<storage, read> place_rows: array<PlaceRow>;

// The inner product, summed from x on. That of WGSL may be summed in another order, and chords that are all but parallel amplify
// what that changes.
fn inner(a: vec3<f32>, b: vec3<f32>) -> f32 {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

// ---- Places ----

// A way of so many units, mm.
fn length_of(way: vec3<i32>) -> vec3<f32> {
    return vec3<f32>(way) * settling.unit;
}

// The step that a place takes for `step` mm, units.
fn units_of(step: vec3<f32>) -> vec3<i32> {
    return vec3<i32>(floor(step * settling.per_mm + 0.5));
}

// Half width and half height of a place.
fn halves_of(place: vec4<i32>) -> vec2<f32> {
    return unpack2x16float(bitcast<u32>(place.w));
}

// Within 0 and 1.
fn share(value: f32) -> f32 {
    return min(max(value, 0.0), 1.0);
}

// ---- Interval: the spline between two places, from the first of them on ----

struct Interval {
    // Where it begins, units.
    start: vec3<i32>,
    // What goes with u, u^2 and u^3, mm.
    c1: vec3<f32>,
    c2: vec3<f32>,
    c3: vec3<f32>,
    // Half width and half height at its beginning, and their growth to its end, mm.
    halves: vec2<f32>,
    growth: vec2<f32>,
}

// The interval between the second and the third of four places.
fn interval_new(before: vec4<i32>, start: vec4<i32>, end: vec4<i32>, behind: vec4<i32>) -> Interval {
    let s = settling.s;
    let a = length_of(before.xyz - start.xyz);
    let b = length_of(end.xyz - start.xyz);
    let c = length_of(behind.xyz - start.xyz);
    var interval: Interval;
    interval.start = start.xyz;
    interval.c1 = (b - a) * s;
    interval.c2 = a * (2.0 * s) + b * (3.0 - 2.0 * s) - c * s;
    interval.c3 = (c - a) * s + b * (s - 2.0);
    interval.halves = halves_of(start);
    interval.growth = halves_of(end) - interval.halves;
    return interval;
}

// The way from its beginning to `u`, mm.
fn interval_offset(interval: Interval, u: f32) -> vec3<f32> {
    return (interval.c1 + (interval.c2 + interval.c3 * u) * u) * u;
}

// The first derivative by u, mm.
fn interval_velocity(interval: Interval, u: f32) -> vec3<f32> {
    return interval.c1 + (interval.c2 * 2.0 + interval.c3 * (3.0 * u)) * u;
}

// The second derivative by u, mm.
fn interval_acceleration(interval: Interval, u: f32) -> vec3<f32> {
    return interval.c2 * 2.0 + interval.c3 * (6.0 * u);
}

// How far the yarn reaches from its centreline at `u`, where it moves with `velocity`, in direction `towards`, mm.
fn interval_reach(interval: Interval, u: f32, velocity: vec3<f32>, towards: vec3<f32>) -> f32 {
    let halves = interval.halves + interval.growth * u;
    if !FLATTENED {
        return halves.x;
    }
    let level = velocity.x * velocity.x + velocity.y * velocity.y;
    let square = level + velocity.z * velocity.z;
    if halves.x == halves.y || level <= VERTICAL * square {
        return halves.x;
    }
    // Side is (-y, x, 0), up is t x side, both over their lengths.
    let aside = (towards.y * velocity.x - towards.x * velocity.y) * halves.x;
    let up = (towards.z * level - (towards.x * velocity.x + towards.y * velocity.y) * velocity.z) * halves.y;
    return sqrt((aside * aside + up * up / square) / level);
}

// What each of an interval's four control points counts, where one of them stands beyond an open yarn's end: those that it is
// made of count instead.
fn folded(tags: u32, weights: vec4<f32>) -> vec4<f32> {
    var own = weights;
    if (tags & TAG_OPENS) != 0u {
        own.y += 2.0 * own.x;
        own.z -= own.x;
        own.x = 0.0;
    }
    if (tags & TAG_ENDS) != 0u {
        own.z += 2.0 * own.w;
        own.y -= own.w;
        own.w = 0.0;
    }
    return own;
}

// ---- Chords ----

struct Chord {
    // Where it begins, units.
    at: vec3<i32>,
    // The place of its interval.
    place: u32,
    // From its beginning to its end, mm.
    span: vec3<f32>,
    // The larger of its interval's half width and half height, at either end, mm.
    thickest: f32,
}

fn chord_of(first: vec4<u32>, second: vec4<u32>) -> Chord {
    return Chord(bitcast<vec3<i32>>(first.xyz), first.w, bitcast<vec3<f32>>(second.xyz), bitcast<f32>(second.w));
}

// Its middle, units.
fn middle_of(chord: Chord) -> vec3<i32> {
    return chord.at + units_of(chord.span * 0.5);
}

// Two chords, as near as images of the second come to the first.
struct Nearest {
    // How many repeats away the image is.
    image: vec2<i32>,
    // Where they come nearest to one another: shares of both.
    shares: vec2<f32>,
    // The way from there to there, mm.
    apart: vec3<f32>,
}

// A way of so many units to something, to the image of that so many repeats away.
fn to_image(way: vec3<i32>, image: vec2<i32>) -> vec3<i32> {
    return vec3(way.x + image.x * settling.period_x, way.y + image.y * settling.period_y, way.z);
}

fn nearest(one: Chord, other: Chord) -> Nearest {
    var found: Nearest;
    let way = other.at - one.at;
    let middles = length_of(way).xy + (other.span.xy - one.span.xy) * 0.5;
    let frequency = vec2(settling.frequency_x, settling.frequency_y);
    found.image = -vec2<i32>(floor(middles * frequency + 0.5));
    let between = length_of(to_image(way, found.image));
    let a = max(inner(one.span, one.span), SHORT);
    let e = max(inner(other.span, other.span), SHORT);
    let b = inner(one.span, other.span);
    let c = -inner(one.span, between);
    let f = -inner(other.span, between);
    let determinant = a * e - b * b;
    // Of parallel chords one place does as well as another.
    var first = 0.5;
    if determinant > PARALLEL * (a * e) {
        first = share((b * f - c * e) / determinant);
    }
    let second = share((b * first + f) / e);
    found.shares = vec2(share((b * second - c) / a), second);
    found.apart = between + other.span * found.shares.y - one.span * found.shares.x;
    return found;
}

// ---- Cells of a grid over x and y ----

// The cell of a coordinate along an axis.
fn cell_along(at: i32, low: i32, size: u32, count: u32, period: i32) -> u32 {
    var from_low = bitcast<u32>(at - low);
    if period > 0 {
        let rest = at % period;
        from_low = bitcast<u32>(select(rest, rest + period, rest < 0));
    }
    return min(from_low / size, count - 1u);
}

// Column and row of the cell in which a chord's middle lies.
fn cell_of(middle: vec3<i32>) -> vec2<u32> {
    return vec2(
        cell_along(middle.x, settling.low_x, settling.size_x, settling.count_x, settling.period_x),
        cell_along(middle.y, settling.low_y, settling.size_y, settling.count_y, settling.period_y),
    );
}

// Its number.
fn cell_number(cell: vec2<u32>) -> u32 {
    return cell.y * settling.count_x + cell.x;
}
