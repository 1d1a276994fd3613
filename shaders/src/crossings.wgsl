// The code that the shaders of crossings share: tables, sites, and the block that is gathered at a
// site. It stands before each of them.
//
// The formulas, the thresholds and the order of operations are those of texere-core (crossings/),
// and crossings.cl is the twin of this file. It is core WGSL, and requires no feature. The
// constants are the core's. texere-gpu writes them before this file.

// Rust: texere_gpu::CrossingsParams, 48 bytes.
struct CrossingsParams {
    crossings: u32,
    ends: u32,
    picks: u32,
    flags: u32,
    tension_warp: f32,
    tension_weft: f32,
    press: f32,
    penalty: f32,
    area: f32,
    pass_number: u32,
    padding: vec2<u32>,
}

// Rust: texere_gpu::ThreadRow, 32 bytes.
struct ThreadRow {
    gap: f32,
    radius: f32,
    stiffness: f32,
    aspect: f32,
    shape: f32,
    least_area: f32,
    freedom: f32,
    height: f32,
}

// A lie (Rust: ThreadState) is the state of a thread at a crossing, a vec4<f32>: shift, height,
// half width, half height. A crossing is two lies, that of its end and that of its pick.

@group(0) @binding(34) var<uniform> cloth: CrossingsParams;
@group(0) @binding(35) var<storage, read> threads: array<ThreadRow>;
// Rust: texere_gpu::CrossingSite.
@group(0) @binding(36) var<storage, read> sites: array<u32>;
// The lies with momentum added, which this pass reads.
@group(0) @binding(37) var<storage, read> found: array<vec4<f32>>;

const WARP = 0u;
const WEFT = 1u;

// ---- Site: an end (x) and a pick (y) ----

const NOWHERE = 0xffffffffu;

// The number that lies `by` after `at`, of the numbers from 0 to `count` - 1. If the numbers
// repeat, the first follows the last. Otherwise a number before the first or after the last is
// NOWHERE.
fn further(at: u32, by: i32, count: u32, repeats: bool) -> u32 {
    let way = bitcast<i32>(at) + by;
    let whole = bitcast<i32>(count);
    if way >= 0 && way < whole {
        return bitcast<u32>(way);
    }
    return select(NOWHERE, bitcast<u32>(select(way - whole, way + whole, by < 0)), repeats);
}

// The crossing that lies `along` crossings further along a thread of set `of_set`, and `across`
// threads of that set to the side.
fn beside(site: vec2<u32>, of_set: u32, along: i32, across: i32) -> vec2<u32> {
    let ends = select(along, across, of_set == WARP);
    let picks = select(across, along, of_set == WARP);
    return vec2(
        further(site.x, ends, cloth.ends, (cloth.flags & REPEATS_ENDS) != 0u),
        further(site.y, picks, cloth.picks, (cloth.flags & REPEATS_PICKS) != 0u),
    );
}

fn is_there(site: vec2<u32>) -> bool {
    return site.x != NOWHERE && site.y != NOWHERE;
}

fn number_of(site: vec2<u32>) -> u32 {
    return site.y * cloth.ends + site.x;
}

// The lie of a set's thread at a site.
fn lie_of(site: vec2<u32>, of_set: u32) -> vec4<f32> {
    return found[2u * number_of(site) + of_set];
}

// The thread of a set at a site. Ends come first in the table.
fn thread_of(site: vec2<u32>, of_set: u32) -> ThreadRow {
    return threads[select(cloth.ends + site.y, site.x, of_set == WARP)];
}

// The distance from a set's thread at a site to the thread `steps` after it.
fn way_of(site: vec2<u32>, of_set: u32, steps: i32) -> f32 {
    var way = thread_of(site, of_set).gap;
    for (var step = 1; step < steps; step++) {
        let next = beside(site, of_set, 0, step);
        if is_there(next) {
            way += thread_of(next, of_set).gap;
        }
    }
    return way;
}

// The side on which a set's thread lies: 1 on the face, -1 on the back.
fn side_of(site: vec2<u32>, of_set: u32) -> f32 {
    let up = (sites[number_of(site)] & SITE_UP) != 0u;
    return select(-1.0, 1.0, up == (of_set == WARP));
}

// The distances, in threads, from the crossing's thread of a set to the nearest threads of that set
// on its level, before and after it. A distance is 0 if there is no such thread.
fn steps_of(site: vec2<u32>, of_set: u32) -> vec2<i32> {
    let word = sites[number_of(site)] >> (2u * SITE_STEPS * of_set);
    let steps = (1u << SITE_STEPS) - 1u;
    return vec2<i32>(vec2(word & steps, (word >> SITE_STEPS) & steps));
}

// ---- CrossingBlock: the energy's slope and curvature in the eight unknowns of a crossing ----

// A block is described from one set. `own` holds the slopes in that set's four unknowns, and
// `crossed` the slopes in those of the other set. Row k of `own_own` holds the curvatures in
// unknown k and all own unknowns, row k of `own_crossed` those in unknown k and the unknowns of the
// other set. Only entries up to the diagonal of `own_own` and `crossed_crossed` are used.
struct CrossingBlock {
    own: vec4<f32>,
    crossed: vec4<f32>,
    own_own: array<vec4<f32>, 4>,
    own_crossed: array<vec4<f32>, 4>,
    crossed_crossed: array<vec4<f32>, 4>,
    clearance: f32,
}

// The block, described from the other set.
fn turned(block: CrossingBlock) -> CrossingBlock {
    let rows = block.own_crossed;
    return CrossingBlock(
        block.crossed,
        block.own,
        block.crossed_crossed,
        array(
            vec4(rows[0].x, rows[1].x, rows[2].x, rows[3].x),
            vec4(rows[0].y, rows[1].y, rows[2].y, rows[3].y),
            vec4(rows[0].z, rows[1].z, rows[2].z, rows[3].z),
            vec4(rows[0].w, rows[1].w, rows[2].w, rows[3].w),
        ),
        block.own_own,
        block.clearance,
    );
}

// Notes the distance of two threads, divided by the distance that they need, if it is the least so
// far.
fn see(block: ptr<function, CrossingBlock>, clearance: f32) {
    (*block).clearance = min((*block).clearance, clearance);
}

// Adds a term for each own unknown, whose residual depends on that unknown alone, with slope
// `slope`. In this function and the next two, `share` is the factor by which curvatures grow,
// because the other crossings of a term step at the same time.
fn add_alone(block: ptr<function, CrossingBlock>, weights: vec4<f32>, share: f32, residuals: vec4<f32>, slope: f32) {
    (*block).own += weights * residuals * slope;
    let more = weights * share * slope * slope;
    (*block).own_own[0].x += more.x;
    (*block).own_own[1].y += more.y;
    (*block).own_own[2].z += more.z;
    (*block).own_own[3].w += more.w;
}

// Adds a term whose residual has `slopes` in the own unknowns.
fn add_own(block: ptr<function, CrossingBlock>, weight: f32, share: f32, residual: f32, slopes: vec4<f32>) {
    (*block).own += (weight * residual) * slopes;
    let weighted = (weight * share) * slopes;
    (*block).own_own[0] += weighted.x * slopes;
    (*block).own_own[1] += weighted.y * slopes;
    (*block).own_own[2] += weighted.z * slopes;
    (*block).own_own[3] += weighted.w * slopes;
}

// Adds a term whose residual has `slopes` in the own height and half height, and `crossed` in the
// unknowns of the other set.
fn add_between(block: ptr<function, CrossingBlock>, weight: f32, share: f32, residual: f32, slopes: vec2<f32>, crossed: vec4<f32>) {
    let height = slopes.x;
    let thickness = slopes.y;
    (*block).own.y += weight * residual * height;
    (*block).own.w += weight * residual * thickness;
    (*block).crossed += (weight * residual) * crossed;
    let weighted = (weight * share) * crossed;
    (*block).own_own[1].y += weight * share * height * height;
    (*block).own_own[3].y += weight * share * thickness * height;
    (*block).own_own[3].w += weight * share * thickness * thickness;
    (*block).own_crossed[1] += weighted * height;
    (*block).own_crossed[3] += weighted * thickness;
    (*block).crossed_crossed[0] += weighted.x * crossed;
    (*block).crossed_crossed[1] += weighted.y * crossed;
    (*block).crossed_crossed[2] += weighted.z * crossed;
    (*block).crossed_crossed[3] += weighted.w * crossed;
}

// Adds a term whose residual has slopes in all eight unknowns.
fn add_both(block: ptr<function, CrossingBlock>, weight: f32, residual: f32, own: vec4<f32>, crossed: vec4<f32>) {
    add_own(block, weight, 1.0, residual, own);
    let weighted = weight * crossed;
    (*block).crossed += residual * weighted;
    (*block).own_crossed[0] += weighted * own.x;
    (*block).own_crossed[1] += weighted * own.y;
    (*block).own_crossed[2] += weighted * own.z;
    (*block).own_crossed[3] += weighted * own.w;
    (*block).crossed_crossed[0] += weighted.x * crossed;
    (*block).crossed_crossed[1] += weighted.y * crossed;
    (*block).crossed_crossed[2] += weighted.z * crossed;
    (*block).crossed_crossed[3] += weighted.w * crossed;
}
