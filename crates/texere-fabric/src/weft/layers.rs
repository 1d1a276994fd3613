//! The order of yarns that lie over one another: loops that cross on their way to other needles,
//! yarns that share a course, and floats behind loops.

use std::collections::HashMap;

use texere_core::OutOfMemory;
use texere_core::backend::{filled, room_for};

use super::stitches::HALVES;
use super::{Bed, Fate, Head, Step, Stitch, Stitches, Visit};

/// Distance in wales above which two loops have needles between them. Places are whole and half
/// wales, so that this distance separates 1.5 from 2.
pub(super) const STEP: f32 = 1.6;

/// The loops on the needle of one bed in one course.
#[derive(Debug, Clone, Copy, Default)]
struct Hanging {
    /// Whether any loop hangs on the needle.
    any: bool,
    /// Whether a loop is made on the needle in this course.
    made: bool,
}

/// A needle in one course: the number of the course, and the place of the needle in half wales. If
/// the cloth repeats, both lie within the repeat.
type Place = [i64; 2];

/// A run of a yarn's steps in one direction and in one course.
#[derive(Debug, Clone, Copy)]
struct Pass {
    strand: usize,
    /// Number of the pass's first step in the strand, and of its last step.
    first: usize,
    last: usize,
    course: u32,
    /// When the pass is made: the number of its first loop. A pass without loops has the number of
    /// the strand's pass before.
    time: u32,
    /// Number of the yarn in a plated stitch, counted from 0.
    plate: u16,
    /// Whether the pass goes from bed to bed, or floats.
    mixed: bool,
}

/// The order of all yarns and loops of a knit that lie over one another.
#[derive(Debug)]
pub(super) struct Layers {
    hanging: HashMap<Place, [Hanging; 2]>,
    repeat: Option<[u32; 2]>,
    /// For each loop, the number of legs between its own legs and the side to which its head is
    /// drawn; none if it crosses no other loop.
    crossed: Vec<Option<u16>>,
    /// The rank of each step of each strand.
    ranks: Vec<Vec<Rank>>,
    /// Whether any yarn floats.
    floats: bool,
}

/// The rank of a step among the yarns of its course.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Rank {
    /// Height among the yarns of the course, from -0.5 for the lowest to 0.5 for the highest.
    pub(super) lift: f64,
    /// Height of the room that the yarns of the course share, in yarn diameters.
    pub(super) sharing: f64,
    /// Number of the yarn in a plated stitch, counted from 0.
    pub(super) plate: u16,
}

/// The loops that a float lies behind, or between, where it passes a needle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Behind {
    /// Between loops of both beds.
    Between,
    /// Behind the loops of one bed.
    One {
        /// The bed.
        bed: Bed,
        /// Whether another yarn makes loops of this bed in the same course.
        made: bool,
    },
}

impl Layers {
    /// **Errors**: [`OutOfMemory`].
    pub(super) fn new(stitches: &Stitches) -> Result<Self, OutOfMemory> {
        let mut layers = Self {
            hanging: HashMap::new(),
            repeat: stitches.repeat,
            crossed: crossed(stitches)?,
            ranks: ranks(stitches)?,
            floats: stitches
                .strands
                .iter()
                .flat_map(|strand| &strand.steps)
                .any(|step| matches!(step, Step::Float { .. })),
        };
        layers.hang(stitches)?;
        Ok(layers)
    }

    /// The number of legs between a loop's own legs and the side to which its head is drawn. None
    /// if the loop crosses no other loop on its way to its last needle.
    pub(super) fn crossed(&self, number: u32) -> Option<f64> {
        self.crossed[number as usize].map(f64::from)
    }

    /// The rank of a step. The step is given by the number of its strand and its number in the
    /// strand.
    pub(super) fn rank(&self, [strand, step]: [usize; 2]) -> Rank {
        self.ranks[strand][step]
    }

    /// Whether the program lets any yarn float.
    pub(super) const fn has_floats(&self) -> bool {
        self.floats
    }

    /// Whether a loop hangs on a needle in a course. `at` is the place of the needle in wales.
    pub(super) fn is_held(&self, course: i64, at: f32) -> bool {
        self.hanging.contains_key(&self.place(course, at))
    }

    /// The loops that a yarn lies behind, or between, where it floats past the needle of `bed` at
    /// the place `at`, in wales.
    pub(super) fn behind(&self, course: i64, at: f32, bed: Bed) -> Behind {
        // Needles of a bed that is racked by half a pitch lie half a wale to each side.
        let beside = [-1.0, 0.0, 1.0].map(|halves| self.place(course, at + halves / HALVES as f32));
        let hanging = beside.map(|place| self.hanging.get(&place).copied().unwrap_or_default());
        let of = |bed: usize| Hanging {
            any: hanging.iter().any(|beds| beds[bed].any),
            made: hanging.iter().any(|beds| beds[bed].made),
        };
        let [front, back] = [of(0), of(1)];
        match (front.any, back.any) {
            (true, true) => Behind::Between,
            (true, false) => Behind::One { bed: Bed::Front, made: front.made },
            (false, true) => Behind::One { bed: Bed::Back, made: back.made },
            (false, false) => Behind::One { bed, made: false },
        }
    }

    fn place(&self, course: i64, at: f32) -> Place {
        let half = (at * HALVES as f32).round() as i64;
        match self.repeat {
            Some([wales, courses]) => {
                [course.rem_euclid(i64::from(courses)), half.rem_euclid(HALVES * i64::from(wales))]
            }
            None => [course, half],
        }
    }

    /// Records each loop in every course in which it hangs on a needle.
    fn hang(&mut self, stitches: &Stitches) -> Result<(), OutOfMemory> {
        for stitch in &stitches.loops {
            let bed = |bed| usize::from(bed == Bed::Back);
            let own = self.at(self.place(i64::from(stitch.course), stitch.at))?;
            own[bed(stitch.bed)] = Hanging { any: true, made: true };
            let until = held_until(stitches, stitch.fate).unwrap_or(i64::from(stitch.course));
            for course in i64::from(stitch.course) + 1..until {
                let Head { at, bed: side, .. } = stitch.head;
                self.at(self.place(course, at))?[bed(side)].any = true;
            }
        }
        Ok(())
    }

    /// The record of a place; an empty one is added for a new place.
    fn at(&mut self, place: Place) -> Result<&mut [Hanging; 2], OutOfMemory> {
        let bytes = (self.hanging.len() as u64 + 1) * size_of::<(Place, [Hanging; 2])>() as u64;
        let refused = |_| OutOfMemory { what: "needles that hold loops", bytes };
        self.hanging.try_reserve(1).map_err(refused)?;
        Ok(self.hanging.entry(place).or_default())
    }
}

/// The course in which another loop is drawn through a loop of this fate. The course may lie beyond
/// the repeat. None for a loop through which no other loop is drawn.
pub(super) fn held_until(stitches: &Stitches, fate: Fate) -> Option<i64> {
    let Fate::Held(child) = fate else { return None };
    let courses = stitches.repeat.map_or(0, |[_, courses]| i64::from(courses));
    let own = i64::from(stitches.loops[child.number as usize].course);
    Some(own + i64::from(child.repeat[1]) * courses)
}

/// For each loop, the number of legs that lie over its own legs; none for a loop that crosses no
/// other loop of its course on the way to another needle.
fn crossed(stitches: &Stitches) -> Result<Vec<Option<u16>>, OutOfMemory> {
    let loops = &stitches.loops;
    let mut levels = filled("loops", loops.len(), None)?;
    let leans = loops.iter().map(|stitch| (stitch.head.at - stitch.at).abs());
    let furthest = leans.fold(0.0, f32::max);
    if furthest == 0.0 {
        return Ok(levels);
    }
    let mut order: Vec<usize> = Vec::new();
    room_for(&mut order, loops.len(), "loops")?;
    order.extend(0..loops.len());
    order.sort_unstable_by(|&first, &second| {
        let [one, other] = [first, second].map(|number| &loops[number]);
        one.course.cmp(&other.course).then(one.at.total_cmp(&other.at)).then(first.cmp(&second))
    });
    for course in order.chunk_by(|&one, &other| loops[one].course == loops[other].course) {
        let mut moved = course.to_vec();
        moved.sort_by_key(|&number| loops[number].head.moved);
        for &number in &moved {
            let own = &loops[number];
            let near = course.partition_point(|&other| loops[other].at < own.at - 2.0 * furthest);
            let near = course[near..].iter().take_while(|&&other| loops[other].at <= own.at + 2.0 * furthest);
            let crossing: Vec<_> = near.copied().filter(|&other| cross(own, &loops[other])).collect();
            if crossing.is_empty() {
                continue;
            }
            let over = crossing.iter().filter(|&&other| loops[other].head.moved < own.head.moved);
            levels[number] =
                Some(over.filter_map(|&other| levels[other]).map(|over| over + 1).max().unwrap_or(0));
        }
    }
    Ok(levels)
}

/// Whether the legs of two loops of a course cross.
fn cross(one: &Stitch, other: &Stitch) -> bool {
    one.head.bed == other.head.bed && (other.at - one.at) * (other.head.at - one.head.at) < 0.0
}

/// The rank of each step among the yarns of its course.
///
/// Yarns of a course cross if one of them floats behind the loops of another, or goes from bed to
/// bed. The yarn that is laid later then lies above. Yarns that only knit side by side on one bed
/// do not cross.
fn ranks(stitches: &Stitches) -> Result<Vec<Vec<Rank>>, OutOfMemory> {
    let strands = &stitches.strands;
    let (mut all, mut passes) = (Vec::new(), Vec::new());
    room_for(&mut all, strands.len(), "yarns of a knit")?;
    for (number, strand) in strands.iter().enumerate() {
        all.push(filled("stitches of a yarn", strand.steps.len(), Rank::default())?);
        passes_of(stitches, number, &mut passes)?;
    }
    passes.sort_unstable_by_key(|pass| (pass.course, pass.time, pass.plate, pass.strand, pass.first));
    for course in passes.chunk_by(|one, other| one.course == other.course) {
        let crosses = course.iter().any(|pass| pass.mixed);
        // All yarns of a plated stitch take the same path, and count as one.
        let most = course.iter().filter(|pass| pass.plate == 0).count().saturating_sub(1) as f64;
        let mut number = -1.0;
        for pass in course {
            number += if pass.plate == 0 { 1.0 } else { 0.0 };
            let lift = if crosses && most > 0.0 { f64::max(number, 0.0) / most - 0.5 } else { 0.0 };
            let rank = Rank { lift, sharing: most, plate: pass.plate };
            all[pass.strand][pass.first..=pass.last].fill(rank);
        }
    }
    Ok(all)
}

/// Appends the passes of a strand in order.
fn passes_of(stitches: &Stitches, strand: usize, passes: &mut Vec<Pass>) -> Result<(), OutOfMemory> {
    let mut steps = Vec::new();
    room_for(&mut steps, stitches.strands[strand].steps.len(), "stitches of a yarn")?;
    steps.extend(stitches.strands[strand].steps.iter().map(|step| stitches.visit(step)));
    let across = stitches.repeat.filter(|_| stitches.strands[strand].onward.is_some());
    let (mut first, mut time) = (0, 0);
    for run in steps.chunk_by(|one, other| (one.course, one.direction) == (other.course, other.direction)) {
        let made = run.iter().find_map(|step| step.number);
        time = made.unwrap_or(time);
        let span = run.last().map_or(0.0, |last| (last.at - run[0].at).abs());
        let seam = across.map_or(0.0, |[wales, _]| wales as f32 - span);
        let mixed = |pair: &[Visit]| pair[0].bed != pair[1].bed || (pair[0].at - pair[1].at).abs() > STEP;
        room_for(passes, 1, "passes of carriers")?;
        passes.push(Pass {
            strand,
            first,
            last: first + run.len() - 1,
            course: run[0].course,
            time,
            plate: made.map_or(0, |number| stitches.loops[number as usize].plate),
            mixed: seam > STEP || run.iter().any(|step| step.number.is_none()) || run.windows(2).any(mixed),
        });
        first += run.len();
    }
    Ok(())
}
