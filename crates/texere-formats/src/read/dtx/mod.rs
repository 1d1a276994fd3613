//! Drafts of Fiberworks PCW (`.dtx`): text in sections, each of which begins with `@@` and its
//! name. The layout is not published. It is read as Fiberworks 4.2 writes it.
//!
//! | section | contents |
//! |---|---|
//! | `Description` | the title |
//! | `Info` | `%%shafts`, `%%treadles`, `%%ends`, `%%picks` |
//! | `Threading` | the shaft of each end, 0 for none |
//! | `Tieup` | a row of 1 and 0 for each shaft, the last row for shaft 1, with a digit for each treadle |
//! | `Treadling` | the treadle of each pick, or several, separated by commas |
//! | `Liftplan` | a row of 1 and 0 for each pick, with a digit for each shaft from shaft 1 on |
//! | `Color Palet`, `Color Palette` | red, green and blue, 0 to 255, of a colour on each line |
//! | `Warp Colors`, `Weft Colors` | the colour of each thread, counted from 0 |
//! | `Warp Spacing`, `Weft Spacing` | the spacing of each thread in units of 0.53 mm |
//!
//! `%%%%sinking` in `Tieup` or `Liftplan` stands for a sinking shed. All other sections are passed
//! over. The rules of WIF drafts hold for what a file leaves open: entries beyond the number of
//! threads are left out, a thread without an entry is on no shaft, and a loom has more shafts or
//! treadles than `Info` declares if ends are threaded on them or the tie-up has them.

mod dtx_draft;
mod plans;
mod sections;
mod threads;

pub(super) use dtx_draft::draft;
