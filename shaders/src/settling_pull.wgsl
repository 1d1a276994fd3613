// Pulls at the four control points of each interval. This file follows settling.wgsl and
// settling_contact.wgsl.
//
// settling_pull.cl is the twin of this file, and Pull in texere-core's pass.rs is the definition.
// Pulls are added up in the order of the lists.
//
// Lanes write planes. A plane has a value for each place, which belongs to the interval that begins
// at the place. First come four slots of planes, one for each of the interval's control points. In
// the weighted form a slot has eight planes: the displacement by contacts (x, y, z, mm) and its
// weight, then the displacement by bends and its weight. In the block form a slot has nine planes:
// the displacement by all pulls (x, y, z, mm), and the products xx, xy, xz, yy, yz, zz of the
// components of their directions, each times its weight. Six planes follow the slots: a vector
// along the interval's chord, half as long as the interval's surplus length (x, y, z, mm); the
// interval's length, mm; the least distance to another yarn, mm; and the least ratio of such a
// distance to the sum of both yarns' reaches.

@group(0) @binding(15) var<storage, read> places: array<vec4<i32>>;
@group(0) @binding(17) var<storage, read> chords: array<vec4<u32>>;
@group(0) @binding(20) var<storage, read> starts: array<u32>;
@group(0) @binding(21) var<storage, read> neighbours: array<u32>;
@group(0) @binding(22) var<storage, read> lengths: array<f32>;
@group(0) @binding(23) var<storage, read_write> pulls: array<f32>;
@group(0) @binding(24) var<storage, read_write> rows: array<SeenRow>;
@group(0) @binding(30) var<storage, read_write> whole: array<SeenRow>;

const WEIGHTED_SLOT = 8u;
const BLOCK_SLOT = 9u;

fn interval_at(place: u32) -> Interval {
    return interval_of(places[place - 1u], places[place], places[place + 1u], places[place + 2u]);
}

// The pull of a bend at one place of an interval. `towards` is the direction in which the curve
// bends. `bends` has a weight for each control point, and `sum` is the sum of their sizes, 0 if the
// bend does not pull. The pull displaces a point by `-way` times the point's weight.
struct Bend {
    towards: vec3<f32>,
    way: vec3<f32>,
    bends: vec4<f32>,
    sum: f32,
}

fn bend_at(interval: Interval, tags: u32, u: f32, sight: ptr<function, Sight>) -> Bend {
    var bend: Bend;
    let velocity = interval_velocity(interval, u);
    let acceleration = interval_acceleration(interval, u);
    let square = max(dot3(velocity, velocity), SHORT);
    let across = acceleration - velocity * (dot3(acceleration, velocity) / square);
    let size = length3(across);
    if size <= 0.0 {
        return bend;
    }
    bend.towards = across * (1.0 / size);
    let diameter = 2.0 * interval_reach(interval, u, bend.towards);
    (*sight).radius = min((*sight).radius, square / (size * diameter));
    let limit = square / (BEND_MARGIN * BEND_RADIUS * diameter * max(settling.growth, 0.5));
    let soft = SOFT_BEND * settling.ease;
    let excess = select(soft * size, size - limit + soft * limit, size > limit);
    if excess > 0.0 {
        let s = settling.s;
        let before = (4.0 - 6.0 * u) * s;
        let behind = (6.0 * u - 2.0) * s;
        let end = 2.0 * (3.0 - 2.0 * s) + 6.0 * (s - 2.0) * u;
        bend.bends = folded(tags, vec4(before, -(before + end + behind), end, behind));
        bend.sum = abs(bend.bends.x) + abs(bend.bends.y) + abs(bend.bends.z) + abs(bend.bends.w);
        bend.way = bend.towards * (excess / (bend.sum * bend.sum));
    }
    return bend;
}

// The interval that begins at `place`.
fn meeting_at(place: u32) -> Meeting {
    var one: Meeting;
    one.interval = interval_at(place);
    one.tags = place_rows[place].tags;
    one.first = place_rows[place].first_chord;
    one.step = 1.0 / f32(place_rows[place + 1u].first_chord - one.first);
    return one;
}

// The start of a walk over the neighbours of an interval's chords, before the first neighbour.
// `go_to` walks on. `first` is the number of the interval's first chord.
fn before_listed(first: u32) -> ListedChord {
    var here: ListedChord;
    here.number = first - 1u;
    here.end = starts[first];
    return here;
}

// The direction from an interval's beginning to its end.
fn interval_along(interval: Interval) -> vec3<f32> {
    let chord = interval.c1 + interval.c2 + interval.c3;
    let length = length3(chord);
    if length > 0.0 {
        return chord * (1.0 / length);
    }
    return vec3(0.0);
}

fn write(plane: u32, place: u32, value: f32) {
    pulls[plane * settling.places + place] = value;
}

// Writes the length and the distances of an interval from plane `plane` on, and returns the
// interval's measures.
fn write_own(plane: u32, place: u32, length: vec3<f32>, arc: f32, sight: Sight) -> SeenRow {
    let wanted = lengths[place];
    write(plane, place, length.x);
    write(plane + 1u, place, length.y);
    write(plane + 2u, place, length.z);
    write(plane + 3u, place, arc);
    write(plane + 4u, place, sight.near);
    write(plane + 5u, place, sight.clearance);
    return SeenRow(sight.clearance, sight.radius, abs(arc - wanted) / wanted, 0.0);
}

fn write_way(plane: u32, place: u32, way: vec4<f32>) {
    write(plane, place, way.x);
    write(plane + 1u, place, way.y);
    write(plane + 2u, place, way.z);
    write(plane + 3u, place, way.w);
}

// Writes the ways and weights of four slots, from plane `plane` of each slot on.
fn write_ways(plane: u32, place: u32, ways: Ways) {
    write_way(plane, place, ways.a);
    write_way(WEIGHTED_SLOT + plane, place, ways.b);
    write_way(2u * WEIGHTED_SLOT + plane, place, ways.c);
    write_way(3u * WEIGHTED_SLOT + plane, place, ways.d);
}

// The sums of ways and weights at each of the four points.
struct Ways {
    a: vec4<f32>,
    b: vec4<f32>,
    c: vec4<f32>,
    d: vec4<f32>,
}

// The sums with one more pull: `ways` times `way`, and `weights`, are added at the four points.
fn add_ways(sums: Ways, way: vec3<f32>, ways: vec4<f32>, weights: vec4<f32>) -> Ways {
    return Ways(
        sums.a + vec4(way * ways.x, weights.x),
        sums.b + vec4(way * ways.y, weights.y),
        sums.c + vec4(way * ways.z, weights.z),
        sums.d + vec4(way * ways.w, weights.w),
    );
}

fn pull_weighted(place: u32) -> SeenRow {
    let one = meeting_at(place);
    var here = before_listed(one.first);
    var sight = Sight(UNSEEN, UNSEEN, UNSEEN);
    let pieces = place_rows[place + 1u].first_chord - one.first;
    let end = min(starts[one.first + pieces], arrayLength(&neighbours));
    var ways: Ways;
    for (var begin = here.end; begin < end; begin += MOST_AT_ONCE) {
        let count = min(end - begin, MOST_AT_ONCE);
        var bits = touching(here, begin, count, &sight);
        while bits != 0u {
            let next = begin + firstTrailingBit(bits);
            bits &= bits - 1u;
            go_to(&here, next);
            let push = meet(one, here, neighbours[next], &sight);
            if any(push.weights != vec4(0.0)) {
                ways = add_ways(ways, push.back, push.weights, CONTACT * abs(push.weights));
            }
        }
    }
    write_ways(0u, place, ways);
    ways = Ways();
    let parts = max(pieces, BEND_PARTS);
    for (var part = 0u; part <= parts; part++) {
        let bend = bend_at(one.interval, one.tags, f32(part) / f32(parts), &sight);
        if bend.sum > 0.0 {
            ways = add_ways(ways, bend.way, -bend.bends, abs(bend.bends) / bend.sum);
        }
    }
    write_ways(4u, place, ways);
    let arc = interval_arc(one.interval);
    let length = interval_along(one.interval) * ((arc - lengths[place]) * 0.5);
    return write_own(4u * WEIGHTED_SLOT, place, length, arc, sight);
}

// The sum of all ways at a point, and the sum of the squares of their directions.
struct Block {
    way: vec3<f32>,
    // xx, xy, xz and yy, yz, zz.
    with_x: vec3<f32>,
    others: vec3<f32>,
}

fn add_block(slot: Block, way: vec3<f32>, direction: vec3<f32>, weight: f32) -> Block {
    let counted = direction * weight;
    return Block(
        slot.way + way,
        slot.with_x + direction * counted.x,
        slot.others + vec3(counted.y * direction.y, counted.y * direction.z, counted.z * direction.z),
    );
}

struct Blocks {
    a: Block,
    b: Block,
    c: Block,
    d: Block,
}

// The sums with one more pull: `ways` times `way`, and `weights` in `direction`, are added at the
// four points.
fn add_blocks(sums: Blocks, way: vec3<f32>, ways: vec4<f32>, direction: vec3<f32>, weights: vec4<f32>) -> Blocks {
    return Blocks(
        add_block(sums.a, way * ways.x, direction, weights.x),
        add_block(sums.b, way * ways.y, direction, weights.y),
        add_block(sums.c, way * ways.z, direction, weights.z),
        add_block(sums.d, way * ways.w, direction, weights.w),
    );
}

fn write_block(plane: u32, place: u32, slot: Block) {
    write_way(plane, place, vec4(slot.way, slot.with_x.x));
    write_way(plane + 4u, place, vec4(slot.with_x.yz, slot.others.xy));
    write(plane + 8u, place, slot.others.z);
}

fn pull_block(place: u32) -> SeenRow {
    let one = meeting_at(place);
    var here = before_listed(one.first);
    var sight = Sight(UNSEEN, UNSEEN, UNSEEN);
    let pieces = place_rows[place + 1u].first_chord - one.first;
    let end = min(starts[one.first + pieces], arrayLength(&neighbours));
    var blocks: Blocks;
    for (var begin = here.end; begin < end; begin += MOST_AT_ONCE) {
        let count = min(end - begin, MOST_AT_ONCE);
        var bits = touching(here, begin, count, &sight);
        while bits != 0u {
            let next = begin + firstTrailingBit(bits);
            bits &= bits - 1u;
            go_to(&here, next);
            let push = meet(one, here, neighbours[next], &sight);
            if any(push.weights != vec4(0.0)) {
                let weights = CONTACT * abs(push.weights);
                blocks = add_blocks(blocks, push.back, push.weights, push.direction, weights);
            }
        }
    }
    let parts = max(pieces, BEND_PARTS);
    for (var part = 0u; part <= parts; part++) {
        let bend = bend_at(one.interval, one.tags, f32(part) / f32(parts), &sight);
        if bend.sum > 0.0 {
            let weights = abs(bend.bends) / bend.sum * BLOCK_BEND;
            blocks = add_blocks(blocks, bend.way, -bend.bends * BLOCK_BEND, bend.towards, weights);
        }
    }
    let arc = interval_arc(one.interval);
    let along = interval_along(one.interval);
    let length = along * ((arc - lengths[place]) * 0.5);
    blocks.b = add_block(blocks.b, length, along, 1.0);
    blocks.c = add_block(blocks.c, -length, along, 1.0);
    write_block(0u, place, blocks.a);
    write_block(BLOCK_SLOT, place, blocks.b);
    write_block(2u * BLOCK_SLOT, place, blocks.c);
    write_block(3u * BLOCK_SLOT, place, blocks.d);
    return write_own(4u * BLOCK_SLOT, place, length, arc, sight);
}

// The measures of two rows joined: the least clearance, the least radius of a bend, the largest
// error of a length, and the largest step.
fn seen_by_both(one: SeenRow, other: SeenRow) -> SeenRow {
    return SeenRow(
        min(one.clearance, other.clearance),
        min(one.radius, other.radius),
        max(one.length, other.length),
        max(one.step, other.step),
    );
}

const SETTLING_PULL_GROUP = 64u;

var<workgroup> lane_seen: array<SeenRow, SETTLING_PULL_GROUP>;

// Writes the row of a workgroup: the measures of its lanes. Lanes are joined in pairs, always the
// same ones.
fn write_row(number: u32, lane: u32, seen: SeenRow) {
    lane_seen[lane] = seen;
    for (var reach = SETTLING_PULL_GROUP / 2u; reach > 0u; reach /= 2u) {
        workgroupBarrier();
        if lane < reach {
            lane_seen[lane] = seen_by_both(lane_seen[lane], lane_seen[lane + reach]);
        }
    }
    if lane == 0u && number * SETTLING_PULL_GROUP < settling.places {
        rows[number] = lane_seen[0];
    }
}

fn has_interval(place: u32) -> bool {
    return place < settling.places && (place_rows[place].tags & TAG_INTERVAL) != 0u;
}

// Works out the pulls of all intervals in the weighted form, with one lane for each place at which
// an interval may begin. Each workgroup writes a row of its measures.
@compute @workgroup_size(SETTLING_PULL_GROUP)
fn settling_pull_weighted(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
                          @builtin(local_invocation_index) lane: u32) {
    let number = group.y * grid.x + group.x;
    let place = number * SETTLING_PULL_GROUP + lane;
    var seen = SeenRow(UNSEEN, UNSEEN, 0.0, 0.0);
    if has_interval(place) {
        seen = pull_weighted(place);
    }
    write_row(number, lane, seen);
}

// Works out the pulls of all intervals in the block form, with one lane for each place at which an
// interval may begin. Each workgroup writes a row of its measures.
@compute @workgroup_size(SETTLING_PULL_GROUP)
fn settling_pull_block(@builtin(workgroup_id) group: vec3<u32>, @builtin(num_workgroups) grid: vec3<u32>,
                       @builtin(local_invocation_index) lane: u32) {
    let number = group.y * grid.x + group.x;
    let place = number * SETTLING_PULL_GROUP + lane;
    var seen = SeenRow(UNSEEN, UNSEEN, 0.0, 0.0);
    if has_interval(place) {
        seen = pull_block(place);
    }
    write_row(number, lane, seen);
}

const SETTLING_SEEN_GROUP = 256u;

var<workgroup> lane_rows: array<SeenRow, SETTLING_SEEN_GROUP>;

// Joins the rows of all workgroups. It runs as one workgroup.
@compute @workgroup_size(SETTLING_SEEN_GROUP)
fn settling_seen(@builtin(local_invocation_index) lane: u32) {
    let count = (settling.places + SETTLING_PULL_GROUP - 1u) / SETTLING_PULL_GROUP;
    var seen = SeenRow(UNSEEN, UNSEEN, 0.0, 0.0);
    for (var row = lane; row < count; row += SETTLING_SEEN_GROUP) {
        seen = seen_by_both(seen, rows[row]);
    }
    lane_rows[lane] = seen;
    for (var reach = SETTLING_SEEN_GROUP / 2u; reach > 0u; reach /= 2u) {
        workgroupBarrier();
        if lane < reach {
            lane_rows[lane] = seen_by_both(lane_rows[lane], lane_rows[lane + reach]);
        }
    }
    if lane == 0u {
        whole[0] = lane_rows[0];
    }
}
