// Draws quads and triangles into their samples. This file follows cover.wgsl and weights.wgsl.
//
// The rules are those of any rasteriser: corners are rounded to 1/256 of a pixel, edges are tested
// in whole numbers, and a sample on an edge belongs to the triangle whose top or left edge it is.
// Triangles with a common edge thus leave no sample out, and cover none twice.

fn cross_of(edge: vec2<i32>, to: vec2<i32>) -> i32 {
    return edge.x * to.y - edge.y * to.x;
}

// The samples in a triangle's box, as rows of samples and columns of pixels. If pixels have shifts,
// the span has some samples more.
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
    // A pixel's leftmost sample lies at 32, its rightmost at 224.
    let first_x = max((least.x - 224 + 255) >> 8u, 0);
    let last_x = min((most.x - 32) >> 8u, i32(view.size.x) - 1);
    return Span(vec2(first_x, first_row), vec2(last_x, last_row));
}

// A triangle, with its corners in clockwise order as seen on the screen.
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

// 0 for a top or left edge, because samples on such an edge belong to the triangle, otherwise -1.
fn edge_bias(edge: vec2<i32>) -> i32 {
    return select(-1, 0, edge.y < 0 || (edge.y == 0 && edge.x > 0));
}

struct Coverage {
    is_covered: bool,
    depth: f32,
}

// The depth at a point. `over_q` and `over_r` are twice the areas of the triangles between the
// point and the edges opposite q and r, and `area` is twice the area of the whole triangle.
fn depth_of(turned: Turned, over_q: f32, over_r: f32, area: f32) -> f32 {
    let share = 1.0 / area;
    return turned.p.depth
        + (over_q * (turned.q.depth - turned.p.depth) + over_r * (turned.r.depth - turned.p.depth)) * share;
}

fn coverage_of(turned: Turned, place: vec2<i32>) -> Coverage {
    let pq = turned.q.place - turned.p.place;
    let qr = turned.r.place - turned.q.place;
    let rp = turned.p.place - turned.r.place;
    let over_r = cross_of(pq, place - turned.p.place);
    let over_p = cross_of(qr, place - turned.q.place);
    let over_q = cross_of(rp, place - turned.r.place);
    // A sample can be inside of all three edges only if they go round clockwise.
    let is_covered =
        (over_r + edge_bias(pq) >= 0) & (over_p + edge_bias(qr) >= 0) & (over_q + edge_bias(rp) >= 0);
    return Coverage(is_covered, depth_of(turned, f32(over_q), f32(over_r), f32(over_r + over_p + over_q)));
}

// Twice the area between `edge` and `to`, and its sign. The sign is exact for differences of 24
// bits, because the area is worked out in parts of 12 bits. The value is rounded to a float.
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
    return Coverage(is_covered, depth_of(turned, over_q.value, over_r.value, long_cross(pq, -rp).value));
}

// Draws a SMALL quad into the samples that it covers. Its first triangle is number `triangle`.
fn draw_small(quad: Quad, samples: u32, triangle: u32) {
    // The pixel at which `samples_of` began.
    let first = first_pixel(lowest(quad) + (middle() - 1));
    for (var rest = samples; rest != 0u; rest &= rest - 1u) {
        let sample = i32(firstTrailingBit(rest));
        let pixel = first + vec2((sample >> 2u) & 1, sample >> 3u);
        draw_sample(quad, pixel.x, 4 * pixel.y + (sample & 3), triangle);
    }
}

// An edge of a triangle, as a vector (x, y, z). For a place (a, b), counted from `origin`, the sum
// x * b - y * a + z is at least 0 if the place lies on the inner side of the edge.
fn edge_of(start: vec2<i32>, end: vec2<i32>, origin: vec2<i32>) -> vec3<i32> {
    let edge = end - start;
    return vec3(edge, edge_bias(edge) - cross_of(edge, start - origin));
}

// The sum of an edge at four places. Parts of the sum may wrap, but the sum is exact, because
// places lie within a box of ALONE samples.
fn sums_at(edge: vec3<i32>, places: Four) -> vec4<i32> {
    return edge.x * places.y - edge.y * places.x + edge.z;
}

// Draws a FEW quad, four by two pixels at a time. It first finds the samples that the quad covers,
// and then draws them.
fn draw_few(quad: Quad, triangle: u32) {
    if view.sees_inside != 0u {
        // A folded quad may show both its triangles in a sample.
        draw_together(quad.p, quad.q, quad.r, triangle, Lanes(0, 0, 1, 1));
        draw_together(quad.s, quad.r, quad.q, triangle + 1u, Lanes(0, 0, 1, 1));
        return;
    }
    let origin = quad.r.place;
    let diagonal = edge_of(quad.r.place, quad.q.place, origin);
    // The other edges of the triangle p q r, and of q s r.
    let pr = edge_of(quad.p.place, quad.r.place, origin);
    let qp = edge_of(quad.q.place, quad.p.place, origin);
    let sq = edge_of(quad.s.place, quad.q.place, origin);
    let rs = edge_of(quad.r.place, quad.s.place, origin);
    let first = first_pixel(lowest(quad) + middle());
    let last = last_pixel(highest(quad) + middle());
    for (var row = first.y; row <= last.y; row += 2) {
        for (var column = first.x; column <= last.x; column += 4) {
            let end = min(vec2(column + 3, row + 1), last);
            var covered = 0u;
            for (var y = row; y <= end.y; y++) {
                for (var x = column; x <= end.x; x++) {
                    let corner = vec2(x, y) * 256 - middle() - origin;
                    let own = samples_in(vec2(x, y));
                    let places = Four(own.x + corner.x, own.y + corner.y);
                    // A number is negative here if either of the two sums in it is negative.
                    let in_first = sums_at(pr, places) | sums_at(qp, places);
                    let in_second = sums_at(sq, places) | sums_at(rs, places);
                    let inside = select(in_second, in_first, sums_at(diagonal, places) >= vec4(0)) >= vec4(0);
                    covered |= bits_of(inside) << u32(16 * (y - row) + 4 * (x - column));
                }
            }
            for (; covered != 0u; covered &= covered - 1u) {
                let sample = i32(firstTrailingBit(covered));
                draw_sample(quad, column + ((sample >> 2u) & 3), 4 * (row + (sample >> 4u)) + (sample & 3), triangle);
            }
        }
    }
}

// Draws a quad into a sample: that triangle of the quad that lies on the sample's side of the
// diagonal between q and r.
fn draw_sample(quad: Quad, x: i32, row: i32, triangle: u32) {
    let place = sample_place(x, row);
    if view.sees_inside != 0u {
        // A folded quad may show both triangles.
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

// Offers a triangle to the sample at `place`, if it covers the sample.
fn offer_covered(turned: Turned, place: vec2<i32>, x: i32, row: i32, triangle: u32) {
    let coverage = coverage_of(turned, place);
    if turned.is_seen && coverage.is_covered {
        offer_at(x, row, coverage.depth, triangle);
    }
}

// A lane of several that share a triangle's samples, arranged in columns and rows.
struct Lanes {
    column: i32,
    row: i32,
    columns: i32,
    rows: i32,
}

// The part of a row of samples that may lie inside a triangle. The result's x is the part's left
// end and its y the right end, in units of 1/256 pixel right of the screen's middle.
fn reach_in(turned: Turned, row: i32) -> vec2<f32> {
    // Samples with shifts lie anywhere in the row.
    let is_shifted = view.spread > 0.0;
    let upper = f32(row * SAMPLE_ROW + select(FIRST_SAMPLE_Y, 0, is_shifted) - middle().y);
    let lower = upper + select(0.0, f32(SAMPLE_ROW), is_shifted);
    let rows = vec2(upper, lower);
    let p = vec2<f32>(turned.p.place);
    let q = vec2<f32>(turned.q.place);
    let r = vec2<f32>(turned.r.place);
    let reach = reach_beside(reach_beside(reach_beside(vec2(-REACHED, REACHED), p, q, rows), q, r, rows), r, p, rows);
    // Slack for the rounding of floats.
    return clamp(reach + vec2(-16.0, 16.0), vec2(-REACHED), vec2(REACHED));
}

// The part of a reach that an edge leaves. The triangle lies on the left of an edge that leads
// down, and on the right of an edge that leads up.
fn reach_beside(reach: vec2<f32>, start: vec2<f32>, end: vec2<f32>, rows: vec2<f32>) -> vec2<f32> {
    let edge = end - start;
    let at = start.x + edge.x / edge.y * (rows - start.y);
    return vec2(select(reach.x, max(reach.x, min(at.x, at.y)), edge.y < 0.0),
                select(reach.y, min(reach.y, max(at.x, at.y)), edge.y > 0.0));
}

// Draws a triangle with several lanes, each of which draws its share of the samples.
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

// Draws a triangle that lies partly behind the eye, or far aside. All samples of the rows that this
// sweep draws are tested against edges in homogeneous coordinates (Olano and Greer 1997, "Triangle
// scan conversion using 2D homogeneous coordinates").
fn draw_beyond(p: vec4<f32>, q: vec4<f32>, r: vec4<f32>, triangle: u32, lane: u32, lanes: u32) {
    let samples = u32(view.size.x) * sweep.rows * 4u;
    for (var sample = lane; sample < samples; sample += lanes) {
        let row = sample / u32(view.size.x);
        let x = i32(sample - row * u32(view.size.x));
        let sample_row = i32(row + 4u * sweep.first_row);
        let weights = weights_at(p, q, r, sample_place(x, sample_row));
        let determinant = dot(weights, vec3(p.w, q.w, r.w));
        let is_front = determinant > 0.0;
        // All weights must have one sign. Otherwise the place lies outside, or the line of sight
        // meets the triangle behind the eye.
        let inside = select(-weights, weights, is_front);
        if determinant != 0.0 && (is_front || view.sees_inside != 0u) && all(inside >= vec3(0.0)) {
            let clip = p * weights.x + q * weights.y + r * weights.z;
            offer_at(x, sample_row, clip.z / clip.w, triangle);
        }
    }
}
