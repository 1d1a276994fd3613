// The samples that a triangle covers. After fabric.wgsl, weights.wgsl and one of keys_64.wgsl and keys_32.wgsl.
//
// The rules are those of any rasteriser, so that triangles with a common edge leave no sample out and have none twice: corners
// are rounded to 1/256 of a pixel, edges are tested in whole numbers, and a sample on an edge belongs to the triangle whose
// top or left edge that is.

const SUBPIXELS = 256.0;

// Corners at most this far from the screen's middle, 1/256 pixels: edges are exact up to there.
const REACHED = 4194304.0;

// A quad of fewer 1/256 pixels across takes edges of 32 bits.
const EXTENT = 32768;

// A quad whose box has more samples is left to the whole workgroup.
const ALONE = 512;

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

// A point in screen space is one of clip space whose x and y are 1/256 pixels from the middle, y downwards, before they are divided by w.
fn screen_of(clip: vec4<f32>) -> vec4<f32> {
    return clip * screen_scale();
}

fn screen_scale() -> vec4<f32> {
    return vec4(vec2(0.5, -0.5) * SUBPIXELS * view.size, 1.0, 1.0);
}

// Next to 3 * 2^22 floats lie 1 apart, and their last bits count them: so a sum rounds. A conversion takes a GPU eight times as long.
const ROUNDER = 12582912.0;
const ROUNDER_BITS = 0x4b400000;

// The nearest whole numbers, up to REACHED.
fn rounded(place: vec2<f32>) -> vec2<i32> {
    return bitcast<vec2<i32>>(place + ROUNDER) - ROUNDER_BITS;
}

// Where that is on the screen, in whole numbers.
fn place_of(xy: vec2<f32>, w: f32) -> vec2<f32> {
    // In a parallel view w is 1 everywhere.
    if view.eye.w == 0.0 {
        return (xy + ROUNDER) - ROUNDER;
    }
    // A sum might be fused with the product in one place and not in another, and round otherwise there.
    return round(xy * (1.0 / w));
}

fn corner_of(at: vec4<f32>) -> Corner {
    let place = place_of(at.xy, at.w);
    let is_beyond = at.w < 1e-6 || any(abs(place) > vec2(REACHED));
    let edge = vec3(0.5 * SUBPIXELS * view.size, 1.0) * at.w;
    let over = vec3<u32>(at.xyz > edge) * vec3(1u, 2u, 4u);
    let under = vec3<u32>(at.xyz < vec3(-edge.xy, 0.0)) * vec3(8u, 16u, 32u);
    let sides = over.x | over.y | over.z | under.x | under.y | under.z | select(0u, BEYOND, is_beyond);
    return Corner(rounded(select(place, vec2(0.0), vec2(is_beyond))), at.z / at.w, sides);
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

// Which samples a quad may have: NONE; those of two by two pixels, a bit each, four for a pixel, from the pixel of the least x and y
// on, row by row; FEW of some pixels more, or all of those; or MANY, as one that lies partly beyond what is reached may have.
const NONE = 0u;
const FEW = 0xffffu;
const MANY = 0x10000u;

// Whether an outside, or an inside where that may be seen, shows: from a triangle's area on the screen, twice. Outsides are
// counter-clockwise as seen with y up: their areas are below 0.
fn is_seen(area: f32) -> bool {
    return area < 0.0 || (area > 0.0 && view.sees_inside != 0u);
}

// That area. Only its sign is wanted, which rounding does not change but where edges are as long as the screen.
fn area_of(p: Corner, q: Corner, r: Corner) -> f32 {
    let pq = vec2<f32>(q.place - p.place);
    let pr = vec2<f32>(r.place - p.place);
    return pq.x * pr.y - pq.y * pr.x;
}

// The same of corners less than EXTENT apart, by an area that is wrong by less than 256: whether a triangle may show. Smaller ones may.
fn near_may_show(p: vec2<f32>, q: vec2<f32>, r: vec2<f32>) -> bool {
    let pq = q - p;
    let pr = r - p;
    return pq.x * pr.y - pq.y * pr.x < 256.0;
}

// The corners of a quad: p and q on its ring, r and s on the next.
struct Quad {
    p: Corner,
    q: Corner,
    r: Corner,
    s: Corner,
}

// Its triangles are p q r and q s r.
fn look_of(quad: Quad) -> u32 {
    if (quad.p.sides & quad.q.sides & quad.r.sides & quad.s.sides & ~BEYOND) != 0u {
        return NONE;
    }
    if ((quad.p.sides | quad.q.sides | quad.r.sides | quad.s.sides) & BEYOND) != 0u {
        return MANY;
    }
    let across = highest(quad) - lowest(quad);
    if max(across.x, across.y) >= EXTENT {
        return select(NONE, MANY, is_seen(area_of(quad.p, quad.q, quad.r)) || is_seen(area_of(quad.q, quad.s, quad.r)));
    }
    return near_look_of(vec2<f32>(quad.p.place), vec2<f32>(quad.q.place), vec2<f32>(quad.r.place), vec2<f32>(quad.s.place), ALONE);
}

fn lowest(quad: Quad) -> vec2<i32> {
    return min(min(quad.p.place, quad.q.place), min(quad.r.place, quad.s.place));
}

fn highest(quad: Quad) -> vec2<i32> {
    return max(max(quad.p.place, quad.q.place), max(quad.r.place, quad.s.place));
}

// The same of a quad whose corners all have a place and lie less than EXTENT apart.
fn near_look_of(p: vec2<f32>, q: vec2<f32>, r: vec2<f32>, s: vec2<f32>, alone: i32) -> u32 {
    if !(near_may_show(p, q, r) | near_may_show(q, s, r) | (view.sees_inside != 0u)) {
        return NONE;
    }
    // One more each way, in case that a compiler rounds otherwise where it is drawn.
    let least = rounded(min(min(p, q), min(r, s))) + (middle() - 1);
    let most = rounded(max(max(p, q), max(r, s))) + (middle() + 1);
    let first = first_pixel(least);
    let last = last_pixel(most);
    let across = last - first;
    if min(across.x, across.y) < 0 {
        return NONE;
    }
    if max(across.x, across.y) > 1 {
        let most_samples = 4 * (across.x + 1) * (across.y + 1);
        return select(MANY, FEW, most_samples <= alone);
    }
    // Most quads lie between samples.
    var samples = samples_between(least, most, first);
    if across.x > 0 {
        samples |= samples_between(least, most, vec2(last.x, first.y)) << 4u;
    }
    if across.y > 0 {
        samples |= samples_between(least, most, vec2(first.x, last.y)) << 8u;
        if across.x > 0 {
            samples |= samples_between(least, most, last) << 12u;
        }
    }
    return samples;
}

// The first pixel of the band from `least` on, 1/256 pixels from the screen's upper left corner.
fn first_pixel(least: vec2<i32>) -> vec2<i32> {
    return max(least >> vec2(8u), vec2(0, i32(sweep.first_row)));
}

// The last one up to `most`.
fn last_pixel(most: vec2<i32>) -> vec2<i32> {
    return min(most >> vec2(8u), vec2(i32(view.size.x) - 1, i32(sweep.first_row + sweep.rows) - 1));
}

// The samples of a pixel that lie between `least` and `most`, likewise, a bit each.
fn samples_between(least: vec2<i32>, most: vec2<i32>, pixel: vec2<i32>) -> u32 {
    let shift = shift_of(pixel);
    let low = least - pixel * 256;
    let high = most - pixel * 256;
    let down = (FIRST_SAMPLE_Y + shift.y) & (SAMPLE_ROW - 1);
    let right = (vec4(sample_x(0), sample_x(1), sample_x(2), sample_x(3)) + shift.x) & vec4(255);
    let y = vec4(0, 1, 2, 3) * SAMPLE_ROW + down;
    let is_between = (vec4(low.x) <= right) & (right <= vec4(high.x)) & (vec4(low.y) <= y) & (y <= vec4(high.y));
    let bits = select(vec4(0u), vec4(1u, 2u, 4u, 8u), is_between);
    return bits.x | bits.y | bits.z | bits.w;
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
    // All three can be inside only where the edges go round clockwise.
    let is_covered =
        (over_r + edge_bias(pq) >= 0) & (over_p + edge_bias(qr) >= 0) & (over_q + edge_bias(rp) >= 0);
    let share = 1.0 / f32(over_r + over_p + over_q);
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

// Draws a quad, whose first triangle is number `triangle`, in those of its samples that `look` names.
fn draw_alone(quad: Quad, look: u32, triangle: u32) {
    if look == FEW {
        draw_together(quad.p, quad.q, quad.r, triangle, Lanes(0, 0, 1, 1));
        draw_together(quad.s, quad.r, quad.q, triangle + 1u, Lanes(0, 0, 1, 1));
        return;
    }
    // The pixel that `near_look_of` has begun at.
    let first = first_pixel(lowest(quad) + (middle() - 1));
    for (var samples = look; samples != 0u; samples &= samples - 1u) {
        let sample = i32(firstTrailingBit(samples));
        let pixel = first + vec2((sample >> 2u) & 1, sample >> 3u);
        draw_sample(quad, pixel.x, 4 * pixel.y + (sample & 3), triangle);
    }
}

// Draws a quad in a sample: that of its triangles which lies on the sample's side of the diagonal between q and r.
fn draw_sample(quad: Quad, x: i32, row: i32, triangle: u32) {
    let place = sample_place(x, row);
    if view.sees_inside != 0u {
        // A quad that is folded may show both.
        offer_covered(turned(quad.p, quad.q, quad.r), place, x, row, triangle);
        offer_covered(turned(quad.s, quad.r, quad.q), place, x, row, triangle + 1u);
        return;
    }
    let diagonal = quad.q.place - quad.r.place;
    let is_first = cross_of(diagonal, place - quad.r.place) + edge_bias(diagonal) >= 0;
    var seen = Turned(quad.s, quad.q, quad.r, true);
    if is_first {
        seen = Turned(quad.p, quad.r, quad.q, true);
    }
    offer_covered(seen, place, x, row, select(triangle + 1u, triangle, is_first));
}

// Offers a triangle in a sample that lies at `place`, where it covers it.
fn offer_covered(turned: Turned, place: vec2<i32>, x: i32, row: i32, triangle: u32) {
    let coverage = coverage_of(turned, place);
    if turned.is_seen && coverage.is_covered {
        offer_at(x, row, coverage.depth, triangle);
    }
}

// A lane of some that share a triangle's samples, in so many columns and rows.
struct Lanes {
    column: i32,
    row: i32,
    columns: i32,
    rows: i32,
}

// How far a row of samples may lie inside of a triangle, 1/256 pixels right of the screen's middle: before `x` and behind `y` it does not.
fn reach_in(turned: Turned, row: i32) -> vec2<f32> {
    // Samples that have shifts lie anywhere in the row.
    let is_shifted = view.spread > 0.0;
    let upper = f32(row * SAMPLE_ROW + select(FIRST_SAMPLE_Y, 0, is_shifted) - middle().y);
    let lower = upper + select(0.0, f32(SAMPLE_ROW), is_shifted);
    let rows = vec2(upper, lower);
    let p = vec2<f32>(turned.p.place);
    let q = vec2<f32>(turned.q.place);
    let r = vec2<f32>(turned.r.place);
    let reach = reach_beside(reach_beside(reach_beside(vec2(-REACHED, REACHED), p, q, rows), q, r, rows), r, p, rows);
    // What floats leave out.
    return clamp(reach + vec2(-16.0, 16.0), vec2(-REACHED), vec2(REACHED));
}

// What an edge leaves of a reach. One that leads down has the triangle on its left, one that leads up on its right.
fn reach_beside(reach: vec2<f32>, start: vec2<f32>, end: vec2<f32>, rows: vec2<f32>) -> vec2<f32> {
    let edge = end - start;
    let at = start.x + edge.x / edge.y * (rows - start.y);
    return vec2(select(reach.x, max(reach.x, min(at.x, at.y)), edge.y < 0.0),
                select(reach.y, min(reach.y, max(at.x, at.y)), edge.y > 0.0));
}

// Draws a triangle: a lane its share of the samples.
fn draw_together(p: Corner, q: Corner, r: Corner, triangle: u32, lanes: Lanes) {
    let turned = turned(p, q, r);
    let low = min(p.place, min(q.place, r.place));
    let high = max(p.place, max(q.place, r.place));
    let span = span_of(low, high);
    let is_long = max(high.x - low.x, high.y - low.y) >= EXTENT;
    if !turned.is_seen {
        return;
    }
    for (var row = span.first.y + lanes.row; row <= span.last.y; row += lanes.rows) {
        let reach = (vec2<i32>(reach_in(turned, row)) + middle().x) >> vec2(8u);
        let last = min(reach.y, span.last.x);
        for (var x = max(reach.x, span.first.x) + lanes.column; x <= last; x += lanes.columns) {
            var coverage: Coverage;
            if is_long {
                coverage = long_coverage(turned, sample_place(x, row));
            } else {
                coverage = coverage_of(turned, sample_place(x, row));
            }
            if coverage.is_covered {
                offer_at(x, row, coverage.depth, triangle);
            }
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
