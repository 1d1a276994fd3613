//! The trials: every case on every device of every backend.

use std::collections::BTreeSet;
use std::ffi::OsString;
use std::process::ExitCode;
use std::sync::{Arc, Mutex};

use libtest_mimic::{Arguments, Completion, Failed, Trial};
use texere_core::{Backend, Limits, Plan, Settings, Yarns};
use texere_cpu::SerialBackend;

use crate::cases::{self, Case};
use crate::compare::{
    Assembled, Quantity, Report, Worst, assemble, compare_bits, compare_counts, compare_with_gold,
    compare_with_oracle,
};
use crate::drive::{DriveError, Way, drive};
use crate::oracle::Oracle;
use crate::registry::Entry;

/// Names, with commas between them, of the backends that must be there.
const REQUIRE: &str = "TEXERE_REQUIRE";

/// The flag that prints how near the outputs came to their bounds.
const WORST: &str = "--worst";

/// The suite's own chunks hold at most this share of a plan's blocks, so that every case of more than one block is cut.
const CUTS: u64 = 40;

/// Runs `yarns` under `settings` on `device` every way there is, and tells what is wrong: against the oracle, against
/// the gold reference (to the bit where `exact`), whole against chunked.
///
/// ```
/// use texere_conformance::{DeferredBackend, cases, check};
/// let case = &cases::all()[0];
/// let report = check(&case.yarns(), case.settings, &DeferredBackend::new(), true)?;
/// assert!(report.is_clean(), "{report}");
/// # Ok::<(), texere_conformance::drive::DriveError>(())
/// ```
///
/// **Errors**: [`DriveError`] where the device gives up.
pub fn check(
    yarns: &Yarns,
    settings: Settings,
    device: &dyn Backend,
    exact: bool,
) -> Result<Report, DriveError> {
    let oracle = Oracle::new(yarns, &settings);
    let plan = Arc::new(Plan::new(yarns.layout().clone(), settings)?);
    let mut report = Report::default();
    compare_counts(&oracle, &plan, &mut report);

    let mut run = |device: &dyn Backend, limits: &Limits, way| -> Result<Assembled, DriveError> {
        let output = drive(device, &plan, yarns, limits, way, &mut report)?;
        Ok(assemble(&oracle, &output, &mut report))
    };
    let cut = |blocks: u64| Limits { blocks: blocks.max(plan.block_count() / CUTS), ..Limits::NONE };
    let whole = run(device, &Limits::NONE, Way::Into)?;
    let others = [run(device, &cut(2), Way::Streamed)?, run(device, &cut(3), Way::Staged)?];
    let gold = run(&SerialBackend::new(), &Limits::NONE, Way::Into)?;

    compare_with_oracle(&oracle, &whole, &mut report);
    for other in &others {
        compare_bits(&oracle, &whole, other, &mut report);
    }
    if exact {
        compare_bits(&oracle, &gold, &whole, &mut report);
    } else {
        let mut against_gold = Report::default();
        compare_with_gold(&oracle, &gold, &whole, &mut against_gold);
        report.absorb(against_gold);
    }
    Ok(report)
}

/// One trial's worst values.
type WorstOf = Arc<Mutex<Vec<(String, [Worst; Quantity::ALL.len()])>>>;

/// Runs the suite on the backends of `registry` and says whether all is well. `args` are those of a test program, its
/// name first; `--worst` besides prints how near the outputs came to their bounds.
///
/// Each trial is named `case::frame::device`. A backend that is missing shows as ignored, with the reason, or as failed
/// where the environment variable `TEXERE_REQUIRE` names it (`TEXERE_REQUIRE=cpu,opencl`). A backend of one's own takes
/// one line in a test target without harness:
///
/// ```no_run
/// # use texere_cpu::ParallelBackend as MyBackend;
/// use std::sync::Arc;
/// use texere_conformance::{Entry, run};
/// run(std::env::args_os(), &[Entry::near("mine", || Ok(vec![Arc::new(MyBackend::new())]))]);
/// ```
pub fn run(args: impl IntoIterator<Item = impl Into<OsString>>, registry: &[Entry]) -> ExitCode {
    let (asked, args): (Vec<_>, Vec<_>) =
        args.into_iter().map(Into::into).partition(|arg: &OsString| arg == WORST);
    let worst = WorstOf::default();
    let required = std::env::var(REQUIRE).unwrap_or_default();
    let trials = trials(registry, &required, &worst);
    let conclusion = libtest_mimic::run(&Arguments::from_iter(args), trials);
    if !asked.is_empty() {
        print_worst(&mut worst.lock().unwrap());
    }
    conclusion.exit_code()
}

fn trials(registry: &[Entry], required: &str, worst: &WorstOf) -> Vec<Trial> {
    let mut required: BTreeSet<_> =
        required.split(',').map(str::trim).filter(|name| !name.is_empty()).collect();
    let mut trials = Vec::new();
    for entry in registry {
        let must = required.remove(entry.name);
        match (entry.open)() {
            Ok(devices) if !devices.is_empty() => {
                for (device, case) in
                    devices.iter().flat_map(|device| cases::all().into_iter().map(move |case| (device, case)))
                {
                    trials.push(trial(case, device.clone(), entry.exact, worst.clone()));
                }
            }
            Ok(_) => trials.push(missing(entry.name, must, "it has no device".into())),
            Err(error) => trials.push(missing(entry.name, must, chain(&error))),
        }
    }
    trials
        .extend(required.into_iter().map(|name| missing(name, true, "the registry does not have it".into())));
    trials
}

fn trial(case: Case, device: Arc<dyn Backend>, exact: bool, worst: WorstOf) -> Trial {
    let name = format!("{}::{}", case.name, device.info().name);
    Trial::test(name.clone(), move || {
        let report = check(&case.yarns(), case.settings, &*device, exact)
            .map_err(|error| Failed::from(chain(&error)))?;
        worst.lock().unwrap().push((name, Quantity::ALL.map(|quantity| report.worst(quantity))));
        if report.is_clean() { Ok(()) } else { Err(report.to_string().into()) }
    })
}

/// Stands for the trials of a backend that is not there.
fn missing(name: &str, must: bool, reason: String) -> Trial {
    Trial::ignorable_test(format!("{name}::missing"), move || {
        if must { Err(reason.into()) } else { Ok(Completion::ignored_with(reason)) }
    })
}

/// An error with all its causes, on one line.
fn chain(error: &dyn std::error::Error) -> String {
    let causes = std::iter::successors(Some(error), |error| error.source());
    causes.map(ToString::to_string).collect::<Vec<_>>().join(": ")
}

/// Prints one line a trial and the worst of all last: each quantity's error, and its share of what is allowed.
fn print_worst(trials: &mut [(String, [Worst; Quantity::ALL.len()])]) {
    trials.sort_by(|(a, _), (b, _)| a.cmp(b));
    let titles = ["centre, radii", "radius", "tangent, rad", "roll, rad", "vertex, radii", "normal, rad"];
    let line = |name: &str, cells: [String; Quantity::ALL.len()]| {
        println!("{name:<52} {}", cells.map(|cell| format!("{cell:>18}")).join(""));
    };
    line("worst error (share of allowed)", titles.map(Into::into));
    let mut most = [Worst::default(); Quantity::ALL.len()];
    for (name, worst) in trials {
        line(name, worst.map(cell));
        for (most, worst) in most.iter_mut().zip(worst) {
            *most = Worst { error: most.error.max(worst.error), share: most.share.max(worst.share) };
        }
    }
    line("all", most.map(cell));
}

fn cell(worst: Worst) -> String {
    format!("{:.1e} ({:.3})", worst.error, worst.share)
}
