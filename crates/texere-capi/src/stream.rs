//! Making the mesh of a plan piece by piece, for a callback.

use std::ffi::c_void;
use std::ops::ControlFlow;
use std::ptr::null;

use texere::backend::Chunk;
use texere::mesh::{MeshPiece, Topology};

use crate::argument::given;
use crate::callback::Answer;
use crate::error::guard;
use crate::handle::{get, get_any};
use crate::mesh::texere_vertex;
use crate::plan::{Planned, texere_draw, texere_plan};
use crate::run::texere_run;
use crate::status::texere_status;

/// A piece of a mesh: vertices, or indices. The piece is valid until the callback returns; its
/// draws are valid until the plan is freed.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_piece {
    /// Size of this struct, bytes. The library sets it.
    pub struct_size: u32,
    /// Zero.
    pub reserved: u32,
    /// The chunk that the piece belongs to, counted from 0.
    pub chunk: u64,
    /// The number of the chunk's first vertex in the mesh. With TEXERE_TOPOLOGY_INDEXED it is what
    /// to add to an index to get the number of a vertex; with TEXERE_TOPOLOGY_SHARED that is
    /// `base_vertex` of each draw.
    pub base_vertex: u64,
    /// The draws of the chunk. Their indices and vertices are numbered in the whole mesh.
    pub draws: *const texere_draw,
    /// How many draws the chunk has.
    pub draw_count: u64,
    /// Vertices; null in a piece of indices.
    pub vertices: *const texere_vertex,
    /// The number of the first of these vertices in the mesh.
    pub first_vertex: u64,
    /// How many vertices the piece has.
    pub vertex_count: u64,
    /// Indices; null in a piece of vertices.
    pub indices: *const u32,
    /// The number of the first of these indices in the mesh.
    pub first_index: u64,
    /// How many indices the piece has.
    pub index_count: u64,
}

/// Takes a piece of a mesh. It returns 0 to go on; any other value ends the call that was given
/// this callback.
pub type texere_piece_callback =
    Option<unsafe extern "C" fn(user: *mut c_void, piece: *const texere_piece) -> i32>;

impl Planned {
    /// A piece of `chunk` that holds neither vertices nor indices yet.
    fn piece(&self, chunk: &Chunk) -> texere_piece {
        let draws = self.draws_of(chunk);
        texere_piece {
            struct_size: size_of::<texere_piece>() as u32,
            reserved: 0,
            chunk: chunk.index(),
            base_vertex: chunk.first_vertex(),
            draws: draws.as_ptr(),
            draw_count: draws.len() as u64,
            vertices: null(),
            first_vertex: 0,
            vertex_count: 0,
            indices: null(),
            first_index: 0,
            index_count: 0,
        }
    }
}

/// Makes the mesh of a plan piece by piece, in bounded memory: the control points and two chunks at
/// a time. Chunks come in order. All vertices of a chunk come before its indices. A piece of
/// indices may end within a triangle. With TEXERE_TOPOLOGY_SHARED the pattern of indices that all
/// draws use comes first, in a piece of chunk 0. `run` may be null. The callback runs on the
/// calling thread, with `user` as its first argument.
///
/// Fails with TEXERE_CANCELLED if `run` was cancelled, or if the callback returned a number other
/// than 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_plan_stream(
    plan: *const texere_plan,
    run: *const texere_run,
    callback: texere_piece_callback,
    user: *mut c_void,
) -> texere_status {
    guard(|| {
        let callback = given(callback)?;
        let (plan, run) = (get(plan)?, get_any(run)?);
        // SAFETY: the caller vouches for the callback; the piece is valid while it runs.
        let take = |piece: texere_piece| Answer::of(unsafe { callback(user, &piece) });
        if let (Topology::Shared, Some(first)) = (plan.plan.settings().topology, plan.chunks.first()) {
            let shared = plan.plan.shared_indices();
            let (indices, index_count) = (shared.as_ptr(), shared.len() as u64);
            take(texere_piece { indices, index_count, ..plan.piece(first) })?;
        }
        let answer = plan.start(run)?.stream(&plan.chunks, |chunk, piece| {
            let whole = plan.piece(chunk);
            let taken = match piece {
                MeshPiece::Vertices { first, vertices } => take(texere_piece {
                    vertices: vertices.as_ptr().cast(),
                    first_vertex: chunk.first_vertex() + u64::from(first),
                    vertex_count: vertices.len() as u64,
                    ..whole
                }),
                MeshPiece::Indices { first, indices } => take(texere_piece {
                    indices: indices.as_ptr(),
                    first_index: chunk.first_index() + u64::from(first),
                    index_count: indices.len() as u64,
                    ..whole
                }),
                _ => Ok(()),
            };
            taken.map_or_else(ControlFlow::Break, ControlFlow::Continue)
        })?;
        match answer {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(answer) => Err(answer.into()),
        }
    })
}
