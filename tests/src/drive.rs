//! Drives the session of a backend by hand, into poisoned memory, and keeps all of its output.

use std::ops::ControlFlow;
use std::sync::Arc;

use texere_core::backend::{Chunk, Engine, MeshMut, Plan, Session, SessionError};
use texere_core::definitions::Ring;
use texere_core::{Backend, Limits, MeshPiece, PlanError, Vertex, Yarns};
use thiserror::Error;

use crate::compare::{Fault, Report, RingPlace};
use crate::poison::{POISONED_INDEX, POISONED_RING, POISONED_VERTEX};

/// An error that keeps a case from running.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum DriveError {
    /// The case's settings give no plan, or its chunks do not fit the device.
    #[error("the case can't be planned")]
    Plan(#[from] PlanError),
    /// The session, or the backend behind it, failed.
    #[error("the session failed")]
    Session(#[from] SessionError),
}

/// The ways through a session. All have to give the same output.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// Both stages in one, straight into the caller's memory. Rings come afterwards, from a stage
    /// of their own.
    Into,
    /// Two chunks at a time: one is made while the one before is read. Control points come in
    /// pieces.
    Streamed,
    /// Stage 1, whose rings are read, and then stage 2, whose mesh is read. Control points come in
    /// pieces, the last piece first.
    Staged,
}

/// A backend's whole output, chunk by chunk.
#[derive(Debug)]
pub struct DeviceOutput {
    /// The plan of the output.
    pub plan: Arc<Plan>,
    /// The chunks of the plan.
    pub chunks: Vec<Chunk>,
    /// The output of each chunk.
    pub meshes: Vec<ChunkOutput>,
}

/// The output of a backend for one chunk, with the planned length.
#[derive(Debug)]
pub struct ChunkOutput {
    /// The rings of the chunk.
    pub rings: Vec<Ring>,
    /// The vertices of the chunk.
    pub vertices: Vec<Vertex>,
    /// The indices of the chunk.
    pub indices: Vec<u32>,
}

impl ChunkOutput {
    fn poisoned(chunk: &Chunk) -> Self {
        Self {
            rings: vec![POISONED_RING; chunk.rings() as usize],
            vertices: vec![POISONED_VERTEX; chunk.vertices() as usize],
            indices: vec![POISONED_INDEX; chunk.indices() as usize],
        }
    }
}

/// The least number of control points in a piece of a piecewise upload, except the last piece. It
/// is so small that a small fabric takes many pieces, most of which begin and end within a yarn.
const PIECE_POINTS: usize = 7;

/// The most pieces of a piecewise upload.
const PIECES: usize = 100;

/// Runs `yarns` through a new session of `device` by way `way`. Chunks are cut to `limits` and to
/// the limits of the device.
///
/// Breaches of a session's rules, such as too many pieces or pieces out of order, go to `report`.
/// The output itself is not checked.
///
/// **Errors**: [`DriveError`] if planning or the backend fails.
pub fn drive(
    device: &dyn Backend,
    plan: &Arc<Plan>,
    yarns: &Yarns,
    limits: &Limits,
    way: Way,
    report: &mut Report,
) -> Result<DeviceOutput, DriveError> {
    let mut session = Session::new(device, plan.clone())?;
    upload(&mut session, yarns, way)?;
    if plan.needs_scan() {
        session.scan()?;
    }
    let chunks: Vec<Chunk> = plan.chunks(&limits.min(&device.info().limits))?.collect();
    let mut meshes: Vec<_> = chunks.iter().map(ChunkOutput::poisoned).collect();
    if let (Way::Streamed, Some(first)) = (way, chunks.first()) {
        session.mesh(first)?;
    }
    for (number, (chunk, output)) in chunks.iter().zip(&mut meshes).enumerate() {
        match way {
            Way::Into => {
                let out = MeshMut { vertices: &mut output.vertices, indices: &mut output.indices };
                session.mesh_into(chunk, out)?;
                session.trajectory(chunk)?;
                read_rings(&mut session, chunk, output, report)?;
            }
            Way::Streamed => {
                if let Some(next) = chunks.get(number + 1) {
                    session.mesh(next)?;
                }
                read_mesh(&mut session, chunk, output, report)?;
                read_rings(&mut session, chunk, output, report)?;
            }
            Way::Staged => {
                session.trajectory(chunk)?;
                read_rings(&mut session, chunk, output, report)?;
                session.mesh(chunk)?;
                read_mesh(&mut session, chunk, output, report)?;
            }
        }
    }
    Ok(DeviceOutput { plan: plan.clone(), chunks, meshes })
}

fn upload(session: &mut Session, yarns: &Yarns, way: Way) -> Result<(), SessionError> {
    let points = yarns.points();
    if way == Way::Into {
        return session.upload(0, points);
    }
    let size = PIECE_POINTS.max(points.len().div_ceil(PIECES));
    let pieces = points.chunks(size).enumerate().map(|(number, piece)| ((number * size) as u64, piece));
    let pieces: Vec<_> = if way == Way::Streamed { pieces.collect() } else { pieces.rev().collect() };
    pieces.into_iter().try_for_each(|(first, piece)| session.upload(first, piece))
}

/// Copies `piece` to `out` from `at` on, if it follows the previous piece and fits. Returns whether
/// it does.
fn take<T: Copy>(
    what: &str,
    done: &mut usize,
    at: usize,
    piece: &[T],
    out: &mut [T],
    report: &mut Report,
) -> bool {
    let follows = report.note_count(
        &format!("{what} before the next piece"),
        RingPlace::default(),
        *done as u64,
        at as u64,
    );
    if !follows {
        return false;
    }
    let Some(room) = out.get_mut(at..at + piece.len()) else {
        report.note(
            Fault::Count,
            RingPlace::default(),
            format_args!("{} {what}", out.len()),
            at + piece.len(),
        );
        return false;
    };
    room.copy_from_slice(piece);
    *done += piece.len();
    true
}

fn read_rings(
    session: &mut Session,
    chunk: &Chunk,
    output: &mut ChunkOutput,
    report: &mut Report,
) -> Result<(), SessionError> {
    let mut done = 0;
    let answer = session.read_trajectory(chunk, &mut |piece| {
        let at = done;
        proceed(take("rings", &mut done, at, piece, &mut output.rings, report))
    })?;
    note_end("rings", answer, done, output.rings.len(), report);
    Ok(())
}

fn read_mesh(
    session: &mut Session,
    chunk: &Chunk,
    output: &mut ChunkOutput,
    report: &mut Report,
) -> Result<(), SessionError> {
    let ChunkOutput { vertices: all_vertices, indices: all_indices, .. } = output;
    let (mut vertices_done, mut indices_done) = (0, 0);
    let answer = session.read_mesh(chunk, &mut |piece| match piece {
        MeshPiece::Vertices { first, vertices } => {
            report.note_count("indices before the last vertex", RingPlace::default(), 0, indices_done as u64);
            let (done, at) = (&mut vertices_done, first as usize);
            proceed(take("vertices", done, at, vertices, all_vertices, report))
        }
        MeshPiece::Indices { first, indices } => {
            proceed(take("indices", &mut indices_done, first as usize, indices, all_indices, report))
        }
        _ => ControlFlow::Continue(()),
    })?;
    note_end("vertices", answer, vertices_done, all_vertices.len(), report);
    note_end("indices", answer, indices_done, all_indices.len(), report);
    Ok(())
}

/// A chunk's mesh, joined from the pieces that a session lends.
#[derive(Debug, Default, PartialEq)]
pub struct Lent {
    /// The vertices of the chunk.
    pub vertices: Vec<Vertex>,
    /// The indices of the chunk.
    pub indices: Vec<u32>,
}

impl Lent {
    /// Reads the mesh of `chunk`, which must be in flight.
    ///
    /// **Errors**: those of [`Session::read_mesh`].
    pub fn read<E: Engine + ?Sized>(session: &mut Session<E>, chunk: &Chunk) -> Result<Self, SessionError> {
        let mut lent = Self::default();
        let _ = session.read_mesh(chunk, &mut |piece| {
            match piece {
                MeshPiece::Vertices { vertices, .. } => lent.vertices.extend_from_slice(vertices),
                MeshPiece::Indices { indices, .. } => lent.indices.extend_from_slice(indices),
                _ => {}
            }
            ControlFlow::Continue(())
        })?;
        Ok(lent)
    }
}

fn proceed(fits: bool) -> ControlFlow<()> {
    if fits { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
}

/// Reports missing output, unless the sink itself stopped.
fn note_end(what: &str, answer: ControlFlow<()>, done: usize, planned: usize, report: &mut Report) {
    if answer.is_continue() && done < planned {
        report.note(Fault::Missing, RingPlace::default(), format_args!("{planned} {what}"), done);
    }
}
