//! The kinds of curves that a stage may hold.
//!
//! **Source**: Pixar, "UsdGeomBasisCurves", openusd.org.

use crate::read::spline::{Curve, Place, Shape};

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

impl Form {
    /// How many vertices of a curve of `count` have a value that varies along the curve. None if no
    /// curve of this form has `count` vertices.
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
                Self::of(Shape::Pieces(pieces.collect()), is_periodic)
            }
            Form::BSpline => b_spline(&vertices, wrap),
        };
        if let Some(radii) = radii {
            curve.vary(radii);
        }
        curve.join();
        curve
    }

    const fn of(shape: Shape, is_closed: bool) -> Self {
        Self { shape, is_closed, has_radii_at_ends: false }
    }

    /// Gives the curve radii that vary along it.
    fn vary(&mut self, radii: &[f64]) {
        self.has_radii_at_ends = true;
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
            && let (Some(first), Some(last)) = (pieces.first(), pieces.last())
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
    Curve::of(Shape::Through(places), is_periodic || ends_at_start)
}

/// Catmull-Rom curves are splines of tension 0. A nonperiodic one has a vertex beyond each end. The
/// curve is closed if it ends where it begins, the vertex beyond its start equals the one before
/// its end, and the vertex beyond its end equals the one after its start.
fn catmull_rom(mut vertices: Vec<Place>, wrap: Wrap) -> Curve {
    if wrap != Wrap::Nonperiodic {
        return Curve::of(Shape::Through(vertices), wrap == Wrap::Periodic);
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
    Curve::of(Shape::Through(vertices), is_closed)
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
    Curve::of(Shape::Pieces((0..pieces).map(piece).collect()), wrap == Wrap::Periodic)
}
