//! Swing of threads out of the cloth's middle where they cross, for cloth with one control point at
//! each crossing.

/// The least swing of a thread at a crossing, by the pitch of the threads that it crosses. The room
/// of a crossing is the distance that the two centrelines keep there. A pair has the pitch over the
/// room, and the swing as a multiple of half the room.
///
/// Two threads that both swing out by half the room just touch at the crossing. On its way from one
/// side to the other the spline cuts corners, so that threads come nearest beside the crossing. The
/// closer the crossed threads lie, the more the spline cuts. These multiples are the smallest with
/// which the centrelines of round yarns of one size stay 0.992 diameters apart in plain weave, 3/1
/// and 2/2 twill, satins on 5 and 8 ends, and random weaves, measured on finely sampled splines.
const SWING: [(f32, f32); 8] = [
    (2.0, 1.33),
    (2.25, 1.17),
    (2.5, 1.09),
    (2.75, 1.06),
    (3.0, 1.04),
    (3.5, 1.02),
    (4.0, 1.013),
    (6.0, 1.0),
];

/// The least pitch over room for which a swing was found that keeps crossing threads clear.
pub(super) const PITCH_MIN: f32 = SWING[0].0;

/// The swing at a pitch over room: [`SWING`], linear between its entries and constant outside.
pub(super) fn swing(pitch: f32) -> f32 {
    let mut below = SWING[0];
    for above in SWING {
        if pitch < above.0 {
            // Before the first entry `below` and `above` are the same, with nothing between them.
            let share = if above.0 > below.0 { (pitch - below.0) / (above.0 - below.0) } else { 0.0 };
            return below.1 + share * (above.1 - below.1);
        }
        below = above;
    }
    below.1
}
