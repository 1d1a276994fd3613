//! Signals that end the program: unfinished files are removed first.

use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, PoisonError};
use std::{fs, thread};

use nix::sys::signal::{SigSet, Signal};
use signal_hook::consts::{SIGABRT, SIGHUP};
use signal_hook::flag::register_conditional_shutdown;
use signal_hook::low_level::emulate_default_handler;

use crate::fail::WORLD;

/// Signals that end a program by default, except those that its own faults raise, such as SIGSEGV.
const ENDS: [Signal; 10] = [
    Signal::SIGINT,
    Signal::SIGTERM,
    Signal::SIGHUP,
    Signal::SIGQUIT,
    Signal::SIGALRM,
    Signal::SIGVTALRM,
    Signal::SIGUSR1,
    Signal::SIGUSR2,
    Signal::SIGXCPU,
    Signal::SIGXFSZ,
];

/// A lock that the listener takes when a signal ends the program, and holds until the end.
static ENDING: Mutex<()> = Mutex::new(());

/// From this call on, Ctrl-C and similar signals first remove unfinished files, whatever the
/// program is doing. The program then ends by that very signal, so that a shell knows why. A signal
/// that was ignored when the program started stays ignored, as under `nohup`.
///
/// Must be called before other threads start: the signals are blocked in this thread and in those
/// that it starts, and one thread waits for them. A handler would not do, since LLVM, with which
/// drivers of software devices compile kernels, replaces handlers by its own.
pub(crate) fn listen() {
    // If an allocation of the standard library fails, the library prints the number of bytes and
    // aborts. The program then ends with the exit code for memory that failed.
    let always = Arc::new(AtomicBool::new(true));
    let _ = register_conditional_shutdown(SIGABRT, WORLD.into(), always);
    let ignored = ignored();
    let heard: SigSet = ENDS.into_iter().filter(|&signal| ignored >> (signal as i32 - 1) & 1 == 0).collect();
    if heard.thread_block().is_err() {
        return;
    }
    let listener = thread::Builder::new().spawn(move || {
        let Ok(signal) = heard.wait() else { return };
        let _until_the_end = ENDING.lock();
        texere::write::abandon();
        let _ = emulate_default_handler(signal as i32);
    });
    // If no thread can be started, signals end the program as usual. An unfinished file then stays
    // until the next write in its folder removes it.
    if listener.is_err() {
        let _ = heard.thread_unblock();
    }
}

/// If a signal is ending the program, waits for the end. A write that the signal stopped is
/// therefore not reported as a failure.
pub(crate) fn give_way() {
    drop(ENDING.lock().unwrap_or_else(PoisonError::into_inner));
}

/// The ignored signals: bit N - 1, counted from the lowest bit as 0, stands for signal N. Linux
/// lists them in a file. On other systems SIGHUP alone is assumed to be ignored.
fn ignored() -> u64 {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(1 << (SIGHUP - 1))
}
