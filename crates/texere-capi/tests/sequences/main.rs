//! Random sequences of calls. Whatever a program does with the library, no call panics, hangs or
//! accepts an argument that it has to refuse.
//!
//! The test prints its seed. With `TEXERE_SEED` set to a seed it makes the same calls again. Only
//! the calls of eight threads may differ, because the threads share their handles.
//! `TEXERE_SEQUENCES` says how many sequences the test makes:
//!
//! ```sh
//! TEXERE_SEQUENCES=1000 valgrind --leak-check=full --errors-for-leak-kinds=definite \
//!     target/debug/deps/sequences-* --exact one_thread
//! ```
//!
//! A new function of the library needs an operation in the folder `operations`, and a new kind of
//! handle needs a line in `kinds.rs`.

#![allow(clippy::unwrap_used, reason = "a test ends at what it did not expect")]

mod caller;
#[path = "../common/mod.rs"]
mod common;
mod kinds;
mod operations;
mod watchdog;

use std::collections::BTreeMap;
use std::path::Path;
use std::process::ExitCode;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::thread;

use libtest_mimic::{Arguments, Failed, Trial};
use texere_c::texere_status;

use caller::{Caller, Pool, Random};
use operations::{Operation, operations};
use watchdog::Watched;

/// How many sequences one thread makes by itself, unless `TEXERE_SEQUENCES` says otherwise. They
/// have more than a hundred thousand calls.
const SEQUENCES: u64 = 20_000;

/// The largest number of calls of a sequence.
const CALLS: usize = 12;

/// The number of threads that share their handles. All of them together make fewer sequences than
/// one thread by itself, by the factor `FEWER`.
const THREADS: u64 = 8;
const FEWER: u64 = 10;

/// The factor by which fewer sequences are made on a GPU.
const FEWER_ON_GPU: u64 = 1000;

fn main() -> ExitCode {
    let number = |name| std::env::var(name).ok().and_then(|text| text.parse().ok());
    let clock = std::time::UNIX_EPOCH.elapsed().map_or(1, |since| since.as_nanos() as u64);
    let seed = number("TEXERE_SEED").unwrap_or(clock);
    let count = number("TEXERE_SEQUENCES").unwrap_or(SEQUENCES);
    let trials = vec![
        Trial::test("every_function_of_the_header_has_an_operation", complete),
        Trial::test("one_thread", move || one_thread(seed, count)),
        Trial::test("eight_threads", move || eight_threads(seed, count / FEWER)),
        Trial::test("gpu", move || gpu(seed, count / FEWER_ON_GPU)),
    ];
    let arguments = Arguments::from_args();
    if !arguments.list {
        eprintln!("TEXERE_SEED={seed} makes these calls again");
    }
    libtest_mimic::run(&arguments, trials).exit_code()
}

fn complete() -> Result<(), Failed> {
    let header = Path::new(env!("CARGO_MANIFEST_DIR")).join("include/texere.h");
    let header = std::fs::read_to_string(header)?;
    let names = header.lines().filter_map(|line| {
        let (before, _) = line.split_once('(')?;
        let name = before.rsplit([' ', '*']).next()?;
        (name.starts_with("texere_") && !line.starts_with("//") && !line.contains("typedef")).then_some(name)
    });
    let known: Vec<_> = operations().into_iter().map(|operation| operation.name).collect();
    let missing: Vec<_> = names.filter(|name| !known.contains(name)).collect();
    if missing.is_empty() { Ok(()) } else { Err(format!("no operation calls {missing:?}").into()) }
}

/// How often each function succeeded, and how often it failed.
type Ends = BTreeMap<&'static str, [u64; 2]>;

fn one_thread(seed: u64, count: u64) -> Result<(), Failed> {
    let (table, mut ends) = (chosen(|operation| !operation.on_gpu), Ends::new());
    let (watched, folder) = (Watched::new(seed), tempfile::tempdir()?);
    for number in 0..count {
        // Each sequence has a pool of its own and can therefore be repeated without the others.
        let pool = Pool::new(false);
        sequence(&table, Random::of(seed, number), &pool, folder.path(), &watched, &mut ends);
        pool.free_all();
    }
    let calls: u64 = ends.values().flatten().sum();
    println!("{count} sequences of {calls} calls");
    // A small number of sequences may not call every function.
    if count < SEQUENCES {
        return Ok(());
    }
    let (table, ends) = (&table, &ends);
    let never = |end: usize| {
        let names = table.iter().filter(move |operation| {
            (end == 0 || operation.fails) && ends.get(operation.name).is_none_or(|ends| ends[end] == 0)
        });
        names.map(|operation| operation.name).collect::<Vec<_>>()
    };
    let [failed, succeeded] = [never(0), never(1)];
    if failed.is_empty() && succeeded.is_empty() {
        return Ok(());
    }
    Err(format!("never succeeded: {failed:?}; never failed: {succeeded:?}").into())
}

fn eight_threads(seed: u64, count: u64) -> Result<(), Failed> {
    let (pool, folder) = (Pool::new(true), tempfile::tempdir()?);
    let (next, all) = (AtomicU64::new(0), Mutex::new(Ends::new()));
    thread::scope(|scope| {
        for _ in 0..THREADS {
            scope.spawn(|| {
                let (table, mut ends) = (chosen(|operation| !operation.on_gpu), Ends::new());
                let watched = Watched::new(seed);
                loop {
                    let number = next.fetch_add(1, Ordering::Relaxed);
                    if number >= count {
                        break;
                    }
                    sequence(&table, Random::of(!seed, number), &pool, folder.path(), &watched, &mut ends);
                    pool.free_most();
                }
                for (name, [succeeded, failed]) in ends {
                    let mut all = all.lock().unwrap();
                    let sum = all.entry(name).or_default();
                    *sum = [sum[0] + succeeded, sum[1] + failed];
                }
            });
        }
    });
    pool.free_all();
    println!("{count} sequences of {} calls", all.lock().unwrap().values().flatten().sum::<u64>());
    Ok(())
}

fn gpu(seed: u64, count: u64) -> Result<(), Failed> {
    let (table, mut ends) = (chosen(|operation| operation.on_gpu), Ends::new());
    let (watched, folder, pool) = (Watched::new(seed), tempfile::tempdir()?, Pool::new(false));
    for number in 0..count {
        sequence(&table, Random::of(seed, number), &pool, folder.path(), &watched, &mut ends);
    }
    pool.free_all();
    println!("{count} sequences of {} calls", ends.values().flatten().sum::<u64>());
    Ok(())
}

fn chosen(which: impl Fn(&Operation) -> bool) -> Vec<Operation> {
    operations().into_iter().filter(which).collect()
}

/// Makes a sequence of calls. `Caller::call` checks how each of them ends.
fn sequence(
    table: &[Operation],
    random: Random,
    pool: &Pool,
    folder: &Path,
    watched: &Arc<Watched>,
    ends: &mut Ends,
) {
    watched.begin(&random);
    let mut caller = Caller::new(random, pool, folder);
    let weights: usize = table.iter().map(|operation| operation.weight).sum();
    for _ in 0..1 + caller.random.below(CALLS) {
        let mut place = caller.random.below(weights);
        let operation = table.iter().find(|operation| {
            let here = place < operation.weight;
            place = place.saturating_sub(operation.weight);
            here
        });
        let operation = operation.unwrap();
        watched.call(operation.name);
        let status = caller.call(operation);
        let end = usize::from(status != texere_status::TEXERE_OK);
        ends.entry(operation.name).or_default()[end] += 1;
    }
    watched.end();
}
