// Contacts: the places where two intervals come near one another, and the pulls there. This file
// follows settling.cl.
//
// Its twins are settling_contact.wgsl, and texere-core's contact.rs and the first half of its
// pass.rs.

// The measures of an interval: the least distance to another yarn, mm; the least distance divided
// by the sum of both reaches; the least radius of curvature, in diameters.
typedef struct {
    float near;
    float clearance;
    float radius;
} Sight;

// A place on each of two intervals, and the way from the first place to the second.
typedef struct {
    float2 at;
    float3 way;
    float distance;
} Contact;

// The pull of a contact on the first interval's points: the step that the place on this interval
// should make, mm, the direction to the other yarn, and the weight of each of the four points. All
// weights are 0 if the contact does not pull.
typedef struct {
    float3 back;
    float3 direction;
    float4 weights;
} Push;

// The weights of four points. The weight of a point beyond an open yarn's end goes to the points
// that it is made from.
float4 folded(uint tags, float4 weights) {
    if ((tags & TAG_OPENS) != 0u) {
        weights = (float4)(0.0f, weights.y + 2.0f * weights.x, weights.z - weights.x, weights.w);
    }
    if ((tags & TAG_ENDS) != 0u) {
        weights = (float4)(weights.x, weights.y - weights.w, weights.z + 2.0f * weights.w, 0.0f);
    }
    return weights;
}

// The weight of each of an interval's four control points at `u`.
float4 point_weights(float u, float s) {
    float square = u * u;
    float cube = u * u * u;
    float before = (2.0f * square - u - cube) * s;
    float after = (cube - square) * s;
    float end = s * u + (3.0f - 2.0f * s) * square + (s - 2.0f) * cube;
    return (float4)(before, 1.0f - before - end - after, end, after);
}

Contact contact_at(const Interval *one, const Interval *other, float3 way, float2 at) {
    Contact contact;
    contact.at = at;
    contact.way = way + interval_offset(other, at.y) - interval_offset(one, at.x);
    contact.distance = length3(contact.way);
    return contact;
}

// The exact places near `at`, by one step of Newton's method. The step is at most `stride` long,
// and is made only if the places come nearer to one another.
Contact refined(const Interval *one, const Interval *other, float3 way, float2 at, float2 stride) {
    Contact start = contact_at(one, other, way, at);
    float3 velocity = interval_velocity(one, at.x);
    float3 other_velocity = interval_velocity(other, at.y);
    float2 squares = (float2)(dot3(velocity, velocity), dot3(other_velocity, other_velocity));
    float2 slopes = (float2)(-dot3(start.way, velocity), dot3(start.way, other_velocity));
    float2 bends = (float2)(-dot3(start.way, interval_acceleration(one, at.x)),
                            dot3(start.way, interval_acceleration(other, at.y)));
    float2 h = fmax(fmax(squares + bends, squares * STIFF), SHORT);
    float mixed = -dot3(velocity, other_velocity);
    float determinant = fmax(h.x * h.y - mixed * mixed, SKEW * (h.x * h.y));
    float2 step = (float2)((mixed * slopes.y - h.y * slopes.x) / determinant,
                           (mixed * slopes.x - h.x * slopes.y) / determinant);
    float2 next = at + fmin(fmax(step, -stride), stride);
    Contact found = contact_at(one, other, way, (float2)(share(next.x), share(next.y)));
    if (found.distance < start.distance) {
        return found;
    }
    return start;
}

// The direction from the first place to the second. If both places coincide, it is at right angles
// to both yarns.
float3 contact_direction(const Contact *contact, float3 velocity, float3 other_velocity) {
    float3 way = contact->way;
    if (!(contact->distance > ONE_PLACE)) {
        way = (float3)(velocity.y * other_velocity.z - velocity.z * other_velocity.y,
                       velocity.z * other_velocity.x - velocity.x * other_velocity.z,
                       velocity.x * other_velocity.y - velocity.y * other_velocity.x);
    }
    float square = dot3(way, way);
    return square > 0.0f ? way * (1.0f / sqrt(square)) : (float3)(0.0f, 0.0f, 1.0f);
}

// The chord whose neighbours are visited: its number, the end of its list, and the chord itself.
typedef struct {
    uint number;
    uint end;
    Chord chord;
} ListedChord;

// Goes on to the chord whose list has entry `next`.
void go_to(ListedChord *here, __global const uint4 *chords, __global const uint *starts, uint next) {
    while (next >= here->end) {
        here->number += 1u;
        here->end = starts[here->number + 1u];
        here->chord = chord_of(chords, here->number);
    }
}

// An interval whose chords are tested against their neighbours one after the other.
typedef struct {
    Interval interval;
    uint tags;
    // The number of the interval's first chord, and one over the number of its chords.
    uint first;
    float step;
} Meeting;

// Another chord, and the places where it and the chord `here` come nearest to one another.
typedef struct {
    Chord there;
    uint2 image;
    float2 shares;
    float distance;
} Approach;

Approach approach_of(const SettlingParams *params, const Chord *here, __global const uint4 *chords, size_t number) {
    Approach approach;
    approach.there = chord_of(chords, number);
    float3 span = approach.there.span;
    uint3 way = approach.there.at - here->at;
    approach.image = nearest_image(params, here->span, span, way);
    float3 between = to_mm(params, to_image(params, way, approach.image));
    approach.shares = chords_nearest(here->span, span, between);
    approach.distance = length3(between + span * approach.shares.y - here->span * approach.shares.x);
    return approach;
}

// Whether chord `number` may touch the chord `here`. If it may not, its distance goes into `sight`.
bool may_touch(const SettlingParams *params, const Chord *here, __global const uint4 *chords, size_t number,
               Sight *sight) {
    Approach approach = approach_of(params, here, chords, number);
    float most = here->thickest + approach.there.thickest;
    if (approach.distance < NEAR * MARGIN * params->growth * most) {
        return true;
    }
    sight->near = fmin(sight->near, approach.distance);
    sight->clearance = fmin(sight->clearance, approach.distance / most);
    return false;
}

#define MOST_AT_ONCE 32u

// A bit for each of the `count` neighbours from entry `begin` on, which is set if the neighbour may
// touch. Each lane first finds these neighbours, and then works out its contacts with them. Lanes
// that run in step thus work out contacts at the same time, and do not wait for one another at each
// neighbour.
uint touching(const SettlingParams *params, ListedChord here, __global const uint4 *chords,
              __global const uint *starts, __global const uint *neighbours, uint begin, uint count, Sight *sight) {
    uint bits = 0u;
    for (uint entry = 0u; entry < count; entry++) {
        go_to(&here, chords, starts, begin + entry);
        if (may_touch(params, &here.chord, chords, neighbours[begin + entry], sight)) {
            bits |= 1u << entry;
        }
    }
    return bits;
}

// The pull of the contact of chord `number` with the chord `here`.
Push meet(const SettlingParams *params, const Meeting *one, const ListedChord *here, __global const uint4 *places,
          __global const PlaceRow *place_rows, __global const uint4 *chords, size_t number, Sight *sight) {
    Push push;
    push.weights = (float4)(0.0f, 0.0f, 0.0f, 0.0f);
    Approach approach = approach_of(params, &here->chord, chords, number);
    Chord there = approach.there;
    Interval other = interval_at(params, places, there.place);
    uint first = place_rows[there.place].first_chord;
    float2 step = (float2)(one->step, 1.0f / (float)(place_rows[there.place + 1u].first_chord - first));
    float2 piece = (float2)((float)(here->number - one->first), (float)(uint)(number - first));
    float2 place = (piece + approach.shares) * step;
    float3 apart = to_mm(params, to_image(params, other.start - one->interval.start, approach.image));
    Contact contact = refined(&one->interval, &other, apart, place, step * STRIDE);
    float3 direction = contact_direction(&contact, interval_velocity(&one->interval, contact.at.x),
                                         interval_velocity(&other, contact.at.y));
    float reach = interval_reach(&one->interval, contact.at.x, direction) +
                  interval_reach(&other, contact.at.y, direction);
    sight->near = fmin(sight->near, contact.distance);
    sight->clearance = fmin(sight->clearance, contact.distance / reach);
    float lacks = MARGIN * params->growth * reach - contact.distance;
    if (lacks > 0.0f) {
        push.back = direction * (-0.5f * lacks);
        push.direction = direction;
        push.weights = folded(one->tags, point_weights(contact.at.x, params->s));
    }
    return push;
}
