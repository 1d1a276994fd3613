//! WIF 1.1, the Weaving Information File. The reader is lenient about how a file is written, and
//! strict about what it says.
//!
//! Sections and keys come in any order and case. A thread that a list of colours, spacings or
//! thicknesses leaves out has the value of its whole set. In THREADING, TIEUP, TREADLING and
//! LIFTPLAN a value of 0 stands for no shaft or no treadle. So does an empty value, or a missing
//! line. CONTENTS is not read.
//!
//! A treadle or shaft that the loom does not have is refused. So is a colour number that is not in
//! the table, unless red, green and blue follow it. These errors name section and key. A draft has
//! to have a lift plan, or both a tie-up and a treadling. If it has neither, the error names the
//! missing section.
//!
//! A loom has the shafts and treadles that WEAVING declares. If ends are threaded on more shafts,
//! or the tie-up has rows for more treadles, the loom has these as well, and a warning says so. A
//! lift of other shafts or a pressing of other treadles is refused. Without a declaration the loom
//! has as many as the file uses.
//!
//! A thickness that leaves threads no room to cross is read as the width at which a program draws
//! them, unless texere has written the draft: see [`DraftThreads`](super::draft::DraftThreads).

mod colors;
mod ini;
mod numbers;
mod program;
mod threads;
mod wif_draft;

pub(crate) use program::PROGRAM;
pub(crate) use threads::UNITS_MM;
pub(super) use wif_draft::draft;
