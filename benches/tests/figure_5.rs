//! Tests of the paper's figure 5, the times of geometry, buffers and drawing. The tests draw on any
//! Vulkan device, such as lavapipe.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::time::Duration;

use texere::Settings;
use texere_bench::phases::{PhaseTimer, Phases};
use texere_bench::{paper_cloth, tables};

#[test]
fn every_phase_takes_time() {
    let yarns = paper_cloth(20, 16).unwrap().yarns().unwrap();
    let phases = PhaseTimer::open("wgpu:0").unwrap().phases(&yarns, &Settings::default(), [64, 48]).unwrap();
    let Phases { rendering, .. } = phases;
    for (name, time) in Phases::NAMES.into_iter().zip(phases.in_order()) {
        // The time of drawing is not asked to be above zero.
        assert!(time > Duration::ZERO || name == "drawing", "{name}: {phases:?}");
    }
    assert_eq!(phases.in_order()[4], rendering);
}

#[test]
fn a_plot_names_its_phases_and_replaces_no_design() {
    let folder = tempfile::tempdir().unwrap();
    let (design, plot) = (folder.path().join("cloth.toml"), folder.path().join("plot.svg"));
    let text = "[weave]\nnotation = \"plain\"\nends = 8\npicks = 8\n[yarns.a]\ndiameter_mm = 0.3\n[warp]\nyarns = [\"a\"]\n\
                per_cm = 8.0\n[weft]\nyarns = [\"a\"]\nper_cm = 8.0\n";
    std::fs::write(&design, text).unwrap();
    let designs = [design.clone()];
    tables::figure_5(&designs, "wgpu:0", [64, 48], &plot).unwrap();
    let svg = std::fs::read_to_string(&plot).unwrap();
    assert!(svg.ends_with("</svg>\n") && Phases::NAMES.iter().all(|name| svg.contains(name)), "{svg}");

    std::fs::hard_link(&design, folder.path().join("link.svg")).unwrap();
    let error = tables::figure_5(&designs, "wgpu:0", [64, 48], &folder.path().join("link.svg")).unwrap_err();
    assert!(error.to_string().contains("which must stay"), "{error}");
    assert_eq!(std::fs::read_to_string(&design).unwrap(), text);
}
