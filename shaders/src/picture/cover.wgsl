// Corners on the screen, and the samples that a quad may cover. Places on the screen are counted in
// units of 1/256 pixel, x to the right and y down. This file follows fabric.wgsl and either
// keys_64.wgsl or keys_32.wgsl.

const SUBPIXELS = 256.0;

// The greatest distance of a corner from the screen's middle along x and y, in units of 1/256
// pixel. Up to this distance `rounded` gives exact numbers, and `long_cross` of draw.wgsl tests
// edges exactly.
const REACHED = 4194304.0;

// If a quad is less wide and less high than this, in units of 1/256 pixel, the products that test
// its edges fit in 32 bits.
const EXTENT = 32768;

// A quad is drawn by one lane if its box has this many samples or fewer, otherwise by a whole
// workgroup.
const ALONE = 512;

// A corner on the screen.
struct Corner {
    // How far the corner lies right of the screen's middle and below it, in units of 1/256 pixel.
    place: vec2<i32>,
    depth: f32,
    // A bit for each side of the view beyond which the corner lies. The bit BEYOND is set if the
    // corner has no place.
    sides: u32,
}

// The bit of a corner without a place. Such a corner lies behind the eye, or farther aside than
// REACHED.
const BEYOND = 64u;

// The point `clip` of clip space, converted to screen space. Its x and y, divided by its w, are the
// distances from the screen's middle to the right and down, in units of 1/256 pixel.
fn screen_of(clip: vec4<f32>) -> vec4<f32> {
    return clip * screen_scale();
}

fn screen_scale() -> vec4<f32> {
    return vec4(vec2(0.5, -0.5) * SUBPIXELS * view.size, 1.0, 1.0);
}

// Floats near 3 * 2^22 lie 1 apart. A sum with ROUNDER is therefore rounded to a whole number, and
// the bits of the float, less ROUNDER_BITS, are that number. Many GPUs take several times as long
// to convert a float to an integer as to add.
const ROUNDER = 12582912.0;
const ROUNDER_BITS = 0x4b400000;

// The nearest whole numbers, up to REACHED.
fn rounded(place: vec2<f32>) -> vec2<i32> {
    return bitcast<vec2<i32>>(place + ROUNDER) - ROUNDER_BITS;
}

// The place of a corner in screen space, in whole units of 1/256 pixel.
fn place_of(xy: vec2<f32>, w: f32) -> vec2<f32> {
    // In a parallel view w is 1 everywhere.
    if view.eye.w == 0.0 {
        return (xy + ROUNDER) - ROUNDER;
    }
    // ROUNDER is not added here. A compiler might fuse the addition with the product in one shader
    // and not in another, and the results would differ.
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

// Offers a triangle, or a part of a hair, to the sample of pixel `x` in row `row`.
fn offer_at(x: i32, row: i32, depth: f32, triangle: u32) {
    if depth < 0.0 || depth > 1.0 {
        return;
    }
    let sample = key_at(u32(x), u32(row >> 2u) - sweep.first_row, u32(row & 3));
    // Depth and number are passed as complements, so that the greatest key belongs to the nearest
    // triangle. If several triangles are equally near, it belongs to the one of the lowest number.
    offer(sample, ~bitcast<u32>(abs(depth)), ~triangle);
}

// The sizes of quads, as bits. The band is the rows of pixels that this sweep draws. A quad is NONE
// if it does not show or if its box meets no pixel of the band, SMALL if the box meets at most two
// by two pixels of the band, FEW if the pixels that it meets have about ALONE samples or fewer, and
// otherwise MANY. A quad with a corner beyond REACHED is MANY.
const NONE = 0u;
const SMALL = 1u;
const FEW = 2u;
const MANY = 4u;

// Whether a triangle shows, given twice its area as `area_of` counts it. The outside of a tube
// shows; the inside shows only if the view may see insides. Seen from outside, the corners of a
// triangle go round counter-clockwise. Because y points down here, the area is then below 0.
fn is_seen(area: f32) -> bool {
    return area < 0.0 || (area > 0.0 && view.sees_inside != 0u);
}

// Twice the area of a triangle on the screen. Only the sign of the area matters. Rounding can
// change the sign only if an edge is longer than 16 pixels and the triangle is thinner than 1/256
// pixel.
fn area_of(p: Corner, q: Corner, r: Corner) -> f32 {
    let pq = vec2<f32>(q.place - p.place);
    let pr = vec2<f32>(r.place - p.place);
    return pq.x * pr.y - pq.y * pr.x;
}

// Whether a triangle may show whose corners are less than EXTENT apart. Twice its area, in units of
// 1/65,536 square pixel, has an error of less than 256 from rounding. A triangle therefore counts
// as seen if that number is below 256, and not only if it is below 0.
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

// Whether the quad's triangle p q r or its triangle q s r may show.
fn may_show(quad: Quad) -> bool {
    if (quad.p.sides & quad.q.sides & quad.r.sides & quad.s.sides & ~BEYOND) != 0u {
        return false;
    }
    if ((quad.p.sides | quad.q.sides | quad.r.sides | quad.s.sides) & BEYOND) != 0u {
        return true;
    }
    let across = highest(quad) - lowest(quad);
    if max(across.x, across.y) >= EXTENT {
        return is_seen(area_of(quad.p, quad.q, quad.r)) || is_seen(area_of(quad.q, quad.s, quad.r));
    }
    let box = near_box_of(vec2<f32>(quad.p.place), vec2<f32>(quad.q.place), vec2<f32>(quad.r.place), vec2<f32>(quad.s.place));
    return size_of(box, ALONE) != NONE;
}

fn lowest(quad: Quad) -> vec2<i32> {
    return min(min(quad.p.place, quad.q.place), min(quad.r.place, quad.s.place));
}

fn highest(quad: Quad) -> vec2<i32> {
    return max(max(quad.p.place, quad.q.place), max(quad.r.place, quad.s.place));
}

// The box round a quad, from `least` to `most`, in units of 1/256 pixel from the screen's upper
// left corner. `first` and `last` are the first and the last pixel of the band that the box meets.
// The band is the rows of pixels that this sweep draws. If the quad does not show, `last` lies
// before `first`.
struct QuadBox {
    least: vec2<i32>,
    most: vec2<i32>,
    first: vec2<i32>,
    last: vec2<i32>,
}

// The box of a quad whose corners all have a place and lie less than EXTENT apart.
fn near_box_of(p: vec2<f32>, q: vec2<f32>, r: vec2<f32>, s: vec2<f32>) -> QuadBox {
    if !(near_may_show(p, q, r) | near_may_show(q, s, r) | (view.sees_inside != 0u)) {
        return QuadBox(vec2(0), vec2(0), vec2(0), vec2(-1));
    }
    // The box is 1/256 pixel larger each way. The corners are worked out again when the quad is
    // drawn, and a compiler may round them differently there.
    let least = rounded(min(min(p, q), min(r, s))) + (middle() - 1);
    let most = rounded(max(max(p, q), max(r, s))) + (middle() + 1);
    return QuadBox(least, most, first_pixel(least), last_pixel(most));
}

// A box with the pixels of a box that is 1/256 pixel larger each way. With this wider box
// `raster_few` finds every quad that `raster` has left over, even if a compiler rounds differently
// in the two passes. A quad that both passes draw does no harm.
fn wider(box: QuadBox) -> QuadBox {
    return QuadBox(box.least, box.most, first_pixel(box.least - 1), last_pixel(box.most + 1));
}

// The size of a quad with this box. `alone` is the most samples of a FEW quad.
fn size_of(box: QuadBox, alone: i32) -> u32 {
    let across = box.last - box.first;
    if min(across.x, across.y) < 0 {
        return NONE;
    }
    if max(across.x, across.y) <= 1 {
        return SMALL;
    }
    return select(MANY, FEW, 4 * (across.x + 1) * (across.y + 1) <= alone);
}

// A bit for each sample in the box of a SMALL quad. There are four bits for a pixel, row by row
// from the pixel of the least x and y on. Most SMALL quads lie between samples and have no bit.
fn samples_of(box: QuadBox) -> u32 {
    let first = box.first;
    let last = box.last;
    var samples = samples_between(box.least, box.most, first);
    if last.x > first.x {
        samples |= samples_between(box.least, box.most, vec2(last.x, first.y)) << 4u;
    }
    if last.y > first.y {
        samples |= samples_between(box.least, box.most, vec2(first.x, last.y)) << 8u;
        if last.x > first.x {
            samples |= samples_between(box.least, box.most, last) << 12u;
        }
    }
    return samples;
}

// The column and the row of the first pixel of the band that a box meets. `least` is the box's
// upper left corner, in units of 1/256 pixel from the screen's upper left corner.
fn first_pixel(least: vec2<i32>) -> vec2<i32> {
    return max(least >> vec2(8u), vec2(0, i32(sweep.first_row)));
}

// The column and the row of the last pixel of the band that a box meets. `most` is the box's lower
// right corner, in units of 1/256 pixel from the screen's upper left corner.
fn last_pixel(most: vec2<i32>) -> vec2<i32> {
    return min(most >> vec2(8u), vec2(i32(view.size.x) - 1, i32(sweep.first_row + sweep.rows) - 1));
}

// A bit for each sample of a pixel, set if the sample lies between `least` and `most`.
fn samples_between(least: vec2<i32>, most: vec2<i32>, pixel: vec2<i32>) -> u32 {
    let low = least - pixel * 256;
    let high = most - pixel * 256;
    let at = samples_in(pixel);
    return bits_of((vec4(low.x) <= at.x) & (at.x <= vec4(high.x)) & (vec4(low.y) <= at.y) & (at.y <= vec4(high.y)));
}

// The four samples of a pixel: how far each lies right of the pixel's upper left corner and below
// it, in units of 1/256 pixel.
struct Four {
    x: vec4<i32>,
    y: vec4<i32>,
}

fn samples_in(pixel: vec2<i32>) -> Four {
    let shift = shift_of(pixel);
    let down = (FIRST_SAMPLE_Y + shift.y) & (SAMPLE_ROW - 1);
    return Four((vec4(sample_x(0), sample_x(1), sample_x(2), sample_x(3)) + shift.x) & vec4(255), vec4(0, 1, 2, 3) * SAMPLE_ROW + down);
}

fn bits_of(each: vec4<bool>) -> u32 {
    let bits = select(vec4(0u), vec4(1u, 2u, 4u, 8u), each);
    return bits.x | bits.y | bits.z | bits.w;
}
