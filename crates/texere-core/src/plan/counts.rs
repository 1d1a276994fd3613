//! How many of everything a plan makes.

use super::{BLOCK_RINGS, Plan};
use crate::{Topology, Vertex};

/// How many of everything a plan makes, uncut.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    /// Yarns.
    pub yarns: u64,
    /// Control points.
    pub control_points: u64,
    /// Rings of all yarns.
    pub rings: u64,
    /// Vertices, caps included.
    pub vertices: u64,
    /// Triangles that get drawn, caps included.
    pub triangles: u64,
    /// Indices that are stored; with [`Topology::Shared`] far fewer than three a triangle.
    pub indices: u64,
}

impl Counts {
    /// Bytes of the mesh: 24 a vertex, 4 an index.
    #[must_use]
    pub const fn bytes(&self) -> u64 {
        self.vertices * size_of::<Vertex>() as u64 + self.indices * 4
    }
}

impl Plan {
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
                // Where the yarn goes on beyond the run, its next ring is repeated.
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
}
