//! The first hit of a ray, against all triangles of the serial backend's mesh; boxes that hold the
//! mesh; and the names of hits.

mod clothes;
mod judge;
mod words;

use std::collections::HashMap;
use std::sync::Arc;

use rayon::prelude::*;
use texere_core::backend::{PaddedPoints, Plan};
use texere_core::{Bounds, ControlPoint, Ray, Settings, Topology, Vertex, Yarn, Yarns};
use texere_cpu::{PickError, Picker};

use self::clothes::{Cloth, clothes, twisted};
use self::judge::{Chance, EDGES, compare, cross, dot, mesh_of, picker_of, ray, sum, triangles};

/// The cosine from which on a triangle faces a ray.
const FACING: f64 = 0.05;

#[test]
fn rays_hit_what_is_nearest_of_all_triangles() {
    let (mut edges, mut rays) = (0, 0);
    for cloth in clothes() {
        let mesh = mesh_of(&cloth.yarns, cloth.settings);
        let own = compare(&picker_of(&mesh, &cloth.yarns), &mesh, cloth.rays, rays as u64);
        println!(
            "{}: {} triangles, {own} of {} rays at edges",
            cloth.name,
            mesh.plan.counts().triangles,
            cloth.rays
        );
        (edges, rays) = (edges + own, rays + cloth.rays);
    }
    assert!(rays >= 100_000 && edges as f64 <= EDGES * rays as f64, "{edges} of {rays} rays met edges");
}

/// A ray from outside towards a vertex or an edge that faces it never passes through the surface.
#[test]
fn no_ray_goes_through_between_triangles() {
    for Cloth { name, yarns, settings, .. } in clothes() {
        let mesh = mesh_of(&yarns, settings);
        let picker = picker_of(&mesh, &yarns);
        let all = triangles(&mesh);
        // Vertices count by position: two of them coincide where a yarn closes.
        let key = |corner: [f64; 3]| corner.map(f64::to_bits);
        let mut normals: HashMap<[u64; 3], Vec<[f64; 3]>> = HashMap::new();
        for ([a, b, c], _) in &all {
            let normal = cross(sum(*b, *a, -1.0), sum(*c, *a, -1.0));
            for corner in [a, b, c] {
                normals.entry(key(*corner)).or_default().push(normal);
            }
        }
        let tried = (0..8_000u64).into_par_iter().filter(|number| {
            let mut chance = Chance(number << 20);
            let (corners, place) = &all[chance.below(all.len())];
            let middle = chance.below(3) as f64 / 2.0;
            let target = sum(corners[0], sum(corners[1], corners[0], -1.0), middle);
            let back = std::array::from_fn(|_| chance.within(-9.0, 9.0));
            let faces = |normal: &[f64; 3]| {
                dot(*normal, back) > FACING * (dot(back, back) * dot(*normal, *normal)).sqrt()
            };
            // A ray may pass by edges of the outline, and by the ends of an open yarn.
            let all_face = corners[..2].iter().all(|corner| normals[&key(*corner)].iter().all(faces));
            let rings = mesh.plan.rings(place.yarn as usize);
            if !all_face || place.cap.is_some() || !(2..rings.max(3) - 3).contains(&place.ring) {
                return false;
            }
            let origin = sum(target, back, 1.0);
            let ray = Ray { origin, direction: sum(target, origin, -1.0) };
            let hit = picker.pick(&ray).map_or(f64::INFINITY, |hit| hit.distance);
            // The target is 1 away, up to rounding. Something may lie before it.
            assert!(hit <= 1.0 + 1e-9, "{name}: {ray:?} came to {hit}");
            true
        });
        let tried = tried.count();
        assert!(tried > 100, "{name}: only {tried} rays faced what they were aimed at");
    }
}

/// An edited picker gives the hits of a fresh one, to the bit, and those of the mesh.
#[test]
fn yarns_that_are_edited_are_hit_where_they_are() {
    let mut edges = 0;
    for Cloth { name, yarns, settings, .. } in clothes() {
        let count = yarns.layout().yarns().len();
        let room = |yarn: usize| yarns.yarn_points(yarn).unwrap().len() as u64 + 40;
        let plan = Plan::with_room(yarns.layout().clone(), settings, room).unwrap();
        let mut picker = Picker::new(Arc::new(plan), yarns.points()).unwrap();
        let mut all: Vec<_> = (0..count)
            .map(|yarn| (*picker.plan().yarn(yarn), yarns.yarn_points(yarn).unwrap().to_vec()))
            .collect();
        let mut chance = Chance(count as u64);
        for edit in 0..5 {
            let yarn = chance.below(count);
            let (what, points) = &mut all[yarn];
            if picker.plan().needs_scan() {
                what.twist = chance.within(-2.0, 2.0) as f32;
            }
            let shift = [(); 3].map(|()| chance.within(-1.0, 1.0) as f32);
            for point in points.iter_mut() {
                *point = ControlPoint {
                    x: point.x + shift[0],
                    y: point.y + shift[1],
                    z: point.z + shift[2],
                    ..*point
                };
            }
            if edit % 2 == 0 && points.len() > 6 {
                points.truncate(points.len() - 3);
            } else {
                let last = points[points.len() - 1];
                points.extend((1..40).map(|k| ControlPoint {
                    x: last.x + k as f32 * 0.3,
                    z: last.z + 0.1,
                    ..last
                }));
                points.truncate(room(yarn) as usize);
            }
            let plan = picker.plan().edited(yarn, *what, points).unwrap();
            picker.set_yarn(Arc::new(plan), yarn, points).unwrap();
        }
        let mut edited = Yarns::builder();
        edited.tension(yarns.tension());
        for section in yarns.layout().sections() {
            edited.section(section.clone());
        }
        for material in yarns.materials().iter() {
            edited.material(material.clone());
        }
        for (yarn, points) in &all {
            edited.yarn(*yarn, points);
        }
        let edited = edited.build().unwrap();
        let mesh = mesh_of(&edited, settings);
        edges += compare(&picker, &mesh, 500, 77);
        let (fresh, triangles) = (picker_of(&mesh, &edited), triangles(&mesh));
        for _ in 0..1_000 {
            let ray = ray(&triangles, &mut chance);
            assert_eq!(picker.pick(&ray), fresh.pick(&ray), "{name}");
        }
    }
    assert!(edges as f64 <= EDGES * 4_000.0, "{edges} rays met edges");
}

/// Boxes hold all vertices, and are little larger than necessary. At the end of a yarn they reach
/// further along the yarn, by the size of its section. Elsewhere they are larger by the excess of a
/// Bézier hull over its curve. `random.rs` tests boxes with random yarns.
#[test]
fn boxes_are_tight() {
    for Cloth { name, yarns, settings, .. } in clothes() {
        let mesh = mesh_of(&yarns, settings);
        let (plan, sides) = (&mesh.plan, settings.sides as usize);
        let mut points = PaddedPoints::new(plan).unwrap();
        points.upload(plan, 0, yarns.points());
        let mut exact = vec![Bounds::NOTHING; yarns.layout().yarns().len()];
        for part in mesh.chunks[0].parts() {
            for vertex in &mesh.vertices[part.first_vertex as usize..][..part.rings as usize * sides] {
                let Vertex { position, .. } = *vertex;
                assert!(
                    plan.yarn_bounds(&points, part.yarn as usize).holds(position),
                    "{name}: {position:?}"
                );
                let own = &mut exact[part.yarn as usize];
                *own = own.joined(&Bounds { low: position, high: position });
            }
        }
        assert!(
            (0..exact.len()).fold(Bounds::NOTHING, |all, yarn| all.joined(&plan.yarn_bounds(&points, yarn)))
                == plan.bounds(&points)
        );
        assert!(picker_of(&mesh, &yarns).bounds() == plan.bounds(&points));
        // Shapes that no cloth has may have control points far from their curves.
        if name == "all shapes" {
            continue;
        }
        for (yarn, exact) in exact.iter().enumerate() {
            let (bounds, section) = (plan.yarn_bounds(&points, yarn), plan.yarn(yarn).section);
            let widest = yarns
                .yarn_points(yarn)
                .unwrap()
                .iter()
                .map(|point| point.half_width().max(point.half_height()));
            let reach =
                plan.outline(section as usize).iter().map(|point| point.x.hypot(point.y)).fold(0.0, f32::max);
            let most = 2.0 * reach * widest.fold(0.0, f32::max);
            for axis in 0..3 {
                let excess = [exact.low[axis] - bounds.low[axis], bounds.high[axis] - exact.high[axis]];
                assert!(
                    excess.iter().all(|excess| *excess <= most),
                    "{name}: {bounds:?} around {exact:?}, {most}"
                );
            }
        }
    }
}

/// On a straight yarn with a point every millimetre, the interval and the place within it give the
/// distance along the yarn, mm.
#[test]
fn the_way_along_the_yarn_is_exact() {
    let mut yarns = Yarns::builder();
    let points: Vec<_> = (0..90).map(|x| ControlPoint::new(x as f32, 0.0, 0.0, 0.25)).collect();
    yarns.yarn(Yarn { twist: 3.0, ..Yarn::default() }, &points);
    let yarns = yarns.build().unwrap();
    let picker = picker_of(&mesh_of(&yarns, Settings { subdivisions: 2, ..Settings::default() }), &yarns);
    let mut chance = Chance(5);
    for _ in 0..2_000 {
        let origin = [chance.within(0.0, 89.0), 0.0, chance.within(1.0, 3.0)];
        let ray = Ray { origin, direction: [0.0, chance.within(-0.1, 0.1), -2.0] };
        let hit = picker.pick(&ray).unwrap();
        let along = f64::from(hit.interval) + hit.t;
        assert!((along - origin[0]).abs() < 1e-5, "{hit:?} at {}", origin[0]);
        assert!((hit.position[0] - origin[0]).abs() < 1e-9);
    }
}

/// Hits without stored indices equal those with them.
#[test]
fn hits_do_not_depend_on_the_topology() {
    let yarns = twisted();
    let settings = Settings { sides: 5, caps: true, ..Settings::default() };
    let indexed = mesh_of(&yarns, settings);
    let triangles = triangles(&indexed);
    let plan = Plan::new(yarns.layout().clone(), Settings { topology: Topology::None, ..settings }).unwrap();
    let pickers = [picker_of(&indexed, &yarns), Picker::new(Arc::new(plan), yarns.points()).unwrap()];
    let mut chance = Chance(3);
    for _ in 0..1_000 {
        let ray = ray(&triangles, &mut chance);
        assert_eq!(pickers[0].pick(&ray), pickers[1].pick(&ray));
    }
}

#[test]
fn rays_that_are_none_hit_nothing_and_wrong_yarns_are_refused() {
    let yarns = twisted();
    let settings = Settings { sides: 5, ..Settings::default() };
    let plan = Arc::new(Plan::new(yarns.layout().clone(), settings).unwrap());
    let mut picker = Picker::new(plan.clone(), yarns.points()).unwrap();
    let numbers = [0.0, -0.0, 1.0, 1e300, -1e-300, 5e-324, f64::MAX, f64::INFINITY, f64::NAN];
    for origin in numbers {
        for x in numbers {
            for z in numbers {
                let hit = picker.pick(&Ray { origin: [origin, 1.0, 9.0], direction: [x, 0.0, z] });
                let nowhere =
                    !(origin.is_finite() && x.is_finite() && z.is_finite()) || (x == 0.0 && z == 0.0);
                assert!(!(nowhere && hit.is_some()), "{hit:?}");
            }
        }
    }
    let points = yarns.yarn_points(1).unwrap();
    let wrong = |result: Result<(), PickError>| result.unwrap_err().to_string();
    assert!(matches!(
        Picker::new(plan.clone(), &points[1..]),
        Err(PickError::PointCount { points: 39, planned: 480 })
    ));
    let mut unsound = yarns.points().to_vec();
    unsound[50].z = f32::NAN;
    assert!(matches!(Picker::new(plan.clone(), &unsound), Err(PickError::Points(_))));
    assert!(matches!(
        picker.set_yarn(plan.clone(), 12, points),
        Err(PickError::NoYarn { yarn: 12, yarns: 12 })
    ));
    assert_eq!(
        wrong(picker.set_yarn(plan.clone(), 1, &points[1..])),
        "39 control points, but the plan has 40"
    );
    assert!(matches!(picker.set_yarn(plan.clone(), 1, &unsound[40..80]), Err(PickError::Points(_))));
    // Another plan of the same yarns is refused, and so is a plan in which another yarn is edited.
    let other = Arc::new(Plan::new(yarns.layout().clone(), settings).unwrap());
    let twice =
        plan.edited(0, *plan.yarn(0), &points[..20]).unwrap().edited(1, *plan.yarn(1), points).unwrap();
    for plan in [other, Arc::new(twice)] {
        assert!(matches!(picker.set_yarn(plan, 1, points), Err(PickError::OtherPlan { yarn: 1 })));
    }
    // Everything is as before.
    let fresh = Picker::new(plan, yarns.points()).unwrap();
    let down = Ray { origin: [5.0, 1.0, 9.0], direction: [0.0, 0.0, -1.0] };
    assert!(picker.pick(&down).is_some());
    assert_eq!(picker.pick(&down), fresh.pick(&down));
}
