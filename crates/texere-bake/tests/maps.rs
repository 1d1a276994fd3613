//! What maps show: they have the cloth's size and colours, show its gaps on both sides, and look
//! like the geometry under the same light.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test may panic")]

mod cloth;

use std::ops::ControlFlow;

use cloth::{JERSEY, TWILL, baked, design, renderer};
use texere_bake::{BakeError, BakeOptions, Maps, bake};
use texere_core::{Origin, Settings};
use texere_cpu::ParallelBackend;
use texere_render::{Camera, Layers};

#[test]
fn maps_have_the_size_and_the_yarns_of_the_repeat() {
    let material = baked(TWILL, &BakeOptions::default().texel_mm(0.02));
    // The weave repeats after three threads, and the colours of the warp after two: six ends and
    // three picks.
    let size = [60.0 / 22.0, 30.0 / 18.0];
    for (maps, axis) in [(&material.front, 0), (&material.front, 1), (&material.back, 0)] {
        assert!((maps.size_mm[axis] - size[axis]).abs() < 1e-6, "{:?}", maps.size_mm);
        assert_eq!(maps.size[axis], (size[axis] / 0.02).round() as u32);
    }
    let front = &material.front;
    let mut seen: Vec<_> = front
        .yarn
        .iter()
        .filter(|&&yarn| yarn != Maps::NO_YARN)
        .map(|&yarn| front.yarns[yarn as usize].0)
        .collect();
    seen.sort_by_key(ToString::to_string);
    seen.dedup();
    let expected: Vec<_> = (1..=6).map(Origin::End).chain((1..=3).map(Origin::Pick)).collect();
    assert_eq!(seen, expected);
    // The red of a texel that is full of yarn lies between the reds of the two colours.
    for (at, &yarn) in front.yarn.iter().enumerate() {
        if front.alpha[at] == 1.0 && yarn != Maps::NO_YARN {
            let red = front.color[at][0];
            let (first, second) = (0.352_f32, 0.807_f32);
            assert!((first - 1e-2..=second + 1e-2).contains(&red), "{red}");
        }
    }
    // The weight is tex over spacing, for warp and weft together. Crimp adds to it.
    let flat = 2.2 * (30.0 + 40.0) / 2.0 + 1.8 * 40.0;
    let weight = material.weight.unwrap();
    assert!(weight > flat && weight < 1.3 * flat, "{weight} g/m² for {flat} and crimp");
    assert!(material.is_woven && material.thickness_mm > 0.3);
}

/// The gaps of the back are those of the face, with left and right exchanged. The maps are drawn in
/// more than one piece.
#[test]
fn gaps_go_through() {
    let material = baked(TWILL, &BakeOptions::default().texel_mm(0.008));
    let (front, back) = (&material.front, &material.back);
    assert_eq!(front.size, back.size);
    let [width, height] = front.size.map(|texels| texels as usize);
    assert!(width > 256);
    let mut off = 0;
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        let [one, other] = [front.alpha[y * width + x], back.alpha[y * width + width - 1 - x]];
        off += usize::from((one - other).abs() > 0.3);
    }
    let open = front.alpha.iter().filter(|alpha| **alpha == 0.0).count();
    assert!(open > width * height / 50, "{open} open texels");
    assert!(off < width * height / 500, "{off} of {} texels differ", width * height);
}

/// A linear colour under Lambert's light, dimmed by `alpha`. The result is linear, too.
fn lit(color: [f32; 3], normal: [f32; 3], alpha: f32) -> [f32; 3] {
    let light = [-0.48_f32, 0.36, 0.8];
    let cosine = normal.iter().zip(light).map(|(axis, light)| axis * light).sum::<f32>().max(0.0);
    color.map(|linear| linear * (0.15 + 0.85 * cosine) * alpha)
}

/// Linear colours as sRGB bytes.
fn bytes(linear: &[[f32; 3]]) -> Vec<u8> {
    let encoded = |linear: f32| {
        let value =
            if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
        (value * 255.0).round() as u8
    };
    linear.iter().flat_map(|pixel| pixel.map(encoded)).collect()
}

/// Under the same light, the maps look like the geometry. The geometry is drawn with sixteen
/// samples a pixel, which are averaged after they are lit. The mean of FLIP (Andersson et al. 2020)
/// is .009 for the twill and .015 for the jersey.
#[test]
fn maps_look_like_the_geometry() {
    for (name, text) in [("twill", TWILL), ("jersey", JERSEY)] {
        let (low, size) = ([1.0, 1.0], [1.2, 0.9]);
        let options = BakeOptions::default().area(low, size).texel_mm(0.01);
        let maps = baked(text, &options).front;
        let device = ParallelBackend::open().unwrap();
        let resting = design(text).rest(&device).run().unwrap();
        let yarns = resting.yarns();
        let settings = Settings { sides: 24, ..Settings::of(yarns) }.following_fibres(yarns);
        // No other test can use the device while this test holds it.
        let renderer = renderer();
        let mut scene = renderer.scene(yarns, &settings).unwrap();
        let fine = maps.size.map(|texels| texels * 4);
        let camera =
            Camera::plan(scene.extent(), low.map(|mm| mm as f32), size.map(|mm| mm as f32), fine).unwrap();
        let layers = scene.view_layers(&camera, |_| ControlFlow::Continue(())).unwrap();
        let mut geometry = vec![[0.0_f32; 3]; maps.alpha.len()];
        for (at, yarn) in layers.yarn.iter().enumerate().filter(|(_, yarn)| **yarn != Layers::NO_YARN) {
            let [x, y] = [at % fine[0] as usize / 4, at / fine[0] as usize / 4];
            let material = yarns.layout().yarns()[*yarn as usize].material;
            let color = yarns.materials()[material as usize].linear_rgb();
            let pixel = &mut geometry[y * maps.size[0] as usize + x];
            for (sum, part) in pixel.iter_mut().zip(lit(color, layers.normal[at], 1.0)) {
                *sum += part / 16.0;
            }
        }
        let plane: Vec<[f32; 3]> =
            (0..maps.alpha.len()).map(|at| lit(maps.color[at], maps.normal[at], maps.alpha[at])).collect();
        let [one, other] = [bytes(&geometry), bytes(&plane)]
            .map(|pixels| nv_flip::FlipImageRgb8::with_data(maps.size[0], maps.size[1], &pixels));
        let map = nv_flip::flip(one, other, nv_flip::DEFAULT_PIXELS_PER_DEGREE);
        let mean = nv_flip::FlipPool::from_image(&map).mean();
        println!("{name}: {mean}");
        assert!(mean < 0.03, "{name}: FLIP {mean}");
    }
}

#[test]
fn what_can_not_be_baked_is_refused() {
    let refused = |text: &str, options: &BakeOptions| {
        let device = ParallelBackend::open().unwrap();
        bake(design(text), &device, &renderer(), options, |_| ControlFlow::Continue(())).unwrap_err()
    };
    let usual = BakeOptions::default();
    assert!(matches!(refused(TWILL, &usual.texel_mm(0.0)), BakeError::Texel { .. }));
    assert!(matches!(refused(TWILL, &usual.texel_mm(f64::NAN)), BakeError::Texel { .. }));
    assert!(matches!(refused(TWILL, &usual.texel_mm(1e-6)), BakeError::TooLarge { .. }));
    assert!(matches!(refused(TWILL, &usual.area([0.0; 2], [0.0, 1.0])), BakeError::Area { .. }));
    assert!(matches!(refused(TWILL, &usual.area([900.0; 2], [1.0, 1.0])), BakeError::Empty));
    let device = ParallelBackend::open().unwrap();
    let stopped = bake(design(TWILL), &device, &renderer(), &usual, |_| ControlFlow::Break(()));
    assert!(matches!(stopped.unwrap_err(), BakeError::Cancelled | BakeError::Render(_)));
}
