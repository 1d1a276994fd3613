//! Shapes of cloth, and tables of the threads of one direction for the threads that cross them.

use texere_core::Section;

use super::thread::{Thread, middles, pitches};
use crate::reach::Reach;

/// Number and places of a thread's control points.
///
/// ```
/// use texere_core::{Material, Section};
/// use texere_fabric::{Shape, Thread, Weave, Woven};
/// let thread = Thread::new(0.4, 0.1);
/// let plain = Weave::parse("plain")?.drawdown(3, 2)?;
/// let mut cloth =
///     Woven::new(plain, vec![thread; 3], vec![thread; 2], vec![Material::default()], vec![Section::Circle])?;
/// cloth.set_shape(Shape::Crossing);
/// assert_eq!(cloth.point_count(), 3 * 4 + 2 * 5);
/// // Each end changes sides once, each pick twice.
/// cloth.set_shape(Shape::Round);
/// assert_eq!(cloth.point_count(), 3 * (4 + 3) + 2 * (5 + 6));
/// # Ok::<(), texere_fabric::FabricError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[non_exhaustive]
pub enum Shape {
    /// One control point at each crossing, and one before and after all crossings, as in the paper
    /// that texere implements (README.md). If crossed threads lie close, threads swing out further
    /// than their thickness needs, because the spline cuts corners. Floats bulge.
    Crossing,
    /// Threads bend round one another as round threads do, and floats lie flat. There are three
    /// more control points wherever a thread changes sides, and a few more within floats that are
    /// long compared with the pitch beside them.
    #[default]
    Round,
}

/// The threads of one direction, as tables for the threads that cross them.
#[derive(Debug, Clone)]
pub(super) struct Set {
    /// The place of each thread, mm.
    pub(super) at: Vec<f32>,
    /// Half the width of each thread's room, mm. The room is an ellipse that holds the section in
    /// every position to which twist turns it.
    pub(super) half_width: Vec<f32>,
    /// Half the height of each thread's room, mm.
    pub(super) half_height: Vec<f32>,
    /// Mean distance of each thread to its neighbours, mm.
    pub(super) pitch: Vec<f32>,
    /// Sum of all spacings, mm. A yarn that crosses these threads ends there.
    pub(super) extent: f32,
}

impl Set {
    pub(super) fn new(threads: &[Thread], sections: &[Section]) -> Self {
        let reaches: Vec<Reach> = sections.iter().map(Reach::new).collect();
        let [first, last] =
            [threads.first(), threads.last()].map(|thread| thread.map_or(0.0, |thread| thread.spacing_mm));
        // An edge thread is treated as if a thread like itself lay beyond the edge.
        let before = [first].into_iter().chain(pitches(threads));
        let after = pitches(threads).chain([last]);
        let room = |half: usize| {
            let room = |thread: &Thread| reaches[thread.section as usize].room(thread.twist)[half];
            threads.iter().map(|thread| thread.halves_mm()[half] * room(thread)).collect()
        };
        Self {
            at: middles(threads).map(|at| at as f32).collect(),
            half_width: room(0),
            half_height: room(1),
            pitch: before.zip(after).map(|(before, after)| ((before + after) / 2.0) as f32).collect(),
            extent: (middles(threads).last().unwrap_or(0.0) + last / 2.0) as f32,
        }
    }
}
