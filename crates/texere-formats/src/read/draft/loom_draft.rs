//! What has been read from a draft.

use texere_fabric::{Draft, Woven};

use crate::read::keys::Keys;

/// What has been read from a draft of a weaving program.
#[derive(Debug)]
pub(crate) struct LoomDraft {
    pub(crate) name: String,
    pub(crate) woven: Woven,
    pub(crate) draft: Draft,
    pub(crate) warnings: Vec<String>,
    pub(crate) keys: Keys,
}
