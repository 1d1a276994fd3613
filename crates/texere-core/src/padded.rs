//! Control points as kernels read them: each yarn with its virtual ends.

use std::ops::Range;

use crate::{BackendError, ControlPoint, Plan};

/// The control points of a fabric, padded as [`Plan::padded_offsets`] says, so that no kernel has end cases.
///
/// ```
/// use texere_core::{ControlPoint, PaddedPoints, Plan, Settings, Yarn, Yarns};
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
    /// **Errors**: [`BackendError::OutOfMemory`].
    pub fn new(plan: &Plan) -> Result<Self, BackendError> {
        let count = plan.padded_offsets().last().copied().unwrap_or(0);
        Ok(Self { points: zeroed("control points", count)? })
    }

    /// Takes `points`, the first of which is number `first` of the fabric, and renews the virtual ends that they touch. Points
    /// past the fabric's last are left out.
    ///
    /// Gives back the range of padded points that may have changed.
    pub fn upload(&mut self, plan: &Plan, first: u64, points: &[ControlPoint]) -> Range<u64> {
        let yarns = touched(plan, first, points.len());
        for yarn in yarns.clone() {
            let (own, sent) = overlap(plan, yarn, first, points.len());
            let padded = &mut self.points[yarn_range(plan, yarn)];
            padded[1 + own.start..1 + own.end].copy_from_slice(&points[sent]);
            renew_ends(padded, plan.yarn(yarn).closed);
        }
        plan.padded_offsets()[yarns.start]..plan.padded_offsets()[yarns.end]
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
    plan.padded_offsets()[yarn] as usize..plan.padded_offsets()[yarn + 1] as usize
}

/// The yarns that `count` points from number `first` on belong to.
pub(crate) fn touched(plan: &Plan, first: u64, count: usize) -> Range<usize> {
    let offsets = plan.layout().offsets();
    let end = first.saturating_add(count as u64).min(plan.layout().point_count());
    if first >= end {
        return 0..0;
    }
    let yarn_before = |end: u64| offsets.partition_point(|&start| start < end);
    yarn_before(first + 1) - 1..yarn_before(end)
}

/// Which of a yarn's own points are among `count` points from number `first` on, and which of those they are.
pub(crate) fn overlap(plan: &Plan, yarn: usize, first: u64, count: usize) -> (Range<usize>, Range<usize>) {
    let (start, end) = (plan.layout().offsets()[yarn], plan.layout().offsets()[yarn + 1]);
    let (from, to) = (start.max(first), end.min(first + count as u64));
    ((from - start) as usize..(to - start) as usize, (from - first) as usize..(to - first) as usize)
}

/// Virtual ends of an open yarn (the paper's equations 3 and 4), wrapped neighbours of a closed one.
pub(crate) fn renew_ends(padded: &mut [ControlPoint], closed: bool) {
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

/// `count` zeroed values, in fresh pages that the system maps only when they are touched.
///
/// **Errors**: [`BackendError::OutOfMemory`], naming `what`.
pub fn zeroed<T: bytemuck::Zeroable>(what: &'static str, count: u64) -> Result<Vec<T>, BackendError> {
    let out_of_memory =
        || BackendError::OutOfMemory { what, bytes: count.saturating_mul(size_of::<T>() as u64) };
    let length = usize::try_from(count).map_err(|_| out_of_memory())?;
    bytemuck::allocation::try_zeroed_vec(length).map_err(|()| out_of_memory())
}
