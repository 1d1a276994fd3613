// A thread that changes sides between two threads of the other set. This file follows crossings.cl.
//
// Its twins are crossings_passage.wgsl, and StraightPassage in texere-core (crossings/passage.rs).

// A straight passage over the first of two crossed threads and under the second, at the slope that
// leaves most room. The sections of the two crossed threads are ellipses.
typedef struct {
    // Cosine and sine of the slope.
    float2 slope;
    // How far each ellipse reaches at right angles to the slope.
    float2 reach;
    // The distance between the middles of both ellipses, at right angles to the slope.
    float between;
    // The room that both ellipses and the thread leave.
    float room;
} StraightPassage;

// How far two ellipses reach at right angles to a slope. `halves` has their half widths in x and z,
// and their half heights in y and w.
float2 reach_of(float2 slope, float4 halves) {
    float2 x = halves.xz * slope.y;
    float2 z = halves.yw * slope.x;
    return sqrt(x * x + z * z);
}

// The room that a slope leaves beside both ellipses.
float left_by(float across, float rise, float4 halves, float2 slope) {
    float2 reach = reach_of(slope, halves);
    return across * slope.y + rise * slope.x - reach.x - reach.y;
}

StraightPassage passage_of(float across, float rise, float4 halves, float thread) {
    const float2 level = (float2)(1.0f, 0.0f);
    const float2 upright = (float2)(0.0f, 1.0f);
    float distance = sqrt(across * across + rise * rise);
    float2 excess = halves.xz * halves.xz - halves.yw * halves.yw;
    // The steps below begin at the best of three slopes. One is the slope that is best for circles.
    // The others are level and upright, because wide ellipses may leave most room near these.
    float2 slope = rise > 0.0f ? (float2)(rise, across) / distance : upright;
    float most = left_by(across, rise, halves, slope);
    float left = left_by(across, rise, halves, level);
    if (left > most) {
        slope = level;
        most = left;
    }
    if (left_by(across, rise, halves, upright) > most) {
        slope = upright;
    }
    for (uint step = 0u; step < PASSAGE_STEPS; step++) {
        float c = slope.x;
        float s = slope.y;
        float2 reach = reach_of(slope, halves);
        float2 p = excess / reach;
        float steep = across * c - rise * s - s * c * (p.x + p.y);
        float curve = -(across * s + rise * c) - (c * c - s * s) * (p.x + p.y) +
                      s * s * c * c * (p.x * p.x / reach.x + p.y * p.y / reach.y);
        float turn = curve < -PASSAGE_CURVED * distance ? -steep / curve : steep / distance;
        turn = fmin(fmax(turn, -PASSAGE_TURN), PASSAGE_TURN);
        slope = (float2)(c - s * turn, s + c * turn);
        slope = slope / sqrt(slope.x * slope.x + slope.y * slope.y);
        if (slope.x < 0.0f) {
            slope = upright;
        }
        if (slope.y < 0.0f) {
            slope = level;
        }
    }
    StraightPassage passage;
    passage.slope = slope;
    passage.reach = reach_of(slope, halves);
    passage.between = across * slope.y + rise * slope.x;
    passage.room = passage.between - passage.reach.x - passage.reach.y - thread;
    return passage;
}
