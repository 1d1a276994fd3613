//! Progress of a picture, and a wish to stop.

use std::ops::ControlFlow;

use texere_wgpu::WgpuBackend;

use crate::RenderError;

/// The caller's progress callback, if there is one, and the share of the work that was last passed
/// to it.
pub(crate) struct Watch<'a> {
    progress: Option<&'a mut dyn FnMut(f64) -> ControlFlow<()>>,
    done: f64,
    /// The submission that was waited for when the callback asked to stop.
    under_way: Option<wgpu::SubmissionIndex>,
}

impl<'a> Watch<'a> {
    pub(crate) fn new(progress: &'a mut dyn FnMut(f64) -> ControlFlow<()>) -> Self {
        Self { progress: Some(progress), done: 0.0, under_way: None }
    }

    /// The watch of a caller without a callback.
    pub(crate) const fn none() -> Self {
        Self { progress: None, done: 0.0, under_way: None }
    }

    /// Passes the share of the work that is done, from 0 to 1, to the callback.
    ///
    /// **Errors**: [`RenderError::Cancelled`].
    pub(crate) fn tell(&mut self, done: f64) -> Result<(), RenderError> {
        self.done = done;
        match self.progress.as_mut().map(|progress| progress(done)) {
            Some(ControlFlow::Break(())) => Err(RenderError::Cancelled),
            _ => Ok(()),
        }
    }

    /// Asks the callback whether the work goes on.
    ///
    /// **Errors**: [`RenderError::Cancelled`].
    pub(crate) fn ask(&mut self) -> Result<(), RenderError> {
        self.tell(self.done)
    }

    /// Waits until `submission` is done, and asks the callback every ten milliseconds.
    ///
    /// **Errors**: [`RenderError::Cancelled`], [`RenderError::Backend`].
    pub(crate) fn wait(
        &mut self,
        device: &WgpuBackend,
        submission: &wgpu::SubmissionIndex,
    ) -> Result<(), RenderError> {
        let Self { progress, done, under_way } = self;
        let Some(progress) = progress else {
            return Ok(device.wait(submission.clone())?);
        };
        if device.wait_while(submission, || progress(*done).is_continue())? {
            return Ok(());
        }
        *under_way = Some(submission.clone());
        Err(RenderError::Cancelled)
    }

    /// The submission that the device may still work on, if the callback ended a wait. It is
    /// returned once.
    pub(crate) const fn take_under_way(&mut self) -> Option<wgpu::SubmissionIndex> {
        self.under_way.take()
    }
}
