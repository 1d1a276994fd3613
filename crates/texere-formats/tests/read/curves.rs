//! Files of curves. BCC is checked byte by byte and read again. USD's text form is evaluated with
//! the matrices of the bases that USD defines.

use glam::Vec3;
use texere_core::definitions::{Segment, neighbours, tangent_factor};
use texere_core::{ControlPoint, Material, Yarn, Yarns};
use texere_formats::read::{CurveScale, curves_from};
use texere_formats::write::{self, CurveFormat};
use texere_formats::{ReadError, WriteError};

const SCALE: CurveScale = CurveScale { unit_mm: Some(1.0), diameter_mm: Some(0.25) };

/// An open yarn, a closed one, and one of another material whose thickness changes.
fn yarns() -> Yarns {
    let mut yarns = Yarns::builder();
    yarns.material(Material::default());
    let red = Material { name: "red \"silk\"\\\n2".into(), srgb: [255, 0, 0], ..Material::default() };
    let red = yarns.material(red);
    let point = |x: f32, y: f32, z: f32, radius| ControlPoint::new(x, y, z, radius);
    let wave = [[0.0, 0.1, 0.3], [1.0, 0.4, -0.3], [2.5, 0.1, 0.3], [3.0, -1.0, 1.0 / 3.0]];
    yarns.yarn(Yarn::default(), &wave.map(|[x, y, z]| point(x, y, z, 0.125)));
    let ring = [[0.0, 0.0, 5.0], [2.0, 0.0, 5.0], [2.0, 2.0, 5.5], [0.0, 2.0, 5.0], [-1e-3, 1e-7, 4.0]];
    yarns.yarn(Yarn { closed: true, ..Yarn::default() }, &ring.map(|[x, y, z]| point(x, y, z, 0.125)));
    let thin = [(0.0, 0.25), (1.0, 0.5), (2.0, 0.125)];
    yarns
        .yarn(Yarn { material: red, ..Yarn::default() }, &thin.map(|(x, radius)| point(x, 9.0, 0.0, radius)));
    yarns.build().unwrap()
}

fn written(yarns: &Yarns, format: CurveFormat) -> Vec<u8> {
    let mut bytes = Vec::new();
    let length = write::curves_to(yarns, format, &mut bytes).unwrap();
    assert_eq!(length, bytes.len() as u64);
    bytes
}

#[test]
fn a_bcc_file_has_the_bytes_of_its_definition() {
    let bytes = written(&yarns(), CurveFormat::Bcc);
    assert_eq!(&bytes[..8], b"BCC\x44C0\x03\x02");
    assert_eq!(bytes[8..24], [[3, 0, 0, 0, 0, 0, 0, 0], [12, 0, 0, 0, 0, 0, 0, 0]].concat());
    assert!(bytes[24..64].starts_with(b"texere: mm"));
    assert_eq!(bytes.len(), 64 + 3 * 4 + 12 * 12);
    assert_eq!(bytes[64..68], 4_i32.to_le_bytes());
    let second = 68 + 4 * 12;
    assert_eq!(bytes[second..second + 4], (-5_i32).to_le_bytes());
    // The last coordinate of the first curve.
    assert_eq!(bytes[second - 4..second], (1.0_f32 / 3.0).to_le_bytes());
}

#[test]
fn curves_of_bcc_are_read_again_to_the_bit() {
    let (yarns, bytes) = (yarns(), written(&yarns(), CurveFormat::Bcc));
    let again = curves_from("again.bcc", &bytes, SCALE).unwrap();
    assert_eq!(again.layout().offsets(), yarns.layout().offsets());
    let closed = |yarns: &Yarns| yarns.layout().yarns().iter().map(|yarn| yarn.closed).collect::<Vec<_>>();
    assert_eq!(closed(&again), closed(&yarns));
    let places =
        |yarns: &Yarns| yarns.points().iter().map(|p| [p.x, p.y, p.z].map(f32::to_bits)).collect::<Vec<_>>();
    assert_eq!(places(&again), places(&yarns));
    assert!(again.points().iter().all(|point| point.half_width() == 0.125));
    assert_eq!(written(&again, CurveFormat::Bcc), bytes);
}

#[test]
fn units_and_the_axis_that_is_up_are_taken_into_account() {
    let mut bytes = written(&yarns(), CurveFormat::Bcc);
    let scale = CurveScale { unit_mm: Some(10.0), diameter_mm: Some(2.0) };
    let first = |bytes: &[u8]| {
        let point = curves_from("up.bcc", bytes, scale).unwrap().points()[1];
        [point.x, point.y, point.z]
    };
    assert_eq!(first(&bytes), [10.0, 4.0, -3.0]);
    bytes[7] = 1;
    assert_eq!(first(&bytes), [10.0, 3.0, 4.0]);
    bytes[7] = 0;
    assert_eq!(first(&bytes), [3.0, 4.0, 10.0]);
}

#[test]
fn a_bcc_file_that_is_cut_short_or_goes_on_is_refused() {
    let bytes = written(&yarns(), CurveFormat::Bcc);
    for end in 0..bytes.len() {
        let error = curves_from("cut.bcc", &bytes[..end], SCALE).unwrap_err();
        assert!(matches!(error, ReadError::Bytes { .. }), "{end}: {error:?}");
    }
    let error = curves_from("long.bcc", &[&bytes[..], &[0]].concat(), SCALE).unwrap_err();
    assert!(error.to_string().starts_with("long.bcc, byte 220: what follows the last list"), "{error}");
}

#[test]
fn values_that_bcc_does_not_allow_are_refused_with_their_place() {
    let bytes = written(&yarns(), CurveFormat::Bcc);
    let huge = u64::MAX.to_le_bytes();
    let changes: [(usize, &[u8], &str); 12] = [
        (0, b"X", "byte 0: the sign"),
        (3, &[0x88], "byte 0: the sign"),
        (4, b"C1", "byte 4: the kind of curve"),
        (6, &[2], "byte 6: the number of dimensions"),
        (7, &[3], "byte 7: the axis that points up"),
        (8, &huge, "byte 8: the number of curves"),
        (16, &huge, "byte 16: the number of control points of all curves"),
        (16, &[11], "the number of control points of a curve"),
        (16, &[13], "the number of control points of all curves"),
        (64, &[1], "byte 64: the number of control points of a curve"),
        (64, &i32::MIN.to_le_bytes(), "byte 64: the number of control points of a curve"),
        (116, &(-2_i32).to_le_bytes(), "byte 116: the number of control points of a curve"),
    ];
    for (at, change, expected) in changes {
        let mut bytes = bytes.clone();
        bytes[at..at + change.len()].copy_from_slice(change);
        let error = curves_from("bad.bcc", &bytes, SCALE).unwrap_err().to_string();
        assert!(error.starts_with("bad.bcc, byte ") && error.contains(expected), "{at}: {error}");
    }
    let mut endless = bytes.clone();
    endless[68..72].copy_from_slice(&f32::INFINITY.to_le_bytes());
    for (bytes, scale) in [
        (&endless, SCALE),
        (&bytes, CurveScale { unit_mm: Some(f32::NAN), ..SCALE }),
        (&bytes, CurveScale { diameter_mm: Some(-1.0), ..SCALE }),
        (&bytes, CurveScale { diameter_mm: Some(0.0), ..SCALE }),
    ] {
        let error = curves_from("bad.bcc", bytes, scale).unwrap_err();
        assert!(matches!(error, ReadError::Yarns { .. }), "{scale:?}: {error}");
    }
}

#[test]
fn bcc_refuses_a_tension_that_it_cannot_hold() {
    let error =
        write::curves_to(&yarns().with_tension(0.5).unwrap(), CurveFormat::Bcc, Vec::new()).unwrap_err();
    assert!(
        matches!(error, WriteError::Unheld { .. }) && error.to_string().contains("tension 0.5"),
        "{error}"
    );
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("tense.bcc");
    write::curves(&yarns().with_tension(0.5).unwrap(), &path).unwrap_err();
    assert_eq!(folder.path().read_dir().unwrap().count(), 0);
}

/// The numbers of an attribute's list in a stage, in the prim that begins at `prim`.
fn numbers(prim: &str, attribute: &str) -> Vec<f32> {
    let (_, list) = prim.split_once(&format!(" {attribute} = [")).unwrap();
    let (list, _) = list.split_once(']').unwrap();
    let plain = list.replace(['(', ')'], " ").replace("true", "1").replace("false", "0");
    plain.split(',').map(|number| number.trim().parse().unwrap()).collect()
}

/// The place at `t` of a cubic with these four vertices, by the matrix of its basis, whose rows are
/// those of t³, t², t and 1.
fn by_basis(basis: &str, vertices: [Vec3; 4], t: f32) -> Vec3 {
    let matrix = match basis {
        "catmullRom" => {
            [[-0.5, 1.5, -1.5, 0.5], [1.0, -2.5, 2.0, -0.5], [-0.5, 0.0, 0.5, 0.0], [0.0, 1.0, 0.0, 0.0]]
        }
        "bezier" => {
            [[-1.0, 3.0, -3.0, 1.0], [3.0, -6.0, 3.0, 0.0], [-3.0, 3.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]]
        }
        other => panic!("{other}"),
    };
    let powers = [t * t * t, t * t, t, 1.0];
    let weight = |vertex: usize| -> f32 { (0..4).map(|power| powers[power] * matrix[power][vertex]).sum() };
    (0..4).map(|vertex| weight(vertex) * vertices[vertex]).sum()
}

/// The vertices of a yarn's curve, four at a time: one quadruple for each interval.
fn quadruples(basis: &str, own: &[Vec3], is_closed: bool) -> Vec<[Vec3; 4]> {
    match (basis, is_closed) {
        // A periodic curve starts at its first vertex, and goes on from its last one to its first.
        ("catmullRom", true) => {
            (0..own.len()).map(|k| [own.len() - 1, 0, 1, 2].map(|step| own[(k + step) % own.len()])).collect()
        }
        ("catmullRom", false) => own.windows(4).map(|four| four.try_into().unwrap()).collect(),
        _ => own.windows(4).step_by(3).map(|four| four.try_into().unwrap()).collect(),
    }
}

#[test]
fn curves_of_usd_are_the_splines_of_the_yarns() {
    for tension in [0.0, 0.4] {
        let yarns = yarns().with_tension(tension).unwrap();
        let stage = String::from_utf8(written(&yarns, CurveFormat::Usda)).unwrap();
        let basis = if tension == 0.0 { "catmullRom" } else { "bezier" };
        let mut seen = 0;
        for prim in stage.split("def BasisCurves").skip(1) {
            assert!(prim.contains(&format!("uniform token basis = \"{basis}\"")));
            let axes = numbers(prim, "points");
            let mut vertices = axes.chunks_exact(3).map(Vec3::from_slice);
            let mut widths = numbers(prim, "widths").into_iter();
            let counts = numbers(prim, "curveVertexCounts");
            let closed = numbers(prim, "primvars:closed");
            for ((count, number), closed) in counts.iter().zip(numbers(prim, "primvars:yarn")).zip(closed) {
                let own: Vec<_> = vertices.by_ref().take(*count as usize).collect();
                let yarn = number as usize;
                let (points, is_closed) =
                    (yarns.yarn_points(yarn).unwrap(), yarns.layout().yarns()[yarn].closed);
                assert_eq!(closed == 1.0, is_closed);
                let wrap = if is_closed && tension == 0.0 { "periodic" } else { "nonperiodic" };
                assert!(prim.contains(&format!("uniform token wrap = \"{wrap}\"")));
                let intervals = points.len() - usize::from(!is_closed);
                let pieces = quadruples(basis, &own, is_closed);
                assert_eq!(pieces.len(), intervals);
                for (interval, four) in pieces.into_iter().enumerate() {
                    let window = neighbours(points, is_closed, interval);
                    let segment = Segment::new(&window, tangent_factor(tension));
                    // The file has the end point of a yarn twice. The yarn's spline instead goes on
                    // beyond its end in a straight line. In the interval at an end the curves
                    // are t (1 - t)² / 2 of the chord apart, 2/27 at most.
                    let is_end = !is_closed && (interval == 0 || interval + 1 == intervals);
                    let chord = window[1].position().distance(window[2].position());
                    let slack = if is_end && tension == 0.0 { 2.0 / 27.0 * chord } else { 0.0 };
                    for t in [0.0, 0.3, 0.5, 0.9, 1.0] {
                        let (place, expected) = (by_basis(basis, four, t), segment.sample(t).centre);
                        let slack = if t == 0.0 || t == 1.0 { 0.0 } else { slack };
                        assert!(
                            place.distance(expected) < slack + 2e-6 * (1.0 + expected.length()),
                            "{place} {expected}"
                        );
                    }
                }
                // Catmull-Rom curves have one width for each vertex, the ends twice; others have
                // one at each end of an interval.
                let mut radii = points.iter().map(|point| 2.0 * point.half_width());
                let expected: Vec<_> = match (basis, is_closed) {
                    ("catmullRom", false) => {
                        radii.clone().take(1).chain(radii.clone()).chain(radii.next_back()).collect()
                    }
                    ("catmullRom", true) => radii.collect(),
                    (_, false) => radii.collect(),
                    (_, true) => radii.clone().chain(radii.take(1)).collect(),
                };
                assert_eq!(widths.by_ref().take(expected.len()).collect::<Vec<_>>(), expected);
                seen += 1;
            }
            assert!(vertices.next().is_none() && widths.next().is_none());
        }
        assert_eq!(seen, 3);
    }
}

#[test]
fn a_stage_of_usd_keeps_control_points_to_the_bit_and_names_to_the_letter() {
    let yarns = yarns();
    let stage = String::from_utf8(written(&yarns, CurveFormat::Usda)).unwrap();
    let prim = stage.split("def BasisCurves").nth(1).unwrap();
    let axes = numbers(prim, "points");
    // The first curve's vertices are its points, with the first and the last one twice.
    let own: Vec<_> = axes[3..15].chunks_exact(3).map(|axes| [axes[0], axes[1], axes[2]]).collect();
    assert_eq!(own, yarns.yarn_points(0).unwrap().iter().map(|p| [p.x, p.y, p.z]).collect::<Vec<_>>());
    assert!(stage.contains("displayName = \"red \\\"silk\\\"\\\\ 2\"\n"), "{stage}");
    // Pure red is 1 in linear light, too.
    assert!(stage.contains("primvars:displayColor = [(1, 0, 0)]"));
    assert!(stage.contains("metersPerUnit = 0.001") && stage.contains("upAxis = \"Z\""));
}

#[test]
fn linear_curves_of_usd_are_the_control_points() {
    let yarns = yarns().with_tension(0.4).unwrap();
    let stage = String::from_utf8(written(&yarns, CurveFormat::LinearUsda)).unwrap();
    for prim in stage.split("def BasisCurves").skip(1) {
        assert!(prim.contains("uniform token type = \"linear\""));
        // Yarns without a tex have no mass.
        let yarn = numbers(prim, "primvars:yarn")[0] as usize;
        let material = &yarns.materials()[yarns.layout().yarns()[yarn].material as usize];
        assert_eq!(prim.contains("physics:masses = "), material.tex.is_some());
        let axes = numbers(prim, "points");
        let mut vertices = axes.chunks_exact(3).map(|axes| [axes[0], axes[1], axes[2]]);
        let mut widths = numbers(prim, "widths").into_iter();
        for (count, yarn) in numbers(prim, "curveVertexCounts").iter().zip(numbers(prim, "primvars:yarn")) {
            let points = yarns.yarn_points(yarn as usize).unwrap();
            // A closed yarn ends where it begins.
            let again = points.first().filter(|_| yarns.layout().yarns()[yarn as usize].closed);
            for point in points.iter().chain(again) {
                assert_eq!(vertices.next(), Some([point.x, point.y, point.z]));
                assert_eq!(widths.next(), Some(2.0 * point.half_width()));
            }
            assert_eq!(*count as usize, points.len() + usize::from(again.is_some()));
        }
        assert!(vertices.next().is_none() && widths.next().is_none());
    }
}
