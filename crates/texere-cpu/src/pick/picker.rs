//! A picker: control points, and boxes round the blocks of yarns.

use std::sync::Arc;

use rayon::prelude::*;
use texere_core::backend::{BLOCK_RINGS, Edits, PaddedPoints, Plan};
use texere_core::definitions::{Turn, index_pattern};
use texere_core::{Bounds, ControlPoint, OutOfMemory, YarnError, check_points};
use thiserror::Error;

use super::tree::BoxTree;
use crate::engine::{Work, resize};
use crate::rolls::Rolls;
use crate::serial::scan_yarn;

/// The fewest blocks of a yarn whose boxes one rayon job makes.
const BLOCKS_LEAST: usize = 64;

/// Why a picker can't be made or changed.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PickError {
    /// The number of control points differs from the plan's.
    #[error("{points} control points, but the plan has {planned}")]
    PointCount {
        /// The number of points given.
        points: u64,
        /// The number of points of the plan.
        planned: u64,
    },
    /// Control points that no yarn can have.
    #[error(transparent)]
    Points(#[from] YarnError),
    /// There is no yarn of this number.
    #[error("yarn {yarn}, but there are {yarns}, counted from 0")]
    NoYarn {
        /// The number asked for, counted from 0.
        yarn: usize,
        /// The number of yarns.
        yarns: usize,
    },
    /// The plan is neither the picker's own plan nor one that [`Plan::edited_all`] makes of it for
    /// the yarns that are set.
    #[error("the plan is not the picker's with yarn {yarn} edited")]
    OtherPlan {
        /// The first yarn that was to be set, counted from 0.
        yarn: usize,
    },
    /// There is not enough memory.
    #[error("there is not enough memory")]
    OutOfMemory(#[from] OutOfMemory),
}

/// Finds the triangle that a ray hits first in the mesh of a cloth: its yarn, ring and side.
///
/// The picker needs no mesh. It holds the control points, 16 bytes each, and about 50 bytes for
/// each block of 64 rings. The time for one ray grows with the logarithm of the number of blocks.
/// The triangles are those of the CPU backends, to the bit. They lie between the same rings and
/// sides for every [`Topology`](texere_core::Topology).
///
/// ```
/// use std::sync::Arc;
/// use texere_core::backend::Plan;
/// use texere_core::{ControlPoint, Ray, Settings, Yarn, Yarns};
/// use texere_cpu::Picker;
/// # let mut yarns = Yarns::builder();
/// # for y in 0..2 {
/// #     yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, y as f32, 0.0, 0.125)));
/// # }
/// # let yarns = yarns.build()?;
/// // Two yarns of radius 0.125 mm from x = 0 to x = 2, at y = 0 and y = 1, seen from above.
/// let plan = Arc::new(Plan::new(yarns.layout().clone(), Settings { sides: 4, ..Settings::default() })?);
/// let mut picker = Picker::new(plan.clone(), yarns.points())?;
/// let down = |x, y| Ray { origin: [x, y, 10.0], direction: [0.0, 0.0, -1.0] };
/// let hit = picker.pick(&down(1.75, 1.0)).ok_or("no hit")?;
/// assert_eq!((hit.place.yarn, hit.place.ring, hit.interval), (1, 3, 1));
/// assert!((hit.distance - 9.875).abs() < 1e-6 && (hit.t - 0.75).abs() < 1e-6);
/// assert!(picker.pick(&down(1.75, 0.5)).is_none());
///
/// // Yarn 0 is laid between the two.
/// let moved = [0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.5, 0.0, 0.125));
/// picker.set_yarn(Arc::new(plan.edited(0, *plan.yarn(0), &moved)?), 0, &moved)?;
/// assert_eq!(picker.pick(&down(1.75, 0.5)).map(|hit| hit.place.yarn), Some(0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Picker {
    pub(super) work: Work,
    /// The boxes of each yarn's blocks.
    pub(super) yarns: Vec<BoxTree>,
    /// The boxes of the yarns. In this tree, yarns that lie side by side are neighbours.
    pub(super) cloth: BoxTree,
    /// The yarn at each position of `cloth`.
    pub(super) order: Vec<u32>,
    /// The position of each yarn in `cloth`.
    positions: Vec<u32>,
    /// For each section, the greatest distance of its outline from its middle. A section's half
    /// width and half height count as 1.
    pub(super) reaches: Vec<f32>,
    /// The indices of the triangles between two rings.
    pub(super) pattern: Vec<u32>,
}

impl Picker {
    /// A picker of the mesh of `plan`. `points` are the control points of all its yarns.
    ///
    /// **Errors**: [`PickError::PointCount`], [`PickError::Points`] for an invalid point,
    /// [`PickError::OutOfMemory`].
    pub fn new(plan: Arc<Plan>, points: &[ControlPoint]) -> Result<Self, PickError> {
        let planned = plan.layout().point_count();
        if points.len() as u64 != planned {
            return Err(PickError::PointCount { points: points.len() as u64, planned });
        }
        let offsets = plan.layout().offsets();
        offsets.par_windows(2).enumerate().try_for_each(|(yarn, bounds)| {
            check_points(yarn, &points[bounds[0] as usize..bounds[1] as usize])
        })?;
        let mut padded = PaddedPoints::new(&plan)?;
        padded.upload(&plan, 0, points);
        let rolls = scanned(&plan, &padded)?;
        let work = Work { plan, points: padded, rolls, lengths: Vec::new() };
        let plan = &work.plan;
        let count = plan.layout().yarns().len();
        let yarns: Vec<_> = (0..count).into_par_iter().map(|yarn| boxes(&work, yarn)).collect();
        let mut order: Vec<_> = (0..count as u32).collect();
        let around: Vec<_> = yarns.iter().map(|tree| *tree.root()).collect();
        sort(&mut order, &around);
        let in_order: Vec<_> = order.iter().map(|&yarn| around[yarn as usize]).collect();
        let mut positions = vec![0; count];
        for (position, &yarn) in (0..).zip(&order) {
            positions[yarn as usize] = position;
        }
        let reach = |section| {
            let outline = plan.outline(section).iter();
            outline.map(|point| point.x.hypot(point.y)).fold(0.0, f32::max)
        };
        let reaches = (0..plan.layout().sections().len()).map(reach).collect();
        let pattern = index_pattern(plan.settings().sides);
        Ok(Self { cloth: BoxTree::new(&in_order), yarns, order, positions, reaches, pattern, work })
    }

    /// The plan of the mesh, with all changes so far.
    #[must_use]
    pub const fn plan(&self) -> &Arc<Plan> {
        &self.work.plan
    }

    /// A box that holds the mesh, with all changes so far.
    #[must_use]
    pub fn bounds(&self) -> Bounds {
        *self.cloth.root()
    }

    /// A box that holds the mesh of yarn number `yarn`, counted from 0, with all changes so far.
    /// None if there is no yarn of this number.
    #[must_use]
    pub fn yarn_bounds(&self, yarn: usize) -> Option<Bounds> {
        self.yarns.get(yarn).map(|tree| *tree.root())
    }

    /// Gives yarn number `yarn`, counted from 0, other control points. `plan` is the picker's own
    /// plan, or the plan that [`Plan::edited`] makes of it for this yarn. Only the boxes of this
    /// yarn, and the boxes above them, are made again.
    ///
    /// **Errors**: the errors of [`Picker::set_yarns`].
    pub fn set_yarn(
        &mut self,
        plan: Arc<Plan>,
        yarn: usize,
        points: &[ControlPoint],
    ) -> Result<(), PickError> {
        let what = plan.layout().yarns().get(yarn).copied().unwrap_or_default();
        self.set_yarns(plan, &Edits::from([(yarn, (what, points))]))
    }

    /// Gives several yarns other control points at once. `plan` is the plan that
    /// [`Plan::edited_all`] makes of the picker's own plan for `edits`.
    ///
    /// **Errors**: [`PickError::NoYarn`], [`PickError::OtherPlan`], [`PickError::PointCount`] of a
    /// yarn, and [`PickError::Points`] leave the picker as it was. After [`PickError::OutOfMemory`]
    /// the picker must not be used any more.
    pub fn set_yarns(&mut self, plan: Arc<Plan>, edits: &Edits<'_>) -> Result<(), PickError> {
        let Some((&first, _)) = edits.first_key_value() else { return Ok(()) };
        let yarns = self.yarns.len();
        if let Some((&yarn, _)) = edits.range(yarns..).next() {
            return Err(PickError::NoYarn { yarn, yarns });
        }
        if !differ_by(self.plan(), &plan, edits) {
            return Err(PickError::OtherPlan { yarn: first });
        }
        let offsets = plan.layout().offsets();
        for (&yarn, (_, points)) in edits {
            let (given, planned) = (points.len() as u64, offsets[yarn + 1] - offsets[yarn]);
            if given != planned {
                return Err(PickError::PointCount { points: given, planned });
            }
            check_points(yarn, points)?;
        }
        let scans_already = self.plan().needs_scan();
        let Work { points: padded, rolls, .. } = &mut self.work;
        for (&yarn, (_, points)) in edits {
            padded.upload(&plan, offsets[yarn], points);
        }
        if plan.needs_scan() && !scans_already {
            *rolls = scanned(&plan, padded)?;
        } else if plan.needs_scan() {
            for &yarn in edits.keys() {
                let at_block = &mut rolls.at_block[plan.block_offsets()[yarn] as usize..];
                rolls.whole[yarn] = scan_yarn(&plan, padded, yarn, at_block);
            }
        }
        self.work.plan = plan;
        for &yarn in edits.keys() {
            self.yarns[yarn] = boxes(&self.work, yarn);
            self.cloth.set(self.positions[yarn] as usize, *self.yarns[yarn].root());
        }
        Ok(())
    }
}

/// Whether `other` is `one` with the yarns of `edits` replaced: the offsets are equal, and so are
/// all other yarns.
fn differ_by(one: &Plan, other: &Plan, edits: &Edits<'_>) -> bool {
    let [before, after] = [one, other].map(|plan| plan.layout().yarns());
    one.shares_offsets(other)
        && (0..before.len()).all(|yarn| match edits.get(&yarn) {
            Some((what, _)) => after[yarn] == *what,
            None => one.rings(yarn) == other.rings(yarn) && before[yarn] == after[yarn],
        })
}

/// The rolls of all yarns.
fn scanned(plan: &Plan, points: &PaddedPoints) -> Result<Rolls, OutOfMemory> {
    let mut rolls = Rolls::default();
    if !plan.needs_scan() {
        return Ok(rolls);
    }
    resize("rolls", &mut rolls.at_block, plan.block_count())?;
    resize("whole turns", &mut rolls.whole, plan.counts().yarns)?;
    let mut left = &mut rolls.at_block[..];
    let mut each: Vec<(&mut [Turn], &mut Turn)> = Vec::new();
    for (blocks, whole) in plan.block_offsets().windows(2).zip(&mut rolls.whole) {
        let (own, rest) = std::mem::take(&mut left).split_at_mut((blocks[1] - blocks[0]) as usize);
        left = rest;
        each.push((own, whole));
    }
    each.into_par_iter().enumerate().for_each(|(yarn, (at_block, whole))| {
        *whole = scan_yarn(plan, points, yarn, at_block);
    });
    Ok(rolls)
}

/// The boxes of a yarn's blocks. Each box also holds the first ring of the next block, where the
/// block's last triangles end.
fn boxes(work: &Work, yarn: usize) -> BoxTree {
    let Work { plan, points, .. } = work;
    let blocks = plan.rings(yarn).div_ceil(BLOCK_RINGS);
    let around = |block: u32| {
        let first = block * BLOCK_RINGS;
        plan.part_bounds(points, yarn, first..first.saturating_add(BLOCK_RINGS + 1))
    };
    let boxes: Vec<_> = (0..blocks).into_par_iter().with_min_len(BLOCKS_LEAST).map(around).collect();
    BoxTree::new(&boxes)
}

/// Puts yarns that lie side by side next to one another in `order`. The yarns are halved along the
/// axis on which their middles lie furthest apart, at the position where the tree halves the row.
/// Each half is then sorted in the same way.
fn sort(order: &mut [u32], around: &[Bounds]) {
    if order.len() < 2 {
        return;
    }
    let middle = |yarn: u32, axis: usize| {
        let Bounds { low, high } = around[yarn as usize];
        low[axis] + high[axis]
    };
    let spread = |axis: usize| {
        let along = order.iter().map(|&yarn| middle(yarn, axis));
        let (low, high) = along.fold((f32::INFINITY, f32::NEG_INFINITY), |(l, h), at| (l.min(at), h.max(at)));
        high - low
    };
    let axis = (0..3).max_by(|&one, &other| spread(one).total_cmp(&spread(other))).unwrap_or(0);
    let half = BoxTree::first_half(order.len());
    order.select_nth_unstable_by(half, |&one, &other| {
        middle(one, axis).total_cmp(&middle(other, axis)).then(one.cmp(&other))
    });
    let (first, second) = order.split_at_mut(half);
    rayon::join(|| sort(first, around), || sort(second, around));
}
