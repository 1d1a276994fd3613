//! The report of `texere inspect`.

use serde_json::Value;

use crate::{design, inspect, stdout, texere};

/// 30 ends 0.8 mm apart, 24 picks 1 mm apart, three yarns of two colours, and a weft that turns
/// round at the edges. The cloth is as it is woven.
const CLOTH: &str = "[weave]\nnotation = \"2/2\"\nends = 30\npicks = 24\n[finish]\nsettle = false\n[cloth]\nselvedge = true\n\
    [yarns.red]\ntex = 40.0\ncolor = \"#c81020\"\n[yarns.rust]\ntex = 50.0\ncolor = \"#C81020\"\n\
    [yarns.ecru]\ntex = 60.0\ncolor = \"#e9dfc7\"\n[warp]\nyarns = [\"2 red\", \"rust\"]\nspacing_mm = 0.8\n\
    [weft]\nyarns = [\"ecru\"]\nspacing_mm = 1\n";

fn cloth() -> Value {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("cloth.toml");
    std::fs::write(&path, CLOTH).unwrap();
    inspect(&[path.to_str().unwrap()])
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

#[test]
fn measures_add_up() {
    let report = cloth();
    assert!([0, 1].iter().all(|&axis| (number(&report["size_mm"][axis]) - 24.0).abs() < 1e-9));
    let measures = &report["measures"];
    let yarns = measures["yarns"].as_array().unwrap();
    let names: Vec<_> = yarns.iter().map(|yarn| yarn["yarn"].as_str().unwrap()).collect();
    assert_eq!(names, ["ecru", "red", "rust"]);
    let [ecru, red, rust] = [0, 1, 2].map(|yarn| number(&yarns[yarn]["length_mm"]));
    assert!((number(&measures["length_mm"]) - ecru - red - rust).abs() < 1e-6);
    // Two yarns of one colour.
    assert!((number(&measures["colors"]["#c81020"]) - red - rust).abs() < 1e-6);
    assert_eq!(number(&measures["colors"]["#e9dfc7"]), ecru);
    // There are 20 ends of red and 10 of rust, and crimp lengthens all ends equally.
    let crimp = &measures["crimp"];
    assert!(((red + rust) / (30.0 * 24.0) - 1.0 - number(&crimp["warp"])).abs() < 1e-9);
    assert!((ecru / (24.0 * 24.0) - 1.0 - number(&crimp["weft"])).abs() < 1e-9);
    assert!((red / rust - 2.0).abs() < 0.01);
    // g/km on 24 mm by 24 mm.
    let grams = (red * 40.0 + rust * 50.0 + ecru * 60.0) * 1e-6;
    assert!((number(&measures["areal_weight_g_per_m2"]) / (grams / 576e-6) - 1.0).abs() < 1e-6);
    let weights: f64 = yarns.iter().map(|yarn| number(&yarn["weight_g"])).sum();
    assert!((weights / grams - 1.0).abs() < 1e-6);
    // Diameters of cotton of 40, 50 and 60 tex, 1.1 cm³/g, divided by spacings: a section has tex ×
    // 1.1e-3 mm².
    let root = (4.0 * 1.1e-3 / std::f64::consts::PI).sqrt();
    let [warp, weft] = [(2.0 * 40f64.sqrt() + 50f64.sqrt()) / 2.4, 60f64.sqrt()].map(|roots| root * roots);
    let cover = &measures["cover"];
    assert!((number(&cover["fraction"]["warp"]) / warp - 1.0).abs() < 2e-3);
    assert!((number(&cover["fraction"]["weft"]) / weft - 1.0).abs() < 2e-3);
    assert!((number(&cover["cloth"]) / (warp + weft - warp * weft) - 1.0).abs() < 3e-3);
    assert!(number(&cover["factor"]["warp"]) > 0.0 && number(&cover["cloth_factor"]) < 28.0);
    // The cloth is thicker than its thickest thread, by less than two threads.
    assert!((0.29..3.0 * 0.29).contains(&number(&measures["thickness_mm"])));
}

/// Tubes have as many sides as the polygon has corners, in cloth at rest and as it is woven.
/// Another number of sides is refused.
#[test]
fn a_polygon_has_as_many_sides_as_corners() {
    let folder = tempfile::tempdir().unwrap();
    let (path, mesh) = (folder.path().join("cloth.toml"), folder.path().join("cloth.ply"));
    for (corners, count) in
        [("[-1, -1], [1, -1], [0, 1]", 3), ("[1, 0], [0.3, 1], [-0.8, 0.6], [-0.8, -0.6], [0.3, -1]", 5)]
    {
        let section = format!("section = {{ shape = \"polygon\", corners = [{corners}] }}\n");
        std::fs::write(&path, CLOTH.replace("tex = 40.0\n", &format!("tex = 40.0\n{section}"))).unwrap();
        let path = path.to_str().unwrap();
        for settle in ["--settle", "--no-settle"] {
            let counts = inspect(&[path, settle]);
            assert_eq!(number(&counts["vertices"]), f64::from(count) * number(&counts["rings"]), "{settle}");
        }
        let output = texere(&["mesh", path, "--no-settle", "-o", mesh.to_str().unwrap()]);
        assert!(output.status.success() && mesh.exists(), "{output:?}");
        std::fs::remove_file(&mesh).unwrap();
        // A number of sides other than that of the polygon's corners is refused. The refusal comes
        // before that of a cloth that can't come to rest.
        let cloth = std::fs::read_to_string(path).unwrap();
        std::fs::write(path, cloth.replace("settle = false", "stretch_warp = 1.9")).unwrap();
        assert_eq!(texere(&["inspect", path]).status.code(), Some(3));
        for command in [&["inspect", "--counts"][..], &["inspect"], &["mesh", "-o", mesh.to_str().unwrap()]] {
            let output = texere(&[command, &[path, "--sides", "6"]].concat());
            let said = String::from_utf8_lossy(&output.stderr);
            assert_eq!(output.status.code(), Some(2), "{said}");
            assert!(said.contains(&format!("set sides to {count}")) && !mesh.exists(), "{said}");
        }
    }
}

#[test]
fn the_worst_places_have_a_weavers_names() {
    let report = cloth();
    let clearance = &report["clearance"];
    let worst = clearance["worst"].as_array().unwrap();
    assert_eq!(worst[0]["ratio"], clearance["min"]);
    let counts = clearance["histogram"]["counts"].as_array().unwrap();
    assert_eq!(counts.iter().map(|count| count.as_u64().unwrap()).sum::<u64>(), clearance["contacts"]);
    assert!(clearance["below_one"].as_u64() <= clearance["contacts"].as_u64());
    let mut crossings = 0;
    for contact in worst {
        let [x, y] = [0, 1].map(|axis| number(&contact["place_mm"][axis]));
        for (name, crossing) in [0, 1].map(|side| (&contact["yarns"][side], &contact["crossings"][side])) {
            let (Some(end), Some(pick)) = (crossing["end"].as_f64(), crossing["pick"].as_f64()) else {
                continue;
            };
            crossings += 1;
            // The first thread lies half a spacing from the edge, and each other thread one spacing
            // further.
            assert!((x - (end - 0.5) * 0.8).abs() < 0.41 && (y - (pick - 0.5)).abs() < 0.51, "{contact}");
            // The weft is one yarn of many picks.
            assert!(*name == format!("end {end}") || *name == format!("pick {pick}"), "{contact}");
        }
    }
    assert!(crossings > 20, "{clearance}");
    let curvature = &report["curvature"];
    assert!(number(&curvature["min"]) > 1.0 && curvature["place_mm"].is_array(), "{curvature}");
    assert!(
        curvature["yarn"].as_str().is_some_and(|name| name.starts_with("end ") || name.starts_with("pick "))
    );
    // If all threads were alike, √3 diameters would be the least pitch. These ends have thicker
    // picks between them.
    let ends = &report["jam"]["after"]["warp"];
    assert_eq!((ends["jammed"].as_u64(), number(&ends["pitch_mm"])), (Some(0), 0.8));
    assert!((0.4..0.6).contains(&number(&ends["pitch_min_mm"])), "{ends}");
}

/// Ashenhurst: in a twill of four, threads of the other set change sides at every second end. An
/// end therefore takes its own diameter and half a pick's.
#[test]
fn setts_stand_beside_the_greatest_of_the_weave() {
    let report = cloth();
    // Cotton of 40, 50 and 60 tex, 1.1 cm³/g.
    let root = (4.0 * 1.1e-3 / std::f64::consts::PI).sqrt();
    let [end, pick] = [(2.0 * 40f64.sqrt() + 50f64.sqrt()) / 3.0, 60f64.sqrt()].map(|roots| roots * root);
    for (set, per_cm, room_mm) in [("warp", 12.5, end + pick / 2.0), ("weft", 10.0, pick + end / 2.0)] {
        let sett = &report["setts"][set];
        let [found, greatest, share] = ["per_cm", "greatest_per_cm", "share"].map(|key| number(&sett[key]));
        assert!((found - per_cm).abs() < 1e-6 && sett["interlacings"] == 0.5, "{sett}");
        assert!(
            (greatest * room_mm / 10.0 - 1.0).abs() < 2e-3 && (share - found / greatest).abs() < 1e-9,
            "{sett}"
        );
    }
}

#[test]
fn text_says_the_same() {
    let text = stdout(&texere(&["inspect", &design("plain.toml")]));
    for said in ["64 ends by 48 picks", "g/m²", "crimp", "cover", "of touching at the least", "yarn radii"] {
        assert!(text.contains(said), "\"{said}\" is missing from:\n{text}");
    }
}

/// The paper's Jacquard has 10.6 million control points.
#[test]
fn the_papers_jacquard_has_the_papers_size_and_is_clear() {
    let report = inspect(&[&design("paper/figure-7a.toml")]);
    assert_eq!(report["triangles"], 254_474_880u64);
    assert_eq!(report["yarns"], 2880 + 1840);
    assert_eq!(report["warnings"], Value::Array(vec![]));
    assert!(number(&report["clearance"]["min"]) >= 0.985, "{}", report["clearance"]["min"]);
    assert!(number(&report["curvature"]["min"]) > 1.0);
}
