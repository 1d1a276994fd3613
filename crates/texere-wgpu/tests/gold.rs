//! Output of the wgpu backend against the oracle and `cpu-serial`, as a whole and in chunks, for
//! some cases of the conformance suite.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod support;

use texere_conformance::{cases, check};
use texere_core::{Backend, Frame, Limits, Settings, Topology, Yarn};
use texere_wgpu::{Schedule, WgpuBackend};

use support::{INSTALL, backend};

fn assert_matches(backend: &dyn Backend, name: &str, yarns: &texere_core::Yarns, settings: Settings) {
    let report = check(yarns, settings, backend, false).unwrap();
    assert!(report.is_clean(), "{name}: {report}");
}

/// Runs the suite's cases named `PREFIX::FRAME` for each of `prefixes`. Each prefix has two
/// cases, one for each frame.
fn run_cases(prefixes: &[&str]) {
    let chosen = cases::all()
        .into_iter()
        .filter(|case| prefixes.iter().any(|prefix| case.name.split("::").next() == Some(prefix)));
    let mut count = 0;
    for case in chosen {
        assert_matches(backend(), &case.name, &case.yarns(), case.settings);
        count += 1;
    }
    assert_eq!(count, 2 * prefixes.len());
}

#[test]
fn topologies_and_caps() {
    run_cases(&["indexed-capped", "indexed-uncapped", "shared-capped", "unindexed-uncapped"]);
}

#[test]
fn even_and_odd_sides() {
    run_cases(&["sides-3", "sides-5", "sides-12", "sides-63", "sides-64"]);
}

#[test]
fn subdivisions() {
    run_cases(&["subdivisions-0", "subdivisions-1", "subdivisions-8"]);
}

#[test]
fn blocks_that_end_where_yarns_do() {
    run_cases(&["rings-64", "rings-65", "rings-65-closed", "rings-66", "rings-129-closed"]);
}

#[test]
fn ten_thousand_yarns_of_two_points() {
    run_cases(&["many-short"]);
}

#[test]
fn materials_sections_and_twist_mixed() {
    run_cases(&["mixed"]);
}

#[test]
fn one_yarn_of_a_hundred_thousand_rings() {
    for (closed, frame) in [(false, Frame::Upright), (true, Frame::RotationMinimizing)] {
        let yarns = cases::winding(25_000, Yarn { closed, twist: 1.5, ..Yarn::default() });
        let settings = Settings { subdivisions: 3, sides: 4, frame, ..Settings::default() };
        assert_matches(backend(), "long", &yarns, settings);
    }
}

#[test]
fn limits_of_a_few_kilobytes() {
    // Small enough for several chunks, and for chunks that end within a yarn.
    let limits = Limits { binding_bytes: 20_000, blocks: 4, ..Limits::NONE };
    let small = WgpuBackend::open(0, Schedule::PerRing).expect(INSTALL).with_limits(limits);
    assert_eq!(small.info().limits.binding_bytes, 20_000);
    for sides in [6, 7] {
        let yarns = cases::winding(700, Yarn { twist: 0.4, ..Yarn::default() });
        let settings = Settings { sides, caps: true, ..Settings::default() };
        assert_matches(&small, "small", &yarns, settings);
    }
}

#[test]
fn the_schedule_per_yarn_does_what_the_paper_does() {
    let backend = WgpuBackend::open(0, Schedule::PerYarn).expect(INSTALL);
    assert_eq!(
        (backend.info().name.as_str(), backend.info().schedule),
        ("wgpu:0/per-yarn", Schedule::PerYarn)
    );
    for (sides, topology) in [(6, Topology::Indexed), (5, Topology::Indexed), (8, Topology::Shared)] {
        for subdivisions in [0, 1, 4] {
            let settings = Settings { sides, topology, subdivisions, ..Settings::default() };
            assert_matches(&backend, "short", &support::waves(300, 2, Yarn::default()), settings);
            // Some blocks end at a yarn's last ring, and some begin with it.
            for points in [63, 64, 65, 66, 129] {
                assert_matches(&backend, "waves", &support::waves(3, points, Yarn::default()), settings);
            }
        }
    }
}
