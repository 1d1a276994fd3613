//! Fibres that stand off yarns have the length that the yarns' hairiness asks for, are the same in
//! every picture, and are left out where they would not be seen.

use std::f64::consts::PI;

use texere_core::{ControlPoint, Limits, Material, Settings, Yarn, Yarns};

use super::{ENDS, PICKS, SETTINGS, SIZE, TWILL, cameras, draw, flattened, open, renderer};
use crate::rasteriser::{Keys, Rasteriser};
use crate::{Background, Camera, Extent, Picture, Pose, Quality, Renderer};

/// A cotton fibre's width, mm: `HAIR_WIDTH` of `hair.wgsl`.
const WIDTH_MM: f64 = 0.012;

/// A copy of `yarns` with this hairiness.
pub(super) fn hairy(yarns: &Yarns, hairiness: f32) -> Yarns {
    let mut hairy = yarns.clone();
    let materials = yarns.materials().iter().map(|material| Material { hairiness, ..material.clone() });
    hairy.set_materials(materials.collect()).unwrap();
    hairy
}

fn drawn(renderer: &Renderer, yarns: &Yarns, camera: &Camera, quality: Quality) -> Picture {
    let mut scene = renderer.scene(yarns, &SETTINGS).unwrap();
    scene.set_background(Background::Nothing);
    scene.picture(camera, quality).unwrap()
}

const PLAIN: Quality = Quality { supersampling: 1, hairs: true };

#[test]
fn only_yarns_with_hairs_have_them_and_only_where_they_are_wanted() {
    let renderer = renderer().lock().unwrap();
    for yarns in [TWILL.yarns(), flattened(&TWILL.yarns())] {
        let hairy = hairy(&yarns, 8.0);
        for (name, camera) in cameras(&Extent::of(&yarns)) {
            let bald = drawn(&renderer, &yarns, &camera, PLAIN).rgb;
            // A cut shows no hairs.
            assert_eq!(drawn(&renderer, &hairy, &camera, PLAIN).rgb != bald, name != "cut", "{name}");
            assert!(
                drawn(&renderer, &hairy, &camera, Quality { hairs: false, ..PLAIN }).rgb == bald,
                "{name}"
            );
        }
    }
}

/// Hairs are left out if threads are less than four pixels wide, and drawn if they are wider.
#[test]
fn hairs_are_not_seen_from_afar() {
    let renderer = renderer().lock().unwrap();
    let yarns = TWILL.yarns();
    let (hairy, extent) = (hairy(&yarns, 8.0), Extent::of(&yarns));
    let width = 2.0 * extent.radius;
    for (pixels, is_seen) in [(3.9, false), (4.1, true)] {
        let camera = Camera::true_scale(&extent, width / pixels).unwrap();
        let [bald, hairy] = [&yarns, &hairy].map(|yarns| drawn(&renderer, yarns, &camera, PLAIN).rgb);
        assert_eq!(bald != hairy, is_seen, "{pixels}");
    }
}

/// Hairs are the same however the fabric is cut into chunks and the screen into bands, with either
/// kind of atomics, and in every run.
#[test]
fn hairs_are_the_same_in_every_picture() {
    let whole = renderer().lock().unwrap();
    let in_rounds = open(Rasteriser::new(Keys::InRounds));
    let few = Limits { binding_bytes: 1 << 16, ..Limits::NONE };
    let in_bands =
        Renderer::with_rasteriser(whole.backend().clone().with_limits(few), Rasteriser::new(Keys::Whole))
            .unwrap();
    let long = Settings { subdivisions: 11, ..SETTINGS };
    for yarns in [TWILL.yarns(), flattened(&TWILL.yarns())].map(|yarns| hairy(&yarns, 8.0)) {
        for (name, camera) in cameras(&Extent::of(&yarns)).into_iter().skip(2) {
            let one = draw(&whole, &yarns, &camera, &Limits::NONE);
            for (renderer, what) in [(&*whole, "again"), (&in_rounds, "in rounds"), (&in_bands, "in bands")] {
                assert!(one == draw(renderer, &yarns, &camera, &Limits::NONE), "{name} {what}");
            }
            // A chunk has one block and the ring that it repeats, so every yarn of more than 64
            // rings is cut into several chunks.
            let cut = |limits: &Limits| {
                let mut scene = whole.scene(&yarns, &long).unwrap().with_limits(limits);
                assert!(scene.plan().rings(0) > 64);
                scene.picture(&camera, PLAIN).unwrap().rgb
            };
            assert!(cut(&Limits::NONE) == cut(&Limits { blocks: 2, ..Limits::NONE }), "{name} in chunks");
        }
    }
}

/// Where a hair has come into the picture, the picture gives a yarn, and a place no farther from
/// that yarn than a hair reaches.
#[test]
fn a_hair_is_seen_as_its_yarn() {
    let renderer = renderer().lock().unwrap();
    let yarns = hairy(&TWILL.yarns(), 20.0);
    let mut scene = renderer.scene(&yarns, &SETTINGS).unwrap();
    let camera = Camera::face(scene.extent(), SIZE);
    let seen = |scene: &crate::Scene| {
        let places = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| [x as f32 + 0.5, y as f32 + 0.5]));
        places.step_by(7).map(|at| scene.seen_at(at).unwrap()).collect::<Vec<_>>()
    };
    scene.frame(&camera, Quality { hairs: false, ..PLAIN }).unwrap();
    let bald = seen(&scene);
    scene.frame(&camera, PLAIN).unwrap();
    let (mut beside, mut over) = (0, 0);
    for (bald, hairy) in bald.iter().zip(seen(&scene)) {
        let Some(hairy) = hairy else {
            assert!(bald.is_none());
            continue;
        };
        assert!(hairy.yarn < ENDS + PICKS);
        // No hair is longer than two and a half millimetres, and the nearest control point of its
        // yarn is no farther from its root than one millimetre.
        let points = yarns.yarn_points(hairy.yarn).unwrap();
        let off =
            points.iter().map(|point| point.position().distance(hairy.position.map(|at| at as f32).into()));
        assert!(off.fold(f32::MAX, f32::min) < 3.5);
        match bald {
            None => beside += 1,
            Some(bald) if bald != &hairy => over += 1,
            Some(_) => {}
        }
    }
    assert!(beside > 20 && over > 20, "{beside} {over}");
}

/// By Cauchy's and Crofton's formula, a curve that is seen from all sides appears pi / 4 times as
/// long as it is, in the mean. The area that hairs cover in pictures is thus their length times pi
/// / 4 of their width, however they bend. The yarns that they stand off are so thin that they hide
/// nothing.
#[test]
fn hairs_are_as_long_as_their_yarn_says() {
    const VIEWS: u32 = 5;
    const YARNS: u32 = 6;
    const LENGTH: u32 = 40;
    const APART: f32 = 5.5;
    const PER_MM: f32 = 24.0;
    const HAIRINESS: f32 = 3.0;
    let yarns = |hairiness| {
        let mut yarns = Yarns::builder();
        yarns.material(Material { hairiness, ..Material::default() });
        yarns.material(Material::default());
        for yarn in 0..YARNS {
            let points = (0..=LENGTH).map(|x| ControlPoint::new(x as f32, yarn as f32 * APART, 0.0, 0.004));
            yarns.yarn(Yarn { twist: 0.5, ..Yarn::default() }, &points.collect::<Vec<_>>());
        }
        // This yarn is out of sight. It is so wide that hairs are shown.
        let points = (0..=YARNS * LENGTH).map(|x| ControlPoint::new(x as f32, 200.0, 0.0, 0.5));
        yarns.yarn(Yarn { material: 1, ..Yarn::default() }, &points.collect::<Vec<_>>());
        yarns.build().unwrap()
    };
    let middle = [LENGTH as f32 / 2.0, (YARNS - 1) as f32 * APART / 2.0, 0.0];
    let size = [(LENGTH as f32 + 6.0) * PER_MM, (YARNS as f32 * APART) * PER_MM].map(|pixels| pixels as u32);
    let renderer = renderer().lock().unwrap();
    let extent = Extent::of(&yarns(0.0));
    // Hairs stand off in the same way all round. Directions in even steps, from across the yarns to
    // along them, therefore stand for all directions.
    let cameras: Vec<_> = (0..VIEWS)
        .map(|view| {
            let cosine = (view as f32 + 0.5) / VIEWS as f32;
            let eye = [middle[0] + 100.0 * cosine, middle[1], 100.0 * (1.0 - cosine * cosine).sqrt()];
            let pose = Pose { eye, target: middle, up: [0.0, 1.0, 0.0] };
            Camera::orthographic(&extent, &pose, size[1] as f32 / PER_MM, size).unwrap()
        })
        .collect();
    let covered = |hairiness| {
        let yarns = yarns(hairiness);
        let area = |camera: &Camera| {
            let alpha = drawn(&renderer, &yarns, camera, PLAIN).alpha;
            alpha.iter().map(|&alpha| f64::from(alpha)).sum::<f64>() / 255.0 / f64::from(PER_MM * PER_MM)
        };
        cameras.iter().map(area).sum::<f64>() / f64::from(VIEWS)
    };
    let hairs_mm = (covered(HAIRINESS) - covered(0.0)) / WIDTH_MM * 4.0 / PI;
    let said_mm = f64::from(HAIRINESS) * f64::from(YARNS * LENGTH);
    println!("{hairs_mm:.1} mm of hairs, {said_mm} said");
    // There are some thirteen hundred hairs, whose lengths scatter by nine tenths of their mean,
    // and some hairs cover others.
    assert!((hairs_mm / said_mm - 1.0).abs() < 0.06, "{hairs_mm} {said_mm}");
}
