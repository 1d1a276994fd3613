//! Feeds a reader any number of inputs:
//! `cargo run -p texere-fuzz --example fuzz -- --reader wif --inputs 1000000`.

use std::path::PathBuf;
use std::time::Instant;

use clap::Parser;
use peak_alloc::PeakAlloc;
use texere_fuzz::{Reader, fuzz};

#[global_allocator]
static HEAP: PeakAlloc = PeakAlloc;

/// Inputs after which progress is printed.
const STEP: u64 = 10_000;

/// Feeds mutated designs to texere's readers.
#[derive(Debug, Parser)]
struct Args {
    /// wif, dtx, wpo, design, notation, image, paper, knitout, knit, warp-knit, yarns, curves,
    /// polylines, stage or texgen; all of them if left out
    #[arg(long)]
    reader: Option<String>,
    /// How many inputs for each reader
    #[arg(long, default_value_t = 1_000_000)]
    inputs: u64,
    /// The first input's number
    #[arg(long, default_value_t = 0)]
    first: u64,
    /// Where the files of an input that fails are kept
    #[arg(long, default_value = "target/fuzz")]
    kept: PathBuf,
}

fn main() {
    let args = Args::parse();
    let readers = Reader::ALL
        .into_iter()
        .filter(|reader| args.reader.as_ref().is_none_or(|name| name == reader.name()));
    for reader in readers {
        let (start, end) = (Instant::now(), args.first + args.inputs);
        let (mut number, mut taken) = (args.first, 0);
        while number < end {
            let next = end.min(number + STEP);
            taken += fuzz(reader, number..next, &HEAP, &args.kept);
            number = next;
            let (inputs, seconds) = (number - args.first, start.elapsed().as_secs_f64());
            println!("{}: {inputs} inputs, {taken} taken, {seconds:.0} s", reader.name());
        }
    }
}
