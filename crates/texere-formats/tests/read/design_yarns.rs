//! Yarns of design files: sections, plies, hairiness, stiffness, firmness and density.

use texere_core::Section;
use texere_formats::ReadError;

use crate::design_file::{DENIM, cloth, read_text, refused};

/// Plies may be pressed into one another.
#[test]
fn a_valley_lies_between_plies() {
    let pressed = Section::Lobed { plies: 2, valley: 0.75 };
    assert!(cloth(&DENIM.replace("plies = 2", "plies = 2\nvalley = 0.75")).sections().contains(&pressed));
    let needs = ["valley", "is given without plies of 2 or more, which it belongs to"];
    refused("plies = 2", "valley = 0.75", &needs);
    refused("plies = 2", "plies = 1\nvalley = 0.75", &needs);
    refused("plies = 2", "plies = 2\nvalley = 0.4", &["yarns.ecru.valley", "is 0.4, outside 0.5 to 1"]);
    refused("plies = 2", "section = { shape = \"circle\" }\nvalley = 0.6", &needs);
    let both = "section = { shape = \"circle\" }\nplies = 2\nvalley = 0.6";
    refused("plies = 2", both, &["give exactly one of section and plies"]);
}

/// Fibres stand off spun staple, which has twist, and not off filament. A design may state the
/// hairiness itself.
#[test]
fn yarns_of_every_structure_have_their_hairiness() {
    let jersey = "[knit]\nchart = \"k\"\nrepeat = [4, 4]\nloop_length_mm = 3.2\n";
    let tricot = "[warp_knit]\nwales = 4\ncourses = 4\nwales_per_cm = 10.0\ncourses_per_cm = 13.0\n\
        [[warp_knit.bars]]\nlapping = \"tricot\"\n";
    let plain = "[weave]\nnotation = \"plain\"\nends = 4\npicks = 4\n[warp]\nyarns = [\"ecru\"]\nper_cm = 12.0\n\
        [weft]\nyarns = [\"ecru\"]\nper_cm = 12.0\n";
    for structure in [jersey, tricot, plain] {
        for (said, hairiness) in [
            ("", 0.0),
            ("twist_per_m = -700.0", 5.0),
            ("hairiness = 8.5", 8.5),
            ("twist_per_m = 9.0\nhairiness = 0", 0.0),
        ] {
            let text = format!("{structure}[yarns.ecru]\ntex = 20.0\n{said}\n");
            let yarns = read_text(&text).unwrap().structure.yarns().unwrap();
            let material = yarns.layout().yarns()[0].material as usize;
            assert_eq!(yarns.materials()[material].hairiness, hairiness, "{text}");
        }
    }
}

/// A yarn has the bending stiffness that the design states. Otherwise the stiffness follows from
/// the yarn's fibre and tex. Cotton, and yarn without tex, have no stiffness of their own.
#[test]
fn yarns_bend_as_their_fibres_do() {
    for (said, bending) in [
        ("tex = 20.0", None),
        ("diameter_mm = 0.2\nfibre = \"wool\"", None),
        ("tex = 20.0\nfibre = \"cotton\"", None),
        ("tex = 20.0\nfibre = \"polyester\"", Some(20.0 * 9.46e-5)),
        ("cotton_count = 29.526\nfibre = \"polyester\"", Some(20.0 * 9.46e-5)),
        ("tex = 20.0\nfibre = \"wool\"\nbending_stiffness = 0.045", Some(0.045)),
        ("diameter_mm = 0.2\nbending_stiffness = 0.045", Some(0.045)),
    ] {
        let text =
            format!("[knit]\nchart = \"k\"\nrepeat = [4, 4]\nloop_length_mm = 3.2\n[yarns.ecru]\n{said}\n");
        let yarns = read_text(&text).unwrap().structure.yarns().unwrap();
        let material = yarns.layout().yarns()[0].material as usize;
        match (yarns.materials()[material].bending, bending) {
            (Some(found), Some(bending)) => assert!((found / bending - 1.0).abs() < 2e-3, "{said}: {found}"),
            (found, bending) => assert_eq!(found, bending, "{said}"),
        }
    }
}

#[test]
fn sections_have_their_numbers() {
    for (text, section) in [
        ("{ shape = \"circle\" }", Section::Circle),
        ("{ shape = \"ellipse\", aspect = 2.0 }", Section::Ellipse { aspect: 2.0 }),
        ("{ shape = \"lenticular\", aspect = 3.0 }", Section::Lenticular { aspect: 3.0, distortion: 0.0 }),
        (
            "{ shape = \"power-ellipse\", aspect = 2.0, exponent = 0.5 }",
            Section::PowerEllipse { aspect: 2.0, exponent: 0.5 },
        ),
        (
            "{ shape = \"polygon\", corners = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]] }",
            Section::Polygon(vec![[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]]),
        ),
    ] {
        let woven = cloth(&DENIM.replace("plies = 2", &format!("section = {text}")));
        assert_eq!(woven.sections()[woven.weft()[0].section as usize], section);
    }
}

/// A polygon whose outline faces nowhere at a corner is refused at its line in the file. The edges
/// at such a corner are too short to have a direction, or they point opposite ways.
#[test]
fn a_polygon_without_a_direction_is_refused() {
    let corners = |corners: &str, parts: &[&str]| {
        let section = format!("section = {{ shape = \"polygon\", corners = {corners} }}");
        refused("plies = 2", &section, &[&["line 12: yarns.ecru.section"], parts].concat());
    };
    corners("[[1e-30, 0.0], [0.0, 1e-30], [-1e-30, 0.0]]", &["corner 1", "too small or too sharp"]);
    corners("[[1.0, 0.0], [1.0, 1e-30], [-1.0, 0.0]]", &["corner", "too small or too sharp"]);
    // A needle-shaped section: after rounding, both edges at its point are equal and opposite.
    corners("[[-1.0, 0.0], [1.0, 1e-45], [-1.0, 3e-45]]", &["corner", "too small or too sharp"]);
    corners("[[1.0, 0.0], [0.0, 1.0, 5.0], [-1.0, 0.0]]", &[]);
    corners("[[1.0, 0.0], [0.0, 1.0]]", &[]);
}

#[test]
fn polygons_that_are_taken_make_a_mesh() {
    for corners in [
        "[[1.0, -0.1], [0.2, 0.9], [-1.0, 0.0]]",
        "[[1e-9, 0.0], [0.0, 1e-9], [-1e-9, 0.0]]",
        "[[1.0, 0.0], [1.0, 1e-6], [-1.0, 0.0]]",
        "[[100.0, 0.0], [0.0, 100.0], [-100.0, -1e-3]]",
    ] {
        let section = format!("section = {{ shape = \"polygon\", corners = {corners} }}");
        let text = DENIM.replace("plies = 2", &section).replace("[\"2 indigo\", \"ecru\"]", "[\"ecru\"]");
        let Ok(design) = read_text(&text) else { continue };
        let yarns = design.yarns().unwrap();
        let mesh = texere_core::Pipeline::new(&yarns).sides(3).caps(true);
        let mesh = mesh.mesh(&texere_cpu::SerialBackend::new()).unwrap();
        let finite = |vertex: &texere_core::Vertex| {
            vertex.position.iter().chain(&vertex.normal).all(|value| value.is_finite())
        };
        assert!(mesh.vertices.iter().all(finite), "{corners}");
    }
}

/// A yarn is as firm as its twist makes it. Filament without twist is soft, but the design has to
/// state the twist of 0. If a design says nothing of twist, the yarn counts as cotton of ordinary
/// twist.
#[test]
fn firmness_follows_twist() {
    let firmness = |lines: &str| {
        let text = DENIM.replace("twist_per_m = -500.0\n", "").replace("tex = 84.0", lines);
        cloth(&text).warp()[0].firmness
    };
    assert_eq!(firmness("tex = 84.0"), 1.0);
    assert_eq!(firmness("tex = 84.0\ntwist_per_m = 0.0"), 0.1);
    assert_eq!(firmness("tex = 84.0\ntwist_per_m = 0.0\nfirmness = 3.0"), 3.0);
    assert_eq!(firmness("tex = 84.0\ntwist_per_m = 9000.0"), 10.0);
    // 500 turns a metre on a radius of 0.1715 mm.
    let tangent =
        0.5 * std::f64::consts::TAU * (4.0 * 84.0 * 1.1 / (1000.0 * std::f64::consts::PI)).sqrt() / 2.0;
    for twist in ["500.0", "-500.0"] {
        let found = f64::from(firmness(&format!("tex = 84.0\ntwist_per_m = {twist}")));
        assert!((found - (tangent / 0.42).powi(2)).abs() < 1e-5, "{twist}: {found}");
    }
}

/// What a yarn can be squeezed to follows from its own density, and from how dense its fibre is.
#[test]
fn a_yarn_keeps_its_own_density_over_that_of_its_packed_fibre() {
    let least = |lines: &str| {
        let text = DENIM.replace("tex = 84.0", lines);
        cloth(&text).warp()[0].least_area
    };
    let off = |lines: &str, expected: f64| {
        let found = f64::from(least(lines));
        assert!((found - expected).abs() < 1e-6, "{lines}: {found}, not {expected}");
    };
    let (peirce, cotton) = (1.0 / 1.1, 1.52);
    off("tex = 84.0", peirce / (0.8 * cotton));
    off("diameter_mm = 0.3", peirce / (0.8 * cotton));
    off("tex = 84.0\ndensity = 0.6", 0.6 / (0.8 * cotton));
    off("tex = 84.0\npacking = 0.9", peirce / (0.9 * cotton));
    // A yarn of wool has as much air in it as one of cotton, unless its density is given.
    off("tex = 84.0\nfibre = \"wool\"", peirce / (0.8 * cotton));
    off("tex = 84.0\nfibre = \"wool\"\ndensity = 0.7", 0.7 / (0.8 * 1.31));
    // Tex and diameter give the density: 84 g a kilometre fill a section of a quarter of pi times
    // 0.16 mm².
    off("tex = 84.0\ndiameter_mm = 0.4", 84.0 / (250.0 * std::f64::consts::PI * 0.16) / (0.8 * cotton));
    // A yarn as dense as its packed fibre can't be squeezed.
    off("tex = 84.0\ndensity = 1.4", 1.0);
    off("tex = 84.0\nleast_area = 0.5", 0.5);
    // Of the same tex, a yarn of a lighter fibre is thicker.
    let radius = |lines: &str| cloth(&DENIM.replace("tex = 84.0", lines)).warp()[0].radius_mm;
    let thicker = radius("tex = 84.0\nfibre = \"nylon\"") / radius("tex = 84.0");
    assert!((thicker.powi(2) - 1.52 / 1.14).abs() < 1e-5, "{thicker}");
}

/// The limit that a refusal names is itself allowed.
#[test]
fn limits_themselves_are_taken() {
    let keys =
        ["stiffness", "bending_stiffness", "firmness", "flatness", "hairiness", "packing", "least_area"];
    let limits = keys.map(|key| {
        let outside = DENIM.replace("tex = 84.0", &format!("tex = 84.0\n{key} = 1e7"));
        let Err(ReadError::OutOfRange { low, high, .. }) = read_text(&outside) else { panic!("{key}") };
        (key, [low, high])
    });
    for (key, ends) in limits {
        for limit in ends {
            let told = read_text(&DENIM.replace("tex = 84.0", &format!("tex = 84.0\n{key} = {limit}")));
            let design = told.unwrap_or_else(|error| panic!("{key} = {limit}: {error}"));
            // What can be read can be written.
            let folder = tempfile::tempdir().unwrap();
            texere_formats::write::toml(&design, folder.path().join("again.toml")).unwrap();
        }
    }
    let cloth = cloth(&DENIM.replace("tex = 84.0", "tex = 84.0\nflatness = 0.1"));
    assert_eq!(cloth.warp()[0].flatness, 0.1);
}
