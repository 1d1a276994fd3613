//! Cloth that is stretched along one set of threads. It becomes narrower across, because its
//! threads keep their lengths.

use std::borrow::Cow;
use std::ops::ControlFlow;

use texere_contact::lengths_mm;
use texere_core::Backend;
use texere_core::crossings::Set;

use super::certificate::crop;
use crate::{BySet, Finish, FinishError, Woven};

/// The least crimp that threads may be pulled to. With less they count as straight, and the stretch
/// is refused. With half the value, and with twice, no test is red.
const STRAIGHT: f64 = 0.002;

/// The largest difference between the crimp of the pulled threads and the crimp that keeps their
/// length. With half the value, and with twice, no test is red.
const NEAR: f64 = 2e-4;

/// The largest factor by which the ratio of both sets' tautness changes, as a natural logarithm. In
/// relaxed cloth, where both sets have a tautness of 1, it leads to about 10, the limit of
/// [`Finish::taut`]. With half the value, `threads_keep_their_length` is red; with twice, no test
/// is.
const TAUTER: f64 = 4.6;

/// Number of halvings of the range of tautness. With half the value,
/// `stretching_tells_its_progress_and_ends_within_a_pass` is red.
const HALVINGS: u32 = 16;
/// Number of times in each halving that the cloth's size across the stretch is adjusted.
const GIVES: u32 = 3;

/// A stretch of a cloth along one set of its threads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stretch {
    /// The set along which the cloth is pulled.
    pub along: Set,
    /// Factor of the cloth's length along that set, from 0.5 to 2. With less than 1 the cloth
    /// becomes shorter.
    pub by: f64,
}

impl Woven {
    /// The cloth stretched along one set of its threads, and `finish` with the tautness that its
    /// threads then have. All threads keep the lengths that they have when this cloth comes to rest
    /// with the given `finish`, with threads that shift even if they would be held in their places.
    /// Threads that are pulled straighten, the threads that cross them take their crimp, and the
    /// cloth becomes narrower. [`Woven::at_rest`] then lets it come to rest. `tension` is the
    /// tension of the yarns' splines, from 0 to below 1. `progress` gets the share of the work
    /// done. `Break` ends the work: on the CPU within 50 ms, on any other device after the pass
    /// that it makes.
    ///
    /// **Errors**: [`FinishError::Stretch`] for a factor outside its limits, or if threads would be
    /// straight or jammed before the cloth has that length. [`FinishError::Fabric`] with the errors
    /// of [`Woven::new`] for spacings that no cloth has. The errors of [`Woven::at_rest`], except
    /// [`FinishError::Woven`].
    ///
    /// **Source**: crimp interchange, as in F. T. Peirce, "The geometry of cloth structure",
    /// Journal of the Textile Institute 28, 1937.
    ///
    /// ```
    /// use std::ops::ControlFlow;
    /// use texere_core::crossings::Set;
    /// use texere_core::{Material, Section};
    /// use texere_cpu::SerialBackend;
    /// use texere_fabric::{Finish, Stretch, Thread, Weave, Woven};
    /// let plain = Weave::parse("plain")?.drawdown(6, 6)?;
    /// let threads = vec![Thread::new(0.42, 0.1); 6];
    /// let cloth = Woven::new(plain, threads.clone(), threads, vec![Material::default()], vec![Section::Circle])?;
    /// let (device, pull) = (SerialBackend::new(), Stretch { along: Set::Warp, by: 1.03 });
    /// let (pulled, _) = cloth.stretched(&Finish::default(), pull, 0.0, &device, |_| ControlFlow::Continue(()))?;
    /// let ([width, height], [narrower, longer]) = (cloth.size_mm(), pulled.size_mm());
    /// assert!((longer / height - 1.03).abs() < 1e-9 && narrower < width);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn stretched(
        &self,
        finish: &Finish,
        stretch: Stretch,
        tension: f32,
        backend: &dyn Backend,
        mut progress: impl FnMut(f64) -> ControlFlow<()> + Send,
    ) -> Result<(Self, Finish), FinishError> {
        let Stretch { along, by } = stretch;
        let across = along.other();
        // Threads with plies are as long as at rest if their plies are pressed as much.
        let is_plied = self.is_plied();
        // Each settling reports its own share of the progress, so that progress shows during the
        // first one, too, and a wish to stop is heeded in each of them.
        let mut courses = f64::from(u8::from(is_plied));
        let share = 1.0 / (courses + f64::from(1 + HALVINGS * GIVES));
        let pressed = match is_plied {
            true => self.pressed(finish, tension, backend, |done| progress(done * share))?.0,
            false => Cow::Borrowed(self),
        };
        let mut crimps_of = |cloth: &Self, finish: &Finish| {
            let crimps = cloth.crimps(finish, tension, backend, |done| progress((courses + done) * share));
            courses += 1.0;
            crimps
        };
        let first = crimps_of(&pressed, finish)?;
        let wanted = (1.0 + first[along]) / by - 1.0;
        let most = (1.0 + first[along]) / (1.0 + STRAIGHT);
        let refused = || FinishError::Stretch { along: ["warp", "weft"][along as usize], by, most };
        if !(wanted >= STRAIGHT && (0.5..=2.0).contains(&by)) {
            return Err(refused());
        }
        let (mut narrower, mut range) = (1.0, [-TAUTER, TAUTER]);
        for _ in 0..HALVINGS {
            let tauter = f64::midpoint(range[0], range[1]);
            let pull = |set: Set, by: f64| (f64::from(finish.taut[set]) * by.exp()).clamp(0.0, 10.0) as f32;
            let mut taut = finish.taut;
            taut[along] = pull(along, tauter / 2.0);
            taut[across] = pull(across, -tauter / 2.0);
            let finish = Finish { taut, ..*finish };
            let (mut cloth, mut crimps) = (pressed.as_ref().clone(), first);
            for _ in 0..GIVES {
                let mut times = BySet { warp: by, weft: by };
                times[across] = narrower;
                // A cloth that is longer along one set has the threads of the other set further
                // apart.
                cloth = pressed.spaced([times.weft, times.warp])?;
                crimps = crimps_of(&cloth, &finish)?;
                narrower = (1.0 + first[across]) / (1.0 + crimps[across]);
            }
            if (crimps[along] - wanted).abs() < NEAR {
                cloth.sections.clone_from(&self.sections);
                return Ok((cloth, finish));
            }
            range[usize::from(crimps[along] < wanted)] = tauter;
        }
        Err(refused())
    }

    /// The crimp of the cloth at rest.
    fn crimps(
        &self,
        finish: &Finish,
        tension: f32,
        backend: &dyn Backend,
        progress: impl FnMut(f64) -> ControlFlow<()>,
    ) -> Result<BySet<f64>, FinishError> {
        let (resting, _) = self.resting(finish, tension, backend, false, progress)?;
        let piece = crop(self, resting.repeat())?;
        let lengths = lengths_mm(&resting.yarns(&piece)?);
        let (size, ends) = (piece.size_mm(), piece.warp().len());
        let [warp, weft]: [f64; 2] = [&lengths[..ends], &lengths[ends..]].map(|lengths| lengths.iter().sum());
        Ok(BySet {
            warp: warp / (ends as f64 * size[1]) - 1.0,
            weft: weft / (piece.weft().len() as f64 * size[0]) - 1.0,
        })
    }
}
