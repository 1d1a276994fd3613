//! Cloth from afar must show no waves that it does not have: threads finer than pixels must not
//! beat with the pixels.

use std::f64::consts::TAU;

use texere_core::{ControlPoint, Material, Yarn, Yarns};

use super::{SETTINGS, renderer};
use crate::{Camera, Extent, Pose, Quality};

/// The number of pixels of the pictures each way.
const SIZE: usize = 96;

/// The greatest height, in levels of 255, that is allowed of a wave that the cloth does not have.
/// It is half of the least height that an eye can see. Pixels that are plain means of their samples
/// beat by at least five times as much.
const SEEN: f64 = 4.0;

/// The distance, in waves over the picture, at which waves can be distinguished. The main lobe of
/// Von Hann's window, with which [`strangest`] fades the picture, reaches two waves each way.
const APART: f64 = 3.0;

/// A weave: its repeat, and a function that tells whether an end lies above a pick.
type Weave = (usize, fn(usize, usize) -> bool);

const PLAIN: Weave = (2, |end, pick| (end + pick) % 2 == 0);
const TWILL: Weave = (4, |end, pick| (end + pick) % 4 != 0);
const SATEEN: Weave = (5, |end, pick| (end + 3 * pick) % 5 == 0);

/// A cloth of dark ends and light picks, a millimetre apart, `threads` of each.
fn cloth((_, up): Weave, threads: usize) -> Yarns {
    let mut yarns = Yarns::builder();
    yarns.material(Material { srgb: [40, 60, 120], ..Material::default() });
    yarns.material(Material { srgb: [235, 225, 205], ..Material::default() });
    let middle = |number: usize| number as f32 + 0.5;
    for end in 0..threads {
        let height = |pick| if up(end, pick) { 0.3 } else { -0.3 };
        let points = (0..threads).map(|pick| ControlPoint::new(middle(end), middle(pick), height(pick), 0.4));
        yarns.yarn(Yarn::default(), &points.collect::<Vec<_>>());
    }
    for pick in 0..threads {
        let height = |end| if up(end, pick) { -0.3 } else { 0.3 };
        let points = (0..threads).map(|end| ControlPoint::new(middle(end), middle(pick), height(end), 0.4));
        yarns.yarn(Yarn { material: 1, ..Yarn::default() }, &points.collect::<Vec<_>>());
    }
    yarns.build().unwrap()
}

/// The waves of a line of numbers, as real and imaginary parts. They are its discrete Fourier
/// transform by the definition.
fn waves_of(line: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let wave = |number: usize| {
        line.iter().enumerate().fold([0.0; 2], |sum, (at, [real, imaginary])| {
            let (sine, cosine) = (TAU * (number * at % SIZE) as f64 / SIZE as f64).sin_cos();
            [sum[0] + real * cosine + imaginary * sine, sum[1] + imaginary * cosine - real * sine]
        })
    };
    (0..line.len()).map(wave).collect()
}

/// The greatest wave of a picture among those that the cloth can't have: its height in levels of
/// 255, and its number of periods over the picture each way.
///
/// In a picture of `pitch` pixels from thread to thread, the cloth has waves of a whole number of
/// periods for `repeat` threads, each way. The neighbourhood of each of these waves that pixels can
/// show is left out. No other waves may be in the picture.
fn strangest(grey: &[f64], pitch: f64, repeat: usize) -> (f64, [f64; 2]) {
    let mean = grey.iter().sum::<f64>() / grey.len() as f64;
    // Von Hann's window fades the picture at its edges, which would otherwise be waves themselves
    // (Harris 1978).
    let window = |at: usize| 0.5 - 0.5 * (TAU * (at as f64 + 0.5) / SIZE as f64).cos();
    let total = (0..SIZE).map(window).sum::<f64>().powi(2);
    let faded = |x: usize, y: usize| [(grey[y * SIZE + x] - mean) * window(x) * window(y), 0.0];
    let rows: Vec<_> =
        (0..SIZE).map(|y| waves_of(&(0..SIZE).map(|x| faded(x, y)).collect::<Vec<_>>())).collect();
    // Waves of more periods than half the picture's pixels run the other way.
    let signed = |number: usize| number as f64 - if number > SIZE / 2 { SIZE as f64 } else { 0.0 };
    let step = SIZE as f64 / (repeat as f64 * pitch);
    let most = (SIZE as f64 / 2.0 / step) as i32;
    let off = |wave: f64| move |number: i32| wave - f64::from(number) * step;
    let nearest =
        |wave: f64| (-most..=most).map(off(wave)).fold(f64::MAX, |one, other| one.abs().min(other.abs()));
    let mut strangest = (0.0, [0.0; 2]);
    for across in 0..SIZE {
        let column: Vec<_> = rows.iter().map(|row| row[across]).collect();
        for (down, [real, imaginary]) in waves_of(&column).into_iter().enumerate() {
            let wave = [signed(across), signed(down)];
            let height = 2.0 * real.hypot(imaginary) / total;
            if nearest(wave[0]).hypot(nearest(wave[1])) >= APART && height > strangest.0 {
                strangest = (height, wave);
            }
        }
    }
    strangest
}

#[test]
fn threads_finer_than_pixels_make_no_waves_of_their_own() {
    let renderer = renderer().lock().unwrap();
    for weave in [PLAIN, TWILL, SATEEN] {
        for pitch in [0.37, 0.44, 0.53, 0.62, 0.71, 0.83, 0.97, 1.31] {
            let shown = SIZE as f64 / pitch;
            let yarns = cloth(weave, shown as usize + 12);
            let extent = Extent::of(&yarns);
            // The camera is not in step with the threads.
            let [x, y, z] = extent.middle().to_array();
            let target = [x + 0.3, y + 0.2, z];
            let pose = Pose { eye: [target[0], target[1], z + 10.0], target, up: [0.0, 1.0, 0.0] };
            let camera = Camera::orthographic(&extent, &pose, shown as f32, [SIZE as u32; 2]).unwrap();
            let mut scene = renderer.scene(&yarns, &texere_core::Settings { sides: 6, ..SETTINGS }).unwrap();
            let picture = scene.picture(&camera, Quality::default()).unwrap();
            let grey: Vec<f64> = picture.rgb.chunks_exact(3).map(|rgb| f64::from(rgb[1])).collect();
            let (height, waves) = strangest(&grey, pitch, weave.0);
            assert!(
                height < SEEN,
                "{pitch} pixels a thread, repeat {}: a wave of {height:.1} levels, {waves:?} over the picture",
                weave.0
            );
        }
    }
}
