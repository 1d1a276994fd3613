//! Sessions: a mesh that stays on its device, chunk by chunk, for programs that draw it there.

use std::ops::ControlFlow;
use std::sync::{Arc, Mutex};

use texere::backend::Session;

use crate::error::guard;
use crate::handle::{Handle, alone, clear, free, get, get_any, give};
use crate::lent::{mesh as lend, native as natives, texere_device_mesh, texere_native};
use crate::mesh::{memory, texere_vertex};
use crate::plan::{Planned, texere_plan};
use crate::run::texere_run;
use crate::sized::{check_sized, write_sized};
use crate::status::texere_status;

/// A plan at work on its device, whose mesh stays there, chunk by chunk. Two chunks are there at a
/// time: a chunk's buffers hold its mesh until `texere_session_mesh` makes the next chunk but one.
///
/// One thread at a time may use a session. A call while another thread's is under way fails with
/// TEXERE_ARGUMENT.
#[derive(Debug)]
pub struct texere_session;

#[derive(Debug)]
pub(crate) struct Lending {
    planned: Arc<Planned>,
    session: Session,
}

impl Handle for texere_session {
    type Value = Mutex<Lending>;
    const NAME: &str = "session";
}

/// Starts a session of a plan: sends its control points to the device. `run` may be null. The plan
/// may be freed.
///
/// Fails with TEXERE_UNSUPPORTED where the device has no buffers to lend, as `cpu` has none, and
/// with TEXERE_CANCELLED where `run` was cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_session_new(
    plan: *const texere_plan,
    run: *const texere_run,
    out: *mut *mut texere_session,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `out`.
        unsafe { clear(out) }?;
        let planned = get(plan)?;
        let session = planned.start(get_any(run)?)?.into_session();
        natives(session.engine())?;
        // SAFETY: as above.
        unsafe { give(out, Mutex::new(Lending { planned, session })) }
    })
}

/// Writes the objects of Vulkan or OpenCL that a session works with, for a program that draws or
/// computes with its buffers. They are valid until the session is freed. The caller has set
/// `native->struct_size`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_session_native(
    session: *const texere_session,
    native: *mut texere_native,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `native`.
        unsafe { check_sized("native", native) }?;
        let found = alone(session, |lending| natives(lending.session.engine()))?;
        // SAFETY: `check_sized` has taken it; the caller vouches for the rest.
        unsafe { write_sized(native, found) };
        Ok(())
    })
}

/// Makes the mesh of a chunk on the device, and lends its buffers there: vertices as
/// `texere_vertex`, indices that count from the chunk's first vertex. `texere_plan_chunk` says how
/// many there are. The call may return before the device is done: `texere_device_mesh` says what to
/// wait for. The caller has set `mesh->struct_size`.
///
/// The buffers belong to the library, and may be read only. They stay valid until the session is
/// freed, and hold this chunk's mesh until the next chunk but one is made.
///
/// Fails with TEXERE_ARGUMENT where the plan has no chunk of that number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_session_mesh(
    session: *const texere_session,
    number: u64,
    mesh: *mut texere_device_mesh,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `mesh`.
        unsafe { check_sized("mesh", mesh) }?;
        let found = alone(session, |Lending { planned, session }| {
            let chunk = planned.chunk(number)?;
            session.mesh(chunk)?;
            let slot = session.slot_of_mesh(chunk)?;
            lend(session.engine(), slot, chunk)
        })?;
        // SAFETY: `check_sized` has taken it; the caller vouches for the rest.
        unsafe { write_sized(mesh, found) };
        Ok(())
    })
}

/// Waits until the device has done all that the session has asked of it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_session_wait(session: *const texere_session) -> texere_status {
    guard(|| {
        alone(session, |lending| {
            lending.session.timings();
            Ok(())
        })
    })
}

/// Copies the mesh of a chunk that is on the device to the caller's memory. Waits for it.
///
/// Fails with TEXERE_ARGUMENT where `vertex_count` or `index_count` is not what `texere_plan_chunk`
/// says, and where the chunk was not made or is no longer there.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_session_read(
    session: *const texere_session,
    number: u64,
    vertices: *mut texere_vertex,
    vertex_count: u64,
    indices: *mut u32,
    index_count: u64,
) -> texere_status {
    guard(|| {
        alone(session, |Lending { planned, session }| {
            let chunk = planned.chunk(number)?;
            let sizes = [chunk.vertices().into(), chunk.indices().into()];
            // SAFETY: the caller vouches for both.
            let mut out = unsafe { memory((vertices, vertex_count), (indices, index_count), sizes) }?;
            let _ = session.read_mesh(chunk, &mut |piece| {
                out.take(piece);
                ControlFlow::Continue(())
            })?;
            Ok(())
        })
    })
}

/// Frees a session with its buffers, or nothing where it is null. No command of the program's that
/// uses the buffers may be under way.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_session_free(session: *mut texere_session) {
    free(session);
}
