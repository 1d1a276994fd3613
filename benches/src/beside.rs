//! Makes meshes of saved yarns whenever another program asks for them, and prints the time that
//! they took. A benchmark in another language runs this program, and times its own calls and this
//! program by turns. `crates/texere-python/benches/overhead.py` is such a benchmark.
//!
//! `cargo run --release -p texere-bench --bin beside -- FILE.yarns...`
//!
//! Each line of the standard input is a number of threads. Each thread makes one mesh, once. The
//! first thread makes the mesh of the first file, the second thread that of the second file, and so
//! on.

use std::error::Error;
use std::io::{Write, stdin, stdout};
use std::thread;
use std::time::Instant;

use texere::{Backend, Pipeline, PipelineError, Settings, Yarns};

fn main() -> Result<(), Box<dyn Error>> {
    let read = |file| texere::read::yarns(file).map(|saved| saved.yarns);
    let cloths: Vec<Yarns> = std::env::args().skip(1).map(read).collect::<Result<_, _>>()?;
    let device = texere::open("cpu")?;
    println!("{} {}", Settings::default().sides, Settings::default().subdivisions);
    for line in stdin().lines() {
        let threads: usize = line?.trim().parse()?;
        let start = Instant::now();
        made(cloths.get(..threads).ok_or("name a file for each thread")?, &*device)?;
        println!("{}", start.elapsed().as_secs_f64());
        stdout().flush()?;
    }
    Ok(())
}

/// Makes the mesh of each cloth. If there are several cloths, each has a thread of its own. The
/// memory of each mesh is freed here, so that the measured time includes the freeing. In Python the
/// time includes the freeing, too, because the last reference to the mesh goes.
fn made(cloths: &[Yarns], device: &dyn Backend) -> Result<(), PipelineError> {
    let mesh = |yarns| Pipeline::new(yarns).mesh(device).map(drop);
    if let [yarns] = cloths {
        return mesh(yarns);
    }
    thread::scope(|scope| {
        let running: Vec<_> = cloths.iter().map(|yarns| scope.spawn(move || mesh(yarns))).collect();
        running.into_iter().filter_map(|thread| thread.join().ok()).collect()
    })
}
