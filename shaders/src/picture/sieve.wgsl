// The triangles of a chunk that a sample may see, as a list. After view.wgsl and chunk.wgsl.
//
// Half of a cloth's triangles face away, and most of a large cloth's lie between the samples of a pixel. To find that
// out here is much less work than to rasterise them (Wihlidal 2016, "Optimizing the graphics pipeline with compute",
// GDC). What is left out would not have been drawn: the picture is the same. But triangles come in no fixed order, so
// that of two of just the same depth in a sample either may be drawn.

const SIEVE_GROUP = 64u;

// Quads that a workgroup looks at together, and their corners: those of whole rings, of 256 sides at most, and of the ring
// after them.
const TILE_QUADS = 512u;
const TILE_CORNERS = 768u;

// How far a rasteriser may move a corner, pixels: half of 1/256 by rounding, as Direct3D requires and Vulkan's desktop drivers
// do, the rest by f32.
const MARGIN = 0.0078125;

// Triangles larger than this are kept without a test: pixels.
const LARGE = 2.0;

// A row of samples in each quarter of a pixel, and where each one's sample is: the pattern that WebGPU prescribes.
const ROWS = 4.0;
const SAMPLE_X = array(0.375, 0.875, 0.125, 0.625);

struct Draw {
    corners: atomic<u32>,
    instances: u32,
    first_corner: u32,
    first_instance: u32,
}

// Three vertices and the run, for each triangle. Those of caps are there already.
@group(0) @binding(3) var<storage, read_write> triangles: array<vec4<u32>>;
@group(0) @binding(4) var<storage, read_write> draw: Draw;

var<workgroup> corners: array<vec4<f32>, TILE_CORNERS>;
var<workgroup> found: atomic<u32>;
var<workgroup> first: u32;

// Place on the screen, depth, and w, which is 0 or less behind the eye.
fn corner_at(number: u32) -> vec4<f32> {
    let clip = clip_of(position_of(number));
    let ndc = clip.xyz / clip.w;
    return vec4((ndc.xy * vec2(0.5, -0.5) + 0.5) * view.size, ndc.z, clip.w);
}

// Twice the area between `edge` and `point`, both from the same corner.
fn area(edge: vec2<f32>, point: vec2<f32>) -> f32 {
    return edge.x * point.y - edge.y * point.x;
}

// The error bound of the area.
fn slack(edge: vec2<f32>) -> f32 {
    return MARGIN * (abs(edge.x) + abs(edge.y));
}

fn may_be_seen(p: vec4<f32>, q: vec4<f32>, r: vec4<f32>) -> bool {
    if min(p.w, min(q.w, r.w)) < 1e-6 {
        return true;
    }
    let low = min(p.xyz, min(q.xyz, r.xyz)) - vec3(MARGIN, MARGIN, 1e-5);
    let high = max(p.xyz, max(q.xyz, r.xyz)) + vec3(MARGIN, MARGIN, 1e-5);
    if any(high < vec3(0.0)) || any(low > vec3(view.size, 1.0)) {
        return false;
    }
    let pq = q.xy - p.xy;
    let qr = r.xy - q.xy;
    let rp = p.xy - r.xy;
    // Counter-clockwise from outside, and rows go down the screen.
    let outside = -area(pq, -rp);
    if view.sees_inside == 0u && outside < -slack(pq) - slack(qr) - slack(rp) {
        return false;
    }
    if any(high.xy - low.xy > vec2(LARGE)) {
        return true;
    }
    let turn = select(1.0, -1.0, outside > 0.0);
    let last_row = floor(high.y * ROWS - 0.5);
    for (var row = ceil(low.y * ROWS - 0.5); row <= last_row; row += 1.0) {
        let offset = SAMPLE_X[u32(i32(row) & 3)];
        for (var x = ceil(low.x - offset) + offset; x <= high.x; x += 1.0) {
            let place = vec2(x, (row + 0.5) / ROWS);
            if turn * area(pq, place - p.xy) >= -slack(pq)
                && turn * area(qr, place - q.xy) >= -slack(qr)
                && turn * area(rp, place - r.xy) >= -slack(rp) {
                return true;
            }
        }
    }
    return false;
}

// The corners of a quad, from the first one of its tile: on its ring, and on the next one.
fn quad_at(quad: u32) -> vec4<u32> {
    let is_last = (quad + 1u) % view.sides == 0u;
    let beside = select(quad + 1u, quad + 1u - view.sides, is_last);
    return vec4(quad, beside, quad + view.sides, beside + view.sides);
}

// A workgroup of SIEVE_GROUP a run.
@compute @workgroup_size(SIEVE_GROUP)
fn sieve(
    @builtin(workgroup_id) group: vec3<u32>,
    @builtin(num_workgroups) grid: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let number = group.y * grid.x + group.x;
    if number >= arrayLength(&runs) {
        return;
    }
    let run = runs[number];
    let tile = TILE_QUADS / view.sides * view.sides;
    for (var start = 0u; start < run.gaps * view.sides; start += tile) {
        let first_vertex = run.first_vertex + start;
        let quads = min(tile, run.gaps * view.sides - start);
        for (var corner = lane; corner < quads + view.sides; corner += SIEVE_GROUP) {
            corners[corner] = corner_at(first_vertex + corner);
        }
        workgroupBarrier();
        // Two bits a quad, eight quads a lane.
        var seen = 0u;
        var bit = 1u;
        for (var quad = lane; quad < quads; quad += SIEVE_GROUP) {
            let at = quad_at(quad);
            let p = corners[at.x];
            let q = corners[at.y];
            let r = corners[at.z];
            let s = corners[at.w];
            seen |= select(0u, bit, may_be_seen(p, q, r)) | select(0u, bit << 1u, may_be_seen(q, s, r));
            bit <<= 2u;
        }
        var place = atomicAdd(&found, countOneBits(seen));
        workgroupBarrier();
        if lane == 0u {
            first = atomicAdd(&draw.corners, 3u * atomicLoad(&found)) / 3u;
            atomicStore(&found, 0u);
        }
        workgroupBarrier();
        place += first;
        while seen != 0u {
            let next = firstTrailingBit(seen);
            seen &= seen - 1u;
            let at = quad_at(lane + next / 2u * SIEVE_GROUP) + first_vertex;
            triangles[place] = vec4(select(at.xyz, at.ywz, (next & 1u) != 0u), number);
            place += 1u;
        }
    }
}
