//! `texere test`

use serde_json::Value;

use crate::{design, stdout, texere};

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

#[test]
fn a_knit_is_strained_both_ways() {
    let folder = tempfile::tempdir().unwrap();
    let table = folder.path().join("jersey.csv");
    let jersey = design("jersey.toml");
    let plot = folder.path().join("jersey.svg");
    let asked = ["test", &jersey, "--to", "0.2", "--states", "4"];
    let files = ["-o", table.to_str().unwrap(), "--plot", plot.to_str().unwrap()];
    let output = texere(&[&asked[..], &["--json"], &files].concat());
    let report: Value = serde_json::from_str(&stdout(&output)).unwrap();
    let tests = report["tests"].as_array().unwrap();
    let ways: Vec<_> = tests.iter().map(|test| test["along"].as_str().unwrap()).collect();
    assert_eq!((report["device"].as_str(), &ways[..]), (Some("cpu"), &["courses", "wales"][..]));
    for (test, way) in tests.iter().zip(ways) {
        let states = test["states"].as_array().unwrap();
        assert_eq!(states.len(), 5);
        let of = |key: &str| -> Vec<f64> {
            states.iter().map(|state| number(&state[&format!("{key}_{way}")])).collect()
        };
        let strains: Vec<String> = of("strain").iter().map(|strain| format!("{strain:.3}")).collect();
        assert_eq!(strains, ["0.000", "0.050", "0.100", "0.150", "0.200"]);
        let forces: Vec<f64> =
            states.iter().map(|state| number(&state[&format!("force_{way}_n_per_mm")])).collect();
        assert!(forces.is_sorted(), "{forces:?}");
        assert!((0.2..0.8).contains(&number(&test["poisson"])), "{test}");
        assert!(number(&test["moduli"][0]["n_per_mm"]) > 0.0);
    }
    let table = std::fs::read_to_string(table).unwrap();
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.len(), 11);
    assert!(rows.iter().all(|row| row.len() == 8));
    let written: f64 = rows[7][2].parse().unwrap();
    assert!((written - number(&tests[1]["states"][1]["strain_wales"])).abs() < 1e-12);
    let plot = std::fs::read_to_string(plot).unwrap();
    assert_eq!((plot.matches("<polyline").count(), plot.matches("<circle").count()), (2, 10), "{plot}");
    let text = stdout(&texere(&asked));
    assert!(text.starts_with("Plain jersey\nalong the courses, from 12."), "{text}");
    assert!(text.contains("Poisson's ratio at rest") && !text.contains("balance"), "{text}");
}

#[test]
fn what_is_no_knit_is_refused() {
    let output = texere(&["test", &design("plain.toml")]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{said}");
    assert!(said.contains("rest by energy is for knits that repeat: this one is woven"), "{said}");
    for wrong in [["--to", "0"], ["--to", "nan"], ["--along", "bias"], ["--states", "0"]] {
        let output = texere(&["test", &design("jersey.toml"), wrong[0], wrong[1]]);
        assert_eq!(output.status.code(), Some(2), "{wrong:?}");
    }
}
