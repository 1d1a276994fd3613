//! The certificate: surfaces as drawn are measured, and threads are made thinner where they lack clearance.

use std::ops::ControlFlow;

use texere_core::{Origin, Settings, Yarns};

use super::lay::Lies;
use crate::clearance::clearance_up_to;
use crate::{Contact, Drawdown, FabricError, NO_CROSSING, Woven};

/// What every pair of surfaces is brought to.
const WANTED: f64 = 0.988;

/// Good enough to end with.
const ENOUGH: f64 = 0.985;

/// The most rounds.
const ROUNDS: u32 = 6;

/// The most that a half width or a half height loses in a round.
const LOST_MOST: f64 = 0.06;

/// At least so many threads beyond a repeat are measured with it, where the cloth has them.
const BEYOND: usize = 4;

/// Measures and thins. Gives the clearance before and after, and how often threads were thinned.
pub(super) fn certify(
    cloth: &Woven,
    lies: &mut Lies,
    settings: &Settings,
    mut progress: impl FnMut(f64) -> ControlFlow<()> + Send,
) -> Result<([f64; 2], u32), FabricError> {
    let piece = crop(cloth, lies.repeat())?;
    let (mut round, mut before) = (0, None);
    loop {
        let yarns = lies.yarns(&piece)?;
        let share = f64::from(round) / f64::from(ROUNDS + 1);
        let found =
            clearance_up_to(&yarns, settings, WANTED, |done| progress(share + done / f64::from(ROUNDS + 1)))?;
        let before = *before.get_or_insert(found.min);
        if found.min >= ENOUGH || round == ROUNDS {
            return Ok(([before, found.min], round));
        }
        thin(lies, &piece, &yarns, &found.worst);
        round += 1;
    }
}

/// A cloth with whole repeats left out: one of them and some more threads are left, with both edges as they are.
fn crop(cloth: &Woven, repeat: [usize; 2]) -> Result<Woven, FabricError> {
    let left = |count: usize, repeat: usize| count - count.saturating_sub(repeat + BEYOND) / repeat * repeat;
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
