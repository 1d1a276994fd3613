//! The state of a crossing: the values of its unknowns.

use bytemuck::{Pod, Zeroable};

/// One of the two sets of threads.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Set {
    /// Threads along y.
    Warp,
    /// Threads along x.
    Weft,
}

impl Set {
    /// Both sets, the warp first.
    pub const BOTH: [Self; 2] = [Self::Warp, Self::Weft];

    /// The set that this one crosses.
    ///
    /// ```
    /// assert_eq!(texere_core::crossings::Set::Warp.other(), texere_core::crossings::Set::Weft);
    /// ```
    #[must_use]
    pub const fn other(self) -> Self {
        match self {
            Self::Warp => Self::Weft,
            Self::Weft => Self::Warp,
        }
    }

    /// The number of this set's first unknown among a crossing's eight.
    pub(crate) const fn first(self) -> usize {
        match self {
            Self::Warp => 0,
            Self::Weft => 4,
        }
    }
}

/// The state of a thread at a crossing. All lengths are in the plan's
/// [`unit`](super::CrossingsPlan::unit).
#[derive(Debug, Clone, Copy, PartialEq, Default, Pod, Zeroable)]
#[repr(C)]
pub struct ThreadState {
    /// The shift sideways: of an end along x, of a pick along y.
    pub shift: f32,
    /// The height of the thread's middle.
    pub height: f32,
    /// Half of the thread's width, in the plane of the cloth.
    pub half_width: f32,
    /// Half of the thread's thickness.
    pub half_height: f32,
}

/// The state of both threads at a crossing.
#[derive(Debug, Clone, Copy, PartialEq, Default, Pod, Zeroable)]
#[repr(C)]
pub struct CrossingState {
    /// The state of the end.
    pub warp: ThreadState,
    /// The state of the pick.
    pub weft: ThreadState,
}

impl CrossingState {
    /// The state of the crossing's thread of `set`.
    ///
    /// ```
    /// use texere_core::crossings::{CrossingState, ThreadState, Set};
    /// let crossing = CrossingState { weft: ThreadState { height: 0.5, ..ThreadState::default() }, ..CrossingState::default() };
    /// assert_eq!(crossing.thread(Set::Weft).height, 0.5);
    /// ```
    #[must_use]
    pub const fn thread(&self, set: Set) -> &ThreadState {
        match set {
            Set::Warp => &self.warp,
            Set::Weft => &self.weft,
        }
    }

    /// The largest difference of any unknown from that of the `other` state.
    ///
    /// ```
    /// use texere_core::crossings::{CrossingState, ThreadState};
    /// let risen = CrossingState { weft: ThreadState { height: 0.5, ..ThreadState::default() }, ..CrossingState::default() };
    /// assert_eq!(risen.difference(&CrossingState::default()), 0.5);
    /// ```
    #[must_use]
    pub fn difference(&self, other: &Self) -> f32 {
        let [one, other]: [[f32; 8]; 2] = [bytemuck::cast(*self), bytemuck::cast(*other)];
        one.iter().zip(other).fold(0.0, |most, (one, other)| most.max((one - other).abs()))
    }

    /// The thread of a set, to be changed.
    #[must_use]
    pub const fn thread_mut(&mut self, set: Set) -> &mut ThreadState {
        match set {
            Set::Warp => &mut self.warp,
            Set::Weft => &mut self.weft,
        }
    }
}
