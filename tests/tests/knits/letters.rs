//! Stitches of small charts, worked out by hand: one yarn a course, one carrier.

use texere_fabric::weft::{Bed, Direction, Fate, Head, LoopKind, LoopRef, Step, Stitch, Stitches, Strand};

/// A loop on a needle: round, course, wale, and the round of the repeat along x that it was made in.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Hung {
    round: i64,
    number: usize,
    /// How many wales to the right of where it was made.
    moved: i64,
}

/// The stitches of a repeat, `courses` from below, a letter a wale: `k` and `p` knit to the face and to the back, `t` tucks, `m`
/// misses, `>` and `<` knit and move the loop to the next needle.
pub(crate) fn letters(courses: &[&str]) -> Stitches {
    let rows: Vec<Vec<char>> = courses.iter().map(|course| course.chars().collect()).collect();
    let (wales, height) = (rows[0].len() as i64, rows.len() as i64);
    // Loops of one round, numbered course by course.
    let mut numbers = vec![vec![None; wales as usize]; height as usize];
    let mut count = 0;
    for course in 0..height as usize {
        for wale in 0..wales as usize {
            if rows[course][wale] != 'm' {
                numbers[course][wale] = Some(count);
                count += 1;
            }
        }
    }
    let mut stacks: Vec<Vec<Hung>> = vec![Vec::new(); wales as usize];
    let mut parents = vec![Vec::new(); count];
    let mut fates = vec![None; count];
    let mut layers = vec![0; count];
    let mut moves = vec![0; count];
    for round in 0..6 {
        for course in 0..height as usize {
            let mut moved = Vec::new();
            for wale in 0..wales as usize {
                let Some(number) = numbers[course][wale] else { continue };
                let letter = rows[course][wale];
                if letter != 't' {
                    let held = std::mem::take(&mut stacks[wale]);
                    for (layer, loop_held) in held.iter().enumerate() {
                        if round == 4 {
                            let at = wale as i64 - loop_held.moved;
                            let x = at.div_euclid(wales);
                            parents[number].push(LoopRef {
                                number: loop_held.number as u32,
                                repeat: [x as i32, (loop_held.round - round) as i32],
                            });
                        }
                        if loop_held.round == 3 {
                            let at = wale as i64 - loop_held.moved;
                            fates[loop_held.number] = Some(LoopRef {
                                number: number as u32,
                                repeat: [-at.div_euclid(wales) as i32, (round - 3) as i32],
                            });
                            layers[loop_held.number] = layer as u16;
                            moves[loop_held.number] = loop_held.moved;
                        }
                    }
                }
                let hung = Hung { round, number, moved: 0 };
                match letter {
                    '>' => moved.push((wale as i64 + 1, Hung { moved: 1, ..hung })),
                    '<' => moved.push((wale as i64 - 1, Hung { moved: -1, ..hung })),
                    _ => stacks[wale].push(hung),
                }
            }
            for (to, hung) in moved {
                stacks[to.rem_euclid(wales) as usize].push(hung);
            }
        }
    }
    let mut stitches = Stitches { repeat: Some([wales as u32, height as u32]), ..Stitches::default() };
    for course in 0..height as usize {
        let mut steps = Vec::new();
        for wale in 0..wales as usize {
            let source = (course * wales as usize + wale) as u32;
            let letter = rows[course][wale];
            let Some(number) = numbers[course][wale] else {
                steps.push(Step::Float {
                    at: wale as f32,
                    bed: Bed::Front,
                    course: course as u32,
                    direction: Direction::Right,
                    source,
                });
                continue;
            };
            let first = stitches.parents.len() as u32;
            stitches.parents.extend(&parents[number]);
            let bed = if letter == 'p' { Bed::Back } else { Bed::Front };
            stitches.loops.push(Stitch {
                kind: if letter == 't' { LoopKind::Tuck } else { LoopKind::Knit },
                bed,
                at: wale as f32,
                opposite: false,
                course: course as u32,
                plate: 0,
                parents: first..stitches.parents.len() as u32,
                head: Head {
                    at: wale as f32 + moves[number] as f32,
                    bed,
                    layer: layers[number],
                    moved: u32::from(moves[number] != 0),
                },
                fate: Fate::Held(fates[number].expect("a loop that is held")),
                length_mm: None,
                source,
            });
            steps.push(Step::Loop { number: number as u32, direction: Direction::Right });
        }
        stitches.strands.push(Strand { carrier: 0, steps, onward: Some([1, 0]) });
    }
    stitches
}
