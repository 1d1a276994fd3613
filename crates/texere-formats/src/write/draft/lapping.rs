//! Lapping diagrams of warp knits, on point paper: a dot for each needle, courses upward.
//!
//! ```text
//!  .  .  .  .     .  .  .  .     course 2
//!  .  .  .  .     .  .  .  .     course 1
//!  front bar      all bars
//! ```
//!
//! Each of the first eight bars has a diagram with one of its guides. The diagram of a Jacquard bar
//! has all of its guides. The diagram on the right has all guides of all bars. The yarn of a guide
//! rises beside a dot, goes round it from above, comes down on the other side, and moves on to the
//! next course. An inlaid yarn passes between the dots.

use std::io::Write;

use texere_fabric::warp::{Lap, LapKind, WarpKnitted};

use super::super::picture::png;
use super::super::{Output, WriteError};
use super::canvas::{Canvas, on_paper};
use super::limits::SIDE_MAX;
use super::sheet::{Block, INK, PAPER, Rgb, Sheet};
use super::side::Side;

/// Pixels from needle to needle.
const PITCH: f64 = 28.0;

/// Pixels from course to course.
const COURSE: f64 = 36.0;

/// The radius at which a yarn goes round a needle, pixels.
const ROUND: f64 = 8.0;

/// The radius of a needle, pixels.
const NEEDLE: f64 = 2.5;

/// The most wales that are drawn.
const WALES_MAX: u32 = 12;

/// The most courses that are drawn.
const COURSES_MAX: u32 = 48;

/// The most diagrams beside one another, the diagram of all bars included.
const DIAGRAMS_MAX: usize = 9;

/// Number of straight pieces of half a turn round a needle.
const PARTS: u32 = 12;

/// Draws a warp knit's lapping diagram to a PNG file. The diagram has the first courses, at most
/// 48, and the first wales, at most 12. A knit of fewer than 6 wales is drawn on 6. The chain of
/// each bar stands below the diagram. Needles are counted from the left if the diagram shows the
/// face, and from the right if it shows the back. Returns the picture's width and height in pixels.
///
/// **Errors**: [`WriteError::NotPng`] if `output` does not end in `.png`,
/// [`WriteError::LappingTooLarge`] for chains too long to be written below, [`WriteError::Spared`],
/// [`WriteError::Io`].
///
/// ```
/// use texere_core::{Material, Section};
/// use texere_fabric::warp::{Bar, Chain, WarpKnitted};
/// use texere_fabric::weft::{Gauge, KnitYarn};
/// use texere_formats::write::{Side, warp_draft};
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("tricot.png");
/// let bars = vec![Bar::new(Chain::parse("1-0/1-2//", 1)?)];
/// let (yarns, materials) = (vec![KnitYarn::new(0.05)], vec![Material::default()]);
/// let tricot = WarpKnitted::new(bars, Gauge::new(1.0, 0.75), 8, 8, yarns, materials, vec![Section::Circle], [1, 1])?;
/// warp_draft(&tricot, Side::Face, &path)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn warp_draft(
    cloth: &WarpKnitted,
    side: Side,
    output: impl Into<Output>,
) -> Result<[u32; 2], WriteError> {
    let output = png(output.into())?;
    drawn(cloth, side, |sheet| sheet.save(output))
}

/// Draws a warp knit's lapping diagram to `out`: the bytes that [`warp_draft`] writes to a file.
/// Returns the picture's width and height in pixels.
///
/// **Errors**: [`WriteError::LappingTooLarge`], [`WriteError::Writer`] if `out` refuses bytes.
pub fn warp_draft_to(cloth: &WarpKnitted, side: Side, out: impl Write) -> Result<[u32; 2], WriteError> {
    drawn(cloth, side, |sheet| sheet.save_to(out))
}

/// Draws a knit on a sheet, and passes the sheet to `save`.
fn drawn(
    cloth: &WarpKnitted,
    side: Side,
    save: impl FnOnce(&Sheet<'_>) -> Result<[u32; 2], WriteError>,
) -> Result<[u32; 2], WriteError> {
    let drawing = Drawing::new(cloth, side);
    let sheet = drawing.sheet(side);
    let [width, height] = sheet.size;
    if width.max(height) > SIDE_MAX {
        let bars = cloth.bars().len();
        return Err(WriteError::LappingTooLarge { bars, width, height, limit: SIDE_MAX });
    }
    save(&sheet)
}

/// A line for each bar of a warp knit, the front one first, with the bar's chain in chain notation.
#[must_use]
pub fn warp_rows(cloth: &WarpKnitted) -> Vec<String> {
    let line = |(number, bar): (usize, &texere_fabric::warp::Bar)| format!("bar {number}: {}", bar.chain);
    (1..).zip(cloth.bars()).map(line).collect()
}

/// All diagrams of a cloth.
struct Drawing<'a> {
    cloth: &'a WarpKnitted,
    /// Number of wales and courses that are drawn.
    size: [u32; 2],
    diagrams: Vec<Canvas>,
}

impl<'a> Drawing<'a> {
    fn new(cloth: &'a WarpKnitted, side: Side) -> Self {
        let [wales, courses] = cloth.size();
        let size = [wales.clamp(6, WALES_MAX), courses.min(COURSES_MAX)];
        let mut drawing = Self { cloth, size, diagrams: Vec::new() };
        let bars = 0..cloth.bars().len();
        let single = bars.clone().take(DIAGRAMS_MAX - 1);
        let mut diagrams: Vec<_> =
            single.map(|bar| drawing.diagram(side, &[(bar, drawing.shown(bar))])).collect();
        let all: Vec<_> = bars.rev().map(|bar| (bar, (0..size[0]).collect())).collect();
        diagrams.push(drawing.diagram(side, &all));
        drawing.diagrams = diagrams;
        drawing
    }

    /// The guides in a bar's own diagram: the threaded guide whose laps are nearest to the middle,
    /// or all guides of a Jacquard bar.
    fn shown(&self, number: usize) -> Vec<u32> {
        let bar = &self.cloth.bars()[number];
        if bar.jacquard.is_some() {
            return (0..self.size[0]).collect();
        }
        let spaces = || bar.chain.laps().iter().flat_map(|lap| [lap.from, lap.to]);
        let middle = (spaces().min().unwrap_or(0) + spaces().max().unwrap_or(0)) / 2 + bar.offset;
        let off = |guide: &u32| (*guide as i32 + middle - self.size[0] as i32 / 2).unsigned_abs();
        let threaded = (0..self.size[0]).filter(|guide| bar.threading.yarn(*guide).is_some());
        threaded.min_by_key(off).into_iter().collect()
    }

    fn diagram(&self, side: Side, bars: &[(usize, Vec<u32>)]) -> Canvas {
        let [wales, courses] = self.size.map(f64::from);
        let mut canvas =
            Canvas::new([(wales + 1.0) * PITCH, (courses + 1.0) * COURSE].map(|side| side as usize));
        let place = |at: [f64; 2]| self.place(side, at);
        for (number, guides) in bars {
            let bar = &self.cloth.bars()[*number];
            // Each bar is drawn a little to the side of the bar before, so that all bars show.
            let beside = *number as f64 * 3.0 / PITCH;
            for guide in guides {
                let Some(yarn) = bar.threading.yarn(*guide) else { continue };
                let mut way = Vec::new();
                for course in 0..=self.size[1] {
                    lay(&mut way, bar.lap(*guide, course), f64::from(course), beside);
                }
                for pair in way.windows(2) {
                    canvas.line(place(pair[0]), place(pair[1]), self.color(yarn));
                }
            }
        }
        for course in 0..self.size[1] {
            for wale in 0..self.size[0] {
                canvas.dot(place([f64::from(wale) + 0.5, f64::from(course)]), NEEDLE, INK);
            }
        }
        canvas
    }

    /// The pixel of a place that is given in needle spaces and courses.
    fn place(&self, side: Side, [x, y]: [f64; 2]) -> [f64; 2] {
        let [wales, courses] = self.size.map(f64::from);
        let x = match side {
            Side::Face => x,
            Side::Back => wales - x,
        };
        [(x + 0.5) * PITCH, (courses - y) * COURSE]
    }

    fn color(&self, yarn: u32) -> Rgb {
        let yarn = self.cloth.guide_yarns().get(yarn as usize);
        let material = yarn.and_then(|yarn| self.cloth.materials().get(yarn.material as usize));
        on_paper(material.map_or(PAPER, |material| material.srgb))
    }

    fn sheet(&self, side: Side) -> Sheet<'_> {
        let mut sheet = Sheet::new(PITCH as usize, false);
        let [mut left, top] = Sheet::ORIGIN;
        for canvas in &self.diagrams {
            let color = Box::new(|x, y, _| canvas.pixel(x, y));
            let block = Block { place: [left, top], squares: canvas.size, square: [1, 1], color };
            [left, _] = sheet.put(block);
        }
        let (side, first) = match side {
            Side::Face => ("FACE", "LEFT"),
            Side::Back => ("BACK", "RIGHT"),
        };
        let [wales, courses] = self.size;
        let mut legend = vec![
            format!("{side}. DOTS: NEEDLES"),
            format!("NEEDLE 1 {first}, COURSE 1 BOTTOM"),
            format!("{wales} WALES, {courses} COURSES"),
            "FRONT BAR FIRST, ALL BARS LAST".into(),
        ];
        legend.extend(warp_rows(self.cloth).into_iter().map(|row| row.to_uppercase()));
        sheet.close(legend);
        sheet
    }
}

/// Adds the path of a lap round its needles to `way`, in needle spaces and courses.
fn lay(way: &mut Vec<[f64; 2]>, lap: Lap, course: f64, beside: f64) {
    let (across, along) = (ROUND / PITCH, ROUND / COURSE);
    if lap.kind() == LapKind::Inlay {
        way.push([f64::from(lap.from) + beside, course]);
        return;
    }
    let needles: Vec<_> = lap.needles().map(|needle| f64::from(needle) + 0.5 + beside).collect();
    let (Some(first), Some(last)) = (needles.first(), needles.last()) else { return };
    let onward = f64::from(lap.overlap().signum());
    way.push([first - onward * across, course - along]);
    for part in 0..=PARTS {
        let turn = std::f64::consts::PI * f64::from(part) / f64::from(PARTS);
        let needle = if part <= PARTS / 2 { first } else { last };
        way.push([needle - onward * across * turn.cos(), course + along * turn.sin()]);
    }
    way.push([last + onward * across, course - along]);
}
