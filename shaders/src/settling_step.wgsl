// Steps of control points. This file follows settling.wgsl.
//
// settling_step.cl is the twin of this file, and Gathered in texere-core's pass.rs is the
// definition.

@group(0) @binding(14) var<storage, read> strands: array<StrandRow>;
@group(0) @binding(15) var<storage, read> places: array<vec4<i32>>;
@group(0) @binding(22) var<storage, read_write> lengths: array<f32>;
@group(0) @binding(23) var<storage, read> pulls: array<f32>;
@group(0) @binding(24) var<storage, read_write> rows: array<SeenRow>;
// The last step of each place, mm.
@group(0) @binding(28) var<storage, read_write> steps: array<vec4<f32>>;
@group(0) @binding(29) var<storage, read_write> next: array<vec4<i32>>;

const WEIGHTED_SLOT = 8u;
const BLOCK_SLOT = 9u;

// Four intervals pull at a point. They begin at the next place, at the point's own place, at the
// place before it, and two places before it. In these four intervals the point has slots 0, 1, 2
// and 3. NOWHERE stands for an interval that the yarn does not have.
const NOWHERE = 0xffffffffu;

fn interval_place(strand: StrandRow, number: i32) -> u32 {
    let goes_on = strand.goes_on != 0u;
    let count = bitcast<i32>(select(strand.points - 1u, strand.points, goes_on));
    var own = number;
    if goes_on {
        // A yarn that goes on has at least three points.
        own = select(own, own + count, own < 0);
        own = select(own, own - count, own >= count);
    }
    return select(NOWHERE, strand.first + bitcast<u32>(own), own >= 0 && own < count);
}

fn intervals_of(strand: StrandRow, place: u32) -> vec4<u32> {
    let point = bitcast<i32>(place - strand.first);
    return vec4(
        interval_place(strand, point + 1),
        interval_place(strand, point),
        interval_place(strand, point - 1),
        interval_place(strand, point - 2),
    );
}

// The value of interval `interval` in plane `plane`, or `nothing` if there is no interval.
fn pulled(plane: u32, interval: u32, nothing: f32) -> f32 {
    if interval == NOWHERE {
        return nothing;
    }
    return pulls[plane * settling.places + interval];
}

// The sum of plane `plane` of the point's slots in all four intervals. A slot has `slot` planes.
fn gathered(intervals: vec4<u32>, slot: u32, plane: u32) -> f32 {
    return pulled(plane, intervals.x, 0.0) + pulled(slot + plane, intervals.y, 0.0)
        + pulled(2u * slot + plane, intervals.z, 0.0) + pulled(3u * slot + plane, intervals.w, 0.0);
}

fn gathered_way(intervals: vec4<u32>, slot: u32, plane: u32) -> vec3<f32> {
    return vec3(
        gathered(intervals, slot, plane),
        gathered(intervals, slot, plane + 1u),
        gathered(intervals, slot, plane + 2u),
    );
}

fn least_seen(intervals: vec4<u32>, plane: u32) -> f32 {
    return min(
        min(pulled(plane, intervals.x, UNSEEN), pulled(plane, intervals.y, UNSEEN)),
        min(pulled(plane, intervals.z, UNSEEN), pulled(plane, intervals.w, UNSEEN)),
    );
}

// The step along z by which the plates press a point, mm.
fn press(place: vec4<i32>) -> f32 {
    if (settling.flags & PLATES) == 0u {
        return 0.0;
    }
    let z = f32(place.z) * settling.unit;
    let far = PRESS * settling.ease * max(abs(z) + halves(place).y - settling.half_gap, 0.0);
    return select(far, -far, z >= 0.0);
}

// A step, limited to a share of the least distance to another yarn and to a share of the diameter.
fn within_limits(step: vec3<f32>, place: vec4<i32>, near: f32) -> vec3<f32> {
    let both = halves(place);
    let diameter = 2.0 * min(both.x, both.y);
    let most = min(STEP_NEAR * near, STEP_DIAMETER * diameter);
    let length = length3(step);
    if length > most {
        return step * (most / length);
    }
    return step;
}

fn step_weighted(intervals: vec4<u32>, place: vec4<i32>, last: vec3<f32>) -> vec3<f32> {
    let own = 4u * WEIGHTED_SLOT;
    let contact = gathered_way(intervals, WEIGHTED_SLOT, 0u);
    let contacts = gathered(intervals, WEIGHTED_SLOT, 3u);
    let bend = gathered_way(intervals, WEIGHTED_SLOT, 4u);
    let bends = gathered(intervals, WEIGHTED_SLOT, 7u);
    // If yarns are about to pass through one another, contact alone counts.
    let apart = share((least_seen(intervals, own + 5u) / settling.growth - CROSSING) * CROSSING_SHARE);
    let length = vec3(
        pulled(own, intervals.y, 0.0) - pulled(own, intervals.z, 0.0),
        pulled(own + 1u, intervals.y, 0.0) - pulled(own + 1u, intervals.z, 0.0),
        pulled(own + 2u, intervals.y, 0.0) - pulled(own + 2u, intervals.z, 0.0),
    );
    var others = bend * (BEND / max(bends, BENDS_MIN)) + length + last * settling.momentum;
    others.z += press(place);
    let step = contact * (1.0 / max(contacts, CONTACTS_MIN)) + others * apart;
    return within_limits(step, place, least_seen(intervals, own + 4u));
}

fn step_block(intervals: vec4<u32>, place: vec4<i32>, last: vec3<f32>) -> vec3<f32> {
    let right = gathered_way(intervals, BLOCK_SLOT, 0u);
    let xx = gathered(intervals, BLOCK_SLOT, 3u) + INERTIA;
    let xy = gathered(intervals, BLOCK_SLOT, 4u);
    let xz = gathered(intervals, BLOCK_SLOT, 5u);
    let yy = gathered(intervals, BLOCK_SLOT, 6u) + INERTIA;
    let yz = gathered(intervals, BLOCK_SLOT, 7u);
    let zz = gathered(intervals, BLOCK_SLOT, 8u) + INERTIA;
    // Solves matrix * x = `right` by cofactors. The matrix is symmetric.
    let a = yy * zz - yz * yz;
    let b = xz * yz - xy * zz;
    let c = xy * yz - xz * yy;
    let d = xx * zz - xz * xz;
    let e = xy * xz - xx * yz;
    let f = xx * yy - xy * xy;
    let inverse = 1.0 / max(xx * a + xy * b + xz * c, INERTIA * INERTIA * INERTIA);
    var step = vec3(
        (a * right.x + b * right.y + c * right.z) * inverse,
        (b * right.x + d * right.y + e * right.z) * inverse,
        (c * right.x + e * right.y + f * right.z) * inverse,
    );
    step += last * settling.momentum;
    step.z += press(place);
    return within_limits(step, place, least_seen(intervals, 4u * BLOCK_SLOT + 4u));
}

// The length that an interval should have after a pass in which lengths are free. `plane` holds the
// lengths of all intervals.
fn freed(plane: u32, intervals: vec4<u32>, length: f32, start: f32) -> f32 {
    var sum = 0.0;
    var count = 0.0;
    for (var k = 3u; k > 0u; k--) {
        let interval = intervals[k - 1u];
        if interval != NOWHERE {
            sum += pulled(plane, interval, 0.0);
            count += 1.0;
        }
    }
    let next = length + FREED * (sum / count - length) - settling.tension * length;
    return min(max(next, FREE_LEAST * start), FREE_MOST * start);
}

const SETTLING_STEP_GROUP = 64u;

var<workgroup> lane_longest: array<f32, SETTLING_STEP_GROUP>;

// Makes the step of the lane's place, and writes the workgroup's longest step into its row.
fn take_step(group: u32, lane: u32, block: bool) {
    let number = group * SETTLING_STEP_GROUP + lane;
    var longest = 0.0;
    if number < settling.places {
        var place = places[number];
        let row = place_rows[number];
        let intervals = intervals_of(strands[row.yarn], number);
        if (settling.flags & LENGTHS_FREE) != 0u && (row.tags & TAG_INTERVAL) != 0u {
            let plane = 4u * select(WEIGHTED_SLOT, BLOCK_SLOT, block) + 3u;
            lengths[number] = freed(plane, intervals, lengths[number], row.start_length);
        }
        if (row.tags & (TAG_POINT | TAG_PINNED)) == TAG_POINT {
            let last = steps[number].xyz;
            var step: vec3<f32>;
            if block {
                step = step_block(intervals, place, last);
            } else {
                step = step_weighted(intervals, place, last);
            }
            steps[number] = vec4(step, 0.0);
            place = vec4(place.xyz + to_units(step), place.w);
            longest = length3(step);
        }
        next[number] = place;
    }
    lane_longest[lane] = longest;
    for (var reach = SETTLING_STEP_GROUP / 2u; reach > 0u; reach /= 2u) {
        workgroupBarrier();
        if lane < reach {
            lane_longest[lane] = max(lane_longest[lane], lane_longest[lane + reach]);
        }
    }
    if lane == 0u && group * SETTLING_STEP_GROUP < settling.places {
        rows[group].step = lane_longest[0];
    }
}

// Makes the steps in the weighted form, with one lane for each place. The longest step of a
// workgroup goes into its row.
@compute @workgroup_size(SETTLING_STEP_GROUP)
fn settling_step_weighted(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
                          @builtin(local_invocation_index) lane: u32) {
    take_step(group.y * grid.x + group.x, lane, false);
}

// Makes the steps in the block form, with one lane for each place. The longest step of a workgroup
// goes into its row.
@compute @workgroup_size(SETTLING_STEP_GROUP)
fn settling_step_block(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
                       @builtin(local_invocation_index) lane: u32) {
    take_step(group.y * grid.x + group.x, lane, true);
}

const SETTLING_ENDS_GROUP = 64u;

// The mirror image of `other` about the point `here`.
fn reflected(here: vec4<i32>, other: vec4<i32>) -> vec4<i32> {
    return vec4(here.xyz + (here.xyz - other.xyz), here.w);
}

// Renews the places beyond the ends of yarns, with one lane for each yarn.
@compute @workgroup_size(SETTLING_ENDS_GROUP)
fn settling_ends(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
                 @builtin(local_invocation_index) lane: u32) {
    let yarn = (group.y * grid.x + group.x) * SETTLING_ENDS_GROUP + lane;
    if yarn >= settling.yarns {
        return;
    }
    let strand = strands[yarn];
    let first = strand.first;
    let last = first + strand.points - 1u;
    if strand.goes_on != 0u {
        let shift = vec4(strand.shift_x * settling.period_x, strand.shift_y * settling.period_y, 0, 0);
        next[first - 1u] = next[last] - shift;
        next[last + 1u] = next[first] + shift;
        next[last + 2u] = next[first + 1u] + shift;
    } else {
        let end = reflected(next[last], next[last - 1u]);
        next[first - 1u] = reflected(next[first], next[first + 1u]);
        next[last + 1u] = end;
        next[last + 2u] = end;
    }
}
