//! Warnings of a file that departs from knitout. Each kind is listed once.

use std::collections::HashSet;
use std::path::Path;

use crate::read::error::named;

/// The most warnings of a file.
pub(super) const WARNINGS_MAX: usize = 20;

/// Warnings, each with its line.
#[derive(Debug)]
pub(super) struct Warnings {
    file: String,
    kinds: HashSet<String>,
    list: Vec<String>,
    full: bool,
}

impl Warnings {
    pub(super) fn new(file: &Path) -> Self {
        Self { file: named(file), kinds: HashSet::new(), list: Vec::new(), full: false }
    }

    /// Adds a warning for a line, unless there is one of this `kind` already or the list is full.
    pub(super) fn once(&mut self, kind: &str, line: usize, said: &str) {
        if self.kinds.contains(kind) {
            return;
        }
        if self.list.len() == WARNINGS_MAX {
            self.full = true;
            return;
        }
        self.kinds.insert(kind.into());
        self.list.push(format!("{}, line {line}: {said}", self.file));
    }

    pub(super) fn list(mut self) -> Vec<String> {
        if self.full {
            self.list.push(format!("{}: more warnings are left out", self.file));
        }
        self.list
    }
}
