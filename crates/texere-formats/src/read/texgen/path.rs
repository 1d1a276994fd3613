//! The path of a yarn through its master nodes.
//!
//! **Source**: Sherburn, "Geometric and mechanical modelling of textiles", PhD thesis, Nottingham,
//! 2007, and the TexGen library.

use crate::read::spline::Place;

/// How a yarn goes from node to node.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    /// Bézier curves. A handle is a third as long as the way between two nodes, times the length of
    /// the tangent.
    Bezier,
    /// The cubic spline whose second derivative is continuous at every node.
    Cubic,
    /// Straight lines.
    Linear,
}

/// What shapes the path between nodes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Interpolation {
    pub(super) form: Form,
    /// Whether the yarn goes on beyond its last node as it began at its first.
    pub(super) periodic: bool,
    /// Whether tangents at nodes lie in the plane of the textile. It counts for Bézier curves
    /// alone.
    pub(super) in_plane: bool,
}

/// A master node.
#[derive(Debug, Clone, Copy)]
pub(super) struct Node {
    /// Coordinates, mm.
    pub(super) position: [f64; 3],
    /// The tangent, or zeros if the neighbours give it.
    pub(super) tangent: [f64; 3],
    /// The direction of the section's height.
    pub(super) up: [f64; 3],
}

type Vector = [f64; 3];

fn each(number: impl Fn(usize) -> f64) -> Vector {
    std::array::from_fn(number)
}

fn length(vector: Vector) -> f64 {
    vector.iter().map(|axis| axis * axis).sum::<f64>().sqrt()
}

/// The vector with length 1, or zeros if it has no direction.
pub(super) fn unit(vector: Vector) -> Vector {
    let length = length(vector);
    if length > 0.0 { vector.map(|axis| axis / length) } else { [0.0; 3] }
}

/// The Bézier curves of a path of two nodes or more. All their places get the `radius`.
pub(super) fn pieces(nodes: &[Node], how: Interpolation, radius: f64) -> Vec<[Place; 4]> {
    let handles = match how.form {
        Form::Bezier => bezier(nodes, how),
        Form::Cubic => cubic(nodes, how.periodic),
        Form::Linear => nodes.windows(2).map(|pair| [thirds(pair); 2]).collect(),
    };
    let place = |[x, y, z]: Vector| [x, y, z, radius];
    let piece = |(pair, [leaving, arriving]): (&[Node], &[Vector; 2])| {
        let (start, end) = (pair[0].position, pair[1].position);
        let first = each(|axis| start[axis] + leaving[axis]);
        let second = each(|axis| end[axis] - arriving[axis]);
        [start, first, second, end].map(place)
    };
    nodes.windows(2).zip(&handles).map(piece).collect()
}

/// A third of the way from one node to the next.
fn thirds(pair: &[Node]) -> Vector {
    each(|axis| (pair[1].position[axis] - pair[0].position[axis]) / 3.0)
}

/// The handles from each node, and to the next. They lie along the tangents. A node that gives no
/// tangent has one that is parallel to the way between its neighbours.
fn bezier(nodes: &[Node], how: Interpolation) -> Vec<[Vector; 2]> {
    let last = nodes.len() - 1;
    let tangent = |number: usize| {
        let node = nodes[number];
        let own = if node.tangent != [0.0; 3] {
            node.tangent
        } else {
            let step =
                |from: usize, to: usize, axis: usize| nodes[to].position[axis] - nodes[from].position[axis];
            let before = |axis| match number {
                0 if how.periodic => step(last - 1, last, axis),
                0 => 0.0,
                _ => step(number - 1, number, axis),
            };
            let after = |axis| match number {
                _ if number < last => step(number, number + 1, axis),
                _ if how.periodic => step(0, 1, axis),
                _ => 0.0,
            };
            unit(each(|axis| before(axis) + after(axis)))
        };
        if how.in_plane { [own[0], own[1], 0.0] } else { own }
    };
    let handle = |(number, pair): (usize, &[Node])| {
        let third = length(thirds(pair));
        [number, number + 1].map(|end| tangent(end).map(|axis| axis * third))
    };
    nodes.windows(2).enumerate().map(handle).collect()
}

/// The handles of a cubic spline: a third of its derivatives at the nodes.
fn cubic(nodes: &[Node], periodic: bool) -> Vec<[Vector; 2]> {
    let axes: [Vec<f64>; 3] = std::array::from_fn(|axis| {
        let steps = nodes.windows(2).map(|pair| pair[1].position[axis] - pair[0].position[axis]);
        let steps: Vec<_> = steps.collect();
        if periodic { periodic_derivatives(&steps) } else { natural_derivatives(&steps) }
    });
    let handle = |number: usize| [number, number + 1].map(|end| each(|axis| axes[axis][end] / 3.0));
    (0..nodes.len() - 1).map(handle).collect()
}

/// The derivatives, at each of its knots, of a natural cubic spline whose knots are `steps` apart.
fn natural_derivatives(steps: &[f64]) -> Vec<f64> {
    let last = steps.len();
    let right = |knot: usize| {
        let before = knot.checked_sub(1).map_or(0.0, |step| steps[step]);
        3.0 * (before + steps.get(knot).copied().unwrap_or(0.0))
    };
    solved(last + 1, |knot| if knot == 0 || knot == last { 2.0 } else { 4.0 }, right)
}

/// The derivatives, at each of its knots, of a periodic cubic spline whose knots are `steps` apart.
///
/// The first equation also names the last derivative, and the last equation the first one. A second
/// solution accounts for these two terms (Sherman and Morrison, 1950).
fn periodic_derivatives(steps: &[f64]) -> Vec<f64> {
    // With fewer than three knots, an equation would name one derivative more than once. The spline
    // does not change if its period is taken three times.
    let all = if steps.len() < 3 { steps.repeat(3) } else { steps.to_vec() };
    let count = all.len();
    let right = |knot: usize| 3.0 * (all[knot] + all[(knot + count - 1) % count]);
    // The matrix of the equations is the one with this diagonal plus the product of a column and a
    // row. The column and the row have 1 at both ends, and 0 between.
    let diagonal = |knot: usize| if knot == 0 || knot == count - 1 { 3.0 } else { 4.0 };
    let plain = solved(count, diagonal, right);
    let beside = solved(count, diagonal, |knot| if knot == 0 || knot == count - 1 { 1.0 } else { 0.0 });
    let share = (plain[0] + plain[count - 1]) / (1.0 + beside[0] + beside[count - 1]);
    let found: Vec<_> = plain.iter().zip(&beside).map(|(plain, beside)| plain - share * beside).collect();
    (0..=steps.len()).map(|knot| found[knot % count]).collect()
}

/// The solution of `count` equations, each of which names its own unknown with the factor
/// `diagonal` and both neighbours with the factor 1.
fn solved(count: usize, diagonal: impl Fn(usize) -> f64, right: impl Fn(usize) -> f64) -> Vec<f64> {
    // Each equation is taken from the next one, and then the unknowns are found from the last on.
    let mut factors: Vec<f64> = Vec::with_capacity(count);
    let mut found: Vec<f64> = Vec::with_capacity(count);
    for row in 0..count {
        let (before, carried) = if row == 0 { (0.0, 0.0) } else { (factors[row - 1], found[row - 1]) };
        let pivot = diagonal(row) - before;
        factors.push(1.0 / pivot);
        found.push((right(row) - carried) / pivot);
    }
    for row in (0..count.saturating_sub(1)).rev() {
        found[row] -= factors[row] * found[row + 1];
    }
    found
}
