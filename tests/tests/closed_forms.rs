//! Curves whose tubes are known in closed form: a torus and a helix. They check the oracle as well as the backends.

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
    /// Where the section's x axis points: the first point of a circle lies on it.
    fn side(&self) -> DVec3 {
        (self.vertices[0].0 - self.centre).normalize()
    }
}

/// The one yarn of `yarns` as the oracle has it, then as the CPU backends have it, each with how exact it can be.
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

/// Half way between two of the points that it passes through, h radians apart on a circle of radius R, a Catmull-Rom
/// spline lies 9/8 cos(h/2) - 1/8 cos(3h/2) = 1 - 3h⁴/128 + … radii from the middle, and nowhere further off.
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
                        // The torus' own normal points away from the nearest place of its core.
                        let core = (x * u + y * v).normalize() * AROUND;
                        let outward = (*vertex - core).normalize();
                        assert!(normal.dot(outward) > 1.0 - 1e-5, "{place}: {normal} is not {outward}");
                    }
                }
            }
        }
    }
}

/// In a plane nothing turns: the section keeps its angle to the plane, all the way round and through the vertical.
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

/// Against the Frenet frame of a helix (its normal points at the axis) a frame that does not turn about the tangent
/// turns by minus torsion times arc length (Bishop 1975). Torsion is b / (a² + b²) for radius a and rise b per radian.
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
            // Off the yarn's ends, where the virtual points bend the spline away from the helix.
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
                // The spline's tangents and chords miss those of the helix by the fourth power of a step.
                let allowed = 1e-6 * length + 1e-4 + 10.0 * exact;
                assert!(off.abs() < allowed, "{who}, radius {a}, rise {b}, ring {ring}: {off} rad");
            }
        }
    }
}
