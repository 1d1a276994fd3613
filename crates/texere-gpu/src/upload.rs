//! Uploads of control points to padded memory elsewhere, such as a GPU's. Nothing is copied on the
//! host. Instead, the caller is lent slices of the points that it has to write, run by run.

use std::ops::Range;
use std::sync::LazyLock;
use std::sync::atomic::{AtomicBool, Ordering};

use texere_core::backend::{Plan, renew_virtual_ends, zeroed};
use texere_core::{BackendError, ControlPoint};

/// A yarn's first three and last two points, from which virtual ends are computed. In a short yarn
/// some of these are the same point.
pub(crate) type Ends = [ControlPoint; 5];

/// The ends of all yarns as last uploaded. With them, virtual ends are right even after an upload
/// of only part of a yarn.
///
/// Together with padded points on a device, which are zeros at first, this replaces
/// [`PaddedPoints`](texere_core::backend::PaddedPoints).
///
/// ```
/// use texere_core::backend::Plan;
/// use texere_core::{ControlPoint, Settings, Yarn, Yarns};
/// use texere_gpu::YarnEnds;
/// # let mut yarns = Yarns::builder();
/// # yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
/// # let yarns = yarns.build()?;
/// let plan = Plan::new(yarns.layout().clone(), Settings::default())?; // one open yarn at x = 0, 1, 2
/// let mut ends = YarnEnds::new(&plan)?;
/// let upload = ends.upload(&plan, 0, yarns.points());
/// assert_eq!(upload.ranges(), [0..0, 0..5, 0..0]);
/// assert_eq!(upload.copied(0..5).iter().map(|point| point.x).collect::<Vec<_>>(), [-1.0, 0.0, 1.0, 2.0, 3.0]);
/// ends.keep(&upload);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct YarnEnds {
    ends: Vec<Ends>,
    /// Whether the ends belong to the points that the device holds now.
    known: bool,
    flattened: bool,
}

impl YarnEnds {
    /// Reserves memory for the ends of all yarns of `plan`, all zero.
    ///
    /// **Errors**: [`BackendError::OutOfMemory`].
    pub fn new(plan: &Plan) -> Result<Self, BackendError> {
        Ok(Self { ends: zeroed("ends of yarns", plan.counts().yarns)?, known: true, flattened: false })
    }

    /// The upload of `points`, the first of which is number `first` of the fabric. Points past the
    /// fabric's last are left out.
    ///
    /// **Panics** for a plan with more yarns than [`YarnEnds::new`] was given.
    #[must_use]
    pub fn upload<'a>(&self, plan: &'a Plan, first: u64, points: &'a [ControlPoint]) -> PaddedUpload<'a> {
        let yarns = plan.layout().yarns_of(first..first.saturating_add(points.len() as u64));
        let mut upload = PaddedUpload {
            plan,
            first,
            points,
            yarns,
            cut: Default::default(),
            flattened: self.flattened.into(),
        };
        if let Some(last) = upload.yarns.clone().last() {
            upload.cut = [upload.yarns.start, last].map(|yarn| upload.renewed(yarn, self.ends[yarn]));
        }
        upload
    }

    /// Whether any upload kept so far had a flattened control point, whose half width differs from
    /// its half height. It stays true even if that point is uploaded as a round one later.
    #[must_use]
    pub fn flattened(&self) -> bool {
        self.flattened
    }

    /// Stores the ends of an upload that has been written.
    ///
    /// **Panics** for an upload to a plan with more yarns than [`YarnEnds::new`] was given.
    pub fn keep(&mut self, upload: &PaddedUpload<'_>) {
        for yarn in upload.yarns.clone() {
            self.ends[yarn] = upload.renewed(yarn, self.ends[yarn]);
        }
        self.known = true;
        self.flattened = upload.flattened.load(Ordering::Relaxed);
    }

    /// Forgets all ends, because the device now holds control points that the host does not have.
    /// `flattened` says whether any of them is not round.
    pub fn forget(&mut self, flattened: bool) {
        self.known = false;
        self.ends.fill(Ends::default());
        self.flattened |= flattened;
    }

    /// Whether the device's control points have to be read before `count` points are uploaded from
    /// number `first` on. They have to be read if virtual ends may depend on points that were
    /// forgotten.
    #[must_use]
    pub fn are_missing(&self, plan: &Plan, first: u64, count: usize) -> bool {
        !self.known && (first > 0 || (count as u64) < plan.layout().point_count())
    }

    /// Stores all ends from the device's control points, which are padded as
    /// [`Plan::padded_offsets`] of `plan` says.
    ///
    /// **Panics** for fewer points than those of `plan`, and if `plan` has fewer yarns than
    /// [`YarnEnds::new`] was given.
    pub fn renew(&mut self, plan: &Plan, padded: &[ControlPoint]) {
        for (yarn, ends) in self.ends.iter_mut().enumerate() {
            let own = &padded[plan.padded_offsets()[yarn] as usize + 1..];
            let count = (plan.layout().offsets()[yarn + 1] - plan.layout().offsets()[yarn]) as usize;
            // A yarn of two points has no third point. The second is stored in its place, and
            // nothing depends on it.
            for (end, at) in ends.iter_mut().zip([0, 1, 2.min(count - 1), count - 2, count - 1]) {
                *end = own[at];
            }
        }
        self.known = true;
    }
}

/// An upload of control points to padded memory, laid out as [`Plan::padded_offsets`] says. Several
/// threads may write pieces of an upload at once.
#[derive(Debug)]
pub struct PaddedUpload<'a> {
    plan: &'a Plan,
    first: u64,
    points: &'a [ControlPoint],
    yarns: Range<usize>,
    /// The ends of the first and of the last yarn, of which only a part may be sent.
    cut: [Ends; 2],
    /// Whether any point that was lent, or sent before, is not round. Points are tested while they
    /// are in a core's cache anyway.
    flattened: AtomicBool,
}

impl PaddedUpload<'_> {
    /// The three ranges of padded points that are to be written, in order. The first is the first
    /// yarn's virtual start, if it changes but does not lie beside the points sent. The second is
    /// the points sent, with the virtual ends between and beside them. The third is the last yarn's
    /// virtual end, if it changes but does not lie beside the points sent. Any range may be empty.
    #[must_use]
    pub fn ranges(&self) -> [Range<u64>; 3] {
        let Some(last) = self.yarns.clone().last() else { return [0..0, 0..0, 0..0] };
        let ([front, inner, _], [from, _]) = (self.places(self.yarns.start), self.overlap(self.yarns.start));
        let ([_, last_inner, back], [to, _]) = (self.places(last), self.overlap(last));
        let (start, end) = (inner.start + from.start as u64, last_inner.start + to.end as u64);
        let ([of_front, _], [_, of_back]) = (self.origins(self.yarns.start), self.origins(last));
        // A yarn's virtual start is sent together with its first point, and its virtual end
        // together with its last.
        let (from_first, to_last) = (start == front.end, end == back.start);
        let start = if from_first { front.start } else { start };
        let end = if to_last { back.end } else { end };
        let beside = |hangs: bool, range| if hangs { range } else { 0..0 };
        [
            beside(!from_first && !meet(&from, &of_front).is_empty(), front),
            start..end,
            beside(!to_last && !meet(&to, &of_back).is_empty(), back),
        ]
    }

    /// Lends the padded points of `range` run by run: slices of the caller's own points, virtual
    /// ends, and zeros for room without points. `range` should lie within one of
    /// [`PaddedUpload::ranges`]. In any other range, only the points that this upload has are lent.
    pub fn runs(&self, range: Range<u64>, mut take: impl FnMut(&[ControlPoint])) {
        let offsets = self.plan.padded_offsets();
        let before = offsets.partition_point(|&start| start <= range.start).saturating_sub(1);
        let yarns = before.max(self.yarns.start)..self.yarns.end;
        for yarn in yarns.take_while(|&yarn| offsets[yarn] < range.end) {
            let ([front, inner, back], [own, sent]) = (self.places(yarn), self.overlap(yarn));
            let short = self.short(yarn);
            let virtual_end = 1 + self.cut[0].len();
            let runs = [
                (front.start, &short[..1]),
                (inner.start + own.start as u64, &self.points[sent]),
                (back.start, &short[virtual_end..][..(back.end - back.start) as usize]),
            ];
            // Behind the yarn there may be room for more points.
            let room = (back.end..offsets[yarn + 1]).step_by(ROOM.len());
            let room = room.map(|at| (at, &ROOM[..ROOM.len().min((offsets[yarn + 1] - at) as usize)]));
            for (at, run) in runs.into_iter().chain(room) {
                let part = meet(&range, &(at..at + run.len() as u64));
                if !part.is_empty() {
                    let lent = &run[(part.start - at) as usize..(part.end - at) as usize];
                    take(lent);
                    if !self.flattened.load(Ordering::Relaxed) && !all_round(lent) {
                        self.flattened.store(true, Ordering::Relaxed);
                    }
                }
            }
        }
    }

    /// A copy of what [`PaddedUpload::runs`] lends.
    #[must_use]
    pub fn copied(&self, range: Range<u64>) -> Vec<ControlPoint> {
        let mut points = Vec::with_capacity((range.end - range.start) as usize);
        self.runs(range, |run| points.extend_from_slice(run));
        points
    }

    /// The ranges of padded points of a yarn's virtual start, its points and its virtual end.
    fn places(&self, yarn: usize) -> [Range<u64>; 3] {
        let Range { start, end } = self.plan.padded_range(yarn);
        let points = start + 1..start + 1 + self.count(yarn) as u64;
        [start..points.start, points.clone(), points.end..end]
    }

    /// The ranges of a yarn's points from which its virtual start and its virtual end are computed.
    fn origins(&self, yarn: usize) -> [Range<usize>; 2] {
        let count = self.count(yarn);
        if self.plan.yarn(yarn).closed { [count - 1..count, 0..3] } else { [0..2, count - 2..count] }
    }

    fn count(&self, yarn: usize) -> usize {
        let offsets = self.plan.layout().offsets();
        (offsets[yarn + 1] - offsets[yarn]) as usize
    }

    fn overlap(&self, yarn: usize) -> [Range<usize>; 2] {
        self.plan.layout().points_of(yarn, &(self.first..self.first + self.points.len() as u64))
    }

    /// The ends of a yarn after this upload. `ends` are those before it.
    fn renewed(&self, yarn: usize, mut ends: Ends) -> Ends {
        let ([own, sent], count) = (self.overlap(yarn), self.count(yarn));
        for (end, at) in ends.iter_mut().zip([0, 1, 2, count - 2, count - 1]) {
            if own.contains(&at) {
                *end = self.points[sent.start + at - own.start];
            }
        }
        ends
    }

    /// A short padded yarn of five points that has the same virtual ends as `yarn`.
    fn short(&self, yarn: usize) -> [ControlPoint; 9] {
        let ends = match yarn {
            _ if yarn == self.yarns.start => self.cut[0],
            _ if yarn + 1 == self.yarns.end => self.cut[1],
            // Yarns between the first and the last are sent whole.
            _ => self.renewed(yarn, Ends::default()),
        };
        let mut padded = [ControlPoint::default(); 9];
        padded[1..=ends.len()].copy_from_slice(&ends);
        let closed = self.plan.yarn(yarn).closed;
        renew_virtual_ends(if closed { &mut padded } else { &mut padded[..7] }, closed);
        padded
    }
}

/// The zeros that are written to room without points.
static ROOM: LazyLock<[ControlPoint; 64]> = LazyLock::new(|| [ControlPoint::default(); 64]);

/// Whether all `points` are round. There is no branch for each point, so that the test takes little
/// time compared with writing the points.
fn all_round(points: &[ControlPoint]) -> bool {
    points.iter().fold(true, |round, point| round & point.is_round())
}

fn meet<T: Ord + Copy>(a: &Range<T>, b: &Range<T>) -> Range<T> {
    a.start.max(b.start)..a.end.min(b.end)
}
