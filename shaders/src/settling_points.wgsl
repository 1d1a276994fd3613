// Control points from settled places, and the box round them. This file follows settling.wgsl.
//
// The formulas are those of texere-core (Scale::point, renew_virtual_ends), and settling_points.cl
// is the twin of this file.

// Rust: texere_gpu::SettledParams, 32 bytes.
struct SettledParams {
    origin: vec3<f32>,
    unit: f32,
    places: u32,
    padding: u32,
    more_padding: vec2<u32>,
}

// Rust: texere_gpu::SettledRow, 32 bytes.
struct SettledRow {
    first_place: u32,
    points: u32,
    first_point: u32,
    closed: u32,
    start_halves: u32,
    end_halves: u32,
    padding: vec2<u32>,
}

// Rust: texere_gpu::BoundsRow, 32 bytes.
struct BoundsRow {
    low: vec3<i32>,
    padding: i32,
    high: vec3<i32>,
    more_padding: i32,
}

@group(0) @binding(1) var<storage, read_write> points: array<vec4<u32>>;
@group(0) @binding(15) var<storage, read> places: array<vec4<i32>>;
@group(0) @binding(31) var<uniform> settled: SettledParams;
@group(0) @binding(32) var<storage, read> settled_rows: array<SettledRow>;
@group(0) @binding(33) var<storage, read_write> bounds: array<BoundsRow>;

// The position of a place, mm: origin + units * unit, rounded once. Units are split into two parts
// that floats hold exactly. The rounding error of the first sum is added to the other part.
fn position(place: u32) -> vec3<f32> {
    let units = places[place].xyz;
    let high = vec3<f32>(units >> vec3(12u)) * (f32(4096) * settled.unit);
    let low = vec3<f32>(units & vec3(4095)) * settled.unit;
    let sum = settled.origin + high;
    let added = sum - settled.origin;
    let lost = (settled.origin - (sum - added)) + (high - added);
    return sum + (lost + low);
}

fn control_point(position: vec3<f32>, halves: u32) -> vec4<u32> {
    return vec4(bitcast<vec3<u32>>(position), halves);
}

// Writes control points, with one lane for each place. The lane also writes the virtual ends that
// depend on its place.
@compute @workgroup_size(64)
fn settling_points(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
                   @builtin(local_invocation_index) lane: u32) {
    let place = (group.y * grid.x + group.x) * 64u + lane;
    if place >= settled.places {
        return;
    }
    if (place_rows[place].tags & TAG_POINT) == 0u {
        return;
    }
    let yarn = settled_rows[place_rows[place].yarn];
    let own = place - yarn.first_place;
    let here = position(place);
    let point = control_point(here, bitcast<u32>(places[place].w));
    points[yarn.first_point + own] = point;
    if yarn.closed != 0u {
        if own == yarn.points - 1u {
            points[yarn.first_point - 1u] = point;
        }
        if own < 3u {
            points[yarn.first_point + yarn.points + own] = point;
        }
        return;
    }
    if own == 0u {
        points[yarn.first_point - 1u] = control_point(2.0 * here - position(place + 1u), yarn.start_halves);
    }
    if own == yarn.points - 1u {
        points[yarn.first_point + yarn.points] = control_point(2.0 * here - position(place - 1u), yarn.end_halves);
    }
}

const BOUNDS_GROUP = 256u;

var<workgroup> lane_low: array<vec3<i32>, BOUNDS_GROUP>;
var<workgroup> lane_high: array<vec3<i32>, BOUNDS_GROUP>;

// Finds the box round all control points. Any number of workgroups share the places, and each
// writes a row.
@compute @workgroup_size(BOUNDS_GROUP)
fn settling_bounds(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
                   @builtin(local_invocation_index) lane: u32) {
    var low = vec3(2147483647);
    var high = vec3(-2147483647);
    for (var place = group.x * BOUNDS_GROUP + lane; place < settled.places; place += grid.x * BOUNDS_GROUP) {
        if (place_rows[place].tags & TAG_POINT) != 0u {
            low = min(low, places[place].xyz);
            high = max(high, places[place].xyz);
        }
    }
    lane_low[lane] = low;
    lane_high[lane] = high;
    for (var reach = BOUNDS_GROUP / 2u; reach > 0u; reach /= 2u) {
        workgroupBarrier();
        if lane < reach {
            low = min(low, lane_low[lane + reach]);
            high = max(high, lane_high[lane + reach]);
            lane_low[lane] = low;
            lane_high[lane] = high;
        }
    }
    if lane == 0u {
        bounds[group.x] = BoundsRow(low, 0, high, 0);
    }
}
