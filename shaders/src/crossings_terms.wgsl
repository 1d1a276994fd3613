// The energy: what threads want, and what keeps them apart. After crossings.wgsl and crossings_passage.wgsl.
//
// crossings_terms.cl is the twin of this file, and texere-core (crossings/terms.rs) the definition.

// A crossing along a thread.
struct Along {
    site: vec2<u32>,
    there: bool,
    // How the thread lies there, and how far it is to the next crossing.
    lie: vec4<f32>,
    gap: f32,
}

fn along_of(site: vec2<u32>, of_set: u32, steps: i32) -> Along {
    var along: Along;
    along.site = beside(site, of_set, steps, 0);
    along.there = is_there(along.site);
    if along.there {
        along.lie = lie_of(along.site, of_set);
        along.gap = thread_of(along.site, 1u - of_set).gap;
    }
    return along;
}

// Shape, area, and the press.
fn add_section(block: ptr<function, Block>, lie: vec4<f32>, radius: f32) {
    let wide = lie.z / radius;
    let thick = lie.w / radius;
    let aspect = vec4(0.0, 0.0, 1.0 / radius, -CROSSINGS_ASPECT / radius);
    add_own(block, CROSSINGS_SHAPE, 1.0, wide - CROSSINGS_ASPECT * thick, aspect);
    let gain = wide * thick - cloth.area;
    let weight = select(CROSSINGS_AREA_GAIN, CROSSINGS_AREA_LOSS, gain < 0.0);
    add_own(block, weight, 1.0, gain, vec4(0.0, 0.0, thick / radius, wide / radius));
    let press = CROSSINGS_PRESS * cloth.press * 4.0 * radius * radius;
    add_alone(block, vec4(0.0, press, 0.0, 0.0), 1.0, lie, 1.0);
}

// A second difference along the thread, which has this slope in what is unknown here.
fn add_bend(block: ptr<function, Block>, thread: ThreadRow, before: Along, middle: Along, after: Along, slope: f32, share: f32) {
    if !before.there || !middle.there || !after.there {
        return;
    }
    let square = 4.0 * thread.radius * thread.radius;
    let pitch = 0.5 * (before.gap + middle.gap);
    let stiff = thread.stiffness * square * square / (pitch * pitch * pitch);
    let weights = vec4(CROSSINGS_SIDEWAYS_BEND * stiff, CROSSINGS_BEND * stiff, 0.0, 0.0);
    add_alone(block, weights, share, before.lie - 2.0 * middle.lie + after.lie, slope);
}

// First differences along the thread to a crossing `gap` away: tension, and sections that change little.
fn add_difference(block: ptr<function, Block>, lie: vec4<f32>, other: Along, gap: f32, tension: f32, evenness: f32) {
    if other.there {
        let taut = tension / gap;
        let weights = vec4(CROSSINGS_SIDEWAYS_TENSION * taut, CROSSINGS_TENSION * taut, evenness, evenness);
        add_alone(block, weights, 2.0, lie - other.lie, 1.0);
    }
}

// What a thread does to what it crosses between two crossings, the `second` of which is this one or else the first.
struct Meeting {
    room: f32,
    // Slopes in its own height and half height, and in what is unknown of the thread that it crosses here.
    slopes: vec2<f32>,
    crossed: vec4<f32>,
    clearance: f32,
}

// The thread stays on its side. Where it slopes it clears the shoulder of the thread under its upper end.
fn shoulder(side: f32, first: Along, last: Along, one: vec4<f32>, two: vec4<f32>, second: bool) -> Meeting {
    let rises = side * (last.lie.y - first.lie.y) > 0.0;
    let upper = select(first.lie, last.lie, rises);
    let lower = select(last.lie, first.lie, rises);
    let under = select(one, two, rises);
    let across = first.gap + two.x - one.x;
    let slope = side * (upper.y - lower.y) / across;
    // Upright, not across the slope.
    let length = sqrt(1.0 + slope * slope);
    let x = under.z * slope;
    let z = under.w;
    let reach = sqrt(x * x + z * z);
    let above = side * (upper.y - under.y);
    let need = reach + upper.w * length;
    let steeper = under.z * x / reach + upper.w * slope / length;
    let wider = steeper * slope / across;
    let shift = select(-wider, wider, second);
    let rise = steeper / across;
    let room = above - need - CROSSINGS_MARGIN;
    if second == rises {
        let crossed = vec4(shift, -side, -x * slope / reach, -z / reach);
        return Meeting(room, vec2(side * (1.0 - rise), -length), crossed, above / need);
    }
    return Meeting(room, vec2(side * rise, 0.0), vec4(shift, 0.0, 0.0, 0.0), above / need);
}

// The thread changes sides.
fn passage(side: f32, first: Along, last: Along, one: vec4<f32>, two: vec4<f32>, second: bool) -> Meeting {
    let across = first.gap + two.x - one.x;
    let rise = side * (two.y - one.y);
    let found = passage_of(across, rise, vec4(one.zw, two.zw), first.lie.w + last.lie.w);
    // This crossing's share of it.
    let c = found.slope.x;
    let s = found.slope.y;
    let lie = select(one, two, second);
    let reach = select(found.reach.x, found.reach.y, second);
    let sign = select(-1.0, 1.0, second);
    let crossed = vec4(sign * s, sign * side * c, -lie.z * s * s / reach, -lie.w * c * c / reach);
    let clearance = found.between / (found.between - found.room);
    return Meeting(found.room - CROSSINGS_MARGIN, vec2(0.0, -1.0), crossed, clearance);
}

fn add_meeting(block: ptr<function, Block>, of_set: u32, first: Along, last: Along, second: bool) {
    if !first.there || !last.there {
        return;
    }
    let one = lie_of(first.site, 1u - of_set);
    let two = lie_of(last.site, 1u - of_set);
    let side = side_of(first.site, of_set);
    var meeting: Meeting;
    if side == side_of(last.site, of_set) {
        meeting = shoulder(side, first, last, one, two, second);
    } else {
        meeting = passage(side, first, last, one, two, second);
    }
    see(block, meeting.clearance);
    if meeting.room < CROSSINGS_NEAR {
        add_between(block, cloth.penalty, 2.0, min(meeting.room, 0.0), meeting.slopes, meeting.crossed);
    }
}

// Neighbours of one set half way between two crossings, as ellipses.
fn add_half_way(block: ptr<function, Block>, own: vec4<f32>, next: Along, neighbour: vec4<f32>, opposite: vec4<f32>, gap: f32, sign: f32) {
    let apart = gap + sign * 0.5 * (neighbour.x + opposite.x - own.x - next.lie.x);
    let rise = 0.5 * (neighbour.y + opposite.y - own.y - next.lie.y);
    let wide = 0.5 * (own.z + next.lie.z + neighbour.z + opposite.z);
    let thick = 0.5 * (own.w + next.lie.w + neighbour.w + opposite.w);
    let x = apart / wide;
    let z = rise / thick;
    let clearance = sqrt(x * x + z * z);
    see(block, clearance);
    let room = (clearance - 1.0) * wide - CROSSINGS_MARGIN;
    if room < CROSSINGS_NEAR {
        let slopes = vec4(
            -sign * 0.5 * x / clearance,
            -0.5 * z * wide / (thick * clearance),
            0.5 * (clearance - 1.0 - x * x / clearance),
            -0.5 * z * z * wide / (thick * clearance),
        );
        add_own(block, cloth.penalty, 4.0, min(room, 0.0), slopes);
    }
}

// Neighbours of one set keep to their own places at a crossing, whatever their heights, and are clear of one another beside it.
fn add_neighbour(block: ptr<function, Block>, of_set: u32, before: Along, here: Along, after: Along, across: i32) {
    let site = beside(here.site, of_set, 0, across);
    if !is_there(site) {
        return;
    }
    let sign = f32(across);
    let other = lie_of(site, of_set);
    var lower = here.site;
    if across < 0 {
        lower = site;
    }
    let gap = thread_of(lower, of_set).gap;
    let apart = gap + sign * (other.x - here.lie.x);
    let need = here.lie.z + other.z;
    see(block, apart / need);
    let room = apart - need - CROSSINGS_MARGIN;
    if room < CROSSINGS_NEAR {
        add_own(block, cloth.penalty, 2.0, min(room, 0.0), vec4(-sign, 0.0, -1.0, 0.0));
    }
    if before.there {
        add_half_way(block, here.lie, before, other, lie_of(beside(before.site, of_set, 0, across), of_set), gap, sign);
    }
    if after.there {
        add_half_way(block, here.lie, after, other, lie_of(beside(after.site, of_set, 0, across), of_set), gap, sign);
    }
}

// Both threads of a crossing lie one on top of the other. The block is seen from the warp.
fn add_contact(block: ptr<function, Block>, site: vec2<u32>) {
    let warp = lie_of(site, WARP);
    let weft = lie_of(site, WEFT);
    let side = side_of(site, WARP);
    let apart = side * (warp.y - weft.y);
    let need = warp.w + weft.w;
    see(block, apart / need);
    let room = apart - need - CROSSINGS_MARGIN;
    if room < CROSSINGS_NEAR {
        add_between(block, cloth.penalty, 1.0, min(room, 0.0), vec2(side, -1.0), vec4(0.0, -side, 0.0, -1.0));
    }
}

// All terms of one set that a crossing is part of.
fn add_set(block: ptr<function, Block>, site: vec2<u32>, of_set: u32) {
    let thread = thread_of(site, of_set);
    let radius = thread.radius;
    let two_before = along_of(site, of_set, -2);
    let before = along_of(site, of_set, -1);
    let here = along_of(site, of_set, 0);
    let after = along_of(site, of_set, 1);
    let two_after = along_of(site, of_set, 2);
    add_section(block, here.lie, radius);
    // Slopes are 1, -2 and 1.
    add_bend(block, thread, two_before, before, here, 1.0, 4.0);
    add_bend(block, thread, before, here, after, -2.0, 2.0);
    add_bend(block, thread, here, after, two_after, 1.0, 4.0);
    let tension = select(cloth.tension_weft, cloth.tension_warp, of_set == WARP) * 4.0 * radius * radius;
    let evenness = CROSSINGS_SMOOTH / (radius * radius);
    add_difference(block, here.lie, before, before.gap, tension, evenness);
    add_difference(block, here.lie, after, here.gap, tension, evenness);
    add_meeting(block, of_set, before, here, true);
    add_meeting(block, of_set, here, after, false);
    add_neighbour(block, of_set, before, here, after, -1);
    add_neighbour(block, of_set, before, here, after, 1);
}

// All terms that a crossing is part of, seen from the warp.
fn gathered(site: vec2<u32>) -> Block {
    var block: Block;
    block.clearance = UNSEEN;
    for (var of_set = WARP; of_set <= WEFT; of_set++) {
        add_set(&block, site, of_set);
        block = turned(block);
    }
    add_contact(&block, site);
    return block;
}
