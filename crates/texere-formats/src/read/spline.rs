//! Curves of other programs, and the splines of texere that have their shape.
//!
//! A spline runs through its control points, so the ends of Bézier pieces are such points. If all
//! curves are splines of one tension, these points are enough. Else each interval in which a spline
//! of tension 0 runs too far beside the pieces is halved, again and again.

use texere_core::OutOfMemory;
use texere_core::backend::{room, room_for};

/// Coordinates and the radius at a place of a curve, mm.
pub(super) type Place = [f64; 4];

/// A curve.
#[derive(Debug)]
pub(super) struct Curve {
    pub(super) shape: Shape,
    pub(super) is_closed: bool,
    /// Whether the file has radii at the ends of pieces alone. Between the ends, the radii are the
    /// spline's own.
    pub(super) has_radii_at_ends: bool,
}

/// What says where a curve runs.
#[derive(Debug)]
pub(super) enum Shape {
    /// A spline of tension 0 runs through these places.
    Through(Vec<Place>),
    /// Bézier curves of four places each. A curve begins where the one before it ends.
    Pieces(Vec<[Place; 4]>),
}

/// The shortest interval of a Bézier piece, in its parameter. Only corners, at which pieces meet,
/// make intervals so short. With 1/16 the test `curves_of_every_basis_run_where_they_should` fails.
const SHORTEST: f64 = 1.0 / 64.0;

/// How far a spline may run beside a Bézier curve that it stands for, as a share of the radius. A
/// picture does not show this. With 0.1 the test `curves_of_every_basis_run_where_they_should`
/// fails.
const BESIDE: f64 = 0.01;

/// The most by which the spline's radius may differ from the curve's, as a share of the radius. A
/// difference of radii shows less than a shift does. Without this limit the test
/// `widths_within_a_piece_are_kept` fails.
const THICKER: f64 = 0.02;

/// The one tension with which splines through the ends of all pieces have the pieces' shape, if
/// there is one. It is 0 if the curves have no pieces.
pub(super) fn tension<'a>(curves: impl Iterator<Item = &'a Curve> + Clone) -> Option<f32> {
    let (mut along, mut square) = (0.0, 0.0);
    handles(curves.clone(), |_, [offset, step], _| {
        along += dot(offset, step);
        square += dot(step, step);
    });
    let is_through = |curve: &Curve| matches!(curve.shape, Shape::Through(_));
    // With tension 0, the handle at a control point is a sixth of the way between the point's
    // neighbours.
    let share = if curves.clone().any(is_through) || square == 0.0 { 1.0 / 6.0 } else { along / square };
    // A closed yarn has three control points or more.
    let is_short =
        |curve: &Curve| curve.is_closed && matches!(&curve.shape, Shape::Pieces(pieces) if pieces.len() < 3);
    let mut fits = share > 0.0 && share < 1.0 / 6.0 + 1e-3 && !curves.clone().any(is_short);
    handles(curves, |curve, [offset, step], radius| {
        let off: Place = std::array::from_fn(|axis| offset[axis] - share * step[axis]);
        fits &= dot(off, off).sqrt() <= BESIDE * radius;
        fits &= curve.has_radii_at_ends || off[3].abs() <= THICKER * radius;
    });
    fits.then_some((1.0 - 6.0 * share).max(0.0) as f32)
}

/// Calls `each` for both handles of each Bézier piece, with two steps and a radius. The first step
/// goes from an end of the piece to the handle there. The second step goes past this end, from one
/// neighbour to the other: the neighbours are the nearest ends of pieces before and after it. The
/// radius is that of the end. An end of an open curve has only one neighbour. The other one is
/// taken to lie on the opposite side of the end, as far away.
fn handles<'a>(curves: impl Iterator<Item = &'a Curve>, mut each: impl FnMut(&Curve, [Place; 2], f64)) {
    let from_to = |from: Place, to: Place| std::array::from_fn(|axis| to[axis] - from[axis]);
    for curve in curves {
        let Shape::Pieces(pieces) = &curve.shape else { continue };
        let count = pieces.len();
        for (number, &[start, leaving, arriving, end]) in pieces.iter().enumerate() {
            let before = (curve.is_closed || number > 0).then(|| pieces[(number + count - 1) % count][0]);
            let after = (curve.is_closed || number + 1 < count).then(|| pieces[(number + 1) % count][3]);
            let twice = |step: Place| step.map(|axis| 2.0 * axis);
            let step = before.map_or_else(|| twice(from_to(start, end)), |before| from_to(before, end));
            each(curve, [from_to(start, leaving), step], start[3]);
            let step = after.map_or_else(|| twice(from_to(end, start)), |after| from_to(after, start));
            each(curve, [from_to(end, arriving), step], end[3]);
        }
    }
}

/// The product of two steps, without their radii.
fn dot(a: Place, b: Place) -> f64 {
    (0..3).map(|axis| a[axis] * b[axis]).sum()
}

/// The control points of a spline that has the shape of a curve, with the tension that
/// [`tension`] found for all curves, or else with tension 0.
///
/// **Errors**: [`OutOfMemory`].
pub(super) fn control_points(curve: Curve, is_spline: bool) -> Result<Vec<Place>, OutOfMemory> {
    let pieces = match curve.shape {
        Shape::Through(places) => return Ok(places),
        Shape::Pieces(pieces) => pieces,
    };
    let cuts = cuts(&pieces, curve.is_closed, is_spline)?;
    let mut places = room("points of curves", cuts.len())?;
    places.extend(cuts.iter().map(|cut| cut.place));
    Ok(places)
}

/// The places on a curve's pieces through which a spline of its shape runs: those of
/// [`control_points`].
///
/// **Errors**: [`OutOfMemory`].
pub(super) fn cuts(pieces: &[[Place; 4]], is_closed: bool, is_spline: bool) -> Result<Vec<Cut>, OutOfMemory> {
    let fewest = if is_closed && pieces.len() < 3 { 4 } else { 1 };
    let mut cuts = room("points of curves", fewest * pieces.len() + 1)?;
    for (number, piece) in pieces.iter().enumerate() {
        cuts.extend((0..fewest).map(|part| Cut::new(number, piece, part as f64 / fewest as f64)));
    }
    let last = pieces.iter().enumerate().next_back().filter(|_| !is_closed);
    cuts.extend(last.map(|(number, piece)| Cut::new(number, piece, 1.0)));
    while !is_spline && let Some(more) = halved(pieces, &cuts, is_closed)? {
        cuts = more;
    }
    Ok(cuts)
}

/// A place on a Bézier piece through which the spline runs.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cut {
    /// The number of the piece.
    pub(super) piece: usize,
    /// The parameter of the place, from 0 to 1.
    pub(super) t: f64,
    pub(super) place: Place,
}

impl Cut {
    fn new(number: usize, piece: &[Place; 4], t: f64) -> Self {
        Self { piece: number, t, place: at(piece, t) }
    }
}

/// The cuts, and one more in the middle of each interval in which the spline runs too far beside
/// the pieces. None if there is no such interval, or if all of them are the shortest already.
fn halved(pieces: &[[Place; 4]], cuts: &[Cut], is_closed: bool) -> Result<Option<Vec<Cut>>, OutOfMemory> {
    let count = cuts.len();
    let place = |cut: usize| cuts[cut % count].place;
    let reflected = |from: Place, to: Place| std::array::from_fn(|axis| 2.0 * from[axis] - to[axis]);
    let mut more = Vec::new();
    for (number, &cut) in cuts.iter().enumerate() {
        room_for(&mut more, 2, "points of curves")?;
        more.push(cut);
        if !is_closed && number + 1 == count {
            break;
        }
        let next = cuts[(number + 1) % count];
        let until = if next.piece == cut.piece && next.t > cut.t { next.t } else { 1.0 };
        let middle = Cut::new(cut.piece, &pieces[cut.piece], (cut.t + until) / 2.0);
        let (start, end) = (cut.place, next.place);
        let before = if is_closed || number > 0 { place(number + count - 1) } else { reflected(start, end) };
        let after = if is_closed || number + 2 < count { place(number + 2) } else { reflected(end, start) };
        if until - cut.t > SHORTEST && is_beside([before, start, end, after], middle.place) {
            more.push(middle);
        }
    }
    Ok((more.len() > count).then_some(more))
}

/// Whether the middle of a spline's interval is beside the place where it should be.
fn is_beside([before, start, end, after]: [Place; 4], should: Place) -> bool {
    let mut off: Place = std::array::from_fn(|axis| {
        (9.0 * (start[axis] + end[axis]) - before[axis] - after[axis]) / 16.0 - should[axis]
    });
    // Along the curve a shift does not change its shape.
    let step: Place = std::array::from_fn(|axis| end[axis] - start[axis]);
    let share = if dot(step, step) > 0.0 { dot(off, step) / dot(step, step) } else { 0.0 };
    (0..3).for_each(|axis| off[axis] -= share * step[axis]);
    dot(off, off).sqrt() > BESIDE * should[3] || off[3].abs() > THICKER * should[3]
}

/// Both parts of a Bézier curve that is cut at parameter `t` (de Casteljau).
pub(super) fn cut_at(piece: &[Place; 4], t: f64) -> [[Place; 4]; 2] {
    let mixed =
        |a: Place, b: Place| -> Place { std::array::from_fn(|axis| a[axis] + (b[axis] - a[axis]) * t) };
    let [a, b, c, d] = *piece;
    let [ab, bc, cd] = [mixed(a, b), mixed(b, c), mixed(c, d)];
    let [abc, bcd] = [mixed(ab, bc), mixed(bc, cd)];
    let middle = mixed(abc, bcd);
    [[a, ab, abc, middle], [middle, bcd, cd, d]]
}

/// The place at parameter `t` of a Bézier curve. Its ends are exact.
fn at(piece: &[Place; 4], t: f64) -> Place {
    let s = 1.0 - t;
    let shares = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
    std::array::from_fn(|axis| shares.iter().zip(piece).map(|(share, place)| share * place[axis]).sum())
}
