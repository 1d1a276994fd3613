//! Measures how much the C library adds to the time of a mesh. One process makes the mesh of a
//! plain weave in the caller's memory, from C and from Rust by turns.
//!
//! `cargo run --release -p texere-bench --features capi --bin c-overhead -- [ENDS PICKS ROUNDS]`
//!
//! Rust makes the mesh in chunks of its usual size, and also in about as many chunks as the C
//! library has. So each round makes three meshes, one from C and two from Rust. The order changes
//! from round to round. All meshes are made in the same memory, which has been written before.

mod calls;

use std::error::Error;
use std::ops::ControlFlow;
use std::ptr::{null, null_mut};
use std::sync::Arc;
use std::time::Instant;

use calls::{design, done, made, plain_weave, sized};
use texere::backend::{Chunk, MeshMut, Plan, Run};
use texere::mesh::Limits;
use texere::{Backend, Settings, Vertex, Yarns};
use texere_bench::median;
use texere_c::*;

/// Memory that all meshes are made in.
struct Memory {
    vertices: Vec<Vertex>,
    indices: Vec<u32>,
}

impl Memory {
    /// The first `vertices` vertices and the first `indices` indices.
    fn part(&mut self, [vertices, indices]: [u64; 2]) -> MeshMut<'_> {
        MeshMut {
            vertices: &mut self.vertices[..vertices as usize],
            indices: &mut self.indices[..indices as usize],
        }
    }
}

/// What a mesh from Rust needs: among others its plan, and the chunks into which `limits` cut it.
struct Rust<'a> {
    yarns: &'a Yarns,
    device: &'a dyn Backend,
    plan: Arc<Plan>,
    limits: Limits,
    chunks: Vec<Chunk>,
}

impl<'a> Rust<'a> {
    fn new(yarns: &'a Yarns, device: &'a dyn Backend, limits: Limits) -> Result<Self, Box<dyn Error>> {
        let plan = Arc::new(Plan::new(yarns.layout().clone(), Settings::of(yarns))?);
        let chunks = plan.chunks(&limits.min(&device.info().limits))?.collect();
        Ok(Self { yarns, device, plan, limits, chunks })
    }

    fn mesh(&self, memory: &mut Memory) -> Result<(), Box<dyn Error>> {
        let go_on = |_| ControlFlow::Continue(());
        let run = Run::start(self.device, self.plan.clone(), self.yarns.points(), self.limits, go_on)?;
        Ok(run.mesh_into(&self.chunks, memory.part(self.plan.mesh_lengths(&self.chunks)))?)
    }
}

/// What a mesh from C needs: its plan, and the sizes of the mesh.
struct C {
    plan: *mut texere_plan,
    counts: texere_counts,
}

impl C {
    fn new(text: &str) -> Result<Self, Box<dyn Error>> {
        let (name, mut counts) = ("cpu", sized());
        // SAFETY: all pointers are those of values that live as long as the calls.
        unsafe {
            let device = made(|out| texere_device_open(name.as_ptr().cast(), name.len(), out))?;
            let cloth = made(|out| texere_cloth_placed(design(text).unwrap_or(null_mut()), out))?;
            let yarns = made(|out| texere_cloth_yarns(cloth, out))?;
            let plan = made(|out| texere_plan_new(yarns, device, null(), out))?;
            done(texere_plan_counts(plan, &mut counts))?;
            Ok(Self { plan, counts })
        }
    }

    fn mesh(&self, memory: &mut Memory) -> Result<(), Box<dyn Error>> {
        let MeshMut { vertices, indices } = memory.part([self.counts.vertices, self.counts.indices]);
        // SAFETY: the memory is as large as the counts say; both kinds of vertex are six floats.
        done(unsafe {
            let (to, also) = (vertices.as_mut_ptr().cast(), indices.as_mut_ptr());
            texere_plan_mesh(self.plan, null(), to, vertices.len() as u64, also, indices.len() as u64)
        })
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let numbers: Result<Vec<usize>, _> = std::env::args().skip(1).map(|number| number.parse()).collect();
    let (ends, picks, rounds) = match numbers?[..] {
        [] => (815, 750, 15),
        [ends, picks, rounds] => (ends, picks, rounds),
        _ => return Err("usage: c-overhead [ENDS PICKS ROUNDS]".into()),
    };
    let text = plain_weave(ends, picks);
    let none = |_: &std::path::Path| Err(std::io::ErrorKind::NotFound.into());
    let (device, cloth) =
        (texere::open("cpu")?, texere::read_from("text.toml", text.as_bytes(), none)?.placed(0.0)?);
    let c = C::new(&text)?;
    let usual = Rust::new(cloth.yarns(), &*device, Limits::default())?;
    // Halves the chunks of `same` until there are as many as the C library has, or more.
    let mut mib = 64;
    let mut same = Rust::new(cloth.yarns(), &*device, Limits::default())?;
    while same.chunks.len() < c.counts.chunks as usize && mib > 1 {
        mib /= 2;
        let limits = Limits { binding_bytes: mib << 20, ..Limits::NONE };
        same = Rust::new(cloth.yarns(), &*device, limits)?;
    }
    println!(
        "{ends} x {picks}: {} triangles; Rust in {} and in {} chunks, C in {}",
        c.counts.triangles,
        usual.chunks.len(),
        same.chunks.len(),
        c.counts.chunks
    );
    let sizes = |rust: &Rust<'_>| rust.plan.mesh_lengths(&rust.chunks);
    let sizes = [sizes(&usual), sizes(&same), [c.counts.vertices, c.counts.indices]];
    let [vertices, indices] =
        [0, 1].map(|kind| sizes.iter().map(|sizes| sizes[kind] as usize).max().unwrap_or(0));
    let mut memory = Memory { vertices: vec![Vertex::default(); vertices], indices: vec![0; indices] };
    let mut times = [const { Vec::new() }; 3];
    // The first round is not timed. It writes all memory once.
    for round in 0..=rounds {
        for turn in 0..3 {
            let who = (round + turn) % 3;
            let start = Instant::now();
            match who {
                0 => usual.mesh(&mut memory)?,
                1 => same.mesh(&mut memory)?,
                _ => c.mesh(&mut memory)?,
            }
            if round > 0 {
                times[who].push(start.elapsed().as_secs_f64());
            }
        }
    }
    let ratio = |to: usize| median(times[2].iter().zip(&times[to]).map(|(own, other)| own / other).collect());
    let ratios = [ratio(0), ratio(1)];
    let [usual, same, own] = times.clone().map(|times| 1e3 * median(times));
    println!("Rust {usual:.1} ms, in C's chunks {same:.1} ms, C {own:.1} ms");
    println!("C to Rust {:.3}, in C's chunks {:.3} (medians of {rounds} rounds)", ratios[0], ratios[1]);
    Ok(())
}
