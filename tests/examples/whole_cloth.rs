//! Compares the mesh of a whole design on a device with the CPU's, vertex by vertex, for cloths
//! that are too large for the suite.
//!
//! ```sh
//! cargo run --release -p texere-conformance --example whole_cloth -- designs/paper/1141x1050.toml wgpu:0 opencl:0
//! ```

use std::ops::ControlFlow;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Instant;

use texere::backend::Plan;
use texere::mesh::MeshPiece;
use texere::{Backend, Pipeline, Settings, Yarns};
use texere_core::Vertex;
use texere_core::backend::{Chunk, MeshMut, Session, zeroed};

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let Some((design, devices)) = args.split_first() else {
        eprintln!("usage: whole_cloth DESIGN DEVICE...");
        return ExitCode::from(2);
    };
    let yarns = texere::read(design).unwrap().yarns().unwrap();
    let mut agree = true;
    for name in devices {
        let device = texere::open(name).unwrap();
        let start = Instant::now();
        let worst = compare(&yarns, &*device);
        println!(
            "{design} on {name} ({}): {} vertices in {} chunks, {:.1} s, {worst:?}",
            device.info().device,
            worst.vertices,
            worst.chunks,
            start.elapsed().as_secs_f64()
        );
        agree &= worst.agrees();
    }
    if agree { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// The counts and the largest differences of a comparison.
#[derive(Debug, Default)]
struct Worst {
    chunks: u64,
    vertices: u64,
    /// Largest difference of a coordinate, in units of the tolerance: 1e-4 of the least half height
    /// of the cloth's yarns plus 4 units in the last place.
    position: f32,
    /// Largest difference of a normal's component, in units of 1e-4.
    normal: f32,
    wrong_indices: u64,
}

impl Worst {
    fn agrees(&self) -> bool {
        self.position <= 1.0 && self.normal <= 1.0 && self.wrong_indices == 0
    }
}

fn compare(yarns: &Yarns, device: &dyn Backend) -> Worst {
    let radius = yarns.points().iter().map(|point| point.half_height()).fold(f32::MAX, f32::min);
    let plan = Arc::new(Plan::new(yarns.layout().clone(), Settings::default()).unwrap());
    let mut gold = Session::new(&*texere::open("cpu").unwrap(), plan.clone()).unwrap();
    gold.upload(0, yarns.points()).unwrap();
    gold.scan().unwrap();

    let mut worst = Worst::default();
    let mut expected: Option<Expected> = None;
    let flow = Pipeline::new(yarns).stream(device, |chunk, piece| {
        if expected.as_ref().is_none_or(|expected| expected.chunk != chunk.index()) {
            expected = Some(Expected::new(&mut gold, chunk));
            worst.chunks += 1;
        }
        worst.take(expected.as_ref().unwrap(), piece, radius);
        ControlFlow::Continue(())
    });
    let _: ControlFlow<()> = flow.unwrap();
    // The comparison above does not notice a chunk without pieces.
    assert!(
        worst.vertices >= plan.counts().vertices,
        "{} vertices of {}",
        worst.vertices,
        plan.counts().vertices
    );
    worst
}

/// The mesh of a chunk, made by the CPU.
struct Expected {
    chunk: u64,
    vertices: Vec<Vertex>,
    indices: Vec<u32>,
}

impl Expected {
    fn new(gold: &mut Session, chunk: &Chunk) -> Self {
        let mut vertices = zeroed("vertices", chunk.vertices().into()).unwrap();
        let mut indices = zeroed("indices", chunk.indices().into()).unwrap();
        gold.mesh_into(chunk, MeshMut { vertices: &mut vertices, indices: &mut indices }).unwrap();
        Self { chunk: chunk.index(), vertices, indices }
    }
}

impl Worst {
    fn take(&mut self, expected: &Expected, piece: MeshPiece<'_>, radius: f32) {
        match piece {
            MeshPiece::Vertices { first, vertices } => {
                self.vertices += vertices.len() as u64;
                for (found, gold) in vertices.iter().zip(&expected.vertices[first as usize..]) {
                    for axis in 0..3 {
                        let ulp = gold.position[axis].abs() * f32::EPSILON;
                        let apart =
                            (found.position[axis] - gold.position[axis]).abs() / (1e-4 * radius + 4.0 * ulp);
                        let turned = (found.normal[axis] - gold.normal[axis]).abs() / 1e-4;
                        // A NaN has to be kept, so the comparisons are written to fail for it.
                        self.position = if apart <= self.position { self.position } else { apart };
                        self.normal = if turned <= self.normal { self.normal } else { turned };
                    }
                }
            }
            MeshPiece::Indices { first, indices } => {
                let gold = &expected.indices[first as usize..];
                self.wrong_indices +=
                    indices.iter().zip(gold).filter(|(found, gold)| found != gold).count() as u64;
            }
            _ => {}
        }
    }
}
