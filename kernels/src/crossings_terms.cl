// The energy of a crossing: terms of single threads, and terms that keep threads apart. This file
// follows crossings.cl and crossings_passage.cl.
//
// Its twins are crossings_terms.wgsl, and texere-core's crossings/{terms,contacts}.rs.

// A crossing on a thread, some steps along the thread from another crossing.
typedef struct {
    uint2 site;
    bool there;
    // The thread's lie at this crossing, and the distance to the next crossing.
    float4 lie;
    float gap;
} Along;

Along along_of(const Cloth *cloth, uint2 site, uint of_set, int steps) {
    Along along;
    along.site = beside(cloth, site, of_set, steps, 0);
    along.there = is_there(along.site);
    along.lie = along.there ? lie_of(cloth, along.site, of_set) : (float4)(0.0f, 0.0f, 0.0f, 0.0f);
    along.gap = along.there ? thread_of(cloth, along.site, 1u - of_set).gap : 0.0f;
    return along;
}

// Adds the terms of the section: its shape, its area, its least area, and the press.
void add_section(const Cloth *cloth, CrossingBlock *block, float4 lie, const ThreadRow *thread) {
    float radius = thread->radius;
    float wide = lie.z / radius;
    float thick = lie.w / radius;
    float4 slopes = (float4)(0.0f, 0.0f, 1.0f / radius, -thread->aspect / radius);
    add_own(block, thread->shape, 1.0f, wide - thread->aspect * thick, slopes);
    float gain = wide * thick - cloth->params->area;
    // Just below its full area a section takes the curvature of a section above that area.
    // Otherwise it would grow beyond the area in one pass, and shrink back in the next.
    float weight = gain < -CROSSINGS_NEAR ? CROSSINGS_AREA_LOSS : CROSSINGS_AREA_GAIN;
    float residual = gain < 0.0f ? CROSSINGS_AREA_LOSS / weight * gain : gain;
    slopes = (float4)(0.0f, 0.0f, thick / radius, wide / radius);
    add_own(block, weight, 1.0f, residual, slopes);
    float room = wide * thick - thread->least_area * cloth->params->area - CROSSINGS_MARGIN;
    if (room < CROSSINGS_NEAR) {
        add_own(block, CROSSINGS_SOLID * cloth->params->penalty, 1.0f, fmin(room, 0.0f), slopes);
    }
    float press = CROSSINGS_PRESS * cloth->params->press * 4.0f * radius * radius;
    add_alone(block, (float4)(0.0f, press, 0.0f, 0.0f), 1.0f, lie, 1.0f);
}

// Adds the term of a bend: a second difference along the thread, with slope `slope` in the unknowns
// of this crossing.
void add_bend(CrossingBlock *block, const ThreadRow *thread, const Along *before, const Along *middle, const Along *after,
              float slope, float share) {
    if (!before->there || !middle->there || !after->there) {
        return;
    }
    float square = 4.0f * thread->radius * thread->radius;
    float pitch = 0.5f * (before->gap + middle->gap);
    float stiff = thread->stiffness * square * square / (pitch * pitch * pitch);
    float4 weights = (float4)(CROSSINGS_SIDEWAYS_BEND * stiff, CROSSINGS_BEND * stiff, 0.0f, 0.0f);
    add_alone(block, weights, share, before->lie - 2.0f * middle->lie + after->lie, slope);
}

// Adds the terms of first differences along the thread, to a crossing `gap` away: tension, and
// evenness of sections. `sign` is -1 for the crossing before, and 1 for the one after. A taut
// thread pulls apart the two threads between which it changes sides.
void add_difference(const Cloth *cloth, CrossingBlock *block, uint of_set, const Along *here, const Along *other, float sign,
                    float gap, float tension, float evenness) {
    if (!other->there) {
        return;
    }
    float taut = tension / gap;
    float4 weights = (float4)(CROSSINGS_SIDEWAYS_TENSION * taut, 0.0f, evenness, evenness);
    add_alone(block, weights, 2.0f, here->lie - other->lie, 1.0f);
    float to = lie_of(cloth, other->site, 1u - of_set).x;
    float span = gap + sign * (to - lie_of(cloth, here->site, 1u - of_set).x);
    float shorter = sqrt(gap / span);
    float rise = shorter * (here->lie.y - other->lie.y);
    float4 crossed = (float4)(0.5f * sign * rise / span, 0.0f, 0.0f, 0.0f);
    add_between(block, CROSSINGS_TENSION * taut, 2.0f, rise, (float2)(shorter, 0.0f), crossed);
}

// The room between a thread and the threads that it crosses, on the way between two crossings. In
// the functions below, `second` is true if this crossing is the second of the two.
typedef struct {
    float room;
    // The slopes of the room in the thread's height and half height, and in the unknowns of the
    // thread that it crosses here.
    float2 slopes;
    float4 crossed;
    float clearance;
} Meeting;

// The meeting of a thread that stays on its side. If it slopes, it has to clear the shoulder of the
// thread under its upper end.
Meeting shoulder(float side, const Along *first, const Along *last, float4 one, float4 two, bool second) {
    bool rises = side * (last->lie.y - first->lie.y) > 0.0f;
    float4 upper = rises ? last->lie : first->lie;
    float4 lower = rises ? first->lie : last->lie;
    float4 under = rises ? two : one;
    float across = first->gap + two.x - one.x;
    float slope = side * (upper.y - lower.y) / across;
    // Measured upright, the thread's half height is longer by this factor than across the slope.
    float length = sqrt(1.0f + slope * slope);
    float x = under.z * slope;
    float z = under.w;
    float reach = sqrt(x * x + z * z);
    float above = side * (upper.y - under.y);
    float need = reach + upper.w * length;
    float steeper = under.z * x / reach + upper.w * slope / length;
    float wider = steeper * slope / across;
    float shift = second ? wider : -wider;
    float rise = steeper / across;
    Meeting meeting;
    meeting.clearance = above / need;
    meeting.room = above - need - CROSSINGS_MARGIN;
    if (second == rises) {
        meeting.slopes = (float2)(side * (1.0f - rise), -length);
        meeting.crossed = (float4)(shift, -side, -x * slope / reach, -z / reach);
    } else {
        meeting.slopes = (float2)(side * rise, 0.0f);
        meeting.crossed = (float4)(shift, 0.0f, 0.0f, 0.0f);
    }
    return meeting;
}

// The meeting of a thread that changes sides.
Meeting passage(float side, const Along *first, const Along *last, float4 one, float4 two, bool second) {
    float across = first->gap + two.x - one.x;
    float rise = side * (two.y - one.y);
    StraightPassage found = passage_of(across, rise, (float4)(one.zw, two.zw), first->lie.w + last->lie.w);
    // The slopes in the unknowns of this crossing.
    float c = found.slope.x;
    float s = found.slope.y;
    float4 lie = second ? two : one;
    float reach = second ? found.reach.y : found.reach.x;
    float sign = second ? 1.0f : -1.0f;
    Meeting meeting;
    meeting.clearance = found.between / (found.between - found.room);
    meeting.room = found.room - CROSSINGS_MARGIN;
    meeting.slopes = (float2)(0.0f, -1.0f);
    meeting.crossed = (float4)(sign * s, sign * side * c, -lie.z * s * s / reach, -lie.w * c * c / reach);
    return meeting;
}

void add_meeting(const Cloth *cloth, CrossingBlock *block, uint of_set, const Along *first, const Along *last, bool second) {
    if (!first->there || !last->there) {
        return;
    }
    float4 one = lie_of(cloth, first->site, 1u - of_set);
    float4 two = lie_of(cloth, last->site, 1u - of_set);
    float side = side_of(cloth, first->site, of_set);
    bool stays = side == side_of(cloth, last->site, of_set);
    // A level thread clears the shoulder if it clears the thread where they cross.
    if (stays && fabs(last->lie.y - first->lie.y) < CROSSINGS_NEAR) {
        return;
    }
    Meeting meeting = stays ? shoulder(side, first, last, one, two, second)
                            : passage(side, first, last, one, two, second);
    see(block, meeting.clearance);
    if (meeting.room < CROSSINGS_NEAR) {
        add_between(block, cloth->params->penalty, 2.0f, fmin(meeting.room, 0.0f), meeting.slopes, meeting.crossed);
    }
}

// Adds the term of the room between this crossing and the crossing `steps` further along the
// thread, past threads of other levels.
void add_meeting_past(const Cloth *cloth, CrossingBlock *block, uint of_set, const Along *here, int steps) {
    Along other = along_of(cloth, here->site, of_set, steps);
    if (!other.there) {
        return;
    }
    bool second = steps < 0;
    Along first = second ? other : *here;
    Along last = second ? *here : other;
    first.gap = way_of(cloth, first.site, 1u - of_set, abs(steps));
    add_meeting(cloth, block, of_set, &first, &last, second);
}

// Adds the term that keeps two ellipses clear of one another. `part` is the share that the lie at
// this crossing has in its ellipse: 1, or a half between two crossings.
void keep_clear(const Cloth *cloth, CrossingBlock *block, float apart, float rise, float wide, float thick, float sign,
                float part) {
    float x = apart / wide;
    float z = rise / thick;
    float clearance = sqrt(x * x + z * z);
    see(block, clearance);
    float room = (clearance - 1.0f) * wide - CROSSINGS_MARGIN;
    if (room < CROSSINGS_NEAR) {
        float4 slopes = (float4)(-sign * part * x / clearance, -part * z * wide / (thick * clearance),
                                 part * (clearance - 1.0f - x * x / clearance),
                                 -part * z * z * wide / (thick * clearance));
        add_own(block, cloth->params->penalty, 2.0f / part, fmin(room, 0.0f), slopes);
    }
}

// Adds the term that keeps neighbours of one set clear half way from this crossing to the `next`.
// There the neighbours are ellipses. They are `gap` apart before they shift. If other threads lie
// between the neighbours, both are of one level, and have to be neighbours at both crossings.
void add_half_way(const Cloth *cloth, CrossingBlock *block, uint of_set, float4 own, const Along *next, float4 neighbour, int across,
                  float gap) {
    if (!next->there) {
        return;
    }
    if (abs(across) > 1) {
        int2 steps = steps_of(cloth, next->site, of_set);
        if ((across < 0 ? steps.x : steps.y) != (int)abs(across)) {
            return;
        }
    }
    float4 opposite = lie_of(cloth, beside(cloth, next->site, of_set, 0, across), of_set);
    float sign = across < 0 ? -1.0f : 1.0f;
    float apart = gap + sign * 0.5f * (neighbour.x + opposite.x - own.x - next->lie.x);
    float rise = 0.5f * (neighbour.y + opposite.y - own.y - next->lie.y);
    float wide = 0.5f * (own.z + next->lie.z + neighbour.z + opposite.z);
    float thick = 0.5f * (own.w + next->lie.w + neighbour.w + opposite.w);
    keep_clear(cloth, block, apart, rise, wide, thick, sign, 0.5f);
}

// Adds the terms that keep a thread and a neighbour of its set clear. At a crossing, neighbours of
// one level lie side by side, whatever their heights. Neighbours of two levels lie side by side or
// one above the other, as ellipses. Half way to the crossings before and after, all neighbours are
// ellipses.
void add_neighbour(const Cloth *cloth, CrossingBlock *block, uint of_set, const Along *before, const Along *here,
                   const Along *after, int across, bool of_level) {
    uint2 site = beside(cloth, here->site, of_set, 0, across);
    if (!is_there(site)) {
        return;
    }
    float sign = across < 0 ? -1.0f : 1.0f;
    float4 other = lie_of(cloth, site, of_set);
    float gap = way_of(cloth, across < 0 ? site : here->site, of_set, abs(across));
    float apart = gap + sign * (other.x - here->lie.x);
    float need = here->lie.z + other.z;
    if (of_level) {
        see(block, apart / need);
        float room = apart - need - CROSSINGS_MARGIN;
        if (room < CROSSINGS_NEAR) {
            add_own(block, cloth->params->penalty, 2.0f, fmin(room, 0.0f), (float4)(-sign, 0.0f, -1.0f, 0.0f));
        }
    } else {
        keep_clear(cloth, block, apart, other.y - here->lie.y, need, here->lie.w + other.w, sign, 1.0f);
    }
    add_half_way(cloth, block, of_set, here->lie, before, other, across, gap);
    add_half_way(cloth, block, of_set, here->lie, after, other, across, gap);
}

// Adds the terms of a thread's neighbours on one side. The nearest neighbour of its own level lies
// `steps` threads away; 0 means that there is none.
void add_neighbours(const Cloth *cloth, CrossingBlock *block, uint of_set, const Along *before, const Along *here,
                    const Along *after, int sign, int steps) {
    if (steps != 0) {
        add_neighbour(cloth, block, of_set, before, here, after, sign * steps, true);
    }
    if (steps != 1) {
        add_neighbour(cloth, block, of_set, before, here, after, sign, false);
    }
}

// How steeply a thread rises or falls beside a crossing, on its steeper side.
float slope_of(const Cloth *cloth, uint2 site, uint of_set) {
    Along before = along_of(cloth, site, of_set, -1);
    Along here = along_of(cloth, site, of_set, 0);
    Along after = along_of(cloth, site, of_set, 1);
    float falls = before.there ? fabs((before.lie.y - here.lie.y) / before.gap) : 0.0f;
    float rises = after.there ? fabs((after.lie.y - here.lie.y) / here.gap) : 0.0f;
    return fmax(falls, rises);
}

// Adds the term of the contact between both threads of a crossing, one on top of the other. Threads
// of one layer touch. The block is described from the warp.
void add_contact(const Cloth *cloth, CrossingBlock *block, uint2 site) {
    float4 warp = lie_of(cloth, site, WARP);
    float4 weft = lie_of(cloth, site, WEFT);
    float side = side_of(cloth, site, WARP);
    // Threads of two layers slope where they cross. Along the slope of the other thread an ellipse
    // reaches further.
    float2 slope = (float2)(0.0f, 0.0f);
    uint word = cloth->sites[number_of(cloth, site)];
    if ((word & SITE_APART) != 0u) {
        slope = CROSSINGS_STEEPER * (float2)(slope_of(cloth, site, WEFT), slope_of(cloth, site, WARP));
    }
    float2 x = (float2)(warp.z, weft.z) * slope;
    float2 z = (float2)(warp.w, weft.w);
    float2 reach = sqrt(x * x + z * z);
    float apart = side * (warp.y - weft.y);
    float need = reach.x + reach.y;
    see(block, apart / need);
    float room = apart - need - CROSSINGS_MARGIN;
    bool near = room < CROSSINGS_NEAR;
    float pull = (word & SITE_TOUCH) != 0u ? CROSSINGS_TOUCH : 0.0f;
    if (near || pull > 0.0f) {
        float weight = near ? cloth->params->penalty : pull;
        float residual = room < 0.0f ? room : pull / weight * room;
        float2 wider = -x * slope / reach;
        float2 thicker = -z / reach;
        add_both(block, weight, residual, (float4)(0.0f, side, wider.x, thicker.x),
                 (float4)(0.0f, -side, wider.y, thicker.y));
    }
}

// Adds all terms of one set that a crossing is part of.
void add_set(const Cloth *cloth, CrossingBlock *block, uint2 site, uint of_set) {
    ThreadRow thread = thread_of(cloth, site, of_set);
    float radius = thread.radius;
    Along two_before = along_of(cloth, site, of_set, -2);
    Along before = along_of(cloth, site, of_set, -1);
    Along here = along_of(cloth, site, of_set, 0);
    Along after = along_of(cloth, site, of_set, 1);
    Along two_after = along_of(cloth, site, of_set, 2);
    add_section(cloth, block, here.lie, &thread);
    // The slopes of the second differences in this crossing's unknowns are 1, -2 and 1.
    add_bend(block, &thread, &two_before, &before, &here, 1.0f, 4.0f);
    add_bend(block, &thread, &before, &here, &after, -2.0f, 2.0f);
    add_bend(block, &thread, &here, &after, &two_after, 1.0f, 4.0f);
    float taut = of_set == WARP ? cloth->params->tension_warp : cloth->params->tension_weft;
    float tension = taut * 4.0f * radius * radius;
    float evenness = CROSSINGS_SMOOTH / (radius * radius);
    add_difference(cloth, block, of_set, &here, &before, -1.0f, before.gap, tension, evenness);
    add_difference(cloth, block, of_set, &here, &after, 1.0f, here.gap, tension, evenness);
    add_meeting(cloth, block, of_set, &before, &here, true);
    add_meeting(cloth, block, of_set, &here, &after, false);
    int2 steps = steps_of(cloth, site, of_set);
    add_neighbours(cloth, block, of_set, &before, &here, &after, -1, steps.x);
    add_neighbours(cloth, block, of_set, &before, &here, &after, 1, steps.y);
    int2 crossed = steps_of(cloth, site, 1u - of_set);
    if (crossed.x > 1) {
        add_meeting_past(cloth, block, of_set, &here, -crossed.x);
    }
    if (crossed.y > 1) {
        add_meeting_past(cloth, block, of_set, &here, crossed.y);
    }
}

// Takes the own shift out of the equations: its step is 0. If it stayed, a step that can't be made
// would lead the other unknowns to values at which the energy is not least.
void hold(CrossingBlock *block) {
    block->own.x = 0.0f;
    block->own_own[0] = (float4)(1.0f, 0.0f, 0.0f, 0.0f);
    block->own_own[1].x = 0.0f;
    block->own_own[2].x = 0.0f;
    block->own_own[3].x = 0.0f;
    block->own_crossed[0] = (float4)(0.0f, 0.0f, 0.0f, 0.0f);
}

// All terms that a crossing is part of, described from the warp.
CrossingBlock gathered(const Cloth *cloth, uint2 site) {
    CrossingBlock block;
    block.own = (float4)(0.0f, 0.0f, 0.0f, 0.0f);
    block.crossed = block.own;
    for (uint k = 0u; k < 4u; k++) {
        block.own_own[k] = block.own;
        block.own_crossed[k] = block.own;
        block.crossed_crossed[k] = block.own;
    }
    block.clearance = UNSEEN;
    for (uint of_set = WARP; of_set <= WEFT; of_set++) {
        add_set(cloth, &block, site, of_set);
        block = turned(&block);
    }
    add_contact(cloth, &block, site);
    if (thread_of(cloth, site, WARP).freedom == 0.0f) {
        hold(&block);
    }
    if (thread_of(cloth, site, WEFT).freedom == 0.0f) {
        block = turned(&block);
        hold(&block);
        block = turned(&block);
    }
    return block;
}
