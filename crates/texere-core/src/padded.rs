//! Padded control points, as kernels read them: each yarn with its virtual ends.

use std::ops::Range;

use crate::backend::{Plan, zeroed};
use crate::{ControlPoint, OutOfMemory};

/// The control points of a fabric, padded as [`Plan::padded_offsets`] describes, so that kernels
/// need no special cases at ends.
///
/// ```
/// use texere_core::backend::{PaddedPoints, Plan};
/// use texere_core::{ControlPoint, Settings, Yarn, Yarns};
/// # let mut yarns = Yarns::builder();
/// # yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
/// # let yarns = yarns.build()?;
/// let plan = Plan::new(yarns.layout().clone(), Settings::default())?; // one open yarn at x = 0, 1, 2
/// let mut padded = PaddedPoints::new(&plan)?;
/// assert_eq!(padded.upload(&plan, 0, yarns.points()), 0..5);
/// assert_eq!(padded.yarn(&plan, 0).iter().map(|point| point.x).collect::<Vec<_>>(), [-1.0, 0.0, 1.0, 2.0, 3.0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct PaddedPoints {
    points: Vec<ControlPoint>,
}

impl PaddedPoints {
    /// Room for the control points of `plan`, all zero.
    ///
    /// **Errors**: [`OutOfMemory`].
    pub fn new(plan: &Plan) -> Result<Self, OutOfMemory> {
        let count = plan.padded_offsets().last().copied().unwrap_or(0);
        Ok(Self { points: zeroed("control points", count)? })
    }

    /// Stores `points`, the first of which is number `first` of the fabric, and renews the virtual
    /// ends that depend on them. Points past the fabric's last are ignored.
    ///
    /// Returns the range of padded points that may have changed.
    pub fn upload(&mut self, plan: &Plan, first: u64, points: &[ControlPoint]) -> Range<u64> {
        let (layout, sent) = (plan.layout(), first..first.saturating_add(points.len() as u64));
        let yarns = layout.yarns_of(sent.clone());
        for yarn in yarns.clone() {
            let [own, sent] = layout.points_of(yarn, &sent);
            let padded = &mut self.points[yarn_range(plan, yarn)];
            padded[1 + own.start..1 + own.end].copy_from_slice(&points[sent]);
            renew_virtual_ends(padded, plan.yarn(yarn).closed);
        }
        let end = yarns.clone().last().map(|last| plan.padded_range(last).end);
        let start = plan.padded_offsets()[yarns.start];
        start..end.unwrap_or(start)
    }

    /// All padded points, yarn after yarn.
    #[must_use]
    pub fn points(&self) -> &[ControlPoint] {
        &self.points
    }

    /// The padded points of one yarn.
    ///
    /// **Panics** past the last yarn.
    #[must_use]
    pub fn yarn(&self, plan: &Plan, yarn: usize) -> &[ControlPoint] {
        &self.points[yarn_range(plan, yarn)]
    }
}

fn yarn_range(plan: &Plan, yarn: usize) -> Range<usize> {
    let range = plan.padded_range(yarn);
    range.start as usize..range.end as usize
}

/// Works out the virtual ends of one padded yarn from the control points between them: the paper's
/// equations 3 and 4 for an open yarn, wrapped neighbours for a closed one.
///
/// `padded` has the layout of [`Plan::padded_offsets`]: one place before the yarn's own points, and
/// one place (for an open yarn) or three (for a closed one) behind them. The yarn has two own
/// points at least (three if closed).
///
/// **Panics** if `padded` is shorter than three places (four if closed).
///
/// ```
/// use texere_core::backend::renew_virtual_ends;
/// use texere_core::ControlPoint;
/// let mut padded = [0.0, 1.0, 2.0, 0.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1));
/// renew_virtual_ends(&mut padded, false);
/// assert_eq!(padded.map(|point| point.x), [0.0, 1.0, 2.0, 3.0]);
/// ```
pub fn renew_virtual_ends(padded: &mut [ControlPoint], closed: bool) {
    let count = padded.len();
    if closed {
        padded[0] = padded[count - 4];
        for k in 0..3 {
            padded[count - 3 + k] = padded[1 + k];
        }
    } else {
        padded[0] = padded[1].reflected(&padded[2]);
        padded[count - 1] = padded[count - 2].reflected(&padded[count - 3]);
    }
}
