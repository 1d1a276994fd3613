//! The yarn, ring and side of a vertex or a triangle of a chunk.

use super::{Chunk, Plan};
use crate::{End, Topology};

/// The place of a vertex or a triangle on its yarn.
///
/// A triangle has the place of the first vertex of its quad. The triangle lies between that ring
/// and the next, and between that corner of the section and the next.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct MeshPlace {
    /// Number of the yarn among all yarns, counted from 0.
    pub yarn: u32,
    /// Number of the ring, counted from the yarn's start.
    pub ring: u32,
    /// Number of the section's corner, counted from 0. For a cap's triangle it is 0.
    pub side: u32,
    /// The end of the yarn whose cap the vertex or triangle belongs to, if it belongs to one.
    pub cap: Option<End>,
}

impl Plan {
    /// The place of vertex number `vertex` of `chunk`, a chunk of this plan. The time grows with
    /// the logarithm of the number of the chunk's blocks. `None` past the last vertex, and in
    /// unused [room](Plan::with_room).
    ///
    /// ```
    /// use texere_core::backend::Plan;
    /// use texere_core::{ControlPoint, End, Limits, MeshPlace, Settings, Yarn, Yarns};
    /// # let mut yarns = Yarns::builder();
    /// # for y in 0..2 {
    /// #     yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, y as f32, 0.0, 0.1)));
    /// # }
    /// # let yarns = yarns.build()?;
    /// // Two yarns of three points. Each has five rings of six vertices, and a cap at either end.
    /// let plan = Plan::new(yarns.layout().clone(), Settings { caps: true, ..Settings::default() })?;
    /// let chunk = plan.chunks(&Limits::NONE)?.next().ok_or("no chunk")?;
    /// assert_eq!(plan.place_of_vertex(&chunk, 45), Some(MeshPlace { yarn: 1, ring: 2, side: 3, cap: None }));
    /// assert_eq!(plan.place_of_vertex(&chunk, 60), Some(MeshPlace { yarn: 0, ring: 0, side: 0, cap: Some(End::Start) }));
    /// assert_eq!(plan.interval(2), (1, 0.0)); // ring 2 is control point 1
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn place_of_vertex(&self, chunk: &Chunk, vertex: u32) -> Option<MeshPlace> {
        let sides = self.settings().sides;
        let after = chunk.blocks().partition_point(|block| block.first_vertex <= vertex);
        if let Some(block) = chunk.blocks()[..after].last() {
            let own = vertex - block.first_vertex;
            if own / sides < block.rings {
                let (ring, side) = (block.first_ring + own / sides, own % sides);
                return Some(MeshPlace { yarn: block.yarn, ring, side, cap: None });
            }
        }
        let after = chunk.caps().partition_point(|cap| cap.first_vertex <= vertex);
        let cap = chunk.caps()[..after].last().filter(|cap| vertex - cap.first_vertex < sides)?;
        Some(MeshPlace { side: vertex - cap.first_vertex, ..self.place_of_cap(cap.yarn, cap.end) })
    }

    /// The place of triangle number `triangle` of `chunk`, a chunk of this plan. The triangle's
    /// corners are index `3 * triangle` and the two after it. `None` past the last triangle, in
    /// unused room, and with another topology than [`Topology::Indexed`].
    #[must_use]
    pub fn place_of_triangle(&self, chunk: &Chunk, triangle: u32) -> Option<MeshPlace> {
        if self.settings().topology != Topology::Indexed {
            return None;
        }
        let (sides, index) = (self.settings().sides, triangle.checked_mul(3)?);
        // A row without quads begins at the same index as the next one.
        let after = chunk.blocks().partition_point(|block| block.first_index <= index);
        if let Some(block) = chunk.blocks()[..after].iter().rev().find(|block| block.quads > 0) {
            let own = index - block.first_index;
            if own / (6 * sides) < block.quads {
                let (ring, side) = (block.first_ring + own / (6 * sides), own % (6 * sides) / 6);
                return Some(MeshPlace { yarn: block.yarn, ring, side, cap: None });
            }
        }
        let after = chunk.caps().partition_point(|cap| cap.first_index <= index);
        let cap = chunk.caps()[..after].last().filter(|cap| index - cap.first_index < 3 * (sides - 2))?;
        Some(self.place_of_cap(cap.yarn, cap.end))
    }

    /// The number of a ring's control interval, counted from 0 along its yarn, and the ring's
    /// parameter in that interval, in \[0, 1). The last ring of an open yarn is at the start of one
    /// more interval.
    #[must_use]
    pub fn interval(&self, ring: u32) -> (u32, f32) {
        let per_interval = self.settings().subdivisions + 1;
        (ring / per_interval, (ring % per_interval) as f32 / per_interval as f32)
    }

    fn place_of_cap(&self, yarn: u32, end: End) -> MeshPlace {
        let ring = if end == End::Start { 0 } else { self.rings(yarn as usize) - 1 };
        MeshPlace { yarn, ring, side: 0, cap: Some(end) }
    }
}
