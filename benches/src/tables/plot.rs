//! The figures as SVG.

use std::error::Error;
use std::time::Duration;

use plotters::prelude::*;

use super::results::{Cloth, Column};
use crate::phases::Phases;

/// A line of a figure: its name, and a time for each cloth.
type Line = (String, Vec<Duration>);

/// The figure of geometry and buffers, serial and parallel, and of drawing, as SVG.
pub(super) fn figure_5(cloths: &[Cloth], phases: &[Phases]) -> Result<String, Box<dyn Error>> {
    let lines = Phases::NAMES
        .into_iter()
        .enumerate()
        .map(|(number, name)| (name.into(), phases.iter().map(|phases| phases.in_order()[number]).collect()));
    draw("Phases of the simulation", cloths, &lines.collect::<Vec<_>>())
}

/// The figure of both stages of each device, as SVG.
pub(super) fn figure_6(cloths: &[Cloth], columns: &[Column]) -> Result<String, Box<dyn Error>> {
    let lines = columns
        .iter()
        .map(|Column { info, runs, .. }| (info.name.clone(), runs.iter().map(|run| run.whole).collect()));
    draw("Trajectory and mesh", cloths, &lines.collect::<Vec<_>>())
}

/// Draws milliseconds against triangles, with both axes logarithmic. Work that is linear appears as
/// a line of slope one.
fn draw(title: &str, cloths: &[Cloth], lines: &[Line]) -> Result<String, Box<dyn Error>> {
    let ms = |time: &Duration| time.as_secs_f64() * 1e3;
    let times = || lines.iter().flat_map(|(_, times)| times).map(ms).filter(|time| *time > 0.0);
    let (low, high) = (times().fold(f64::MAX, f64::min), times().fold(f64::MIN_POSITIVE, f64::max));
    let triangles = || cloths.iter().map(|cloth| cloth.counts.triangles as f64);
    let (fewest, most) = (triangles().fold(f64::MAX, f64::min), triangles().fold(1.0, f64::max));

    let mut svg = String::new();
    let area = SVGBackend::with_string(&mut svg, (960, 560)).into_drawing_area();
    area.fill(&WHITE)?;
    let mut chart = ChartBuilder::on(&area)
        .caption(title, ("sans-serif", 20))
        .margin(12)
        .x_label_area_size(44)
        .y_label_area_size(70)
        .build_cartesian_2d((fewest * 0.8..most * 1.25).log_scale(), (low * 0.5..high * 2.0).log_scale())?;
    chart.configure_mesh().x_desc("triangles").y_desc("milliseconds").draw()?;
    for (number, (name, times)) in lines.iter().enumerate() {
        let color = Palette99::pick(number).to_rgba();
        let points: Vec<_> = triangles().zip(times.iter().map(ms)).filter(|(_, time)| *time > 0.0).collect();
        chart
            .draw_series(LineSeries::new(points, color.stroke_width(2)).point_size(3))?
            .label(name)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], color.stroke_width(2)));
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperLeft)
        .background_style(WHITE.mix(0.8))
        .border_style(BLACK)
        .draw()?;
    area.present()?;
    drop((chart, area));
    Ok(svg)
}
