//! The mesh: vertices, triangles, and the draws that show it.

use std::sync::Arc;

use crate::backend::{Chunk, Plan};
use crate::definitions::index_pattern;
use crate::topology::SHARED_GAPS;
use crate::{End, Material, Topology, Vertex};

/// A range of indices that draws (part of) one yarn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Draw {
    /// Number of the yarn among all yarns, counted from 0.
    pub yarn: u32,
    /// The range of the mesh's indices.
    pub indices: std::ops::Range<u64>,
    /// The number to add to an index to get a vertex of the mesh.
    pub base_vertex: u64,
    /// The number of vertices from `base_vertex` on that the draw may refer to, for file formats
    /// and interfaces that need it. These are the vertices of the chunk, or those of the draw if
    /// the pattern is shared.
    pub vertices: u64,
}

/// A range of indices that draws (part of) one yarn of a chunk from the chunk's own buffers. The
/// fields are the arguments of an indexed draw on a GPU.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ChunkDraw {
    /// Number of the yarn among all yarns, counted from 0.
    pub yarn: u32,
    /// The range of the chunk's indices, or of the [shared pattern](Plan::shared_indices).
    pub indices: std::ops::Range<u32>,
    /// The number to add to an index to get a vertex of the chunk.
    pub base_vertex: i32,
}

impl Plan {
    /// The number of gaps between rings that the shared pattern covers: as many as the longest yarn
    /// has, room included, but at most [`SHARED_GAPS`].
    fn shared_gaps(&self) -> u64 {
        let longest = self.ring_offsets().windows(2).map(|bounds| bounds[1] - bounds[0] - 1).max();
        longest.unwrap_or(0).min(SHARED_GAPS)
    }

    pub(crate) fn shared_index_count(&self) -> u64 {
        let sides = u64::from(self.settings().sides);
        let caps = if self.settings().caps { self.layout().sections().len() as u64 * 2 } else { 0 };
        self.shared_gaps() * sides * 6 + caps * (sides - 2) * 3
    }

    /// The lengths of the mesh of `chunks`, which are all chunks of the plan: how many vertices,
    /// and how many indices. A ring at which two chunks meet counts twice.
    #[must_use]
    pub fn mesh_lengths(&self, chunks: &[Chunk]) -> [u64; 2] {
        let total = |count: fn(&Chunk) -> u32| chunks.iter().map(|chunk| u64::from(count(chunk))).sum();
        let indices = match self.settings().topology {
            Topology::Shared => self.shared_index_count(),
            _ => total(Chunk::indices),
        };
        [total(Chunk::vertices), indices]
    }

    /// The indices of [`Topology::Shared`]: the pattern of as many gaps as one draw may cover. With
    /// caps, the indices of the start cap and of the finish cap follow for each section.
    #[must_use]
    pub fn shared_indices(&self) -> Vec<u32> {
        self.shared().collect()
    }

    /// [`Plan::shared_indices`], one by one.
    pub(crate) fn shared(&self) -> impl Iterator<Item = u32> {
        let sides = self.settings().sides;
        let pattern = index_pattern(sides);
        let tubes = (0..self.shared_gaps() as u32 * sides * 6)
            .map(move |number| number / (sides * 6) * sides + pattern[(number % (sides * 6)) as usize]);
        let sections = if self.settings().caps { self.layout().sections().len() } else { 0 };
        let caps = (0..sections).flat_map(move |section| {
            [End::Start, End::Finish].into_iter().flat_map(move |end| self.cap_indices(section, end))
        });
        tubes.chain(caps)
    }

    /// The indices of [`Plan::shared_indices`] as `u16`, in half the memory, for interfaces that
    /// draw with 16-bit indices and a base vertex. `None` if an index does not fit, which happens
    /// only with more than seven sides and a long yarn.
    ///
    /// ```
    /// use texere_core::backend::Plan;
    /// use texere_core::{ControlPoint, Settings, Topology, Yarn, Yarns};
    /// # let mut yarns = Yarns::builder();
    /// # yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
    /// # let yarns = yarns.build()?;
    /// let settings = Settings { topology: Topology::Shared, ..Settings::default() };
    /// let plan = Plan::new(yarns.layout().clone(), settings)?; // five rings of six sides: four gaps
    /// let indices = plan.shared_indices_u16().ok_or("too many sides")?;
    /// assert_eq!((indices.len(), indices.iter().max()), (4 * 6 * 6, Some(&29)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn shared_indices_u16(&self) -> Option<Vec<u16>> {
        self.shared_indices().into_iter().map(|index| u16::try_from(index).ok()).collect()
    }

    /// The indices of a cap of `section`, counted from the cap's first vertex: three per triangle,
    /// facing out of the yarn.
    pub fn cap_indices(&self, section: usize, end: End) -> impl Iterator<Item = u32> {
        self.cap_triangles(section).iter().flat_map(move |&[a, b, c]| match end {
            End::Start => [a, c, b],
            End::Finish => [a, b, c],
        })
    }

    /// The draws of a chunk as part of a whole mesh, yarn by yarn, the caps last. Empty with
    /// [`Topology::None`].
    pub fn draws<'a>(&'a self, chunk: &'a Chunk) -> impl Iterator<Item = Draw> + 'a {
        self.draws_from(chunk, chunk.first_vertex(), chunk.first_index())
    }

    /// The draws of a chunk from the chunk's own buffers, such as those that a device lends. They
    /// come yarn by yarn, the caps last. Vertices and indices are counted from the chunk's first.
    /// Empty with [`Topology::None`].
    ///
    /// Draw nothing but these ranges of a [`LiveMesh`](crate::backend::LiveMesh), because unused
    /// room between yarns holds triangles from before an edit. An edit may change the draws, for
    /// example if it makes a yarn longer or shorter.
    pub fn chunk_draws<'a>(&'a self, chunk: &'a Chunk) -> impl Iterator<Item = ChunkDraw> + 'a {
        self.draws_from(chunk, 0, 0).map(|draw| ChunkDraw {
            yarn: draw.yarn,
            // The conversion is exact: a chunk has at most as many vertices as an `i32` counts.
            indices: draw.indices.start as u32..draw.indices.end as u32,
            base_vertex: draw.base_vertex as i32,
        })
    }

    fn draws_from<'a>(
        &'a self,
        chunk: &'a Chunk,
        first_vertex: u64,
        first_index: u64,
    ) -> impl Iterator<Item = Draw> + 'a {
        let sides = u64::from(self.settings().sides);
        let topology = self.settings().topology;
        let tubes = chunk.parts().iter().flat_map(move |part| {
            let gaps = u64::from(part.rings) - 1;
            // With a shared pattern, a part is drawn in stretches, and the pattern starts again at
            // each stretch's first ring. An indexed part is one stretch.
            let stretch = if topology == Topology::Shared { SHARED_GAPS } else { gaps.max(1) };
            (0..gaps.div_ceil(stretch)).map(move |number| {
                let here = stretch.min(gaps - number * stretch);
                let (indices, base_vertex) = match topology {
                    Topology::Shared => (0, u64::from(part.first_vertex) + number * stretch * sides),
                    _ => (first_index + u64::from(part.first_index), 0),
                };
                Draw {
                    yarn: part.yarn,
                    indices: indices..indices + here * sides * 6,
                    base_vertex: first_vertex + base_vertex,
                    vertices: if topology == Topology::Shared {
                        (here + 1) * sides
                    } else {
                        chunk.vertices().into()
                    },
                }
            })
        });
        let caps = chunk.caps().iter().map(move |cap| {
            let each = (sides - 2) * 3;
            let (indices, base_vertex) = match topology {
                Topology::Shared => {
                    let section = u64::from(self.yarn(cap.yarn as usize).section);
                    let before = section * 2 + u64::from(cap.end == End::Finish);
                    (self.shared_gaps() * sides * 6 + before * each, u64::from(cap.first_vertex))
                }
                _ => (first_index + u64::from(cap.first_index), 0),
            };
            Draw {
                yarn: cap.yarn,
                indices: indices..indices + each,
                base_vertex: first_vertex + base_vertex,
                vertices: if topology == Topology::Shared { sides } else { chunk.vertices().into() },
            }
        });
        tubes.chain(caps).filter(move |_| topology != Topology::None)
    }
}

/// A piece of a chunk's mesh, borrowed for one call.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum MeshPiece<'a> {
    /// Consecutive vertices of the chunk.
    Vertices {
        /// Number of the first vertex, counted from the chunk's start.
        first: u32,
        /// The vertices.
        vertices: &'a [Vertex],
    },
    /// Consecutive indices of the chunk.
    Indices {
        /// Number of the first index, counted from the chunk's start.
        first: u32,
        /// The indices. They count vertices from the chunk's first.
        indices: &'a [u32],
    },
}

impl MeshPiece<'_> {
    pub(crate) const fn bytes(&self) -> u64 {
        match self {
            Self::Vertices { vertices, .. } => size_of_val(*vertices) as u64,
            Self::Indices { indices, .. } => size_of_val(*indices) as u64,
        }
    }
}

/// The caller's memory for the mesh of a chunk, or of a whole plan: slices of exactly the planned
/// lengths.
#[derive(Debug)]
pub struct MeshMut<'a> {
    /// Vertices: [`Chunk::vertices`] of a chunk, or as many as [`Plan::mesh_lengths`] says.
    pub vertices: &'a mut [Vertex],
    /// Indices: [`Chunk::indices`] of a chunk, or as many as [`Plan::mesh_lengths`] says.
    pub indices: &'a mut [u32],
}

impl MeshMut<'_> {
    /// The bytes of both slices.
    #[must_use]
    pub const fn bytes(&self) -> u64 {
        (size_of_val(self.vertices) + size_of_val(self.indices)) as u64
    }

    /// Copies a piece of the chunk to its place.
    ///
    /// **Panics** for a piece past the end.
    pub fn take(&mut self, piece: MeshPiece<'_>) {
        match piece {
            MeshPiece::Vertices { first, vertices } => {
                self.vertices[first as usize..][..vertices.len()].copy_from_slice(vertices);
            }
            MeshPiece::Indices { first, indices } => {
                self.indices[first as usize..][..indices.len()].copy_from_slice(indices);
            }
        }
    }
}

/// A whole fabric's mesh in host memory.
///
/// The mesh keeps the plan, chunks and materials, so that a writer needs nothing else. A change of
/// colour never rebuilds geometry.
///
/// ```
/// use texere_core::backend::NullBackend;
/// use texere_core::{ControlPoint, Pipeline, Topology, Yarn, Yarns};
/// # let mut yarns = Yarns::builder();
/// # yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
/// # let yarns = yarns.build()?;
/// // Any device does; this one leaves all vertices at the origin.
/// let mesh = Pipeline::new(&yarns).topology(Topology::Shared).mesh(&NullBackend::default())?;
/// for draw in mesh.draws() {
///     let colour = mesh.materials[mesh.plan.yarn(draw.yarn as usize).material as usize].srgb;
///     println!("yarn {}: indices {:?} from vertex {}, {colour:?}", draw.yarn, draw.indices, draw.base_vertex);
/// }
/// assert_eq!(mesh.triangles().count() as u64, mesh.plan.counts().triangles);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Mesh {
    /// All vertices, chunk after chunk.
    pub vertices: Vec<Vertex>,
    /// All indices: chunk after chunk, or the shared pattern.
    pub indices: Vec<u32>,
    /// The chunks, which map each vertex to its yarn.
    pub chunks: Vec<Chunk>,
    /// The plan of the mesh.
    pub plan: Arc<Plan>,
    /// The materials that yarns refer to.
    pub materials: Arc<[Material]>,
}

impl Mesh {
    /// The draws of the mesh, chunk by chunk: first those of the yarns in order, then those of the
    /// caps. There are none with [`Topology::None`].
    pub fn draws(&self) -> impl Iterator<Item = Draw> {
        self.chunks.iter().flat_map(|chunk| self.plan.draws(chunk))
    }

    /// All triangles, as numbers of the mesh's vertices.
    pub fn triangles(&self) -> impl Iterator<Item = [u64; 3]> {
        self.draws().flat_map(|draw| {
            let range = draw.indices.start as usize..draw.indices.end as usize;
            self.indices[range]
                .chunks_exact(3)
                .map(move |corners| [0, 1, 2].map(|corner| draw.base_vertex + u64::from(corners[corner])))
        })
    }
}
