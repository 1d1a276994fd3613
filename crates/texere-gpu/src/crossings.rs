//! Tables of settling by crossings. They are sent to a device byte for byte, and the measures of
//! passes come back in the same way.

use std::ops::ControlFlow;

use bytemuck::{Pod, Zeroable};
use texere_core::BackendError;
use texere_core::crossings::{BESIDE_MAX, CrossingsPass, CrossingsPlan, CrossingsSeen, Row, Set};

/// The most passes that a device makes before the host waits for them.
pub const CROSSINGS_PASSES: u32 = 16;

/// A thread. Lengths are in the plan's unit.
///
/// **Shape**: eight `f32`, 32 bytes. A table has all ends, then all picks.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default, Pod, Zeroable)]
pub struct ThreadRow {
    /// The distance to the next thread.
    pub gap: f32,
    /// The thread's radius.
    pub radius: f32,
    /// The thread's stiffness against bending.
    pub stiffness: f32,
    /// The ratio of width to thickness that the thread tends to.
    pub aspect: f32,
    /// The weight of the difference from [`ThreadRow::aspect`].
    pub shape: f32,
    /// The least area of the thread's section, as a share of its area.
    pub least_area: f32,
    /// The largest shift of the thread to either side.
    pub freedom: f32,
    /// The largest height of the thread, up or down.
    pub height: f32,
}

const _: () = assert!(size_of::<ThreadRow>() == 32 && std::mem::offset_of!(ThreadRow, height) == 28);

/// The parameters of a pass.
///
/// **Shape**: twelve 4-byte values, 48 bytes. Uniform buffers need a multiple of 16.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default, Pod, Zeroable)]
pub struct CrossingsParams {
    /// Number of crossings.
    pub crossings: u32,
    /// Number of ends.
    pub ends: u32,
    /// Number of picks.
    pub picks: u32,
    /// Bits: [`CrossingsParams::ENDS`] and [`CrossingsParams::PICKS`].
    pub flags: u32,
    /// The tension of the warp, 1 for relaxed cloth.
    pub tension_warp: f32,
    /// The tension of the weft, 1 for relaxed cloth.
    pub tension_weft: f32,
    /// The strength of the press, 1 for relaxed cloth.
    pub press: f32,
    /// The weight of terms that keep threads apart.
    pub penalty: f32,
    /// The area that a thread tends to, as a share of its full area.
    pub area: f32,
    /// The number of the pass since the host last waited, counted from 0.
    pub pass_number: u32,
    /// Unused, 0.
    pub padding: [u32; 2],
}

const _: () =
    assert!(size_of::<CrossingsParams>() == 48 && std::mem::offset_of!(CrossingsParams, pass_number) == 36);

/// The measures of a pass, of one workgroup or of all together.
///
/// **Shape**: two `f32`, 8 bytes.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default, Pod, Zeroable)]
pub struct CrossingsSeenRow {
    /// The longest step of any unknown.
    pub step: f32,
    /// The least distance of two threads, as a share of the distance that they need.
    pub clearance: f32,
}

const _: () = assert!(size_of::<CrossingsSeenRow>() == 8);

impl ThreadRow {
    /// The rows of all threads of `plan`.
    #[must_use]
    pub fn all(plan: &CrossingsPlan) -> Vec<Self> {
        let row = |row: &Row| {
            let &Row { gap, radius, stiffness, aspect, shape, least_area, freedom, height } = row;
            Self { gap, radius, stiffness, aspect, shape, least_area, freedom, height }
        };
        Set::BOTH.into_iter().flat_map(|set| plan.rows(set)).map(row).collect()
    }
}

impl CrossingsParams {
    /// Bit of [`CrossingsParams::flags`]: the first end follows the last.
    pub const ENDS: u32 = 1;
    /// Bit of [`CrossingsParams::flags`]: the first pick follows the last.
    pub const PICKS: u32 = 2;

    /// The parameters of `plan`, without those of a pass.
    ///
    /// ```
    /// use texere_core::crossings::{Crossings, CrossingsPass, CrossingsPlan, CrossingThread};
    /// use texere_gpu::{CrossingsParams, ThreadRow};
    /// let thread = CrossingThread::new(0.4, 0.2);
    /// let plain = Crossings::new(vec![true, false, false, true], vec![thread; 2], vec![thread; 2]);
    /// let plan = CrossingsPlan::new(&plain.repeats(true, false))?;
    /// let params = CrossingsParams::new(&plan).with_pass(&CrossingsPass::of(50), 3);
    /// assert_eq!((params.crossings, params.flags, params.penalty), (4, CrossingsParams::ENDS, 1000.0));
    /// assert_eq!(ThreadRow::all(&plan).len(), 4);
    /// # Ok::<(), texere_core::CrossingsError>(())
    /// ```
    #[must_use]
    pub fn new(plan: &CrossingsPlan) -> Self {
        let [ends, picks] = plan.repeats();
        Self {
            crossings: plan.crossings() as u32,
            ends: plan.rows(Set::Warp).len() as u32,
            picks: plan.rows(Set::Weft).len() as u32,
            flags: [(ends, Self::ENDS), (picks, Self::PICKS)]
                .into_iter()
                .filter_map(|(is_set, flag)| is_set.then_some(flag))
                .sum(),
            tension_warp: plan.tension(Set::Warp),
            tension_weft: plan.tension(Set::Weft),
            press: plan.press(),
            ..Self::default()
        }
    }

    /// These parameters for `pass`, which has number `number` since the host last waited.
    #[must_use]
    pub const fn with_pass(self, pass: &CrossingsPass, number: u32) -> Self {
        Self { penalty: pass.penalty, area: pass.area, pass_number: number, ..self }
    }
}

impl CrossingsSeenRow {
    /// The measures as the core has them.
    #[must_use]
    pub const fn seen(self) -> CrossingsSeen {
        CrossingsSeen { step: self.step, clearance: self.clearance }
    }
}

/// Makes passes on a device, at most [`CROSSINGS_PASSES`] in one call of `run`, and calls `watch`
/// with the measures of each until `watch` breaks off. GPU backends implement
/// [`CrossingsSettler::passes`](texere_core::crossings::CrossingsSettler::passes) with this
/// function.
///
/// **Errors**: the errors of `run`.
pub fn crossings_batches(
    passes: &[CrossingsPass],
    mut run: impl FnMut(&[CrossingsPass]) -> Result<Vec<CrossingsSeen>, BackendError>,
    watch: &mut dyn FnMut(&CrossingsPass, Option<CrossingsSeen>) -> ControlFlow<()>,
) -> Result<ControlFlow<()>, BackendError> {
    for passes in passes.chunks(CROSSINGS_PASSES as usize) {
        for (pass, seen) in passes.iter().zip(run(passes)?) {
            if watch(pass, Some(seen)).is_break() {
                return Ok(ControlFlow::Break(()));
            }
        }
    }
    Ok(ControlFlow::Continue(()))
}

/// What a device reads of a crossing besides the states of its threads.
///
/// **Shape**: a `u32`. Its lowest bits are four distances of [`CrossingSite::STEPS`] bits each:
/// from the end to the nearest end of its level before it and after it, and likewise for the pick.
/// A distance is 0 if there is no such thread within [`BESIDE_MAX`] threads. Three bits follow.
#[repr(transparent)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Pod, Zeroable)]
pub struct CrossingSite(pub u32);

const _: () = assert!(BESIDE_MAX < 1 << CrossingSite::STEPS);

impl CrossingSite {
    /// The number of bits of a distance.
    pub const STEPS: u32 = 5;
    /// Bit: the end lies on the face.
    pub const UP: u32 = 1 << 20;
    /// Bit: end and pick belong to one layer, and touch.
    pub const TOUCH: u32 = 1 << 21;
    /// Bit: end and pick belong to different layers.
    pub const APART: u32 = 1 << 22;

    /// The sites of all crossings of `plan`.
    ///
    /// ```
    /// use texere_core::crossings::{Crossings, CrossingsPlan, CrossingThread};
    /// use texere_gpu::CrossingSite;
    /// let thread = CrossingThread::new(0.4, 0.2);
    /// let plain = Crossings::new(vec![true, false, false, true], vec![thread; 2], vec![thread; 2]);
    /// let sites = CrossingSite::all(&CrossingsPlan::new(&plain)?);
    /// // The nearest neighbour on every side is the next thread.
    /// assert_eq!(sites[0].0, CrossingSite::UP | CrossingSite::TOUCH | 0b00001_00001_00001_00001);
    /// # Ok::<(), texere_core::CrossingsError>(())
    /// ```
    #[must_use]
    pub fn all(plan: &CrossingsPlan) -> Vec<Self> {
        let word = |number: usize| {
            let site = plan.site(number);
            let neighbours = plan.neighbours(site);
            let steps = neighbours.beside.as_flattened().iter().rev();
            let steps = steps.fold(0, |word, &steps| word << Self::STEPS | u32::from(steps));
            let bit = |is_set: bool, bit: u32| if is_set { bit } else { 0 };
            let up = bit(plan.side(site, Set::Warp) > 0.0, Self::UP);
            let contact = bit(neighbours.touch(), Self::TOUCH) | bit(neighbours.are_apart(), Self::APART);
            Self(steps | up | contact)
        };
        (0..plan.crossings()).map(word).collect()
    }
}

/// Lower bound on the bytes of device memory that a pass of `plan` moves. For each crossing, a pass
/// reads the state with momentum, reads and writes the state without momentum, and writes the state
/// with momentum for the next pass. It also reads the crossing's [`CrossingSite`]. A crossing also
/// reads the states of its neighbours, which are not counted again.
#[must_use]
pub fn crossings_pass_bytes(plan: &CrossingsPlan) -> u64 {
    let crossings = plan.crossings() as u64;
    crossings * (4 * 32 + 4)
}
