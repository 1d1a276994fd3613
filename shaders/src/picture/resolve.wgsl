// Works out what each sample shows, from the number of its triangle or of its part of a hair. This
// file follows fabric.wgsl, weights.wgsl, kept.wgsl and hair.wgsl, and the constant HAIRY, which is
// false if no yarn has hairs.

@group(0) @binding(10) var<storage, read> cap_rows: array<CapRow>;
@group(0) @binding(11) var<storage, read> cap_pattern: array<u32>;
// The triangle and the nearness of each sample, as complements; 0 if the sample has no triangle.
@group(1) @binding(4) var<storage, read> keys: array<vec2<u32>>;
@group(1) @binding(5) var<storage, read> ring_rolls: array<vec2<u32>>;
@group(1) @binding(6) var depths: texture_storage_2d_array<r32float, read_write>;
@group(1) @binding(7) var directions: texture_storage_2d_array<rg32uint, write>;
@group(1) @binding(8) var places: texture_storage_2d_array<rg32uint, write>;

struct Vertex {
    clip: vec4<f32>,
    position: vec3<f32>,
    normal: vec3<f32>,
}

fn vertex_at(stance: Stance, point: vec4<f32>) -> Vertex {
    let position = position_at(stance, point);
    return Vertex(clip_of(position), position, normal_at(stance, point));
}

// The roll and the lean of a ring of the chunk.
fn roll_of(chunk_ring: u32) -> vec2<u32> {
    if params.rolled == 0u {
        return vec2(0u);
    }
    return ring_rolls[chunk_ring];
}

// How the section stands on a ring of a block, and on the ring after it.
struct Stances {
    here: Stance,
    next: Stance,
}

// How the section stands on ring `ring` of a block, and on the ring after it. Both rings lie in one
// interval or at its ends. At an interval's end the spline is the same as at the next interval's
// start, unless it comes to rest there and turns round.
fn stances_at(yarn: YarnRow, block: Block, ring: u32) -> Stances {
    let per_interval = params.subdivisions + 1u;
    let place = block.first_ring % per_interval + ring;
    let interval = quotient(place, per_interval);
    let part = place - interval * per_interval;
    let segment = segment_new(block.first_point + interval, params.s);
    let here = segment_sample(segment, f32(part) * params.step);
    let ends_interval = part + 1u == per_interval;
    let arrival = segment.c1.xyz + segment.c2.xyz * 2.0 + segment.c3.xyz * 3.0;
    var next: Sample;
    if ends_interval && dot(arrival, arrival) <= segment.at_rest {
        next = ring_sample(yarn, block, ring + 1u).sample;
    } else {
        next = segment_sample(segment, select(f32(part + 1u) * params.step, 1.0, ends_interval));
    }
    return Stances(stance_of_sample(here, roll_of(block.chunk_ring + ring)),
                   stance_of_sample(next, roll_of(block.chunk_ring + ring + 1u)));
}

// The weight of each corner, and whether the triangle is seen from outside.
struct Shares {
    corners: vec3<f32>,
    is_front: bool,
}

fn shares_of(p: vec4<f32>, q: vec4<f32>, r: vec4<f32>, place: vec2<i32>) -> Shares {
    let weights = weights_at(p, q, r, place);
    let is_front = dot(weights, vec3(p.w, q.w, r.w)) > 0.0;
    // The place may lie outside of the triangle. Weights are limited, so that nothing is
    // extrapolated far beyond a small triangle.
    let inside = max(select(-weights, weights, is_front), vec3(0.0));
    let sum = inside.x + inside.y + inside.z;
    return Shares(select(vec3(1.0 / 3.0), inside / sum, sum > 0.0), is_front);
}

fn angle_of(side: u32) -> vec2<f32> {
    let angle = f32(side) * (TAU / f32(params.sides));
    return vec2(cos(angle), sin(angle));
}

fn tube_at(row: u32, number: u32, place: vec2<i32>) -> vec4<u32> {
    let block = blocks[row];
    let yarn = yarns[block.yarn];
    let at = quad_at(number / 2u);
    let ring = at.x;
    let side = at.y;
    let beside = at.z;
    let stances = stances_at(yarn, block, ring);
    let outline = yarn.section * params.sides;
    let own = outlines[outline + side];
    let other = outlines[outline + beside];
    let is_second = (number & 1u) != 0u;
    // The quad's first triangle has two corners on this ring and one on the next. The second has
    // one corner on this ring and two on the next.
    let first = select(side, beside, is_second);
    let p = vertex_at(stances.here, select(own, other, is_second));
    var q: Vertex;
    if is_second {
        q = vertex_at(stances.next, other);
    } else {
        q = vertex_at(stances.here, other);
    }
    let r = vertex_at(stances.next, own);
    let shares = shares_of(p.clip, q.clip, r.clip, place);
    let normal = mat3x3(p.normal, q.normal, r.normal) * shares.corners;
    // The direction along the facet at its first corner. It is the direction of the fibres, because
    // a twisted yarn's corners turn with its twist.
    var fibre = r.position - p.position;
    if is_second {
        fibre = q.position - p.position;
    }
    let around = mat3x2(angle_of(first), angle_of(beside), angle_of(side)) * shares.corners;
    let past = shares.corners.z + select(0.0, shares.corners.y, is_second);
    let along = f32(block.first_ring + ring) + past;
    let angle = fract(atan2(around.y, around.x) / TAU);
    return kept_of(normal, fibre, angle, along, block.yarn, shares.is_front);
}

fn cap_at(number: u32, triangle: u32, place: vec2<i32>) -> vec4<u32> {
    let cap = cap_rows[number];
    let stance = cap_stance(cap, roll_of(cap.ring_vertex / params.sides));
    let outline = yarns[cap.yarn].section * params.sides;
    let first_corner = cap.first_corner + 3u * triangle;
    let p = vertex_at(stance, outlines[outline + cap_pattern[first_corner]]);
    let q = vertex_at(stance, outlines[outline + cap_pattern[first_corner + 1u]]);
    let r = vertex_at(stance, outlines[outline + cap_pattern[first_corner + 2u]]);
    let is_front = shares_of(p.clip, q.clip, r.clip, place).is_front;
    let normal = stance.tangent.xyz * select(1.0, -1.0, cap.end == 0u);
    return kept_of(normal, normal, 0.0, 0.0, cap.yarn | CUT, is_front);
}

// Part number `number` of the chunk's hairs, on the side that faces the eye.
fn hair_at(number: u32) -> vec4<u32> {
    let block = blocks[number / hairs_of_block()];
    let part = number % HAIR_PARTS;
    let noted = number % hairs_of_block() / HAIR_PARTS;
    let ring = noted / HAIRS_OF_GAP;
    let yarn = yarns[block.yarn];
    let seed = seed_of(block.yarn, block.first_ring + ring, noted % HAIRS_OF_GAP);
    let stances = stances_at(yarn, block, ring);
    let hair = hair_new(seed, yarn.section * params.sides, stances.here, stances.next);
    let direction = hair_direction(hair, part);
    let to_eye = view.eye.xyz - (hair.root - view.target_point) * view.eye.w;
    let facing = to_eye - direction * dot(to_eye, direction);
    let is_level = dot(facing, facing) > 1e-8 * dot(to_eye, to_eye);
    return kept_of(select(to_eye, facing, is_level), direction, 0.0, 0.0, block.yarn | HAIR, true);
}

fn kept_of_number(number: u32, place: vec2<i32>) -> vec4<u32> {
    if HAIRY && number >= first_hair() {
        return hair_at(number - first_hair());
    }
    let row = number / numbers_of_block();
    let triangle = number - row * numbers_of_block();
    if row < params.blocks {
        return tube_at(row, triangle, place);
    }
    return cap_at(row - params.blocks, triangle, place);
}

// The samples that a workgroup works out, each for itself and for the samples of its pixel that
// show the same. An entry has fields of bits. From the lowest on they are the pixel's lane (6
// bits), the sample (2), a bit for each sample of the pixel that shows anything (4), and a bit for
// each sample that is listed (4).
const RESOLVE_GROUP = SCREEN_GROUP * SCREEN_GROUP;
const SAMPLE_SHIFT = 6u;
const SHOWN_SHIFT = 8u;
const LISTED_SHIFT = 12u;
const_assert RESOLVE_GROUP == 1u << SAMPLE_SHIFT && SAMPLES == 4;
var<workgroup> wanted: array<u32, RESOLVE_GROUP * 4u>;
var<workgroup> wanted_count: atomic<u32>;

// The pixel of a lane, counted from the first row that has keys.
fn place_of_lane(group: vec3<u32>, lane: u32) -> vec2<u32> {
    return group.xy * SCREEN_GROUP + vec2(lane % SCREEN_GROUP, lane / SCREEN_GROUP);
}

// Lists the samples of a lane's pixel that are nearer than those of earlier chunks, and keeps their
// depths.
fn list_wanted(place: vec2<u32>, lane: u32) {
    let pixel = vec2(place.x, place.y + sweep.first_row);
    var shown = 0u;
    var own = 0u;
    var last = 0u;
    for (var sample = 0u; sample < u32(SAMPLES); sample++) {
        let key = keys[key_at(place.x, place.y, sample)];
        var nearest = 1.0;
        if sweep.is_first == 0u {
            nearest = textureLoad(depths, pixel, sample).x;
        }
        let depth = select(bitcast<f32>(~key.y), 1.0, key.y == 0u);
        if depth < nearest || sweep.is_first != 0u {
            textureStore(depths, pixel, sample, vec4(min(depth, nearest), 0.0, 0.0, 0.0));
        }
        if depth < nearest {
            shown |= 1u << sample;
            // Samples of one triangle in a pixel show the same, unless each is worked out at its
            // own place.
            if view.spread > 0.0 || key.x != last {
                own |= 1u << sample;
                last = key.x;
            }
        }
    }
    var at = atomicAdd(&wanted_count, countOneBits(own));
    for (var rest = own; rest != 0u; rest &= rest - 1u) {
        wanted[at] = lane | (firstTrailingBit(rest) << SAMPLE_SHIFT) | (shown << SHOWN_SHIFT) | (own << LISTED_SHIFT);
        at++;
    }
}

// A bit for each sample that an entry stands for: from its own sample to the one before the next
// that is listed.
fn alike_of(sample: u32, entry: u32) -> u32 {
    let shown = (entry >> SHOWN_SHIFT) & 15u;
    let later = (entry >> LISTED_SHIFT) & (30u << sample);
    let before_next = (later & (~later + 1u)) - 1u;
    return shown & before_next & (15u << sample);
}

// Works out the samples of a square of pixels. Each lane first takes a pixel, and lists those of
// its samples that have to be worked out. Then the lanes share the listed samples. Many samples are
// not listed, because they show the same as the sample before.
@compute @workgroup_size(SCREEN_GROUP, SCREEN_GROUP)
fn resolve(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    if lane == 0u {
        atomicStore(&wanted_count, 0u);
    }
    workgroupBarrier();
    let own_place = place_of_lane(group, lane);
    if own_place.x < u32(view.size.x) && own_place.y < sweep.rows {
        list_wanted(own_place, lane);
    }
    workgroupBarrier();
    let count = atomicLoad(&wanted_count);
    for (var k = lane; k < count; k += RESOLVE_GROUP) {
        let entry = wanted[k];
        let place = place_of_lane(group, entry & (RESOLVE_GROUP - 1u));
        let sample = (entry >> SAMPLE_SHIFT) & 3u;
        let pixel = vec2<i32>(vec2(place.x, place.y + sweep.first_row));
        // The samples are worked out in the pixel's middle, as rasterisers do. If triangles are
        // finer than pixels, each sample is worked out at its own place: the middle may lie far
        // outside, and the pattern of middles would beat with the triangles.
        let middle_of_pixel = pixel * 256 + 128 - middle();
        let at = select(middle_of_pixel, sample_place(pixel.x, 4 * pixel.y + i32(sample)), view.spread > 0.0);
        let kept = kept_of_number(~keys[key_at(place.x, place.y, sample)].x, at);
        for (var alike = alike_of(sample, entry); alike != 0u; alike &= alike - 1u) {
            let layer = firstTrailingBit(alike);
            textureStore(directions, pixel, layer, vec4(kept.xy, 0u, 0u));
            textureStore(places, pixel, layer, vec4(kept.zw, 0u, 0u));
        }
    }
}
