// The samples that a triangle covers. After fabric.wgsl and one of keys_64.wgsl and keys_32.wgsl.
//
// The rules are those of any rasteriser, so that triangles with a common edge leave no sample out and have none twice: corners
// are rounded to 1/256 of a pixel, edges are tested in whole numbers, and a sample on an edge belongs to the triangle whose
// top or left edge that is.

const SUBPIXELS = 256.0;

// Corners at most this far from the screen's middle, pixels: edges are exact up to there.
const REACHED = 16384.0;

// A quad of fewer 1/256 pixels across takes edges of 32 bits.
const EXTENT = 32768;

// A quad whose box has more samples is left to the whole workgroup.
const ALONE = 96;

// A corner on the screen.
struct Corner {
    // 1/256 pixels right of the middle and below it.
    place: vec2<i32>,
    depth: f32,
    // The sides of the view that it lies beyond, a bit each, and BEYOND.
    sides: u32,
}

// Marks a corner that lies behind the eye or too far aside to have a place.
const BEYOND = 64u;

fn corner_of(clip: vec4<f32>) -> Corner {
    let pixels = clip.xy / clip.w * vec2(0.5, -0.5) * view.size;
    let is_beyond = clip.w < 1e-6 || any(abs(pixels) > vec2(REACHED));
    let over = vec3<u32>(clip.xyz > vec3(clip.w)) * vec3(1u, 2u, 4u);
    let under = vec3<u32>(clip.xyz < vec3(-clip.w, -clip.w, 0.0)) * vec3(8u, 16u, 32u);
    let sides = over.x | over.y | over.z | under.x | under.y | under.z | select(0u, BEYOND, is_beyond);
    let place = select(vec2<i32>(floor(pixels * SUBPIXELS + 0.5)), vec2(0), vec2(is_beyond));
    return Corner(place, clip.z / clip.w, sides);
}

fn cross_of(edge: vec2<i32>, to: vec2<i32>) -> i32 {
    return edge.x * to.y - edge.y * to.x;
}

// The samples of a triangle's box, or some more where pixels have shifts: rows of samples, and pixels.
struct Span {
    first: vec2<i32>,
    last: vec2<i32>,
}

fn span_of(low: vec2<i32>, high: vec2<i32>) -> Span {
    let slack = select(0, 32, view.spread > 0.0);
    let least = low + middle() - slack;
    let most = high + middle() + slack;
    let first_row = max((least.y - FIRST_SAMPLE_Y + SAMPLE_ROW - 1) >> 6u, i32(4u * sweep.first_row));
    let last_row = min((most.y - FIRST_SAMPLE_Y) >> 6u, i32(4u * (sweep.first_row + sweep.rows)) - 1);
    // The sample of a pixel that lies farthest left is at 32, the one farthest right at 224.
    let first_x = max((least.x - 224 + 255) >> 8u, 0);
    let last_x = min((most.x - 32) >> 8u, i32(view.size.x) - 1);
    return Span(vec2(first_x, first_row), vec2(last_x, last_row));
}

// Offers the triangle in the sample of pixel `x` in row `row`.
fn offer_at(x: i32, row: i32, depth: f32, triangle: u32) {
    if depth < 0.0 || depth > 1.0 {
        return;
    }
    let sample = key_at(u32(x), u32(row >> 2u) - sweep.first_row, u32(row & 3));
    // Complements: the greatest key is that of the nearest triangle, and of those as near of the first one.
    offer(sample, ~bitcast<u32>(abs(depth)), ~triangle);
}

// Whether a quad may have samples: none, few or many. One that lies partly beyond what is reached may have many.
const NONE = 0u;
const FEW = 1u;
const MANY = 2u;

// A triangle's area on the screen, twice. Only its sign is wanted, which rounding does not change but where edges are as long as
// the screen. Outsides are counter-clockwise as seen with y up: their areas are below 0.
fn area_of(p: Corner, q: Corner, r: Corner) -> f32 {
    let pq = vec2<f32>(q.place - p.place);
    let pr = vec2<f32>(r.place - p.place);
    return pq.x * pr.y - pq.y * pr.x;
}

fn is_seen(area: f32) -> bool {
    return area < 0.0 || (area > 0.0 && view.sees_inside != 0u);
}

// Of the quad between p and q on a ring and r and s on the next: the triangles p q r and q s r.
fn look_of(p: Corner, q: Corner, r: Corner, s: Corner) -> u32 {
    if (p.sides & q.sides & r.sides & s.sides & ~BEYOND) != 0u {
        return NONE;
    }
    if ((p.sides | q.sides | r.sides | s.sides) & BEYOND) != 0u {
        return MANY;
    }
    if !is_seen(area_of(p, q, r)) && !is_seen(area_of(q, s, r)) {
        return NONE;
    }
    let low = min(min(p.place, q.place), min(r.place, s.place));
    let high = max(max(p.place, q.place), max(r.place, s.place));
    let span = span_of(low, high);
    let across = span.last - span.first + 1;
    let extent = max(high.x - low.x, high.y - low.y);
    let is_small = across.x * across.y <= ALONE && extent < EXTENT;
    // Most quads lie between samples, in one row or in two.
    let has_samples = min(across.x, across.y) > 0
        && (max(across.x, across.y) > 2 || has_sample(low, high, span.first) || has_sample(low, high, span.last)
            || has_sample(low, high, vec2(span.first.x, span.last.y)) || has_sample(low, high, vec2(span.last.x, span.first.y)));
    return select(NONE, select(MANY, FEW, is_small), has_samples);
}

// Whether the sample of pixel `at.x` in row `at.y` lies between `low` and `high`.
fn has_sample(low: vec2<i32>, high: vec2<i32>, at: vec2<i32>) -> bool {
    let place = sample_place(at.x, at.y);
    return all(low <= place) && all(place <= high);
}

// A triangle in the order in which edges go round it clockwise as seen on the screen.
struct Turned {
    p: Corner,
    q: Corner,
    r: Corner,
    is_seen: bool,
}

fn turned(p: Corner, q: Corner, r: Corner) -> Turned {
    let area = area_of(p, q, r);
    if area < 0.0 {
        return Turned(p, r, q, true);
    }
    return Turned(p, q, r, is_seen(area));
}

// 0 for an edge that its samples belong to, a top or a left one, else -1.
fn edge_bias(edge: vec2<i32>) -> i32 {
    return select(-1, 0, edge.y < 0 || (edge.y == 0 && edge.x > 0));
}

struct Coverage {
    is_covered: bool,
    depth: f32,
}

fn coverage_of(turned: Turned, place: vec2<i32>) -> Coverage {
    let pq = turned.q.place - turned.p.place;
    let qr = turned.r.place - turned.q.place;
    let rp = turned.p.place - turned.r.place;
    let over_r = cross_of(pq, place - turned.p.place);
    let over_p = cross_of(qr, place - turned.q.place);
    let over_q = cross_of(rp, place - turned.r.place);
    let is_covered =
        over_r + edge_bias(pq) >= 0 && over_p + edge_bias(qr) >= 0 && over_q + edge_bias(rp) >= 0;
    let share = 1.0 / f32(cross_of(pq, -rp));
    let depth = turned.p.depth
        + (f32(over_q) * (turned.q.depth - turned.p.depth) + f32(over_r) * (turned.r.depth - turned.p.depth)) * share;
    return Coverage(is_covered, depth);
}

// Twice the area between `edge` and `to`, and its sign, exact for differences of 24 bits: in parts of 12 bits.
struct Area {
    sign: i32,
    value: f32,
}

fn long_cross(edge: vec2<i32>, to: vec2<i32>) -> Area {
    let edge_high = edge >> vec2(12u);
    let edge_low = edge & vec2(4095);
    let to_high = to >> vec2(12u);
    let to_low = to & vec2(4095);
    let low = cross_of(edge_low, to_low);
    let middle = cross_of(edge_high, to_low) + cross_of(edge_low, to_high) + (low >> 12u);
    let high = cross_of(edge_high, to_high) + (middle >> 12u);
    let rest = ((middle & 4095) << 12u) | (low & 4095);
    let sign = select(select(0, 1, high > 0 || rest != 0), -1, high < 0);
    return Area(sign, f32(high) * 16777216.0 + f32(rest));
}

fn long_coverage(turned: Turned, place: vec2<i32>) -> Coverage {
    let pq = turned.q.place - turned.p.place;
    let qr = turned.r.place - turned.q.place;
    let rp = turned.p.place - turned.r.place;
    let over_r = long_cross(pq, place - turned.p.place);
    let over_p = long_cross(qr, place - turned.q.place);
    let over_q = long_cross(rp, place - turned.r.place);
    let is_covered = over_r.sign + edge_bias(pq) >= 0 && over_p.sign + edge_bias(qr) >= 0
        && over_q.sign + edge_bias(rp) >= 0;
    let share = 1.0 / long_cross(pq, -rp).value;
    let depth = turned.p.depth
        + (over_q.value * (turned.q.depth - turned.p.depth) + over_r.value * (turned.r.depth - turned.p.depth)) * share;
    return Coverage(is_covered, depth);
}

fn lowest(turned: Turned) -> vec2<i32> {
    return min(turned.p.place, min(turned.q.place, turned.r.place));
}

fn highest(turned: Turned) -> vec2<i32> {
    return max(turned.p.place, max(turned.q.place, turned.r.place));
}

// Draws a quad of few samples, whose first triangle is number `triangle`.
fn draw_alone(p: Corner, q: Corner, r: Corner, s: Corner, triangle: u32) {
    let one = turned(p, q, r);
    let other = turned(q, s, r);
    let span = span_of(min(lowest(one), lowest(other)), max(highest(one), highest(other)));
    for (var row = span.first.y; row <= span.last.y; row++) {
        for (var x = span.first.x; x <= span.last.x; x++) {
            let place = sample_place(x, row);
            // A sample lies in one of them at most, but where the quad is folded.
            let in_one = coverage_of(one, place);
            if one.is_seen && in_one.is_covered {
                offer_at(x, row, in_one.depth, triangle);
            }
            let in_other = coverage_of(other, place);
            if other.is_seen && in_other.is_covered {
                offer_at(x, row, in_other.depth, triangle + 1u);
            }
        }
    }
}

// Draws a triangle of many samples: lane `lane` of `lanes` its share of them.
fn draw_together(p: Corner, q: Corner, r: Corner, triangle: u32, lane: u32, lanes: u32) {
    let turned = turned(p, q, r);
    let low = lowest(turned);
    let high = highest(turned);
    let span = span_of(low, high);
    let across = span.last - span.first + 1;
    let is_long = max(high.x - low.x, high.y - low.y) >= EXTENT;
    if !turned.is_seen || min(across.x, across.y) <= 0 {
        return;
    }
    let step = vec2(i32(lanes) % across.x, i32(lanes) / across.x);
    var at = vec2(i32(lane) % across.x, i32(lane) / across.x);
    while at.y < across.y {
        let x = span.first.x + at.x;
        let row = span.first.y + at.y;
        var coverage: Coverage;
        if is_long {
            coverage = long_coverage(turned, sample_place(x, row));
        } else {
            coverage = coverage_of(turned, sample_place(x, row));
        }
        if coverage.is_covered {
            offer_at(x, row, coverage.depth, triangle);
        }
        at += step;
        if at.x >= across.x {
            at += vec2(-across.x, 1);
        }
    }
}

// Draws a triangle that lies partly behind the eye, or far aside: the whole screen against its edges in homogeneous coordinates
// (Olano and Greer 1997, "Triangle scan conversion using 2D homogeneous coordinates").
fn draw_beyond(p: vec4<f32>, q: vec4<f32>, r: vec4<f32>, triangle: u32, lane: u32, lanes: u32) {
    let samples = u32(view.size.x) * sweep.rows * 4u;
    for (var sample = lane; sample < samples; sample += lanes) {
        let row = sample / u32(view.size.x);
        let x = i32(sample - row * u32(view.size.x));
        let sample_row = i32(row + 4u * sweep.first_row);
        let weights = weights_at(p, q, r, sample_place(x, sample_row));
        let determinant = dot(weights, vec3(p.w, q.w, r.w));
        let is_front = determinant > 0.0;
        // All of one sign: else the place lies outside, or the line of sight meets the triangle behind the eye.
        let inside = select(-weights, weights, is_front);
        if determinant != 0.0 && (is_front || view.sees_inside != 0u) && all(inside >= vec3(0.0)) {
            let clip = p * weights.x + q * weights.y + r * weights.z;
            offer_at(x, sample_row, clip.z / clip.w, triangle);
        }
    }
}
