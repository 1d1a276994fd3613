//! Draws how a knit pulls as it is strained, as SVG.

use std::fmt::Write;

/// The picture's size and the plot's edges in it, pixels.
const SIZE: [f64; 2] = [800.0, 500.0];
const LEFT: f64 = 80.0;
const RIGHT: f64 = 560.0;
const TOP: f64 = 30.0;
const BOTTOM: f64 = 440.0;

/// The most steps that the values on an axis span, before the ends of the axis are rounded to whole
/// steps.
const STEPS: f64 = 8.0;

/// The share of a step by which a value may lie outside of the axis. Forces at rest are not quite
/// 0.
const NOISE: f64 = 0.01;

/// The colours of curves, one after the other (Okabe and Ito 2008).
const COLORS: [&str; 4] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7"];

/// A curve: its name, and its points: strain, and force per width in N/mm.
pub(super) struct Curve {
    pub(super) name: &'static str,
    pub(super) points: Vec<[f64; 2]>,
}

/// An axis: its least and its greatest value, the distance of the numbers on it, and its ends in
/// the picture.
struct Axis {
    low: f64,
    high: f64,
    step: f64,
    ends: [f64; 2],
}

/// Draws force per width over strain.
pub(super) fn plot(curves: &[Curve]) -> String {
    let values = |axis: usize| {
        let points = curves.iter().flat_map(|curve| &curve.points);
        points.map(move |point| point[axis]).filter(|value| value.is_finite())
    };
    let axes = [Axis::new(values(0), [LEFT, RIGHT]), Axis::new(values(1), [BOTTOM, TOP])];
    let [width, height] = SIZE;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n"
    );
    // Writing to a string can't fail.
    let _ = frame(&mut svg, &axes).and_then(|()| {
        let numbered = curves.iter().zip(COLORS.into_iter().cycle()).zip(0_u32..);
        numbered
            .into_iter()
            .try_for_each(|((curve, color), number)| draw(&mut svg, curve, color, &axes, number))
    });
    svg + "</svg>\n"
}

impl Axis {
    /// An axis from `ends[0]` to `ends[1]` that has 0 and all `values`.
    fn new(values: impl Iterator<Item = f64>, ends: [f64; 2]) -> Self {
        let (low, high) =
            values.fold((0.0, 0.0), |(low, high): (f64, f64), value| (low.min(value), high.max(value)));
        let span = if high > low { high - low } else { 1.0 };
        let power = 10_f64.powf((span / STEPS).log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0]
            .map(|times| times * power)
            .into_iter()
            .find(|step| span * (1.0 - NOISE) <= STEPS * step);
        let step = step.unwrap_or(span);
        Self {
            low: (low / step + NOISE).floor() * step,
            high: ((low + span) / step - NOISE).ceil() * step,
            step,
            ends,
        }
    }

    fn at(&self, value: f64) -> f64 {
        let [start, end] = self.ends;
        start + (end - start) * (value - self.low) / (self.high - self.low)
    }

    /// The numbers on the axis, as they are written.
    fn numbers(&self) -> impl Iterator<Item = (f64, String)> + '_ {
        let digits = (-self.step.log10().floor()).max(0.0) as usize;
        let count = ((self.high - self.low) / self.step).round() as u32;
        (0..=count).map(move |number| {
            let value = self.low + f64::from(number) * self.step;
            // Adding 0 leaves no number as -0.
            (self.at(value), format!("{:.digits$}", (value / self.step).round() * self.step + 0.0))
        })
    }
}

/// Draws the axes.
fn frame(svg: &mut String, [across, up]: &[Axis; 2]) -> std::fmt::Result {
    for (x, number) in across.numbers() {
        writeln!(svg, "<path d=\"M{x:.1} {TOP}V{BOTTOM}\" stroke=\"#ddd\"/>")?;
        writeln!(svg, "<text x=\"{x:.1}\" y=\"{}\" text-anchor=\"middle\">{number}</text>", BOTTOM + 18.0)?;
    }
    for (y, number) in up.numbers() {
        writeln!(svg, "<path d=\"M{LEFT} {y:.1}H{RIGHT}\" stroke=\"#ddd\"/>")?;
        let x = LEFT - 6.0;
        writeln!(svg, "<text x=\"{x}\" y=\"{:.1}\" text-anchor=\"end\">{number}</text>", y + 4.0)?;
    }
    let (x, y) = (f64::midpoint(LEFT, RIGHT), BOTTOM + 40.0);
    writeln!(svg, "<text x=\"{x}\" y=\"{y}\" text-anchor=\"middle\">strain</text>")?;
    writeln!(svg, "<text x=\"{LEFT}\" y=\"{}\" text-anchor=\"middle\">force, N/mm</text>", TOP - 12.0)
}

/// Draws a curve with its points, and its name at the right.
fn draw(svg: &mut String, curve: &Curve, color: &str, axes: &[Axis; 2], number: u32) -> std::fmt::Result {
    let (x, y) = (RIGHT + 14.0, TOP + 14.0 + 22.0 * f64::from(number));
    writeln!(svg, "<path d=\"M{x} {y}h20\" stroke=\"{color}\" stroke-width=\"2\"/>")?;
    writeln!(svg, "<text x=\"{}\" y=\"{}\">{}</text>", x + 26.0, y + 4.0, curve.name)?;
    let drawn = curve.points.iter().filter(|point| point.iter().all(|value| value.is_finite()));
    let places: Vec<[f64; 2]> =
        drawn.map(|[strain, force]| [axes[0].at(*strain), axes[1].at(*force)]).collect();
    let line: Vec<String> = places.iter().map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
    let line = line.join(" ");
    writeln!(svg, "<polyline points=\"{line}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"1.5\"/>")?;
    places.iter().try_for_each(|[x, y]| {
        writeln!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"2.5\" fill=\"{color}\"/>")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_lie_between_the_numbers_of_the_axes() {
        let curve = Curve { name: "courses", points: vec![[0.0, 0.0], [0.2, 0.03], [0.4, 0.1]] };
        let svg = plot(&[curve]);
        // Steps of 0.05 are 60 pixels of strain, and steps of 0.02 are 82 pixels of force.
        assert!(svg.contains("points=\"80.0,440.0 320.0,317.0 560.0,30.0\""), "{svg}");
        assert!(svg.contains("<text x=\"320.0\" y=\"458\" text-anchor=\"middle\">0.20</text>"), "{svg}");
        assert!(svg.contains("y=\"34.0\" text-anchor=\"end\">0.10</text>"), "{svg}");
    }

    #[test]
    fn noise_makes_no_axis_longer() {
        let curve = |points| plot(&[Curve { name: "courses", points }]);
        let clean = curve(vec![[0.0, 0.0], [0.4, 0.7]]);
        let noisy = curve(vec![[0.0, -1e-5], [0.4 + 1e-15, 0.7]]);
        assert_eq!(noisy.matches("<text").count(), clean.matches("<text").count(), "{noisy}");
        assert!(!noisy.contains(">-0.1<") && !noisy.contains(">0.45<"), "{noisy}");
    }

    #[test]
    fn what_is_no_number_is_left_out() {
        let points = vec![[-0.1, -1e-4], [f64::NAN, 1.0], [0.1, f64::INFINITY], [0.1, 1e-4]];
        let svg = plot(&[Curve { name: "wales", points }]);
        assert_eq!(svg.matches("<circle").count(), 2, "{svg}");
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
        assert!(plot(&[]).ends_with("</svg>\n"));
    }
}
