// A pass: it moves every crossing by one step, and gathers the longest step and the least clearance
// of all. This file follows crossings_terms.cl.
//
// Its twin is crossings_pass.wgsl. CrossingBlock::step and CrossingsPlan in texere-core
// (crossings/) are the definitions.

// ---- Eight equations by Cholesky's method, in two halves of four ----

// The Cholesky factor of a symmetric 4 x 4 matrix.
typedef struct {
    float4 rows[4];
} Root;

// The square root of a damped pivot, which is at least CROSSINGS_PIVOT. `left` is what is left of a
// diagonal element, and `whole` is that element before anything was subtracted.
float pivot(float left, float whole) {
    return sqrt(fmax(left + CROSSINGS_DAMPING + CROSSINGS_DAMPING * whole, CROSSINGS_PIVOT));
}

// The Cholesky factor of a symmetric 4 x 4 matrix, of which the lower triangle is given. `whole` is
// the diagonal before anything was subtracted from the matrix.
Root root_of(const float4 *rows, float4 whole) {
    float4 a = rows[0];
    float4 b = rows[1];
    float4 c = rows[2];
    float4 d = rows[3];
    a.x = pivot(a.x, whole.x);
    b.x = b.x / a.x;
    b.y = pivot(b.y - b.x * b.x, whole.y);
    c.x = c.x / a.x;
    c.y = (c.y - c.x * b.x) / b.y;
    c.z = pivot(c.z - c.x * c.x - c.y * c.y, whole.z);
    d.x = d.x / a.x;
    d.y = (d.y - d.x * b.x) / b.y;
    d.z = (d.z - d.x * c.x - d.y * c.y) / c.z;
    d.w = pivot(d.w - d.x * d.x - d.y * d.y - d.z * d.z, whole.w);
    Root root;
    root.rows[0] = a;
    root.rows[1] = b;
    root.rows[2] = c;
    root.rows[3] = d;
    return root;
}

// Solves root * x = `right`.
float4 forwards(const Root *root, float4 right) {
    const float4 *rows = root->rows;
    float x = right.x / rows[0].x;
    float y = (right.y - rows[1].x * x) / rows[1].y;
    float z = (right.z - rows[2].x * x - rows[2].y * y) / rows[2].z;
    float w = (right.w - rows[3].x * x - rows[3].y * y - rows[3].z * z) / rows[3].w;
    return (float4)(x, y, z, w);
}

// Solves transpose(root) * x = `right`.
float4 backwards(const Root *root, float4 right) {
    const float4 *rows = root->rows;
    float w = right.w / rows[3].w;
    float z = (right.z - rows[3].z * w) / rows[2].z;
    float y = (right.y - rows[2].y * z - rows[3].y * w) / rows[1].y;
    float x = (right.x - rows[1].x * y - rows[2].x * z - rows[3].x * w) / rows[0].x;
    return (float4)(x, y, z, w);
}

float dot4(float4 one, float4 other) {
    return one.x * other.x + one.y * other.y + one.z * other.z + one.w * other.w;
}

// The steps of both threads of a crossing.
typedef struct {
    float4 warp;
    float4 weft;
} Pair;

// The step that solves the block's equations.
Pair step_of(const CrossingBlock *block) {
    const float4 *own = block->own_own;
    Root warp = root_of(own, (float4)(own[0].x, own[1].y, own[2].z, own[3].w));
    CrossingBlock other = turned(block);
    float4 a = forwards(&warp, other.own_crossed[0]);
    float4 b = forwards(&warp, other.own_crossed[1]);
    float4 c = forwards(&warp, other.own_crossed[2]);
    float4 d = forwards(&warp, other.own_crossed[3]);
    float4 *rows = other.own_own;
    float4 whole = (float4)(rows[0].x, rows[1].y, rows[2].z, rows[3].w);
    rows[0].x -= dot4(a, a);
    rows[1].x -= dot4(b, a);
    rows[1].y -= dot4(b, b);
    rows[2].x -= dot4(c, a);
    rows[2].y -= dot4(c, b);
    rows[2].z -= dot4(c, c);
    rows[3].x -= dot4(d, a);
    rows[3].y -= dot4(d, b);
    rows[3].z -= dot4(d, c);
    rows[3].w -= dot4(d, d);
    Root weft = root_of(rows, whole);
    float4 right = forwards(&warp, -block->own);
    float4 left = -block->crossed - (float4)(dot4(a, right), dot4(b, right), dot4(c, right), dot4(d, right));
    float4 step = backwards(&weft, forwards(&weft, left));
    Pair both;
    both.warp = backwards(&warp, right - a * step.x - b * step.y - c * step.z - d * step.w);
    both.weft = step;
    return both;
}

// ---- Pass ----

// A lie, limited to what its thread allows.
float4 bounded(float4 lie, const ThreadRow *thread) {
    float4 most = (float4)(thread->freedom, thread->height, CROSSINGS_HALF_WIDTH_MOST * thread->radius,
                           CROSSINGS_HALF_HEIGHT_MOST * thread->radius);
    float4 least = (float4)(-thread->freedom, -thread->height, CROSSINGS_HALF_WIDTH_LEAST * thread->radius,
                            CROSSINGS_HALF_HEIGHT_LEAST * thread->radius);
    return fmin(fmax(lie, least), most);
}

float largest(float4 one) {
    float4 all = fabs(one);
    return fmax(fmax(all.x, all.y), fmax(all.z, all.w));
}

// Moves one thread of a crossing, and returns by how much.
float4 move_thread(const Cloth *cloth, __global float4 *crossings, size_t lie, const ThreadRow *thread, float4 step) {
    float4 was = crossings[lie];
    float4 moved = bounded(cloth->found[lie] + step, thread);
    crossings[lie] = moved;
    return moved - was;
}

// Writes the lie that the next pass reads: the lie after this pass, moved by `on` (momentum).
void move_on(const __global float4 *crossings, __global float4 *next, size_t lie, const ThreadRow *thread, float4 on) {
    next[lie] = bounded(crossings[lie] + on, thread);
}

// Moves a crossing. Returns the longest step and the least clearance.
float2 move_crossing(const Cloth *cloth, __global float4 *crossings, __global float4 *next, uint number) {
    uint2 site = (uint2)(number % cloth->params->ends, number / cloth->params->ends);
    CrossingBlock block = gathered(cloth, site);
    Pair step = step_of(&block);
    float longest = fmax(largest(step.warp), largest(step.weft));
    float share = longest > CROSSINGS_STEP ? CROSSINGS_STEP / longest : 1.0f;
    ThreadRow end = thread_of(cloth, site, WARP);
    ThreadRow pick = thread_of(cloth, site, WEFT);
    size_t first = 2u * (size_t)number;
    float4 warp = move_thread(cloth, crossings, first + WARP, &end, share * step.warp);
    float4 weft = move_thread(cloth, crossings, first + WEFT, &pick, share * step.weft);
    // Momentum fades if the step leads uphill in the energy. None is left if the cosine between the
    // step and the energy's slope is CROSSINGS_UPHILL or more.
    float rise = dot4(block.own, warp) + dot4(block.crossed, weft);
    float slopes = dot4(block.own, block.own) + dot4(block.crossed, block.crossed);
    float steepest = sqrt((dot4(warp, warp) + dot4(weft, weft)) * slopes);
    float momentum = CROSSINGS_MOMENTUM;
    if (rise > 0.0f) {
        momentum *= fmax(1.0f - rise / (CROSSINGS_UPHILL * steepest), 0.0f);
    }
    move_on(crossings, next, first + WARP, &end, momentum * warp);
    move_on(crossings, next, first + WEFT, &pick, momentum * weft);
    return (float2)(fmax(largest(warp), largest(weft)), block.clearance);
}

// The longest step and the least clearance of two rows.
float2 seen_by_both(float2 one, float2 other) {
    return (float2)(fmax(one.x, other.x), fmin(one.y, other.y));
}

// The longest step and the least clearance of a workgroup. Lanes are joined in pairs. The result is
// valid in lane 0.
float2 seen_by_group(__local float2 *rows, uint lane, uint lanes, float2 seen) {
    rows[lane] = seen;
    for (uint reach = lanes / 2u; reach > 0u; reach /= 2u) {
        barrier(CLK_LOCAL_MEM_FENCE);
        if (lane < reach) {
            rows[lane] = seen_by_both(rows[lane], rows[lane + reach]);
        }
    }
    return rows[0];
}

#define CROSSINGS_MOVE_GROUP 64

// Moves all crossings, with one lane for each. Each workgroup writes a row: the longest step and
// the least clearance of its lanes, which are joined in pairs.
__kernel __attribute__((reqd_work_group_size(CROSSINGS_MOVE_GROUP, 1, 1)))
void crossings_move(const CrossingsParams params, __global const ThreadRow *threads, __global const uint *sites,
                    __global const float4 *found, __global float4 *crossings, __global float4 *next,
                    __global float2 *group_rows) {
    __local float2 group[CROSSINGS_MOVE_GROUP];
    Cloth cloth = {&params, threads, sites, found};
    uint number = get_global_id(0);
    float2 seen = (float2)(0.0f, UNSEEN);
    if (number < params.crossings) {
        seen = move_crossing(&cloth, crossings, next, number);
    }
    seen = seen_by_group(group, get_local_id(0), CROSSINGS_MOVE_GROUP, seen);
    if (get_local_id(0) == 0u) {
        group_rows[number / CROSSINGS_MOVE_GROUP] = seen;
    }
}

#define CROSSINGS_SEEN_GROUP 256

// Joins the rows of all workgroups into the row of this pass. It runs as one workgroup.
__kernel __attribute__((reqd_work_group_size(CROSSINGS_SEEN_GROUP, 1, 1)))
void crossings_seen(const CrossingsParams params, __global const float2 *group_rows, __global float2 *pass_rows) {
    __local float2 group[CROSSINGS_SEEN_GROUP];
    uint lane = get_local_id(0);
    uint count = (params.crossings + CROSSINGS_MOVE_GROUP - 1u) / CROSSINGS_MOVE_GROUP;
    float2 seen = (float2)(0.0f, UNSEEN);
    for (uint row = lane; row < count; row += CROSSINGS_SEEN_GROUP) {
        seen = seen_by_both(seen, group_rows[row]);
    }
    seen = seen_by_group(group, lane, CROSSINGS_SEEN_GROUP, seen);
    if (lane == 0u) {
        pass_rows[params.pass_number] = seen;
    }
}
