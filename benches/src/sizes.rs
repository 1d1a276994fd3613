//! Measures the time for a triangle by the size of the cloth, and with the whole cloth in one yarn.
//! All cloths are measured by turns in one process.
//!
//! `cargo run --release -p texere-bench --bin sizes -- [ROUNDS]`

use std::error::Error;
use std::time::Instant;

use texere::{Settings, Vertex};
use texere_bench::{median, one_yarn, paper_cloth, plan, session};
use texere_core::backend::MeshMut;
use texere_cpu::ParallelBackend;

/// The numbers of ends and picks. The last cloth is the paper's largest.
const SIZES: [(usize, usize); 5] = [(489, 450), (815, 750), (1141, 1050), (1630, 1500), (2880, 1840)];

fn main() -> Result<(), Box<dyn Error>> {
    let rounds = std::env::args().nth(1).map_or(Ok(7), |rounds| rounds.parse())?;
    let mut fabrics = Vec::new();
    for (ends, picks) in SIZES {
        fabrics.push((format!("{ends} x {picks}"), paper_cloth(ends, picks)?.yarns()?));
    }
    let one = one_yarn(&fabrics[3].1)?;
    fabrics.push(("1630 x 1500 in one yarn".into(), one));

    let (mut vertices, mut indices): (Vec<Vertex>, Vec<u32>) = (Vec::new(), Vec::new());
    let mut jobs = Vec::new();
    for (name, yarns) in &fabrics {
        let (plan, chunks) = plan(yarns, Settings::default())?;
        let largest = chunks.iter().map(|chunk| (chunk.vertices() as usize, chunk.indices() as usize));
        let (most_vertices, most_indices) = largest
            .fold((vertices.len(), indices.len()), |most, here| (most.0.max(here.0), most.1.max(here.1)));
        vertices.resize(most_vertices, Vertex::default());
        indices.resize(most_indices, 0);
        jobs.push((name, session(&ParallelBackend::open()?, &plan, yarns)?, plan, chunks, Vec::new()));
    }
    for _ in 0..rounds {
        for (_, session, _, chunks, times) in &mut jobs {
            let start = Instant::now();
            for chunk in &*chunks {
                let vertices = &mut vertices[..chunk.vertices() as usize];
                let indices = &mut indices[..chunk.indices() as usize];
                session.mesh_into(chunk, MeshMut { vertices, indices })?;
            }
            times.push(start.elapsed().as_secs_f64());
        }
    }
    for (name, _, plan, _, times) in jobs {
        let counts = plan.counts();
        let time = median(times) / counts.triangles as f64;
        println!("{name}: {} yarns, {} triangles, {:.2} ns each", counts.yarns, counts.triangles, time * 1e9);
    }
    Ok(())
}
