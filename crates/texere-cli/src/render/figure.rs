//! The paper's figure 5: phases alone, serial against parallel, as a table and as a plot.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::time::Duration;

use texere::{Output, Phases, Renderer, Settings};

use crate::fail::Fail;
use crate::terminal::line;

/// Bars of a group, in the order of the table: what they stand for, and their colour.
const BARS: [(&str, &str); 5] = [
    ("geometry, serial", "#9a3324"),
    ("geometry, parallel", "#d98a5b"),
    ("buffers, serial", "#2b4a6f"),
    ("buffers, parallel", "#7f9fc4"),
    ("rendering", "#6b7d4f"),
];

/// The plot, in pixels.
const WIDTH: f64 = 900.0;
const HEIGHT: f64 = 460.0;
const LEFT: f64 = 70.0;
const TOP: f64 = 50.0;
const BOTTOM: f64 = 400.0;

/// The same for each design: its name, and the times of [`BARS`].
struct Row {
    name: String,
    times: [Duration; 5],
}

pub(super) fn run(
    designs: &[PathBuf],
    plot: &Path,
    renderer: &Renderer,
    settings: Settings,
    size: [u32; 2],
) -> Result<(), Fail> {
    let named: Vec<_> =
        designs.iter().map(|path| Ok((path, texere::read(path)?))).collect::<Result<_, Fail>>()?;
    let output = Output::to(plot).sparing(named.iter().flat_map(|(_, design)| design.files()));
    output.check()?;
    let serial = texere::open("cpu-serial")?;
    let mut rows = Vec::new();
    for (path, design) in named {
        let yarns = design.yarns()?;
        let phases = renderer.phases(&yarns, &settings, &*serial, size)?;
        let name = line(path.file_stem().unwrap_or_default().display());
        let row = Row { name, times: in_order(&phases) };
        if rows.is_empty() {
            crate::print(&header(&renderer.info().device))?;
        }
        crate::print(&table_row(&row))?;
        rows.push(row);
    }
    Ok(texere::write_file(svg(&rows, &renderer.info().device).as_bytes(), output)?)
}

fn in_order(phases: &Phases) -> [Duration; 5] {
    [
        phases.serial_geometry,
        phases.parallel_geometry,
        phases.serial_buffers,
        phases.parallel_buffers,
        phases.rendering,
    ]
}

fn header(device: &str) -> String {
    let columns: String = BARS.iter().map(|(name, _)| format!(" {name} |")).collect();
    format!(
        "Milliseconds; serial is one core, parallel is {device}.\n\n| cloth |{columns}\n|---|{}\n",
        "---:|".repeat(5)
    )
}

fn table_row(row: &Row) -> String {
    let times: String = row.times.iter().map(|time| format!(" {:.1} |", milliseconds(*time))).collect();
    format!("| {} |{times}\n", row.name)
}

fn milliseconds(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}

/// Grouped bars over a logarithmic axis, since phases differ by orders of magnitude.
fn svg(rows: &[Row], device: &str) -> String {
    let times = || rows.iter().flat_map(|row| row.times).map(|time| milliseconds(time).max(0.01));
    let low = times().fold(f64::MAX, f64::min).log10().floor();
    let high = times().fold(0.01, f64::max).log10().ceil().max(low + 1.0);
    let y = |ms: f64| BOTTOM - (ms.max(0.01).log10() - low) / (high - low) * (BOTTOM - TOP);
    let group = (WIDTH - LEFT - 20.0) / rows.len().max(1) as f64;
    let bar = group * 0.8 / BARS.len() as f64;

    // Writing to a string can't fail.
    let mut text = String::new();
    let _ = writeln!(
        text,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" font-family=\"sans-serif\" \
         font-size=\"13\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n\
         <text x=\"{LEFT}\" y=\"20\">Phases of the simulation, milliseconds; serial is one core, parallel is {}</text>",
        device.replace('&', "&amp;").replace('<', "&lt;")
    );
    for power in low as i32..=high as i32 {
        let (ms, at) = (10f64.powi(power), y(10f64.powi(power)));
        let _ = writeln!(
            text,
            "<path d=\"M{LEFT} {at:.1}H{:.1}\" stroke=\"#ccc\"/><text x=\"{:.1}\" y=\"{:.1}\" \
             text-anchor=\"end\">{ms}</text>",
            WIDTH - 20.0,
            LEFT - 6.0,
            at + 4.0
        );
    }
    for (number, row) in rows.iter().enumerate() {
        let start = LEFT + group * (number as f64 + 0.1);
        for (place, (time, (_, color))) in row.times.iter().zip(BARS).enumerate() {
            let at = y(milliseconds(*time));
            let _ = writeln!(
                text,
                "<rect x=\"{:.1}\" y=\"{at:.1}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"{color}\"/>",
                start + bar * place as f64,
                bar * 0.92,
                BOTTOM - at
            );
        }
        let (middle, below) = (start + group * 0.4, BOTTOM + 18.0);
        let name = row.name.replace('&', "&amp;").replace('<', "&lt;");
        let _ = writeln!(text, "<text x=\"{middle:.1}\" y=\"{below}\" text-anchor=\"middle\">{name}</text>");
    }
    for (number, (name, color)) in BARS.iter().enumerate() {
        let x = LEFT + 160.0 * number as f64;
        let _ = writeln!(
            text,
            "<rect x=\"{x}\" y=\"{:.1}\" width=\"12\" height=\"12\" fill=\"{color}\"/>\
             <text x=\"{:.1}\" y=\"{:.1}\">{name}</text>",
            HEIGHT - 25.0,
            x + 17.0,
            HEIGHT - 14.0
        );
    }
    text + "</svg>\n"
}
