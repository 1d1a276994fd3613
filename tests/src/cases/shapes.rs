//! Single yarns, each with one difficulty for a backend.

use std::f64::consts::TAU;

use texere_core::{ControlPoint, Yarn};

/// A yarn with a name.
pub(super) struct Shape {
    pub(super) name: &'static str,
    pub(super) yarn: Yarn,
    pub(super) points: Vec<ControlPoint>,
}

const RADIUS: f64 = 0.25;

fn point([x, y, z]: [f64; 3], radius: f64) -> ControlPoint {
    ControlPoint::new(x as f32, y as f32, z as f32, radius as f32)
}

/// Points of equal thickness along `curve`.
fn along(count: u32, curve: impl Fn(f64) -> [f64; 3]) -> Vec<ControlPoint> {
    (0..count).map(|k| point(curve(f64::from(k)), RADIUS)).collect()
}

fn listed(points: &[[f64; 3]]) -> Vec<ControlPoint> {
    points.iter().map(|&at| point(at, RADIUS)).collect()
}

fn open(name: &'static str, points: Vec<ControlPoint>) -> Shape {
    Shape { name, yarn: Yarn::default(), points }
}

fn closed(name: &'static str, points: Vec<ControlPoint>) -> Shape {
    Shape { name, yarn: Yarn { closed: true, ..Yarn::default() }, points }
}

fn twisted(shape: Shape, twist: f32) -> Shape {
    Shape { yarn: Yarn { twist, ..shape.yarn }, ..shape }
}

fn moved(shape: Shape, [x, y]: [f32; 2]) -> Shape {
    let shift = |point: &ControlPoint| ControlPoint { x: point.x + x, y: point.y + y, ..*point };
    Shape { points: shape.points.iter().map(shift).collect(), ..shape }
}

fn thick_and_thin(name: &'static str, radii: &[f64]) -> Shape {
    let points = radii.iter().enumerate().map(|(k, &radius)| {
        let k = k as f64;
        point([k, (k * 0.7).sin(), (k * 0.9).cos()], radius)
    });
    open(name, points.collect())
}

/// A winding yarn whose points have these half widths and half heights.
fn flattened(name: &'static str, halves: &[[f32; 2]]) -> Shape {
    let points = halves.iter().enumerate().map(|(k, &[half_width, half_height])| {
        let k = k as f64;
        point([k, (k * 0.7).sin(), (k * 0.9).cos()], RADIUS).flattened(half_width, half_height)
    });
    open(name, points.collect())
}

fn helix(k: f64, per_turn: f64, radius: f64, rise: f64) -> [f64; 3] {
    let (sin, cos) = (TAU * k / per_turn).sin_cos();
    [radius * cos, radius * sin, rise * k]
}

/// A torus knot, which winds three times around a ring's tube while it goes round the ring twice.
fn torus_knot(k: f64, count: f64) -> [f64; 3] {
    let (sin, cos) = (2.0 * TAU * k / count).sin_cos();
    let (winding_sin, winding_cos) = (3.0 * TAU * k / count).sin_cos();
    let out = 4.0 + 1.5 * winding_cos;
    [out * cos, out * sin, 1.5 * winding_sin]
}

/// A weft yarn in plain weave.
fn wave(k: f64) -> [f64; 3] {
    [k, 0.0, if (k as u32).is_multiple_of(2) { 0.25 } else { -0.25 }]
}

/// A course of plain loops, with twelve points a loop. The legs of the loops are as steep as in a
/// knit.
fn loops(k: f64) -> [f64; 3] {
    const HALF: [[f64; 3]; 7] = [
        [0.0, 0.0, -0.84],
        [0.31, 0.083, -0.48],
        [0.36, 0.285, 0.41],
        [0.25, 0.5, 0.98],
        [0.14, 0.715, 0.41],
        [0.19, 0.917, -0.48],
        [0.5, 1.0, -0.84],
    ];
    let (stitch, node) = (k as usize / 12, k as usize % 12);
    let [x, y, z] = if node < 7 { HALF[node] } else { HALF[12 - node] };
    let x = if node < 7 { x } else { 1.0 - x };
    [(stitch as f64 + x) * 2.0, y * 2.6, z * 0.35]
}

/// All shapes.
pub(super) fn all() -> Vec<Shape> {
    let mut shapes = straight();
    shapes.extend(round());
    shapes.extend(turning_back());
    shapes.extend(standing_still());
    shapes.extend(far());
    shapes.extend(uneven());
    shapes.extend(flat());
    shapes
}

fn straight() -> Vec<Shape> {
    vec![
        open("straight", along(5, |k| [k, 0.0, 0.0])),
        open("straight-oblique", along(5, |k| [k, 2.0 * k, -2.0 * k])),
        open("straight-up", along(5, |k| [0.5, 0.25, k])),
        open("straight-down", along(5, |k| [0.5, 0.25, -k])),
        // The yarn is less than a milliradian off z. There the frame is sensitive to rounding, but
        // its rule for the vertical does not apply.
        open("nearly-up", along(5, |k| [k * 1e-4, k * 8e-4, k])),
        open("one-interval", listed(&[[0.0, 0.0, 0.0], [1.0, 2.0, 0.5]])),
        open("one-interval-up", listed(&[[0.0, 0.0, 0.0], [0.0, 0.0, 2.0]])),
        open("uneven-spacing", listed(&[[0.0; 3], [0.125, 0.0, 0.0], [4.0, 1.0, 0.0], [4.25, 1.5, 1.0]])),
    ]
}

fn round() -> Vec<Shape> {
    let circle = |k: f64| (TAU * k / 12.0).sin_cos();
    vec![
        closed("circle-flat", along(12, |k| [circle(k).1 * 3.0, circle(k).0 * 3.0, 0.0])),
        // The tangent passes through the vertical twice, at a control point.
        closed("circle-upright", along(12, |k| [circle(k).1 * 3.0, 0.0, circle(k).0 * 3.0])),
        closed("circle-tilted", along(12, |k| [circle(k).1 * 3.0, circle(k).0 * 2.4, circle(k).0 * 1.8])),
        closed("triangle", listed(&[[0.0; 3], [4.0, 0.0, 0.0], [2.0, 3.0, 1.0]])),
        open("arc-over", along(9, |k| [-3.0 * circle(k).1, 0.5 * k, 3.0 * circle(k).0])),
        open("helix", along(40, |k| helix(k, 10.0, 2.0, 0.2))),
        open(
            "helix-lying",
            along(40, |k| {
                let [x, y, z] = helix(k, 10.0, 2.0, 0.2);
                [z, x, y]
            }),
        ),
        closed("helix-closed", along(48, |k| torus_knot(k, 48.0))),
        open("wave", along(40, wave)),
        open("loops", along(37, loops)),
    ]
}

fn turning_back() -> Vec<Shape> {
    vec![
        open("hairpin", listed(&[[0.0; 3], [2.0, 0.0, 0.0], [0.0; 3]])),
        open("hairpin-oblique", listed(&[[0.0; 3], [1.0, 2.0, 1.0], [3.0, 6.0, 3.0], [1.0, 2.0, 1.0]])),
        // Coordinates are not exact in f32. Derivatives that should be zero are rounding errors.
        open("hairpin-askew", listed(&[[0.1, 0.2, 0.3], [0.7, 1.6, -0.1], [0.1, 0.2, 0.3]])),
        open("hairpin-up", listed(&[[0.0; 3], [0.0, 0.0, 2.0], [0.0; 3]])),
        closed("hairpin-closed", listed(&[[0.0; 3], [2.0, 0.0, 0.0], [4.0, 0.0, 0.0], [2.0, 0.0, 0.0]])),
        // At tension 0 velocity and acceleration vanish at the second point.
        open("cusp-flat", listed(&[[1.0, 0.5, 0.0], [0.0; 3], [1.0, 0.5, 0.0], [6.0, 3.0, 0.0]])),
        // At tension 0 the velocity vanishes half way between the middle points.
        open("cusp", listed(&[[-5.0, 2.0, 0.0], [0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [6.0, 2.0, 0.0]])),
        // The yarn lies in a plane of constant x. Each point lies further on, but between the
        // second and the third point the spline goes back for a while.
        open(
            "back-stitch",
            listed(&[[0.5, 0.0, 0.0], [0.5, 1.0, 0.1], [0.5, 1.01, -0.1], [0.5, 2.01, 0.2], [0.5, 3.0, 0.0]]),
        ),
        open(
            "zigzag",
            along(12, |k| [k * 0.25, if (k as u32).is_multiple_of(2) { 0.0 } else { 2.0 }, 0.1 * k]),
        ),
    ]
}

fn standing_still() -> Vec<Shape> {
    let (a, b, c, d) = ([0.0; 3], [1.0, 0.5, 0.0], [2.0, 0.0, 1.0], [3.0, 1.0, 1.0]);
    vec![
        open("repeated-start", listed(&[a, a, b, c])),
        open("repeated-middle", listed(&[a, b, b, c, d])),
        open("repeated-thrice", listed(&[a, b, b, b, c])),
        open("repeated-end", listed(&[a, b, c, c])),
        open("repeated-all", listed(&[b, b, b, b])),
        open("repeated-pair", listed(&[b, b])),
        closed("repeated-closed", listed(&[a, b, b, c, d])),
        closed("repeated-all-closed", listed(&[c, c, c])),
    ]
}

fn far() -> Vec<Shape> {
    vec![
        moved(open("far-wave", along(20, wave)), [1e4, -1e4]),
        moved(open("far-loops", along(37, loops)), [1e4, 1e4]),
        moved(closed("far-helix-closed", along(48, |k| torus_knot(k, 48.0))), [-1e4, 1e4]),
        // The yarn lies far from the origin, where neighbouring f32 values are a sixteenth of a mm
        // apart.
        moved(open("farthest-wave", along(20, |k| wave(k).map(|value| value * 4.0))), [1e6, -1e6]),
        open("long-interval", listed(&[[-5e3, 0.0, 0.0], [5e3, 10.0, 0.0], [5e3, 5e3, 0.0]])),
    ]
}

fn uneven() -> Vec<Shape> {
    let slub = |name| thick_and_thin(name, &[0.25, 0.25, 0.5, 0.75, 0.25, 0.25, 0.125, 0.25]);
    let wave = |name| open(name, along(40, wave));
    let knot = |name| closed(name, along(48, |k| torus_knot(k, 48.0)));
    vec![
        slub("slub"),
        // Between two thin places beside thick ones, the spline of the width dips below zero.
        thick_and_thin("slub-overshooting", &[0.25, 1.0, 0.0625, 0.0625, 1.0, 0.25]),
        thick_and_thin("slub-steep", &[0.01, 2.0, 0.01, 2.0, 0.01]),
        twisted(slub("slub-twisted"), 1.5),
        twisted(wave("twist-z"), 0.8),
        twisted(wave("twist-s"), -0.8),
        twisted(wave("twist-strong"), 900.0),
        twisted(knot("twist-closed"), 0.5),
        twisted(knot("twist-closed-strong"), -300.0),
        twisted(open("twist-up", along(5, |k| [0.5, 0.25, k])), 2.0),
        twisted(open("twist-hairpin", listed(&[[0.0; 3], [2.0, 0.0, 0.0], [0.0; 3]])), 1.0),
        twisted(open("twist-repeated", listed(&[[1.0; 3], [1.0; 3], [1.0; 3]])), 5.0),
    ]
}

fn flat() -> Vec<Shape> {
    let ribbon = |name| flattened(name, &[[0.5, 0.125]; 8]);
    // The yarn is wider than high at four points, as high as wide at three, and higher than wide at
    // one.
    let changing = [
        [0.3, 0.2],
        [0.35, 0.15],
        [0.25, 0.25],
        [0.2, 0.3],
        [0.5, 0.1],
        [0.25, 0.25],
        [0.25, 0.25],
        [0.4, 0.2],
    ];
    let flat_knot = |name| {
        let at =
            |k: f64| point(torus_knot(k, 48.0), RADIUS).flattened(0.3 + 0.1 * (k * 0.4).cos() as f32, 0.2);
        closed(name, (0..48).map(|k| at(f64::from(k))).collect())
    };
    // The yarn rises through the vertical and a little beyond, and becomes level again.
    let binder = |name| {
        let at = |k: f64| {
            let (sin, cos) = (0.1 * TAU * k).sin_cos();
            point([0.8 * k - 1.5 * sin, 0.1 * (2.0 * k).sin(), -2.0 * cos], RADIUS).flattened(0.3, 0.15)
        };
        open(name, (0..31).map(|k| at(f64::from(k))).collect())
    };
    vec![
        ribbon("flat"),
        binder("flat-binder"),
        twisted(binder("flat-binder-twisted"), 1.0),
        flattened("flat-standing", &[[0.125, 0.5]; 6]),
        flattened("flat-changing", &changing),
        // The spline of the height dips below zero, and that of the width does not.
        flattened("flat-overshooting", &[[0.25, 1.0], [0.25, 0.0625], [0.25, 0.0625], [0.25, 1.0]]),
        flattened(
            "flat-round-at-last",
            &[[0.4, 0.2], [0.25, 0.25], [0.25, 0.25], [0.25, 0.25], [0.25, 0.25]],
        ),
        twisted(ribbon("flat-twisted"), 2.0),
        twisted(flattened("flat-changing-twisted", &changing), -1.5),
        flat_knot("flat-closed"),
        twisted(flat_knot("flat-closed-twisted"), 0.7),
        // The yarn runs along z, where the upright side is +y.
        open(
            "flat-up",
            (0..5).map(|k| point([0.5, 0.25, f64::from(k)], RADIUS).flattened(0.4, 0.2)).collect(),
        ),
        open(
            "flat-repeated",
            [0.0, 1.0, 1.0, 2.0].map(|x| point([x, 0.5 * x, 0.0], RADIUS).flattened(0.4, 0.2)).into(),
        ),
    ]
}
