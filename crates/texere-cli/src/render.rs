//! `texere render`

mod figure;

use std::collections::HashSet;
use std::f32::consts::TAU;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use clap::ValueEnum;
use texere::{Camera, Cut, Design, Extent, Output, Picture, Quality, Renderer, Structure};

use crate::args::{SettingsArgs, file_of};
use crate::drivers;
use crate::fail::Fail;
use crate::places::middles;
use crate::terminal::line;

#[derive(Debug, clap::Args)]
pub(crate) struct RenderArgs {
    /// A .wif draft or a .toml design; with --timings any number of them
    #[arg(required = true)]
    designs: Vec<PathBuf>,
    /// The picture to write, a .png file; a turntable numbers its pictures: OUT-001.png and so on
    #[arg(short, long, value_name = "FILE", required_unless_present = "timings", value_parser = file_of("png"))]
    output: Option<PathBuf>,
    /// Time what the paper's figure 5 does, each alone: yarn geometry, buffer creation and rendering, serial against
    /// parallel; prints a table and draws it to an .svg file
    #[arg(long, value_name = "FILE", conflicts_with = "output", value_parser = file_of("svg"))]
    timings: Option<PathBuf>,
    /// Width and height, pixels
    #[arg(long, value_name = "WxH", default_value = "1600x1200", value_parser = size)]
    size: [u32; 2],
    /// From where the cloth is seen
    #[arg(long, value_enum, default_value_t = View::Face)]
    view: View,
    /// The point that a close-up or a cut shows, mm from the cloth's left and lower edges; if left out its middle, or for a
    /// cut the middle of the thread nearest to it
    #[arg(long, value_name = "X,Y", value_parser = point, allow_hyphen_values = true)]
    at: Option<[f32; 2]>,
    /// What a close-up or a cut shows, mm across; if left out, forty times a yarn's radius
    #[arg(long, value_name = "MM", value_parser = millimetres, allow_negative_numbers = true)]
    width: Option<f32>,
    /// Show face or back at true scale, so many millimetres to a pixel, in a picture as large as that takes
    #[arg(long, value_name = "MM", conflicts_with = "size", value_parser = millimetres, allow_negative_numbers = true)]
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
    let number = |text: &str| match text.parse() {
        Ok(number) if number > 0 => Ok(number),
        _ => Err(format!("\"{text}\" is not a number of pixels")),
    };
    Ok([number(width)?, number(height)?])
}

/// A length from its number.
fn millimetres(text: &str) -> Result<f32, String> {
    let number = text.parse().ok().filter(|number: &f32| number.is_finite() && *number > 0.0);
    number.ok_or_else(|| "expected a finite number of millimetres above 0".into())
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
    let ([design], Some(output)) = (&args.designs[..], &args.output) else {
        let Some(plot) = &args.timings else { return Err(Fail::too_many_designs(args.designs.len())) };
        let renderer = drivers::quietly(|| texere::open_renderer(&args.device))?;
        return figure::run(&args.designs, plot, &renderer, args.settings.settings(), args.size);
    };
    let start = Instant::now();
    let renderer = drivers::quietly(|| texere::open_renderer(&args.device))?;
    let opened = start.elapsed();
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
    let outputs = outputs(output, args, &design)?;
    let yarns = stages.time("yarns", || design.yarns())?;
    let mut scene = stages.time("upload", || renderer.scene(&yarns, &args.settings.settings()))?;
    let cameras = cameras(args, &design, scene.extent())?;
    let quality = Quality { supersampling: args.supersampling };
    let mut text = String::new();
    for (output, camera) in outputs.into_iter().zip(cameras) {
        let Picture { size: [width, height], rgb, timings } = scene.picture(&camera, quality)?;
        stages.add("screen", timings.screen);
        stages.add("mesh and draw", timings.draw);
        stages.add("light", timings.shade);
        let path = line(output.path().display());
        stages.time("write", || texere::write_picture([width, height], &rgb, output))?;
        let triangles = scene.plan().counts().triangles;
        let name = &renderer.info().name;
        // Writing to a string can't fail.
        let _ = writeln!(text, "{path}: {width} × {height} pixels, {triangles} triangles, drawn by {name}");
    }
    Ok(text)
}

/// The files that the pictures go to, once it is known that none would replace another, or the design.
fn outputs(output: &Path, args: &RenderArgs, design: &Design) -> Result<Vec<Output>, Fail> {
    let paths = match args.view {
        View::Turntable => (1..=args.frames).map(|number| numbered(output, number)).collect(),
        _ => vec![output.to_owned()],
    };
    let mut taken = HashSet::new();
    let checked = paths.into_iter().map(|path| {
        let output = Output::to(&path).sparing(design.files());
        output.check()?;
        // What is not there yet is no link to another.
        let real = fs::canonicalize(&path).ok();
        if real.is_some_and(|real| !taken.insert(real)) {
            Err(Fail::written_twice(&path))
        } else {
            Ok(output)
        }
    });
    checked.collect()
}

/// The cameras, one for each picture.
fn cameras(args: &RenderArgs, design: &Design, extent: &Extent) -> Result<Vec<Camera>, Fail> {
    let (size, at) = (args.size, point_shown(args, design, extent)?);
    let width = args.width.unwrap_or(40.0 * extent.radius);
    let face = || match args.mm_per_pixel {
        Some(scale) => Camera::true_scale(extent, scale),
        None => Ok(Camera::face(extent, size)),
    };
    let camera = match args.view {
        View::Face => face()?,
        View::Back => face()?.turned_over(),
        View::Oblique => Camera::oblique(extent, -0.5, size)?,
        View::CloseUp => Camera::close_up(extent, at, width, size)?,
        View::CutWarp => Camera::cut(extent, Cut::Warp, at, width, size)?,
        View::CutWeft => Camera::cut(extent, Cut::Weft, at, width, size)?,
        View::Turntable => {
            let turn = |number| TAU * number as f32 / args.frames as f32;
            let cameras = (0..args.frames).map(|number| Camera::oblique(extent, turn(number), size));
            return Ok(cameras.collect::<Result<_, _>>()?);
        }
    };
    Ok(vec![camera])
}

/// The point that was asked for, or else the middle of the cloth; in a cut that of a thread, since there is nothing to cut
/// between two.
fn point_shown(args: &RenderArgs, design: &Design, extent: &Extent) -> Result<[f32; 2], Fail> {
    let ([left, lower, _], [right, upper, _]) = (extent.low, extent.high);
    if let Some([x, y]) = args.at {
        return if (left..=right).contains(&x) && (lower..=upper).contains(&y) {
            Ok([x, y])
        } else {
            Err(Fail::off_the_cloth([x, y], [left, lower], [right, upper]))
        };
    }
    let [x, y] = [0.5 * (left + right), 0.5 * (lower + upper)];
    let Structure::Woven(cloth) = &design.structure else { return Ok([x, y]) };
    Ok(match args.view {
        View::CutWarp => [x, nearest(middles(cloth.weft()), y)],
        View::CutWeft => [nearest(middles(cloth.warp()), x), y],
        _ => [x, y],
    })
}

/// The one of `places` that is nearest to `wanted`.
fn nearest(places: impl Iterator<Item = f64>, wanted: f32) -> f32 {
    let off = |place: &f64| (place - f64::from(wanted)).abs();
    places.min_by(|one, other| off(one).total_cmp(&off(other))).map_or(wanted, |place| place as f32)
}

/// `cloth.png` as `cloth-007.png`.
fn numbered(path: &Path, number: u32) -> PathBuf {
    let mut name = path.file_stem().unwrap_or_default().to_owned();
    name.push(format!("-{number:03}."));
    name.push(path.extension().unwrap_or_default());
    path.with_file_name(name)
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
