//! The work of a device for a settling.

use std::any::Any;
use std::fmt::Debug;
use std::ops::ControlFlow;
use std::sync::Arc;

use glam::IVec3;

use super::{Pass, Place, SettlingPlan};
use crate::BackendError;
use crate::backend::zeroed;
use crate::work_watch::WorkWatch;

/// The measures of a pass. All but `step` are taken before the points move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SettlingSeen {
    /// The longest step of a point in the pass, mm.
    pub step: f32,
    /// The least distance of two yarns, divided by the sum of their reaches. It is 1 if they touch.
    pub clearance: f32,
    /// The least radius of curvature, in diameters of the yarn.
    pub radius: f32,
    /// The largest difference between an interval's length and the length that it aims for, as a
    /// share of the length that it aims for.
    pub length: f32,
}

/// A settling on one device. [`settle`](super::settle) calls most of these methods and keeps these
/// rules:
///
/// - `upload` comes first, with as many places as the plan has control points.
/// - `list` comes before the first pass. It is called again before chords have moved so far, or
///   yarns have grown so much, that neighbours may be missing from the lists.
///
/// **Errors**: methods that can fail return a [`BackendError`], for failures that could not be
/// foreseen. `list` also returns [`BackendError::Crowded`].
pub trait Settler: Any + Debug + Send {
    /// The plan of the settler.
    fn plan(&self) -> &Arc<SettlingPlan>;

    /// Sets the places of all control points, with the sizes that the plan has. All steps become
    /// zero, and the lengths that intervals aim for become those of the plan.
    fn upload(&mut self, places: &[Place]) -> Result<(), BackendError>;

    /// Lists every chord's neighbours for yarns with the share `growth` of their thickness. Returns
    /// the number of all neighbours.
    fn list(&mut self, growth: f32) -> Result<u64, BackendError>;

    /// Moves every control point once, and returns the measures of the pass.
    fn pass(&mut self, pass: &Pass) -> Result<SettlingSeen, BackendError>;

    /// Does what [`list`](Self::list) does, and asks `watch` a few times in each 50 ms whether to
    /// go on. After `Break` the lists are incomplete.
    ///
    /// The provided method does not ask.
    fn list_watched(
        &mut self,
        growth: f32,
        watch: WorkWatch<'_>,
    ) -> Result<ControlFlow<(), u64>, BackendError> {
        let _ = watch;
        self.list(growth).map(ControlFlow::Continue)
    }

    /// Does what [`pass`](Self::pass) does, and asks `watch` a few times in each 50 ms whether to
    /// go on. After `Break` no point has moved. [`keep`](Self::keep) may not be called before the
    /// next whole pass.
    ///
    /// The provided method does not ask.
    fn pass_watched(
        &mut self,
        pass: &Pass,
        watch: WorkWatch<'_>,
    ) -> Result<ControlFlow<(), SettlingSeen>, BackendError> {
        let _ = watch;
        self.pass(pass).map(ControlFlow::Continue)
    }

    /// Keeps the places that the last pass has measured, not those that it moved points to. Places
    /// kept before are replaced.
    fn keep(&mut self) -> Result<(), BackendError>;

    /// Restores the kept places, if there are any, and sets all steps to zero. The lengths that
    /// intervals aim for stay. Neighbours have to be listed again before a pass.
    fn recall(&mut self) -> Result<(), BackendError>;

    /// Writes the present places of all control points into `places`.
    fn read(&mut self, places: &mut [Place]) -> Result<(), BackendError>;

    /// The least and the greatest x, y and z of all control points' present places, units.
    ///
    /// The provided method reads all places.
    fn bounds(&mut self) -> Result<[[i32; 3]; 2], BackendError> {
        let mut places: Vec<Place> = zeroed("control points at rest", self.plan().counts().points)?;
        self.read(&mut places)?;
        let nothing = [IVec3::MAX, IVec3::MIN];
        let units = places.iter().map(Place::units);
        let [low, high] = units.fold(nothing, |[low, high], at| [low.min(at), high.max(at)]);
        Ok([low.to_array(), high.to_array()])
    }
}

const _: () = {
    const fn sends<T: Send + ?Sized>() {}
    sends::<dyn Settler>();
};
