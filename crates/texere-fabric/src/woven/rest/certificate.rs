//! The certificate: surfaces are measured as drawn, and threads are made thinner where they lack
//! clearance or bend too tightly. A section keeps its least area: if thinning leaves less, its
//! width and height grow in one ratio until it has this area again.

use std::ops::ControlFlow;

use texere_contact::{Contact, bends_up_to, clearance_up_to};
use texere_core::crossings::Set;
use texere_core::{Origin, Settings, YarnPlace, Yarns};

use super::resting::RestingRepeat;
use crate::{Drawdown, FabricError, NO_CROSSING, Woven};

/// The clearance that every pair of surfaces is brought to. With half its difference to 1,
/// `turns_do_not_fold` is red; with twice, `neighbours_give_way_to_a_thick_end`.
const WANTED: f64 = 0.988;

/// The largest clearance of the contacts that are looked for. With twice its difference to 1,
/// `a_woven_structure_comes_to_rest` is red; with half, no test is.
const NEAR: f64 = 0.99;

/// The clearance with which the rounds may end. With half its difference to 1, `turns_do_not_fold`
/// is red; with twice, `neighbours_give_way_to_a_thick_end`.
pub(super) const ENOUGH: f64 = 0.986;

/// The radius that every bend is brought to, as a multiple of the distance by which the thread
/// reaches into the bend. With half its difference to 1, and with twice, `turns_do_not_fold` is
/// red.
const BENDS_WANTED: f64 = 1.003;

/// The most rounds in which threads are made thinner. With 10, weft-backed cloth still folds
/// (`layers_lie_on_one_another`).
const ROUNDS: u32 = 16;

/// The largest loss of a half width or a half height in a round, as a share.
const LOST_MOST: f64 = 0.06;

/// The largest loss of a half height in a round because of a tight bend, as a share.
const BENT_MOST: f64 = 0.25;

/// The least share of a half width or a half height at rest that is left. Thinner threads would no
/// longer look like cloth.
const KEPT_LEAST: f32 = 0.6;

/// Number of threads beyond a repeat that are measured with it, if the cloth has them.
const BEYOND: usize = 4;

/// The result of a round.
struct Round {
    /// The clearance, [`ENOUGH`] at most, and the tightest bend, 1 at most.
    measured: [f64; 2],
    /// The clearance of surfaces, [`NEAR`] at most.
    clearance: f64,
    number: u32,
    drawn: Vec<[[f32; 2]; 2]>,
}

/// Measures surfaces and thins threads, in rounds. Returns the clearance before and after, the
/// tightest bend after, and the number of rounds. If no round makes surfaces clear, threads are
/// left as in the best round.
pub(super) fn certify(
    cloth: &Woven,
    resting: &mut RestingRepeat,
    mut progress: impl FnMut(f64) -> ControlFlow<()> + Send,
) -> Result<([f64; 2], f64, u32), FabricError> {
    let (piece, settings) = (crop(cloth, resting.repeat())?, &Settings::default());
    let mut yarns = resting.yarns(&piece)?;
    let (mut round, once) = (0, once(&piece, &yarns, resting.repeat()));
    let mut fresh = once.clone();
    let (mut known, mut least) = (Vec::new(), [f64::INFINITY; 2]);
    let mut tight: Vec<(f64, YarnPlace)> = Vec::new();
    let mut best: Option<Round> = None;
    loop {
        let measured = |done| progress((f64::from(round) + done) / f64::from(ROUNDS + 1));
        let found = clearance_up_to(&yarns, settings, [NEAR, WANTED], |point| fresh[point], measured)?;
        // Intervals that have not changed keep their contacts.
        known.retain(|contact: &Contact| !contact.places.iter().any(|place| fresh[first(&yarns, place)]));
        known.extend(found.worst);
        let now = known.iter().map(|contact| contact.ratio).fold(found.min.min(NEAR), f64::min);
        // Only the first round has measured all contacts up to [`NEAR`].
        least = if round == 0 { [now; 2] } else { [least[0], now.min(WANTED)] };
        tight.retain(|(_, place)| !fresh[first(&yarns, place)]);
        tight.extend(bends_up_to(&yarns, settings, BENDS_WANTED, |point| fresh[point])?);
        let bends = tight.iter().map(|(bend, _)| *bend).fold(1.0, f64::min);
        if now >= ENOUGH && bends >= 1.0 {
            return Ok((least, bends, round));
        }
        let measured = [now.min(ENOUGH), bends];
        if best.as_ref().is_none_or(|best| best.measured < measured) {
            best = Some(Round { measured, clearance: now, number: round, drawn: resting.drawn.clone() });
        }
        if let Some(best) = best.take_if(|_| round == ROUNDS) {
            resting.drawn = best.drawn;
            return Ok(([least[0], best.clearance], best.measured[1], best.number));
        }
        thin(resting, &piece, &yarns, &known, &tight);
        let thinner = resting.yarns(&piece)?;
        fresh = changed(&yarns, &thinner);
        fresh.iter_mut().zip(&once).for_each(|(fresh, once)| *fresh &= once);
        yarns = thinner;
        round += 1;
    }
}

/// The number of the first control point of the interval that a place lies in.
fn first(yarns: &Yarns, place: &YarnPlace) -> usize {
    yarns.layout().offsets()[place.yarn] as usize + place.interval
}

/// For each control point, whether the interval that begins there has changed. Four control points
/// shape an interval.
fn changed(before: &Yarns, after: &Yarns) -> Vec<bool> {
    let differs: Vec<bool> =
        before.points().iter().zip(after.points()).map(|(one, two)| one != two).collect();
    let near = |point: usize| differs[point.saturating_sub(1)..differs.len().min(point + 3)].contains(&true);
    (0..differs.len()).map(near).collect()
}

/// For each control point, whether the interval that begins there is measured. Only intervals at
/// crossings of the first repeat and a few more threads, and of the last threads, are measured,
/// because the other intervals are copies of them. Intervals beside no crossing are measured, too.
fn once(piece: &Woven, yarns: &Yarns, repeat: [usize; 2]) -> Vec<bool> {
    let [ends, picks] = [piece.warp().len(), piece.weft().len()];
    let counts =
        |thread: usize, count: usize, repeat: usize| thread < repeat + BEYOND || thread + BEYOND >= count;
    let at = |source: &u32| {
        let source = *source as usize;
        counts(source % ends, ends, repeat[0]) && counts(source / ends, picks, repeat[1])
    };
    let sources = yarns.sources().unwrap_or(&[]);
    sources.iter().map(|source| *source == NO_CROSSING || at(source)).collect()
}

/// The cloth without most of its repeats. One repeat and some more threads are left, with both
/// edges as they are.
pub(super) fn crop(cloth: &Woven, repeat: [usize; 2]) -> Result<Woven, FabricError> {
    let [ends, picks] = cloth.cropped(repeat, repeat.map(|threads| threads + BEYOND));
    let drawdown = Drawdown::from_fn(ends, picks, |end, pick| cloth.drawdown().up(end, pick))?;
    let (warp, weft) = (cloth.warp()[..ends].to_vec(), cloth.weft()[..picks].to_vec());
    cloth.like(drawdown, warp, weft)
}

/// Makes threads thinner where contacts are nearer than [`WANTED`]. The worst contact at a crossing
/// decides. Makes threads less high where they bend more tightly than [`BENDS_WANTED`].
fn thin(
    resting: &mut RestingRepeat,
    piece: &Woven,
    yarns: &Yarns,
    contacts: &[Contact],
    tight: &[(f64, YarnPlace)],
) {
    let mut shares = vec![[[1.0_f64; 2]; 2]; resting.drawn.len()];
    let mut keep = |place: &YarnPlace, kept: [f64; 2]| {
        let set = usize::from(!is_end(yarns, place));
        for crossing in crossings(yarns, place, piece.warp().len()) {
            let share = &mut shares[resting.number(crossing[0], crossing[1])][set];
            *share = [share[0].min(kept[0]), share[1].min(kept[1])];
        }
    };
    for contact in contacts {
        let lacking = (1.0 - contact.ratio / WANTED).min(LOST_MOST);
        let [one, two] = &contact.places;
        let [dx, dy, dz] = [0, 1, 2].map(|axis| two.position[axis] - one.position[axis]);
        for place in &contact.places {
            let across = if is_end(yarns, place) { dx } else { dy };
            let Some(point) = yarns.yarn_points(place.yarn).map(|points| points[place.interval]) else {
                continue;
            };
            let (wide, high) = (
                (across / f64::from(point.half_width())).powi(2),
                (dz / f64::from(point.half_height())).powi(2),
            );
            let (wide, high) = (wide / (wide + high), high / (wide + high));
            // Losses of width and height, weighted by `wide` and `high`, have to make up what is
            // lacking. The two losses below have the least sum of squares among all losses that do.
            let both = wide * wide + high * high;
            keep(place, [1.0 - lacking * wide / both, 1.0 - lacking * high / both]);
        }
    }
    for (bend, place) in tight {
        keep(place, [1.0, (bend / BENDS_WANTED).max(1.0 - BENT_MOST)]);
    }
    for (number, shares) in shares.into_iter().enumerate() {
        for (set, share) in Set::BOTH.into_iter().zip(shares) {
            let (halves, lie) = (resting.drawn[number][set as usize], resting.rest[number].thread(set));
            let least = [lie.half_width, lie.half_height].map(|half| KEPT_LEAST * half);
            let [width, height] = [0, 1].map(|half| (halves[half] * share[half] as f32).max(least[half]));
            let lacking = (resting.least(number, set) / (width * height)).max(1.0).sqrt();
            resting.drawn[number][set as usize] = [lacking * width, lacking * height];
        }
    }
}

/// Whether a place is on an end.
fn is_end(yarns: &Yarns, place: &YarnPlace) -> bool {
    matches!(yarns.layout().yarns()[place.yarn].origin, Origin::End(_))
}

/// End and pick of the crossings between which a place lies.
fn crossings(yarns: &Yarns, place: &YarnPlace, ends: usize) -> impl Iterator<Item = [usize; 2]> {
    let first = first(yarns, place);
    let near = yarns.sources().and_then(|sources| sources.get(first..first + 2)).unwrap_or(&[]);
    near.iter()
        .filter(|source| **source != NO_CROSSING)
        .map(move |source| [*source as usize % ends, *source as usize / ends])
}
