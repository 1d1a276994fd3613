//! What has been read from a draft.

use texere_fabric::{Draft, Woven};

use crate::read::keys::Keys;

/// What has been read from a draft of a weaving program.
#[derive(Debug)]
pub(in crate::read) struct LoomDraft {
    pub(in crate::read) name: String,
    pub(in crate::read) woven: Woven,
    pub(in crate::read) draft: Draft,
    pub(in crate::read) warnings: Vec<String>,
    pub(in crate::read) keys: Keys,
}
