// The energy of a crossing: terms of single threads, and terms that keep threads apart. This file
// follows crossings.wgsl and crossings_passage.wgsl.
//
// crossings_terms.cl is the twin of this file, and texere-core's crossings/terms.rs and contacts.rs
// are the definition.

// A crossing on a thread, some steps along the thread from another crossing.
struct Along {
    site: vec2<u32>,
    there: bool,
    // The thread's lie at this crossing, and the distance to the next crossing.
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

// Adds the terms of the section: its shape, its area, its least area, and the press.
fn add_section(block: ptr<function, CrossingBlock>, lie: vec4<f32>, thread: ThreadRow) {
    let radius = thread.radius;
    let wide = lie.z / radius;
    let thick = lie.w / radius;
    let sides = vec4(0.0, 0.0, 1.0 / radius, -thread.aspect / radius);
    add_own(block, thread.shape, 1.0, wide - thread.aspect * thick, sides);
    let gain = wide * thick - cloth.area;
    // Just below its full area a section takes the curvature of a section above that area.
    // Otherwise it would grow beyond the area in one pass, and shrink back in the next.
    let weight = select(CROSSINGS_AREA_GAIN, CROSSINGS_AREA_LOSS, gain < -CROSSINGS_NEAR);
    let residual = select(gain, CROSSINGS_AREA_LOSS / weight * gain, gain < 0.0);
    let slopes = vec4(0.0, 0.0, thick / radius, wide / radius);
    add_own(block, weight, 1.0, residual, slopes);
    let room = wide * thick - thread.least_area * cloth.area - CROSSINGS_MARGIN;
    if room < CROSSINGS_NEAR {
        add_own(block, CROSSINGS_SOLID * cloth.penalty, 1.0, min(room, 0.0), slopes);
    }
    let press = CROSSINGS_PRESS * cloth.press * 4.0 * radius * radius;
    add_alone(block, vec4(0.0, press, 0.0, 0.0), 1.0, lie, 1.0);
}

// Adds the term of a bend: a second difference along the thread, with slope `slope` in the unknowns
// of this crossing.
fn add_bend(block: ptr<function, CrossingBlock>, thread: ThreadRow, before: Along, middle: Along, after: Along, slope: f32, share: f32) {
    if !before.there || !middle.there || !after.there {
        return;
    }
    let square = 4.0 * thread.radius * thread.radius;
    let pitch = 0.5 * (before.gap + middle.gap);
    let stiff = thread.stiffness * square * square / (pitch * pitch * pitch);
    let weights = vec4(CROSSINGS_SIDEWAYS_BEND * stiff, CROSSINGS_BEND * stiff, 0.0, 0.0);
    add_alone(block, weights, share, before.lie - 2.0 * middle.lie + after.lie, slope);
}

// Adds the terms of first differences along the thread, to a crossing `gap` away: tension, and
// evenness of sections. `sign` is -1 for the crossing before, and 1 for the one after. A taut
// thread pulls apart the two threads between which it changes sides.
fn add_difference(block: ptr<function, CrossingBlock>, of_set: u32, here: Along, other: Along, sign: f32, gap: f32, tension: f32, evenness: f32) {
    if !other.there {
        return;
    }
    let taut = tension / gap;
    let weights = vec4(CROSSINGS_SIDEWAYS_TENSION * taut, 0.0, evenness, evenness);
    add_alone(block, weights, 2.0, here.lie - other.lie, 1.0);
    let to = lie_of(other.site, 1u - of_set).x;
    let span = gap + sign * (to - lie_of(here.site, 1u - of_set).x);
    let shorter = sqrt(gap / span);
    let rise = shorter * (here.lie.y - other.lie.y);
    let crossed = vec4(0.5 * sign * rise / span, 0.0, 0.0, 0.0);
    add_between(block, CROSSINGS_TENSION * taut, 2.0, rise, vec2(shorter, 0.0), crossed);
}

// The room between a thread and the threads that it crosses, on the way between two crossings. In
// the functions below, `second` is true if this crossing is the second of the two.
struct Meeting {
    room: f32,
    // The slopes of the room in the thread's height and half height, and in the unknowns of the
    // thread that it crosses here.
    slopes: vec2<f32>,
    crossed: vec4<f32>,
    clearance: f32,
}

// The meeting of a thread that stays on its side. If it slopes, it has to clear the shoulder of the
// thread under its upper end.
fn shoulder(side: f32, first: Along, last: Along, one: vec4<f32>, two: vec4<f32>, second: bool) -> Meeting {
    let rises = side * (last.lie.y - first.lie.y) > 0.0;
    let upper = select(first.lie, last.lie, rises);
    let lower = select(last.lie, first.lie, rises);
    let under = select(one, two, rises);
    let across = first.gap + two.x - one.x;
    let slope = side * (upper.y - lower.y) / across;
    // Measured upright, the thread's half height is longer by this factor than across the slope.
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

// The meeting of a thread that changes sides.
fn passage(side: f32, first: Along, last: Along, one: vec4<f32>, two: vec4<f32>, second: bool) -> Meeting {
    let across = first.gap + two.x - one.x;
    let rise = side * (two.y - one.y);
    let found = passage_of(across, rise, vec4(one.zw, two.zw), first.lie.w + last.lie.w);
    // The slopes in the unknowns of this crossing.
    let c = found.slope.x;
    let s = found.slope.y;
    let lie = select(one, two, second);
    let reach = select(found.reach.x, found.reach.y, second);
    let sign = select(-1.0, 1.0, second);
    let crossed = vec4(sign * s, sign * side * c, -lie.z * s * s / reach, -lie.w * c * c / reach);
    let clearance = found.between / (found.between - found.room);
    return Meeting(found.room - CROSSINGS_MARGIN, vec2(0.0, -1.0), crossed, clearance);
}

fn add_meeting(block: ptr<function, CrossingBlock>, of_set: u32, first: Along, last: Along, second: bool) {
    if !first.there || !last.there {
        return;
    }
    let one = lie_of(first.site, 1u - of_set);
    let two = lie_of(last.site, 1u - of_set);
    let side = side_of(first.site, of_set);
    var meeting: Meeting;
    if side == side_of(last.site, of_set) {
        // A level thread clears the shoulder if it clears the thread where they cross.
        if abs(last.lie.y - first.lie.y) < CROSSINGS_NEAR {
            return;
        }
        meeting = shoulder(side, first, last, one, two, second);
    } else {
        meeting = passage(side, first, last, one, two, second);
    }
    see(block, meeting.clearance);
    if meeting.room < CROSSINGS_NEAR {
        add_between(block, cloth.penalty, 2.0, min(meeting.room, 0.0), meeting.slopes, meeting.crossed);
    }
}

// Adds the term of the room between this crossing and the crossing `steps` further along the
// thread, past threads of other levels.
fn add_meeting_past(block: ptr<function, CrossingBlock>, of_set: u32, here: Along, steps: i32) {
    let other = along_of(here.site, of_set, steps);
    if !other.there {
        return;
    }
    let second = steps < 0;
    var first = here;
    var last = other;
    if second {
        first = other;
        last = here;
    }
    first.gap = way_of(first.site, 1u - of_set, abs(steps));
    add_meeting(block, of_set, first, last, second);
}

// Adds the term that keeps two ellipses clear of one another. `part` is the share that the lie at
// this crossing has in its ellipse: 1, or a half between two crossings.
fn keep_clear(block: ptr<function, CrossingBlock>, apart: f32, rise: f32, wide: f32, thick: f32, sign: f32, part: f32) {
    let x = apart / wide;
    let z = rise / thick;
    let clearance = sqrt(x * x + z * z);
    see(block, clearance);
    let room = (clearance - 1.0) * wide - CROSSINGS_MARGIN;
    if room < CROSSINGS_NEAR {
        let slopes = vec4(
            -sign * part * x / clearance,
            -part * z * wide / (thick * clearance),
            part * (clearance - 1.0 - x * x / clearance),
            -part * z * z * wide / (thick * clearance),
        );
        add_own(block, cloth.penalty, 2.0 / part, min(room, 0.0), slopes);
    }
}

// Adds the term that keeps neighbours of one set clear half way from this crossing to the `next`.
// There the neighbours are ellipses. They are `gap` apart before they shift. If other threads lie
// between the neighbours, both are of one level, and have to be neighbours at both crossings.
fn add_half_way(block: ptr<function, CrossingBlock>, of_set: u32, own: vec4<f32>, next: Along, neighbour: vec4<f32>, across: i32, gap: f32) {
    if !next.there {
        return;
    }
    if abs(across) > 1 {
        let steps = steps_of(next.site, of_set);
        if select(steps.y, steps.x, across < 0) != abs(across) {
            return;
        }
    }
    let opposite = lie_of(beside(next.site, of_set, 0, across), of_set);
    let sign = f32(sign(across));
    let apart = gap + sign * 0.5 * (neighbour.x + opposite.x - own.x - next.lie.x);
    let rise = 0.5 * (neighbour.y + opposite.y - own.y - next.lie.y);
    let wide = 0.5 * (own.z + next.lie.z + neighbour.z + opposite.z);
    let thick = 0.5 * (own.w + next.lie.w + neighbour.w + opposite.w);
    keep_clear(block, apart, rise, wide, thick, sign, 0.5);
}

// Adds the terms that keep a thread and a neighbour of its set clear. At a crossing, neighbours of
// one level lie side by side, whatever their heights. Neighbours of two levels lie side by side or
// one above the other, as ellipses. Half way to the crossings before and after, all neighbours are
// ellipses.
fn add_neighbour(block: ptr<function, CrossingBlock>, of_set: u32, before: Along, here: Along, after: Along, across: i32, of_level: bool) {
    let site = beside(here.site, of_set, 0, across);
    if !is_there(site) {
        return;
    }
    let sign = f32(sign(across));
    let other = lie_of(site, of_set);
    var lower = here.site;
    if across < 0 {
        lower = site;
    }
    let gap = way_of(lower, of_set, abs(across));
    let apart = gap + sign * (other.x - here.lie.x);
    let need = here.lie.z + other.z;
    if of_level {
        see(block, apart / need);
        let room = apart - need - CROSSINGS_MARGIN;
        if room < CROSSINGS_NEAR {
            add_own(block, cloth.penalty, 2.0, min(room, 0.0), vec4(-sign, 0.0, -1.0, 0.0));
        }
    } else {
        keep_clear(block, apart, other.y - here.lie.y, need, here.lie.w + other.w, sign, 1.0);
    }
    add_half_way(block, of_set, here.lie, before, other, across, gap);
    add_half_way(block, of_set, here.lie, after, other, across, gap);
}

// Adds the terms of a thread's neighbours on one side. The nearest neighbour of its own level lies
// `steps` threads away; 0 means that there is none.
fn add_neighbours(block: ptr<function, CrossingBlock>, of_set: u32, before: Along, here: Along, after: Along, side: i32, steps: i32) {
    if steps != 0 {
        add_neighbour(block, of_set, before, here, after, side * steps, true);
    }
    if steps != 1 {
        add_neighbour(block, of_set, before, here, after, side, false);
    }
}

// How steeply a thread rises or falls beside a crossing, on its steeper side.
fn slope_of(site: vec2<u32>, of_set: u32) -> f32 {
    let before = along_of(site, of_set, -1);
    let here = along_of(site, of_set, 0);
    let after = along_of(site, of_set, 1);
    var steepest = 0.0;
    if before.there {
        steepest = abs((before.lie.y - here.lie.y) / before.gap);
    }
    if after.there {
        steepest = max(steepest, abs((after.lie.y - here.lie.y) / here.gap));
    }
    return steepest;
}

// Adds the term of the contact between both threads of a crossing, one on top of the other. Threads
// of one layer touch. The block is described from the warp.
fn add_contact(block: ptr<function, CrossingBlock>, site: vec2<u32>) {
    let warp = lie_of(site, WARP);
    let weft = lie_of(site, WEFT);
    let side = side_of(site, WARP);
    // Threads of two layers slope where they cross. Along the slope of the other thread an ellipse
    // reaches further.
    var slope = vec2(0.0);
    let word = sites[number_of(site)];
    if (word & SITE_APART) != 0u {
        slope = CROSSINGS_STEEPER * vec2(slope_of(site, WEFT), slope_of(site, WARP));
    }
    let x = vec2(warp.z, weft.z) * slope;
    let z = vec2(warp.w, weft.w);
    let reach = sqrt(x * x + z * z);
    let apart = side * (warp.y - weft.y);
    let need = reach.x + reach.y;
    see(block, apart / need);
    let room = apart - need - CROSSINGS_MARGIN;
    let near = room < CROSSINGS_NEAR;
    let pull = select(0.0, CROSSINGS_TOUCH, (word & SITE_TOUCH) != 0u);
    if near || pull > 0.0 {
        let weight = select(pull, cloth.penalty, near);
        let residual = select(pull / weight * room, room, room < 0.0);
        let wider = -x * slope / reach;
        let thicker = -z / reach;
        let own = vec4(0.0, side, wider.x, thicker.x);
        add_both(block, weight, residual, own, vec4(0.0, -side, wider.y, thicker.y));
    }
}

// Adds all terms of one set that a crossing is part of.
fn add_set(block: ptr<function, CrossingBlock>, site: vec2<u32>, of_set: u32) {
    let thread = thread_of(site, of_set);
    let radius = thread.radius;
    let two_before = along_of(site, of_set, -2);
    let before = along_of(site, of_set, -1);
    let here = along_of(site, of_set, 0);
    let after = along_of(site, of_set, 1);
    let two_after = along_of(site, of_set, 2);
    add_section(block, here.lie, thread);
    // The slopes of the second differences in this crossing's unknowns are 1, -2 and 1.
    add_bend(block, thread, two_before, before, here, 1.0, 4.0);
    add_bend(block, thread, before, here, after, -2.0, 2.0);
    add_bend(block, thread, here, after, two_after, 1.0, 4.0);
    let tension = select(cloth.tension_weft, cloth.tension_warp, of_set == WARP) * 4.0 * radius * radius;
    let evenness = CROSSINGS_SMOOTH / (radius * radius);
    add_difference(block, of_set, here, before, -1.0, before.gap, tension, evenness);
    add_difference(block, of_set, here, after, 1.0, here.gap, tension, evenness);
    add_meeting(block, of_set, before, here, true);
    add_meeting(block, of_set, here, after, false);
    let steps = steps_of(site, of_set);
    add_neighbours(block, of_set, before, here, after, -1, steps.x);
    add_neighbours(block, of_set, before, here, after, 1, steps.y);
    let crossed = steps_of(site, 1u - of_set);
    if crossed.x > 1 {
        add_meeting_past(block, of_set, here, -crossed.x);
    }
    if crossed.y > 1 {
        add_meeting_past(block, of_set, here, crossed.y);
    }
}

// Takes the own shift out of the equations: its step is 0. If it stayed, a step that can't be made
// would lead the other unknowns to values at which the energy is not least.
fn hold(block: ptr<function, CrossingBlock>) {
    (*block).own.x = 0.0;
    (*block).own_own[0] = vec4(1.0, 0.0, 0.0, 0.0);
    (*block).own_own[1].x = 0.0;
    (*block).own_own[2].x = 0.0;
    (*block).own_own[3].x = 0.0;
    (*block).own_crossed[0] = vec4(0.0);
}

// All terms that a crossing is part of, described from the warp.
fn gathered(site: vec2<u32>) -> CrossingBlock {
    var block: CrossingBlock;
    block.clearance = UNSEEN;
    for (var of_set = WARP; of_set <= WEFT; of_set++) {
        add_set(&block, site, of_set);
        block = turned(block);
    }
    add_contact(&block, site);
    if thread_of(site, WARP).freedom == 0.0 {
        hold(&block);
    }
    if thread_of(site, WEFT).freedom == 0.0 {
        block = turned(block);
        hold(&block);
        block = turned(block);
    }
    return block;
}
