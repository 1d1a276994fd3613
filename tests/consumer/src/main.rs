//! Runs the README's five lines with a draft, and then every backend of the CPU on threads with
//! little stack. The parallel backend runs once for each kind of vector instructions that the
//! processor has.

use std::error::Error;
use std::thread;

use texere::mesh::{Frame, Topology};
use texere::yarn::Section;
use texere::{Backend, Pipeline, PipelineError, Settings, Yarns};
use texere_cpu::{ParallelBackend, SerialBackend};

/// The least stack that a thread of a program may be expected to have, bytes.
const STACK: usize = 128 << 10;

fn main() -> Result<(), Box<dyn Error>> {
    let designs = concat!(env!("CARGO_MANIFEST_DIR"), "/../../designs");

    let design = texere::read(format!("{designs}/herringbone.wif"))?;
    let device = texere::open("auto")?;
    let cloth = design.rest(&*device).run()?;
    let mesh = Pipeline::new(cloth.yarns()).mesh(&*device)?;
    let folder = std::env::temp_dir().join(format!("texere-consumer-{}", std::process::id()));
    std::fs::create_dir(&folder)?;
    let written = texere::write(&mesh, folder.join("herringbone.glb"));
    std::fs::remove_dir_all(&folder)?;
    written?;
    let (name, device) = (&cloth.design().name, &device.info().name);
    println!("{name} by {device}: {} triangles", mesh.plan.counts().triangles);

    for file in ["denim.toml", "satin.toml"] {
        let mut design = texere::read(format!("{designs}/{file}"))?;
        design.structure.set_section(Section::plied(2))?;
        let yarns = design.yarns()?;
        on_little_stack(&yarns, &SerialBackend::new())?;
        for device in ParallelBackend::each() {
            on_little_stack(&yarns, &device)?;
        }
    }
    Ok(())
}

/// Makes meshes and trajectories of every topology and frame, called from a thread with little
/// stack, with worker threads that have as little.
fn on_little_stack(yarns: &Yarns, device: &dyn Backend) -> Result<(), Box<dyn Error>> {
    let name = &device.info().name;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(4).stack_size(STACK).build()?;
    let work = || -> Result<(), PipelineError> {
        for topology in [Topology::Indexed, Topology::Shared, Topology::None] {
            for (frame, sides) in [(Frame::Upright, 6), (Frame::RotationMinimizing, 6), (Frame::Upright, 13)] {
                let settings = Settings { topology, frame, sides, caps: true, ..Settings::default() };
                Pipeline::new(yarns).settings(settings).mesh(device)?;
                Pipeline::new(yarns).settings(settings).trajectory(device)?;
            }
        }
        Ok(())
    };
    thread::scope(|scope| {
        let caller = thread::Builder::new().stack_size(STACK).spawn_scoped(scope, || pool.install(work))?;
        caller.join().map_err(|_| format!("{name} panicked"))??;
        Ok::<(), Box<dyn Error>>(())
    })?;
    println!("{name}: a stack of {STACK} bytes is enough");
    Ok(())
}
