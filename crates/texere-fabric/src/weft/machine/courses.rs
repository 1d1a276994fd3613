//! The course of each pass of a carrier. A pass is a row of stitches that the same carriers make in
//! one direction. No stitch of a pass is drawn through another stitch of the pass.

/// A pass that is drawn through loops of another pass.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Above {
    /// The upper pass.
    pub(super) pass: u32,
    /// The lower pass, through whose loops the upper one is drawn.
    pub(super) below: u32,
    /// Number of rounds of the repeat from the lower pass to the upper one; 0 if both are of one
    /// round.
    pub(super) rounds: u32,
}

/// Number of sweeps over all passes that are made to find how many courses a round adds.
const ROUNDS: u32 = 4;

/// Number of sweeps over all passes after which another height of the repeat is tried.
const SWEEPS_MAX: u32 = 64;

/// The course of each pass, and the number of courses of a repeat; none if nothing repeats.
///
/// A pass lies one course above the highest pass that it is drawn through. A pass that is drawn
/// through nothing lies in the course of its carrier's previous pass (`before`), and a carrier's
/// first pass in course 0. In a repeat, loops of an earlier round lie lower by the height of the
/// repeat for each round between. `aboves` are ordered by pass.
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
    // The last height, the number of passes, always suffices: a chain of passes that comes back to
    // its first pass has no more.
    let heights = [added.max(1), added + 1, before.len().max(1) as u32];
    for height in heights {
        courses.fill(0);
        if (0..SWEEPS_MAX).any(|_| !sweep(before, aboves, &mut courses, height)) {
            return (courses, Some(height));
        }
    }
    (courses, Some(heights[2]))
}

/// Raises each pass above the passes that it is drawn through. A pass of an earlier round counts as
/// `height` courses lower for each round between. Returns whether any pass was too low.
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
