// A thread that changes sides between two threads of the other set. This file follows
// crossings.wgsl.
//
// crossings_passage.cl is the twin of this file, and StraightPassage in texere-core
// (crossings/passage.rs) is the definition.

// A straight passage over the first of two crossed threads and under the second, at the slope that
// leaves most room. The sections of the two crossed threads are ellipses.
struct StraightPassage {
    // Cosine and sine of the slope.
    slope: vec2<f32>,
    // How far each ellipse reaches at right angles to the slope.
    reach: vec2<f32>,
    // The distance between the middles of both ellipses, at right angles to the slope.
    between: f32,
    // The room that both ellipses and the thread leave.
    room: f32,
}

// How far two ellipses reach at right angles to a slope. `halves` has their half widths in x and z,
// and their half heights in y and w.
fn reach_of(slope: vec2<f32>, halves: vec4<f32>) -> vec2<f32> {
    let x = halves.xz * slope.y;
    let z = halves.yw * slope.x;
    return sqrt(x * x + z * z);
}

// The room that a slope leaves beside both ellipses.
fn left_by(across: f32, rise: f32, halves: vec4<f32>, slope: vec2<f32>) -> f32 {
    let reach = reach_of(slope, halves);
    return across * slope.y + rise * slope.x - reach.x - reach.y;
}

fn passage_of(across: f32, rise: f32, halves: vec4<f32>, thread: f32) -> StraightPassage {
    let distance = sqrt(across * across + rise * rise);
    let excess = halves.xz * halves.xz - halves.yw * halves.yw;
    // The steps below begin at the best of three slopes. One is the slope that is best for circles.
    // The others are level and upright, because wide ellipses may leave most room near these.
    var slope = vec2(0.0, 1.0);
    if rise > 0.0 {
        slope = vec2(rise, across) / distance;
    }
    var most = left_by(across, rise, halves, slope);
    let level = left_by(across, rise, halves, vec2(1.0, 0.0));
    if level > most {
        slope = vec2(1.0, 0.0);
        most = level;
    }
    if left_by(across, rise, halves, vec2(0.0, 1.0)) > most {
        slope = vec2(0.0, 1.0);
    }
    for (var step = 0u; step < PASSAGE_STEPS; step++) {
        let c = slope.x;
        let s = slope.y;
        let reach = reach_of(slope, halves);
        let p = excess / reach;
        let steep = across * c - rise * s - s * c * (p.x + p.y);
        let curve = -(across * s + rise * c) - (c * c - s * s) * (p.x + p.y)
            + s * s * c * c * (p.x * p.x / reach.x + p.y * p.y / reach.y);
        var turn = steep / distance;
        if curve < -PASSAGE_CURVED * distance {
            turn = -steep / curve;
        }
        turn = min(max(turn, -PASSAGE_TURN), PASSAGE_TURN);
        slope = vec2(c - s * turn, s + c * turn);
        slope = slope / sqrt(slope.x * slope.x + slope.y * slope.y);
        if slope.x < 0.0 {
            slope = vec2(0.0, 1.0);
        }
        if slope.y < 0.0 {
            slope = vec2(1.0, 0.0);
        }
    }
    let reach = reach_of(slope, halves);
    let between = across * slope.y + rise * slope.x;
    return StraightPassage(slope, reach, between, between - reach.x - reach.y - thread);
}
