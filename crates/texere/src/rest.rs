//! Cloth at rest: its finish, its report, and the settling of single pieces.
//!
//! [`Design::rest`](crate::Design::rest) lets the yarns of a design come to rest as its [`Finish`]
//! says. The [`RestReport`] of the cloth says whether they did.
//!
//! | to | use |
//! |---|---|
//! | say how cloth is finished: how long its yarns are, whether it is pressed | [`Finish`], [`Length`], [`Press`] |
//! | follow a design to rest, and know how it ended | [`Resting`], [`RestReport`], [`Finished`], [`Verdict`] |
//! | let a knit find its own gauge, by the least energy of bending and contact | [`RestBy::Energy`], [`RelaxedKnit`], [`Energy`] |
//! | rest by energy whatever device there is | [`stand_in`] |
//! | strain a knit, and measure how it pulls | [`Design::strain_test`](crate::Design::strain_test), [`StrainTest`], [`Along`] |
//! | settle yarns of any origin | [`Piece`], [`settle`], [`Settled`] |
//! | settle one repeat, and copy it | [`Repeat`] |
//!
//! ```
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! use texere::rest::RestReport;
//! use texere::woven::{Relief, Thread, Weave, Woven, WovenDesign};
//! use texere::yarn::{Material, Section};
//! use texere::{Design, Structure};
//! let plain = Weave::parse("plain")?.drawdown(8, 6)?;
//! let thread = Thread::new(1.0, 0.2);
//! let cloth = Woven::new(plain, vec![thread; 8], vec![thread; 6], vec![Material::default()], vec![Section::Circle])?;
//! let muslin = Design::of("Muslin", Structure::Woven(WovenDesign::new(cloth, None, Relief::Report)?));
//! let cloth = muslin.rest(&*texere::open("cpu")?).run()?;
//! assert!(matches!(cloth.report(), RestReport::Finished(_)));
//! # Ok(())
//! # }
//! ```

pub use crate::device::stand_in;
pub use texere_core::relaxation::Energy;
pub use texere_core::settling::Length;
pub use texere_core::{CrossingsError, RelaxationError, SettlingError, Subject};
pub use texere_fabric::{
    Along, Finish, FinishError, Finished, Piece, Press, RelaxedKnit, Repeat, RestBy, Settled, StrainState,
    StrainTest, Verdict, WovenRest, settle,
};
pub use texere_formats::{RestReport, Resting};
