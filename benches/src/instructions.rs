//! Meshes a small cloth some times over, for a count of instructions: `instructions KIND TIMES`.
//!
//! KIND is `upright`, `minimizing` or `bare`, which has no indices. The scan is counted too.

use std::error::Error;
use std::sync::Arc;

use texere::{Frame, Limits, Plan, Settings, Topology};
use texere_bench::{paper_cloth, session};
use texere_core::MeshMut;
use texere_cpu::ParallelBackend;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<_> = std::env::args().skip(1).collect();
    let [kind, times] = arguments.as_slice() else {
        return Err("usage: instructions KIND TIMES".into());
    };
    let settings = match kind.as_str() {
        "upright" => Settings::default(),
        "minimizing" => Settings { frame: Frame::RotationMinimizing, ..Settings::default() },
        "bare" => Settings { topology: Topology::None, ..Settings::default() },
        _ => return Err(format!("no kind of mesh is called {kind}").into()),
    };
    let yarns = paper_cloth(60, 60)?.yarns()?;
    let plan = Arc::new(Plan::new(yarns.layout().clone(), settings)?);
    let chunks: Vec<_> = plan.chunks(&Limits::NONE)?.collect();
    let mut session = session(&ParallelBackend::new(), &plan, &yarns)?;
    let mut vertices = texere_core::zeroed("vertices", plan.counts().vertices)?;
    let mut indices = texere_core::zeroed("indices", plan.counts().indices)?;
    for _ in 0..times.parse()? {
        session.scan()?;
        session.mesh_into(&chunks[0], MeshMut { vertices: &mut vertices, indices: &mut indices })?;
    }
    println!("{}", plan.counts().rings);
    Ok(())
}
