//! The settings of a mesh.

use texere::Settings;
use texere::mesh::{Frame, Quantum, Topology};

use crate::argument::flag;
use crate::error::guard;
use crate::failure::Failure;
use crate::handle::get;
use crate::sized::{check_sized, grows_after, sized, write_sized};
use crate::status::texere_status;
use crate::yarns::texere_yarns;

/// Sections stand upright: their width lies at right angles to z. A round yarn that runs too
/// steeply for that at any place has TEXERE_FRAME_ROTATION_MINIMIZING instead, along all its
/// length. A flattened yarn that runs so steeply leans instead: see `lean` of `texere_ring`.
pub const TEXERE_FRAME_UPRIGHT: u32 = 0;
/// Sections are carried along the yarn without turning about it.
pub const TEXERE_FRAME_ROTATION_MINIMIZING: u32 = 1;

/// Three indices for each triangle, counted from the base vertex of their draw.
pub const TEXERE_TOPOLOGY_INDEXED: u32 = 0;
/// One pattern of indices that all draws use, counted from the base vertex of each draw.
pub const TEXERE_TOPOLOGY_SHARED: u32 = 1;
/// No indices.
pub const TEXERE_TOPOLOGY_NONE: u32 = 2;

/// The settings of a mesh. `texere_settings_default` fills it in.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_settings {
    /// Size of this struct, bytes. The caller sets it.
    pub struct_size: u32,
    /// How many points are inserted between two control points, 0 to 1023.
    pub subdivisions: u32,
    /// How many sides the tubes have, 3 to 256.
    pub sides: u32,
    /// A constant whose name begins with TEXERE_FRAME.
    pub frame: u32,
    /// A constant whose name begins with TEXERE_TOPOLOGY.
    pub topology: u32,
    /// 1 if the ends of yarns are closed, else 0.
    pub caps: u32,
    /// The step of the grid that packed positions lie on, mm: a power of two from 2^-24 to 2^11.
    pub quantum_mm: f32,
}

grows_after!(texere_settings, quantum_mm);

/// The settings that `pointer` points to, or those that suit `yarns` if it is null.
///
/// # Safety
///
/// A `pointer` that is not null is valid for reads of a `u32`, and of as many bytes as that says.
pub(crate) unsafe fn chosen(
    pointer: *const texere_settings,
    yarns: &texere::Yarns,
) -> Result<Settings, Failure> {
    if pointer.is_null() {
        return Ok(Settings::of(yarns));
    }
    // SAFETY: the caller vouches for it.
    let given = unsafe { sized("settings", pointer) }?;
    let frame = match given.frame {
        TEXERE_FRAME_UPRIGHT => Frame::Upright,
        TEXERE_FRAME_ROTATION_MINIMIZING => Frame::RotationMinimizing,
        other => return Err(Failure::argument(format!("settings.frame is {other}, expected 0 or 1"))),
    };
    let topology = match given.topology {
        TEXERE_TOPOLOGY_INDEXED => Topology::Indexed,
        TEXERE_TOPOLOGY_SHARED => Topology::Shared,
        TEXERE_TOPOLOGY_NONE => Topology::None,
        other => return Err(Failure::argument(format!("settings.topology is {other}, expected 0 to 2"))),
    };
    let caps = flag("settings.caps", given.caps)?;
    let mm = given.quantum_mm;
    let quantum = Quantum::of(mm).ok_or_else(|| {
        Failure::argument(format!("settings.quantum_mm is {mm}, expected a power of two from 2^-24 to 2^11"))
    })?;
    let (subdivisions, sides) = (given.subdivisions, given.sides);
    Ok(Settings { subdivisions, sides, frame, topology, caps, quantum })
}

/// Writes the settings that suit yarns: the usual ones, with as many subdivisions as the yarns'
/// twist needs, and with as many sides as a polygon among their sections has corners. The caller
/// sets `settings->struct_size` before the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_settings_default(
    yarns: *const texere_yarns,
    settings: *mut texere_settings,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `settings`.
        unsafe { check_sized("settings", settings) }?;
        let usual = Settings::of(&*get(yarns)?);
        let found = texere_settings {
            struct_size: size_of::<texere_settings>() as u32,
            subdivisions: usual.subdivisions,
            sides: usual.sides,
            frame: match usual.frame {
                Frame::Upright => TEXERE_FRAME_UPRIGHT,
                Frame::RotationMinimizing => TEXERE_FRAME_ROTATION_MINIMIZING,
            },
            topology: match usual.topology {
                Topology::Indexed => TEXERE_TOPOLOGY_INDEXED,
                Topology::Shared => TEXERE_TOPOLOGY_SHARED,
                Topology::None => TEXERE_TOPOLOGY_NONE,
            },
            caps: u32::from(usual.caps),
            quantum_mm: usual.quantum.mm(),
        };
        // SAFETY: `check_sized` has accepted the size; the caller vouches for the memory.
        unsafe { write_sized(settings, found) };
        Ok(())
    })
}
