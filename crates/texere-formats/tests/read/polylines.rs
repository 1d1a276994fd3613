//! Polylines of OBJ files, read as yarns.

use texere_core::{Settings, Yarns};
use texere_formats::ReadError;
use texere_formats::read::{self, CurveScale, curves_from};

const SCALE: CurveScale = CurveScale { unit_mm: Some(1.0), diameter_mm: Some(0.25) };

fn read(text: &str) -> Yarns {
    curves_from("lines.obj", text.as_bytes(), SCALE).unwrap()
}

/// Whether each yarn is closed, and the x of its points.
fn yarns(yarns: &Yarns) -> Vec<(bool, Vec<f32>)> {
    let own = |yarn| yarns.yarn_points(yarn).unwrap().iter().map(|point| point.x).collect();
    yarns.layout().yarns().iter().enumerate().map(|(number, yarn)| (yarn.closed, own(number))).collect()
}

#[test]
fn polylines_are_yarns_and_all_else_is_passed_over() {
    let text = "# texere\r\nmtllib a.mtl\r\nv 0 0 0\r\nv 1 0.5 -2e-1\r\nv 2 0 0 1 0.5 0.5 0.5\r\nvt 0 0\r\n\
                vn 0 0 1\r\nf 1 2 3\r\nl 1/1 2/1 3\r\nv 3 0 0\r\nv 4 0 0 # behind\r\nl -2 -1\r\n";
    let read = read(text);
    assert_eq!(yarns(&read), [(false, vec![0.0, 1.0, 2.0]), (false, vec![3.0, 4.0])]);
    let point = read.points()[1];
    assert_eq!(([point.y, point.z], point.half_width()), ([0.5, -0.2], 0.125));
    assert_eq!(read.layout().offsets(), [0, 3, 5]);
}

/// Some programs write each edge as a polyline of its own.
#[test]
fn edges_end_to_end_are_one_yarn() {
    let vertices: String = (0..6).map(|x| format!("v {x} {} 0\n", x % 2)).collect();
    let of = |lines: &str| yarns(&read(&format!("{vertices}{lines}")));
    assert_eq!(
        of("l 1 2\nl 2 3\nl 4 5\nl 5 6\n"),
        [(false, vec![0.0, 1.0, 2.0]), (false, vec![3.0, 4.0, 5.0])]
    );
    let ring = [(true, vec![0.0, 1.0, 2.0])];
    assert_eq!(of("l 1 2 3 1\n"), ring);
    assert_eq!(of("l 1 2\nl 2 3\nl 3 1\n"), ring);
    assert_eq!(of("l 1 2 \\\n 3 \\\r\n1\n"), ring);
    // A closed yarn has no end to go on from.
    let [_, beyond] = &of("l 1 2 3 1\nl 1 4\n")[..] else { panic!("two yarns") };
    assert_eq!(*beyond, (false, vec![0.0, 3.0]));
    // A way to and fro is no ring.
    assert_eq!(of("l 1 2 1\n"), [(false, vec![0.0, 1.0, 0.0])]);
}

#[test]
fn coordinates_are_those_of_the_text_times_the_unit() {
    let places = [[0.1_f32, -1.0 / 3.0, 1e-7], [12345.678, 2.0, -0.3], [99999.99, 0.0, 7.25e-3]];
    let text: String = places.iter().map(|[x, y, z]| format!("v {x} {y} {z}\n")).collect();
    let text = text + "l 1 2 3\n";
    let found = read(&text);
    for (point, place) in found.points().iter().zip(places) {
        assert_eq!([point.x, point.y, point.z].map(f32::to_bits), place.map(f32::to_bits));
    }
    let metres = CurveScale { unit_mm: Some(1000.0), diameter_mm: Some(0.25) };
    let found = curves_from("lines.OBJ", text.as_bytes(), metres).unwrap();
    assert_eq!(found.points()[2].z, 7.25e-3 * 1000.0);
}

#[test]
fn what_obj_does_not_allow_is_refused_with_its_place() {
    for (text, said) in [
        ("", "bad.obj: the statement l is missing or empty; each yarn is a polyline"),
        ("v 0 0 0\nv 1 0 0\nf 1 2 1\n", "bad.obj: the statement l is missing"),
        ("v 0 0\n", "bad.obj, line 1, column 6: the line ends, expected a coordinate"),
        ("v 0 nan 0\n", "bad.obj, line 1, column 5: \"nan\", expected a coordinate"),
        ("v 0 1e99 0\n", "bad.obj, line 1, column 5: \"1e99\", expected a coordinate"),
        ("v 0 0 0\n\n  l 1 2\n", "bad.obj, line 3, column 7: \"2\", expected a vertex from 1 to 1"),
        ("v 0 0 0\nl 1 0\n", "line 2, column 5: \"0\", expected a vertex from 1 to 1, or from -1 to -1"),
        ("v 0 0 0\nl 1 -2\n", "line 2, column 5: \"-2\""),
        ("v 0 0 0\nl 1 -9223372036854775808\n", "line 2, column 5: \"-9223372036854775808\""),
        ("v 0 0 0\nl 1 9223372036854775807\n", "line 2, column 5: \"9223372036854775807\""),
        ("v 0 0 0\nl 1\n", "line 2, column 4: the line ends, expected two vertices or more"),
        ("v 0 0 0\nv 1 0 0\nl 1 \\\n é\n", "line 4, column 2: \"é\""),
        ("v 0 0 0\nv 1 0 0\nl 1\\\nx\n", "line 4, column 1: \"x\""),
    ] {
        let error = curves_from("bad.obj", text.as_bytes(), SCALE).unwrap_err();
        assert!(error.to_string().contains(said), "{text:?}: {error}");
    }
    let wide = CurveScale { diameter_mm: Some(f32::NAN), ..SCALE };
    let error = curves_from("bad.obj", b"v 0 0 0\nv 1 0 0\nl 1 2\n", wide).unwrap_err();
    assert!(matches!(error, ReadError::Yarns { .. }), "{error}");
}

/// A statement may be as long as the file. The time to find an error in it is proportional to its
/// length.
#[test]
fn one_long_polyline_is_read() {
    let count = 200_000;
    let mut text: String = (0..count).map(|x| format!("v {x} 0 0\n")).collect();
    text += "l";
    (1..=count).for_each(|corner| text += &format!(" {corner}"));
    assert_eq!(read(&text).points().len(), count);
    text += " x";
    assert!(curves_from("long.obj", text.as_bytes(), SCALE).is_err());
}

/// The yarns of a file have the control points and the settings of equal yarns made in code.
#[test]
fn a_file_of_lines_is_read_from_its_path() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("lines.obj");
    std::fs::write(&path, "v 0 0 0\nv 0.001 0 0\nv 0.002 0.001 0\nl 1 2 3\n").unwrap();
    let found = read::curves(&path, CurveScale { unit_mm: Some(1000.0), diameter_mm: Some(0.2) }).unwrap();
    let mut known = Yarns::builder();
    let at = [[0.0, 0.0], [1.0, 0.0], [2.0, 1.0]];
    let points = at.map(|[x, y]| texere_core::ControlPoint::new(x, y, 0.0, 0.1));
    known.yarn(texere_core::Yarn::default(), &points);
    let known = known.build().unwrap();
    assert_eq!(found.points(), known.points());
    assert_eq!(Settings::of(&found), Settings::of(&known));
}
