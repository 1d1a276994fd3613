//! Layers of a picture, against the geometry of a single straight yarn and against single points.

use std::f32::consts::{PI, TAU};

use super::*;
use crate::Layers;

const RADIUS: f32 = 0.5;

/// Two yarns. Yarn 1 lies along x from 1 to 9 mm at y = 2 and z = 3, with four rings a millimetre.
/// Yarn 0 is out of sight.
fn straight() -> Yarns {
    let mut yarns = Yarns::builder();
    let other = [[0.0, -20.0, 0.0], [1.0, -20.0, 0.0]].map(|[x, y, z]| ControlPoint::new(x, y, z, RADIUS));
    yarns.yarn(Yarn::default(), &other);
    let points: Vec<_> = (1..10).map(|x| ControlPoint::new(x as f32, 2.0, 3.0, RADIUS)).collect();
    yarns.yarn(Yarn::default(), &points);
    yarns.build().unwrap()
}

fn layers_of(yarns: &Yarns, camera: impl FnOnce(&Extent) -> Camera, supersampling: u32) -> (Layers, Camera) {
    let renderer = renderer().lock().unwrap();
    let mut scene = renderer.scene(yarns, &Settings { sides: 64, ..SETTINGS }).unwrap();
    assert_eq!(scene.layers().unwrap(), None);
    let camera = camera(scene.extent());
    scene.picture(&camera, Quality { supersampling, hairs: false }).unwrap();
    let layers = scene.layers().unwrap().unwrap();
    let [width, height] = camera.size();
    for y in 0..height {
        for x in 0..width {
            let seen = scene.seen_at([x as f32 + 0.5, y as f32 + 0.5]).unwrap();
            let number = (y * width + x) as usize;
            assert_eq!(seen.map_or(Layers::NO_YARN, |seen| seen.yarn as u32), layers.yarn[number]);
            let position = seen.map_or([0.0; 3], |seen| seen.position.map(|mm| mm as f32));
            assert_eq!(position, layers.position[number]);
        }
    }
    (layers, camera)
}

#[test]
fn a_straight_yarn_has_the_layers_of_a_cylinder() {
    // With a supersampling of 1 a row has 101 samples of 20 bytes. That is no multiple of the 8
    // bytes to which copies are aligned.
    for (supersampling, size) in [(1, [101, 30]), (3, [20, 16])] {
        let yarns = straight();
        let look = |extent: &Extent| {
            let pose = crate::Pose { eye: [5.0, 2.0, 13.0], target: [5.0, 2.0, 3.0], up: [0.0, 1.0, 0.0] };
            Camera::orthographic(extent, &pose, 2.0, size).unwrap()
        };
        let (layers, camera) = layers_of(&yarns, look, supersampling);
        assert_eq!(layers.size, size);
        let mut seen = 0;
        for (number, yarn) in layers.yarn.iter().enumerate() {
            let [column, row] = [number as u32 % size[0], number as u32 / size[0]];
            let sight = camera.ray([column as f32 + 0.5, row as f32 + 0.5]);
            let y = sight.origin[1] as f32 - 2.0;
            if *yarn == Layers::NO_YARN {
                assert!(y.abs() > 0.9 * RADIUS || !(1.0..9.0).contains(&sight.origin[0]));
                assert!(layers.depth[number].is_infinite() && layers.normal[number] == [0.0; 3]);
                continue;
            }
            assert_eq!(*yarn, 1);
            // At the outline of the yarn, depth and normal change fast within a pixel.
            if y.abs() > 0.8 * RADIUS {
                continue;
            }
            seen += 1;
            let z = (RADIUS * RADIUS - y * y).sqrt();
            let near = |got: f32, expected: f32, by: f32| {
                assert!((got - expected).abs() < by, "{got}, not {expected}, at {column} {row}");
            };
            let [_, at_y, at_z] = layers.position[number];
            near(at_y, y + 2.0, 0.07);
            near(at_z, 3.0 + z, 0.07);
            near(layers.depth[number], sight.origin[2] as f32 - at_z, 1e-4);
            let normal = [0.0, y / RADIUS, z / RADIUS];
            (0..3).for_each(|axis| near(layers.normal[number][axis], normal[axis], 0.15));
            (0..3).for_each(|axis| near(layers.tangent[number][axis], [1.0, 0.0, 0.0][axis], 1e-3));
            near(layers.uv[number][1], 4.0 * (sight.origin[0] as f32 - 1.0), 0.7);
            // The angle counts from the first corner. In an upright section it lies towards z × t,
            // where t is the yarn's direction: towards +y.
            let angle = z.atan2(y).rem_euclid(TAU);
            near((layers.uv[number][0] - angle + PI).rem_euclid(TAU), PI, 0.3);
        }
        assert!(seen > 50, "{seen} pixels");
    }
}

#[test]
fn a_twill_in_perspective_shows_the_yarns_of_single_points() {
    let (layers, camera) =
        layers_of(&TWILL.yarns(), |extent| Camera::oblique(extent, 0.4, [63, 47]).unwrap(), 2);
    let mut shown = 0;
    for (number, position) in layers.position.iter().enumerate() {
        if layers.yarn[number] == Layers::NO_YARN {
            continue;
        }
        shown += 1;
        let [x, y] = [number % 63, number / 63].map(|pixel| (pixel as f32 * 2.0 + 1.5) / 2.0);
        let sight = camera.ray([x, y]);
        let along = sight.at(f64::from(layers.depth[number]));
        (0..3).for_each(|axis| assert!((along[axis] - f64::from(position[axis])).abs() < 1e-3));
        let facing: f64 =
            (0..3).map(|axis| sight.direction[axis] * f64::from(layers.normal[number][axis])).sum();
        assert!(facing < 0.35, "a normal points away from the eye: {facing}");
    }
    assert!(shown > 1000, "{shown} pixels");
}
