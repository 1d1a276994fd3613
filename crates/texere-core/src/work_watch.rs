//! The question whether long work goes on.

use std::ops::ControlFlow;

/// A callback that is asked, now and then, whether to go on.
pub type WorkWatch<'a> = &'a mut dyn FnMut() -> ControlFlow<()>;
