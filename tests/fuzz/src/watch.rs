//! Runs many inputs one after the other, and watches time and memory.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use peak_alloc::PeakAlloc;

use crate::{Depth, Input, Outcome, Reader, drive};

/// Time that an input may take, so that only inputs that hang are caught. The slowest one, a denim
/// with a weft of 3 mm that is to be stretched, takes some seconds. With a limit of 20 s that input
/// counted as hanging while other programs kept both cores busy.
const LIMIT: Duration = Duration::from_secs(60);

/// The most memory that the whole program may take while it handles an input, MiB.
const MEMORY_MIB: f32 = 1024.0;

/// One input in this many goes on to mesh, clearance and rest, which take several times as long as
/// all before. All others end at their yarns.
const DEEP: u64 = 8;

/// Runs the inputs with these numbers. Returns the number of inputs that were accepted and passed
/// through every step that they had to take.
///
/// `heap` counts the program's memory. The files of an input that fails are kept in the folder
/// `kept`.
///
/// # Panics
///
/// At the first input that panics or takes too much memory. An input that hangs ends the program,
/// because nothing else can stop it. Its files are kept first.
#[must_use]
pub fn fuzz(reader: Reader, numbers: std::ops::Range<u64>, heap: &PeakAlloc, kept: &Path) -> u64 {
    let folder = tempfile::tempdir().expect("a folder for inputs");
    let now = Arc::new(Mutex::new((Instant::now(), numbers.start)));
    let ended = Arc::new(AtomicU64::new(0));
    let watch = watch(reader, Arc::clone(&now), Arc::clone(&ended), kept.into());
    let mut taken = 0;
    for number in numbers {
        *now.lock().expect("the watch") = (Instant::now(), number);
        let input = Input::new(reader, number);
        let path = write(&input, folder.path());
        heap.reset_peak_usage();
        let depth = if number.is_multiple_of(DEEP) { Depth::Rest } else { Depth::Yarns };
        let outcome = catch_unwind(AssertUnwindSafe(|| drive(&path, depth)));
        let peak = heap.peak_usage_as_mb();
        let failed = match outcome {
            Err(_) => Some("panics".to_owned()),
            Ok(_) if peak > MEMORY_MIB => Some(format!("takes {peak} MiB")),
            Ok(outcome) => {
                taken += u64::from(outcome == Outcome::Taken);
                None
            }
        };
        if let Some(failed) = failed {
            panic!("{} input {number} {failed}; it is kept in {}", reader.name(), keep(reader, number, kept));
        }
    }
    ended.store(1, Ordering::Relaxed);
    watch.join().expect("the watch");
    taken
}

/// Checks twice a second how long the current input has taken.
fn watch(
    reader: Reader,
    now: Arc<Mutex<(Instant, u64)>>,
    ended: Arc<AtomicU64>,
    kept: PathBuf,
) -> std::thread::JoinHandle<()> {
    std::thread::spawn(move || {
        while ended.load(Ordering::Relaxed) == 0 {
            std::thread::sleep(Duration::from_millis(500));
            let (since, number) = *now.lock().expect("the watch");
            if since.elapsed() > LIMIT && Arc::strong_count(&now) > 1 {
                let place = keep(reader, number, &kept);
                eprintln!(
                    "{} input {number} takes more than {LIMIT:?}; it is kept in {place}",
                    reader.name()
                );
                std::process::abort();
            }
            // The thread that feeds inputs has panicked.
            if Arc::strong_count(&now) == 1 {
                return;
            }
        }
    })
}

/// Writes the files of an input to `folder`. Returns the path of the file that is read.
fn write(input: &Input, folder: &Path) -> PathBuf {
    for (name, bytes) in &input.files {
        std::fs::write(folder.join(name), bytes).expect("an input's file");
    }
    folder.join(input.files[0].0)
}

/// Writes an input's files to a folder in `kept`. Returns the path of that folder.
fn keep(reader: Reader, number: u64, kept: &Path) -> String {
    let folder = kept.join(format!("{}-{number}", reader.name()));
    std::fs::create_dir_all(&folder).expect("a folder for what failed");
    write(&Input::new(reader, number), &folder);
    folder.display().to_string()
}
