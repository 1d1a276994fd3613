//! Linking: whether yarns have passed through one another on their way from one shape to another.

mod chords;
mod found;
mod images;
mod motion;
mod part;
mod passage;
mod search;
mod shapes;
mod strand;
mod window;

use std::ops::ControlFlow;

use rayon::prelude::*;
use texere_core::{Boundary, Yarns};

pub use self::passage::{LINKING_CHANGE, Linking, Passage};

use self::found::Found;
use self::images::Images;
use self::search::{SEARCH, Search};
use self::shapes::{Shape, Shapes};
use crate::ContactError;
use crate::grid::Grid;
use crate::watch::{Report, Watch};

/// Number of cells in one task, and of intervals in a span.
const TASK: usize = 1024;

/// Finds the places where yarns have passed through one another, from their shapes before and after
/// they were moved.
///
/// The measure is the Gauss linking integral of two pieces of yarn. If the pieces bend, the
/// integral changes little. If one piece passes through the other, it changes by 1. Round each
/// place where a passage may have happened, a window of either yarn is cut out, and the integral of
/// both windows before is compared with the integral after. The yarns have passed if the integral
/// has changed by more than [`LINKING_CHANGE`]. In cloth that is bent, stretched, sheared or rolled
/// up, the integral changes by 0.13 at most. If an end changes sides, or a stitch is dropped or
/// pulled, the integral changes by 0.86 to 1.03, or by 0.8 if this happens half a pitch from the
/// cloth's edge.
///
/// A window has eight control intervals, or reaches five diameters each way if that is more. It
/// holds a crossing and the yarn on both sides of it, and is too short for passages to cancel out.
/// A loop that slips off another passes through it on both sides. In windows of more than 1.3 loops
/// the two passages cancel out.
///
/// Most pairs of windows are left out, because nothing can have passed there. Let all control
/// points move straight from their places before to their places after. Two intervals that stay
/// apart all the way have not passed through one another. Two intervals can only meet if their
/// distance before or after is no more than their motion against one another, so only such pairs
/// are tested. The distance within which pairs are tested is a quarter of a window at most. If two
/// intervals within this distance, before or after, have moved against one another by more than
/// twice the distance, their windows are compared without the test. For yarns that are shifted,
/// bent or stretched together, or slide beside one another, no integral is computed.
///
/// Two pieces of one yarn count like pieces of two yarns if they lie six control intervals or more
/// apart. If need be, their windows are cut short, so that the windows do not overlap. A yarn that
/// slips past a cut end has passed through nothing. With a repeat in `boundary`, yarns meet the
/// copies of other yarns, and windows go on over the edge. A point of `after` that has left the
/// repeat must stay where it is, and must not be moved back into the repeat. Only centrelines are
/// compared, so sections don't matter.
///
/// Time grows with the control points and with how far they have moved. A million control points
/// take half a second on two cores if they have moved little, one second if they have moved half a
/// diameter, and 2.5 seconds if they have moved several diameters. A cloth that is turned round in
/// its plane takes a hundred times as long, because everything is compared. Memory is 17 bytes a
/// control point beside the yarns. The result does not depend on the number of threads.
///
/// **Errors**: [`ContactError::OtherLayout`] if `after` has other yarns or other numbers of control
/// points, [`ContactError::Yarns`] if it has another tension, [`ContactError::Boundary`] for a
/// boundary that is not that of the yarns, [`ContactError::LinkingSize`] for more intervals than
/// are compared (with their copies, of which a small repeat has many), and
/// [`ContactError::OutOfMemory`].
///
/// **Source**: Klenin and Langowski, "Computation of writhe in modeling of supercoiled DNA",
/// Biopolymers 54, 2000, method 1a: the integral as a sum over pairs of chords.
///
/// ```
/// use texere_core::{Boundary, ControlPoint, Yarn, Yarns};
/// // A straight yarn, and one across it that is pushed down through it.
/// let crossing = |z: f32| {
///     let mut yarns = Yarns::builder();
///     let straight = [-4.0, -2.0, 0.0, 2.0, 4.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.25));
///     yarns.yarn(Yarn::default(), &straight);
///     yarns.yarn(Yarn::default(), &straight.map(|point| ControlPoint::new(0.5, point.x, z, 0.25)));
///     yarns.build()
/// };
/// let (before, after) = (crossing(0.5)?, crossing(-0.25)?);
/// let boundary = Boundary::without_repeat(before.layout());
/// let linking = texere_contact::linking(&before, &after, &boundary)?;
/// assert!(linking.passages > 0 && linking.largest > 0.8);
/// assert_eq!(linking.worst[0].places.map(|place| place.yarn), [0, 1]);
/// assert_eq!(texere_contact::linking(&before, &before, &boundary)?.passages, 0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn linking(before: &Yarns, after: &Yarns, boundary: &Boundary) -> Result<Linking, ContactError> {
    linking_with_progress(before, after, boundary, |_| ControlFlow::Continue(()))
}

/// Compares as [`linking()`] does, and calls `progress` with the share of the work done, from 0 to
/// 1, from any thread. `Break` ends the comparison.
///
/// **Errors**: the errors of [`linking()`], and [`ContactError::Cancelled`] if `progress` asks to
/// stop.
///
/// ```
/// use std::ops::ControlFlow;
/// use texere_core::{Boundary, ControlPoint, Yarn, Yarns};
/// use texere_contact::{ContactError, linking_with_progress};
/// # let mut yarns = Yarns::builder();
/// # yarns.yarn(Yarn::default(), &[-1.0, 1.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
/// # let yarns = yarns.build()?;
/// let boundary = Boundary::without_repeat(yarns.layout());
/// let mut share = 0.0;
/// linking_with_progress(&yarns, &yarns, &boundary, |done| {
///     share = done;
///     ControlFlow::Continue(())
/// })?;
/// assert_eq!(share, 1.0);
/// let stopped = linking_with_progress(&yarns, &yarns, &boundary, |_| ControlFlow::Break(()));
/// assert_eq!(stopped, Err(ContactError::Cancelled));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn linking_with_progress(
    before: &Yarns,
    after: &Yarns,
    boundary: &Boundary,
    mut progress: impl FnMut(f64) -> ControlFlow<()> + Send,
) -> Result<Linking, ContactError> {
    compared(before, after, boundary, &mut progress)
}

fn compared(
    before: &Yarns,
    after: &Yarns,
    boundary: &Boundary,
    progress: &mut Report<'_>,
) -> Result<Linking, ContactError> {
    boundary.check(before.layout())?;
    let shapes = Shapes::new(before, after, boundary)?;
    let points = before.points().len() as u64;
    // Intervals that were not near before but met on the way have moved far. They may be near
    // after, so the shapes after are searched as well.
    let searches: &[Shape] =
        if shapes.any_is_far() { &[Shape::Before, Shape::After] } else { &[Shape::Before] };
    let watch = Watch::new(searches.len() as u64 * SEARCH, progress);
    let spans = shapes.spans(TASK);
    let mut found = Found::default();
    for &shape in searches {
        let images = Images::new(boundary.repeat(), points, &spans, |span| shapes.rooms(span, shape))?;
        let grid = Grid::new(spans.len(), &watch, |span| {
            shapes.rooms(&spans[span], shape).flat_map(|each| images.of(each))
        })?;
        let search = Search::new(&shapes, &images, &grid, shape);
        let more = (0..grid.len().div_ceil(TASK))
            .into_par_iter()
            .map(|task| search.cells(task * TASK..grid.len().min((task + 1) * TASK), &watch))
            .try_reduce(Found::default, |one, other| Ok(one.joined(other)))?;
        found = found.joined(more);
    }
    // The units of a search are rounded down, so the rest is added here.
    watch.advance(SEARCH)?;
    Ok(found.linking())
}
