//! The suite's own proof: each broken backend is caught, by the name of its fault and no other.

use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use texere_conformance::compare::{Fault, Report};
use texere_conformance::{Entry, OpenAll, REGISTRY, Sabotage, SabotagedBackend, check, run};
use texere_core::{BackendError, ControlPoint, Frame, Settings, Yarn, Yarns};
use texere_cpu::SerialBackend;

/// Two yarns that fit one block each, then one of several blocks.
fn yarns() -> Yarns {
    let at = |k: u32, y: f32| ControlPoint::new(k as f32, y, (k as f32).sin() * 0.5, 0.25);
    let mut yarns = Yarns::builder();
    for (y, points) in [(0.0, 9), (1.0, 9), (2.0, 90)] {
        let points: Vec<_> = (0..points).map(|k| at(k, y)).collect();
        yarns.yarn(Yarn { twist: 0.5, ..Yarn::default() }, &points);
    }
    yarns.build().unwrap()
}

fn report(sabotage: Sabotage, exact: bool) -> Report {
    let settings =
        Settings { subdivisions: 1, frame: Frame::RotationMinimizing, caps: true, ..Settings::default() };
    check(&yarns(), settings, &SabotagedBackend::new(sabotage), exact).unwrap()
}

fn found(report: &Report) -> Vec<Fault> {
    let all = [
        Fault::Count,
        Fault::Missing,
        Fault::NotFinite,
        Fault::Position,
        Fault::Normal,
        Fault::Radius,
        Fault::Tangent,
        Fault::Roll,
        Fault::Index,
        Fault::Bits,
    ];
    all.into_iter().filter(|&fault| report.count(fault) > 0).collect()
}

#[test]
fn an_honest_backend_passes() {
    let report = report(Sabotage::None, true);
    assert!(report.is_clean(), "{report}");
}

#[test]
fn every_sabotage_is_caught_by_name() {
    for sabotage in Sabotage::ALL {
        let report = report(sabotage, false);
        let found = found(&report);
        for fault in sabotage.faults() {
            assert!(found.contains(fault), "{sabotage:?}: no {fault:?} in {report}");
        }
        assert_eq!(found.len(), sabotage.faults().len(), "{sabotage:?}: {report}");
    }
}

/// A backend that promises the gold reference's bits is held to them.
#[test]
fn a_promise_of_equal_bits_is_checked() {
    let last_bit = report(Sabotage::LastBit, true);
    assert!(last_bit.count(Fault::Bits) > 0, "{last_bit}");
    let near_enough = report(Sabotage::LastBit, false);
    assert!(near_enough.is_clean(), "{near_enough}");
}

#[test]
fn a_report_names_the_place_and_both_values() {
    let report = report(Sabotage::ShiftedVertex, false);
    // Once against the oracle, once against the gold reference.
    let [mismatch, _] = report.first() else { panic!("{report}") };
    assert_eq!((mismatch.fault, mismatch.place.yarn), (Fault::Position, 2));
    assert_eq!((mismatch.place.ring, mismatch.place.point), (10, Some(2)));
    assert_ne!(mismatch.expected, mismatch.actual);
    let told = report.to_string();
    assert!(told.starts_with("Position at yarn 2, ring 10, point 2: expected "), "{told}");
    assert!(told.ends_with("2 mismatches: 2 Position"), "{told}");
}

const BROKEN: &[Entry] =
    &[Entry::near("broken", || Ok(vec![Arc::new(SabotagedBackend::new(Sabotage::Zeros))]))];

const STOPPED: &[Entry] =
    &[Entry::near("stopped", || Ok(vec![Arc::new(SabotagedBackend::new(Sabotage::StoppedClock))]))];

const WASTEFUL: &[Entry] =
    &[Entry::near("wasteful", || Ok(vec![Arc::new(SabotagedBackend::new(Sabotage::WholeUpload))]))];

const EAGER: &[Entry] =
    &[Entry::near("eager", || Ok(vec![Arc::new(SabotagedBackend::new(Sabotage::Eager))]))];

const LAZY: &[Entry] = &[Entry::near("lazy", || Ok(vec![Arc::new(SabotagedBackend::new(Sabotage::Lazy))]))];

const MISSING: &[Entry] = &[
    Entry::near("absent", || Err(BackendError::NoDevice { wanted: "absent".into(), found: Vec::new() })),
    Entry::near("empty", || Ok(Vec::new())),
];

/// Runs the trials with `filter` in their names; gives back whether all passed, and what was printed.
fn run_trials(filter: &str, registry: &[Entry], required: &str) -> (bool, String) {
    static RUNS: AtomicU32 = AtomicU32::new(0);
    let number = RUNS.fetch_add(1, Ordering::Relaxed);
    let log = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("suite-{}-{number}", std::process::id()));
    let code = run(["suite", "--logfile", log.to_str().unwrap(), filter], registry, required);
    let printed = std::fs::read_to_string(&log).unwrap();
    std::fs::remove_file(log).unwrap();
    (format!("{code:?}") == format!("{:?}", ExitCode::SUCCESS), printed)
}

/// The names of the trials with `filter` in their names that fail.
fn failures(filter: &str, registry: &[Entry], required: &str) -> Vec<String> {
    let (passed, printed) = run_trials(filter, registry, required);
    let failed = printed.lines().filter_map(|line| line.strip_prefix("test ")?.strip_suffix(" ... FAILED"));
    let failed: Vec<_> = failed.map(|name| name.trim_end().to_owned()).collect();
    assert_eq!(passed, failed.is_empty(), "{printed}");
    failed
}

#[test]
fn a_broken_backend_fails_the_run() {
    let failed = failures("rings-193::upright", BROKEN, "");
    assert_eq!(failed, ["rings-193::upright::Zeros"]);
}

#[test]
fn a_backend_whose_clock_stands_still_fails_by_name() {
    assert_eq!(failures("every-stage", STOPPED, ""), ["session::every-stage-is-timed::StoppedClock"]);
}

#[test]
fn a_backend_that_sends_the_whole_fabric_again_fails_by_name() {
    assert_eq!(failures("an-edit", WASTEFUL, ""), ["session::an-edit-moves-one-yarn::WholeUpload"]);
}

#[test]
fn a_missing_backend_is_ignored_unless_it_is_required() {
    let failures = |required| failures("missing", MISSING, required);
    assert_eq!(failures(""), [""; 0]);
    assert_eq!(failures("absent"), ["absent::missing"]);
    assert_eq!(failures("cpu, empty"), ["empty::missing", "cpu::missing"]);
    assert_eq!(failures("unheard-of"), ["unheard-of::missing"]);
}

#[test]
fn a_backend_taken_out_of_the_registry_fails_by_name_where_it_is_required() {
    // Which devices there are here does not matter.
    let open: OpenAll = || Ok(vec![Arc::new(SerialBackend::new())]);
    let registry: Vec<_> = REGISTRY.iter().map(|entry| Entry { open, ..*entry }).collect();
    let required = registry.iter().map(|entry| entry.name).collect::<Vec<_>>().join(",");
    assert_eq!(failures("missing", &registry, &required), [""; 0]);
    for gone in 0..registry.len() {
        let mut rest = registry.clone();
        let gone = rest.remove(gone).name;
        assert_eq!(failures("missing", &rest, &required), [format!("{gone}::missing")]);
        assert_eq!(failures("missing", &rest, ""), [""; 0]);
    }
}

/// A schedule that leaves something out is held to leaving out just that.
#[test]
fn a_backend_that_refuses_too_little_or_too_much_fails() {
    let failures = |name: &str, registry: &[Entry]| failures(&format!("{name}::upright::"), registry, "");
    // `SabotagedBackend` does everything, whatever its schedule is called.
    assert_eq!(failures("helix", EAGER), ["helix::upright::Eager"]);
    assert_eq!(failures("paper-rings-65", EAGER), [""; 0]);
    assert_eq!(failures("helix", LAZY), [""; 0]);
    assert_eq!(failures("paper-rings-65", LAZY), ["paper-rings-65::upright::Lazy"]);
}
