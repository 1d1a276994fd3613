//! Tubes that are known in closed form: a torus and a helix. They check the oracle and both CPU
//! backends.

use std::f64::consts::TAU;

use glam::DVec3;
use texere_conformance::oracle::Oracle;
use texere_core::{ControlPoint, Frame, Pipeline, Settings, Yarn, Yarns};
use texere_cpu::{ParallelBackend, SerialBackend};

/// A centre with its vertices and their normals.
struct Ring {
    centre: DVec3,
    vertices: Vec<(DVec3, DVec3)>,
}

impl Ring {
    /// Direction of the section's x axis, on which the first point of a circle lies.
    fn side(&self) -> DVec3 {
        (self.vertices[0].0 - self.centre).normalize()
    }
}

/// The single yarn of `yarns` by the oracle and by the CPU backends, each with its accuracy.
fn tubes(yarns: &Yarns, settings: Settings) -> Vec<(&'static str, Vec<Ring>, f64)> {
    let sides = settings.sides as usize;
    let oracle = Oracle::new(yarns, &settings);
    let rings = oracle.yarns[0].rings.iter().enumerate().map(|(number, ring)| Ring {
        centre: ring.centre,
        vertices: (0..sides).map(|point| oracle.vertex(0, number, point)).collect(),
    });
    let mut tubes = vec![("oracle", rings.collect(), 1e-9)];
    let place = |at: [f32; 3]| DVec3::from_array(at.map(f64::from));
    for (name, device) in [
        ("cpu-serial", &SerialBackend::new() as &dyn texere_core::Backend),
        ("cpu", &ParallelBackend::open().unwrap()),
    ] {
        let pipeline = || Pipeline::new(yarns).settings(settings);
        let (mesh, trajectory) = (pipeline().mesh(device).unwrap(), pipeline().trajectory(device).unwrap());
        let rings = mesh.vertices.chunks(sides).zip(&trajectory.rings).map(|(vertices, ring)| Ring {
            centre: place(ring.centre),
            vertices: vertices.iter().map(|vertex| (place(vertex.position), place(vertex.normal))).collect(),
        });
        tubes.push((name, rings.collect(), 2e-6));
    }
    tubes
}

fn one_yarn(closed: bool, count: u32, at: impl Fn(f64) -> DVec3) -> Yarns {
    let point = |k| {
        let at = at(f64::from(k)).as_vec3();
        ControlPoint::new(at.x, at.y, at.z, 0.5)
    };
    let points: Vec<_> = (0..count).map(point).collect();
    let mut yarns = Yarns::builder();
    yarns.yarn(Yarn { closed, ..Yarn::default() }, &points);
    yarns.build().unwrap()
}

/// Two unit vectors that span a plane: flat, upright, and askew.
fn planes() -> [(&'static str, DVec3, DVec3); 3] {
    let askew = DVec3::new(1.0, 2.0, 2.0) / 3.0;
    [
        ("flat", DVec3::X, DVec3::Y),
        ("upright", DVec3::X, DVec3::Z),
        ("askew", askew, DVec3::new(2.0, 1.0, -2.0) / 3.0),
    ]
}

const AROUND: f64 = 4.0;
const POINTS: u32 = 32;

/// A Catmull-Rom spline through points of a circle, h radians apart, is furthest off half way
/// between two points. It lies 9/8 cos(h/2) - 1/8 cos(3h/2) = 1 - 3h⁴/128 + … radii from the centre
/// there.
fn deviation() -> f64 {
    AROUND * 3.0 / 128.0 * (TAU / f64::from(POINTS)).powi(4)
}

#[test]
fn a_closed_circle_makes_a_torus() {
    for (name, x, y) in planes() {
        let yarns = one_yarn(true, POINTS, |k| {
            let (sin, cos) = (TAU * k / f64::from(POINTS)).sin_cos();
            (x * cos + y * sin) * AROUND
        });
        for frame in [Frame::Upright, Frame::RotationMinimizing] {
            for (who, rings, exact) in
                tubes(&yarns, Settings { frame, subdivisions: 5, ..Settings::default() })
            {
                assert_eq!(rings.len() as u32, POINTS * 6 + 1);
                for (number, ring) in rings.iter().enumerate() {
                    for (vertex, normal) in &ring.vertices {
                        let (u, v) = (vertex.dot(x), vertex.dot(y));
                        let across = vertex.dot(x.cross(y));
                        let off = (u.hypot(v) - AROUND).hypot(across) - 0.5;
                        let place = format!("{who}, {name}, {frame:?}, ring {number}");
                        assert!(off.abs() < deviation() + exact * 4.0, "{place}: {off} off the torus");
                        // The normal of a torus points away from the nearest place of its core.
                        let core = (x * u + y * v).normalize() * AROUND;
                        let outward = (*vertex - core).normalize();
                        assert!(normal.dot(outward) > 1.0 - 1e-5, "{place}: {normal} is not {outward}");
                    }
                }
            }
        }
    }
}

/// In a plane nothing turns. The section keeps its angle to the plane all the way round, also
/// through the vertical.
#[test]
fn a_rotation_minimising_frame_does_not_turn_round_a_circle() {
    for (name, x, y) in planes() {
        let yarns = one_yarn(true, POINTS, |k| {
            let (sin, cos) = (TAU * k / f64::from(POINTS)).sin_cos();
            (x * cos + y * sin) * AROUND
        });
        let settings = Settings { frame: Frame::RotationMinimizing, subdivisions: 5, ..Settings::default() };
        for (who, rings, exact) in tubes(&yarns, settings) {
            let across = rings[0].side().dot(x.cross(y));
            for (number, ring) in rings.iter().enumerate() {
                let now = ring.side().dot(x.cross(y));
                assert!(
                    (now - across).abs() < 10.0 * exact,
                    "{who}, {name}, ring {number}: {now}, not {across}"
                );
            }
        }
    }
}

/// The normal of a helix's Frenet frame points at the axis. A frame that does not turn about the
/// tangent turns against the Frenet frame by minus torsion times arc length (Bishop 1975). For
/// radius a and rise b per radian, the torsion is b / (a² + b²).
#[test]
fn a_rotation_minimising_frame_unwinds_the_torsion_of_a_helix() {
    let per_turn = 64.0;
    for (a, b) in [(2.0, 0.5), (2.0, -0.5), (1.0, 1.5)] {
        let yarns = one_yarn(false, 200, |k| {
            let (sin, cos) = (TAU * k / per_turn).sin_cos();
            DVec3::new(a * cos, a * sin, b * TAU * k / per_turn)
        });
        let settings = Settings { frame: Frame::RotationMinimizing, subdivisions: 3, ..Settings::default() };
        for (who, rings, exact) in tubes(&yarns, settings) {
            // Away from the yarn's ends, where virtual points bend the spline away from the helix.
            let inner = 12..rings.len() - 12;
            let angle = |ring: usize| {
                let turned = TAU * ring as f64 / (per_turn * 4.0);
                let normal = DVec3::new(-turned.cos(), -turned.sin(), 0.0);
                let tangent = DVec3::new(-a * turned.sin(), a * turned.cos(), b) / a.hypot(b);
                let side = rings[ring].side();
                side.dot(tangent.cross(normal)).atan2(side.dot(normal))
            };
            let start = angle(inner.start);
            for ring in inner.clone() {
                let radians = TAU * (ring - inner.start) as f64 / (per_turn * 4.0);
                let (torsion, length) = (b / (a * a + b * b), a.hypot(b) * radians);
                let off = angle(ring) - start + torsion * length;
                let off = off - (off / TAU).round() * TAU;
                // Tangents and chords of the spline differ from those of the helix by the fourth
                // power of a step.
                let allowed = 1e-6 * length + 1e-4 + 10.0 * exact;
                assert!(off.abs() < allowed, "{who}, radius {a}, rise {b}, ring {ring}: {off} rad");
            }
        }
    }
}

/// A yarn along `at`, with these half widths and half heights at its points.
fn flattened_yarn(
    closed: bool,
    count: u32,
    at: impl Fn(f64) -> DVec3,
    halves: impl Fn(f64) -> [f64; 2],
) -> Yarns {
    let point = |k| {
        let (at, [width, height]) = (at(f64::from(k)).as_vec3(), halves(f64::from(k)));
        ControlPoint::new(at.x, at.y, at.z, 0.5).flattened(width as f32, height as f32)
    };
    let points: Vec<_> = (0..count).map(point).collect();
    let mut yarns = Yarns::builder();
    yarns.yarn(Yarn { closed, ..Yarn::default() }, &points);
    yarns.build().unwrap()
}

/// Relative error of a half float, and of the spline between two of them.
const HALF_FLOAT: f64 = 1e-3;

/// On a level circle of radius R, the side of the upright frame points at the centre, and its up
/// points along z. With half width a, half height b and distance ρ from the axis, the surface is
/// ((ρ - R)/a)² + (z/b)² = 1 at each angle. The normal has the direction of the gradient of the
/// left side, with a and b that change along the yarn.
#[test]
fn a_flattened_circle_makes_a_torus_of_ellipses() {
    let turned = |k: f64| TAU * k / f64::from(POINTS);
    let halves = |k: f64| [0.6 + 0.15 * turned(k).cos(), 0.3 + 0.08 * (2.0 * turned(k)).sin()];
    let growths = |k: f64| [-0.15 * turned(k).sin() / AROUND, 0.16 * (2.0 * turned(k)).cos() / AROUND];
    let yarns =
        flattened_yarn(true, POINTS, |k| DVec3::new(turned(k).cos(), turned(k).sin(), 0.0) * AROUND, halves);
    for (who, rings, _) in tubes(&yarns, Settings { subdivisions: 5, ..Settings::default() }) {
        for (number, ring) in rings.iter().enumerate() {
            let k = number as f64 / 6.0;
            let (outward, along) = (
                DVec3::new(turned(k).cos(), turned(k).sin(), 0.0),
                DVec3::new(-turned(k).sin(), turned(k).cos(), 0.0),
            );
            let ([a, b], [a_growth, b_growth]) = (halves(k), growths(k));
            for (vertex, normal) in &ring.vertices {
                let (x, y) = ((vertex.dot(outward) - AROUND) / a, vertex.z / b);
                let off = x.hypot(y) - 1.0;
                let place = format!("{who}, ring {number}");
                assert!(off.abs() < 2.0 * HALF_FLOAT, "{place}: {off} off the torus");
                let gradient = outward * (x / a) + DVec3::Z * (y / b)
                    - along * (x * x * a_growth / a + y * y * b_growth / b);
                let away = (gradient.normalize() - *normal).length();
                // The derivative of a spline is less accurate than the spline.
                assert!(away < 6.0 * HALF_FLOAT, "{place}: {normal} is {away} off the gradient");
            }
        }
    }
}

/// On a helix about z, the side of the upright frame points at the axis. Its up is at right angles
/// to the side and to the tangent.
#[test]
fn a_flattened_helix_has_an_ellipse_in_each_of_its_normal_planes() {
    let (out, rise, per_turn) = (2.0, 0.6, 48.0);
    let turned = |k: f64| TAU * k / per_turn;
    let halves = |k: f64| [0.5 + 0.1 * (1.5 * turned(k)).sin(), 0.25 + 0.05 * turned(k).cos()];
    let yarns = flattened_yarn(
        false,
        120,
        |k| DVec3::new(out * turned(k).cos(), out * turned(k).sin(), rise * turned(k)),
        halves,
    );
    for (who, rings, _) in tubes(&yarns, Settings { subdivisions: 5, ..Settings::default() }) {
        // Away from the yarn's ends, where virtual points bend the spline away from the helix.
        for (number, ring) in rings.iter().enumerate().take(rings.len() - 18).skip(18) {
            let k = number as f64 / 6.0;
            let tangent = DVec3::new(-out * turned(k).sin(), out * turned(k).cos(), rise) / out.hypot(rise);
            let side = -DVec3::new(turned(k).cos(), turned(k).sin(), 0.0);
            let (up, [a, b]) = (tangent.cross(side), halves(k));
            for (vertex, _) in &ring.vertices {
                let arm = *vertex - ring.centre;
                let off = (arm.dot(side) / a).hypot(arm.dot(up) / b) - 1.0;
                let place = format!("{who}, ring {number}");
                assert!(off.abs() < 2.0 * HALF_FLOAT, "{place}: {off} off the ellipse");
                assert!(arm.dot(tangent).abs() < HALF_FLOAT * a, "{place}: not in the normal plane");
            }
        }
    }
}
