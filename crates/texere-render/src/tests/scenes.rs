//! Free cameras, backgrounds, and several cloths in one scene.

use std::f64::consts::FRAC_PI_3;
use std::sync::Arc;

use glam::DVec3;
use texere_core::backend::Plan;
use texere_core::{
    ControlPoint, DeviceInfo, DeviceKind, Layout, Limits, Placement, Ray, Settings, Topology, Yarn, Yarns,
};
use texere_cpu::Picker;

use super::{SETTINGS, SIZE, TWILL, renderer, two_yarns};
use crate::raster::{ROLL_BYTES, Raster};
use crate::{Background, Camera, Extent, Picture, Pose, Quality, RenderError, Scene};

/// Two cloths with warp in red and green and weft in blue. The second lies beside the first, turned
/// and larger.
fn cloths() -> Yarns {
    let twill = TWILL.yarns();
    let mut colored = Yarns::builder();
    for srgb in [[255, 0, 0], [0, 255, 0], [0, 0, 255]] {
        colored.material(texere_core::Material { srgb, ..Default::default() });
    }
    twill.layout().sections().iter().for_each(|section| {
        colored.section(section.clone());
    });
    for number in 0..twill.layout().yarns().len() {
        let yarn: &Yarn = &twill.layout().yarns()[number];
        colored.yarn(*yarn, twill.yarn_points(number).unwrap());
    }
    let one = colored.build().unwrap();
    let other = one.placed(&Placement { turn: FRAC_PI_3, scale: 1.5, at: [22.0, -4.0, 1.0] }).unwrap();
    Yarns::merged([&one, &other]).unwrap()
}

fn drawn(yarns: &Yarns, camera: &Camera, background: Background) -> Picture {
    let renderer = renderer().lock().unwrap();
    let mut scene = renderer.scene(yarns, &SETTINGS).unwrap();
    scene.set_background(background);
    scene.picture(camera, Quality { supersampling: 1, ..Quality::default() }).unwrap()
}

/// Views from aside, from near with a wide field and a tilted head, from below, and along parallel
/// lines.
fn cameras(extent: &Extent) -> [(&'static str, Camera); 4] {
    let pose = |eye, target, up| Pose { eye, target, up };
    let aside = pose([30.0, -25.0, 22.0], [13.0, 3.0, 0.0], [0.0, 0.0, 1.0]);
    let near = pose([4.0, 2.0, 3.0], [6.5, 4.5, 0.0], [0.3, 0.2, 1.0]);
    let below = pose([10.0, -14.0, -24.0], [12.0, 4.0, 0.0], [0.0, 1.0, 0.0]);
    [
        ("aside", Camera::perspective(extent, &aside, 0.6, SIZE).unwrap()),
        ("near", Camera::perspective(extent, &near, 1.4, SIZE).unwrap()),
        ("below", Camera::perspective(extent, &below, 0.7, SIZE).unwrap()),
        ("parallel", Camera::orthographic(extent, &aside, 16.0, SIZE).unwrap()),
    ]
}

/// Away from edges, a pixel has the colour of the material that a picker finds along its line of
/// sight, or shows nothing if the picker finds nothing. The picture and the picker share nothing
/// but the camera.
#[test]
fn a_pixel_shows_the_yarn_that_its_ray_hits() {
    let yarns = cloths();
    let layout: &Arc<Layout> = yarns.layout();
    let settings = Settings { topology: Topology::None, caps: true, ..SETTINGS };
    let plan = Arc::new(Plan::new(layout.clone(), settings).unwrap());
    let picker = Picker::new(plan, yarns.points()).unwrap();
    let material = |ray: &Ray| picker.pick(ray).map(|hit| layout.yarns()[hit.place.yarn as usize].material);
    for (name, camera) in cameras(&Extent::of(&yarns)) {
        let picture = drawn(&yarns, &camera, Background::Nothing);
        let mut seen = [0; 4];
        for (x, y) in (0..SIZE[1]).step_by(3).flat_map(|y| (0..SIZE[0]).step_by(3).map(move |x| (x, y))) {
            // The corners of a pixel, and the places of its four samples.
            let within = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].into_iter();
            let within = within.chain([[0.375, 0.125], [0.875, 0.375], [0.125, 0.625], [0.625, 0.875]]);
            let hit = |[right, down]: [f32; 2]| material(&camera.ray([x as f32 + right, y as f32 + down]));
            let hits: Vec<_> = within.map(hit).collect();
            if hits.iter().any(|hit| *hit != hits[0]) {
                continue; // an edge
            }
            let pixel = (y * SIZE[0] + x) as usize;
            let rgb: [u8; 3] = picture.rgb[3 * pixel..][..3].try_into().unwrap();
            match hits[0] {
                Some(material) => {
                    let material = material as usize;
                    assert!(rgb.iter().all(|&channel| channel <= rgb[material]), "{name} {x} {y}: {rgb:?}");
                    assert!(picture.alpha[pixel] == 255 && rgb[material] > 0, "{name} {x} {y}: {rgb:?}");
                    seen[material] += 1;
                }
                None => {
                    assert_eq!(picture.alpha[pixel], 0, "{name} {x} {y}");
                    seen[3] += 1;
                }
            }
        }
        assert!(seen.iter().all(|&count| count > 20), "{name}: {seen:?}");
    }
}

/// The yarn and the place that a picture gives for a point are those that the line of sight hits.
#[test]
fn what_is_seen_at_a_point_is_what_its_ray_hits() {
    let yarns = cloths();
    let settings = Settings { topology: Topology::None, caps: true, ..SETTINGS };
    let picker =
        Picker::new(Arc::new(Plan::new(yarns.layout().clone(), settings).unwrap()), yarns.points()).unwrap();
    let renderer = renderer().lock().unwrap();
    let mut scene = renderer.scene(&yarns, &SETTINGS).unwrap();
    assert_eq!(scene.seen_at([1.0, 1.0]).unwrap(), None, "before the first picture");
    for (name, camera) in cameras(&Extent::of(&yarns)) {
        for supersampling in [1, 2] {
            scene.frame(&camera, Quality { supersampling, ..Quality::default() }).unwrap();
            let (mut yarns_seen, mut nothing_seen) = (0, 0);
            for (x, y) in (2..SIZE[1])
                .step_by(9)
                .flat_map(|y| (2..SIZE[0]).step_by(9).map(move |x| (x as f32, y as f32)))
            {
                let hit = |[right, down]: [f32; 2]| picker.pick(&camera.ray([x + right, y + down]));
                let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(hit);
                let yarn = |hit: &Option<texere_cpu::Hit>| hit.map(|hit| hit.place.yarn);
                if corners.iter().any(|corner| yarn(corner) != yarn(&corners[0])) {
                    continue; // an edge
                }
                let seen = scene.seen_at([x + 0.5, y + 0.5]).unwrap();
                assert_eq!(seen.map(|seen| seen.yarn as u32), yarn(&corners[0]), "{name} {x} {y}");
                let (Some(seen), [Some(a), Some(b), Some(c), Some(d)]) = (seen, corners) else {
                    nothing_seen += 1;
                    continue;
                };
                yarns_seen += 1;
                let [a, b, c, d] = [a, b, c, d].map(|hit| DVec3::from(hit.position));
                let across = a.distance(d).max(b.distance(c));
                let off = (a + b + c + d) / 4.0 - DVec3::from(seen.position);
                assert!(off.length() <= 0.75 * across, "{name} {x} {y}: {off}, a pixel is {across}");
            }
            assert!(yarns_seen > 20 && nothing_seen > 20, "{name}: {yarns_seen}, {nothing_seen}");
        }
    }
    for outside in [[-0.5, 3.0], [3.0, SIZE[1] as f32], [f32::NAN, 3.0], [f32::INFINITY, 3.0]] {
        assert_eq!(scene.seen_at(outside).unwrap(), None, "{outside:?}");
    }
}

/// A scene may take over the screen that another scene of its renderer has drawn to, but not while
/// that scene still holds it.
#[test]
fn a_scene_keeps_its_picture_while_others_are_drawn() {
    let renderer = renderer().lock().unwrap();
    let (twill, others) = (TWILL.yarns(), cloths());
    let camera = Camera::face(&Extent::of(&twill), [40, 24]);
    let scene = |yarns| renderer.scene(yarns, &SETTINGS).unwrap();
    let seen = |scene: &Scene| [4.5, 12.5, 20.5, 28.5].map(|x| scene.seen_at([x, 12.5]).unwrap());
    let mut first = scene(&twill);
    first.frame(&camera, Quality { supersampling: 1, ..Quality::default() }).unwrap();
    let before = seen(&first);
    assert!(before.iter().any(Option::is_some));
    let mut beside = scene(&others);
    let aside = Camera::face(beside.extent(), [40, 24]);
    beside.frame(&aside, Quality { supersampling: 1, ..Quality::default() }).unwrap();
    assert_eq!(seen(&first), before);
    assert_ne!(seen(&beside), before);
    // The samples that a dropped scene has left in the screen are not seen.
    drop((first, beside));
    let mut last = scene(&twill);
    last.frame(&camera, Quality { supersampling: 1, ..Quality::default() }).unwrap();
    assert_eq!(seen(&last), before);
}

/// Where a pixel of the screen has its first sample if threads are finer than pixels. The
/// arithmetic is that of `sample_in` in `view.wgsl`.
fn shifted_sample(x: u32, y: u32) -> [f32; 2] {
    let mixed = x.wrapping_mul(1_597_334_677) ^ y.wrapping_mul(3_812_015_801);
    let hash = (mixed ^ (mixed >> 16)).wrapping_mul(2_246_822_519);
    let within = [(96 + (hash >> 24)) % 256, (32 + (hash >> 18) % 64) % 64];
    [(x, within[0]), (y, within[1])].map(|(pixel, within)| pixel as f32 + within as f32 / 256.0)
}

/// If threads are finer than pixels, each pixel has its samples at places of its own. A sample
/// there shows the yarn that a ray through it hits.
#[test]
fn threads_finer_than_pixels_are_seen_where_rays_hit_them() {
    let yarns = cloths();
    let settings = Settings { topology: Topology::None, caps: true, ..SETTINGS };
    let picker =
        Picker::new(Arc::new(Plan::new(yarns.layout().clone(), settings).unwrap()), yarns.points()).unwrap();
    let extent = Extent::of(&yarns);
    let size = [48, 32];
    let whole = Camera::face(&extent, size);
    for camera in [&whole, &Camera::oblique(&extent, 0.3, size).unwrap()] {
        let renderer = renderer().lock().unwrap();
        let mut scene = renderer.scene(&yarns, &SETTINGS).unwrap();
        scene.frame(camera, Quality { supersampling: 1, ..Quality::default() }).unwrap();
        let (mut alike, mut others) = (0, 0);
        for (x, y) in (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y))) {
            let hit = picker.pick(&camera.ray(shifted_sample(x, y))).map(|hit| hit.place.yarn as usize);
            let seen = scene.seen_at([x as f32 + 0.5, y as f32 + 0.5]).unwrap().map(|seen| seen.yarn);
            *if hit == seen { &mut alike } else { &mut others } +=
                usize::from(hit.is_some() || seen.is_some());
        }
        // Corners are rounded to 1/256 of a pixel, so some samples on an edge fall to its other
        // side.
        assert!(alike > 250 && others * 50 < alike, "{alike} {others}");
    }
}

/// The matrix and the lines of sight agree on the pixel of a point.
#[test]
fn a_point_on_a_ray_lies_at_its_pixel() {
    for (name, camera) in cameras(&Extent::of(&cloths())) {
        let matrix = camera.clip_from_cloth();
        for pixel in [[0.0, 0.0], [SIZE[0] as f32, 11.5], [97.25, SIZE[1] as f32], [120.0, 90.0]] {
            for distance in [3.0, 20.0, 50.0] {
                let [x, y, z] = camera.ray(pixel).at(distance);
                let clip: [f64; 4] = std::array::from_fn(|row| {
                    matrix[0][row] * x + matrix[1][row] * y + matrix[2][row] * z + matrix[3][row]
                });
                let across = (clip[0] / clip[3] + 1.0) / 2.0 * f64::from(SIZE[0]);
                let down = (1.0 - clip[1] / clip[3]) / 2.0 * f64::from(SIZE[1]);
                let off = (across - f64::from(pixel[0])).abs() + (down - f64::from(pixel[1])).abs();
                assert!(off < 1e-3, "{name} {pixel:?}: {across} {down}");
            }
        }
    }
}

#[test]
fn backgrounds_change_no_pixel_that_is_all_yarn() {
    let yarns = cloths();
    let (_, camera) = cameras(&Extent::of(&yarns)).into_iter().next().unwrap();
    let [ground, plum, nothing] = [Background::Ground, Background::Color([120, 40, 90]), Background::Nothing]
        .map(|background| drawn(&yarns, &camera, background));
    assert!(ground.alpha.iter().chain(&plum.alpha).all(|&alpha| alpha == 255));
    let (mut yarn, mut mixed, mut empty) = (0, 0, 0);
    for (pixel, &alpha) in nothing.alpha.iter().enumerate() {
        let rgb = |picture: &Picture| <[u8; 3]>::try_from(&picture.rgb[3 * pixel..][..3]).unwrap();
        match alpha {
            255 => {
                yarn += 1;
                assert_eq!([rgb(&plum), rgb(&nothing)], [rgb(&ground); 2]);
            }
            0 => {
                empty += 1;
                assert_eq!([rgb(&plum), rgb(&nothing)], [[120, 40, 90], [0; 3]]);
            }
            _ => mixed += 1,
        }
    }
    assert!(yarn > 4000 && mixed > 300 && empty > 4000, "{yarn} {mixed} {empty}");
    assert_eq!(nothing.rgba()[..4], [0; 4]);
}

#[test]
fn eyes_that_see_nothing_are_refused() {
    let extent = Extent::of(&two_yarns());
    let good = Pose { eye: [0.0, 0.0, 9.0], target: [0.0; 3], up: [0.0, 1.0, 0.0] };
    assert!(Camera::perspective(&extent, &good, 0.5, SIZE).is_ok());
    let poses = [
        Pose { eye: [0.0; 3], ..good },
        Pose { eye: [f32::NAN, 0.0, 9.0], ..good },
        Pose { eye: [0.0, 0.0, f32::MAX], target: [0.0, 0.0, f32::MIN], ..good },
        Pose { target: [0.0, f32::INFINITY, 0.0], ..good },
        Pose { up: [0.0, 0.0, 3.0], ..good },
        Pose { up: [0.0; 3], ..good },
        Pose { up: [f32::NAN; 3], ..good },
    ];
    for pose in poses {
        for refused in
            [Camera::perspective(&extent, &pose, 0.5, SIZE), Camera::orthographic(&extent, &pose, 4.0, SIZE)]
        {
            assert!(matches!(refused, Err(RenderError::Camera { .. })), "{pose:?}");
        }
    }
    for value in [0.0, -1.0, 3.15, f32::NAN, f32::INFINITY] {
        let refused = Camera::perspective(&extent, &good, value, SIZE);
        assert!(matches!(refused, Err(RenderError::Camera { .. })), "{value}");
    }
    for value in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        let refused = Camera::orthographic(&extent, &good, value, SIZE);
        assert!(matches!(refused, Err(RenderError::Camera { .. })), "{value}");
    }
}

/// A chunk's control points are bound as one piece, and so are the rolls of its rings. Both must
/// fit, whatever yarns the chunk is cut from.
#[test]
fn chunks_of_pictures_fit_a_binding() {
    const BYTES: u64 = 1 << 17;
    let info = renderer().lock().unwrap().info().clone();
    // Yarns of all lengths, and then yarns that have as many points as fit one block: 63 closed and
    // 64 open without subdivisions, 31 closed with one, 8 open with seven.
    let counts = [&[3, 64, 65, 66, 130, 500, 4, 3, 3, 2000][..], &[63], &[64], &[31], &[8]];
    for (counts, closed) in counts.iter().flat_map(|counts| [(counts, false), (counts, true)]) {
        let mut yarns = Yarns::builder();
        for &count in counts.iter().cycle().take(400) {
            let points: Vec<_> = (0..count).map(|x| ControlPoint::new(x as f32, 0.0, 0.0, 0.1)).collect();
            yarns.yarn(Yarn { closed, ..Yarn::default() }, &points);
        }
        let yarns = yarns.build().unwrap();
        for subdivisions in [0, 1, 7, 200] {
            let settings = Settings { subdivisions, ..SETTINGS };
            let plan = Plan::new(yarns.layout().clone(), settings).unwrap();
            let kind = DeviceKind::DiscreteGpu;
            let limits = Limits { binding_bytes: BYTES, ..Limits::NONE };
            let device = DeviceInfo { kind, limits, ..info.clone() };
            let limits = Raster::chunk_limits(&plan, &yarns, &device);
            for chunk in plan.chunks(&limits).unwrap() {
                let window = chunk.window();
                let points = (window.end - window.start) * size_of::<ControlPoint>() as u64;
                let rolls = ROLL_BYTES * u64::from(chunk.rings());
                assert!(points.max(rolls) <= BYTES, "{counts:?} {closed} {subdivisions}: {points}, {rolls}");
            }
        }
    }
}

/// A yarn that is seen from outside is drawn only on its outside. A yarn that the near plane goes
/// through is seen from inside.
#[test]
fn an_eye_in_a_yarn_sees_its_wall() {
    let mut yarns = Yarns::builder();
    let points: Vec<_> = (0..=20).map(|x| ControlPoint::new(x as f32, 0.0, 0.0, 1.0)).collect();
    yarns.yarn(Yarn::default(), &points);
    let yarns = yarns.build().unwrap();
    let extent = Extent::of(&yarns);
    let camera =
        |eye, target, up| Camera::perspective(&extent, &Pose { eye, target, up }, 1.0, SIZE).unwrap();
    let along = camera([10.0, 0.0, 0.0], [12.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
    // The near plane lies a millimetre before the eye, half a millimetre deep in the yarn.
    let down = camera([10.0, 0.0, 1.5], [10.0, 0.0, -48.5], [0.0, 1.0, 0.0]);
    for (name, camera) in [("along", along), ("down", down)] {
        let alpha = drawn(&yarns, &camera, Background::Nothing).alpha;
        assert!(alpha.iter().all(|&alpha| alpha == 255), "{name}");
    }
    let above = camera([10.0, 0.0, 2.6], [10.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    assert!(!above.sees_inside());
    let corner = drawn(&yarns, &above, Background::Nothing).alpha[0];
    assert_eq!(corner, 0);
}

/// Splines reach past their control points, and the near plane must not cut them there.
#[test]
fn a_crest_past_its_control_points_is_whole() {
    let mut yarns = Yarns::builder();
    let points = [(0.0, 0.0), (1.0, 2.0), (2.0, 2.0), (3.0, 0.0)];
    yarns.yarn(Yarn::default(), &points.map(|(x, z)| ControlPoint::new(x, 0.0, z, 0.1)));
    let yarns = yarns.build().unwrap();
    let extent = Extent::of(&yarns);
    let pose = Pose { eye: [1.5, 0.0, 40.0], target: [1.5, 0.0, 2.0], up: [0.0, 1.0, 0.0] };
    let perspective = Camera::perspective(&extent, &pose, 0.02, SIZE).unwrap();
    let parallel = Camera::orthographic(&extent, &pose, 0.8, SIZE).unwrap();
    for (name, camera) in [("perspective", perspective), ("parallel", parallel)] {
        let alpha = drawn(&yarns, &camera, Background::Nothing).alpha;
        let [width, height] = SIZE.map(|pixels| pixels as usize);
        assert_eq!(alpha[height / 2 * width + width / 2], 255, "{name}");
    }
}
