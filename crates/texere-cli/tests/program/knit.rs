//! Knits: their reports, and the stitch of the yarn under a point.

use serde_json::Value;
use tempfile::TempDir;

use crate::{design, inspect, stderr, stdout, texere};

#[test]
fn our_own_knits_settle_and_are_clean() {
    let plain = ["jersey", "rib", "interlock", "garter", "milano", "cable", "lace", "tuck", "miss"];
    for name in plain.into_iter().chain(["jacquard", "double-jacquard"]) {
        let (status, report) = checked(name);
        assert_eq!(status, Some(0), "{name}: {report}");
    }
}

/// Exit code and JSON of a design's check. Asserts that it is knitted without fault, at rest, and
/// linked as before.
fn checked(name: &str) -> (Option<i32>, Value) {
    let output = texere(&["check", "--json", &design(&format!("{name}.toml"))]);
    let report: Value = serde_json::from_str(&stdout(&output)).unwrap();
    let settling = &report["settling"];
    assert_eq!((&settling["at_rest"], &settling["linked"]), (&true.into(), &true.into()), "{name}");
    assert_eq!(report["machine"]["errors"], Value::Array(vec![]), "{name}");
    (output.status.code(), report)
}

#[test]
fn loops_courses_and_wales_are_counted() {
    let report = inspect(&["--counts", &design("lace.toml")]);
    assert_eq!(
        (&report["loops"], &report["courses"], &report["wales"]),
        (&576.into(), &24.into(), &24.into())
    );
    assert!(report["measures"].is_null());
    let report = inspect(&[&design("jersey.toml")]);
    let knit = &report["measures"]["knit"];
    let number = |key: &str| knit[key].as_f64().unwrap();
    // The design asks for 3.2 mm, of 20 tex.
    assert!((number("loop_length_mm") / 3.2 - 1.0).abs() < 0.03, "{knit}");
    assert!((number("tightness") * number("loop_length_mm") / 10.0 / 20f64.sqrt() - 1.0).abs() < 1e-6);
    assert!(report["ends"].is_null() && report["measures"]["crimp"].is_null());
    let text = stdout(&texere(&["inspect", "--counts", &design("jersey.toml")]));
    assert!(text.contains("576 in 24 courses of 24 wales"), "{text}");
}

/// Each cell, knit or float, has twelve control points, so 400 wales have the paper's 4,800.
#[test]
fn the_papers_knit_has_the_papers_size() {
    let report = inspect(&["--counts", &design("paper/figure-7b.toml")]);
    assert_eq!((&report["yarns"], &report["control_points"]), (&2880.into(), &13_824_000.into()));
    assert_eq!(report["triangles"], 331_706_880u64);
}

#[test]
fn the_instruction_under_a_point_is_named() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("a.k");
    let courses: String = (0..4)
        .map(|course| {
            let knit =
                |needle: i32| format!("knit {} f{needle} 1\n", if course % 2 == 0 { '+' } else { '-' });
            let needles = 0..6;
            if course % 2 == 0 {
                needles.map(knit).collect::<String>()
            } else {
                needles.rev().map(knit).collect()
            }
        })
        .collect();
    std::fs::write(&path, format!(";!knitout-2\n;;Carriers: 1\n;;Gauge: 25.4\nin 1\n{courses}")).unwrap();
    // The point lies on needle 2 of the second course. Needles are 1 mm apart, so the legs of its
    // loop lie at both sides of x = 2.5 mm.
    let path = path.to_str().unwrap();
    let report = inspect(&["--no-settle", "--at", "2.25,1.4", path]);
    let at = report["at"].as_array().unwrap();
    assert!(!at.is_empty(), "{report}");
    for under in at {
        let place = under["place"].as_str().unwrap();
        let line: usize = place.rsplit_once("a.k, line ").unwrap().1.parse().unwrap();
        // Lines 5 to 28 knit; only needles 1 to 3 reach there.
        assert!((5..29).contains(&line), "{under}");
        let instruction = under["instructions"][0].as_str().unwrap();
        assert!(["f1", "f2", "f3"].iter().any(|needle| instruction.contains(needle)), "{under}");
    }
    let heights: Vec<_> = at.iter().map(|under| under["z_mm"].as_f64().unwrap()).collect();
    assert!(heights.is_sorted_by(|above, below| above >= below), "{heights:?}");
    let nowhere = inspect(&["--no-settle", "--at=-50,-50", path]);
    assert_eq!(nowhere["at"], Value::Array(vec![]));
    // Woven yarns have names as well.
    let woven = inspect(&["--at", "6,6", &design("plain.toml")]);
    for under in woven["at"].as_array().unwrap() {
        let yarn = under["yarn"].as_str().unwrap();
        assert!(yarn.starts_with("end ") || yarn.starts_with("pick "), "{under}");
    }
}

#[test]
fn what_a_machine_could_not_do_fails_the_check() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("a.k");
    let text = ";!knitout-2\n;;Carriers: 1 2\ninhook 1\ninhook 2\nknit + f1 1\nknit + f2 1\nknit - f2 1\nknit - f1 1\nouthook 1\n";
    std::fs::write(&path, text).unwrap();
    let output = texere(&["check", path.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(4));
    let said = stdout(&output);
    assert!(said.contains("line 4: the hook takes carrier 2, but still holds carrier 1"), "{said}");
    assert!(!said.contains("cure"), "{said}");
    assert!(stderr(&output).contains("can't be knitted"), "{}", stderr(&output));
    std::fs::write(&path, text.replace("knit - f2 1", "knit - g2 1")).unwrap();
    let output = texere(&["check", path.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(3));
    assert!(stderr(&output).contains("line 7, column 8: \"g2\", expected a needle"), "{}", stderr(&output));
}
