//! The needle diagram: for each pass of a carrier, both rows of needles as dots, and the yarn's
//! path round them.

use texere_fabric::weft::{Bed, Direction, Knitted, LoopKind, Step, Stitches, Strand};

use super::yarn_color::yarn_color;
use crate::write::draft::canvas::{Canvas, on_paper};
use crate::write::draft::sheet::{INK, Rgb};

/// Pixels from needle to needle of a bed.
const PITCH: i64 = 24;

/// Pixels from pass to pass.
const PASS: i64 = 56;

/// The distance of each bed's needles from the middle of a pass, pixels.
const BED: i64 = 12;

/// The radius of a loop round its needle, pixels.
const LOOP: f64 = 7.0;

/// The radius of a needle, pixels.
const NEEDLE: f64 = 2.5;

/// The colour of transfers.
const MOVED: Rgb = [30, 90, 200];

/// The needle diagram as pixels.
#[derive(Debug)]
pub(super) struct Needles {
    pub(super) canvas: Canvas,
}

/// The steps of a carrier in one course and direction. `time` is the number of the pass's first
/// loop. A pass without loops has the time of the pass before. Passes are sorted by `time`.
struct Pass<'a> {
    carrier: u32,
    time: u32,
    steps: &'a [Step],
}

fn passes(stitches: &Stitches) -> Vec<Pass<'_>> {
    let course_and_way = |step: &Step| {
        let visit = stitches.visit(step);
        (visit.course, visit.direction)
    };
    let of = |strand: &'_ Strand| -> Vec<(u32, usize, usize)> {
        let (mut found, mut first, mut time) = (Vec::new(), 0, 0);
        for run in strand.steps.chunk_by(|one, other| course_and_way(one) == course_and_way(other)) {
            let made = run.iter().find_map(|step| stitches.visit(step).number);
            time = made.unwrap_or(time);
            found.push((time, first, first + run.len()));
            first += run.len();
        }
        found
    };
    let mut all: Vec<Pass<'_>> = Vec::new();
    for strand in &stitches.strands {
        let pass =
            |(time, first, end)| Pass { carrier: strand.carrier, time, steps: &strand.steps[first..end] };
        all.extend(of(strand).into_iter().map(pass));
    }
    all.sort_by_key(|pass| pass.time);
    all
}

impl Needles {
    /// The diagram of a cloth whose chart has `wales` wales from `left` on. None if it would have
    /// more than `passes_max` passes.
    pub(super) fn new(cloth: &Knitted, wales: usize, left: i64, passes_max: usize) -> Option<Self> {
        let stitches = cloth.stitches();
        let passes = passes(stitches);
        if passes.len() > passes_max {
            return None;
        }
        let size =
            [(wales as i64 + 1) * PITCH, (passes.len() as i64).max(1) * PASS].map(|side| side as usize);
        let mut needles = Self { canvas: Canvas::new(size) };
        for (number, pass) in (1..).zip(&passes) {
            let middle = size[1] as i64 - number * PASS + PASS / 2;
            let wrap = stitches.repeat.map(|_| wales as f32);
            needles.pass(cloth, pass, [left, middle], wrap);
            for wale in 0..wales as i64 {
                let x = ((wale + 1) * PITCH - PITCH / 2) as f64;
                for y in [middle - BED, middle + BED] {
                    needles.canvas.dot([x, y as f64], NEEDLE, INK);
                }
            }
        }
        Some(needles)
    }

    /// Draws a pass, whose middle is row `middle` of pixels. Front needles lie below the middle, as
    /// in a machine seen from above.
    fn pass(&mut self, cloth: &Knitted, pass: &Pass<'_>, [left, middle]: [i64; 2], wrap: Option<f32>) {
        let stitches = cloth.stitches();
        let x = |at: f32| {
            let at = wrap.map_or(at, |wales| at.rem_euclid(wales));
            (f64::from(at) - left as f64 + 0.5) * PITCH as f64
        };
        let middle = middle as f64;
        let side = |bed: Bed| if bed == Bed::Front { 1.0 } else { -1.0 };
        // The colour is dark enough for paper.
        let yarn = on_paper(yarn_color(cloth, pass.carrier));
        let mut before: Option<f64> = None;
        for step in pass.steps {
            let visit = stitches.visit(step);
            let here = x(visit.at);
            let way = if visit.direction == Direction::Right { 1.0 } else { -1.0 };
            // If the next needle is in the repeat beside this one, the yarn leaves the diagram on
            // one side and comes in on the other.
            let from =
                before.filter(|from| (here - from) * way >= 0.0).unwrap_or(here - way * PITCH as f64 / 2.0);
            self.canvas.line([from, middle], [here + way * PITCH as f64 / 4.0, middle], yarn);
            before = Some(here);
            let Some(number) = visit.number else { continue };
            let stitch = &stitches.loops[number as usize];
            let needle = middle + side(stitch.bed) * BED as f64;
            if stitch.kind == LoopKind::Tuck {
                let tip = needle + side(stitch.bed) * LOOP;
                self.canvas.line([here - LOOP, middle], [here, tip], yarn);
                self.canvas.line([here, tip], [here + LOOP, middle], yarn);
            } else {
                self.canvas.line([here, middle], [here, needle - side(stitch.bed) * LOOP], yarn);
                self.canvas.ring([here, needle], LOOP, yarn);
            }
            if stitch.head.at != stitch.at || stitch.head.bed != stitch.bed {
                let to = here + f64::from(stitch.head.at - stitch.at) * PITCH as f64;
                let tip = [to, middle + side(stitch.head.bed) * BED as f64];
                if stitch.head.bed == stitch.bed {
                    // The transfer is drawn round the needles between.
                    let below = [(here + to) / 2.0, needle + side(stitch.bed) * 2.0 * LOOP];
                    self.canvas.line([here, needle], below, MOVED);
                    self.arrow(below, tip);
                } else {
                    self.arrow([here, needle], tip);
                }
            }
        }
        if let (Some(from), Some(wales)) = (before, wrap) {
            self.canvas.line([from, middle], [from.min(f64::from(wales) * PITCH as f64), middle], yarn);
        }
    }

    fn arrow(&mut self, from: [f64; 2], to: [f64; 2]) {
        self.canvas.line(from, to, MOVED);
        let (x, y) = (to[0] - from[0], to[1] - from[1]);
        let length = x.hypot(y).max(1.0);
        for turn in [-1.0, 1.0] {
            let back = [(-x + turn * 0.5 * y) / length * LOOP, (-y - turn * 0.5 * x) / length * LOOP];
            self.canvas.line(to, [to[0] + back[0], to[1] + back[1]], MOVED);
        }
    }
}
