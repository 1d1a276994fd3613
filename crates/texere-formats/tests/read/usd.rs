//! Curves of USD files: what texere wrote comes back, curves of every basis run where their
//! definition says, and what can't be read is refused with its place.

use texere_core::{ControlPoint, Material, Yarn, Yarns};
use texere_formats::ReadError;
use texere_formats::read::{CurveScale, curves_from};
use texere_formats::write::{self, CurveFormat};

fn read(text: &str) -> Result<Yarns, ReadError> {
    curves_from("cloth.usda", text.as_bytes(), CurveScale::default())
}

/// A stage in mm, z up, with a prim of curves.
fn stage(body: &str) -> String {
    format!(
        "#usda 1.0\n(\n metersPerUnit = 0.001\n upAxis = \"Z\"\n)\ndef BasisCurves \"c\"\n{{\n{body}\n}}\n"
    )
}

fn curve(kind: &str, basis: &str, wrap: &str, points: &[[f32; 3]]) -> String {
    let points: Vec<_> = points.iter().map(|[x, y, z]| format!("({x}, {y}, {z})")).collect();
    stage(&format!(
        "uniform token type = \"{kind}\"\nuniform token basis = \"{basis}\"\nuniform token wrap = \"{wrap}\"\n\
         int[] curveVertexCounts = [{}]\npoint3f[] points = [{}]\nfloat[] widths = [0.5]",
        points.len(),
        points.join(", ")
    ))
}

/// Yarns of three materials, one of them closed, with diameters that change.
fn yarns(tension: f32) -> Yarns {
    let mut yarns = Yarns::builder();
    yarns.tension(tension);
    let point = |at: usize, by: f32| {
        let at = at as f32 + by;
        ControlPoint::new(at, (at * 1.7).sin(), -0.3 * (at * 2.3).cos(), 0.1 + 0.01 * (at * 0.9).sin())
    };
    let colors = [[230, 12, 77], [0, 0, 0], [255, 254, 1]];
    let materials = colors.map(|srgb| {
        yarns.material(Material { name: format!("\"{srgb:?}\" \\ of three"), srgb, ..Material::default() })
    });
    for number in 0..7 {
        let material = materials[number * 2 % 3];
        let points: Vec<_> = (0..number + 3).map(|at| point(at, number as f32 * 0.37)).collect();
        yarns.yarn(Yarn { closed: number == 4, material, ..Yarn::default() }, &points);
    }
    yarns.build().unwrap()
}

#[test]
fn what_was_written_comes_back_to_the_bit() {
    for tension in [0.0, 0.4] {
        let yarns = yarns(tension);
        let mut file = Vec::new();
        write::curves_to(&yarns, CurveFormat::Usda, &mut file).unwrap();
        let again = curves_from("cloth.usd", &file, CurveScale::default()).unwrap();
        assert_eq!(again.points(), yarns.points());
        assert_eq!(again.layout().offsets(), yarns.layout().offsets());
        assert!((again.tension() - tension).abs() < 1e-4, "{}", again.tension());
        for (again, yarn) in again.layout().yarns().iter().zip(yarns.layout().yarns()) {
            assert_eq!(again.closed, yarn.closed);
        }
        let look = |yarns: &Yarns| -> Vec<(String, [u8; 3])> {
            let materials =
                yarns.layout().yarns().iter().map(|yarn| &yarns.materials()[yarn.material as usize]);
            materials.map(|material| (material.name.clone(), material.srgb)).collect()
        };
        assert_eq!(look(&again), look(&yarns));
    }
}

/// The places of a curve by its definition: de Casteljau's for Bézier, Cox and de Boor's for
/// B-splines with whole knots.
fn defined(basis: &str, points: &[[f64; 3]], closed: bool) -> Vec<[f64; 3]> {
    const STEPS: usize = 400;
    let mixed =
        |a: [f64; 3], b: [f64; 3], t: f64| std::array::from_fn(|axis| a[axis] + (b[axis] - a[axis]) * t);
    let count = points.len();
    let (pieces, stride) = match (basis, closed) {
        ("bezier", false) => ((count - 1) / 3, 3),
        ("bezier", true) => (count / 3, 3),
        (_, false) => (count - 3, 1),
        (_, true) => (count, 1),
    };
    let mut places = Vec::new();
    for piece in 0..pieces {
        let own: [[f64; 3]; 4] = std::array::from_fn(|part| points[(piece * stride + part) % count]);
        for step in 0..STEPS {
            let t = step as f64 / STEPS as f64;
            let mut level = own.to_vec();
            for degree in (1..4).rev() {
                level = (0..degree)
                    .map(|at| {
                        // The knots of piece 0 are -2 to 3; the piece itself is from 0 to 1.
                        let share = if basis == "bezier" {
                            t
                        } else {
                            (t + (degree - 1 - at) as f64) / degree as f64
                        };
                        mixed(level[at], level[at + 1], share)
                    })
                    .collect();
            }
            places.push(level[0]);
        }
    }
    places
}

/// The greatest way from a place of the yarn's spline to the nearest of `places`.
fn beside(yarns: &Yarns, places: &[[f64; 3]]) -> f64 {
    let points: Vec<[f64; 3]> = yarns.points().iter().map(|p| [p.x, p.y, p.z].map(f64::from)).collect();
    let closed = yarns.layout().yarns()[0].closed;
    let count = points.len();
    let reflected = |a: [f64; 3], b: [f64; 3]| std::array::from_fn(|axis| 2.0 * a[axis] - b[axis]);
    let mut most = 0.0_f64;
    for interval in 0..count - usize::from(!closed) {
        let (b, c) = (points[interval], points[(interval + 1) % count]);
        let a = if closed || interval > 0 { points[(interval + count - 1) % count] } else { reflected(b, c) };
        let d = if closed || interval + 2 < count { points[(interval + 2) % count] } else { reflected(c, b) };
        for step in 0..20 {
            let t = f64::from(step) / 20.0;
            // Catmull and Rom 1974.
            let place: [f64; 3] = std::array::from_fn(|i| {
                0.5 * (2.0 * b[i]
                    + (c[i] - a[i]) * t
                    + (2.0 * a[i] - 5.0 * b[i] + 4.0 * c[i] - d[i]) * t * t
                    + (3.0 * b[i] - a[i] - 3.0 * c[i] + d[i]) * t * t * t)
            });
            let way = |to: &[f64; 3]| (0..3).map(|i| (to[i] - place[i]).powi(2)).sum::<f64>();
            most = most.max(places.iter().map(way).fold(f64::INFINITY, f64::min).sqrt());
        }
    }
    most
}

const ZIGZAG: [[f32; 3]; 9] = [
    [0.0, 0.0, 0.0],
    [1.0, 2.0, 0.5],
    [2.0, -1.0, 0.5],
    [3.0, 0.5, -0.5],
    [3.5, 1.25, -1.0],
    [5.0, 0.0, 0.0],
    [5.5, -2.0, 0.25],
    [3.0, -4.0, 1.0],
    [1.0, -3.0, 0.0],
];

#[test]
fn curves_of_every_basis_run_where_they_should() {
    for (basis, wrap, count) in [
        ("bezier", "nonperiodic", 7),
        ("bezier", "periodic", 9),
        ("bspline", "nonperiodic", 9),
        ("bspline", "periodic", 8),
    ] {
        let points = &ZIGZAG[..count];
        let yarns = read(&curve("cubic", basis, wrap, points)).unwrap();
        assert_eq!(yarns.layout().yarns()[0].closed, wrap == "periodic");
        let places =
            defined(basis, &points.iter().map(|p| p.map(f64::from)).collect::<Vec<_>>(), wrap == "periodic");
        // A hundredth of the radius, and the way between places of the definition.
        let most = beside(&yarns, &places);
        assert!(most < 0.01 * 0.25 + 0.012, "{basis} {wrap}: {most} with {} points", yarns.points().len());
        // The spline begins and ends where the curve does.
        let start = yarns.points()[0];
        assert!((0..3).all(|i| ([start.x, start.y, start.z][i] - places[0][i] as f32).abs() < 1e-6));
    }
}

#[test]
fn splines_keep_their_points() {
    let places = |yarns: &Yarns| yarns.points().iter().map(|p| [p.x, p.y, p.z]).collect::<Vec<_>>();
    for (kind, wrap, expected, closed) in [
        ("linear", "nonperiodic", &ZIGZAG[..], false),
        ("linear", "pinned", &ZIGZAG[..], false),
        ("linear", "periodic", &ZIGZAG[..], true),
        ("cubic", "nonperiodic", &ZIGZAG[1..8], false),
        ("cubic", "pinned", &ZIGZAG[..], false),
        ("cubic", "periodic", &ZIGZAG[..], true),
    ] {
        let yarns = read(&curve(kind, "catmullRom", wrap, &ZIGZAG)).unwrap();
        assert_eq!(places(&yarns), expected, "{kind} {wrap}");
        assert_eq!(yarns.layout().yarns()[0].closed, closed);
        assert!(yarns.points().iter().all(|point| point.half_width() == 0.25));
    }
    // A pinned B-spline begins at its first vertex and ends at its last one.
    let yarns = read(&curve("cubic", "bspline", "pinned", &ZIGZAG)).unwrap();
    let (first, last) = (yarns.points()[0], yarns.points()[yarns.points().len() - 1]);
    assert!((first.x - 0.0).abs() + (first.y - 0.0).abs() < 1e-6);
    assert!((last.x - 1.0).abs() + (last.y + 3.0).abs() < 1e-6);
}

/// Widths belong to all curves, to each curve, to each vertex, or vary along each curve.
#[test]
fn widths_belong_where_the_file_says() {
    let points = "int[] curveVertexCounts = [4, 5]\nuniform token basis = \"catmullRom\"\npoint3f[] points = [(0,0,0), (1,0,0), \
                  (2,0,0), (3,0,0), (0,5,0), (1,5,0), (2,5,0), (3,5,0), (4,5,0)]";
    for (widths, interpolation, expected) in [
        ("[0.5]", "constant", [0.5, 0.5, 0.5, 0.5, 0.5]),
        ("[0.5, 0.25]", "uniform", [0.5, 0.5, 0.25, 0.25, 0.25]),
        ("[1, 2, 3, 4, 5]", "varying", [1.0, 2.0, 3.0, 4.0, 5.0]),
        ("[9, 1, 2, 9, 9, 3, 4, 5, 9]", "vertex", [1.0, 2.0, 3.0, 4.0, 5.0]),
    ] {
        let body = format!("{points}\nfloat[] widths = {widths} (\n interpolation = \"{interpolation}\"\n)");
        let yarns = read(&stage(&body)).unwrap();
        let found: Vec<_> = yarns.points().iter().map(|point| 2.0 * point.half_width()).collect();
        assert_eq!(found, expected, "{interpolation}");
    }
    let error = read(&stage(&format!("{points}\nfloat[] widths = [1, 2]"))).unwrap_err().to_string();
    assert!(error.ends_with("expected 9 widths (vertex); there are 2"), "{error}");
    // A diameter and a unit beside the file count instead of its own.
    let scale = CurveScale { unit_mm: Some(10.0), diameter_mm: Some(0.5) };
    let yarns = curves_from("c.usda", stage(points).as_bytes(), scale).unwrap();
    assert_eq!((yarns.points()[1].x, yarns.points()[1].half_width()), (20.0, 0.25));
}

/// A straight line stays a line of few points, wherever its handles lie.
#[test]
fn straight_pieces_of_any_length_stay_few() {
    let count = 100;
    let points: Vec<_> =
        (0..=3 * count).map(|at| [(at / 3 + at / 6) as f32 + (at % 3) as f32 * 0.3, 0.0, 0.0]).collect();
    let yarns = read(&curve("cubic", "bezier", "nonperiodic", &points)).unwrap();
    assert!(yarns.points().len() <= 2 * count, "{}", yarns.points().len());
    assert!(yarns.points().iter().all(|point| point.y == 0.0 && point.z == 0.0));
}

#[test]
fn widths_within_a_piece_are_kept() {
    let text = curve(
        "cubic",
        "bezier",
        "nonperiodic",
        &[[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 0.0, 0.0]],
    );
    let yarns = read(&text.replace("[0.5]", "[1, 0.1, 0.1, 1]")).unwrap();
    // Bernstein: 1/8, 3/8, 3/8, 1/8.
    let middle = yarns.points().iter().find(|point| point.x == 1.5).unwrap();
    assert!((2.0 * middle.half_width() - (2.0 * 0.125 + 0.2 * 0.375)).abs() < 1e-3, "{middle:?}");
}

/// Colours may be indexed, and `primvars:widths` goes before `widths`. Prims that no one sees, and
/// what other programs write beside curves, are passed over.
#[test]
fn a_stage_is_read_as_its_program_meant_it() {
    let curve = "int[] curveVertexCounts = [2, 2]\nuniform token type = \"linear\"\npoint3f[] points = [(0,0,0), (1,0,0), (0,1,0), \
                 (1,1,0)]\nfloat[] widths = [1]\n";
    let colors = |yarns: &Yarns| -> Vec<_> {
        yarns.layout().yarns().iter().map(|yarn| yarns.materials()[yarn.material as usize].srgb).collect()
    };
    let red_green = "color3f[] primvars:displayColor = [(1,0,0), (0,1,0)] (interpolation = \"uniform\")\n";
    let yarns = read(&stage(&format!("{curve}{red_green}"))).unwrap();
    assert_eq!(colors(&yarns), [[255, 0, 0], [0, 255, 0]]);
    let yarns =
        read(&stage(&format!("{curve}{red_green}int[] primvars:displayColor:indices = [1, 0]"))).unwrap();
    assert_eq!(colors(&yarns), [[0, 255, 0], [255, 0, 0]]);
    let yarns = read(&stage(&format!("{curve}float[] primvars:widths = [0.5]"))).unwrap();
    assert_eq!(yarns.points()[0].half_width(), 0.25);
    for beside in [
        "float[] primvars:yarn = [0.5, 2]",
        "int primvars:yarn = 3",
        "double3 xformOp:translate; token[] xformOpOrder = [\"xformOp:translate\"]",
        "double xformOp:spin = 1",
        "double3 xformOp:translate.timeSamples = { 1: (0, 0, 0) }",
        "point3f[] points.timeSamples = { 1: [(0, 0, 0)] }",
        "token visibility = \"inherited\"",
        "/*/ one remark */",
    ] {
        assert_eq!(read(&stage(&format!("{curve}{beside}"))).unwrap().points().len(), 4, "{beside}");
    }
    for other in [
        "def Camera \"c\" { double3 xformOp:translate.timeSamples = { 1: (0, 0, 0) }\n token[] xformOpOrder = [\"xformOp:translate\"] }",
        "def BasisCurves \"none\" { }",
        "def BasisCurves \"none\" { token visibility = \"invisible\"\n point3f[] points = [(0, 0, 0)] }",
        "def BasisCurves \"none\" { token purpose = \"guide\"\n point3f[] points = [(0, 0, 0)] }",
        "over BasisCurves \"none\" { point3f[] points.timeSamples = { 1: [(0, 0, 0)] } }",
        "def \"d\" ( payload = None\n variants = { }\n delete references = @a@ ) { }",
    ] {
        assert_eq!(read(&(stage(curve) + other)).unwrap().points().len(), 4, "{other}");
    }
    // A name may have escaped letters.
    let named = stage(curve).replace("\"c\"", "\"c\" ( displayName = \"a\\tb\\x41\\\\ \\\"\" )");
    assert_eq!(read(&named).unwrap().materials()[0].name, "a\tbA\\ \"");
}

/// Whatever a stage holds besides its curves is passed over.
#[test]
fn other_parts_of_a_stage_are_passed_over() {
    let text = "#usda 1.0\n# a remark\n(\n \"about\"\n doc = '''many\n lines \" '''\n customLayerData = { dictionary a = { string[] b = \
                [\"}\", 'it\\'s'] } }\n metersPerUnit = 1\n upAxis = \"Y\"\n)\n/* more\n */ def Scope \"looks\" (\n kind = \"group\"\n prepend \
                apiSchemas = [\"A\", \"B\"];\n)\n{\n def Material \"m\" { token outputs:surface.connect = </looks/m/s.o>\n asset inputs:f = \
                @./a@ }\n}\nover \"gone\" { def BasisCurves \"c\" { } }\ndef \"off\" ( active = false ) { def NurbsCurves \"n\" { } }\ndef Xform \
                \"cloth\"\n{\n reorder properties = [\"a\"]\n def BasisCurves \"c\"\n {\n custom float plain\n float[] widths.timeSamples = { 1: \
                [2], 2: None }\n rel material:binding = [</looks/m>, <../m>]\n int[] curveVertexCounts = [2,]\n uniform token type = \
                \"linear\"\n point3f[] points = [(1, 2, 3), (1e0, 2.5, -.5),]\n float[] widths = [0.002]\n color3f[] \
                primvars:displayColor = None\n }\n // The op comes last.\n double3 xformOp:translate = (0, 0, 1); uniform token[] \
                xformOpOrder = [\"xformOp:translate\"]\n}\n";
    let yarns = read(text).unwrap();
    let found: Vec<_> = yarns.points().iter().map(|p| [p.x, p.y, p.z, p.half_width()]).collect();
    // Metres, with y up.
    assert_eq!(found, [[1000.0, -4000.0, 2000.0, 1.0], [1000.0, -500.0, 2500.0, 1.0]]);
    assert_eq!(yarns.materials()[0].name, "c");
}

#[test]
fn what_can_not_be_read_is_refused_with_its_place() {
    let curve = "int[] curveVertexCounts = [2]\nuniform token type = \"linear\"\npoint3f[] points = [(0,0,0), (1,0,0)]\n";
    let whole = stage(&format!("{curve}float[] widths = [1]"));
    read(&whole).unwrap();
    for (from, to, expected) in [
        (
            "float[] widths = [1]",
            "float[] widths = [1, 1] (interpolation = \"constant\")",
            "expected 1 widths (constant); there are 2",
        ),
        (
            "float[] widths = [1]",
            "float[] widths = [1, 1] (interpolation = \"each\")",
            "\"each\", expected constant, uniform",
        ),
        ("#usda", "#sdf", "byte 0: the sign is #sdf 1.0"),
        ("1.0\n", "2.0\n", "line 1, column 7: \"2.0\", expected version 1"),
        ("\"Z\"", "\"W\"", "line 4, column 11: \"W\", expected X, Y or Z"),
        ("0.001", "far", "line 3, column 18: \"far\", expected a number"),
        ("upAxis = \"Z\"", "subLayers = [@a.usda@]", "\"subLayers\", expected a stage without this"),
        ("\"c\"", "\"c\" ( prepend references = @a@</b> )", "\"references\", expected a stage without this"),
        (
            "[2]",
            "[3]",
            "line 6, column 5: \"BasisCurves\", expected 3 points, as curveVertexCounts says; there are 2",
        ),
        ("[2]", "[1, 1]", "expected curves of another number of points: one has 1"),
        ("[2]", "[-2]", "line 8, column 28: \"-2\", expected a whole number"),
        ("linear", "flat", "line 9, column 22: \"flat\", expected cubic or linear"),
        ("(1,0,0)]", "(1,0)]", "line 10, column 34: \")\", expected \",\""),
        ("(1,0,0)", "(1,0,nan)", "\"nan\", expected a number"),
        ("widths = [1]", "widths = []", "expected curves with widths, or a diameter beside the file"),
        ("widths = [1]", "widths = [1", "line 12, column 1: \"}\", expected \"]\""),
        ("\n}\n", "\n", "the line ends, expected the bracket that ends a prim"),
        ("BasisCurves", "NurbsCurves", "line 6, column 5: \"NurbsCurves\", expected BasisCurves"),
        ("BasisCurves", "Scope", "a prim of the type BasisCurves is missing or empty"),
        ("points = [", "points.timeSamples = [", "curves that move are not read"),
        ("float[] widths", "variantSet widths", "expected a stage without variants"),
        (
            "float[] widths = [1]",
            "double xformOp:spin = 1; token[] xformOpOrder = [\"xformOp:spin\"]",
            "\"xformOp:spin\", expected an operation that texere knows and that does not move",
        ),
        (
            "float[] widths = [1]",
            "double3 xformOp:scale = (0, 1, 1); token[] xformOpOrder = [\"!invert!xformOp:scale\"]",
            "expected an operation that can be undone",
        ),
        (
            "float[] widths = [1]",
            "float[] widths = [1]; color3f[] primvars:displayColor = [(1, 0, 0)]; int[] primvars:displayColor:indices = [1]",
            "expected colour 1; there are 1",
        ),
        (
            "float[] widths = [1]",
            "float[] widths = [1]; token[] xformOpOrder = [\"a\"]",
            "\"a\", expected an operation of the same prim",
        ),
        ("float[] widths = [1]", "float[] widths = \"1", "expected a text that ends with its quotes"),
    ] {
        assert!(whole.contains(from), "{from}");
        let error = read(&whole.replacen(from, to, 1)).unwrap_err().to_string();
        assert!(error.contains(expected), "{to}: {error}");
    }
    let error = curves_from("c.usdc", b"PXR-USDC\0\x08", CurveScale::default()).unwrap_err().to_string();
    assert!(error.contains("PXR-USDC, expected #usda 1.0: the text form"), "{error}");
    let error = curves_from("c.usda", b"#usda 1.0\n\xff", CurveScale::default()).unwrap_err().to_string();
    assert!(error.contains("byte 10: the text is ff, expected UTF-8"), "{error}");
}

/// Brackets within brackets need no stack.
#[test]
fn a_deep_stage_is_read_or_refused() {
    let deep =
        |before: &str, after: &str| format!("#usda 1.0\n{}{}", before.repeat(200_000), after.repeat(200_000));
    for text in [
        deep("def \"a\" {", "}"),
        deep("def \"a\" {", ""),
        deep("(", ")"),
        stage(&deep("float a = [", "]")[10..]),
    ] {
        let error = read(&text).unwrap_err();
        assert!(matches!(error, ReadError::Word { .. } | ReadError::MissingKey { .. }), "{error}");
    }
}
