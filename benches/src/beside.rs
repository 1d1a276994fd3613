//! Makes meshes of saved yarns when it is told to, and prints the time. A program in another
//! language runs it beside its own calls, by turns, as
//! `crates/texere-python/benches/overhead.py` does.
//!
//! `cargo run --release -p texere-bench --bin beside -- FILE.yarns`
//!
//! Each line of the standard input is a number of threads, each of which makes the mesh once.

use std::error::Error;
use std::io::{Write, stdin, stdout};
use std::thread;
use std::time::Instant;

use texere::{Backend, Pipeline, PipelineError, Settings, Yarns};

fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(1).ok_or("name a file of saved yarns")?;
    let yarns = texere::read::yarns(file)?.yarns;
    let device = texere::open("cpu")?;
    println!("{} {}", Settings::default().sides, Settings::default().subdivisions);
    for line in stdin().lines() {
        let threads: usize = line?.trim().parse()?;
        let start = Instant::now();
        made(&yarns, &*device, threads)?;
        println!("{}", start.elapsed().as_secs_f64());
        stdout().flush()?;
    }
    Ok(())
}

/// Makes the mesh in each of so many threads. The time includes giving the memory back, as it does
/// where Python's last reference goes.
fn made(yarns: &Yarns, device: &dyn Backend, threads: usize) -> Result<(), PipelineError> {
    let mesh = || Pipeline::new(yarns).mesh(device).map(drop);
    if threads == 1 {
        return mesh();
    }
    thread::scope(|scope| {
        let running: Vec<_> = (0..threads).map(|_| scope.spawn(mesh)).collect();
        running.into_iter().filter_map(|thread| thread.join().ok()).collect()
    })
}
