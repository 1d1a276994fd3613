//! `texere render`

mod figure;

use std::f32::consts::TAU;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use clap::ValueEnum;
use texere::{Camera, Cut, Extent, Picture, Quality, RenderError, Renderer};

use crate::args::SettingsArgs;
use crate::fail::Fail;

#[derive(Debug, clap::Args)]
pub(crate) struct RenderArgs {
    /// A .wif draft or a .toml design; with --timings any number of them
    #[arg(required = true)]
    designs: Vec<PathBuf>,
    /// The picture to write, a .png file; a turntable numbers its pictures: OUT-001.png and so on
    #[arg(short, long, value_name = "FILE", required_unless_present = "timings")]
    output: Option<PathBuf>,
    /// Time what the paper's figure 5 does, each alone: yarn geometry, buffer creation and rendering, serial against
    /// parallel; prints a table and draws it to an .svg file
    #[arg(long, value_name = "FILE", conflicts_with = "output")]
    timings: Option<PathBuf>,
    /// Width and height, pixels
    #[arg(long, value_name = "WxH", default_value = "1600x1200", value_parser = size)]
    size: [u32; 2],
    /// From where the cloth is seen
    #[arg(long, value_enum, default_value_t = View::Face)]
    view: View,
    /// The point that a close-up or a cut shows, mm from the first end and the first pick; the cloth's middle if left out
    #[arg(long, value_name = "X,Y", value_parser = point)]
    at: Option<[f32; 2]>,
    /// What a close-up or a cut shows, mm across; if left out, forty times a yarn's radius
    #[arg(long, value_name = "MM")]
    width: Option<f32>,
    /// Show face or back at true scale, so many millimetres to a pixel, in a picture as large as that takes
    #[arg(long, value_name = "MM", conflicts_with = "size")]
    mm_per_pixel: Option<f32>,
    /// Pictures of a turntable
    #[arg(long, value_name = "N", default_value_t = 36, value_parser = clap::value_parser!(u32).range(1..=9999))]
    frames: u32,
    /// Pixels drawn for each pixel of the picture, each way; each has four samples
    #[arg(long, value_name = "N", default_value_t = Quality::default().supersampling, value_parser = clap::value_parser!(u32).range(1..=8))]
    supersampling: u32,
    /// The device that draws: auto, wgpu, wgpu:1, wgpu:nvidia
    #[arg(long, default_value = "auto")]
    device: String,
    /// Make everything anew so many times, to see how long it takes on a device that is warm
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    repeat: u32,
    #[command(flatten)]
    settings: SettingsArgs,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum View {
    /// Straight onto the face
    Face,
    /// Straight onto the back: the cloth is turned over sideways, end 1 at the right
    Back,
    /// The whole cloth from above its lower edge
    Oblique,
    /// Some yarns, from near
    CloseUp,
    /// A cut through the ends, along a pick
    CutWarp,
    /// A cut through the picks, along an end
    CutWeft,
    /// The oblique view from all sides, as numbered pictures
    Turntable,
}

/// A size from its numbers.
fn size(text: &str) -> Result<[u32; 2], String> {
    let (width, height) = text.split_once('x').ok_or("expected a width and a height, such as 1600x1200")?;
    let number = |text: &str| text.parse().map_err(|_| format!("\"{text}\" is not a number of pixels"));
    Ok([number(width)?, number(height)?])
}

/// A point from its numbers.
fn point(text: &str) -> Result<[f32; 2], String> {
    let (x, y) = text.split_once(',').ok_or("expected two numbers, such as 12.5,8")?;
    let number = |text: &str| match text.trim().parse::<f32>() {
        Ok(number) if number.is_finite() => Ok(number),
        _ => Err(format!("\"{text}\" is not a number of millimetres")),
    };
    Ok([number(x)?, number(y)?])
}

pub(crate) fn run(args: &RenderArgs) -> Result<(), Fail> {
    let start = Instant::now();
    let renderer = texere::open_renderer(&args.device)?;
    let opened = start.elapsed();
    let (design, output) = match (&args.designs[..], &args.output, &args.timings) {
        (designs, _, Some(path)) => {
            return figure::run(designs, path, &renderer, args.settings.settings(), args.size);
        }
        ([design], Some(output), None) => (design, output),
        (designs, ..) => return Err(Fail::too_many_designs(designs.len())),
    };
    for number in 0..args.repeat {
        let mut stages = Stages::default();
        let pictures = whole_run(design, output, args, &renderer, &mut stages)?;
        let first = if number == 0 { format!("device {}, ", milliseconds(opened)) } else { String::new() };
        crate::print(&format!("{pictures}{first}{stages}\n"))?;
    }
    Ok(())
}

/// From the design file to the picture. Gives a line for what was written.
fn whole_run(
    design: &Path,
    output: &Path,
    args: &RenderArgs,
    renderer: &Renderer,
    stages: &mut Stages,
) -> Result<String, Fail> {
    let mut design = stages.time("read", || texere::read(design))?;
    if let Some(section) = &args.settings.section {
        design.set_section(section.clone())?;
    }
    let yarns = stages.time("yarns", || design.yarns())?;
    let mut scene = stages.time("upload", || renderer.scene(&yarns, &args.settings.settings()))?;
    let cameras = cameras(output, args, scene.extent())?;
    let quality = Quality { supersampling: args.supersampling };
    let mut text = String::new();
    for (path, camera) in cameras {
        let Picture { size: [width, height], rgb, timings } = scene.picture(&camera, quality)?;
        stages.add("screen", timings.screen);
        stages.add("mesh and draw", timings.draw);
        stages.add("light", timings.shade);
        stages.time("write", || texere::write_picture([width, height], &rgb, &path))?;
        let triangles = scene.plan().counts().triangles;
        let name = &renderer.info().name;
        // Writing to a string can't fail.
        let _ = writeln!(
            text,
            "{}: {width} × {height} pixels, {triangles} triangles, drawn by {name}",
            path.display()
        );
    }
    Ok(text)
}

/// The cameras, each with the file that its picture goes to.
fn cameras(output: &Path, args: &RenderArgs, extent: &Extent) -> Result<Vec<(PathBuf, Camera)>, RenderError> {
    let size = args.size;
    let middle = [0, 1].map(|axis| 0.5 * (extent.low[axis] + extent.high[axis]));
    let (at, width) = (args.at.unwrap_or(middle), args.width.unwrap_or(40.0 * extent.radius));
    let face = || match args.mm_per_pixel {
        Some(scale) => Camera::true_scale(extent, scale),
        None => Ok(Camera::face(extent, size)),
    };
    let camera = match args.view {
        View::Face => face()?,
        View::Back => face()?.turned_over(),
        View::Oblique => Camera::oblique(extent, -0.5, size),
        View::CloseUp => Camera::close_up(extent, at, width, size)?,
        View::CutWarp => Camera::cut(extent, Cut::Warp, at, width, size)?,
        View::CutWeft => Camera::cut(extent, Cut::Weft, at, width, size)?,
        View::Turntable => {
            let frame = |number| {
                let turn = TAU * number as f32 / args.frames as f32;
                (numbered(output, number + 1), Camera::oblique(extent, turn, size))
            };
            return Ok((0..args.frames).map(frame).collect());
        }
    };
    Ok(vec![(output.to_owned(), camera)])
}

/// `cloth.png` as `cloth-007.png`.
fn numbered(path: &Path, number: u32) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}-{number:03}.{ending}"))
}

/// What each stage took, in the order in which they came.
#[derive(Debug, Default)]
struct Stages(Vec<(&'static str, Duration)>);

impl Stages {
    fn time<T>(&mut self, name: &'static str, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = work();
        self.add(name, start.elapsed());
        result
    }

    fn add(&mut self, name: &'static str, time: Duration) {
        match self.0.iter_mut().find(|(known, _)| *known == name) {
            Some((_, sum)) => *sum += time,
            None => self.0.push((name, time)),
        }
    }
}

impl std::fmt::Display for Stages {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for (name, time) in &self.0 {
            write!(f, "{name} {}, ", milliseconds(*time))?;
        }
        let all = self.0.iter().map(|(_, time)| *time).sum();
        write!(f, "all but the device {}", milliseconds(all))
    }
}

fn milliseconds(time: Duration) -> String {
    format!("{:.1} ms", time.as_secs_f64() * 1e3)
}
