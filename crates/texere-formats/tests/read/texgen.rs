//! Yarns of TexGen files.

use texere_core::{Pipeline, Section, Yarns};
use texere_cpu::ParallelBackend;
use texere_formats::ReadError;
use texere_formats::read::{CurveScale, curves_from};

fn read(text: &str) -> Result<Yarns, ReadError> {
    curves_from("cloth.tg3", text.as_bytes(), CurveScale::default())
}

/// A file of TexGen with these yarns.
fn file(yarns: &str) -> String {
    format!(
        "<?xml version=\"1.0\" ?>\n<TexGenModel version=\"3.14.0\">\n<Textile name=\"a\" GeometryScale=\"mm\" type=\"CTextile\" \
         NeedsBuilding=\"0\">\n<Domain type=\"CDomainPlanes\"><Plane Normal=\"1, 0, 0\" d=\"0\" /></Domain>\n{yarns}</Textile>\n\
         </TexGenModel>\n"
    )
}

/// An ellipse for the whole yarn.
const ROUND: &str = "<YarnSection type=\"CYarnSectionConstant\" ConstMesh=\"1\">\n<Section type=\"CSectionEllipse\" Width=\"0.2\" \
                     Height=\"0.2\">\n<SectionMesh type=\"CSectionMeshRectangular\" />\n</Section>\n</YarnSection>\n";

/// A yarn through nodes, with a section.
fn yarn(how: &str, section: &str, nodes: &str) -> String {
    let nodes: String = nodes.split(';').map(|node| format!("<MasterNode {} />\n", node.trim())).collect();
    format!(
        "<Yarn index=\"0\" NumSlaveNodes=\"20\">\n<Interpolation {how} />\n{section}<Repeat value=\"4, 0, 0\" />\n{nodes}</Yarn>\n"
    )
}

/// Nodes at these coordinates.
fn at(places: &[[f64; 3]]) -> String {
    let place = |[x, y, z]: &[f64; 3]| {
        format!("Position=\"{x}, {y}, {z}\" Tangent=\"0, 0, 0\" Up=\"0, 0, 1\" Angle=\"0\"")
    };
    places.iter().map(place).collect::<Vec<_>>().join(";")
}

const STRAIGHT: &str = "Position=\"0, 0, 0\"; Position=\"1, 0, 0\"; Position=\"2, 0, 0\"";

/// Periodic Bézier curves.
const BEZIER: &str = "Periodic=\"1\" type=\"CInterpolationBezier\"";

/// Master nodes, unevenly spaced and out of every plane.
const NODES: [[f64; 3]; 5] =
    [[0.0, 0.0, 0.0], [1.0, 0.0, 0.2], [2.5, 0.0, -0.1], [3.0, 0.4, 0.0], [4.0, 0.0, 0.0]];

/// Where TexGen 3.14 (pytexgen 1.2.1) places a yarn through `NODES` at a quarter, a half and three
/// quarters of each interval, mm. The text before the places says how the yarn is interpolated: the
/// kind, 1 if it is periodic, and 1 if tangents at nodes lie in the plane. A last word names what
/// else is special.
const PATHS: &[(&str, &[[f64; 3]])] = &[
    (
        "Cubic 1 0",
        &[
            [0.232422, -0.042188, 0.055859],
            [0.453125, -0.0375, 0.128125],
            [0.697266, -0.014062, 0.186328],
            [1.380859, -0.014062, 0.149609],
            [1.796875, -0.0375, 0.059375],
            [2.189453, -0.042187, -0.035547],
            [2.689453, 0.104688, -0.108984],
            [2.796875, 0.2375, -0.078125],
            [2.880859, 0.351563, -0.033203],
            [3.197266, 0.351562, 0.003516],
            [3.453125, 0.2375, -0.009375],
            [3.732422, 0.104687, -0.017578],
        ],
    ),
    (
        "Bezier 1 0",
        &[
            [0.248439, -0.027991, 0.047156],
            [0.49703, -0.024881, 0.117535],
            [0.747106, -0.00933, 0.179147],
            [1.379341, -0.013995, 0.151525],
            [1.754455, -0.037321, 0.061018],
            [2.127342, -0.041986, -0.034998],
            [2.636753, 0.080288, -0.09529],
            [2.748227, 0.215811, -0.063294],
            [2.860588, 0.343429, -0.024652],
            [3.258103, 0.347354, 0.005148],
            [3.502946, 0.226277, -0.004183],
            [3.746316, 0.092062, -0.011422],
        ],
    ),
    (
        "Linear 1 0",
        &[
            [0.25, 0.0, 0.05],
            [0.5, 0.0, 0.1],
            [0.75, 0.0, 0.15],
            [1.375, 0.0, 0.125],
            [1.75, 0.0, 0.05],
            [2.125, 0.0, -0.025],
            [2.625, 0.1, -0.075],
            [2.75, 0.2, -0.05],
            [2.875, 0.3, -0.025],
            [3.25, 0.3, 0.0],
            [3.5, 0.2, 0.0],
            [3.75, 0.1, 0.0],
        ],
    ),
    (
        "Bezier 1 1",
        &[
            [0.248439, -0.027991, 0.03125],
            [0.49703, -0.024881, 0.1],
            [0.747106, -0.00933, 0.16875],
            [1.379341, -0.013995, 0.153125],
            [1.754455, -0.037321, 0.05],
            [2.127342, -0.041986, -0.053125],
            [2.636753, 0.080288, -0.084375],
            [2.748227, 0.215811, -0.05],
            [2.860588, 0.343429, -0.015625],
            [3.258103, 0.347354, 0.0],
            [3.502946, 0.226277, 0.0],
            [3.746316, 0.092062, 0.0],
        ],
    ),
    (
        "Cubic 0 0",
        &[
            [0.199777, 0.010045, 0.088504],
            [0.419643, 0.016071, 0.161607],
            [0.679687, 0.014063, 0.203906],
            [1.388393, -0.026116, 0.142076],
            [1.803571, -0.048214, 0.052679],
            [2.191964, -0.046205, -0.038058],
            [2.691964, 0.10067, -0.111496],
            [2.803571, 0.226786, -0.084821],
            [2.888393, 0.339509, -0.040737],
            [3.179688, 0.379688, 0.021094],
            [3.419643, 0.291071, 0.024107],
            [3.699777, 0.15692, 0.015067],
        ],
    ),
    (
        "Bezier 0 0",
        &[
            [0.24911, 0.0, 0.061286],
            [0.497626, 0.0, 0.130095],
            [0.74733, 0.0, 0.183857],
            [1.379341, -0.013995, 0.151525],
            [1.754455, -0.037321, 0.061018],
            [2.127342, -0.041986, -0.034998],
            [2.636753, 0.080288, -0.09529],
            [2.748227, 0.215811, -0.063294],
            [2.860588, 0.343429, -0.024652],
            [3.260497, 0.35625, 0.010075],
            [3.509331, 0.25, 0.008955],
            [3.753499, 0.11875, 0.003358],
        ],
    ),
    (
        "Linear 0 0",
        &[
            [0.25, 0.0, 0.05],
            [0.5, 0.0, 0.1],
            [0.75, 0.0, 0.15],
            [1.375, 0.0, 0.125],
            [1.75, 0.0, 0.05],
            [2.125, 0.0, -0.025],
            [2.625, 0.1, -0.075],
            [2.75, 0.2, -0.05],
            [2.875, 0.3, -0.025],
            [3.25, 0.3, 0.0],
            [3.5, 0.2, 0.0],
            [3.75, 0.1, 0.0],
        ],
    ),
    (
        "Bezier 0 1",
        &[
            [0.24911, 0.0, 0.03125],
            [0.497626, 0.0, 0.1],
            [0.74733, 0.0, 0.16875],
            [1.379341, -0.013995, 0.153125],
            [1.754455, -0.037321, 0.05],
            [2.127342, -0.041986, -0.053125],
            [2.636753, 0.080288, -0.084375],
            [2.748227, 0.215811, -0.05],
            [2.860588, 0.343429, -0.015625],
            [3.260497, 0.35625, 0.0],
            [3.509331, 0.25, 0.0],
            [3.753499, 0.11875, 0.0],
        ],
    ),
    (
        "Bezier 0 0 tangent",
        &[
            [0.296875, -0.047803, 0.059375],
            [0.625, -0.127475, 0.125],
            [0.890625, -0.14341, 0.178125],
            [1.164398, 0.20112, 0.160123],
            [1.563395, 0.153892, 0.068661],
            [2.055694, 0.029719, -0.032132],
            [2.636753, 0.080288, -0.09529],
            [2.748227, 0.215811, -0.063294],
            [2.860588, 0.343429, -0.024652],
            [3.260497, 0.35625, 0.010075],
            [3.509331, 0.25, 0.008955],
            [3.753499, 0.11875, 0.003358],
        ],
    ),
    ("Cubic 1 0 two", &[[0.25, 0.0, 0.05], [0.5, 0.0, 0.1], [0.75, 0.0, 0.15]]),
    (
        "Cubic 1 0 three",
        &[
            [0.273438, 0.0, 0.026562],
            [0.5, 0.0, 0.1],
            [0.726562, 0.0, 0.173438],
            [1.351562, 0.0, 0.148438],
            [1.75, 0.0, 0.05],
            [2.148438, 0.0, -0.048437],
        ],
    ),
];

/// The distance of a place from a spline of texere.
fn distance(yarns: &Yarns, place: [f64; 3]) -> f64 {
    let points: Vec<[f64; 3]> = yarns
        .yarn_points(0)
        .unwrap()
        .iter()
        .map(|point| [point.x, point.y, point.z].map(f64::from))
        .collect();
    let share = f64::from(1.0 - yarns.tension()) / 2.0;
    let last = points.len() - 1;
    let beyond =
        |end: usize, next: usize| std::array::from_fn(|axis| 2.0 * points[end][axis] - points[next][axis]);
    let point = |number: usize| match number {
        0 => beyond(0, 1),
        number if number > last + 1 => beyond(last, last - 1),
        number => points[number - 1],
    };
    let mut least = f64::INFINITY;
    for interval in 0..last {
        let [a, b, c, d]: [[f64; 3]; 4] = std::array::from_fn(|number| point(interval + number));
        for step in 0..=64 {
            let t = f64::from(step) / 64.0;
            let (t2, t3) = (t * t, t * t * t);
            let off = (0..3).map(|axis| {
                let (from, to) = (share * (c[axis] - a[axis]), share * (d[axis] - b[axis]));
                let at = (2.0 * t3 - 3.0 * t2 + 1.0) * b[axis]
                    + (t3 - 2.0 * t2 + t) * from
                    + (3.0 * t2 - 2.0 * t3) * c[axis]
                    + (t3 - t2) * to;
                (at - place[axis]).powi(2)
            });
            least = least.min(off.sum::<f64>().sqrt());
        }
    }
    least
}

#[test]
fn paths_run_where_texgen_has_them() {
    for (name, places) in PATHS {
        let words: Vec<_> = name.split(' ').collect();
        let how = format!(
            "Periodic=\"{}\" ForceInPlaneTangent=\"0\" ForceMasterNodeTangent=\"{}\" type=\"CInterpolation{}\"",
            words[1], words[2], words[0]
        );
        let count = match words.get(3) {
            Some(&"two") => 2,
            Some(&"three") => 3,
            _ => 5,
        };
        let mut nodes = at(&NODES[..count]);
        if words.get(3) == Some(&"tangent") {
            let second = nodes.match_indices("Tangent=\"0, 0, 0\"").nth(1).unwrap().0;
            nodes.replace_range(second..second + 17, "Tangent=\"0, 1, 0\"");
        }
        let yarns = read(&file(&yarn(&how, ROUND, &nodes))).unwrap();
        assert_eq!(places.len(), 3 * (count - 1), "{name}");
        // A hundredth of the radius, or a fifth for straight lines. The steps of the search come on
        // top.
        let most = if words[0] == "Linear" { 0.02 } else { 0.001 };
        for place in *places {
            let off = distance(&yarns, *place);
            assert!(off < most + 4e-3 * 0.02, "{name}: {place:?} is {off} beside the yarn");
        }
        // The yarn is open, and runs through its nodes.
        assert!(!yarns.layout().yarns()[0].closed);
        for node in &NODES[..count] {
            assert!(
                yarns
                    .points()
                    .iter()
                    .any(|point| [point.x, point.y, point.z] == node.map(|axis| axis as f32))
            );
        }
    }
}

/// Sections by the words of TexGen, half the width and half the height of each, and the height of
/// its outermost points, mm.
#[test]
fn sections_are_as_wide_and_as_high_as_texgens() {
    let polygon = "<Section type=\"CSectionPolygon\"><PolygonPoint value=\"0.3, 0.05\" /><PolygonPoint value=\"-0.2, 0.1\" />\
                   <PolygonPoint value=\"-0.2, -0.1\" /></Section>";
    for (section, [width, height], edge) in [
        ("<Section type=\"CSectionEllipse\" Width=\"0.4\" Height=\"0.2\" />", [0.2, 0.1], 0.0),
        (
            "<Section type=\"CSectionLenticular\" Width=\"0.4\" Height=\"0.2\" Distortion=\"0.02\" />",
            [0.2, 0.1],
            0.02,
        ),
        (
            "<Section type=\"CSectionPowerEllipse\" Width=\"0.4\" Height=\"0.2\" Power=\"0.6\" XOffset=\"0\" />",
            [0.2, 0.1],
            0.0,
        ),
        ("<Section type=\"CSectionRectangle\" Width=\"0.5\" Height=\"0.2\" />", [0.25, 0.1], 0.1),
        (polygon, [0.3, 0.1], 0.05),
    ] {
        let section = format!("<YarnSection type=\"CYarnSectionConstant\">{section}</YarnSection>");
        let yarns = read(&file(&yarn(BEZIER, &section, STRAIGHT))).unwrap();
        let [point, ..] = yarns.points() else { panic!("no points") };
        let outline = yarns.layout().sections()[0].outline(256);
        let sides = outline.iter().map(|place| [place.x * point.half_width(), place.y * point.half_height()]);
        let most = |axis: usize| sides.clone().map(|place| place[axis].abs()).fold(0.0, f32::max);
        assert!(
            (most(0) - width).abs() < 2e-4 && (most(1) - height).abs() < 2e-4,
            "{section}: {} {}",
            most(0),
            most(1)
        );
        let outermost = sides.clone().max_by(|a, b| a[0].abs().total_cmp(&b[0].abs())).unwrap()[1].abs();
        assert!((outermost - edge).abs() < 2e-4, "{section}: edges at {outermost}");
    }
}

/// TexGen's section has its x along the tangent times the up direction: towards -y for a yarn along
/// x.
#[test]
fn a_polygon_points_to_the_side_that_texgen_draws_it_on() {
    let section = "<YarnSection type=\"CYarnSectionConstant\"><Section type=\"CSectionPolygon\"><PolygonPoint value=\"0.3, 0.05\" />\
                   <PolygonPoint value=\"-0.2, 0.1\" /><PolygonPoint value=\"-0.2, -0.1\" /></Section></YarnSection>";
    let yarns = read(&file(&yarn(BEZIER, section, STRAIGHT))).unwrap();
    let mesh = Pipeline::new(&yarns).sides(3).mesh(&ParallelBackend::open().unwrap()).unwrap();
    for corner in [[-0.3, 0.05], [0.2, 0.1], [0.2, -0.1]] {
        let is_there = mesh.vertices.iter().any(|vertex| {
            let [_, y, z] = vertex.position;
            (y - corner[0]).abs() < 1e-3 && (z - corner[1]).abs() < 1e-3
        });
        assert!(is_there, "no vertex at {corner:?}");
    }
}

#[test]
fn sections_of_nodes_widen_the_yarn() {
    let node = |width: f64, more: &str| {
        format!(
            "<NodeSection nodeindex=\"0\"><Section type=\"CSectionEllipse\" Width=\"{width}\" Height=\"0.2\" />{more}</NodeSection>"
        )
    };
    let between = "<MidNodeSection nodeindex=\"1\" t=\"0.5\"><Section type=\"CSectionEllipse\" Width=\"1\" Height=\"0.4\" /></MidNodeSection>";
    let sections = [node(0.2, ""), node(0.4, between), node(0.6, "")].concat();
    let section = format!(
        "<YarnSection type=\"CYarnSectionInterpNode\" Ramped=\"0\" Polar=\"0\">{sections}</YarnSection>"
    );
    let yarns = read(&file(&yarn(BEZIER, &section, STRAIGHT))).unwrap();
    let at = |x: f32| {
        let point = yarns.points().iter().find(|point| (point.x - x).abs() < 1e-6).unwrap();
        [point.half_width(), point.half_height()]
    };
    for (x, halves) in [(0.0, [0.1, 0.1]), (1.0, [0.2, 0.1]), (1.5, [0.5, 0.2]), (2.0, [0.3, 0.1])] {
        let found = at(x);
        assert!(found.iter().zip(halves).all(|(found, half)| (found - half).abs() < 2e-4), "{x}: {found:?}");
    }
    assert_eq!(yarns.layout().sections(), [Section::Circle]);
    // If the sections of a yarn have several shapes, each becomes an ellipse of its size.
    let lens = "<Section type=\"CSectionLenticular\" Width=\"0.4\" Height=\"0.2\" Distortion=\"0\" />";
    let mixed =
        section.replacen("<Section type=\"CSectionEllipse\" Width=\"0.4\" Height=\"0.2\" />", lens, 1);
    let mixed = read(&file(&yarn(BEZIER, &mixed, STRAIGHT))).unwrap();
    assert_eq!((mixed.points(), mixed.layout().sections()), (yarns.points(), yarns.layout().sections()));
    // A file has to have a section for each node.
    let text = file(&yarn(BEZIER, &section.replacen(&node(0.2, ""), "", 1), STRAIGHT));
    assert!(
        read(&text).unwrap_err().to_string().contains("as many sections as master nodes; it has 2 and 3")
    );
}

#[test]
fn units_are_those_of_the_file_or_of_the_caller() {
    let text = file(&yarn(BEZIER, ROUND, STRAIGHT));
    let last = |yarns: &Yarns| {
        let point = *yarns.points().last().unwrap();
        [point.x, point.half_width()]
    };
    let close = |found: [f32; 2], [x, radius]: [f32; 2]| {
        assert!((found[0] / x - 1.0).abs() < 1e-6 && (found[1] / radius - 1.0).abs() < 1e-3, "{found:?}");
    };
    close(last(&read(&text).unwrap()), [2.0, 0.1]);
    close(last(&read(&text.replace("GeometryScale=\"mm\"", "GeometryScale=\"cm\"")).unwrap()), [20.0, 1.0]);
    close(last(&read(&text.replace(" GeometryScale=\"mm\"", "")).unwrap()), [2.0, 0.1]);
    let scaled = |scale| last(&curves_from("a.TG3", text.as_bytes(), scale).unwrap());
    close(scaled(CurveScale { unit_mm: Some(25.4), ..CurveScale::default() }), [50.8, 2.54]);
    close(scaled(CurveScale { diameter_mm: Some(0.5), ..CurveScale::default() }), [2.0, 0.25]);
}

#[test]
fn a_ring_is_closed_and_a_height_may_point_anywhere() {
    let ring = at(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.0]]);
    let cubic = "Periodic=\"1\" type=\"CInterpolationCubic\"";
    let yarns = read(&file(&yarn(cubic, ROUND, &ring))).unwrap();
    assert!(yarns.layout().yarns()[0].closed);
    let first = yarns.points()[0];
    assert!(!yarns.points()[1..].iter().any(|point| point.position() == first.position()));
    assert!(yarns.ups().is_none());
    let open = read(&file(&yarn(&cubic.replace('1', "0"), ROUND, &ring))).unwrap();
    assert!(!open.layout().yarns()[0].closed);
    // The up direction turns from z to y, and back.
    let turned =
        "Position=\"0, 0, 0\" Up=\"0, 0, 2\"; Position=\"1, 0, 0\" Up=\"0, 3, 0\"; Position=\"2, 0, 0\"";
    let yarns = read(&file(&yarn(BEZIER, ROUND, turned))).unwrap();
    let ups = yarns.ups().unwrap();
    assert_eq!((ups[0].to_array(), ups.last().unwrap().to_array()), ([0.0, 0.0, 1.0], [0.0, 0.0, 1.0]));
    assert!(ups.iter().any(|up| up.to_array() == [0.0, 1.0, 0.0]));
}

#[test]
fn several_yarns_and_textiles_keep_their_order() {
    let one = |z: f64| yarn(BEZIER, ROUND, &at(&[[0.0, 0.0, z], [1.0, 0.0, z]]));
    let two = file(&(one(1.0) + &one(2.0)));
    let more = file(&one(3.0)).replace("<?xml version=\"1.0\" ?>\n<TexGenModel version=\"3.14.0\">\n", "");
    let text = two.replace("</TexGenModel>\n", &more);
    let yarns = read(&text).unwrap();
    let heights: Vec<_> = (0..3).map(|yarn| yarns.yarn_points(yarn).unwrap()[0].z).collect();
    assert_eq!((heights, yarns.layout().sections().len()), (vec![1.0, 2.0, 3.0], 1));
}

#[test]
fn what_can_not_be_held_is_refused_with_its_place() {
    let whole = file(&yarn(BEZIER, ROUND, STRAIGHT));
    for (from, to, said) in [
        ("<TexGenModel", "<Model", "line 2, column 1: \"Model\", expected TexGenModel"),
        (
            "CInterpolationBezier",
            "CInterpolationAdjusted",
            "line 6, column 35: \"CInterpolationAdjusted\", expected CInterpolationBezier,",
        ),
        (
            "CYarnSectionConstant",
            "CYarnSectionInterpPosition",
            "line 7, column 20: \"CYarnSectionInterpPosition\", expected CYarnSectionConstant or",
        ),
        (
            "CSectionEllipse",
            "CSectionHybrid",
            "line 8, column 16: \"CSectionHybrid\", expected CSectionEllipse, CSectionLenticular",
        ),
        ("Width=\"0.2\"", "Width=\"wide\"", "line 8, column 40: \"wide\", expected a number"),
        ("Width=\"0.2\"", "", "line 8, column 1: \"Section\", expected an element with the attribute Width"),
        (
            "Position=\"1, 0, 0\"",
            "Position=\"1, 0\"",
            "line 14, column 23: \"1, 0\", expected 3 numbers separated by commas",
        ),
        ("Position=\"1, 0, 0\"", "Position=\"1, nan, 0\"", "expected 3 numbers separated by commas"),
        (
            "Position=\"1, 0, 0\"",
            "Position=\"1, 0, 0\" Angle=\"0.5\"",
            "line 14, column 1: \"MasterNode\", expected a node with the Angle 0",
        ),
        (
            "GeometryScale=\"mm\"",
            "GeometryScale=\"ell\"",
            "line 3, column 34: \"ell\", expected mm, cm, m, km, um or nm",
        ),
        (
            "CSectionEllipse\"",
            "CSectionPowerEllipse\" Power=\"5\"",
            "cloth.tg3, line 8: Section is no section",
        ),
        (
            "CSectionEllipse\"",
            "CSectionPowerEllipse\" Power=\"1\" XOffset=\"0.1\"",
            "expected a section with an XOffset of 0",
        ),
        ("</Yarn>", "</Tarn>", "cloth.tg3, line 16: ill-formed document"),
        ("Height=\"0.2\">", "Height=\"-1\">", "cloth.tg3 holds no valid yarns"),
    ] {
        assert!(whole.contains(from), "{from}");
        let error = read(&whole.replacen(from, to, 1)).expect_err(to).to_string();
        assert!(error.contains(said), "\"{error}\" lacks \"{said}\"");
    }
    let said = |text: &str| read(text).unwrap_err().to_string();
    assert!(said("<html></html>").contains("line 1, column 1: \"html\", expected TexGenModel, with which"));
    assert!(said("").contains("the element TexGenModel is missing"));
    assert!(said("<TexGenModel />").contains("the element Textile is missing"));
    let minimal = file("").replace("NeedsBuilding=\"0\"", "NeedsBuilding=\"1\"");
    assert!(
        said(&minimal)
            .contains("line 3, column 1: \"Textile\", expected a textile with yarns: TexGen leaves them out")
    );
    let one = file(&yarn(BEZIER, ROUND, "Position=\"0, 0, 0\""));
    assert!(said(&one).contains("line 5, column 1: \"Yarn\", expected a yarn of two master nodes or more"));
    let bytes = curves_from("a.tg3", b"<TexGenModel a=\"\xff\" />", CurveScale::default()).unwrap_err();
    assert!(bytes.to_string().contains("a.tg3, byte 16: the text is ff"), "{bytes}");
}

#[test]
fn a_file_that_is_cut_off_is_refused_wherever_it_ends() {
    let whole = file(&yarn(BEZIER, ROUND, STRAIGHT));
    let end = whole.trim_end().len();
    for cut in 0..end {
        assert!(read(&whole[..cut]).is_err(), "{cut}");
    }
    assert!(read(&whole[..end]).is_ok());
}

/// Entities are not expanded, and elements that nobody reads may be nested as deeply as they like.
#[test]
fn files_that_would_blow_up_do_not() {
    let whole = file(&yarn(BEZIER, ROUND, STRAIGHT));
    let laughs = "<!DOCTYPE a [<!ENTITY b \"ha\"><!ENTITY c \"&b;&b;&b;&b;&b;&b;&b;&b;\"><!ENTITY d \"&c;&c;&c;&c;&c;&c;&c;&c;\">]>\n<TexGenModel";
    let text = whole.replacen("<TexGenModel", laughs, 1);
    assert_eq!(read(&text).unwrap().points(), read(&whole).unwrap().points());
    let entity = text.replacen("Position=\"1, 0, 0\"", "Position=\"&d;\"", 1);
    assert!(read(&entity).unwrap_err().to_string().contains("\"&d;\", expected 3 numbers"));
    let nested = "<a>".repeat(200_000) + &"</a>".repeat(200_000);
    let text = whole.replacen("<Domain", &(nested + "<Domain"), 1);
    assert_eq!(read(&text).unwrap().points(), read(&whole).unwrap().points());
    let sections = "<Section type=\"CSectionEllipse\" Width=\"1\" Height=\"1\">".repeat(100_000);
    assert!(read(&whole.replacen("<Section ", &(sections + "<Section "), 1)).is_err());
    let attributes: String = (0..100_000).map(|number| format!(" a{number}=\"\"")).collect();
    let text = whole.replacen("<MasterNode", &format!("<MasterNode{attributes}"), 1);
    assert_eq!(read(&text).unwrap().points(), read(&whole).unwrap().points());
}
