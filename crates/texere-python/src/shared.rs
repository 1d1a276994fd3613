//! Yarns that several objects of Python hold.

use std::ops::Deref;
use std::sync::Arc;

/// Yarns that several objects of Python share.
#[derive(Debug, Clone)]
pub(crate) enum Shared {
    /// The yarns of a cloth.
    Cloth(Arc<texere::Cloth>),
    /// Yarns that belong to no cloth.
    Own(Arc<texere::Yarns>),
}

impl Deref for Shared {
    type Target = texere::Yarns;

    fn deref(&self) -> &texere::Yarns {
        match self {
            Self::Cloth(cloth) => cloth.yarns(),
            Self::Own(yarns) => yarns,
        }
    }
}
