//! Sessions: chunks of a mesh that stay on the device, for programs that draw them there.

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

/// A session, which makes the mesh of a plan on the plan's device, chunk by chunk, and leaves the
/// chunks there. The device holds two chunks at a time: a third one that `texere_session_mesh`
/// makes takes the buffers of the older one.
///
/// One thread at a time may use a session: a call fails with TEXERE_ARGUMENT while a call of
/// another thread is using it.
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

/// Starts a session of a plan: sends the control points of its yarns to the device. `run` may be
/// null. The plan may be freed afterwards.
///
/// Fails with TEXERE_UNSUPPORTED if the device has no buffers of OpenCL or Vulkan to lend, as with
/// "cpu", and with TEXERE_CANCELLED if `run` was cancelled.
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
/// computes with the session's buffers. The objects are valid until the session is freed. The
/// caller sets `native->struct_size` before the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_session_native(
    session: *const texere_session,
    native: *mut texere_native,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `native`.
        unsafe { check_sized("native", native) }?;
        let found = alone(session, |lending| natives(lending.session.engine()))?;
        // SAFETY: `check_sized` has accepted the size; the caller vouches for the memory.
        unsafe { write_sized(native, found) };
        Ok(())
    })
}

/// Makes the mesh of a chunk on the device, and lends the buffers that hold it: vertices as
/// `texere_vertex`, and indices that count from the chunk's first vertex. `texere_plan_chunk` says
/// how many vertices and indices there are. The call may return before the device is done;
/// `texere_device_mesh` says what to wait for. The caller sets `mesh->struct_size` before the call.
///
/// The buffers belong to the library, and the program may only read them. They stay valid until the
/// session is freed. They hold this chunk's mesh until two other chunks have been made.
///
/// Fails with TEXERE_ARGUMENT if the plan has no chunk of that number.
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
        // SAFETY: `check_sized` has accepted the size; the caller vouches for the memory.
        unsafe { write_sized(mesh, found) };
        Ok(())
    })
}

/// Waits until the device has finished all work of the session.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_session_wait(session: *const texere_session) -> texere_status {
    guard(|| {
        alone(session, |lending| {
            lending.session.timings();
            Ok(())
        })
    })
}

/// Waits for the mesh of a chunk that `texere_session_mesh` has made, and copies it to the caller's
/// memory.
///
/// Fails with TEXERE_ARGUMENT if `vertex_count` or `index_count` is not what `texere_plan_chunk`
/// says, and if the chunk was not made or another chunk has taken its buffers.
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

/// Frees a session with its buffers. A null handle is allowed. None of the program's own commands
/// may be using the buffers then.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_session_free(session: *mut texere_session) {
    free(session);
}
