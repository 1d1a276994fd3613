//! Compares the CPU's mesh stage, also with packed vertices, with a plain fill of as many bytes.
//! Both run by turns in one process.
//!
//! `cargo run --release -p texere-bench --bin shares -- [ENDS PICKS [ROUNDS]]`
//!
//! For each kind of mesh, on one thread and on two, it prints the median triangles per second into
//! buffers that are used again, and the fill's bandwidth. It prints the mesh's share of that
//! bandwidth: the median and the best of the rounds' own ratios. It prints the scan's time as a
//! share of the mesh's. For the upright mesh it also prints the triangles per second of meshes in
//! fresh memory, with set-up and allocation.

use std::error::Error;
use std::sync::Arc;
use std::time::{Duration, Instant};

use rayon::ThreadPoolBuilder;
use texere::backend::Plan;
use texere::mesh::{Frame, PackedVertex, Topology};
use texere::{Pipeline, Settings, Vertex, Yarns};
use texere_bench::{median, paper_cloth, plan, session, shaped, stream};
use texere_core::ControlPoint;
use texere_core::backend::{Chunk, MeshMut, Session};
use texere_cpu::ParallelBackend;

/// A kind of mesh, ready to be made.
struct Case {
    name: &'static str,
    output: Output,
    plan: Arc<Plan>,
    chunks: Vec<Chunk>,
    session: Session,
    /// The first control point.
    first: ControlPoint,
    rounds: Vec<Round>,
}

/// The output that is made.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Output {
    /// Vertices and, if the topology has any, indices, into memory of the benchmark.
    Mesh,
    /// Packed vertices, into memory of the session.
    Packed,
}

/// The times of one round.
struct Round {
    fill: Duration,
    scan: Duration,
    mesh: Duration,
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut numbers = std::env::args().skip(1).map(|argument| argument.parse::<usize>());
    let mut next = |default| numbers.next().unwrap_or(Ok(default));
    let (ends, picks, rounds) = (next(1630)?, next(1500)?, next(9)?);
    let yarns = paper_cloth(ends, picks)?.yarns()?;
    let minimizing = Settings { frame: Frame::RotationMinimizing, ..Settings::default() };
    let bare = Settings { topology: Topology::None, ..Settings::default() };
    let upright = Settings::default();
    let kinds = [
        ("upright", upright, yarns.clone(), Output::Mesh),
        ("upright, flattened", upright, shaped(&yarns, 0.0, 2.0)?, Output::Mesh),
        ("upright, twisted", upright, shaped(&yarns, 0.7, 1.0)?, Output::Mesh),
        ("upright, twisted and flattened", upright, shaped(&yarns, 0.7, 2.0)?, Output::Mesh),
        ("rotation minimising", minimizing, yarns.clone(), Output::Mesh),
        ("no indices", bare, yarns.clone(), Output::Mesh),
        ("packed", bare, yarns.clone(), Output::Packed),
        ("packed, flattened", bare, shaped(&yarns, 0.0, 2.0)?, Output::Packed),
    ];

    let mut room: (Vec<Vertex>, Vec<u32>) = (Vec::new(), Vec::new());
    for threads in [1, 2] {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build()?;
        let mut cases = Vec::new();
        for (name, settings, yarns, output) in &kinds {
            cases.push(Case::new(name, *settings, yarns, *output)?);
        }
        for _ in 0..rounds {
            for case in &mut cases {
                let counts = *case.plan.counts();
                let length = |had: usize, wanted: u64| had.max(wanted as usize);
                room.0.resize(length(room.0.len(), counts.vertices), Vertex::default());
                room.1.resize(length(room.1.len(), counts.indices), 0);
                let (vertices, indices) =
                    (&mut room.0[..counts.vertices as usize], &mut room.1[..counts.indices as usize]);
                let round = pool.install(|| case.round(vertices, indices))?;
                case.rounds.push(round);
            }
        }
        for case in &cases {
            case.print(threads);
        }
        let times = (0..rounds.min(5)).map(|_| -> Result<_, Box<dyn Error + Send + Sync>> {
            let cpu = ParallelBackend::open()?;
            let start = Instant::now();
            let mesh = pool.install(|| Pipeline::new(&yarns).mesh(&cpu))?;
            let time = start.elapsed();
            drop(mesh);
            Ok(time)
        });
        let times: Vec<_> = times.collect::<Result<_, _>>().map_err(|error| error as Box<dyn Error>)?;
        let triangles = cases[0].plan.counts().triangles as f64;
        let time = median(times.iter().map(Duration::as_secs_f64).collect());
        println!(
            "{threads} thread(s), one mesh in fresh memory: {:.1} M triangles/s",
            triangles / time / 1e6
        );
    }
    Ok(())
}

impl Case {
    fn new(
        name: &'static str,
        settings: Settings,
        yarns: &Yarns,
        output: Output,
    ) -> Result<Self, Box<dyn Error>> {
        let (plan, chunks) = plan(yarns, settings)?;
        let session = session(&ParallelBackend::open()?, &plan, yarns)?;
        Ok(Self { name, output, plan, chunks, session, first: yarns.points()[0], rounds: Vec::new() })
    }

    fn round(
        &mut self,
        vertices: &mut [Vertex],
        indices: &mut [u32],
    ) -> Result<Round, texere_core::backend::SessionError> {
        let start = Instant::now();
        let floats: &mut [f32] = bytemuck::cast_slice_mut(vertices);
        let share = if self.output == Output::Packed { 2 } else { 1 };
        let written = floats.len() / share;
        stream::fill(&mut floats[..written], 1.0);
        stream::fill(bytemuck::cast_slice_mut(indices), 1.0);
        let fill = start.elapsed();

        // After an upload the session computes its rolls again. Only one point is uploaded, which
        // takes negligible time.
        self.session.upload(0, &[self.first])?;
        let start = Instant::now();
        self.session.scan()?;
        let scan = start.elapsed();

        let start = Instant::now();
        if self.output == Output::Packed {
            for chunk in &self.chunks {
                self.session.packed(chunk)?;
            }
            return Ok(Round { fill, scan, mesh: start.elapsed() });
        }
        let (mut vertices, mut indices) = (vertices, indices);
        for chunk in &self.chunks {
            let (own_vertices, others) = vertices.split_at_mut(chunk.vertices() as usize);
            let (own_indices, other_indices) = indices.split_at_mut(chunk.indices() as usize);
            (vertices, indices) = (others, other_indices);
            self.session.mesh_into(chunk, MeshMut { vertices: own_vertices, indices: own_indices })?;
        }
        Ok(Round { fill, scan, mesh: start.elapsed() })
    }

    fn print(&self, threads: usize) {
        let seconds =
            |of: fn(&Round) -> Duration| self.rounds.iter().map(move |round| of(round).as_secs_f64());
        let (fill, mesh) =
            (median(seconds(|round| round.fill).collect()), median(seconds(|round| round.mesh).collect()));
        let shares: Vec<_> =
            self.rounds.iter().map(|round| round.fill.as_secs_f64() / round.mesh.as_secs_f64()).collect();
        let best = shares.iter().copied().fold(0.0, f64::max);
        let counts = self.plan.counts();
        let bytes = match self.output {
            Output::Mesh => counts.bytes(),
            Output::Packed => counts.vertices * size_of::<PackedVertex>() as u64,
        };
        println!(
            "{threads} thread(s), {}: {:.1} M triangles/s, {:.0} % of the fill's {:.1} GB/s (best round {:.0} %), scan {:.0} % of the mesh",
            self.name,
            counts.triangles as f64 / mesh / 1e6,
            100.0 * median(shares),
            bytes as f64 / fill / 1e9,
            100.0 * best,
            100.0 * median(seconds(|round| round.scan).collect()) / mesh,
        );
    }
}
