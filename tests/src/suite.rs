//! The trials: every case on every device of every backend, and the guarantees of every session.

use std::collections::BTreeSet;
use std::ffi::OsString;
use std::process::ExitCode;
use std::sync::Arc;

use libtest_mimic::{Arguments, Completion, Failed, Trial};
use texere_core::Backend;

use crate::cases::{self, Case};
use crate::check::check_within;
use crate::registry::names;
use crate::registry::{Entry, chain};
use crate::schedule::{beyond, refuses};
use crate::sessions;
use crate::worst::Table;

/// The flag that prints the largest errors beside their tolerances.
const WORST: &str = "--worst";

/// The flag that adds the product of all factors: [`cases::product`].
const FULL: &str = "--full";

/// Runs the suite on the backends of `registry`. Returns whether all trials pass.
///
/// `args` are the arguments of a test program, its name first, such as `--list` and a filter.
/// `--full` adds the cases of [`cases::product`], and `--worst` prints the largest errors beside
/// their tolerances.
///
/// The trial of a case is named `case::device`, and the trial of a guarantee
/// `session::guarantee::device`. A missing backend, or a device that does not open, shows as
/// ignored with the reason. It shows as failed if the backend is in `required`, a list of names
/// with commas between them. Running the suite on a backend of your own takes one line in a test
/// target without harness:
///
/// ```no_run
/// # use texere_wgpu::{Schedule, WgpuBackend as MyBackend};
/// use std::sync::Arc;
/// use texere_conformance::{Entry, run};
/// let mine = Entry::near("mine", || vec![MyBackend::open(0, Schedule::PerRing).map(|mine| Arc::new(mine) as _)]);
/// run(std::env::args_os(), &[mine], "mine");
/// ```
pub fn run(
    args: impl IntoIterator<Item = impl Into<OsString>>,
    registry: &[Entry],
    required: &str,
) -> ExitCode {
    let (own, args): (Vec<_>, Vec<_>) =
        args.into_iter().map(Into::into).partition(|arg: &OsString| arg == WORST || arg == FULL);
    let asked = |flag: &str| own.iter().any(|arg| arg == flag);
    let worst = Table::default();
    let trials = trials(registry, required, asked(FULL), &worst);
    let conclusion = libtest_mimic::run(&Arguments::from_iter(args), trials);
    if asked(WORST) {
        worst.print();
    }
    conclusion.exit_code()
}

fn trials(registry: &[Entry], required: &str, full: bool, worst: &Table) -> Vec<Trial> {
    let mut required: BTreeSet<_> = names(required).collect();
    let mut trials = Vec::new();
    for entry in registry {
        let must = required.remove(entry.name);
        let (devices, reasons) = entry.devices();
        let product = if full { cases::product() } else { Vec::new() };
        let cases: Vec<_> = (entry.cases)().into_iter().chain(product).map(Arc::new).collect();
        for device in devices {
            let of_case = |case: &Arc<Case>| trial(case.clone(), device.clone(), entry.exact, worst);
            trials.extend(cases.iter().map(of_case));
            trials.extend(sessions::trials(&device));
        }
        trials.extend(reasons.into_iter().map(|reason| missing(entry.name, must, reason)));
    }
    trials
        .extend(required.into_iter().map(|name| missing(name, true, "the registry does not have it".into())));
    trials
}

fn trial(case: Arc<Case>, device: Arc<dyn Backend>, exact: bool, worst: &Table) -> Trial {
    let (name, worst) = (format!("{}::{}", case.name, device.info().name), worst.clone());
    Trial::test(name.clone(), move || {
        let yarns = case.yarns();
        if beyond(device.info(), &yarns, &case.settings) {
            return refuses(&*device, &yarns, case.settings);
        }
        let report = check_within(&yarns, case.settings, case.tight, &*device, exact)
            .map_err(|error| Failed::from(chain(&error)))?;
        worst.note(name, &report);
        if report.is_clean() { Ok(()) } else { Err(report.to_string().into()) }
    })
}

/// A trial that stands for a missing backend, or for a missing device.
fn missing(name: &str, must: bool, reason: String) -> Trial {
    Trial::ignorable_test(format!("{name}::missing"), move || {
        if must { Err(reason.into()) } else { Ok(Completion::ignored_with(reason)) }
    })
}
