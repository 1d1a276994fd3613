//! Writing meshes to files.

use std::ffi::{c_char, c_void};
use std::sync::Arc;

use texere::backend;
use texere::mesh::{Limits, Topology};
use texere::write::Format;

use crate::argument::text;
use crate::callback_file::{CallbackFile, texere_write_callback};
use crate::error::guard;
use crate::failure::Failure;
use crate::handle::{get, get_any};
use crate::plan::{Planned, texere_plan};
use crate::run::{Run, texere_run};
use crate::status::texere_status;
use crate::structure::choice;

/// glTF 2.0 in one binary file, `.glb`.
pub const TEXERE_FORMAT_GLB: u32 = 0;
/// Binary PLY, `.ply`.
pub const TEXERE_FORMAT_PLY: u32 = 1;
/// Binary STL, `.stl`: triangles without colours.
pub const TEXERE_FORMAT_STL: u32 = 2;
/// OBJ, `.obj`. Its materials are in a file beside it whose name ends in `.mtl`. A callback gets
/// the bytes of the `.obj` file alone, which names `materials.mtl`.
pub const TEXERE_FORMAT_OBJ: u32 = 3;
/// glTF 2.0 in one binary file, with 12 bytes for a vertex instead of 24: whole numbers, as the
/// extension KHR_mesh_quantization allows. The largest side of the box that a yarn lies in has
/// 65,534 steps. Coordinates are off by half a step at most, and normals by 0.4 degrees. The mesh
/// is made twice. A yarn whose box has a side of more than 655 mm is refused with
/// TEXERE_UNSUPPORTED.
pub const TEXERE_FORMAT_PACKED_GLB: u32 = 4;
/// A packed glTF file that is compressed to about half of its bytes, as the extension
/// EXT_meshopt_compression says.
pub const TEXERE_FORMAT_COMPRESSED_GLB: u32 = 5;
/// glTF 2.0 in one binary file that holds each part of a yarn once, however often it recurs, as the
/// extension EXT_mesh_gpu_instancing says. The mesh is made twice. Cloth whose different parts take
/// more than 256 MiB is refused with TEXERE_UNSUPPORTED.
pub const TEXERE_FORMAT_INSTANCED_GLB: u32 = 6;
/// The text form of Universal Scene Description, `.usda`: a mesh for each yarn.
pub const TEXERE_FORMAT_USDA: u32 = 7;
/// A packed glTF file that is compressed further than TEXERE_FORMAT_COMPRESSED_GLB, as the later
/// extension KHR_meshopt_compression says. Fewer programs know it.
pub const TEXERE_FORMAT_KHR_COMPRESSED_GLB: u32 = 8;

/// Chunks of a file: 2 MiB of vertices at most. The file does not depend on them. A disk that takes
/// 100 MB a second takes a chunk and its triangles in 50 ms.
const LIMITS: Limits = Limits { binding_bytes: 2 << 20, ..Limits::NONE };

impl Planned {
    /// The run that a writer takes: with a pattern of indices for all draws, so that the device
    /// makes none.
    fn writing(&self, run: Option<Arc<Run>>) -> Result<backend::Run<'_>, Failure> {
        self.run_of(Arc::new(self.plan.with_topology(Topology::Shared)), LIMITS, run)
    }
}

/// Makes the mesh of a plan and writes it to a file, `.glb`, `.ply`, `.stl`, `.obj` or `.usda`, in
/// bounded memory. `run` may be null. An existing file of that name is replaced only once the new
/// one is complete.
///
/// Fails with TEXERE_IO if the file can't be written, with TEXERE_UNSUPPORTED if the mesh is too
/// large for the format, and with TEXERE_CANCELLED if `run` was cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_plan_write(
    plan: *const texere_plan,
    run: *const texere_run,
    path: *const c_char,
    path_length: usize,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for `path`.
        let path = unsafe { text("path", path, path_length) }?;
        let (plan, run) = (get(plan)?, get_any(run)?);
        texere::write::run(plan.writing(run)?, plan.yarns.materials(), path)?;
        Ok(())
    })
}

/// Makes the mesh of a plan and hands the bytes of a file to `callback`, in bounded memory: the
/// bytes that `texere_plan_write` writes, or those of a packed, a compressed or an instanced file.
/// `format` is a constant whose name begins with TEXERE_FORMAT. `run` may be null. The callback
/// runs on the calling thread, with `user` as its first argument.
///
/// Fails with TEXERE_UNSUPPORTED if the mesh is too large for the format, and with TEXERE_CANCELLED
/// if `run` was cancelled, or if the callback returned a number other than 0. The bytes that came
/// before then are not a complete file.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_plan_write_to(
    plan: *const texere_plan,
    run: *const texere_run,
    format: u32,
    callback: texere_write_callback,
    user: *mut c_void,
) -> texere_status {
    guard(|| {
        // SAFETY: the caller vouches for the callback.
        let file = unsafe { CallbackFile::new(callback, user) }?;
        let formats = [
            Format::Glb,
            Format::Ply,
            Format::Stl,
            Format::Obj,
            Format::PackedGlb,
            Format::CompressedGlb,
            Format::InstancedGlb,
            Format::Usda,
            Format::KhrCompressedGlb,
        ];
        let format = choice("format", format, &formats)?;
        let (plan, run) = (get(plan)?, get_any(run)?);
        texere::write::run_to(plan.writing(run)?, plan.yarns.materials(), format, file)?;
        Ok(())
    })
}
