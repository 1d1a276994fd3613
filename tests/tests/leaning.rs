//! Yarns that leave the plane of their cloth, with up directions of their own: the cloth is turned
//! and bent.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::Arc;

use glam::{DMat3, DVec3};
use texere_conformance::cases::{design, small_designs};
use texere_conformance::schedule::able_devices;
use texere_contact::clearance;
use texere_core::backend::{LiveMesh, Plan};
use texere_core::{
    ControlPoint, Frame, Material, Mesh, MeshPiece, Pipeline, Placement, Ray, Section, Settings, Topology,
    Vertex, Yarn, YarnError, Yarns,
};
use texere_cpu::{ParallelBackend, Picker, SerialBackend};
use texere_fabric::{Thread, Weave, Woven};

/// A plain weave of flat threads that lie close, in `section`.
fn cloth(section: Section, twist: f32) -> Yarns {
    let plain = Weave::parse("plain").unwrap().drawdown(6, 6).unwrap();
    let thread = Thread { flatness: 1.6, twist, ..Thread::new(0.55, 0.125) };
    let (warp, weft) = (vec![thread; 6], vec![thread; 6]);
    Woven::new(plain, warp, weft, vec![Material::default()], vec![section]).unwrap().yarns().unwrap()
}

/// `yarns` turned about x and then about z, rad, and the matrix of both turns.
fn turned(yarns: &Yarns, [x, z]: [f64; 2]) -> (Yarns, DMat3) {
    let turn = DMat3::from_rotation_z(z) * DMat3::from_rotation_x(x);
    (yarns.mapped(|place| (turn * DVec3::from_array(place)).to_array()).unwrap(), turn)
}

fn least(yarns: &Yarns) -> f64 {
    clearance(yarns, &Settings::default()).unwrap().min
}

/// `yarns` bent around a cylinder of this radius, mm. Its axis runs below the cloth, parallel to
/// the cloth's plane, `way` radians from y.
fn cylinder(yarns: &Yarns, radius: f64, way: f64) -> Yarns {
    let (sin, cos) = way.sin_cos();
    let map = |[x, y, z]: [f64; 3]| {
        let (across, along) = (cos * x + sin * y, cos * y - sin * x);
        let (out, up) =
            ((across / radius).sin() * (radius + z), (across / radius).cos() * (radius + z) - radius);
        [cos * out - sin * along, sin * out + cos * along, up]
    };
    yarns.mapped(map).unwrap()
}

/// `yarns` bent over a saddle: down along x and up along y, with this radius, mm, in the middle of
/// the cloth.
fn saddle(yarns: &Yarns, radius: f64) -> Yarns {
    saddle_about(yarns, radius, [1.65; 2])
}

fn saddle_about(yarns: &Yarns, radius: f64, middle: [f64; 2]) -> Yarns {
    let map = |[x, y, z]: [f64; 3]| {
        let (u, v) = (x - middle[0], y - middle[1]);
        let normal = DVec3::new(u / radius, -v / radius, 1.0).normalize();
        (DVec3::new(u, v, (v * v - u * u) / (2.0 * radius)) + normal * z).to_array()
    };
    yarns.mapped(map).unwrap()
}

#[test]
fn a_cloth_that_is_turned_any_way_keeps_its_clearance() {
    for section in [Section::Circle, Section::Lenticular { aspect: 1.5, distortion: 0.0 }] {
        let flat = cloth(section, 0.0);
        let before = least(&flat);
        for degrees in [30.0_f64, 60.0, 90.0, 137.0] {
            for z in [0.0, 0.7] {
                let after = least(&turned(&flat, [degrees.to_radians(), z]).0);
                assert!((after - before).abs() < 0.003, "{degrees} degrees, {z}: {after} for {before}");
            }
        }
    }
}

#[test]
fn a_cloth_on_a_cylinder_or_a_saddle_keeps_its_clearance() {
    let flat = cloth(Section::Circle, 0.0);
    let before = least(&flat);
    for radius in [8.0, 20.0] {
        for way in [0.0, 0.5, 1.571] {
            let after = least(&cylinder(&flat, radius, way));
            assert!((after - before).abs() < 0.01, "cylinder of {radius} mm, {way}: {after} for {before}");
        }
        let after = least(&saddle(&flat, radius));
        assert!((after - before).abs() < 0.01, "saddle of {radius} mm: {after} for {before}");
    }
}

/// The poplin of the example designs, at rest. Its threads are flattened and lie close.
#[test]
fn poplin_at_rest_keeps_its_clearance_wherever_it_goes() {
    let cloth = design("poplin.toml").rest(&ParallelBackend::open().unwrap()).run().unwrap();
    let flat = cloth.yarns();
    let before = least(flat);
    assert!(before > 0.98 && flat.points().iter().any(|point| !point.is_round()), "{before}");
    for degrees in [30.0_f64, 60.0, 90.0] {
        let after = least(&turned(flat, [degrees.to_radians(), 0.0]).0);
        assert!((after - before).abs() < 0.003, "{degrees} degrees: {after} for {before}");
    }
    // Without its up directions the tilted cloth would pierce itself.
    let tilted = turned(flat, [1.0, 0.0]).0;
    let layout = tilted.layout().as_ref().clone();
    let upright = Yarns::new(layout, tilted.materials().to_vec(), tilted.points().to_vec()).unwrap();
    assert!(least(&upright) < before - 0.1);
    // A roll of cloth, and a saddle that rises by a tenth of the cloth's width.
    let after = least(&cylinder(flat, 20.0, 0.3));
    assert!((after - before).abs() < 0.01, "cylinder: {after} for {before}");
    let after = least(&saddle_about(flat, 60.0, [11.5; 2]));
    assert!((after - before).abs() < 0.01, "saddle: {after} for {before}");
}

/// `yarns` with this width over height.
fn flattened(yarns: &Yarns, flatness: f32) -> Yarns {
    let flattened = |point: &ControlPoint| {
        let radius = (point.half_width() * point.half_height()).sqrt();
        point.flattened(radius * flatness.sqrt(), radius / flatness.sqrt())
    };
    let points = yarns.points().iter().map(flattened).collect();
    Yarns::new(yarns.layout().as_ref().clone(), yarns.materials().to_vec(), points).unwrap()
}

/// Ribbons side by side. Some go up, over and down, and some only go up.
fn binders() -> [Yarns; 2] {
    let ribbons = |count: u8, place: &dyn Fn(f32, f32) -> [f32; 3]| {
        let mut yarns = Yarns::builder();
        for yarn in (0..3_u8).map(f32::from) {
            let point = |k| {
                let [x, y, z] = place(yarn, f32::from(k));
                ControlPoint::new(x, y, z, 0.1).flattened(0.2, 0.08)
            };
            yarns.yarn(Yarn::default(), &(0..count).map(point).collect::<Vec<_>>());
        }
        yarns.build().unwrap()
    };
    let over = |yarn: f32, k: f32| {
        let angle = (k / 20.0).clamp(0.2, 0.8) * std::f32::consts::TAU;
        let leg = if k < 10.0 { (4.0 - k).max(0.0) } else { (k - 16.0).max(0.0) };
        [angle.sin(), 0.44 * yarn + 0.02 * k.sin(), -angle.cos() - 0.3 * leg]
    };
    [ribbons(21, &over), ribbons(6, &|yarn, k| [0.1 * yarn, 0.2 * yarn, k])]
}

/// Flat yarns without up directions come equally near to one another for any direction of their
/// cloth, also where they run straight up.
#[test]
fn flat_yarns_that_run_up_and_down_keep_their_clearance_any_way_round() {
    let knits = ["tricot.toml", "jersey.toml", "locknit.toml"].map(|name| small(name, 1.5));
    for (number, yarns) in binders().into_iter().chain(knits).enumerate() {
        assert!(yarns.ups().is_none());
        let before = least(&yarns);
        for z in [0.7, 2.9] {
            let placed = yarns.placed(&Placement { turn: z, ..Placement::default() }).unwrap();
            let after = least(&placed);
            assert!((after - before).abs() < 0.01, "{number}, placed by {z}: {after} for {before}");
        }
        for x in [0.5, 1.571] {
            let after = least(&turned(&yarns, [x, 0.4]).0);
            assert!((after - before).abs() < 0.01, "{number}, turned by {x}: {after} for {before}");
        }
    }
}

/// A small piece of a design, with yarns of this width over height.
fn small(name: &str, flatness: f32) -> Yarns {
    let yarns = small_designs().find(|(small, _)| *small == name.trim_end_matches(".toml"));
    flattened(&yarns.expect("a design of that name").1, flatness)
}

fn mesh(yarns: &Yarns, device: &dyn texere_core::Backend, settings: Settings) -> Mesh {
    Pipeline::new(yarns).settings(settings).mesh(device).unwrap()
}

/// The vertices of all rings, for any cut into chunks.
fn by_ring(mesh: &Mesh) -> Vec<Vertex> {
    let sides = mesh.plan.settings().sides;
    let mut rings = BTreeMap::new();
    for chunk in &mesh.chunks {
        for part in chunk.parts() {
            for ring in 0..part.rings {
                let first = chunk.first_vertex() as usize + (part.first_vertex + ring * sides) as usize;
                rings.insert((part.yarn, part.first_ring + ring), &mesh.vertices[first..][..sides as usize]);
            }
        }
    }
    rings.into_values().flatten().copied().collect()
}

/// On every device the mesh of turned cloth is the mesh of flat cloth, turned.
#[test]
fn the_mesh_of_a_turned_cloth_is_the_turned_mesh() {
    let flats = [cloth(Section::Circle, 0.0), cloth(Section::plied(2), 1.5)];
    for flat in &flats {
        for frame in [Frame::Upright, Frame::RotationMinimizing] {
            let settings = Settings {
                frame,
                subdivisions: 3,
                sides: 8,
                topology: Topology::None,
                ..Settings::default()
            };
            let before = mesh(flat, &SerialBackend::default(), settings);
            for angles in [[0.9, 0.0], [1.57, 0.4], [2.5, -1.0]] {
                let (tilted, turn) = turned(flat, angles);
                for device in able_devices(&tilted, &settings) {
                    let after = mesh(&tilted, &*device, settings);
                    for (number, (one, other)) in by_ring(&before).iter().zip(&by_ring(&after)).enumerate() {
                        let wide = |v: [f32; 3]| DVec3::from_array(v.map(f64::from));
                        let off = (turn * wide(one.position)).distance(wide(other.position));
                        let leans = (turn * wide(one.normal)).distance(wide(other.normal));
                        let name = &device.info().name;
                        // Half widths and half heights are rounded to eleven bits.
                        assert!(
                            off < 3e-4 && leans < 8e-3,
                            "{name}, {frame:?}, {angles:?}, {number}: {off}, {leans}"
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn all_cores_make_the_bits_of_one() {
    for (yarns, closed) in [(saddle(&cloth(Section::plied(3), 2.0), 6.0), false), (ring(), true)] {
        for frame in [Frame::Upright, Frame::RotationMinimizing] {
            for sides in [6, 7] {
                let settings =
                    Settings { frame, subdivisions: 5, sides, caps: !closed, ..Settings::default() };
                let (one, all) = (SerialBackend::default(), ParallelBackend::open().unwrap());
                let [serial, parallel] =
                    [&one as &dyn texere_core::Backend, &all].map(|device| mesh(&yarns, device, settings));
                assert!(serial.vertices == parallel.vertices && serial.indices == parallel.indices);
                let pipeline = || Pipeline::new(&yarns).settings(settings);
                assert!(pipeline().trajectory(&one).unwrap() == pipeline().trajectory(&all).unwrap());
                assert!(pipeline().packed(&one).unwrap() == pipeline().packed(&all).unwrap());
            }
        }
    }
}

/// Three yarns: a twisted one; a ribbon of `count` points, which rises by `slope`, radians, in its
/// middle; and an untwisted yarn in the place of the first.
fn rising(slope: f32, count: u8) -> Yarns {
    let mut at = [0.0_f32, 1.0, 0.0];
    let ribbon: Vec<_> = (0..count)
        .map(|k| {
            let here = ControlPoint::new(at[0], at[1], at[2], 0.1).flattened(0.2, 0.05);
            let [along, aside] = [f32::from(k) / f32::from(count), 0.02 * f32::from(k).sin()];
            let own = slope * (std::f32::consts::PI * along).sin();
            at = [at[0] + 0.3 * own.cos(), at[1] + aside, at[2] + 0.3 * own.sin()];
            here
        })
        .collect();
    let twisted: Vec<_> = (0..60).map(|k| ControlPoint::new(0.2 * k as f32, 0.0, 0.0, 0.1)).collect();
    let mut yarns = Yarns::builder();
    let section = yarns.section(Section::Lenticular { aspect: 1.5, distortion: 0.0 });
    for (twist, points) in [(2.0, &twisted), (0.0, &ribbon), (0.0, &twisted)] {
        yarns.yarn(Yarn { section, twist, ..Yarn::default() }, points);
    }
    yarns.build().unwrap()
}

/// A ribbon in a live mesh is raised, raised further, made longer, laid flat and raised again. Each
/// time the mesh equals a fresh one, on every device.
#[test]
fn flat_yarns_that_are_raised_are_live() {
    let (flat, settings) = (rising(0.2, 40), Settings { sides: 8, ..Settings::default() });
    let edits =
        [(1.6, 40), (1.8, 40), (1.7, 44), (0.1, 44), (1.5, 39)].map(|(slope, count)| rising(slope, count));
    let leans: Vec<_> = edits.iter().map(|yarns| yarns.layout().leans()).collect();
    assert_eq!((flat.layout().leans(), &leans[..]), (false, &[true, true, true, false, true][..]));
    for device in able_devices(&edits[0], &settings).filter(|device| device.info().can.edit) {
        let plan = Arc::new(Plan::with_room(flat.layout().clone(), settings, |_| 60).unwrap());
        let mut live = LiveMesh::new(&*device, plan).unwrap();
        live.upload(0, flat.points()).unwrap();
        live.update().unwrap();
        for (number, yarns) in edits.iter().enumerate() {
            let points = yarns.yarn_points(1).unwrap();
            let first = live.plan().layout().offsets()[1];
            // If the number of points is the same, they are uploaded. Otherwise the yarn is
            // replaced.
            if points.len() as u64 == live.plan().layout().offsets()[2] - first {
                live.upload(first, points).unwrap();
            } else {
                live.set_yarn(1, yarns.layout().yarns()[1], points).unwrap();
            }
            live.update().unwrap();
            assert_eq!(live.plan().layout(), yarns.layout(), "edit {number}");
            let fresh = by_ring(&mesh(yarns, &*device, settings));
            let kept = by_ring(&kept(&mut live));
            assert!(kept == fresh, "{}, edit {number}", device.info().name);
        }
    }
}

/// The vertices and chunks of the mesh that `live` keeps, without indices and materials.
fn kept(live: &mut LiveMesh) -> Mesh {
    let mut kept = Mesh {
        plan: live.plan().clone(),
        chunks: live.chunks().to_vec(),
        vertices: Vec::new(),
        indices: Vec::new(),
        materials: Arc::from([]),
    };
    for chunk in 0..live.chunks().len() {
        let mut take = |piece: MeshPiece<'_>| {
            if let MeshPiece::Vertices { vertices, .. } = piece {
                kept.vertices.extend_from_slice(vertices);
            }
            ControlFlow::Continue(())
        };
        let _ = live.read_mesh(chunk, &mut take).unwrap();
    }
    kept
}

/// A closed ribbon along an upright circle, which makes one turn about itself on its way round.
fn ring() -> Yarns {
    let at = |step: usize| std::f64::consts::TAU * step as f64 / 16.0;
    let points: Vec<_> = (0..16)
        .map(|step| {
            let (sin, cos) = at(step).sin_cos();
            ControlPoint::new(cos as f32, 0.0, sin as f32, 0.1).flattened(0.2, 0.05)
        })
        .collect();
    let ups = (0..16).map(|step| {
        let ((sin, cos), (over_sin, over_cos)) = (at(step).sin_cos(), at(step).sin_cos());
        [(cos * over_cos) as f32, over_sin as f32, (sin * over_cos) as f32]
    });
    let mut yarns = Yarns::builder();
    yarns.yarn(Yarn { closed: true, ..Yarn::default() }, &points);
    let ups: Vec<_> = ups.collect();
    yarns.build().unwrap().with_ups(ups).unwrap()
}

/// At each control point, the outline has its height along the part of the given up that is across
/// the yarn.
#[test]
fn outlines_stand_along_their_ups() {
    let ring = ring();
    for device in able_devices(&ring, &Settings::default()) {
        let settings =
            Settings { sides: 4, subdivisions: 2, topology: Topology::None, ..Settings::default() };
        let (mesh, rings) = (
            mesh(&ring, &*device, settings),
            Pipeline::new(&ring).settings(settings).trajectory(&*device).unwrap().rings,
        );
        for (point, up) in ring.ups().unwrap().iter().enumerate() {
            let number = 3 * point;
            let [centre, tangent] = [rings[number].centre, rings[number].tangent].map(glam::Vec3::from_array);
            let up = (*up - tangent * up.dot(tangent)).normalize();
            // For any turn of the section, its corners lie on an ellipse whose short axis is the
            // up.
            let side = up.cross(tangent);
            let corners: Vec<_> = mesh.vertices[4 * number..][..4]
                .iter()
                .map(|vertex| {
                    let arm = glam::Vec3::from_array(vertex.position) - centre;
                    (arm.dot(side) / 0.2).hypot(arm.dot(up) / 0.05)
                })
                .collect();
            let name = &device.info().name;
            corners.iter().for_each(|at| {
                assert!((at / corners[0] - 1.0).abs() < 2e-3, "{name}, point {point}: {corners:?}")
            });
        }
    }
}

#[test]
fn ups_go_along_with_their_yarns() {
    let tilted = turned(&cloth(Section::Circle, 0.0), [1.0, 0.0]).0;
    let placed = tilted.placed(&Placement { turn: 0.5, scale: 2.0, at: [1.0, 2.0, 3.0] }).unwrap();
    assert!((least(&placed) - least(&tilted)).abs() < 0.003);
    let only = tilted.only([3, 1]).unwrap();
    assert_eq!(only.ups().unwrap()[0], tilted.ups().unwrap()[tilted.range(3).unwrap().start]);
    let flat = cloth(Section::Circle, 0.0);
    let both = Yarns::merged([&flat, &tilted]).unwrap();
    let ups = both.ups().unwrap()[flat.points().len()..].iter().zip(tilted.ups().unwrap());
    ups.for_each(|(up, own)| assert!(up.distance(*own) < 1e-6, "{up} for {own}"));
    let merged = both.only(0..flat.layout().yarns().len()).unwrap();
    assert!((least(&merged) - least(&flat)).abs() < 1e-6);
    assert!(Yarns::merged([&flat, &flat]).unwrap().ups().is_none());
}

#[test]
fn ups_that_are_none_are_named() {
    let flat = cloth(Section::Circle, 0.0);
    let count = flat.points().len();
    assert_eq!(
        flat.clone().with_ups(vec![[0.0, 0.0, 1.0]; 3]).unwrap_err(),
        YarnError::UpCount { ups: 3, points: count }
    );
    let mut ups = vec![[0.0, 0.0, 1.0]; count];
    for bad in [[0.0; 3], [f32::NAN, 0.0, 0.0], [f32::INFINITY, 0.0, 1.0]] {
        ups[1] = bad;
        let refused = flat.clone().with_ups(ups.clone()).unwrap_err();
        assert!(matches!(refused, YarnError::Up { yarn: 0, point: 1, .. }), "{refused}");
    }
    assert!(flat.mapped(|_| [f64::NAN; 3]).is_err());
    assert!(flat.mapped(|[x, _, _]| [x, x, x]).is_err());
}

/// A live mesh of bent cloth equals a fresh one. It refuses other points for a yarn, because the
/// yarn's up directions were given with its points. A ray from just outside a triangle hits the
/// triangle, or a surface before it.
#[test]
fn bent_cloth_is_kept_live_and_picked() {
    let bent = saddle(&cloth(Section::Circle, 0.0), 6.0);
    let settings = Settings { sides: 8, ..Settings::default() };
    let device = ParallelBackend::open().unwrap();
    let plan = Arc::new(Plan::new(bent.layout().clone(), settings).unwrap());
    let mut live = LiveMesh::new(&device, plan.clone()).unwrap();
    live.upload(0, bent.points()).unwrap();
    live.update().unwrap();
    let fresh = mesh(&bent, &device, settings);
    assert!(kept(&mut live).vertices == fresh.vertices);
    let moved: Vec<_> = bent
        .yarn_points(0)
        .unwrap()
        .iter()
        .map(|point| ControlPoint { z: point.z + 1.0, ..*point })
        .collect();
    assert!(live.upload(0, &moved).is_err());
    assert!(live.set_yarn(0, *plan.yarn(0), &moved).is_err());

    let picker = Picker::new(plan, bent.points()).unwrap();
    for triangle in fresh.indices.chunks_exact(3).step_by(97) {
        let corners = [0, 1, 2].map(|corner| {
            DVec3::from_array(fresh.vertices[triangle[corner] as usize].position.map(f64::from))
        });
        let (middle, normal) = (
            (corners[0] + corners[1] + corners[2]) / 3.0,
            (corners[1] - corners[0]).cross(corners[2] - corners[0]),
        );
        let origin = middle + normal.normalize() * 0.01;
        let hit = picker
            .pick(&Ray { origin: origin.to_array(), direction: (-normal.normalize()).to_array() })
            .expect("a hit");
        let yarn = hit.place.yarn;
        // From so near, the ray first hits the triangle itself, or a surface that pierces it.
        assert!(hit.distance <= 0.0101, "yarn {yarn}: {}", hit.distance);
    }
}
