//! Readers of saved yarns and of curves, and what readers report: the place of an error in a file,
//! and the names of places in a cloth.
//!
//! [`texere::read`](fn@crate::read) reads a design's file and the files that it names;
//! [`read_from`](crate::read_from) takes them from memory.
//!
//! A WIF draft read by itself has no finish, so [`Design::rest`](crate::Design::rest) leaves its
//! yarns as placed unless [`Design::settle`](crate::Design::settle) is set to true.
//! [`run`](crate::rest::Resting::run) is `Ok` even if yarns don't come to rest:
//! [`Cloth::report`](crate::Cloth::report) then says so.
//!
//! | to | use |
//! |---|---|
//! | read yarns that were saved, without settling them again | [`yarns`], [`yarns_from`], which give [`SavedYarns`] |
//! | read curves that another program wrote, as round yarns | [`curves`], [`curves_from`], with a [`CurveScale`] |
//! | know file, line and field of an error | [`FilePlace`]; of an error of any type [`fault_place`], which gives a [`FaultPlace`] |
//! | know why a whole design is refused | [`Refusal`] |
//! | know which steps a knitting machine could not do | [`MachineFault`] |
//! | say in words where a yarn was picked | [`Design::named`](crate::Design::named), which gives a [`NamedPlace`] |

pub use texere_formats::read::{
    CurveScale, FaultPlace, SavedYarns, curves, curves_from, fault_place, yarns, yarns_from,
};
pub use texere_formats::{FilePlace, MachineFault, NamedPlace, ProgramPlace, Refusal};
