//! Woven cloth in code: drafts, weaves, threads and setts.
//!
//! | to | use |
//! |---|---|
//! | write a weave in its usual notation | [`Weave`] |
//! | thread a loom | [`Draft`], [`Shedding`] |
//! | say which thread lies on top at each crossing | [`Drawdown`] |
//! | say which yarn each thread is, and how close threads lie | [`Thread`] |
//! | make a cloth | [`Woven`]; [`WovenDesign`] adds how it comes to rest |
//! | have a value for the warp and one for the weft | [`BySet`], [`Set`] |
//! | know whether threads have room, or make room | [`Pitch`], [`Tightness`], [`Sett`]; [`Relief`], [`JamReport`] |
//! | place single ends and picks again after an edit | [`Loom`] |
//!
//! ```
//! use texere::woven::{Thread, Weave, Woven};
//! use texere::yarn::{Material, Section};
//! let twill = Weave::parse("2/2")?.drawdown(40, 30)?;
//! let thread = Thread::new(0.5, 0.1); // 20 threads a cm, 0.2 mm thick
//! let cloth = Woven::new(twill, vec![thread; 40], vec![thread; 30], vec![Material::default()], vec![Section::Circle])?;
//! assert_eq!(cloth.yarns()?.layout().yarns().len(), 70);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub use texere_core::crossings::Set;
pub use texere_fabric::{
    BySet, Crimp, Draft, Drawdown, JamReport, LOOM_MAX, Loom, NO_CROSSING, Pitch, Relief, Sett, Shape,
    Shedding, Stretch, Thread, ThreadError, Tightness, Weave, Woven, WovenDesign, WovenError,
};
