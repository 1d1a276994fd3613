//! Drafts, point paper, stitch charts and lapping diagrams as PNG pictures, as weavers and knitters
//! draw them on squared paper. A draft has these blocks:
//!
//! ```text
//! warp yarns
//! threading     tie-up
//! drawdown      treadling or lift plan      weft yarns
//! ```
//!
//! Pick 1 is the bottom row, end 1 is the left column, and the threading stands above the cloth, as
//! in a mill. Shaft 1 is the row next to the cloth, treadle 1 the column next to it. A black square
//! of the drawdown is warp on top. A cloth without a shaft draft, or with more than 100 shafts or
//! treadles, is drawn as point paper: drawdown and yarns alone. The back of a cloth is point paper,
//! too, because a draft is written for the face. The cloth is then turned over sideways, so that
//! end 1 is on the right.

mod canvas;
mod font;
mod knit;
mod lapping;
mod limits;
mod sheet;
mod side;
mod weave;

pub use knit::{knit_draft, knit_draft_to, knit_rows};
pub use lapping::{warp_draft, warp_draft_to, warp_rows};
pub use side::Side;
pub use weave::{draft, draft_to};
