// Contacts: the places where two intervals come near one another, and the pulls there. This file
// follows settling.wgsl, and comes before settling_pull.wgsl.
//
// settling_contact.cl is the twin of this file. The definition is in texere-core's contact.rs and
// in the first half of its pass.rs.

// The measures of an interval: the least distance to another yarn, mm; the least distance divided
// by the sum of both reaches; the least radius of curvature, in diameters.
struct Sight {
    near: f32,
    clearance: f32,
    radius: f32,
}

// A place on each of two intervals, and the way from the first place to the second.
struct Contact {
    at: vec2<f32>,
    way: vec3<f32>,
    distance: f32,
}

// The pull of a contact on the first interval's points: the step that the place on this interval
// should make, mm, the direction to the other yarn, and the weight of each of the four points. All
// weights are 0 if the contact does not pull.
struct Push {
    back: vec3<f32>,
    direction: vec3<f32>,
    weights: vec4<f32>,
}

// The weights of four points. The weight of a point beyond an open yarn's end goes to the points
// that it is made from.
fn folded(tags: u32, weights: vec4<f32>) -> vec4<f32> {
    var own = weights;
    if (tags & TAG_OPENS) != 0u {
        own = vec4(0.0, own.y + 2.0 * own.x, own.z - own.x, own.w);
    }
    if (tags & TAG_ENDS) != 0u {
        own = vec4(own.x, own.y - own.w, own.z + 2.0 * own.w, 0.0);
    }
    return own;
}

// The weight of each of an interval's four control points at `u`.
fn point_weights(u: f32) -> vec4<f32> {
    let s = settling.s;
    let square = u * u;
    let cube = u * u * u;
    let before = (2.0 * square - u - cube) * s;
    let behind = (cube - square) * s;
    let end = s * u + (3.0 - 2.0 * s) * square + (s - 2.0) * cube;
    return vec4(before, 1.0 - before - end - behind, end, behind);
}

fn contact_at(one: Interval, other: Interval, way: vec3<f32>, at: vec2<f32>) -> Contact {
    let between = way + interval_offset(other, at.y) - interval_offset(one, at.x);
    return Contact(at, between, length3(between));
}

// The exact places near `at`, by one step of Newton's method. The step is at most `stride` long,
// and is made only if the places come nearer to one another.
fn refined(one: Interval, other: Interval, way: vec3<f32>, at: vec2<f32>, stride: vec2<f32>) -> Contact {
    let start = contact_at(one, other, way, at);
    let velocity = interval_velocity(one, at.x);
    let other_velocity = interval_velocity(other, at.y);
    let squares = vec2(dot3(velocity, velocity), dot3(other_velocity, other_velocity));
    let slopes = vec2(-dot3(start.way, velocity), dot3(start.way, other_velocity));
    let bends = vec2(
        -dot3(start.way, interval_acceleration(one, at.x)),
        dot3(start.way, interval_acceleration(other, at.y)),
    );
    let h = max(max(squares + bends, squares * STIFF), vec2(SHORT));
    let mixed = -dot3(velocity, other_velocity);
    let determinant = max(h.x * h.y - mixed * mixed, SKEW * (h.x * h.y));
    let step = vec2(mixed * slopes.y - h.y * slopes.x, mixed * slopes.x - h.x * slopes.y) / determinant;
    let next = at + min(max(step, -stride), stride);
    let found = contact_at(one, other, way, vec2(share(next.x), share(next.y)));
    if found.distance < start.distance {
        return found;
    }
    return start;
}

// The direction from the first place to the second. If both places coincide, it is at right angles
// to both yarns.
fn contact_direction(contact: Contact, velocity: vec3<f32>, other_velocity: vec3<f32>) -> vec3<f32> {
    var way = contact.way;
    if contact.distance <= ONE_PLACE {
        way = vec3(
            velocity.y * other_velocity.z - velocity.z * other_velocity.y,
            velocity.z * other_velocity.x - velocity.x * other_velocity.z,
            velocity.x * other_velocity.y - velocity.y * other_velocity.x,
        );
    }
    let square = dot3(way, way);
    if square > 0.0 {
        return way * (1.0 / sqrt(square));
    }
    return vec3(0.0, 0.0, 1.0);
}

// The chord whose neighbours are visited: its number, the end of its list, and the chord itself.
struct ListedChord {
    number: u32,
    end: u32,
    chord: Chord,
}

// Goes on to the chord whose list has entry `next`.
fn go_to(here: ptr<function, ListedChord>, next: u32) {
    while next >= (*here).end {
        (*here).number += 1u;
        let number = (*here).number;
        (*here).end = starts[number + 1u];
        (*here).chord = chord_of(chords[2u * number], chords[2u * number + 1u]);
    }
}

// An interval whose chords are tested against their neighbours one after the other.
struct Meeting {
    interval: Interval,
    tags: u32,
    // The number of the interval's first chord, and one over the number of its chords.
    first: u32,
    step: f32,
}

// Another chord, and the places where it and the chord `here` come nearest to one another.
struct Approach {
    there: Chord,
    image: vec2<i32>,
    shares: vec2<f32>,
    distance: f32,
}

fn approach_of(here: Chord, number: u32) -> Approach {
    var approach: Approach;
    approach.there = chord_of(chords[2u * number], chords[2u * number + 1u]);
    let span = approach.there.span;
    let way = approach.there.at - here.at;
    approach.image = nearest_image(here.span, span, way);
    let between = to_mm(to_image(way, approach.image));
    approach.shares = chords_nearest(here.span, span, between);
    approach.distance = length3(between + span * approach.shares.y - here.span * approach.shares.x);
    return approach;
}

// Whether chord `number` may touch the chord `here`. If it may not, its distance goes into `sight`.
fn may_touch(here: Chord, number: u32, sight: ptr<function, Sight>) -> bool {
    let approach = approach_of(here, number);
    let most = here.thickest + approach.there.thickest;
    if approach.distance < NEAR * MARGIN * settling.growth * most {
        return true;
    }
    (*sight).near = min((*sight).near, approach.distance);
    (*sight).clearance = min((*sight).clearance, approach.distance / most);
    return false;
}

const MOST_AT_ONCE = 32u;

// A bit for each of the `count` neighbours from entry `begin` on, which is set if the neighbour may
// touch. Each lane first finds these neighbours, and then works out its contacts with them. Lanes
// that run in step thus work out contacts at the same time, and do not wait for one another at each
// neighbour.
fn touching(start: ListedChord, begin: u32, count: u32, sight: ptr<function, Sight>) -> u32 {
    var here = start;
    var bits = 0u;
    for (var entry = 0u; entry < count; entry++) {
        go_to(&here, begin + entry);
        let number = neighbours[begin + entry];
        // An entry that was left over has a number that is no chord's.
        if number < settling.chords {
            bits |= u32(may_touch(here.chord, number, sight)) << entry;
        }
    }
    return bits;
}

// The pull of the contact of chord `number` with the chord `here`.
fn meet(one: Meeting, here: ListedChord, number: u32, sight: ptr<function, Sight>) -> Push {
    var push: Push;
    let approach = approach_of(here.chord, number);
    let there = approach.there;
    let other = interval_at(there.place);
    let first = place_rows[there.place].first_chord;
    let step = vec2(one.step, 1.0 / f32(place_rows[there.place + 1u].first_chord - first));
    let piece = vec2(f32(here.number - one.first), f32(number - first));
    let at = (piece + approach.shares) * step;
    let apart = to_mm(to_image(other.start - one.interval.start, approach.image));
    let contact = refined(one.interval, other, apart, at, step * STRIDE);
    let velocity = interval_velocity(one.interval, contact.at.x);
    let direction = contact_direction(contact, velocity, interval_velocity(other, contact.at.y));
    let reach = interval_reach(one.interval, contact.at.x, direction) + interval_reach(other, contact.at.y, direction);
    (*sight).near = min((*sight).near, contact.distance);
    (*sight).clearance = min((*sight).clearance, contact.distance / reach);
    let lacks = MARGIN * settling.growth * reach - contact.distance;
    if lacks > 0.0 {
        push.back = direction * (-0.5 * lacks);
        push.direction = direction;
        push.weights = folded(one.tags, point_weights(contact.at.x));
    }
    return push;
}
