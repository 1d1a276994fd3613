//! WIF 1.1, the Weaving Information File: lenient about how a file is written, strict about what it
//! says.
//!
//! Sections and keys come in any order and case; sparse lists take defaults; 0 or nothing stands
//! for none; what CONTENTS claims is not trusted. Refused, with section and key: a treadle or shaft
//! that the loom does not have, a colour that no table holds, a tie-up, treadling or lift plan that
//! the others need.
//!
//! A loom has the shafts and treadles that WEAVING declares. Where ends are threaded on more
//! shafts, or the tie-up has rows for more treadles, it has those too, with a warning; what then
//! lifts a shaft or presses a treadle beyond them is refused. Without a declaration the loom has as
//! many as the file uses.
//!
//! A thickness that leaves threads no room to cross is taken for how wide they are drawn, unless
//! texere has written the draft: see [`threads::roomy`].

mod colors;
mod ini;
mod limits;
mod numbers;
mod program;
mod threads;
mod wif_draft;

pub(crate) use limits::{FILE_MAX, LENGTH_MM, LOOM_MAX};
pub(crate) use program::PROGRAM;
pub(crate) use threads::UNITS_MM;
pub(super) use wif_draft::{design, read};
