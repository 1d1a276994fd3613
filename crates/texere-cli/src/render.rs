//! `texere render`

use std::collections::HashSet;
use std::f32::consts::TAU;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use texere::check::SettlingReport;
use texere::picture::{Background, Camera, Cut, Extent, Quality, Renderer};
use texere::rest::{Finished, RestReport};
use texere::write::Output;
use texere::yarn::Origin;
use texere::{ControlPoint, Structure, Yarns};

use crate::args::{RenderArgs, View, undersampled};
use crate::fail::Fail;
use crate::terminal::line;
use crate::{drivers, print, reading, settling};

pub(crate) fn run(args: &RenderArgs) -> Result<(), Fail> {
    let start = Instant::now();
    let renderer = drivers::quietly(|| texere::picture::open_renderer(&args.device))?;
    let opened = start.elapsed();
    for number in 0..args.repeat {
        let mut stages = Stages::default();
        let pictures = whole_run(args, &renderer, &mut stages)?;
        let first = if number == 0 { format!("device {}, ", milliseconds(opened)) } else { String::new() };
        print::text(&format!("{pictures}{first}{stages}\n"))?;
    }
    Ok(())
}

/// The cloth that is shown, and the files that its pictures go to.
struct Shown {
    outputs: Vec<Output>,
    yarns: Yarns,
    /// Whether the cloth is woven cloth at rest, whose flattened threads lie so close that coarse
    /// tubes would pierce one another.
    lies_close: bool,
    /// The x of each end's centreline in woven cloth, and the y of each pick's, mm.
    middles: [Vec<f64>; 2],
    settling: Option<SettlingReport>,
}

impl Shown {
    /// The cloth that `args` name: saved cloth, curves, or the cloth of a design. Saved woven cloth
    /// counts as cloth at rest, since only cloth at rest is worth saving.
    fn new(args: &RenderArgs, stages: &mut Stages) -> Result<Self, Fail> {
        let design = stages.time("read", || reading::cloth(&args.design, args.curves, &args.settings))?;
        let outputs = outputs(args, design.files())?;
        let (open, tension) =
            (|| texere::open(&args.device), args.settings.tension(design.structure.tension()));
        let (cloth, settling) =
            stages.time("yarns", || settling::cloth(design, &args.settling, tension, open))?;
        let is_at_rest = matches!(cloth.report(), RestReport::Finished(Finished::Woven(_)));
        let (design, yarns) = cloth.into_parts();
        let middles = match &design.structure {
            Structure::Woven(woven) => woven.cloth().middles_mm().into_array(),
            Structure::Yarns(_) => saved_middles(&yarns),
            _ => <[_; 2]>::default(),
        };
        let is_saved = matches!(design.structure, Structure::Yarns(_));
        let lies_close = is_at_rest || is_saved && middles.iter().all(|middles| !middles.is_empty());
        Ok(Self { outputs, yarns, lies_close, middles, settling })
    }
}

/// The x of each end's centreline among saved yarns, and the y of each pick's, mm.
fn saved_middles(yarns: &Yarns) -> [Vec<f64>; 2] {
    let mut middles = [Vec::new(), Vec::new()];
    for (number, yarn) in yarns.layout().yarns().iter().enumerate() {
        let points = yarns.yarn_points(number).unwrap_or_default();
        match yarn.origin {
            Origin::End(_) => middles[0].push(median(points, |point| point.x)),
            Origin::Pick(_) => middles[1].extend(ways(points).map(|way| median(way, |point| point.y))),
            _ => {}
        }
    }
    middles
}

/// The ways of a weft yarn from edge to edge. The yarn turns at a selvedge, and each way is a pick.
fn ways(points: &[ControlPoint]) -> impl Iterator<Item = &[ControlPoint]> {
    let goes_right = |at: usize| points[at].x <= points[at + 1].x;
    let turns = (1..points.len().saturating_sub(1)).filter(move |&at| goes_right(at - 1) != goes_right(at));
    let mut first = 0;
    turns.chain([points.len()]).map(move |turn| {
        let way = &points[first..turn];
        first = turn;
        way
    })
}

/// The median of a coordinate of a yarn's points. There must be at least one point.
fn median(points: &[ControlPoint], coordinate: fn(&ControlPoint) -> f32) -> f64 {
    let mut all: Vec<f32> = points.iter().map(coordinate).collect();
    let middle = all.len() / 2;
    f64::from(*all.select_nth_unstable_by(middle, f32::total_cmp).1)
}

/// Reads the cloth, draws it, and writes the pictures. Returns the report of settling, a warning if
/// there is one, and a line for each picture.
fn whole_run(args: &RenderArgs, renderer: &Renderer, stages: &mut Stages) -> Result<String, Fail> {
    let Shown { outputs, yarns, lies_close, middles, settling } = Shown::new(args, stages)?;
    let settings = args.settings.of_picture(&yarns, lies_close);
    let mut scene = stages.time("upload", || renderer.scene(&yarns, &settings))?;
    scene.set_background(args.background);
    let cameras = cameras(args, middles, scene.extent())?;
    let quality = Quality { supersampling: args.supersampling, ..Quality::default() };
    let mut text = settling.iter().map(settling::said).collect::<String>();
    if let Some(warning) = undersampled(&yarns, &settings) {
        // Writing to a string can't fail.
        let _ = writeln!(text, "warning: {}", line(warning));
    }
    for (output, camera) in outputs.into_iter().zip(cameras) {
        let picture = scene.picture(&camera, quality)?;
        stages.add("screen", picture.timings.screen);
        stages.add("draw", picture.timings.draw);
        stages.add("light", picture.timings.shade);
        stages.add("copy", picture.timings.copy);
        let pixels = if args.background == Background::Nothing { picture.rgba() } else { picture.rgb };
        let [width, height] = picture.size;
        let path = line(output.path().display());
        stages.time("write", || texere::write::picture(picture.size, &pixels, output))?;
        let triangles = scene.plan().counts().triangles;
        let name = &renderer.info().name;
        // Writing to a string can't fail.
        let _ = writeln!(text, "{path}: {width} × {height} pixels, {triangles} triangles, drawn by {name}");
    }
    Ok(text)
}

/// The files that the pictures go to. Refuses files that would replace one another or one of the
/// files that were `read`.
fn outputs(args: &RenderArgs, read: &[impl AsRef<Path>]) -> Result<Vec<Output>, Fail> {
    let output = &args.output;
    let paths = match args.view {
        View::Turntable => (1..=args.frames).map(|number| numbered(output, number)).collect(),
        _ => vec![output.clone()],
    };
    let mut taken = HashSet::new();
    let checked = paths.into_iter().map(|path| {
        let output = Output::to(&path).sparing(read);
        output.check()?;
        // `canonicalize` fails for a file that does not exist yet. Such a file links to no other.
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
fn cameras(args: &RenderArgs, middles: [Vec<f64>; 2], extent: &Extent) -> Result<Vec<Camera>, Fail> {
    let (size, at) = (args.size, point_shown(args, middles, extent)?);
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

/// The point that was asked for, or else the middle of the cloth. A cut of woven cloth runs along
/// the thread nearest to the middle instead: between two threads it would show sections of the
/// other set alone.
fn point_shown(args: &RenderArgs, [ends, picks]: [Vec<f64>; 2], extent: &Extent) -> Result<[f32; 2], Fail> {
    let ([left, lower, _], [right, upper, _]) = (extent.low, extent.high);
    if let Some([x, y]) = args.at {
        return if (left..=right).contains(&x) && (lower..=upper).contains(&y) {
            Ok([x, y])
        } else {
            Err(Fail::off_the_cloth([x, y], [left, lower], [right, upper]))
        };
    }
    let [x, y] = [0.5 * (left + right), 0.5 * (lower + upper)];
    Ok(match args.view {
        View::CutWarp => [x, nearest(picks, y)],
        View::CutWeft => [nearest(ends, x), y],
        _ => [x, y],
    })
}

/// The one of `places` that is nearest to `wanted`, or `wanted` itself if there are no places.
fn nearest(places: Vec<f64>, wanted: f32) -> f32 {
    let off = |place: &f64| (place - f64::from(wanted)).abs();
    places
        .into_iter()
        .min_by(|one, other| off(one).total_cmp(&off(other)))
        .map_or(wanted, |place| place as f32)
}

/// `cloth.png` as `cloth-007.png`.
fn numbered(path: &Path, number: u32) -> PathBuf {
    let mut name = path.file_stem().unwrap_or_default().to_owned();
    name.push(format!("-{number:03}."));
    name.push(path.extension().unwrap_or_default());
    path.with_file_name(name)
}

/// The time of each stage, in order.
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
        write!(f, "together, without opening the device, {}", milliseconds(all))
    }
}

fn milliseconds(time: Duration) -> String {
    format!("{:.1} ms", time.as_secs_f64() * 1e3)
}
