//! The kinds of curves that a stage may hold, and the splines of texere that have their shape.
//!
//! **Source**: Pixar, "UsdGeomBasisCurves", openusd.org.

/// The form of curves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    Linear,
    CatmullRom,
    Bezier,
    BSpline,
}

/// How curves end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Wrap {
    /// The first and the last vertex may shape the ends without lying on the curve.
    Nonperiodic,
    /// The end is the start.
    Periodic,
    /// The curve begins at the first vertex and ends at the last one.
    Pinned,
}

/// Coordinates and the radius at a place of a curve, mm.
pub(super) type Place = [f64; 4];

/// A curve.
#[derive(Debug)]
pub(super) struct Curve {
    pub(super) shape: Shape,
    pub(super) is_closed: bool,
}

/// What says where a curve runs.
#[derive(Debug)]
pub(super) enum Shape {
    /// A spline of tension 0 runs through these places.
    Through(Vec<Place>),
    /// Bézier curves of four places each, each of which begins where the one before it ends.
    Pieces(Vec<[Place; 4]>),
}

/// The most intervals that a Bézier piece becomes. A piece that needs more is longer than 10,000 of
/// its radii, or has a cusp.
const PARTS_MOST: usize = 64;

/// How far a spline may run beside a Bézier curve that it stands for, as a share of the radius. No
/// picture shows a hundredth. With a tenth `curves_of_every_basis_run_where_they_should` is red.
const BESIDE: f64 = 0.01;

impl Form {
    /// How many vertices of a curve of `count` have a value that varies along the curve, or none if
    /// no curve has so many.
    pub(super) fn varying(self, wrap: Wrap, count: usize) -> Option<usize> {
        let least = match (self, wrap) {
            (Self::Linear | Self::CatmullRom | Self::BSpline, Wrap::Periodic) | (Self::Bezier, _) => 3,
            (Self::Linear, _) | (_, Wrap::Pinned) => 2,
            _ => 4,
        };
        let values = match (self, wrap) {
            (Self::Bezier, Wrap::Periodic) if count.is_multiple_of(3) => count / 3,
            (Self::Bezier, Wrap::Nonperiodic | Wrap::Pinned) if count % 3 == 1 => count / 3 + 1,
            (Self::Bezier, _) => return None,
            (Self::CatmullRom | Self::BSpline, Wrap::Nonperiodic) => count.checked_sub(2)?,
            _ => count,
        };
        (count >= least).then_some(values)
    }
}

impl Curve {
    /// The curve of some vertices, whose number [`Form::varying`] accepts. `radii` are those that
    /// vary along the curve. Without them each vertex has its own.
    pub(super) fn new(form: Form, wrap: Wrap, vertices: Vec<Place>, radii: Option<&[f64]>) -> Self {
        let is_periodic = wrap == Wrap::Periodic;
        let mut curve = match form {
            Form::Linear => through(vertices, is_periodic),
            Form::CatmullRom => catmull_rom(vertices, wrap),
            Form::Bezier => {
                let count = vertices.len();
                let pieces = (0..count.saturating_sub(1)).step_by(3);
                let pieces = pieces.map(|at| std::array::from_fn(|vertex| vertices[(at + vertex) % count]));
                Self { shape: Shape::Pieces(pieces.collect()), is_closed: is_periodic }
            }
            Form::BSpline => b_spline(&vertices, wrap),
        };
        if let Some(radii) = radii {
            curve.vary(radii);
        }
        curve.join();
        curve
    }

    /// Gives the curve radii that vary along it.
    fn vary(&mut self, radii: &[f64]) {
        match &mut self.shape {
            Shape::Through(places) => {
                places.iter_mut().zip(radii.iter().cycle()).for_each(|(place, radius)| place[3] = *radius);
            }
            Shape::Pieces(pieces) => {
                for (number, piece) in pieces.iter_mut().enumerate() {
                    let [from, to] = [radii[number], radii[(number + 1) % radii.len()]];
                    for (part, place) in piece.iter_mut().enumerate() {
                        place[3] = from + (to - from) * part as f64 / 3.0;
                    }
                }
            }
        }
    }

    /// Closes a curve of Bézier pieces that ends where it begins.
    fn join(&mut self) {
        if let Shape::Pieces(pieces) = &self.shape
            && let [first, _, .., last] = &pieces[..]
        {
            self.is_closed |= first[0] == last[3];
        }
    }
}

/// A spline through places. One that ends where it begins is closed.
fn through(mut places: Vec<Place>, is_periodic: bool) -> Curve {
    let ends_at_start = !is_periodic && places.len() > 3 && places.first() == places.last();
    if ends_at_start {
        places.pop();
    }
    Curve { shape: Shape::Through(places), is_closed: is_periodic || ends_at_start }
}

/// Catmull-Rom curves are splines of tension 0. A nonperiodic one has a vertex beyond each end. If
/// these are the vertices before its end and after its start, and it ends where it begins, the
/// curve is closed.
fn catmull_rom(mut vertices: Vec<Place>, wrap: Wrap) -> Curve {
    if wrap != Wrap::Nonperiodic {
        return Curve { shape: Shape::Through(vertices), is_closed: wrap == Wrap::Periodic };
    }
    let is_closed = match &vertices[..] {
        [before, start, after, .., last, end, beyond] if vertices.len() > 5 => {
            start == end && before == last && after == beyond
        }
        _ => false,
    };
    vertices.pop();
    if is_closed {
        vertices.pop();
    }
    vertices.remove(0);
    Curve { shape: Shape::Through(vertices), is_closed }
}

fn b_spline(vertices: &[Place], wrap: Wrap) -> Curve {
    let count = vertices.len();
    let beyond =
        |from: usize, to: usize| std::array::from_fn(|axis| 2.0 * vertices[from][axis] - vertices[to][axis]);
    let vertex = |number: usize| match wrap {
        Wrap::Nonperiodic => vertices[number],
        Wrap::Periodic => vertices[number % count],
        Wrap::Pinned if number == 0 => beyond(0, 1),
        Wrap::Pinned if number == count + 1 => beyond(count - 1, count - 2),
        Wrap::Pinned => vertices[number - 1],
    };
    let pieces = match wrap {
        Wrap::Nonperiodic => count - 3,
        Wrap::Periodic => count,
        Wrap::Pinned => count - 1,
    };
    let piece = |number| {
        let [a, b, c, d] = std::array::from_fn(|place| vertex(number + place));
        let mixed = |shares: [f64; 4]| -> Place {
            std::array::from_fn(|axis| {
                (shares[0] * a[axis] + shares[1] * b[axis] + shares[2] * c[axis] + shares[3] * d[axis]) / 6.0
            })
        };
        [[1.0, 4.0, 1.0, 0.0], [0.0, 4.0, 2.0, 0.0], [0.0, 2.0, 4.0, 0.0], [0.0, 1.0, 4.0, 1.0]].map(mixed)
    };
    Curve { shape: Shape::Pieces((0..pieces).map(piece).collect()), is_closed: wrap == Wrap::Periodic }
}

/// The tension of splines through the ends of all Bézier pieces that have the pieces' shape, if
/// there is one. It is 0 if the curves have no pieces.
pub(super) fn tension(curves: &[Curve]) -> Option<f32> {
    let (mut along, mut square) = (0.0, 0.0);
    handles(curves, |[offset, step], _| {
        along += dot(offset, step);
        square += dot(step, step);
    });
    let has_lines = curves.iter().any(|curve| matches!(curve.shape, Shape::Through(_)));
    // The handle of a spline of tension 0 is a sixth of the way between its neighbours.
    let share = if has_lines || square == 0.0 { 1.0 / 6.0 } else { along / square };
    let mut fits = (0.0..1.0 / 6.0 + 1e-3).contains(&share) && share > 0.0;
    handles(curves, |[offset, step], radius| {
        let off: Place = std::array::from_fn(|axis| offset[axis] - share * step[axis]);
        fits &= dot(off, off).sqrt() <= BESIDE * radius;
    });
    fits.then_some((1.0 - 6.0 * share).max(0.0) as f32)
}

/// Calls `each` for both handles at each end of a Bézier piece: from the end to the handle, and
/// between the neighbours of the end, with the radius there. At the two ends of an open curve the
/// neighbour beyond it is as far away as the one within.
fn handles(curves: &[Curve], mut each: impl FnMut([Place; 2], f64)) {
    let from_to = |from: Place, to: Place| std::array::from_fn(|axis| to[axis] - from[axis]);
    for curve in curves {
        let Shape::Pieces(pieces) = &curve.shape else { continue };
        let count = pieces.len();
        for (number, &[start, leaving, arriving, end]) in pieces.iter().enumerate() {
            let before = (curve.is_closed || number > 0).then(|| pieces[(number + count - 1) % count][0]);
            let after = (curve.is_closed || number + 1 < count).then(|| pieces[(number + 1) % count][3]);
            let twice = |step: Place| step.map(|axis| 2.0 * axis);
            let step = before.map_or_else(|| twice(from_to(start, end)), |before| from_to(before, end));
            each([from_to(start, leaving), step], start[3]);
            let step = after.map_or_else(|| twice(from_to(end, start)), |after| from_to(after, start));
            each([from_to(end, arriving), step], end[3]);
        }
    }
}

/// The product of two steps, without their radii.
fn dot(a: Place, b: Place) -> f64 {
    (0..3).map(|axis| a[axis] * b[axis]).sum()
}

impl Curve {
    /// The places that a spline runs through: the ends of Bézier pieces.
    pub(super) fn ends(&self) -> Vec<Place> {
        match &self.shape {
            Shape::Through(places) => places.clone(),
            Shape::Pieces(_) => self.sampled(1),
        }
    }

    /// The places that a spline of tension 0 runs through, so many that it is the curve within a
    /// hundredth of the radius.
    pub(super) fn places(&self) -> Vec<Place> {
        let Shape::Pieces(pieces) = &self.shape else { return self.ends() };
        let mut parts = if self.is_closed && pieces.len() < 3 { 4 } else { 1 };
        while parts < PARTS_MOST && self.is_beside(&self.sampled(parts), parts) {
            parts *= 2;
        }
        self.sampled(parts)
    }

    /// Places on the pieces, `parts` for each.
    fn sampled(&self, parts: usize) -> Vec<Place> {
        let Shape::Pieces(pieces) = &self.shape else { return Vec::new() };
        let within =
            pieces.iter().flat_map(|piece| (0..parts).map(|part| at(piece, part as f64 / parts as f64)));
        within.chain(pieces.last().filter(|_| !self.is_closed).map(|piece| piece[3])).collect()
    }

    /// Whether the spline through `places` runs beside the pieces in the middle of its intervals.
    fn is_beside(&self, places: &[Place], parts: usize) -> bool {
        let Shape::Pieces(pieces) = &self.shape else { return false };
        let count = places.len();
        let reflected =
            |from: Place, to: Place| -> Place { std::array::from_fn(|axis| 2.0 * from[axis] - to[axis]) };
        (0..pieces.len() * parts).any(|interval| {
            let (start, end) = (places[interval], places[(interval + 1) % count]);
            let (opens, closes) = (interval == 0, interval + 2 > count - 1);
            let before = if self.is_closed || !opens {
                places[(interval + count - 1) % count]
            } else {
                reflected(start, end)
            };
            let after = if self.is_closed || !closes {
                places[(interval + 2) % count]
            } else {
                reflected(end, start)
            };
            let should = at(&pieces[interval / parts], ((interval % parts) as f64 + 0.5) / parts as f64);
            let off: Place = std::array::from_fn(|axis| {
                (9.0 * (start[axis] + end[axis]) - before[axis] - after[axis]) / 16.0 - should[axis]
            });
            dot(off, off).sqrt() > BESIDE * should[3]
        })
    }
}

/// The place at parameter `t` of a Bézier curve. Its ends are exact.
fn at(piece: &[Place; 4], t: f64) -> Place {
    let s = 1.0 - t;
    let shares = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
    std::array::from_fn(|axis| shares.iter().zip(piece).map(|(share, place)| share * place[axis]).sum())
}
