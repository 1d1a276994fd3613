//! The certificate: surfaces as drawn are measured, and threads are made thinner where they lack clearance.

use std::ops::ControlFlow;

use texere_core::{Origin, Settings, Yarns};

use super::lay::Lies;
use crate::clearance::clearance_up_to;
use crate::{Contact, Drawdown, FabricError, NO_CROSSING, Woven, YarnPlace};

/// What every pair of surfaces is brought to.
const WANTED: f64 = 0.988;

/// Contacts beyond are not looked for.
const NEAR: f64 = 1.02;

/// Good enough to end with.
const ENOUGH: f64 = 0.985;

/// The most rounds.
const ROUNDS: u32 = 6;

/// The most that a half width or a half height loses in a round.
const LOST_MOST: f64 = 0.06;

/// At least so many threads beyond a repeat are measured with it, where the cloth has them.
const BEYOND: usize = 4;

/// A repeat of so many threads is large.
const LARGE: usize = 64;

/// Measures and thins. Gives the clearance before and after, and how often threads were thinned.
pub(super) fn certify(
    cloth: &Woven,
    lies: &mut Lies,
    settings: &Settings,
    mut progress: impl FnMut(f64) -> ControlFlow<()> + Send,
) -> Result<([f64; 2], u32), FabricError> {
    let piece = crop(cloth, lies.repeat())?;
    let mut yarns = lies.yarns(&piece)?;
    let (mut round, mut fresh) = (0, vec![true; yarns.points().len()]);
    let (mut known, mut least) = (Vec::new(), [f64::INFINITY; 2]);
    loop {
        let share = f64::from(round) / f64::from(ROUNDS + 1);
        let measured = |done| progress(share + done / f64::from(ROUNDS + 1));
        let found = clearance_up_to(&yarns, settings, [NEAR, WANTED], |point| fresh[point], measured)?;
        // What has not changed has the contacts that it had.
        known.retain(|contact: &Contact| !contact.places.iter().any(|place| fresh[first(&yarns, place)]));
        known.extend(found.worst);
        let now = known.iter().map(|contact| contact.ratio).fold(found.min.min(NEAR), f64::min);
        // Of contacts that are clear enough only the first round has measured all.
        least = if round == 0 { [now; 2] } else { [least[0], now.min(WANTED)] };
        if now >= ENOUGH || round == ROUNDS {
            return Ok((least, round));
        }
        thin(lies, &piece, &yarns, &known);
        let thinner = lies.yarns(&piece)?;
        fresh = changed(&yarns, &thinner);
        yarns = thinner;
        round += 1;
    }
}

/// The number of the first control point of the interval that a place lies in.
fn first(yarns: &Yarns, place: &YarnPlace) -> usize {
    yarns.layout().offsets()[place.yarn] as usize + place.interval
}

/// Whether the interval from each control point on is another one than before: it is what four points make of it.
fn changed(before: &Yarns, after: &Yarns) -> Vec<bool> {
    let differs: Vec<bool> =
        before.points().iter().zip(after.points()).map(|(one, two)| one != two).collect();
    let near = |point: usize| differs[point.saturating_sub(1)..differs.len().min(point + 3)].contains(&true);
    (0..differs.len()).map(near).collect()
}

/// A cloth with whole repeats left out: one of them and some more threads are left, with both edges as they are. Of a large repeat the other
/// edge is left out, where no selvedge turns: its threads are cut off like any, and would take a second repeat.
fn crop(cloth: &Woven, repeat: [usize; 2]) -> Result<Woven, FabricError> {
    let left = |count: usize, repeat: usize| {
        let one = repeat + BEYOND;
        if repeat >= LARGE && !cloth.selvedge() {
            count.min(one)
        } else {
            count - count.saturating_sub(one) / repeat * repeat
        }
    };
    let [ends, picks] = [left(cloth.warp().len(), repeat[0]), left(cloth.weft().len(), repeat[1])];
    let drawdown = Drawdown::from_fn(ends, picks, |end, pick| cloth.drawdown().up(end, pick))?;
    let (warp, weft) = (cloth.warp()[..ends].to_vec(), cloth.weft()[..picks].to_vec());
    let (materials, sections) = (cloth.materials().to_vec(), cloth.sections().to_vec());
    let mut piece = Woven::new(drawdown, warp, weft, materials, sections)?;
    piece.set_selvedge(cloth.selvedge());
    Ok(piece)
}

/// Makes threads thinner where contacts are nearer than wanted, each by the worst of its contacts at a crossing.
fn thin(lies: &mut Lies, piece: &Woven, yarns: &Yarns, contacts: &[Contact]) {
    let ends = piece.warp().len();
    let mut shares = vec![[[1.0_f64; 2]; 2]; lies.drawn.len()];
    for contact in contacts {
        let lacking = (1.0 - contact.ratio / WANTED).min(LOST_MOST);
        let [one, two] = &contact.places;
        let [dx, dy, dz] = [0, 1, 2].map(|axis| two.position[axis] - one.position[axis]);
        for place in &contact.places {
            let (set, across) = match yarns.layout().yarns()[place.yarn].origin {
                Origin::End(_) => (0, dx),
                _ => (1, dy),
            };
            let (Some(points), Some(range), Some(sources)) =
                (yarns.yarn_points(place.yarn), yarns.range(place.yarn), yarns.sources())
            else {
                continue;
            };
            let point = points[place.interval];
            let (wide, high) = (
                (across / f64::from(point.half_width())).powi(2),
                (dz / f64::from(point.half_height())).powi(2),
            );
            let (wide, high) = (wide / (wide + high), high / (wide + high));
            // The least that both lose together, where the one counts so much and the other so much.
            let both = wide * wide + high * high;
            let kept = [1.0 - lacking * wide / both, 1.0 - lacking * high / both];
            for source in [0, 1].map(|next| sources[range.start + place.interval + next]) {
                if source != NO_CROSSING {
                    let share = &mut shares[lies.number(source as usize % ends, source as usize / ends)][set];
                    *share = [share[0].min(kept[0]), share[1].min(kept[1])];
                }
            }
        }
    }
    for (drawn, shares) in lies.drawn.iter_mut().zip(shares) {
        for (halves, share) in drawn.iter_mut().zip(shares) {
            *halves = [0, 1].map(|half| halves[half] * share[half] as f32);
        }
    }
}
