//! Plans of a region, which make only a part of the cloth.

use std::iter;
use std::ops::Range;
use std::sync::Arc;

use super::{BLOCK_RINGS, Bounds, Counts, Plan};
use crate::Topology;
use crate::backend::PaddedPoints;

impl Plan {
    /// A plan that makes only the part of the mesh in a box: the blocks of [`BLOCK_RINGS`] rings
    /// whose own [box](Plan::part_bounds) touches `bounds`. Everything in the box is made, with the
    /// same bits as in the whole mesh. Blocks are made whole, so parts of yarns beyond the box are
    /// made, too. `points` must have been made for this plan.
    ///
    /// Yarns, rings and control points keep their numbers, and all offsets stay. A session of
    /// either plan can make chunks of both. Only [counts](Plan::counts) and [chunks](Plan::chunks)
    /// are those of the region.
    ///
    /// ```
    /// use texere_core::backend::{PaddedPoints, Plan};
    /// use texere_core::{Bounds, ControlPoint, Limits, Settings, Yarn, Yarns};
    /// let points: Vec<_> = (0..1000).map(|x| ControlPoint::new(x as f32, 0.0, 0.0, 0.1)).collect();
    /// let mut yarns = Yarns::builder();
    /// yarns.yarn(Yarn::default(), &points);
    /// let yarns = yarns.build()?;
    /// let plan = Plan::new(yarns.layout().clone(), Settings::default())?; // two rings a millimetre
    /// let mut points = PaddedPoints::new(&plan)?;
    /// points.upload(&plan, 0, yarns.points());
    ///
    /// let part = plan.within(&points, &Bounds::rectangle([500.0, -1.0], [540.0, 1.0]));
    /// let chunk = part.chunks(&Limits::NONE)?.next().ok_or("empty")?;
    /// // Blocks of 64 rings, 32 mm, and the first ring of the next one.
    /// assert_eq!((chunk.parts()[0].first_ring, chunk.rings()), (15 * 64, 2 * 64 + 1));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn within(&self, points: &PaddedPoints, bounds: &Bounds) -> Self {
        let mut runs = Vec::<Range<u64>>::new();
        let blocks = self.offsets.blocks.windows(2).enumerate();
        for (yarn, block) in
            blocks.flat_map(|(yarn, ends)| (ends[0]..ends[1]).map(move |block| (yarn, block)))
        {
            let first = (block - self.offsets.blocks[yarn]) as u32 * BLOCK_RINGS;
            // The block's last triangles reach to the ring after the block.
            let rings = first..first.saturating_add(BLOCK_RINGS + 1);
            if self.part_bounds(points, yarn, rings).touches(bounds) {
                match runs.last_mut() {
                    Some(last) if last.end == block => last.end += 1,
                    _ => runs.push(block..block + 1),
                }
            }
        }
        let mut plan = Self { runs: Arc::from(runs), ..self.clone() };
        plan.counts = plan.count();
        plan
    }

    /// The plan without its region, which makes everything.
    #[must_use]
    pub fn whole(&self) -> Self {
        let mut plan = self.clone();
        if !plan.is_whole() {
            plan.runs = iter::once(0..self.block_count()).collect();
            plan.counts = plan.count();
        }
        plan
    }

    /// Whether the plan makes everything.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.runs.len() == 1 && self.runs[0] == (0..self.block_count())
    }

    /// Counts everything that the plan makes.
    pub(super) fn count(&self) -> Counts {
        let sides = u64::from(self.settings.sides);
        let [mut rings, mut gaps, mut caps] = [0; 3];
        for run in self.runs.iter() {
            let mut yarn = self.yarn_of_block(run.start);
            let mut block = run.start;
            while block < run.end {
                let (first_block, next) = (self.offsets.blocks[yarn], self.offsets.blocks[yarn + 1]);
                let (end, all) = (run.end.min(next), u64::from(self.rings(yarn)));
                let [from, to] =
                    [block, end].map(|block| ((block - first_block) * u64::from(BLOCK_RINGS)).min(all));
                // If the yarn goes on beyond the run, its next ring is repeated.
                let repeated = u64::from(to < all && to > from);
                rings += to - from + repeated;
                gaps += (to - from + repeated).saturating_sub(1);
                if self.settings.caps && !self.yarn(yarn).closed {
                    caps += u64::from(from == 0 && to > 0) + u64::from(to == all && to > from);
                }
                (block, yarn) = (end, yarn + 1);
            }
        }
        let triangles = 2 * sides * gaps + caps * (sides - 2);
        Counts {
            yarns: self.layout.yarns().len() as u64,
            control_points: self.layout.point_count(),
            rings,
            vertices: sides * (rings + caps),
            triangles,
            indices: match self.settings.topology {
                Topology::Indexed => 3 * triangles,
                Topology::Shared => self.shared_index_count(),
                Topology::None => 0,
            },
        }
    }

    /// Ranges of the blocks that the plan makes, in order.
    pub(super) fn runs(&self) -> &[Range<u64>] {
        &self.runs
    }

    /// Whether the plan makes block number `block`.
    pub(super) fn makes(&self, block: u64) -> bool {
        let after = self.runs.partition_point(|run| run.start <= block);
        after > 0 && block < self.runs[after - 1].end
    }

    /// The yarn of block number `block`.
    pub(super) fn yarn_of_block(&self, block: u64) -> usize {
        self.offsets.blocks.partition_point(|&start| start <= block) - 1
    }
}
