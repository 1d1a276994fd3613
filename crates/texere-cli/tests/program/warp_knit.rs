//! Warp knits: the report of their bars, and the lap of the yarn under a point.

use serde_json::Value;
use tempfile::TempDir;

use crate::draft::png_size;
use crate::{design, inspect, stdout, texere};

const PLAIN: [&str; 9] = [
    "tricot",
    "locknit",
    "reverse-locknit",
    "warp-satin",
    "sharkskin",
    "queenscord",
    "atlas",
    "net",
    "tulle",
];

#[test]
fn our_own_warp_knits_settle_and_are_clean() {
    for name in PLAIN.into_iter().chain(["warp-jacquard"]) {
        let output = texere(&["check", "--json", &design(&format!("{name}.toml"))]);
        let report: Value = serde_json::from_str(&stdout(&output)).unwrap();
        assert_eq!(output.status.code(), Some(0), "{name}: {report}");
        let settling = &report["settling"];
        assert_eq!((&settling["at_rest"], &settling["linked"]), (&true.into(), &true.into()), "{name}");
    }
}

#[test]
fn bars_are_told_and_the_guide_under_a_point_is_named() {
    let report = inspect(&["--no-settle", "--at", "5.25,5.1", &design("locknit.toml")]);
    let lappings: Vec<_> = report["bars"].as_array().unwrap().iter().map(|bar| &bar["lapping"]).collect();
    assert_eq!(lappings, ["1-0/2-3//", "1-2/1-0//"]);
    // Two bars of 18 guides make 24 courses.
    assert_eq!((&report["loops"], &report["yarns"]), (&(2 * 18 * 24).into(), &36.into()));
    // The point lies on the left leg of the loops on needle 5, counted from 0. It lies in course 7,
    // which begins at 6 x 0.75 = 4.5 mm. In odd courses the front bar laps 1-0, so its guide 5,
    // counted from 0, is on that needle. The back bar laps 1-2, so its guide 4 is there, too.
    let at = report["at"].as_array().unwrap();
    let told: Vec<_> = at.iter().map(|under| (&under["yarn"], &under["place"])).collect();
    let [front, back, course] = ["guide bar 1, guide 6", "guide bar 2, guide 5", "course 7"].map(Value::from);
    assert_eq!(told, [(&front, &course), (&back, &course)]);
}

/// The number of facets is within 1 % of the paper's 381.71 million.
#[test]
fn the_papers_warp_knit_has_the_papers_size() {
    let report = inspect(&["--counts", &design("paper/figure-7c.toml")]);
    assert_eq!(report["yarns"], 2520);
    let facets = report["triangles"].as_f64().unwrap();
    assert!((facets / 381.71e6 - 1.0).abs() < 0.01, "{facets}");
}

#[test]
fn what_has_no_room_is_jammed_and_what_misses_its_run_in_is_warned_of() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("dense.toml");
    let text = "[warp_knit]\nwales = 4\ncourses = 4\nwales_per_cm = 10.0\ncourses_per_cm = 13.333\n\
         [[warp_knit.bars]]\nlapping = \"1-0/2-3//\"\nrun_in_mm = 1000\n[[warp_knit.bars]]\nlapping = \"1-2/1-0//\"\n\
         [yarns.white]\ndiameter_mm = 0.25\n";
    std::fs::write(&path, text).unwrap();
    let said = stdout(&texere(&["inspect", path.to_str().unwrap()]));
    assert!(said.contains("jammed, not at rest after ") && said.contains("clearance 0."), "{said}");
    assert!(said.contains("bar 1 takes ") && said.contains(" off the 1000 mm asked for"), "{said}");
    let output = texere(&["check", path.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(4));
}

#[test]
fn a_lapping_diagram_is_drawn() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("locknit.png");
    let output = texere(&["draft", &design("locknit.toml"), "-o", path.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(0));
    assert!(png_size(&path).iter().all(|side| *side > 100));
}
