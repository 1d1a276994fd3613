//! Draws how yarns came to rest, pass by pass, as SVG.

use std::fmt::Write;

use texere::backend::settling::{Form, Pass, SettlingSeen};

/// The picture's size and the plot's edges in it, pixels.
const SIZE: [f64; 2] = [960.0, 540.0];
const LEFT: f64 = 60.0;
const RIGHT: f64 = 690.0;
const TOP: f64 = 40.0;
const BOTTOM: f64 = 490.0;

/// A line of the plot: its name, its colour (Okabe and Ito 2008), and its value for a pass.
type Line = (&'static str, &'static str, fn(&SettlingSeen) -> f32);

const LINES: [Line; 4] = [
    ("clearance, 1 where yarns touch", "#0072b2", |seen| seen.clearance),
    ("least radius of curvature, diameters", "#009e73", |seen| seen.radius),
    ("length off, share", "#d55e00", |seen| seen.length),
    ("longest step, mm", "#cc79a7", |seen| seen.step),
];

/// The most powers of ten on the vertical axis, from the largest value down.
const DECADES: i32 = 9;

/// Draws clearance, bends, lengths and steps on a logarithmic scale over the passes of `course`.
/// Values of 0 and infinite values have no place on that scale, and leave a gap.
pub(crate) fn plot(course: &[(Pass, SettlingSeen)]) -> String {
    let values = || course.iter().flat_map(|(_, seen)| LINES.map(|(.., value)| value(seen))).filter(is_drawn);
    let decade = |value: f32| f64::from(value).log10();
    let high = decade(values().fold(f32::MIN_POSITIVE, f32::max).max(1.0)).ceil() as i32;
    let low = decade(values().fold(0.1, f32::min)).floor() as i32;
    let axes = Axes { passes: course.len(), low: low.max(high - DECADES), high };
    let [width, height] = SIZE;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n"
    );
    // Writing to a string can't fail.
    let _ = axes.draw(&mut svg).and_then(|()| stages(&mut svg, course, &axes)).and_then(|()| {
        LINES.iter().zip(0_u8..).try_for_each(|(line, number)| curve(&mut svg, course, &axes, line, number))
    });
    svg + "</svg>\n"
}

fn is_drawn(value: &f32) -> bool {
    value.is_finite() && *value > 0.0
}

/// The axes of the plot: passes from left to right, powers of ten from the bottom to the top.
struct Axes {
    passes: usize,
    low: i32,
    high: i32,
}

impl Axes {
    fn x(&self, pass: usize) -> f64 {
        LEFT + (RIGHT - LEFT) * pass as f64 / self.passes.saturating_sub(1).max(1) as f64
    }

    fn y(&self, value: f32) -> f64 {
        let share = (f64::from(value).log10() - f64::from(self.low)) / f64::from(self.high - self.low);
        BOTTOM - (BOTTOM - TOP) * share.max(0.0)
    }

    fn draw(&self, svg: &mut String) -> std::fmt::Result {
        for power in self.low..=self.high {
            let y = self.y(10_f32.powi(power));
            writeln!(svg, "<path d=\"M{LEFT} {y:.1}H{RIGHT}\" stroke=\"#ddd\"/>")?;
            let x = LEFT - 6.0;
            writeln!(svg, "<text x=\"{x}\" y=\"{:.1}\" text-anchor=\"end\">1e{power}</text>", y + 4.0)?;
        }
        let steps = [1, 2, 5, 10, 20, 50, 100, 200, 500].into_iter().find(|step| self.passes <= 10 * step);
        for pass in (0..self.passes).step_by(steps.unwrap_or(self.passes.div_ceil(10))) {
            let (x, y) = (self.x(pass), BOTTOM + 18.0);
            writeln!(svg, "<text x=\"{x:.1}\" y=\"{y}\" text-anchor=\"middle\">{pass}</text>")?;
        }
        let (x, y) = (f64::midpoint(LEFT, RIGHT), BOTTOM + 38.0);
        writeln!(svg, "<text x=\"{x}\" y=\"{y}\" text-anchor=\"middle\">passes</text>")
    }
}

/// Draws a line where each stage begins, with the name of the stage.
fn stages(svg: &mut String, course: &[(Pass, SettlingSeen)], axes: &Axes) -> std::fmt::Result {
    let mut last = "";
    for (number, (pass, _)) in course.iter().enumerate().skip(1) {
        let stage = match pass.form {
            Form::Block => "block form",
            Form::Weighted if pass.growth < 1.0 => "growing",
            Form::Weighted if pass.ease > 0.0 => "easing",
            Form::Weighted => "weighted form",
        };
        if stage != last {
            let (x, y) = (axes.x(number), TOP - 8.0);
            writeln!(svg, "<path d=\"M{x:.1} {TOP}V{BOTTOM}\" stroke=\"#888\" stroke-dasharray=\"4 3\"/>")?;
            writeln!(svg, "<text x=\"{x:.1}\" y=\"{y}\" font-size=\"11\">{stage}</text>")?;
            last = stage;
        }
    }
    Ok(())
}

/// Draws one line of the plot, and its name at the right.
fn curve(
    svg: &mut String,
    course: &[(Pass, SettlingSeen)],
    axes: &Axes,
    &(name, color, value): &Line,
    number: u8,
) -> std::fmt::Result {
    let (x, y) = (RIGHT + 14.0, TOP + 14.0 + 22.0 * f64::from(number));
    writeln!(svg, "<path d=\"M{x} {y}h20\" stroke=\"{color}\" stroke-width=\"2\"/>")?;
    writeln!(svg, "<text x=\"{}\" y=\"{}\">{name}</text>", x + 26.0, y + 4.0)?;
    write!(svg, "<path fill=\"none\" stroke=\"{color}\" stroke-width=\"1.5\" d=\"")?;
    let mut pen = 'M';
    for (pass, (_, seen)) in course.iter().enumerate() {
        let value = value(seen);
        if is_drawn(&value) {
            write!(svg, "{pen}{:.1} {:.1}", axes.x(pass), axes.y(value))?;
            pen = 'L';
        } else {
            pen = 'M';
        }
    }
    writeln!(svg, "\"/>")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pass(form: Form, growth: f32, ease: f32, clearance: f32, length: f32) -> (Pass, SettlingSeen) {
        let seen = SettlingSeen { step: 1e-3, clearance, radius: f32::INFINITY, length };
        (Pass { form, growth, ease, momentum: 0.8 }, seen)
    }

    #[test]
    fn every_stage_is_marked_once_where_it_begins() {
        let mut course = vec![pass(Form::Weighted, 1.0, 0.0, 0.5, 0.0)];
        course.extend([pass(Form::Weighted, 0.25, 1.0, 0.9, 0.01); 2]);
        course.push(pass(Form::Weighted, 1.0, 0.5, 0.9, 0.01));
        course.push(pass(Form::Weighted, 1.0, 0.0, 0.9, 0.01));
        course.push(pass(Form::Block, 1.0, 0.0, 1.0, 0.01));
        let svg = plot(&course);
        // Six passes: 126 pixels from each to the next.
        for (stage, x) in [("growing", 186), ("easing", 438), ("weighted form", 564), ("block form", 690)] {
            assert_eq!(
                svg.matches(&format!("<text x=\"{x}.0\" y=\"32\" font-size=\"11\">{stage}<")).count(),
                1,
                "{svg}"
            );
        }
    }

    #[test]
    fn what_has_no_logarithm_leaves_a_gap() {
        let course = [0.0, 0.1, 0.01, 0.0, 1.0].map(|off| pass(Form::Weighted, 1.0, 0.0, 1.0, off));
        let svg = plot(&course);
        // The axis goes from 1e-3, the step of every pass, to 1, with 150 pixels for each power of
        // ten. Radii of curvature are infinite, so their line is empty.
        assert!(svg.contains("d=\"M217.5 190.0L375.0 340.0M690.0 40.0\"/>"), "{svg}");
        assert!(svg.contains("stroke=\"#009e73\" stroke-width=\"1.5\" d=\"\"/>"), "{svg}");
        assert!(plot(&[]).ends_with("</svg>\n"));
    }
}
