//! The work of a device for a settling.

use std::any::Any;
use std::fmt::Debug;
use std::sync::Arc;

use glam::IVec3;

use super::{Pass, Place, SettlingPlan};
use crate::BackendError;
use crate::backend::zeroed;

/// The measures of a pass, taken before its points were moved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SettlingSeen {
    /// The longest step of a point in the pass, mm.
    pub step: f32,
    /// The least distance of two yarns over both reaches: 1 where they touch.
    pub clearance: f32,
    /// The least radius of curvature, in diameters of the yarn.
    pub radius: f32,
    /// The largest difference of an interval's length from the one asked for, as a share of it.
    pub length: f32,
}

/// A settling on one device. [`settle`](super::settle) calls it and keeps these rules:
///
/// - `upload` comes first, with as many places as the plan has control points.
/// - `list` comes before the first pass. It comes again before chords have moved so far, or yarns
///   have grown so much, that neighbours may be missing.
///
/// **Errors**: all methods return a [`BackendError`] for failures that could not be foreseen, and
/// for nothing else.
pub trait Settler: Any + Debug + Send {
    /// The plan of the settler.
    fn plan(&self) -> &Arc<SettlingPlan>;

    /// Takes the places of all control points, with the sizes that the plan has. Sets all steps to
    /// zero, and lengths to the plan's.
    fn upload(&mut self, places: &[Place]) -> Result<(), BackendError>;

    /// Lists every chord's neighbours for yarns of `growth` of their thickness. Returns their
    /// number in all.
    fn list(&mut self, growth: f32) -> Result<u64, BackendError>;

    /// Moves every control point once.
    fn pass(&mut self, pass: &Pass) -> Result<SettlingSeen, BackendError>;

    /// Keeps the places that the last pass has measured, before it moved them, in place of any kept
    /// before.
    fn keep(&mut self) -> Result<(), BackendError>;

    /// Goes back to the kept places, if there are any, and sets all steps to zero. Lengths stay,
    /// and neighbours have to be listed again before a pass.
    fn recall(&mut self) -> Result<(), BackendError>;

    /// Writes the present places of all control points.
    fn read(&mut self, places: &mut [Place]) -> Result<(), BackendError>;

    /// The least and the greatest x, y and z of all control points' present places, units.
    ///
    /// Provided: reads all places.
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
