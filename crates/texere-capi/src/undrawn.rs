//! The renderer of a build without pictures, which refuses to open.

use std::ops::ControlFlow;

use texere::{BackendError, Settings, Yarns};

use crate::failure::Failure;
use crate::picture::{Pixels, texere_extent, texere_picture};

/// A renderer. This build can't make one, so the type has no values.
#[derive(Debug)]
pub(crate) enum Drawing {}

impl Drawing {
    pub(crate) fn open(name: &str) -> Result<Self, Failure> {
        Err(BackendError::NoFeature { wanted: name.into(), feature: "render" }.into())
    }

    pub(crate) fn show(
        &mut self,
        _: &Yarns,
        _: Option<Settings>,
        _: impl FnMut(f64) -> ControlFlow<()>,
    ) -> Result<(), Failure> {
        match *self {}
    }

    pub(crate) fn extent(&self) -> Result<texere_extent, Failure> {
        match *self {}
    }

    pub(crate) fn picture(
        &mut self,
        _: &texere_picture,
        _: impl FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Pixels, Failure> {
        match *self {}
    }

    pub(crate) fn seen(&self, _: [f32; 2]) -> Result<Option<(usize, [f64; 3])>, Failure> {
        match *self {}
    }
}
