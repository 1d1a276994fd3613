// Lengths along yarns up to each block's start, and the attributes of vertices. This file follows
// common.wgsl.
//
// Its twins are attributes.cl and texere-cpu's attributes.rs. Lengths are whole steps of 2^-32 mm
// (Rust: ArcLength), so the order of the sums does not matter. A length is two words, the lower
// half first.

const ATTRIBUTES_GROUP = 64u;
const YARN_LENGTHS_GROUP = 256u;

// For each block, the length of its yarn up to the block's first ring.
@group(0) @binding(42) var<storage, read_write> arc_lengths: array<vec2<u32>>;
// An attribute (Rust: Attribute) is three elements: the yarn and the bits of the angle; the bits of
// the length and of the tangent's x; the bits of the tangent's y and z.
@group(0) @binding(43) var<storage, read_write> attribute_pieces: array<vec2<u32>>;
@group(0) @binding(10) var<storage, read> attribute_caps: array<CapRow>;

fn length_sum(one: vec2<u32>, other: vec2<u32>) -> vec2<u32> {
    let low = one.x + other.x;
    return vec2(low, one.y + other.y + select(0u, 1u, low < one.x));
}

fn length_difference(one: vec2<u32>, other: vec2<u32>) -> vec2<u32> {
    return vec2(one.x - other.x, one.y - other.y - select(0u, 1u, one.x < other.x));
}

// A length in mm as whole steps.
fn length_from_mm(mm: f32) -> vec2<u32> {
    let whole = floor(max(mm, 0.0));
    let part = max(mm, 0.0) - whole;
    return vec2(u32(part * LENGTH_STEPS), u32(min(whole, LENGTH_MM_MAX)));
}

fn length_mm(length: vec2<u32>) -> f32 {
    return f32(length.y) + f32(length.x) / LENGTH_STEPS;
}

// The speed of the spline at t.
fn segment_speed(segment: Segment, t: f32) -> f32 {
    let velocity = segment.c1.xyz + (segment.c2.xyz * 2.0 + segment.c3.xyz * (3.0 * t)) * t;
    return sqrt(dot(velocity, velocity));
}

// A length by the Gauss-Legendre rule, and the lowest and the highest speed at the rule's nodes and
// in the middle.
struct Rule {
    length: f32,
    slowest: f32,
    fastest: f32,
}

// Adds a pair of nodes, `reach` to either side of the middle.
fn rule_with(rule: Rule, segment: Segment, middle: f32, reach: f32, weight: f32) -> Rule {
    let before = segment_speed(segment, middle - reach);
    let behind = segment_speed(segment, middle + reach);
    return Rule(rule.length + weight * (before + behind), min(min(rule.slowest, before), behind),
                max(max(rule.fastest, before), behind));
}

// The length between two parameters, by the Gauss-Legendre rule with eight nodes.
fn length_by_rule(segment: Segment, start: f32, end: f32) -> Rule {
    let middle = (start + end) * 0.5;
    let half_way = (end - start) * 0.5;
    let speed = segment_speed(segment, middle);
    var rule = Rule(0.0, speed, speed);
    rule = rule_with(rule, segment, middle, half_way * ARC_NODE_1, ARC_WEIGHT_1);
    rule = rule_with(rule, segment, middle, half_way * ARC_NODE_2, ARC_WEIGHT_2);
    rule = rule_with(rule, segment, middle, half_way * ARC_NODE_3, ARC_WEIGHT_3);
    rule = rule_with(rule, segment, middle, half_way * ARC_NODE_4, ARC_WEIGHT_4);
    rule.length *= half_way;
    return rule;
}

// The length between two parameters. If the speed is uneven, the interval between them is split
// into parts, whose lengths are added up.
fn segment_length(segment: Segment, start: f32, end: f32) -> f32 {
    let rule = length_by_rule(segment, start, end);
    if rule.slowest >= ARC_EVEN * rule.fastest {
        return rule.length;
    }
    let part = (end - start) / f32(ARC_PANELS);
    var sum = 0.0;
    for (var panel = 0u; panel < ARC_PANELS; panel++) {
        let own = start + f32(panel) * part;
        sum += length_by_rule(segment, own, own + part).length;
    }
    return sum;
}

// The length from ring number `k` of the block to the next ring. The ring must not be the yarn's
// last.
fn step_length(block: Block, k: u32) -> vec2<u32> {
    let per_interval = params.subdivisions + 1u;
    let place = block.first_ring % per_interval + k;
    let interval = quotient(place, per_interval);
    let part = place - interval * per_interval;
    let segment = segment_new(block.first_point + interval, params.s);
    // At the interval's end this is set to 1, since the last multiple of the step may differ
    // slightly from 1.
    let end = select(f32(part + 1u) * params.step, 1.0, part + 1u == per_interval);
    return length_from_mm(segment_length(segment, f32(part) * params.step, end));
}

var<workgroup> length_sums: array<vec2<u32>, YARN_LENGTHS_GROUP>;

// The sum of the lengths of all lanes up to this one, inclusive. Until the next barrier the last of
// `length_sums` is the sum of all `lanes`. Every lane must call this function.
fn running_length(lane: u32, lanes: u32, length: vec2<u32>) -> vec2<u32> {
    length_sums[lane] = length;
    for (var reach = 1u; reach < lanes; reach *= 2u) {
        workgroupBarrier();
        var further = vec2(0u, 0u);
        if lane >= reach {
            further = length_sums[lane - reach];
        }
        workgroupBarrier();
        length_sums[lane] = length_sum(length_sums[lane], further);
    }
    workgroupBarrier();
    return length_sums[lane];
}

// The length from ring `lane` of a block to the next ring, or 0 if no quads start from ring `lane`.
fn lane_length(block: Block, lane: u32) -> vec2<u32> {
    if lane >= block.quads {
        return vec2(0u, 0u);
    }
    return step_length(block, lane);
}

// Writes the length of each block of a chunk, from its first ring to the next block's first ring,
// or to the yarn's last ring. It runs with one workgroup of ATTRIBUTES_GROUP lanes for each row of
// the block table.
@compute @workgroup_size(ATTRIBUTES_GROUP)
fn block_lengths(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
                 @builtin(local_invocation_index) lane: u32) {
    let row = group.y * grid.x + group.x;
    if row >= params.blocks {
        return;
    }
    let block = blocks[row];
    let sum = running_length(lane, ATTRIBUTES_GROUP, lane_length(block, lane));
    if lane == ATTRIBUTES_GROUP - 1u {
        arc_lengths[yarns[block.yarn].first_block + block.first_ring / BLOCK_RINGS] = sum;
    }
}

// Replaces the length of each block of a yarn by the total length of the blocks before it, one tile
// of YARN_LENGTHS_GROUP blocks after the other. It runs with one workgroup of YARN_LENGTHS_GROUP
// lanes for each of `params.blocks` yarns from `params.first_yarn` on.
@compute @workgroup_size(YARN_LENGTHS_GROUP)
fn yarn_lengths(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
                @builtin(local_invocation_index) lane: u32) {
    let row = group.y * grid.x + group.x;
    if row >= params.blocks {
        return;
    }
    let yarn = yarns[params.first_yarn + row];
    let blocks = (yarn.rings - 1u) / BLOCK_RINGS + 1u;

    var before = vec2(0u, 0u);
    for (var tile = 0u; tile < blocks; tile += YARN_LENGTHS_GROUP) {
        let block = tile + lane;
        var length = vec2(0u, 0u);
        if block < blocks {
            length = arc_lengths[yarn.first_block + block];
        }
        let sum = running_length(lane, YARN_LENGTHS_GROUP, length);
        if block < blocks {
            arc_lengths[yarn.first_block + block] = length_difference(length_sum(before, sum), length);
        }
        before = length_sum(before, length_sums[YARN_LENGTHS_GROUP - 1u]);
        workgroupBarrier();
    }
}

// For each ring, the length along the yarn, mm, and the tangent.
var<workgroup> attribute_rings: array<vec4<f32>, ATTRIBUTES_GROUP>;

// Writes the attributes of the vertices of a chunk's tubes. It runs with one workgroup of
// ATTRIBUTES_GROUP lanes for each row of the block table.
@compute @workgroup_size(ATTRIBUTES_GROUP)
fn attributes(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
              @builtin(local_invocation_index) lane: u32) {
    let row = group.y * grid.x + group.x;
    if row >= params.blocks {
        return;
    }
    let block = blocks[row];
    let yarn = yarns[block.yarn];
    let length = lane_length(block, lane);
    let sum = running_length(lane, ATTRIBUTES_GROUP, length);
    if lane < block.rings {
        let here = ring_sample(yarn, block, lane);
        let start = arc_lengths[yarn.first_block + block.first_ring / BLOCK_RINGS];
        let along = length_sum(start, length_difference(sum, length));
        attribute_rings[lane] = vec4(length_mm(along), here.sample.tangent);
    }
    workgroupBarrier();
    // Three stores of 8 bytes a vertex, contiguous across lanes.
    for (var piece = lane; piece < 3u * params.sides * block.rings; piece += ATTRIBUTES_GROUP) {
        let vertex = piece / 3u;
        let ring = vertex / params.sides;
        let here = attribute_rings[ring];
        var stored = bitcast<vec2<u32>>(here.zw);
        if piece % 3u == 0u {
            let angle = f32(vertex - ring * params.sides) * (FULL_TURN / f32(params.sides));
            stored = vec2(block.yarn, bitcast<u32>(angle));
        } else if piece % 3u == 1u {
            stored = bitcast<vec2<u32>>(here.xy);
        }
        attribute_pieces[3u * block.first_vertex + piece] = stored;
    }
}

// Writes the attributes of caps, which equal those of the end rings. It runs with one lane for each
// cap vertex.
@compute @workgroup_size(ATTRIBUTES_GROUP)
fn cap_attributes(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
                  @builtin(local_invocation_index) lane: u32) {
    let number = (group.y * grid.x + group.x) * ATTRIBUTES_GROUP + lane;
    if number >= params.caps * params.sides {
        return;
    }
    let cap = attribute_caps[number / params.sides];
    let corner = number % params.sides;
    for (var piece = 0u; piece < 3u; piece++) {
        attribute_pieces[3u * (cap.first_vertex + corner) + piece] =
            attribute_pieces[3u * (cap.ring_vertex + corner) + piece];
    }
}
