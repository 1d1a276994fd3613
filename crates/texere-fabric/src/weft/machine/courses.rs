//! The course of each pass of a carrier. A pass is a row of stitches that the same carriers make in
//! one direction. No stitch of a pass is drawn through another stitch of the pass.
//!
//! The program of a repeat runs several times. Each run is a round.

/// Two passes, one above the other. The upper pass is drawn through loops of the lower one, or
/// tucks on needles that hold loops of the lower one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Above {
    /// The upper pass.
    pub(super) pass: u32,
    /// The lower pass.
    pub(super) below: u32,
    /// Number of rounds from the lower pass to the upper one: 0 if both are of one round, 1 if the
    /// lower one is of the round before.
    pub(super) rounds: u32,
}

/// Number of sweeps over all passes in the estimate of the repeat's height. Each sweep stands for
/// one more round. The estimate is the number of courses that the last sweep adds.
const ROUNDS: u32 = 4;

/// Number of sweeps over all passes after which another height of the repeat is tried.
const SWEEPS_MAX: u32 = 64;

/// The course of each pass, and the number of courses of a repeat; none if nothing repeats.
///
/// A pass lies one course above the highest pass below it, as `aboves` has them. If no pass lies
/// below it, it lies in the course of its carrier's previous pass (`before`). If there is no
/// previous pass either, it lies in course 0. In a repeat, a pass of the round before counts as
/// lower by the height of the repeat, and a pass of the round before that as lower by two heights.
/// `aboves` are ordered by pass.
pub(super) fn courses(before: &[Option<u32>], aboves: &[Above], repeats: bool) -> (Vec<u32>, Option<u32>) {
    let mut courses = vec![0; before.len()];
    sweep(before, aboves, &mut courses, 0);
    if !repeats {
        return (courses, None);
    }
    let top = |courses: &[u32]| courses.iter().copied().max().unwrap_or(0);
    let mut added = 0;
    for _ in 1..ROUNDS {
        let under = top(&courses);
        sweep(before, aboves, &mut courses, 0);
        added = top(&courses) - under;
    }
    // The last height is the number of passes, and always suffices. The passes of one round fill at
    // most that many courses, so that no pass of an earlier round lies above course 0.
    let heights = [added.max(1), added + 1, before.len().max(1) as u32];
    for height in heights {
        courses.fill(0);
        if (0..SWEEPS_MAX).any(|_| !sweep(before, aboves, &mut courses, height)) {
            return (courses, Some(height));
        }
    }
    (courses, Some(heights[2]))
}

/// Raises each pass above the passes that lie below it. A pass of the round before counts as
/// `height` courses lower, one of the round before that as twice as much lower, and so on. Returns
/// whether any pass was too low.
fn sweep(before: &[Option<u32>], aboves: &[Above], courses: &mut [u32], height: u32) -> bool {
    let (mut changed, mut rest) = (false, aboves);
    for (pass, &previous) in before.iter().enumerate() {
        let count = rest.iter().take_while(|above| above.pass as usize == pass).count();
        let (own, others) = rest.split_at(count);
        rest = others;
        let least = |above: &Above| {
            let lowered = u64::from(height) * u64::from(above.rounds);
            (u64::from(courses[above.below as usize]) + 1).saturating_sub(lowered) as u32
        };
        let level = previous.map_or(0, |previous| courses[previous as usize]);
        let course = own.iter().map(least).max().unwrap_or(level);
        changed |= course > courses[pass];
        courses[pass] = course.max(courses[pass]);
    }
    changed
}
