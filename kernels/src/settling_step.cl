// Steps of control points. This file follows settling.cl, settling_contact.cl and settling_pull.cl.
//
// Its twins are settling_step.wgsl, and Gathered in texere-core's pass.rs.

// Four intervals pull at a point. They begin at the next place, at the point's own place, at the
// place before it, and two places before it. In these four intervals the point has slots 0, 1, 2
// and 3. NOWHERE stands for an interval that the yarn does not have.
#define NOWHERE 0xffffffffu

uint interval_place(const StrandRow *strand, int number) {
    int count = (int)(strand->goes_on != 0u ? strand->points : strand->points - 1u);
    if (strand->goes_on != 0u) {
        number = number < 0 ? number + count : (number >= count ? number - count : number);
    }
    return number >= 0 && number < count ? strand->first + (uint)number : NOWHERE;
}

uint4 intervals_of(const StrandRow *strand, uint place) {
    int point = (int)(place - strand->first);
    return (uint4)(interval_place(strand, point + 1), interval_place(strand, point),
                   interval_place(strand, point - 1), interval_place(strand, point - 2));
}

// The value of interval `interval` in plane `plane`, or `nothing` if there is no interval.
float pulled(const SettlingParams *params, __global const float *pulls, uint plane, uint interval, float nothing) {
    return interval == NOWHERE ? nothing : pulls[plane * (size_t)params->places + interval];
}

// The sum of plane `plane` of the point's slots in all four intervals. A slot has `slot` planes.
float gathered(const SettlingParams *params, __global const float *pulls, uint4 intervals, uint slot, uint plane) {
    return pulled(params, pulls, plane, intervals.x, 0.0f) + pulled(params, pulls, slot + plane, intervals.y, 0.0f) +
           pulled(params, pulls, 2u * slot + plane, intervals.z, 0.0f) +
           pulled(params, pulls, 3u * slot + plane, intervals.w, 0.0f);
}

float3 gathered_way(const SettlingParams *params, __global const float *pulls, uint4 intervals, uint slot,
                    uint plane) {
    return (float3)(gathered(params, pulls, intervals, slot, plane),
                    gathered(params, pulls, intervals, slot, plane + 1u),
                    gathered(params, pulls, intervals, slot, plane + 2u));
}

float least_seen(const SettlingParams *params, __global const float *pulls, uint4 intervals, uint plane) {
    return fmin(fmin(pulled(params, pulls, plane, intervals.x, UNSEEN), pulled(params, pulls, plane, intervals.y, UNSEEN)),
                fmin(pulled(params, pulls, plane, intervals.z, UNSEEN), pulled(params, pulls, plane, intervals.w, UNSEEN)));
}

// The step along z by which the plates press a point, mm.
float press(const SettlingParams *params, uint4 place) {
    if ((params->flags & PLATES) == 0u) {
        return 0.0f;
    }
    float z = (float)as_int(place.z) * params->unit;
    return copysign(PRESS * params->ease * fmax(fabs(z) + halves(place).y - params->half_gap, 0.0f), -z);
}

// A step, limited to a share of the least distance to another yarn and to a share of the diameter.
float3 within_limits(float3 step, uint4 place, float near) {
    float2 both = halves(place);
    float diameter = 2.0f * fmin(both.x, both.y);
    float most = fmin(STEP_NEAR * near, STEP_DIAMETER * diameter);
    float length = length3(step);
    return length > most ? step * (most / length) : step;
}

float3 step_weighted(const SettlingParams *params, __global const float *pulls, uint4 intervals, uint4 place,
                     float3 last) {
    uint own = 4u * WEIGHTED_SLOT;
    float3 contact = gathered_way(params, pulls, intervals, WEIGHTED_SLOT, 0u);
    float contacts = gathered(params, pulls, intervals, WEIGHTED_SLOT, 3u);
    float3 bend = gathered_way(params, pulls, intervals, WEIGHTED_SLOT, 4u);
    float bends = gathered(params, pulls, intervals, WEIGHTED_SLOT, 7u);
    // If yarns are about to pass through one another, contact alone counts.
    float apart = share((least_seen(params, pulls, intervals, own + 5u) / params->growth - CROSSING) * CROSSING_SHARE);
    float3 length = (float3)(pulled(params, pulls, own, intervals.y, 0.0f) - pulled(params, pulls, own, intervals.z, 0.0f),
                             pulled(params, pulls, own + 1u, intervals.y, 0.0f) -
                                 pulled(params, pulls, own + 1u, intervals.z, 0.0f),
                             pulled(params, pulls, own + 2u, intervals.y, 0.0f) -
                                 pulled(params, pulls, own + 2u, intervals.z, 0.0f));
    float3 others = bend * (BEND / fmax(bends, BENDS_MIN)) + length + last * params->momentum;
    others.z += press(params, place);
    float3 step = contact * (1.0f / fmax(contacts, CONTACTS_MIN)) + others * apart;
    return within_limits(step, place, least_seen(params, pulls, intervals, own + 4u));
}

float3 step_block(const SettlingParams *params, __global const float *pulls, uint4 intervals, uint4 place,
                  float3 last) {
    float3 right = gathered_way(params, pulls, intervals, BLOCK_SLOT, 0u);
    float xx = gathered(params, pulls, intervals, BLOCK_SLOT, 3u) + INERTIA;
    float xy = gathered(params, pulls, intervals, BLOCK_SLOT, 4u);
    float xz = gathered(params, pulls, intervals, BLOCK_SLOT, 5u);
    float yy = gathered(params, pulls, intervals, BLOCK_SLOT, 6u) + INERTIA;
    float yz = gathered(params, pulls, intervals, BLOCK_SLOT, 7u);
    float zz = gathered(params, pulls, intervals, BLOCK_SLOT, 8u) + INERTIA;
    // Solves matrix * x = `right` by cofactors. The matrix is symmetric.
    float a = yy * zz - yz * yz;
    float b = xz * yz - xy * zz;
    float c = xy * yz - xz * yy;
    float d = xx * zz - xz * xz;
    float e = xy * xz - xx * yz;
    float f = xx * yy - xy * xy;
    float inverse = 1.0f / fmax(xx * a + xy * b + xz * c, INERTIA * INERTIA * INERTIA);
    float3 step = (float3)((a * right.x + b * right.y + c * right.z) * inverse,
                           (b * right.x + d * right.y + e * right.z) * inverse,
                           (c * right.x + e * right.y + f * right.z) * inverse);
    step += last * params->momentum;
    step.z += press(params, place);
    return within_limits(step, place, least_seen(params, pulls, intervals, 4u * BLOCK_SLOT + 4u));
}

// The length that an interval should have after a pass in which lengths are free. `plane` holds the
// lengths of all intervals.
float freed(const SettlingParams *params, __global const float *pulls, uint plane, uint4 intervals, float length,
            float start) {
    float sum = 0.0f;
    float count = 0.0f;
    uint beside[3] = {intervals.z, intervals.y, intervals.x};
    for (uint k = 0u; k < 3u; k++) {
        if (beside[k] != NOWHERE) {
            sum += pulled(params, pulls, plane, beside[k], 0.0f);
            count += 1.0f;
        }
    }
    float next = length + FREED * (sum / count - length) - params->tension * length;
    return fmin(fmax(next, FREE_LEAST * start), FREE_MOST * start);
}

// Makes the step of place `number`, and returns its length.
float take_step(const SettlingParams *params, bool block, __global const uint4 *places,
                __global const PlaceRow *place_rows, __global const StrandRow *strands, __global const float *pulls,
                __global float4 *steps, __global float *lengths, __global uint4 *next, uint number) {
    uint4 place = places[number];
    PlaceRow row = place_rows[number];
    StrandRow strand = strands[row.yarn];
    uint4 intervals = intervals_of(&strand, number);
    float3 step = (float3)(0.0f, 0.0f, 0.0f);
    if ((params->flags & LENGTHS_FREE) != 0u && (row.tags & TAG_INTERVAL) != 0u) {
        uint plane = 4u * (block ? BLOCK_SLOT : WEIGHTED_SLOT) + 3u;
        lengths[number] = freed(params, pulls, plane, intervals, lengths[number], row.start_length);
    }
    if ((row.tags & (TAG_POINT | TAG_PINNED)) == TAG_POINT) {
        float3 last = steps[number].xyz;
        step = block ? step_block(params, pulls, intervals, place, last)
                     : step_weighted(params, pulls, intervals, place, last);
        steps[number] = (float4)(step, 0.0f);
        place.xyz += to_units(params, step);
    }
    next[number] = place;
    return length3(step);
}

#define SETTLING_STEP_WEIGHTED_GROUP 64

// Makes the steps in the weighted form, with one lane for each place. The longest step of a
// workgroup goes into its row.
__kernel __attribute__((reqd_work_group_size(SETTLING_STEP_WEIGHTED_GROUP, 1, 1)))
void settling_step_weighted(const SettlingParams params, __global const uint4 *places,
                            __global const PlaceRow *place_rows, __global const StrandRow *strands,
                            __global const float *pulls, __global float4 *steps, __global float *lengths,
                            __global uint4 *next, __global float4 *rows) {
    __local float4 group[SETTLING_STEP_WEIGHTED_GROUP];
    uint number = get_global_id(0);
    float4 seen = (float4)(UNSEEN, UNSEEN, 0.0f, 0.0f);
    if (number < params.places) {
        seen.w = take_step(&params, false, places, place_rows, strands, pulls, steps, lengths, next, number);
    }
    seen = seen_by_group(group, get_local_id(0), SETTLING_STEP_WEIGHTED_GROUP, seen);
    if (get_local_id(0) == 0u) {
        rows[number / SETTLING_STEP_WEIGHTED_GROUP].w = seen.w;
    }
}

#define SETTLING_STEP_BLOCK_GROUP 64

// Makes the steps in the block form, with one lane for each place. The longest step of a workgroup
// goes into its row.
__kernel __attribute__((reqd_work_group_size(SETTLING_STEP_BLOCK_GROUP, 1, 1)))
void settling_step_block(const SettlingParams params, __global const uint4 *places,
                            __global const PlaceRow *place_rows, __global const StrandRow *strands,
                            __global const float *pulls, __global float4 *steps, __global float *lengths,
                            __global uint4 *next, __global float4 *rows) {
    __local float4 group[SETTLING_STEP_BLOCK_GROUP];
    uint number = get_global_id(0);
    float4 seen = (float4)(UNSEEN, UNSEEN, 0.0f, 0.0f);
    if (number < params.places) {
        seen.w = take_step(&params, true, places, place_rows, strands, pulls, steps, lengths, next, number);
    }
    seen = seen_by_group(group, get_local_id(0), SETTLING_STEP_BLOCK_GROUP, seen);
    if (get_local_id(0) == 0u) {
        rows[number / SETTLING_STEP_BLOCK_GROUP].w = seen.w;
    }
}

#define SETTLING_ENDS_GROUP 64

// The mirror image of `other` about the point `here`.
uint4 reflected(uint4 here, uint4 other) {
    return (uint4)(here.xyz + (here.xyz - other.xyz), here.w);
}

// Renews the places beyond the ends of yarns, with one lane for each yarn.
__kernel __attribute__((reqd_work_group_size(SETTLING_ENDS_GROUP, 1, 1)))
void settling_ends(const SettlingParams params, __global const StrandRow *strands, __global uint4 *places) {
    size_t yarn = get_global_id(0);
    if (yarn >= params.yarns) {
        return;
    }
    StrandRow strand = strands[yarn];
    uint first = strand.first;
    uint last = first + strand.points - 1u;
    if (strand.goes_on != 0u) {
        uint4 shift = (uint4)((uint)strand.shift_x * (uint)params.period_x,
                              (uint)strand.shift_y * (uint)params.period_y, 0u, 0u);
        places[first - 1u] = places[last] - shift;
        places[last + 1u] = places[first] + shift;
        places[last + 2u] = places[first + 1u] + shift;
    } else {
        uint4 end = reflected(places[last], places[last - 1u]);
        places[first - 1u] = reflected(places[first], places[first + 1u]);
        places[last + 1u] = end;
        places[last + 2u] = end;
    }
}
