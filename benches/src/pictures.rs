//! Measures pictures of a cloth from far and near, stage by stage.

use std::error::Error;
use std::path::PathBuf;
use std::time::Duration;

use texere::Settings;
use texere::picture::{Camera, Extent, PictureTimings, Pose, Quality, RenderError};

use crate::measure::median_time;

/// Draws each design `rounds` times from straight above and from aside, with four and with sixteen
/// samples a pixel, and prints the medians. Each number of `nearer` says how many times nearer a
/// view is than that of the whole cloth.
///
/// # Errors
///
/// The errors of the reader, the structure and the device.
pub fn print(
    designs: &[PathBuf],
    device: &str,
    size: [u32; 2],
    nearer: &[f32],
    rounds: usize,
) -> Result<(), Box<dyn Error>> {
    let renderer = texere::picture::open_renderer(device)?;
    println!("{}: {} x {} pixels\n", renderer.info().device, size[0], size[1]);
    println!("| design | view | nearer | samples | draw, ms | light, ms | copy, ms |");
    println!("|---|---|---|---|---|---|---|");
    for design in designs {
        let name = design.file_stem().unwrap_or_default().to_string_lossy();
        let yarns = texere::read(design)?.yarns()?;
        let mut scene = renderer.scene(&yarns, &Settings::default())?;
        for &nearer in nearer {
            let extent = *scene.extent();
            for (view, camera) in
                [("above", above(&extent, nearer, size)?), ("aside", aside(&extent, nearer, size)?)]
            {
                for supersampling in [1, 2] {
                    let pictures = (0..rounds)
                        .map(|_| scene.picture(&camera, Quality { supersampling, ..Quality::default() }));
                    let all: Vec<_> =
                        pictures.map(|picture| Ok(picture?.timings)).collect::<Result<_, RenderError>>()?;
                    let median = |stage: fn(&PictureTimings) -> Duration| {
                        median_time(&all.iter().map(stage).collect::<Vec<_>>()).as_secs_f64() * 1e3
                    };
                    println!(
                        "| {name} | {view} | {nearer} | {} | {:.2} | {:.2} | {:.2} |",
                        4 * supersampling * supersampling,
                        median(|timings| timings.draw),
                        median(|timings| timings.shade),
                        median(|timings| timings.copy),
                    );
                }
            }
        }
    }
    Ok(())
}

/// The view from straight above the middle.
fn above(extent: &Extent, nearer: f32, size: [u32; 2]) -> Result<Camera, RenderError> {
    let middle = middle(extent);
    let eye = [middle[0], middle[1], middle[2] + 1.0];
    let pose = Pose { eye, target: middle, up: [0.0, 1.0, 0.0] };
    Camera::orthographic(extent, &pose, 1.05 * height(extent, size) / nearer, size)
}

/// The view in perspective from above the lower left.
fn aside(extent: &Extent, nearer: f32, size: [u32; 2]) -> Result<Camera, RenderError> {
    let middle = middle(extent);
    let away = 2.0 * height(extent, size) / nearer;
    let eye = [middle[0] - 0.3 * away, middle[1] - 0.6 * away, middle[2] + 0.75 * away];
    Camera::perspective(extent, &Pose { eye, target: middle, up: [0.0, 0.0, 1.0] }, 0.5, size)
}

fn middle(extent: &Extent) -> [f32; 3] {
    std::array::from_fn(|axis| 0.5 * (extent.low[axis] + extent.high[axis]))
}

/// The height that a picture shows if the whole cloth just fits it, mm.
fn height(extent: &Extent, size: [u32; 2]) -> f32 {
    let across = |axis: usize| extent.high[axis] - extent.low[axis];
    across(1).max(across(0) * size[1] as f32 / size[0] as f32)
}
