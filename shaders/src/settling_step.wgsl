// The step that each control point takes. After settling.wgsl and BLOCK.
//
// settling_step.cl is the twin of this file, and pass.rs of texere-core the definition.

@group(0) @binding(14) var<storage, read> strands: array<StrandRow>;
@group(0) @binding(15) var<storage, read> places: array<vec4<i32>>;
@group(0) @binding(22) var<storage, read_write> lengths: array<f32>;
@group(0) @binding(23) var<storage, read> pulls: array<f32>;
@group(0) @binding(24) var<storage, read_write> rows: array<SeenRow>;
// The step that each place has taken last, mm.
@group(0) @binding(28) var<storage, read_write> steps: array<vec4<f32>>;
@group(0) @binding(29) var<storage, read_write> next: array<vec4<i32>>;

const NO_PLACE = 0xffffffffu;

// The place of interval `interval` of a strand, counted from its first one, which may be one or two before or one behind; none where it has
// none.
fn strand_interval(strand: StrandRow, interval: i32) -> u32 {
    let count = bitcast<i32>(strand.points) - select(1, 0, strand.goes_on != 0u);
    var own = interval;
    if strand.goes_on != 0u {
        // It has three points at least.
        own = select(own, own + count, own < 0);
        own = select(own, own - count, own >= count);
    }
    return select(NO_PLACE, strand.first + bitcast<u32>(own), own >= 0 && own < count);
}

fn plane(number: u32, place: u32) -> f32 {
    return pulls[number * settling.places + place];
}

fn planes(number: u32, place: u32) -> vec4<f32> {
    return vec4(plane(number, place), plane(number + 1u, place), plane(number + 2u, place), plane(number + 3u, place));
}

// The way that an interval's length pulls its ends, mm; nothing where there is none.
fn length_at(place: u32) -> vec3<f32> {
    if place == NO_PLACE {
        return vec3(0.0);
    }
    return planes(4u * SLOT_PLANES, place).xyz;
}

// The step along z that plates make a point take, mm.
fn press(place: vec4<i32>, halves: vec2<f32>) -> f32 {
    if (settling.flags & PLATES) == 0u {
        return 0.0;
    }
    let z = f32(place.z) * settling.unit;
    let far = PRESS * settling.ease * max(abs(z) + halves.y - settling.half_gap, 0.0);
    return select(far, -far, z >= 0.0);
}

// What a symmetrical matrix, positive by its diagonal, turns into `right`: by its cofactors.
fn solved(xx: f32, xy: f32, xz: f32, yy: f32, yz: f32, zz: f32, right: vec3<f32>) -> vec3<f32> {
    let a = yy * zz - yz * yz;
    let b = xz * yz - xy * zz;
    let c = xy * yz - xz * yy;
    let d = xx * zz - xz * xz;
    let e = xy * xz - xx * yz;
    let f = xx * yy - xy * xy;
    let determinant = xx * a + xy * b + xz * c;
    let inverse = 1.0 / max(determinant, INERTIA * INERTIA * INERTIA);
    return vec3(
        (a * right.x + b * right.y + c * right.z) * inverse,
        (b * right.x + d * right.y + e * right.z) * inverse,
        (c * right.x + e * right.y + f * right.z) * inverse,
    );
}

// The step that the control point at `place` takes, mm. `own` is its number along its yarn.
fn step_of(place: u32, strand: StrandRow, own: i32) -> vec3<f32> {
    var first = vec4(0.0);
    var second = vec4(0.0);
    var last = 0.0;
    var near = UNSEEN;
    var clearance = UNSEEN;
    for (var slot = 0u; slot < 4u; slot++) {
        let interval = strand_interval(strand, own + 1 - bitcast<i32>(slot));
        if interval == NO_PLACE {
            continue;
        }
        first += planes(slot * SLOT_PLANES, interval);
        second += planes(slot * SLOT_PLANES + 4u, interval);
        if BLOCK {
            last += plane(slot * SLOT_PLANES + 8u, interval);
        }
        near = min(near, plane(4u * SLOT_PLANES + 4u, interval));
        clearance = min(clearance, plane(4u * SLOT_PLANES + 5u, interval));
    }
    let halves = halves_of(places[place]);
    let diameter = 2.0 * min(halves.x, halves.y);
    let pressed = press(places[place], halves);
    let on = steps[place].xyz * settling.momentum;
    var step: vec3<f32>;
    if BLOCK {
        step = solved(first.w + INERTIA, second.x, second.y, second.z + INERTIA, second.w, last + INERTIA, first.xyz) + on;
        step.z += pressed;
    } else {
        // Yarns that are about to cross obey contact alone.
        let apart = share((clearance / settling.growth - CROSSING) * CROSSING_SHARE);
        let bend = second.xyz * (BEND / max(second.w, BENDS_MIN));
        let ahead = length_at(strand_interval(strand, own));
        let back = length_at(strand_interval(strand, own - 1));
        var others = bend + (ahead - back) + on;
        others.z += pressed;
        step = first.xyz * (1.0 / max(first.w, CONTACTS_MIN)) + others * apart;
    }
    let most = min(STEP_NEAR * near, STEP_DIAMETER * diameter);
    let length = sqrt(inner(step, step));
    if length > most {
        return step * (most / length);
    }
    return step;
}

// The length that the interval at `place` is to have from now on.
fn freed(place: u32, strand: StrandRow, own: i32) -> f32 {
    let length = lengths[place];
    let start = place_rows[place].start_length;
    var sum = 0.0;
    var count = 0.0;
    for (var beside = -1; beside <= 1; beside++) {
        let interval = strand_interval(strand, own + beside);
        if interval != NO_PLACE {
            sum += plane(4u * SLOT_PLANES + 3u, interval);
            count += 1.0;
        }
    }
    let freed = length + FREED * (sum / count - length) - settling.tension * length;
    return min(max(freed, FREE_LEAST * start), FREE_MOST * start);
}

const STEP_GROUP = 64u;

var<workgroup> lane_longest: array<f32, STEP_GROUP>;

// A lane a place, and the longest step of each workgroup.
@compute @workgroup_size(STEP_GROUP)
fn settling_step(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
                 @builtin(local_invocation_index) lane: u32) {
    let number = group.y * grid.x + group.x;
    let place = number * STEP_GROUP + lane;
    var longest = 0.0;
    if place < settling.places {
        let row = place_rows[place];
        let strand = strands[row.yarn];
        let own = bitcast<i32>(place - strand.first);
        if (settling.flags & LENGTHS_FREE) != 0u && (row.tags & TAG_INTERVAL) != 0u {
            lengths[place] = freed(place, strand, own);
        }
        var there = places[place];
        if (row.tags & (TAG_POINT | TAG_PINNED)) == TAG_POINT {
            let step = step_of(place, strand, own);
            steps[place] = vec4(step, 0.0);
            there = vec4(there.xyz + units_of(step), there.w);
            longest = sqrt(inner(step, step));
        }
        next[place] = there;
    }
    lane_longest[lane] = longest;
    for (var reach = STEP_GROUP / 2u; reach > 0u; reach /= 2u) {
        workgroupBarrier();
        if lane < reach {
            longest = max(longest, lane_longest[lane + reach]);
            lane_longest[lane] = longest;
        }
    }
    if lane == 0u && number * STEP_GROUP < settling.places {
        rows[number].step = longest;
    }
}
