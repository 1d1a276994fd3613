//! The suite's own proof: each broken backend is caught, by the name of its fault and no other.

use std::process::{Command, ExitCode};
use std::sync::Arc;

use texere_conformance::compare::{Fault, Report};
use texere_conformance::{Entry, Sabotage, SabotagedBackend, check, run};
use texere_core::{BackendError, ControlPoint, Frame, Settings, Yarn, Yarns};

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

const MISSING: &[Entry] = &[
    Entry::near("absent", || Err(BackendError::NoDevice { wanted: "absent".into(), found: Vec::new() })),
    Entry::near("empty", || Ok(Vec::new())),
];

/// Whether a run of the trials with `filter` in their names passes.
fn passes(filter: &str, registry: &[Entry]) -> bool {
    let code = run(["suite", "--quiet", filter], registry);
    format!("{code:?}") == format!("{:?}", ExitCode::SUCCESS)
}

/// Whether one of the tests below passes in a process of its own, which keeps its output to itself and has
/// `TEXERE_REQUIRE` set to `required`.
fn passes_alone(test: &str, required: &str) -> bool {
    let mut program = Command::new(std::env::current_exe().unwrap());
    program.args(["--exact", test, "--ignored"]).env("TEXERE_REQUIRE", required);
    let output = program.output().unwrap();
    let ran = String::from_utf8_lossy(&output.stdout).contains("running 1 test");
    assert!(ran, "there is no {test}");
    output.status.success()
}

#[test]
#[ignore = "started by another test"]
fn run_a_broken_backend() {
    assert!(passes("rings-193::upright", BROKEN));
}

#[test]
#[ignore = "started by another test"]
fn run_without_backends() {
    assert!(passes("missing", MISSING));
}

#[test]
fn a_broken_backend_fails_the_run() {
    assert!(!passes_alone("run_a_broken_backend", ""));
}

#[test]
fn a_missing_backend_is_ignored_unless_it_is_required() {
    let passes = |required| passes_alone("run_without_backends", required);
    assert!(passes(""));
    assert!(!passes("absent"));
    assert!(!passes("cpu, empty"));
    assert!(!passes("unheard-of"));
}
