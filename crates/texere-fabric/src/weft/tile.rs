//! Several copies of a repeat, joined to one larger repeat.

use super::{Fate, LoopRef, Step, Stitch, Stitches, Strand};

impl Stitches {
    /// `tiles` copies of the repeat along x and y, joined to one repeat. A cloth that does not
    /// repeat stays as it is.
    pub(super) fn tiled(&self, tiles: [u32; 2]) -> Self {
        let Some(size) = self.repeat.filter(|_| tiles != [1, 1]) else { return self.clone() };
        let tiling = Tiling { tiles: tiles.map(i64::from), loops: self.loops.len() as u32, size };
        let mut tiled = Self { repeat: Some([0, 1].map(|axis| size[axis] * tiles[axis])), ..Self::default() };
        let cells: Vec<_> =
            (0..tiling.tiles[1]).flat_map(|y| (0..tiling.tiles[0]).map(move |x| [x, y])).collect();
        for &cell in &cells {
            let first = tiled.parents.len() as u32;
            tiled.parents.extend(self.parents.iter().map(|&parent| tiling.of(cell, parent)));
            tiled.loops.extend(self.loops.iter().map(|stitch| Stitch {
                at: tiling.at(cell, stitch.at),
                course: tiling.course(cell, stitch.course),
                parents: stitch.parents.start + first..stitch.parents.end + first,
                head: super::Head { at: tiling.at(cell, stitch.head.at), ..stitch.head },
                fate: match stitch.fate {
                    Fate::Held(child) => Fate::Held(tiling.of(cell, child)),
                    fate => fate,
                },
                ..stitch.clone()
            }));
        }
        let rows = 0..tiling.tiles[1];
        for strand in &self.strands {
            let begins: Vec<_> = match strand.onward {
                // The yarn goes on through all copies that lie side by side.
                Some([right, _]) => {
                    rows.clone().map(|y| [if right < 0 { tiling.tiles[0] - 1 } else { 0 }, y]).collect()
                }
                None => cells.clone(),
            };
            tiled.strands.extend(begins.into_iter().map(|cell| tiling.strand(strand, cell)));
        }
        tiled
    }
}

/// How copies of a repeat are numbered: copies along x and y, and the loops, wales and courses of
/// one repeat.
struct Tiling {
    tiles: [i64; 2],
    loops: u32,
    size: [u32; 2],
}

impl Tiling {
    /// The number of the copy at `cell` within the large repeat, and the large repeat in which the
    /// copy lies.
    fn copy(&self, cell: [i64; 2]) -> (usize, [i32; 2]) {
        let [x, y] = [0, 1].map(|axis| cell[axis].rem_euclid(self.tiles[axis]));
        let round = [0, 1].map(|axis| cell[axis].div_euclid(self.tiles[axis]) as i32);
        ((y * self.tiles[0] + x) as usize, round)
    }

    /// A reference that a loop of the copy at `cell` makes, in loop numbers of the large repeat.
    fn of(&self, cell: [i64; 2], LoopRef { number, repeat }: LoopRef) -> LoopRef {
        let (copy, repeat) = self.copy([0, 1].map(|axis| cell[axis] + i64::from(repeat[axis])));
        LoopRef { number: number + copy as u32 * self.loops, repeat }
    }

    fn at(&self, cell: [i64; 2], at: f32) -> f32 {
        at + (cell[0] * i64::from(self.size[0])) as f32
    }

    fn course(&self, cell: [i64; 2], course: u32) -> u32 {
        course + (cell[1] * i64::from(self.size[1])) as u32
    }

    /// The yarn that begins in the copy at `[x, y]`, through all copies that it goes on in.
    fn strand(&self, strand: &Strand, [x, y]: [i64; 2]) -> Strand {
        let right = strand.onward.map_or(1, |[right, _]| i64::from(right));
        let copies = if strand.onward.is_some() { self.tiles[0] } else { 1 };
        let steps = (0..copies)
            .flat_map(|copy| strand.steps.iter().map(move |step| self.step([x + copy * right, y], *step)));
        Strand { steps: steps.collect(), ..*strand }
    }

    fn step(&self, cell: [i64; 2], step: Step) -> Step {
        match step {
            Step::Loop { number, direction } => {
                Step::Loop { number: number + self.copy(cell).0 as u32 * self.loops, direction }
            }
            Step::Float { at, bed, course, direction, source } => Step::Float {
                at: self.at(cell, at),
                bed,
                course: self.course(cell, course),
                direction,
                source,
            },
        }
    }
}
