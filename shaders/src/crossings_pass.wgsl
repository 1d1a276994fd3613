// A pass: it moves every crossing by one step, and gathers the longest step and the least clearance
// of all. This file follows crossings_terms.wgsl.
//
// crossings_pass.cl is the twin of this file. CrossingBlock::step and CrossingsPlan in texere-core
// (crossings/) are the definitions.

// The lies after the last pass, without momentum. A lie is the state of a thread at a crossing:
// shift, height, half width and half height.
@group(0) @binding(38) var<storage, read_write> crossings: array<vec4<f32>>;
// The lies with momentum added, which the next pass reads.
@group(0) @binding(39) var<storage, read_write> next: array<vec4<f32>>;
// A row for each workgroup, and a row for each pass: the longest step and the least clearance.
@group(0) @binding(40) var<storage, read_write> group_rows: array<vec2<f32>>;
@group(0) @binding(41) var<storage, read_write> pass_rows: array<vec2<f32>>;

// ---- Eight equations by Cholesky's method, in two halves of four ----

// The square root of a damped pivot, which is at least CROSSINGS_PIVOT. `left` is what is left of a
// diagonal element, and `whole` is that element before anything was subtracted.
fn pivot(left: f32, whole: f32) -> f32 {
    return sqrt(max(left + CROSSINGS_DAMPING + CROSSINGS_DAMPING * whole, CROSSINGS_PIVOT));
}

// The Cholesky factor of a symmetric 4 x 4 matrix, of which the lower triangle is given. `whole` is
// the diagonal before anything was subtracted from the matrix.
fn root_of(rows: array<vec4<f32>, 4>, whole: vec4<f32>) -> array<vec4<f32>, 4> {
    var root: array<vec4<f32>, 4>;
    root[0].x = pivot(rows[0].x, whole.x);
    root[1].x = rows[1].x / root[0].x;
    root[1].y = pivot(rows[1].y - root[1].x * root[1].x, whole.y);
    root[2].x = rows[2].x / root[0].x;
    root[2].y = (rows[2].y - root[2].x * root[1].x) / root[1].y;
    root[2].z = pivot(rows[2].z - root[2].x * root[2].x - root[2].y * root[2].y, whole.z);
    root[3].x = rows[3].x / root[0].x;
    root[3].y = (rows[3].y - root[3].x * root[1].x) / root[1].y;
    root[3].z = (rows[3].z - root[3].x * root[2].x - root[3].y * root[2].y) / root[2].z;
    root[3].w = pivot(
        rows[3].w - root[3].x * root[3].x - root[3].y * root[3].y - root[3].z * root[3].z,
        whole.w,
    );
    return root;
}

// Solves root * x = `right`.
fn forwards(root: array<vec4<f32>, 4>, right: vec4<f32>) -> vec4<f32> {
    let x = right.x / root[0].x;
    let y = (right.y - root[1].x * x) / root[1].y;
    let z = (right.z - root[2].x * x - root[2].y * y) / root[2].z;
    let w = (right.w - root[3].x * x - root[3].y * y - root[3].z * z) / root[3].w;
    return vec4(x, y, z, w);
}

// Solves transpose(root) * x = `right`.
fn backwards(root: array<vec4<f32>, 4>, right: vec4<f32>) -> vec4<f32> {
    let w = right.w / root[3].w;
    let z = (right.z - root[3].z * w) / root[2].z;
    let y = (right.y - root[2].y * z - root[3].y * w) / root[1].y;
    let x = (right.x - root[1].x * y - root[2].x * z - root[3].x * w) / root[0].x;
    return vec4(x, y, z, w);
}

fn dot4(one: vec4<f32>, other: vec4<f32>) -> f32 {
    return one.x * other.x + one.y * other.y + one.z * other.z + one.w * other.w;
}

// The steps of both threads of a crossing.
struct Pair {
    warp: vec4<f32>,
    weft: vec4<f32>,
}

// The step that solves the block's equations.
fn step_of(block: CrossingBlock) -> Pair {
    let own = block.own_own;
    let warp = root_of(own, vec4(own[0].x, own[1].y, own[2].z, own[3].w));
    let between = turned(block).own_crossed;
    let a = forwards(warp, between[0]);
    let b = forwards(warp, between[1]);
    let c = forwards(warp, between[2]);
    let d = forwards(warp, between[3]);
    var rows = block.crossed_crossed;
    let whole = vec4(rows[0].x, rows[1].y, rows[2].z, rows[3].w);
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
    let weft = root_of(rows, whole);
    let right = forwards(warp, -block.own);
    let left = -block.crossed - vec4(dot4(a, right), dot4(b, right), dot4(c, right), dot4(d, right));
    let step = backwards(weft, forwards(weft, left));
    return Pair(backwards(warp, right - a * step.x - b * step.y - c * step.z - d * step.w), step);
}

// ---- Pass ----

// A lie, limited to what its thread allows.
fn bounded(lie: vec4<f32>, thread: ThreadRow) -> vec4<f32> {
    let most = vec4(
        thread.freedom,
        thread.height,
        CROSSINGS_HALF_WIDTH_MOST * thread.radius,
        CROSSINGS_HALF_HEIGHT_MOST * thread.radius,
    );
    let least = vec4(
        -thread.freedom,
        -thread.height,
        CROSSINGS_HALF_WIDTH_LEAST * thread.radius,
        CROSSINGS_HALF_HEIGHT_LEAST * thread.radius,
    );
    return min(max(lie, least), most);
}

fn largest(one: vec4<f32>) -> f32 {
    let all = abs(one);
    return max(max(all.x, all.y), max(all.z, all.w));
}

// Moves one thread of a crossing, and returns by how much.
fn move_thread(lie: u32, thread: ThreadRow, step: vec4<f32>) -> vec4<f32> {
    let was = crossings[lie];
    let moved = bounded(found[lie] + step, thread);
    crossings[lie] = moved;
    return moved - was;
}

// Writes the lie that the next pass reads: the lie after this pass, moved by `on` (momentum).
fn move_on(lie: u32, thread: ThreadRow, on: vec4<f32>) {
    next[lie] = bounded(crossings[lie] + on, thread);
}

// Moves a crossing. Returns the longest step and the least clearance.
fn move_crossing(number: u32) -> vec2<f32> {
    let site = vec2(number % cloth.ends, number / cloth.ends);
    let block = gathered(site);
    let step = step_of(block);
    let longest = max(largest(step.warp), largest(step.weft));
    var share = 1.0;
    if longest > CROSSINGS_STEP {
        share = CROSSINGS_STEP / longest;
    }
    let end = thread_of(site, WARP);
    let pick = thread_of(site, WEFT);
    let first = 2u * number;
    let warp = move_thread(first + WARP, end, share * step.warp);
    let weft = move_thread(first + WEFT, pick, share * step.weft);
    // Momentum fades if the step leads uphill in the energy. None is left if the cosine between the
    // step and the energy's slope is CROSSINGS_UPHILL or more.
    let rise = dot4(block.own, warp) + dot4(block.crossed, weft);
    let slopes = dot4(block.own, block.own) + dot4(block.crossed, block.crossed);
    let steepest = sqrt((dot4(warp, warp) + dot4(weft, weft)) * slopes);
    var momentum = CROSSINGS_MOMENTUM;
    if rise > 0.0 {
        momentum *= max(1.0 - rise / (CROSSINGS_UPHILL * steepest), 0.0);
    }
    move_on(first + WARP, end, momentum * warp);
    move_on(first + WEFT, pick, momentum * weft);
    return vec2(max(largest(warp), largest(weft)), block.clearance);
}

// The longest step and the least clearance of two rows.
fn seen_by_both(one: vec2<f32>, other: vec2<f32>) -> vec2<f32> {
    return vec2(max(one.x, other.x), min(one.y, other.y));
}

const CROSSINGS_MOVE_GROUP = 64u;

var<workgroup> lane_seen: array<vec2<f32>, CROSSINGS_MOVE_GROUP>;

// Moves all crossings, with one lane for each. Each workgroup writes a row: the longest step and
// the least clearance of its lanes, which are joined in pairs.
@compute @workgroup_size(CROSSINGS_MOVE_GROUP)
fn crossings_move(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
                  @builtin(local_invocation_index) lane: u32) {
    let row = group.y * grid.x + group.x;
    let number = row * CROSSINGS_MOVE_GROUP + lane;
    var seen = vec2(0.0, UNSEEN);
    if number < cloth.crossings {
        seen = move_crossing(number);
    }
    lane_seen[lane] = seen;
    for (var reach = CROSSINGS_MOVE_GROUP / 2u; reach > 0u; reach /= 2u) {
        workgroupBarrier();
        if lane < reach {
            lane_seen[lane] = seen_by_both(lane_seen[lane], lane_seen[lane + reach]);
        }
    }
    if lane == 0u && row * CROSSINGS_MOVE_GROUP < cloth.crossings {
        group_rows[row] = lane_seen[0];
    }
}

const CROSSINGS_SEEN_GROUP = 256u;

var<workgroup> lane_rows: array<vec2<f32>, CROSSINGS_SEEN_GROUP>;

// Joins the rows of all workgroups into the row of this pass. It runs as one workgroup.
@compute @workgroup_size(CROSSINGS_SEEN_GROUP)
fn crossings_seen(@builtin(local_invocation_index) lane: u32) {
    let count = (cloth.crossings + CROSSINGS_MOVE_GROUP - 1u) / CROSSINGS_MOVE_GROUP;
    var seen = vec2(0.0, UNSEEN);
    for (var row = lane; row < count; row += CROSSINGS_SEEN_GROUP) {
        seen = seen_by_both(seen, group_rows[row]);
    }
    lane_rows[lane] = seen;
    for (var reach = CROSSINGS_SEEN_GROUP / 2u; reach > 0u; reach /= 2u) {
        workgroupBarrier();
        if lane < reach {
            lane_rows[lane] = seen_by_both(lane_rows[lane], lane_rows[lane + reach]);
        }
    }
    if lane == 0u {
        pass_rows[cloth.pass_number] = lane_rows[0];
    }
}
