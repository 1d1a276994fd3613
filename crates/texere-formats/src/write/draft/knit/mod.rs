//! Knits as pictures: a stitch chart, and below it the needle diagram.
//!
//! The chart has a square for each wale of each course, the first course at the bottom. A square
//! has the colour of the yarn that shows on the face. An empty square is a knit stitch, a dot a
//! purl, as in knitters' charts.

mod chart;
mod grid;
mod needles;
mod symbols;
mod yarn_color;

pub use chart::{knit_draft, knit_draft_to, knit_rows};
