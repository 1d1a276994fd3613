//! Makes a cloth or its mesh several times, for a count of instructions: `instructions KIND TIMES`.
//!
//! KIND says what is made. The kinds of meshes are `upright`, with upright frames; `flattened`, of
//! flattened yarns; `minimizing`, with rotation minimising frames and their scan; `bare`, without
//! indices; `streamed`, as `upright`, but so large that it is written past the caches. The kinds of
//! control points are `crossing`, one point at each crossing; `round`, with threads bent round one
//! another. The program prints the number of rings of one mesh, or of control points of one cloth.

use std::error::Error;

use texere::Settings;
use texere::mesh::{Frame, Topology};
use texere::woven::Shape;
use texere_bench::{paper_cloth, plan, session, shaped};
use texere_core::backend::MeshMut;
use texere_cpu::ParallelBackend;

/// Ends and picks of a cloth whose mesh is written through the caches.
const SMALL: (usize, usize) = (60, 60);

/// Ends and picks of a cloth whose mesh is large enough to be written past the caches (32 MiB,
/// `STREAM_BYTES` of texere-cpu).
const LARGE: (usize, usize) = (240, 240);

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<_> = std::env::args().skip(1).collect();
    let [kind, times] = arguments.as_slice() else {
        return Err("usage: instructions KIND TIMES".into());
    };
    let times = times.parse()?;
    let made = match kind.as_str() {
        "upright" => mesh(SMALL, 1.0, Settings::default(), times)?,
        "flattened" => mesh(SMALL, 2.0, Settings::default(), times)?,
        "minimizing" => {
            mesh(SMALL, 1.0, Settings { frame: Frame::RotationMinimizing, ..Settings::default() }, times)?
        }
        "bare" => mesh(SMALL, 1.0, Settings { topology: Topology::None, ..Settings::default() }, times)?,
        "streamed" => mesh(LARGE, 1.0, Settings::default(), times)?,
        "crossing" => generate(Shape::Crossing, times)?,
        "round" => generate(Shape::Round, times)?,
        _ => return Err(format!("there is no kind {kind}").into()),
    };
    println!("{made}");
    Ok(())
}

/// Makes the control points of a cloth `times` times, and returns their number in one cloth. The
/// cloth is so large that all other work is negligible.
fn generate(shape: Shape, times: u32) -> Result<u64, Box<dyn Error>> {
    let mut cloth = paper_cloth(300, 300)?;
    cloth.set_shape(shape);
    for _ in 0..times {
        cloth.yarns()?;
    }
    Ok(cloth.point_count())
}

/// Makes a mesh `times` times, and returns the number of its rings. Its yarns are `flatness` times
/// as wide as high.
fn mesh(
    (ends, picks): (usize, usize),
    flatness: f32,
    settings: Settings,
    times: u32,
) -> Result<u64, Box<dyn Error>> {
    let yarns = shaped(&paper_cloth(ends, picks)?.yarns()?, 0.0, flatness)?;
    let (plan, chunks) = plan(&yarns, settings)?;
    let mut session = session(&ParallelBackend::open()?, &plan, &yarns)?;
    let mut vertices = texere_core::backend::zeroed("vertices", chunks[0].vertices().into())?;
    let mut indices = texere_core::backend::zeroed("indices", chunks[0].indices().into())?;
    for _ in 0..times {
        // The session scans only after an upload. Only one point is uploaded, which takes
        // negligible time.
        session.upload(0, &yarns.points()[..1])?;
        session.scan()?;
        session.mesh_into(&chunks[0], MeshMut { vertices: &mut vertices, indices: &mut indices })?;
    }
    Ok(plan.counts().rings)
}
