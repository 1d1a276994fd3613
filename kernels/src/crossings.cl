// The code that the kernels of crossings share: tables, sites, and the block that is gathered at a
// site.
//
// The formulas, the thresholds and the order of operations are those of texere-core (crossings/),
// and crossings.wgsl is the twin of this file. It is OpenCL C 1.2 without extensions. The constants
// are the core's. texere-gpu writes them before this file.

#pragma OPENCL FP_CONTRACT OFF

// Rust: texere_gpu::CrossingsParams, 48 bytes.
typedef struct {
    uint crossings;
    uint ends;
    uint picks;
    uint flags;
    float tension_warp;
    float tension_weft;
    float press;
    float penalty;
    float area;
    uint pass_number;
    uint padding[2];
} CrossingsParams;

// Rust: texere_gpu::ThreadRow, 32 bytes.
typedef struct {
    float gap;
    float radius;
    float stiffness;
    float aspect;
    float shape;
    float least_area;
    float freedom;
    float height;
} ThreadRow;

// A lie (Rust: ThreadState) is the state of a thread at a crossing, a float4: shift, height, half
// width, half height. A crossing is two lies, that of its end and that of its pick.

// The input of all lanes.
typedef struct {
    const CrossingsParams *params;
    __global const ThreadRow *threads;
    // Rust: texere_gpu::CrossingSite.
    __global const uint *sites;
    // The lies with momentum added, which this pass reads.
    __global const float4 *found;
} Cloth;

#define WARP 0u
#define WEFT 1u

// ---- Site: an end (x) and a pick (y) ----

#define NOWHERE 0xffffffffu

// The number that lies `by` after `at`, of the numbers from 0 to `count` - 1. If the numbers
// repeat, the first follows the last. Otherwise a number before the first or after the last is
// NOWHERE.
uint further(uint at, int by, uint count, bool repeats) {
    int way = (int)at + by;
    int whole = (int)count;
    if (way >= 0 && way < whole) {
        return (uint)way;
    }
    return repeats ? (uint)(by < 0 ? way + whole : way - whole) : NOWHERE;
}

// The crossing that lies `along` crossings further along a thread of set `of_set`, and `across`
// threads of that set to the side.
uint2 beside(const Cloth *cloth, uint2 site, uint of_set, int along, int across) {
    int ends = of_set == WARP ? across : along;
    int picks = of_set == WARP ? along : across;
    return (uint2)(further(site.x, ends, cloth->params->ends, (cloth->params->flags & REPEATS_ENDS) != 0u),
                   further(site.y, picks, cloth->params->picks, (cloth->params->flags & REPEATS_PICKS) != 0u));
}

bool is_there(uint2 site) {
    return site.x != NOWHERE && site.y != NOWHERE;
}

uint number_of(const Cloth *cloth, uint2 site) {
    return site.y * cloth->params->ends + site.x;
}

// The lie of a set's thread at a site.
float4 lie_of(const Cloth *cloth, uint2 site, uint of_set) {
    return cloth->found[2u * (size_t)number_of(cloth, site) + of_set];
}

// The thread of a set at a site. Ends come first in the table.
ThreadRow thread_of(const Cloth *cloth, uint2 site, uint of_set) {
    return cloth->threads[of_set == WARP ? site.x : cloth->params->ends + site.y];
}

// The distance from a set's thread at a site to the thread `steps` after it.
float way_of(const Cloth *cloth, uint2 site, uint of_set, int steps) {
    float way = thread_of(cloth, site, of_set).gap;
    for (int step = 1; step < steps; step++) {
        uint2 next = beside(cloth, site, of_set, 0, step);
        way += is_there(next) ? thread_of(cloth, next, of_set).gap : 0.0f;
    }
    return way;
}

// The side on which a set's thread lies: 1 on the face, -1 on the back.
float side_of(const Cloth *cloth, uint2 site, uint of_set) {
    bool up = (cloth->sites[number_of(cloth, site)] & SITE_UP) != 0u;
    return up == (of_set == WARP) ? 1.0f : -1.0f;
}

// The distances, in threads, from the crossing's thread of a set to the nearest threads of that set
// on its level, before and after it. A distance is 0 if there is no such thread.
int2 steps_of(const Cloth *cloth, uint2 site, uint of_set) {
    uint word = cloth->sites[number_of(cloth, site)] >> (2u * SITE_STEPS * of_set);
    uint steps = (1u << SITE_STEPS) - 1u;
    return (int2)((int)(word & steps), (int)((word >> SITE_STEPS) & steps));
}

// ---- CrossingBlock: the energy's slope and curvature in the eight unknowns of a crossing ----

// A block is described from one set. `own` holds the slopes in that set's four unknowns, and
// `crossed` the slopes in those of the other set. Row k of `own_own` holds the curvatures in
// unknown k and all own unknowns, row k of `own_crossed` those in unknown k and the unknowns of the
// other set. Only entries up to the diagonal of `own_own` and `crossed_crossed` are used.
typedef struct {
    float4 own;
    float4 crossed;
    float4 own_own[4];
    float4 own_crossed[4];
    float4 crossed_crossed[4];
    float clearance;
} CrossingBlock;

// The block, described from the other set.
CrossingBlock turned(const CrossingBlock *block) {
    const float4 *rows = block->own_crossed;
    CrossingBlock other;
    other.own = block->crossed;
    other.crossed = block->own;
    for (uint k = 0u; k < 4u; k++) {
        other.own_own[k] = block->crossed_crossed[k];
        other.crossed_crossed[k] = block->own_own[k];
    }
    other.own_crossed[0] = (float4)(rows[0].x, rows[1].x, rows[2].x, rows[3].x);
    other.own_crossed[1] = (float4)(rows[0].y, rows[1].y, rows[2].y, rows[3].y);
    other.own_crossed[2] = (float4)(rows[0].z, rows[1].z, rows[2].z, rows[3].z);
    other.own_crossed[3] = (float4)(rows[0].w, rows[1].w, rows[2].w, rows[3].w);
    other.clearance = block->clearance;
    return other;
}

// Notes the distance of two threads, divided by the distance that they need, if it is the least so
// far.
void see(CrossingBlock *block, float clearance) {
    block->clearance = fmin(block->clearance, clearance);
}

// Adds a term for each own unknown, whose residual depends on that unknown alone, with slope
// `slope`. In this function and the next two, `share` is the factor by which curvatures grow,
// because the other crossings of a term step at the same time.
void add_alone(CrossingBlock *block, float4 weights, float share, float4 residuals, float slope) {
    block->own += weights * residuals * slope;
    float4 more = weights * share * slope * slope;
    block->own_own[0].x += more.x;
    block->own_own[1].y += more.y;
    block->own_own[2].z += more.z;
    block->own_own[3].w += more.w;
}

// Adds a term whose residual has `slopes` in the own unknowns.
void add_own(CrossingBlock *block, float weight, float share, float residual, float4 slopes) {
    block->own += (weight * residual) * slopes;
    float4 weighted = (weight * share) * slopes;
    block->own_own[0] += weighted.x * slopes;
    block->own_own[1] += weighted.y * slopes;
    block->own_own[2] += weighted.z * slopes;
    block->own_own[3] += weighted.w * slopes;
}

// Adds a term whose residual has `slopes` in the own height and half height, and `crossed` in the
// unknowns of the other set.
void add_between(CrossingBlock *block, float weight, float share, float residual, float2 slopes, float4 crossed) {
    float height = slopes.x;
    float thickness = slopes.y;
    block->own.y += weight * residual * height;
    block->own.w += weight * residual * thickness;
    block->crossed += (weight * residual) * crossed;
    float4 weighted = (weight * share) * crossed;
    block->own_own[1].y += weight * share * height * height;
    block->own_own[3].y += weight * share * thickness * height;
    block->own_own[3].w += weight * share * thickness * thickness;
    block->own_crossed[1] += weighted * height;
    block->own_crossed[3] += weighted * thickness;
    block->crossed_crossed[0] += weighted.x * crossed;
    block->crossed_crossed[1] += weighted.y * crossed;
    block->crossed_crossed[2] += weighted.z * crossed;
    block->crossed_crossed[3] += weighted.w * crossed;
}

// Adds a term whose residual has slopes in all eight unknowns.
void add_both(CrossingBlock *block, float weight, float residual, float4 own, float4 crossed) {
    add_own(block, weight, 1.0f, residual, own);
    float4 weighted = weight * crossed;
    block->crossed += residual * weighted;
    block->own_crossed[0] += weighted * own.x;
    block->own_crossed[1] += weighted * own.y;
    block->own_crossed[2] += weighted * own.z;
    block->own_crossed[3] += weighted * own.w;
    block->crossed_crossed[0] += weighted.x * crossed;
    block->crossed_crossed[1] += weighted.y * crossed;
    block->crossed_crossed[2] += weighted.z * crossed;
    block->crossed_crossed[3] += weighted.w * crossed;
}
