// The code that the kernels of a settling share: tables, places, intervals and chords.
//
// The formulas, the thresholds and the order of operations are those of texere-core (settling/),
// and settling.wgsl is the twin of this file. It is OpenCL C 1.2 without extensions. texere-gpu
// writes two things before this file: the core's constants, and FLATTENED, which is true if the
// code for yarns that are not round is needed.

#pragma OPENCL FP_CONTRACT OFF

// Rust: texere_gpu::SettlingParams, 96 bytes.
typedef struct {
    uint places;
    uint chords;
    uint yarns;
    uint flags;
    float unit;
    float per_mm;
    float s;
    float growth;
    float ease;
    float momentum;
    float half_gap;
    float tension;
    int period_x;
    int period_y;
    float frequency_x;
    float frequency_y;
    float diameter;
    float along;
    int low_x;
    int low_y;
    uint size_x;
    uint size_y;
    uint count_x;
    uint count_y;
} SettlingParams;

// Rust: texere_gpu::PlaceRow, 16 bytes.
typedef struct {
    uint tags;
    uint yarn;
    uint first_chord;
    float start_length;
} PlaceRow;

// Rust: texere_gpu::StrandRow, 32 bytes.
typedef struct {
    uint first;
    uint points;
    uint goes_on;
    int shift_x;
    int shift_y;
    uint length;
    uint padding[2];
} StrandRow;

// Rust: texere_gpu::ChordRow, 16 bytes.
typedef struct {
    uint place;
    uint from;
    uint to;
    float thickest;
} ChordRow;

// A place (Rust: Place) is a uint4: x, y and z in units (i32, as bits so that sums wrap), and two
// half floats. A chord, in the form that passes read, is two uint4. The first has the point where
// the chord begins and the place of its interval, the second the bits of the chord's span, mm, and
// of the largest half width or half height of the interval.

float dot3(float3 a, float3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

float length3(float3 a) {
    return sqrt(dot3(a, a));
}

// `value`, limited to the range from 0 to 1.
float share(float value) {
    return fmin(fmax(value, 0.0f), 1.0f);
}

// The way `units`, converted to mm.
float3 to_mm(const SettlingParams *params, uint3 units) {
    return (float3)((float)as_int(units.x), (float)as_int(units.y), (float)as_int(units.z)) * params->unit;
}

// The step `step`, mm, in whole units.
uint3 to_units(const SettlingParams *params, float3 step) {
    float3 units = step * params->per_mm;
    return (uint3)(as_uint(convert_int_sat(floor(units.x + 0.5f))), as_uint(convert_int_sat(floor(units.y + 0.5f))),
                   as_uint(convert_int_sat(floor(units.z + 0.5f))));
}

// Half width (x) and half height (y) at a place.
float2 halves(uint4 place) {
    uint both = place.w;
    return (float2)(vload_half(0, (const half *)&both), vload_half(1, (const half *)&both));
}

// ---- Interval: the spline between two places, from the first of them on ----

typedef struct {
    uint3 start;
    // Coefficients of u, u^2 and u^3, mm.
    float3 c1;
    float3 c2;
    float3 c3;
    // Half width and half height at the interval's beginning, and the growth of both to its end.
    float2 halves;
    float2 growth;
} Interval;

// The interval that begins at `place`.
Interval interval_at(const SettlingParams *params, __global const uint4 *places, uint place) {
    uint4 here = places[place];
    uint4 next = places[place + 1u];
    float3 a = to_mm(params, places[place - 1u].xyz - here.xyz);
    float3 b = to_mm(params, next.xyz - here.xyz);
    float3 c = to_mm(params, places[place + 2u].xyz - here.xyz);
    float s = params->s;
    Interval interval;
    interval.start = here.xyz;
    interval.c1 = (b - a) * s;
    interval.c2 = a * (2.0f * s) + b * (3.0f - 2.0f * s) - c * s;
    interval.c3 = (c - a) * s + b * (s - 2.0f);
    interval.halves = halves(here);
    interval.growth = halves(next) - interval.halves;
    return interval;
}

float3 interval_offset(const Interval *interval, float u) {
    return (interval->c1 + (interval->c2 + interval->c3 * u) * u) * u;
}

float3 interval_velocity(const Interval *interval, float u) {
    return interval->c1 + (interval->c2 * 2.0f + interval->c3 * (3.0f * u)) * u;
}

float3 interval_acceleration(const Interval *interval, float u) {
    return interval->c2 * 2.0f + interval->c3 * (6.0f * u);
}

// How far the yarn reaches from its centreline at `u` towards a unit vector, mm.
float interval_reach(const Interval *interval, float u, float3 towards) {
    float width = interval->halves.x + interval->growth.x * u;
    if (!FLATTENED) {
        return width;
    }
    float height = interval->halves.y + interval->growth.y * u;
    float3 tangent = interval_velocity(interval, u);
    float level = tangent.x * tangent.x + tangent.y * tangent.y;
    float square = level + tangent.z * tangent.z;
    if (width == height || level <= VERTICAL * square) {
        return width;
    }
    // Side is (-y, x, 0), and up is tangent x side, both divided by their lengths.
    float aside = (towards.y * tangent.x - towards.x * tangent.y) * width;
    float up = (towards.z * level - (towards.x * tangent.x + towards.y * tangent.y) * tangent.z) * height;
    return sqrt((aside * aside + up * up / square) / level);
}

// The length of an interval by Gauss's rule of three nodes, mm.
float interval_arc(const Interval *interval) {
    float outer = length3(interval_velocity(interval, GAUSS_1)) + length3(interval_velocity(interval, GAUSS_3));
    return outer * GAUSS_OUTER + length3(interval_velocity(interval, GAUSS_2)) * GAUSS_MIDDLE;
}

// ---- Chord ----

typedef struct {
    uint3 at;
    uint place;
    float3 span;
    // The largest half width or half height of its interval.
    float thickest;
} Chord;

Chord chord_of(__global const uint4 *chords, size_t number) {
    uint4 at = chords[2 * number];
    float4 span = as_float4(chords[2 * number + 1]);
    Chord chord;
    chord.at = at.xyz;
    chord.place = at.w;
    chord.span = span.xyz;
    chord.thickest = span.w;
    return chord;
}

// The middle of a chord, units.
uint3 chord_middle(const SettlingParams *params, const Chord *chord) {
    return chord->at + to_units(params, chord->span * 0.5f);
}

// The number of repeats to the image of chord `other` that is nearest to chord `one`. Chord `other`
// begins `way` from the beginning of chord `one`.
uint2 nearest_image(const SettlingParams *params, float3 one, float3 other, uint3 way) {
    float3 apart = to_mm(params, way) + (other - one) * 0.5f;
    return (uint2)(-as_uint(convert_int_sat(floor(apart.x * params->frequency_x + 0.5f))),
                   -as_uint(convert_int_sat(floor(apart.y * params->frequency_y + 0.5f))));
}

// The way to an image: `way`, moved by `image` repeats.
uint3 to_image(const SettlingParams *params, uint3 way, uint2 image) {
    return (uint3)(way.x + image.x * (uint)params->period_x, way.y + image.y * (uint)params->period_y, way.z);
}

// The places where two chords come nearest to one another, as shares of the chords. The second
// chord begins `way` from the beginning of the first.
float2 chords_nearest(float3 one, float3 other, float3 way) {
    float a = fmax(dot3(one, one), SHORT);
    float e = fmax(dot3(other, other), SHORT);
    float b = dot3(one, other);
    float c = -dot3(one, way);
    float f = -dot3(other, way);
    float determinant = a * e - b * b;
    // On parallel chords no place of the first is better than another, so its middle is taken.
    float first = 0.5f;
    if (determinant > PARALLEL * (a * e)) {
        first = share((b * f - c * e) / determinant);
    }
    float second = share((b * first + f) / e);
    return (float2)(share((b * second - c) / a), second);
}

#define SETTLING_CHORDS_GROUP 64

// Works out all chords from places, with one lane for each chord.
__kernel __attribute__((reqd_work_group_size(SETTLING_CHORDS_GROUP, 1, 1)))
void settling_chords(const SettlingParams params, __global const uint4 *places, __global const PlaceRow *place_rows,
                     __global const ChordRow *chord_rows, __global uint4 *chords) {
    uint number = get_global_id(0);
    if (number >= params.chords) {
        return;
    }
    ChordRow row = chord_rows[number];
    uint first = place_rows[row.place].first_chord;
    float pieces = (float)(place_rows[row.place + 1u].first_chord - first);
    uint piece = number - first;
    Interval interval = interval_at(&params, places, row.place);
    float3 from = interval_offset(&interval, (float)piece / pieces);
    float3 span = interval_offset(&interval, (float)(piece + 1u) / pieces) - from;
    chords[2 * (size_t)number] = (uint4)(interval.start + to_units(&params, from), row.place);
    chords[2 * (size_t)number + 1] = as_uint4((float4)(span, row.thickest));
}
