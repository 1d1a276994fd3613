//! Stitches of small charts, worked out by hand: a machine that knows no more than it needs.

use texere_fabric::weft::{Bed, Direction, Fate, Head, LoopKind, LoopRef, Step, Stitch, Stitches, Strand};

/// What one yarn does in one course, a letter a wale: `k` and `p` knit on the front and the back needle, `t` tucks, `m` misses;
/// `>` and `<` knit and move the loop to the next needle, `A` and `B` two needles to the right and to the left, `A` first.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pass {
    pub(crate) course: u32,
    pub(crate) carrier: u32,
    pub(crate) letters: &'static str,
}

/// Whether a wale has one needle, which knits to either side, or one on each bed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Needles {
    Shared,
    Both,
}

/// One pass a course, by one carrier.
pub(crate) fn courses(letters: &[&'static str]) -> Vec<Pass> {
    (0..).zip(letters).map(|(course, &letters)| Pass { course, carrier: 0, letters }).collect()
}

/// A loop on a needle.
#[derive(Debug, Clone, Copy)]
struct Hung {
    round: i32,
    number: u32,
    /// The wale where it was made, counted on through repeats.
    made: i32,
}

/// Rounds of the repeat that are run; the loops of one in the middle are the cloth.
const ROUNDS: i32 = 7;
const CLOTH: i32 = 3;

/// The stitches of a repeat of these passes.
pub(crate) fn stitches(passes: &[Pass], needles: Needles) -> Stitches {
    let wales = passes[0].letters.len() as i32;
    let courses = passes.iter().map(|pass| pass.course + 1).max().expect("passes");
    let mut all = Stitches { repeat: Some([wales as u32, courses]), ..Stitches::default() };
    let mut parents: Vec<Vec<LoopRef>> = Vec::new();
    let mut stacks: Vec<Vec<Hung>> = vec![Vec::new(); 2 * wales as usize];
    let stack = |bed: Bed, wale: i32| {
        let row = usize::from(needles == Needles::Both && bed == Bed::Back);
        2 * wale.rem_euclid(wales) as usize + row
    };
    for round in 0..ROUNDS {
        let mut number = 0;
        for pass in passes {
            let mut steps = Vec::new();
            let mut moved = Vec::new();
            for (wale, letter) in (0..).zip(pass.letters.chars()) {
                let bed = if letter == 'p' { Bed::Back } else { Bed::Front };
                let source = (pass.course * wales as u32) + wale as u32;
                let direction = Direction::Right;
                if letter == 'm' {
                    steps.push(Step::Float { at: wale as f32, bed, course: pass.course, direction, source });
                    continue;
                }
                let opposite = needles == Needles::Both && !stacks[stack(bed.other(), wale)].is_empty();
                if round == 0 {
                    parents.push(Vec::new());
                    all.loops.push(Stitch {
                        kind: if letter == 't' { LoopKind::Tuck } else { LoopKind::Knit },
                        bed,
                        at: wale as f32,
                        opposite,
                        course: pass.course,
                        plate: 0,
                        parents: 0..0,
                        head: Head { at: wale as f32, bed, layer: 0, moved: 0 },
                        fate: Fate::OnNeedle,
                        length_mm: None,
                        source,
                    });
                }
                all.loops[number as usize].opposite = opposite;
                steps.push(Step::Loop { number, direction });
                if letter != 't' {
                    for (layer, hung) in (0..).zip(std::mem::take(&mut stacks[stack(bed, wale)])) {
                        let across = hung.made.div_euclid(wales);
                        if round == CLOTH {
                            let repeat = [across, hung.round - round];
                            parents[number as usize].push(LoopRef { number: hung.number, repeat });
                        }
                        if hung.round == CLOTH {
                            let held = &mut all.loops[hung.number as usize];
                            let child = LoopRef { number, repeat: [-across, round - hung.round] };
                            held.fate = Fate::Held(child);
                            held.head.layer = layer;
                        }
                    }
                }
                let far = match letter {
                    '>' => 1,
                    '<' => -1,
                    'A' => 2,
                    'B' => -2,
                    _ => 0,
                };
                all.loops[number as usize].head.at = (wale + far) as f32;
                all.loops[number as usize].head.moved = match letter {
                    'A' | '>' | '<' => 1,
                    'B' => 2,
                    _ => 0,
                };
                // Where it was made, as the needle sees it that it hangs on.
                let to = wale + far;
                let made = wale - to.div_euclid(wales) * wales;
                moved.push((far != 0, stack(bed, to), Hung { round, number, made }));
                number += 1;
            }
            moved.sort_by_key(|(far, ..)| *far);
            moved.into_iter().for_each(|(_, stack, hung)| stacks[stack].push(hung));
            if round == 0 {
                all.strands.push(Strand { carrier: pass.carrier, steps, onward: Some([1, 0]) });
            }
        }
    }
    for (stitch, own) in all.loops.iter_mut().zip(parents) {
        let first = all.parents.len() as u32;
        all.parents.extend(own);
        stitch.parents = first..all.parents.len() as u32;
    }
    all
}
