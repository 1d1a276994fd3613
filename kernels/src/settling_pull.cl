// Pulls at the four control points of each interval. This file follows settling.cl and
// settling_contact.cl.
//
// settling_pull.wgsl is the twin of this file, and Pull in texere-core's pass.rs is the definition.
// Pulls are added up in the order of the lists.
//
// Lanes write planes. A plane has a value for each place, which belongs to the interval that begins
// at the place. First come four slots of planes, one for each of the interval's control points. In
// the weighted form a slot has eight planes: the displacement by contacts (x, y, z, mm) and its
// weight, then the displacement by bends and its weight. In the block form a slot has nine planes:
// the displacement by all pulls (x, y, z, mm), and the products xx, xy, xz, yy, yz, zz of the
// components of their directions, each times its weight. Six planes follow the slots: a vector
// along the interval's chord, half as long as the interval's surplus length (x, y, z, mm); the
// interval's length, mm; the least distance to another yarn, mm; and the least ratio of such a
// distance to the sum of both yarns' reaches.

#define WEIGHTED_SLOT 8u
#define BLOCK_SLOT 9u

// The measures of two rows joined: the least clearance, the least radius of a bend, the largest
// error of a length, and the largest step.
float4 seen_by_both(float4 one, float4 other) {
    return (float4)(fmin(one.xy, other.xy), fmax(one.zw, other.zw));
}

// The pull of a bend at one place of an interval. `towards` is the direction in which the curve
// bends. `bends` has a weight for each control point, and `sum` is the sum of their sizes, 0 if the
// bend does not pull. The pull displaces a point by `-way` times the point's weight.
typedef struct {
    float3 towards;
    float3 way;
    float4 bends;
    float sum;
} Bend;

Bend bend_at(const SettlingParams *params, const Interval *interval, uint tags, float u, Sight *sight) {
    Bend bend;
    bend.sum = 0.0f;
    float3 velocity = interval_velocity(interval, u);
    float3 acceleration = interval_acceleration(interval, u);
    float square = fmax(dot3(velocity, velocity), SHORT);
    float3 across = acceleration - velocity * (dot3(acceleration, velocity) / square);
    float size = length3(across);
    if (!(size > 0.0f)) {
        return bend;
    }
    bend.towards = across * (1.0f / size);
    float diameter = 2.0f * interval_reach(interval, u, bend.towards);
    sight->radius = fmin(sight->radius, square / (size * diameter));
    float limit = square / (BEND_MARGIN * BEND_RADIUS * diameter * fmax(params->growth, 0.5f));
    float soft = SOFT_BEND * params->ease;
    float excess = size > limit ? size - limit + soft * limit : soft * size;
    if (excess > 0.0f) {
        float s = params->s;
        float before = (4.0f - 6.0f * u) * s;
        float after = (6.0f * u - 2.0f) * s;
        float end = 2.0f * (3.0f - 2.0f * s) + 6.0f * (s - 2.0f) * u;
        bend.bends = folded(tags, (float4)(before, -(before + end + after), end, after));
        bend.sum = fabs(bend.bends.x) + fabs(bend.bends.y) + fabs(bend.bends.z) + fabs(bend.bends.w);
        bend.way = bend.towards * (excess / (bend.sum * bend.sum));
    }
    return bend;
}

// The interval that begins at `place`.
Meeting meeting_at(const SettlingParams *params, __global const uint4 *places, __global const PlaceRow *place_rows,
                   uint place) {
    Meeting one;
    one.interval = interval_at(params, places, place);
    one.tags = place_rows[place].tags;
    one.first = place_rows[place].first_chord;
    one.step = 1.0f / (float)(place_rows[place + 1u].first_chord - one.first);
    return one;
}

// The start of a walk over the neighbours of an interval's chords, before the first neighbour.
// `go_to` walks on. `first` is the number of the interval's first chord.
ListedChord before_listed(__global const uint *starts, uint first) {
    ListedChord here;
    here.number = first - 1u;
    here.end = starts[first];
    return here;
}

// Writes the length and the distances of an interval from plane `plane` on, and returns the
// interval's measures.
float4 write_own(const SettlingParams *params, __global float *pulls, uint plane, uint place, float3 length,
                 float arc, float wanted, const Sight *sight) {
    size_t step = params->places;
    __global float *out = pulls + plane * step + place;
    out[0] = length.x;
    out[step] = length.y;
    out[2 * step] = length.z;
    out[3 * step] = arc;
    out[4 * step] = sight->near;
    out[5 * step] = sight->clearance;
    return (float4)(sight->clearance, sight->radius, fabs(arc - wanted) / wanted, 0.0f);
}

// The direction from an interval's beginning to its end.
float3 interval_along(const Interval *interval) {
    float3 chord = interval->c1 + interval->c2 + interval->c3;
    float length = length3(chord);
    return length > 0.0f ? chord * (1.0f / length) : (float3)(0.0f, 0.0f, 0.0f);
}

// Writes the ways and weights of four slots, from plane `plane` of each slot on.
void write_ways(const SettlingParams *params, __global float *pulls, uint plane, uint place, const float4 *ways) {
    for (uint slot = 0u; slot < 4u; slot++) {
        size_t step = params->places;
        __global float *out = pulls + (slot * WEIGHTED_SLOT + plane) * step + place;
        out[0] = ways[slot].x;
        out[step] = ways[slot].y;
        out[2 * step] = ways[slot].z;
        out[3 * step] = ways[slot].w;
    }
}

float4 pull_weighted(const SettlingParams *params, __global const uint4 *places, __global const PlaceRow *place_rows,
                     __global const uint4 *chords, __global const uint *starts, __global const uint *neighbours,
                     __global const float *lengths, __global float *pulls, uint place) {
    Meeting one = meeting_at(params, places, place_rows, place);
    ListedChord here = before_listed(starts, one.first);
    Sight sight = {UNSEEN, UNSEEN, UNSEEN};
    uint pieces = place_rows[place + 1u].first_chord - one.first;
    uint end = starts[one.first + pieces];
    float4 ways[4] = {(float4)(0.0f), (float4)(0.0f), (float4)(0.0f), (float4)(0.0f)};
    for (uint begin = here.end; begin < end; begin += MOST_AT_ONCE) {
        uint count = min(end - begin, MOST_AT_ONCE);
        uint bits = touching(params, here, chords, starts, neighbours, begin, count, &sight);
        while (bits != 0u) {
            uint next = begin + 31u - clz(bits & -bits);
            bits &= bits - 1u;
            go_to(&here, chords, starts, next);
            Push push = meet(params, &one, &here, places, place_rows, chords, neighbours[next], &sight);
            float4 weights = push.weights;
            if (any(weights != 0.0f)) {
                ways[0] += (float4)(push.back * weights.x, CONTACT * fabs(weights.x));
                ways[1] += (float4)(push.back * weights.y, CONTACT * fabs(weights.y));
                ways[2] += (float4)(push.back * weights.z, CONTACT * fabs(weights.z));
                ways[3] += (float4)(push.back * weights.w, CONTACT * fabs(weights.w));
            }
        }
    }
    write_ways(params, pulls, 0u, place, ways);
    ways[0] = ways[1] = ways[2] = ways[3] = (float4)(0.0f);
    uint parts = max(pieces, BEND_PARTS);
    for (uint part = 0u; part <= parts; part++) {
        Bend bend = bend_at(params, &one.interval, one.tags, (float)part / (float)parts, &sight);
        if (bend.sum > 0.0f) {
            ways[0] += (float4)(bend.way * -bend.bends.x, fabs(bend.bends.x) / bend.sum);
            ways[1] += (float4)(bend.way * -bend.bends.y, fabs(bend.bends.y) / bend.sum);
            ways[2] += (float4)(bend.way * -bend.bends.z, fabs(bend.bends.z) / bend.sum);
            ways[3] += (float4)(bend.way * -bend.bends.w, fabs(bend.bends.w) / bend.sum);
        }
    }
    write_ways(params, pulls, 4u, place, ways);
    float arc = interval_arc(&one.interval);
    float3 length = interval_along(&one.interval) * ((arc - lengths[place]) * 0.5f);
    return write_own(params, pulls, 4u * WEIGHTED_SLOT, place, length, arc, lengths[place], &sight);
}

// The sum of all ways at a point, and the sum of the squares of their directions.
typedef struct {
    float3 way;
    // xx, xy, xz and yy, yz, zz.
    float3 with_x;
    float3 others;
} Block;

void add_block(Block *slot, float3 way, float3 direction, float weight) {
    float3 counted = direction * weight;
    slot->way += way;
    slot->with_x += direction * counted.x;
    slot->others += (float3)(counted.y * direction.y, counted.y * direction.z, counted.z * direction.z);
}

float4 pull_block(const SettlingParams *params, __global const uint4 *places, __global const PlaceRow *place_rows,
                  __global const uint4 *chords, __global const uint *starts, __global const uint *neighbours,
                  __global const float *lengths, __global float *pulls, uint place) {
    Meeting one = meeting_at(params, places, place_rows, place);
    ListedChord here = before_listed(starts, one.first);
    Sight sight = {UNSEEN, UNSEEN, UNSEEN};
    uint pieces = place_rows[place + 1u].first_chord - one.first;
    uint end = starts[one.first + pieces];
    Block slots[4];
    for (uint slot = 0u; slot < 4u; slot++) {
        slots[slot].way = slots[slot].with_x = slots[slot].others = (float3)(0.0f, 0.0f, 0.0f);
    }
    for (uint begin = here.end; begin < end; begin += MOST_AT_ONCE) {
        uint count = min(end - begin, MOST_AT_ONCE);
        uint bits = touching(params, here, chords, starts, neighbours, begin, count, &sight);
        while (bits != 0u) {
            uint next = begin + 31u - clz(bits & -bits);
            bits &= bits - 1u;
            go_to(&here, chords, starts, next);
            Push push = meet(params, &one, &here, places, place_rows, chords, neighbours[next], &sight);
            float4 weights = push.weights;
            if (any(weights != 0.0f)) {
                add_block(&slots[0], push.back * weights.x, push.direction, CONTACT * fabs(weights.x));
                add_block(&slots[1], push.back * weights.y, push.direction, CONTACT * fabs(weights.y));
                add_block(&slots[2], push.back * weights.z, push.direction, CONTACT * fabs(weights.z));
                add_block(&slots[3], push.back * weights.w, push.direction, CONTACT * fabs(weights.w));
            }
        }
    }
    uint parts = max(pieces, BEND_PARTS);
    for (uint part = 0u; part <= parts; part++) {
        Bend bend = bend_at(params, &one.interval, one.tags, (float)part / (float)parts, &sight);
        if (bend.sum > 0.0f) {
            float4 weights = fabs(bend.bends) / bend.sum * BLOCK_BEND;
            add_block(&slots[0], bend.way * -bend.bends.x * BLOCK_BEND, bend.towards, weights.x);
            add_block(&slots[1], bend.way * -bend.bends.y * BLOCK_BEND, bend.towards, weights.y);
            add_block(&slots[2], bend.way * -bend.bends.z * BLOCK_BEND, bend.towards, weights.z);
            add_block(&slots[3], bend.way * -bend.bends.w * BLOCK_BEND, bend.towards, weights.w);
        }
    }
    float arc = interval_arc(&one.interval);
    float3 along = interval_along(&one.interval);
    float3 length = along * ((arc - lengths[place]) * 0.5f);
    add_block(&slots[1], length, along, 1.0f);
    add_block(&slots[2], -length, along, 1.0f);
    size_t step = params->places;
    for (uint slot = 0u; slot < 4u; slot++) {
        __global float *out = pulls + slot * BLOCK_SLOT * step + place;
        out[0] = slots[slot].way.x;
        out[step] = slots[slot].way.y;
        out[2 * step] = slots[slot].way.z;
        out[3 * step] = slots[slot].with_x.x;
        out[4 * step] = slots[slot].with_x.y;
        out[5 * step] = slots[slot].with_x.z;
        out[6 * step] = slots[slot].others.x;
        out[7 * step] = slots[slot].others.y;
        out[8 * step] = slots[slot].others.z;
    }
    return write_own(params, pulls, 4u * BLOCK_SLOT, place, length, arc, lengths[place], &sight);
}

// The measures of a workgroup, whose number of lanes is a power of two. Lanes are joined in pairs,
// always the same ones. The result is valid in lane 0.
float4 seen_by_group(__local float4 *rows, uint lane, uint lanes, float4 seen) {
    rows[lane] = seen;
    for (uint reach = lanes / 2u; reach > 0u; reach /= 2u) {
        barrier(CLK_LOCAL_MEM_FENCE);
        if (lane < reach) {
            rows[lane] = seen_by_both(rows[lane], rows[lane + reach]);
        }
    }
    return rows[0];
}

#define SETTLING_PULL_WEIGHTED_GROUP 64

// Works out the pulls of all intervals in the weighted form, with one lane for each place at which
// an interval may begin. Each workgroup writes a row of its measures.
__kernel __attribute__((reqd_work_group_size(SETTLING_PULL_WEIGHTED_GROUP, 1, 1)))
void settling_pull_weighted(const SettlingParams params, __global const uint4 *places,
                            __global const PlaceRow *place_rows, __global const uint4 *chords,
                            __global const uint *starts, __global const uint *neighbours,
                            __global const float *lengths, __global float *pulls, __global float4 *rows) {
    __local float4 group[SETTLING_PULL_WEIGHTED_GROUP];
    uint place = get_global_id(0);
    float4 seen = (float4)(UNSEEN, UNSEEN, 0.0f, 0.0f);
    if (place < params.places && (place_rows[place].tags & TAG_INTERVAL) != 0u) {
        seen = pull_weighted(&params, places, place_rows, chords, starts, neighbours, lengths, pulls, place);
    }
    seen = seen_by_group(group, get_local_id(0), SETTLING_PULL_WEIGHTED_GROUP, seen);
    if (get_local_id(0) == 0u) {
        rows[place / SETTLING_PULL_WEIGHTED_GROUP] = seen;
    }
}

#define SETTLING_PULL_BLOCK_GROUP 64

// Works out the pulls of all intervals in the block form, with one lane for each place at which an
// interval may begin. Each workgroup writes a row of its measures.
__kernel __attribute__((reqd_work_group_size(SETTLING_PULL_BLOCK_GROUP, 1, 1)))
void settling_pull_block(const SettlingParams params, __global const uint4 *places,
                         __global const PlaceRow *place_rows, __global const uint4 *chords,
                         __global const uint *starts, __global const uint *neighbours,
                         __global const float *lengths, __global float *pulls, __global float4 *rows) {
    __local float4 group[SETTLING_PULL_BLOCK_GROUP];
    uint place = get_global_id(0);
    float4 seen = (float4)(UNSEEN, UNSEEN, 0.0f, 0.0f);
    if (place < params.places && (place_rows[place].tags & TAG_INTERVAL) != 0u) {
        seen = pull_block(&params, places, place_rows, chords, starts, neighbours, lengths, pulls, place);
    }
    seen = seen_by_group(group, get_local_id(0), SETTLING_PULL_BLOCK_GROUP, seen);
    if (get_local_id(0) == 0u) {
        rows[place / SETTLING_PULL_BLOCK_GROUP] = seen;
    }
}

#define SETTLING_SEEN_GROUP 256

// Joins the rows of all workgroups. It runs as one workgroup.
__kernel __attribute__((reqd_work_group_size(SETTLING_SEEN_GROUP, 1, 1)))
void settling_seen(const uint count, __global const float4 *rows, __global float4 *all) {
    __local float4 group[SETTLING_SEEN_GROUP];
    uint lane = get_local_id(0);
    float4 seen = (float4)(UNSEEN, UNSEEN, 0.0f, 0.0f);
    for (size_t row = lane; row < count; row += SETTLING_SEEN_GROUP) {
        seen = seen_by_both(seen, rows[row]);
    }
    seen = seen_by_group(group, lane, SETTLING_SEEN_GROUP, seen);
    if (lane == 0u) {
        all[0] = seen;
    }
}
