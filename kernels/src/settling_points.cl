// Control points from settled places, and the box round them. This file follows settling.cl.
//
// The formulas are those of texere-core (Scale::point, renew_virtual_ends), and
// settling_points.wgsl is the twin of this file.

// Rust: texere_gpu::SettledParams, 32 bytes.
typedef struct {
    float origin[3];
    float unit;
    uint places;
    uint padding[3];
} SettledParams;

// Rust: texere_gpu::SettledRow, 32 bytes.
typedef struct {
    uint first_place;
    uint points;
    uint first_point;
    uint closed;
    uint start_halves;
    uint end_halves;
    uint padding[2];
} SettledRow;

// Rust: texere_gpu::BoundsRow, 32 bytes.
typedef struct {
    int4 low;
    int4 high;
} BoundsRow;

// The position of a place, mm: origin + units * unit, rounded once. Units are split into two parts
// that floats hold exactly. The rounding error of the first sum is added to the other part.
float3 position(const SettledParams *settled, __global const uint4 *places, uint place) {
    int3 units = as_int3(places[place].xyz);
    float3 origin = (float3)(settled->origin[0], settled->origin[1], settled->origin[2]);
    float3 high = convert_float3(units >> 12) * ((float)4096 * settled->unit);
    float3 low = convert_float3(units & 4095) * settled->unit;
    float3 sum = origin + high;
    float3 added = sum - origin;
    float3 lost = (origin - (sum - added)) + (high - added);
    return sum + (lost + low);
}

uint4 control_point(float3 position, uint halves) {
    return (uint4)(as_uint3(position), halves);
}

// Writes control points, with one lane for each place. The lane also writes the virtual ends that
// depend on its place.
#define SETTLING_POINTS_GROUP 64
__kernel __attribute__((reqd_work_group_size(SETTLING_POINTS_GROUP, 1, 1)))
void settling_points(const SettledParams settled,
                     __global const PlaceRow *place_rows,
                     __global const SettledRow *settled_rows,
                     __global const uint4 *places,
                     __global uint4 *points) {
    uint place = get_global_id(0);
    if (place >= settled.places || (place_rows[place].tags & TAG_POINT) == 0u) {
        return;
    }
    SettledRow yarn = settled_rows[place_rows[place].yarn];
    uint own = place - yarn.first_place;
    float3 here = position(&settled, places, place);
    uint4 point = control_point(here, places[place].w);
    points[yarn.first_point + own] = point;
    if (yarn.closed != 0u) {
        if (own == yarn.points - 1u) {
            points[yarn.first_point - 1u] = point;
        }
        if (own < 3u) {
            points[yarn.first_point + yarn.points + own] = point;
        }
        return;
    }
    if (own == 0u) {
        float3 next = position(&settled, places, place + 1u);
        points[yarn.first_point - 1u] = control_point(2.0f * here - next, yarn.start_halves);
    }
    if (own == yarn.points - 1u) {
        float3 before = position(&settled, places, place - 1u);
        points[yarn.first_point + yarn.points] = control_point(2.0f * here - before, yarn.end_halves);
    }
}

// Finds the box round all control points. Any number of workgroups share the places, and each
// writes a row.
#define SETTLING_BOUNDS_GROUP 256
__kernel __attribute__((reqd_work_group_size(SETTLING_BOUNDS_GROUP, 1, 1)))
void settling_bounds(const SettledParams settled,
                     __global const PlaceRow *place_rows,
                     __global const uint4 *places,
                     __global BoundsRow *bounds) {
    __local int4 lane_low[SETTLING_BOUNDS_GROUP];
    __local int4 lane_high[SETTLING_BOUNDS_GROUP];
    uint lane = get_local_id(0);
    int4 low = (int4)(2147483647);
    int4 high = (int4)(-2147483647);
    for (uint place = get_global_id(0); place < settled.places; place += get_global_size(0)) {
        if ((place_rows[place].tags & TAG_POINT) != 0u) {
            low = min(low, as_int4(places[place]));
            high = max(high, as_int4(places[place]));
        }
    }
    lane_low[lane] = low;
    lane_high[lane] = high;
    for (uint reach = SETTLING_BOUNDS_GROUP / 2u; reach > 0u; reach /= 2u) {
        barrier(CLK_LOCAL_MEM_FENCE);
        if (lane < reach) {
            low = min(low, lane_low[lane + reach]);
            high = max(high, lane_high[lane + reach]);
            lane_low[lane] = low;
            lane_high[lane] = high;
        }
    }
    if (lane == 0u) {
        bounds[get_group_id(0)].low = low;
        bounds[get_group_id(0)].high = high;
    }
}
