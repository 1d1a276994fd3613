//! Plies of woven cloth at rest, which press into one another.
//!
//! Plies that nothing presses are round, and leave deep valleys between them: a yarn of two plies
//! reaches 1.3 times as far from its axis as a single yarn of equal tex. Threads of cloth press one
//! another. Their plies then fill the valleys before their fibres come closer together. Cloth of
//! plied yarns therefore comes to rest near the cloth of single yarns of equal tex.

use std::borrow::Cow;
use std::ops::ControlFlow;

use texere_core::{Backend, Section};

use super::{Certified, SETTLED};
use crate::diagnosis::is_clear;
use crate::{Finish, FinishError, Woven};

/// The distances of valleys from the axis up to which plies are pressed, one after the other, as
/// shares of the distance to which a ply reaches ([`Section::Lobed`]). The next one is tried if
/// threads pierce or fold, or if plied threads are as dense as their fibres allow.
///
/// For the first, 0.5, 0.65, 0.75, 0.9 and 0.95 were tried: sheeting of two plies crimps by 12.8,
/// 12.1, 10.6, 8.9 and 8.5 %, with 0.85 by 9.4 %, and of single yarns by 8.0 %. With 0.95, pictures
/// hardly show plies. For the second, 0.9 and 0.95 were tried: dense duck crimps by 30.0 and
/// 26.1 %, and of single yarns by 24.4 %. If plies are pressed no further, denim of two plies folds
/// (`plied_threads_rest_near_single_ones`).
const VALLEYS: [f32; 3] = [0.85, 0.95, 1.0];

impl Woven {
    /// Whether some thread has plies.
    pub(super) fn is_plied(&self) -> bool {
        self.presses() != [None]
    }

    /// The distances of [`VALLEYS`], or `None` alone if no thread has plies. The first one is
    /// larger if the valleys of all threads are shallower.
    fn presses(&self) -> Vec<Option<f32>> {
        let threads = self.warp().iter().chain(self.weft());
        let valleys = threads.filter_map(|thread| match self.sections()[thread.section as usize] {
            Section::Lobed { valley, .. } => Some(valley),
            _ => None,
        });
        let Some(deepest) = valleys.min_by(f32::total_cmp) else { return vec![None] };
        let first = deepest.max(VALLEYS[0]);
        let further = VALLEYS.into_iter().filter(|valley| *valley > first);
        [first].into_iter().chain(further).map(Some).collect()
    }

    /// The cloth with plies that are pressed as far as is necessary, the least distance of their
    /// valleys from the axis, and the cloth's crossings at rest.
    pub(super) fn pressed(
        &self,
        finish: &Finish,
        tension: f32,
        backend: &dyn Backend,
        mut progress: impl FnMut(f64) -> ControlFlow<()> + Send,
    ) -> Result<(Cow<'_, Self>, Option<f32>, Certified), FinishError> {
        let presses = self.presses();
        let (mut tried, count) = (0.0, presses.len() as f64 + f64::from(u8::from(self.is_mixed())));
        let mut presses = presses.into_iter().peekable();
        loop {
            let press = presses.next().flatten();
            let is_last = presses.peek().is_none();
            let cloth = press.map_or(Cow::Borrowed(self), |valley| Cow::Owned(self.filled(valley)));
            let mut share = |done: f64| progress((tried + done) / count);
            let (resting, rest) =
                cloth.resting(finish, tension, backend, false, |done| share(SETTLED * done))?;
            // Thinning makes threads denser. If plies are solid before it, the attempt has failed.
            if is_last || !resting.are_plies_solid(&cloth) {
                let thinned = |done| share(SETTLED + (1.0 - SETTLED) * done);
                let certified = cloth.certified(resting, rest, thinned)?;
                let is_clear = is_clear(certified.clearance[1], certified.bend);
                if is_last && !is_clear && cloth.is_mixed() {
                    let held = |done| progress((count - 1.0 + done) / count);
                    let certified = cloth.clearer_if_held(certified, finish, tension, backend, held)?;
                    return Ok((cloth, press, certified));
                }
                if is_last || is_clear && !certified.resting.are_plies_solid(&cloth) {
                    return Ok((cloth, press, certified));
                }
            }
            tried += 1.0;
        }
    }

    /// The cloth with valleys between plies at least as far from the axis as `least`, as a share of
    /// the distance to which a ply reaches.
    fn filled(&self, least: f32) -> Self {
        let filled = |section: &Section| match *section {
            Section::Lobed { .. } if least >= 1.0 => Section::Circle,
            Section::Lobed { plies, valley } => Section::Lobed { plies, valley: valley.max(least) },
            _ => section.clone(),
        };
        let mut cloth = self.clone();
        cloth.sections.iter_mut().for_each(|section| *section = filled(section));
        cloth
    }
}
