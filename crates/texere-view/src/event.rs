//! Events of a window, for the program that has opened it.

use std::fmt;
use std::path::PathBuf;

use texere::check::Crossing;
use texere::read::NamedPlace;

/// An event of a window. It is printed as one line.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Event {
    /// A cloth is shown: the design's, or an edited one.
    Shown {
        /// The design's title.
        name: String,
        /// Number of yarns of the cloth.
        yarns: usize,
        /// Number of triangles that are drawn of the cloth.
        triangles: u64,
        /// Whether its yarns have settled. They may be jammed, and not at rest.
        settled: bool,
    },
    /// A yarn was clicked on.
    Picked(NamedPlace),
    /// A lift was changed.
    Lifted {
        /// The crossing whose lift was changed.
        crossing: Crossing,
        /// Whether the warp lies on top at the crossing now.
        up: bool,
    },
    /// The edited cloth was written as a design file.
    Saved {
        /// The file.
        path: PathBuf,
        /// Parts of the design that a design file has no place for.
        left_out: Vec<String>,
    },
    /// A change that was asked for failed, or the design's file can't be read. The cloth is shown
    /// as it was.
    Failed(String),
    /// The window is being closed. [`View::open`](crate::View::open) returns when the device has
    /// finished its present work, which may take seconds. A program with nothing else to do may
    /// exit here.
    Closed,
}

impl fmt::Display for Event {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Shown { name, yarns, triangles, settled } => {
                let rest = if *settled { "settled" } else { "as its structure puts them" };
                write!(f, "shown: {name}, {yarns} yarns {rest}, {triangles} triangles")
            }
            Self::Picked(place) => write!(f, "picked: {place}"),
            Self::Lifted { crossing: Crossing { end, pick }, up } => {
                write!(f, "lifted: end {end} is {} pick {pick}", if *up { "above" } else { "below" })
            }
            Self::Saved { path, left_out } => {
                write!(f, "saved: {}", path.display())?;
                left_out.iter().try_for_each(|what| write!(f, "; {what}"))
            }
            Self::Failed(what) => write!(f, "failed: {what}"),
            Self::Closed => write!(f, "closed"),
        }
    }
}
