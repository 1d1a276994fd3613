//! The suite can fail: each broken backend is caught, by the name of its fault and by no other.

use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use texere_conformance::cases::leaning;
use texere_conformance::compare::{Fault, Report};
use texere_conformance::{Entry, OpenAll, REGISTRY, Sabotage, SabotagedBackend, check, run};
use texere_core::{Backend, BackendError, ControlPoint, Frame, Settings, Yarn, Yarns};
use texere_cpu::SerialBackend;

/// Two yarns of one block each, a yarn of several blocks, and a closed yarn.
fn yarns() -> Yarns {
    let at = |k: u32, y: f32| ControlPoint::new(k as f32, y, (k as f32).sin() * 0.5, 0.25);
    let mut yarns = Yarns::builder();
    for (y, points) in [(0.0, 9), (1.0, 9), (2.0, 90)] {
        let points: Vec<_> = (0..points).map(|k| at(k, y)).collect();
        yarns.yarn(Yarn { twist: 0.5, ..Yarn::default() }, &points);
    }
    let on_circle = |k: u32| (k as f32 * 0.3).sin_cos();
    let circle: Vec<_> =
        (0..20).map(on_circle).map(|(x, y)| ControlPoint::new(x, 10.0 + y, 0.0, 0.1)).collect();
    yarns.yarn(Yarn { twist: 0.5, closed: true, ..Yarn::default() }, &circle);
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
        Fault::Size,
        Fault::Tangent,
        Fault::Roll,
        Fault::Lean,
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
fn a_backend_that_ignores_leans_is_caught() {
    // Half of the yarns stay upright, so that both ways in which a section leans occur.
    let steep: Vec<_> = (0..8).map(|yarn| leaning().layout().is_steep(yarn)).collect();
    assert_eq!(steep, [false, false, false, false, true, true, true, true]);
    for frame in [Frame::Upright, Frame::RotationMinimizing] {
        let settings = Settings { frame, caps: true, ..Settings::default() };
        let report = |sabotage| check(&leaning(), settings, &SabotagedBackend::new(sabotage), false).unwrap();
        let honest = report(Sabotage::None);
        assert!(honest.is_clean(), "{honest}");
        let level = report(Sabotage::LevelOutlines);
        assert_eq!(found(&level), Sabotage::LevelOutlines.faults(), "{level}");
    }
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

/// A backend that promises the bits of the gold reference has to give them.
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
    // One fault against the oracle, and one against the gold reference.
    let [mismatch, _] = report.first() else { panic!("{report}") };
    assert_eq!((mismatch.fault, mismatch.place.yarn), (Fault::Position, 2));
    assert_eq!((mismatch.place.ring, mismatch.place.point), (10, Some(2)));
    assert_ne!(mismatch.expected, mismatch.actual);
    let reason = report.to_string();
    assert!(reason.starts_with("Position at yarn 2, ring 10, point 2: expected "), "{reason}");
    assert!(reason.ends_with("2 mismatches: 2 Position"), "{reason}");
}

const BROKEN: &[Entry] = &[Entry::near("broken", || sabotaged(Sabotage::Zeros))];

const STOPPED: &[Entry] = &[Entry::near("stopped", || sabotaged(Sabotage::StoppedClock))];

const FAST: &[Entry] = &[Entry::near("fast", || sabotaged(Sabotage::FastClock))];

const WASTEFUL: &[Entry] = &[Entry::near("wasteful", || sabotaged(Sabotage::WholeUpload))];

const STALE: &[Entry] = &[Entry::near("stale", || sabotaged(Sabotage::LostEdit))];

const SHIFTED: &[Entry] = &[Entry::near("shifted", || sabotaged(Sabotage::ShiftedPacked))];

const INWARD: &[Entry] = &[Entry::near("inward", || sabotaged(Sabotage::InwardPacked))];

const CRACKED: &[Entry] = &[Entry::near("cracked", || sabotaged(Sabotage::CrackedPacked))];

const EAGER: &[Entry] = &[Entry::near("eager", || sabotaged(Sabotage::Eager))];

const LAZY: &[Entry] = &[Entry::near("lazy", || sabotaged(Sabotage::Lazy))];

fn sabotaged(sabotage: Sabotage) -> Vec<Result<Arc<dyn Backend>, BackendError>> {
    vec![Ok(Arc::new(SabotagedBackend::new(sabotage)))]
}

fn no_device(wanted: &str) -> BackendError {
    BackendError::NoDevice { wanted: wanted.into(), found: Vec::new() }
}

const MISSING: &[Entry] =
    &[Entry::near("absent", || vec![Err(no_device("absent"))]), Entry::near("empty", Vec::new)];

/// Three devices, of which the second does not open.
const GAPPY: &[Entry] = &[Entry::near("gappy", || {
    let mut opened = sabotaged(Sabotage::None);
    opened.push(Err(no_device("the second")));
    opened.extend(sabotaged(Sabotage::Zeros));
    opened
})];

/// Runs the trials with `filter` in their names. Returns whether all passed, and the printed text.
fn run_trials(filter: &str, registry: &[Entry], required: &str) -> (bool, String) {
    static RUNS: AtomicU32 = AtomicU32::new(0);
    let number = RUNS.fetch_add(1, Ordering::Relaxed);
    let log = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("suite-{}-{number}", std::process::id()));
    let code = run(["suite", "--logfile", log.to_str().unwrap(), filter], registry, required);
    let printed = std::fs::read_to_string(&log).unwrap();
    std::fs::remove_file(log).unwrap();
    (format!("{code:?}") == format!("{:?}", ExitCode::SUCCESS), printed)
}

/// The names of the trials that fail among those with `filter` in their names.
fn failures(filter: &str, registry: &[Entry], required: &str) -> Vec<String> {
    let (passed, printed) = run_trials(filter, registry, required);
    let failed = failed(&printed);
    assert_eq!(passed, failed.is_empty(), "{printed}");
    failed
}

/// The names of the failed trials in `printed`.
fn failed(printed: &str) -> Vec<String> {
    let failed = printed.lines().filter_map(|line| line.strip_prefix("test ")?.strip_suffix(" ... FAILED"));
    failed.map(|name| name.trim_end().to_owned()).collect()
}

#[test]
fn a_broken_backend_fails_the_run() {
    let failed = failures("rings-193::upright", BROKEN, "");
    assert_eq!(failed, ["rings-193::upright::Zeros"]);
}

/// Asserts that only `trial` fails among the trials with `filter` in their names, with a reason
/// that begins with `why`.
fn assert_fails(filter: &str, registry: &[Entry], trial: &str, why: &str) {
    let (_, printed) = run_trials(filter, registry, "");
    assert_eq!(failed(&printed), [trial]);
    let reason = printed.split_once(&format!("---- {trial} ----\n")).map(|(_, reason)| reason.trim_start());
    assert!(reason.is_some_and(|reason| reason.starts_with(why)), "{printed}");
}

#[test]
fn a_clock_that_stands_still_or_runs_fast_is_reported() {
    let timed = |registry, device, why| {
        assert_fails("every-stage", registry, &format!("session::every-stage-is-timed::{device}"), why);
    };
    timed(STOPPED, "StoppedClock", "mesh took no time: ");
    timed(FAST, "FastClock", "more time than there was, ");
}

#[test]
fn an_edit_that_moves_too_much_or_nothing_is_reported() {
    let edited = |registry, device, why| {
        assert_fails("an-edit", registry, &format!("session::an-edit-moves-one-yarn::{device}"), why);
    };
    edited(WASTEFUL, "WholeUpload", "the edited yarn: ");
    edited(STALE, "LostEdit", "a new session makes another mesh of the edited cloth");
}

#[test]
fn packed_vertices_that_lie_elsewhere_or_crack_are_reported() {
    let packed = |registry, device, why| {
        assert_fails(
            "packed-vertices",
            registry,
            &format!("session::packed-vertices-are-the-meshs::{device}"),
            why,
        );
    };
    packed(SHIFTED, "ShiftedPacked", "MeshPlace { yarn: 0, ring: 75, side: 4, cap: None } lies at ");
    packed(INWARD, "InwardPacked", "MeshPlace { yarn: 0, ring: 75, side: 4, cap: None } points to ");
    packed(CRACKED, "CrackedPacked", "MeshPlace { yarn: 0, ring: 64, side: 5, cap: None } is ");
    assert_eq!(
        failures("packed-vertices", &[Entry::near("honest", || sabotaged(Sabotage::None))], ""),
        [""; 0]
    );
}

#[test]
fn a_missing_backend_is_ignored_unless_it_is_required() {
    let failures = |required| failures("missing", MISSING, required);
    assert_eq!(failures(""), [""; 0]);
    assert_eq!(failures("absent"), ["absent::missing"]);
    assert_eq!(failures("cpu, empty"), ["empty::missing", "cpu::missing"]);
    assert_eq!(failures("unheard-of"), ["unheard-of::missing"]);
}

/// A device that does not open does not hide the others, and the others do not hide it.
#[test]
fn a_device_that_does_not_open_is_missing_alone() {
    assert_fails("rings-193::upright", GAPPY, "rings-193::upright::Zeros", "");
    let (_, printed) = run_trials("rings-193::upright", GAPPY, "gappy");
    assert!(printed.contains("rings-193::upright::None"), "{printed}");
    let (passed, printed) = run_trials("missing", GAPPY, "");
    assert!(passed, "{printed}");
    let (_, printed) = run_trials("missing", GAPPY, "gappy");
    assert_eq!(failed(&printed), ["gappy::missing"]);
    assert!(printed.contains("device 2 of 3: ") && printed.contains("the second"), "{printed}");
}

#[test]
fn a_backend_taken_out_of_the_registry_fails_by_name_where_it_is_required() {
    // The devices of this machine do not matter.
    let open: OpenAll = || vec![Ok(Arc::new(SerialBackend::new()))];
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

/// A backend has to refuse exactly the cases that its schedule leaves out.
#[test]
fn a_backend_that_refuses_too_little_or_too_much_fails() {
    let failures = |name: &str, registry: &[Entry]| failures(&format!("{name}::upright::"), registry, "");
    // `SabotagedBackend` does everything, under any name of a schedule.
    assert_eq!(failures("helix", EAGER), ["helix::upright::Eager"]);
    assert_eq!(failures("paper-rings-65", EAGER), [""; 0]);
    assert_eq!(failures("helix", LAZY), [""; 0]);
    assert_eq!(failures("paper-rings-65", LAZY), ["paper-rings-65::upright::Lazy"]);
}
