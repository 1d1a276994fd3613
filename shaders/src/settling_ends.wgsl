// Places beyond yarns' ends, and what a pass has seen. After settling.wgsl.
//
// settling_ends.cl is the twin of this file.

@group(0) @binding(14) var<storage, read> strands: array<StrandRow>;
@group(0) @binding(24) var<storage, read> rows: array<SeenRow>;
@group(0) @binding(29) var<storage, read_write> next: array<vec4<i32>>;
@group(0) @binding(30) var<storage, read_write> whole: array<SeenRow>;

fn moved(place: vec4<i32>, way: vec3<i32>) -> vec4<i32> {
    return vec4(place.xyz + way, place.w);
}

// A lane a yarn: makes the places beyond its ends anew.
@compute @workgroup_size(64)
fn settling_ends(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
                 @builtin(local_invocation_index) lane: u32) {
    let yarn = (group.y * grid.x + group.x) * 64u + lane;
    if yarn >= settling.yarns {
        return;
    }
    let strand = strands[yarn];
    let first = strand.first;
    let last = first + strand.points - 1u;
    if strand.goes_on != 0u {
        let way = vec3(strand.shift_x * settling.period_x, strand.shift_y * settling.period_y, 0);
        next[first - 1u] = moved(next[last], -way);
        next[last + 1u] = moved(next[first], way);
        next[last + 2u] = moved(next[first + 1u], way);
    } else {
        next[first - 1u] = moved(next[first], next[first].xyz - next[first + 1u].xyz);
        next[last + 1u] = moved(next[last], next[last].xyz - next[last - 1u].xyz);
        next[last + 2u] = next[last + 1u];
    }
}

const SEEN_GROUP = 256u;

var<workgroup> lane_seen: array<SeenRow, SEEN_GROUP>;

fn both_seen(a: SeenRow, b: SeenRow) -> SeenRow {
    return SeenRow(
        min(a.clearance, b.clearance),
        min(a.radius, b.radius),
        max(a.length, b.length),
        max(a.step, b.step),
    );
}

// One workgroup: what all rows have seen.
@compute @workgroup_size(SEEN_GROUP)
fn settling_seen(@builtin(local_invocation_index) lane: u32) {
    var seen = SeenRow(UNSEEN, UNSEEN, 0.0, 0.0);
    for (var row = lane; row < (settling.places + 63u) / 64u; row += SEEN_GROUP) {
        seen = both_seen(seen, rows[row]);
    }
    lane_seen[lane] = seen;
    for (var reach = SEEN_GROUP / 2u; reach > 0u; reach /= 2u) {
        workgroupBarrier();
        if lane < reach {
            seen = both_seen(seen, lane_seen[lane + reach]);
            lane_seen[lane] = seen;
        }
    }
    if lane == 0u {
        whole[0] = seen;
    }
}
