//! Makes meshes of saved yarns when it is told to, and prints the time. A program in another
//! language runs it beside its own calls, by turns, as
//! `crates/texere-python/benches/overhead.py` does.
//!
//! `cargo run --release -p texere-bench --bin beside -- FILE.yarns...`
//!
//! Each line of the standard input is a number of threads. Each thread makes one mesh once: that of
//! the first file, of the second file, and so on.

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

/// Makes the mesh of each cloth, in a thread for each if there are several. The time includes
/// giving the memory back, as it does where Python's last reference goes.
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
