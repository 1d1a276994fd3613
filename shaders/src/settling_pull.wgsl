// What pulls at the control points of intervals. After settling.wgsl, and after BLOCK: whether it is for the block form or for
// the weighted one, so that neither has registers for the other.
//
// settling_pull.cl is the twin of this file, and contact.rs and pass.rs of texere-core the definition.

@group(0) @binding(15) var<storage, read> places: array<vec4<i32>>;
@group(0) @binding(17) var<storage, read> chords: array<vec4<u32>>;
@group(0) @binding(20) var<storage, read> starts: array<u32>;
@group(0) @binding(21) var<storage, read> neighbours: array<u32>;
@group(0) @binding(22) var<storage, read> lengths: array<f32>;
@group(0) @binding(23) var<storage, read_write> pulls: array<f32>;
@group(0) @binding(24) var<storage, read_write> rows: array<SeenRow>;

// ---- Where two intervals come near one another ----

struct Contact {
    // Places on either interval.
    at: vec2<f32>,
    // The way from the first interval's place to the other's, mm, and its length.
    way: vec3<f32>,
    distance: f32,
}

// Two places, on intervals of which the second begins `way` from the first.
fn contact_at(one: Interval, other: Interval, way: vec3<f32>, at: vec2<f32>) -> Contact {
    let between = way + interval_offset(other, at.y) - interval_offset(one, at.x);
    return Contact(at, between, sqrt(inner(between, between)));
}

// The exact places near `at`: one step of Newton's method of at most `stride`, where that comes nearer.
fn contact_refined(one: Interval, other: Interval, way: vec3<f32>, at: vec2<f32>, stride: vec2<f32>) -> Contact {
    let start = contact_at(one, other, way, at);
    let velocity = interval_velocity(one, at.x);
    let other_velocity = interval_velocity(other, at.y);
    let squares = vec2(inner(velocity, velocity), inner(other_velocity, other_velocity));
    let slopes = vec2(-inner(start.way, velocity), inner(start.way, other_velocity));
    let bends = vec2(
        -inner(start.way, interval_acceleration(one, at.x)),
        inner(start.way, interval_acceleration(other, at.y)),
    );
    let h = max(max(squares + bends, STIFF * squares), vec2(SHORT));
    let mixed = -inner(velocity, other_velocity);
    let determinant = max(h.x * h.y - mixed * mixed, SKEW * (h.x * h.y));
    let step = vec2(mixed * slopes.y - h.y * slopes.x, mixed * slopes.x - h.x * slopes.y) / determinant;
    let next = min(max(at + min(max(step, -stride), stride), vec2(0.0)), vec2(1.0));
    let found = contact_at(one, other, way, next);
    if found.distance < start.distance {
        return found;
    }
    return start;
}

// The direction from the first interval's place to the other's. Where both are one, it is square to both yarns.
fn contact_direction(contact: Contact, velocity: vec3<f32>, other_velocity: vec3<f32>) -> vec3<f32> {
    var way = contact.way;
    if contact.distance <= ONE_PLACE {
        way = cross(velocity, other_velocity);
    }
    let length = inner(way, way);
    if length > 0.0 {
        return way * (1.0 / sqrt(length));
    }
    return vec3(0.0, 0.0, 1.0);
}

// ---- What pulls at an interval's control points ----

// At one of the four. In the weighted form: the sum of contacts' ways, mm, and of their weights; the same of bends. In the block
// form: the sum of all ways, and of the squares of their directions, each with its weight: xx; xy, xz, yy, yz; zz.
struct Slot {
    first: vec4<f32>,
    second: vec4<f32>,
    last: f32,
}

struct Pull {
    slots: array<Slot, 4>,
    // The least distance to another yarn, mm; the same over both yarns' reaches; the least radius of curvature, in diameters.
    near: f32,
    clearance: f32,
    radius: f32,
}

fn add_block(pull: ptr<function, Pull>, slot: u32, way: vec3<f32>, direction: vec3<f32>, weight: f32) {
    let weighted = direction * weight;
    (*pull).slots[slot].first += vec4(way, weighted.x * direction.x);
    (*pull).slots[slot].second += vec4(weighted.x * direction.yz, weighted.y * direction.yz);
    (*pull).slots[slot].last += weighted.z * direction.z;
}

// What each of an interval's four control points counts at `u`.
fn weights_at(u: f32) -> vec4<f32> {
    let s = settling.s;
    let square = u * u;
    let cube = u * u * u;
    let before = (2.0 * square - u - cube) * s;
    let behind = (cube - square) * s;
    let end = s * u + (3.0 - 2.0 * s) * square + (s - 2.0) * cube;
    return vec4(before, 1.0 - before - end - behind, end, behind);
}

// What each of them counts in the second derivative at `u`.
fn bends_at(u: f32) -> vec4<f32> {
    let s = settling.s;
    let before = (4.0 - 6.0 * u) * s;
    let behind = (6.0 * u - 2.0) * s;
    let end = 2.0 * (3.0 - 2.0 * s) + 6.0 * (s - 2.0) * u;
    return vec4(before, -(before + end + behind), end, behind);
}

// Adds a contact with another interval.
fn touch(pull: ptr<function, Pull>, tags: u32, one: Interval, other: Interval, contact: Contact) {
    let velocity = interval_velocity(one, contact.at.x);
    let other_velocity = interval_velocity(other, contact.at.y);
    let direction = contact_direction(contact, velocity, other_velocity);
    let reach = interval_reach(one, contact.at.x, velocity, direction)
        + interval_reach(other, contact.at.y, other_velocity, direction);
    (*pull).near = min((*pull).near, contact.distance);
    (*pull).clearance = min((*pull).clearance, contact.distance / reach);
    let lacks = MARGIN * settling.growth * reach - contact.distance;
    if lacks > 0.0 {
        let back = direction * (-0.5 * lacks);
        let weights = folded(tags, weights_at(contact.at.x));
        for (var slot = 0u; slot < 4u; slot++) {
            let way = back * weights[slot];
            let weight = CONTACT * abs(weights[slot]);
            if BLOCK {
                add_block(pull, slot, way, direction, weight);
            } else {
                (*pull).slots[slot].first += vec4(way, weight);
            }
        }
    }
}

// The share of its interval's length that place `on` of a chord is at (x), and what a chord is (y).
fn along_interval(number: u32, place: u32, on: f32) -> vec2<f32> {
    let first = place_rows[place].first_chord;
    let step = 1.0 / f32(place_rows[place + 1u].first_chord - first);
    return vec2((f32(number - first) + on) * step, step);
}

// Adds what a neighbour, chord `other_number`, does to chord `number` of an interval.
fn meet(pull: ptr<function, Pull>, tags: u32, number: u32, one: Chord, interval: Interval, other_number: u32) {
    let other = chord_of(chords[2u * other_number], chords[2u * other_number + 1u]);
    let found = nearest(one, other);
    let distance = sqrt(inner(found.apart, found.apart));
    let most = one.thickest + other.thickest;
    if distance >= NEAR * MARGIN * settling.growth * most {
        (*pull).near = min((*pull).near, distance);
        (*pull).clearance = min((*pull).clearance, distance / most);
        return;
    }
    let at = along_interval(number, one.place, found.shares.x);
    let other_at = along_interval(other_number, other.place, found.shares.y);
    let there = interval_of(other.place);
    let way = length_of(to_image(there.start - interval.start, found.image));
    let stride = STRIDE * vec2(at.y, other_at.y);
    touch(pull, tags, interval, there, contact_refined(interval, there, way, vec2(at.x, other_at.x), stride));
}

// The interval that begins at a place.
fn interval_of(place: u32) -> Interval {
    return interval_new(places[place - 1u], places[place], places[place + 1u], places[place + 2u]);
}

// Adds what the interval's own bends do.
fn bend(pull: ptr<function, Pull>, tags: u32, pieces: u32, interval: Interval) {
    let parts = max(pieces, BEND_PARTS);
    for (var part = 0u; part <= parts; part++) {
        let u = f32(part) / f32(parts);
        let velocity = interval_velocity(interval, u);
        let acceleration = interval_acceleration(interval, u);
        let square = max(inner(velocity, velocity), SHORT);
        let across = acceleration - velocity * (inner(acceleration, velocity) / square);
        let bend = sqrt(inner(across, across));
        if bend <= 0.0 {
            continue;
        }
        let towards = across * (1.0 / bend);
        let diameter = 2.0 * interval_reach(interval, u, velocity, towards);
        (*pull).radius = min((*pull).radius, square / (bend * diameter));
        let limit = square / (BEND_MARGIN * BEND_RADIUS * diameter * max(settling.growth, 0.5));
        let soft = SOFT_BEND * settling.ease;
        let excess = select(soft * bend, bend - limit + soft * limit, bend > limit);
        if excess > 0.0 {
            let bends = folded(tags, bends_at(u));
            let sum = abs(bends.x) + abs(bends.y) + abs(bends.z) + abs(bends.w);
            let way = towards * (excess / (sum * sum));
            for (var slot = 0u; slot < 4u; slot++) {
                let own = way * -bends[slot];
                let weight = abs(bends[slot]) / sum;
                if BLOCK {
                    add_block(pull, slot, own * BLOCK_BEND, towards, BLOCK_BEND * weight);
                } else {
                    (*pull).slots[slot].second += vec4(own, weight);
                }
            }
        }
    }
}

// How fast the spline moves at `u`.
fn speed(interval: Interval, u: f32) -> f32 {
    let velocity = interval_velocity(interval, u);
    return sqrt(inner(velocity, velocity));
}

fn write(plane: u32, place: u32, value: f32) {
    pulls[plane * settling.places + place] = value;
}

// Works out what pulls at the interval that begins at `place` and writes it down. Gives back the least clearance and radius, and by
// which share its length is off.
fn pull_of(place: u32) -> vec3<f32> {
    let row = place_rows[place];
    let end = place_rows[place + 1u].first_chord;
    let interval = interval_of(place);
    var pull: Pull;
    pull.near = UNSEEN;
    pull.clearance = UNSEEN;
    pull.radius = UNSEEN;
    for (var number = row.first_chord; number < end; number++) {
        let one = chord_of(chords[2u * number], chords[2u * number + 1u]);
        let last = min(starts[number + 1u], arrayLength(&neighbours));
        for (var slot = starts[number]; slot < last; slot++) {
            let other = neighbours[slot];
            // A number that is no chord's ends a list.
            if other >= settling.chords {
                break;
            }
            meet(&pull, row.tags, number, one, interval, other);
        }
    }
    bend(&pull, row.tags, end - row.first_chord, interval);
    let ends = speed(interval, GAUSS_1) + speed(interval, GAUSS_3);
    let arc = ends * GAUSS_OUTER + speed(interval, GAUSS_2) * GAUSS_MIDDLE;
    let chord = interval.c1 + interval.c2 + interval.c3;
    let span = sqrt(inner(chord, chord));
    var along = vec3(0.0);
    if span > 0.0 {
        along = chord * (1.0 / span);
    }
    let length = along * ((arc - lengths[place]) * 0.5);
    if BLOCK {
        add_block(&pull, 1u, length, along, 1.0);
        add_block(&pull, 2u, -length, along, 1.0);
    }
    for (var slot = 0u; slot < 4u; slot++) {
        let own = pull.slots[slot];
        for (var k = 0u; k < 4u; k++) {
            write(slot * SLOT_PLANES + k, place, own.first[k]);
            write(slot * SLOT_PLANES + 4u + k, place, own.second[k]);
        }
        if BLOCK {
            write(slot * SLOT_PLANES + 8u, place, own.last);
        }
    }
    for (var axis = 0u; axis < 3u; axis++) {
        write(4u * SLOT_PLANES + axis, place, length[axis]);
    }
    write(4u * SLOT_PLANES + 3u, place, arc);
    write(4u * SLOT_PLANES + 4u, place, pull.near);
    write(4u * SLOT_PLANES + 5u, place, pull.clearance);
    return vec3(pull.clearance, pull.radius, abs(arc - lengths[place]) / lengths[place]);
}

const PULL_GROUP = 64u;

var<workgroup> lane_seen: array<vec3<f32>, PULL_GROUP>;

// A lane a place, and a row of what was seen for each workgroup.
@compute @workgroup_size(PULL_GROUP)
fn settling_pull(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
                 @builtin(local_invocation_index) lane: u32) {
    let number = group.y * grid.x + group.x;
    let place = number * PULL_GROUP + lane;
    var seen = vec3(UNSEEN, UNSEEN, 0.0);
    if place < settling.places && (place_rows[place].tags & TAG_INTERVAL) != 0u {
        seen = pull_of(place);
    }
    lane_seen[lane] = seen;
    for (var reach = PULL_GROUP / 2u; reach > 0u; reach /= 2u) {
        workgroupBarrier();
        if lane < reach {
            let other = lane_seen[lane + reach];
            seen = vec3(min(seen.xy, other.xy), max(seen.z, other.z));
            lane_seen[lane] = seen;
        }
    }
    if lane == 0u && number * PULL_GROUP < settling.places {
        rows[number] = SeenRow(seen.x, seen.y, seen.z, 0.0);
    }
}
