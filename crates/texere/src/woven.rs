//! Woven cloth in code: drafts, weaves, threads and setts.
//!
//! | to | take |
//! |---|---|
//! | write a weave in its usual notation | [`Weave`] |
//! | thread a loom | [`Draft`], [`Shedding`] |
//! | say which thread lies on top at each crossing | [`Drawdown`] |
//! | say what threads are like, and how close they lie | [`Thread`], [`Pitch`] |
//! | have a cloth | [`Woven`]; [`WovenDesign`] adds how it comes to rest |
//! | read what warp and weft each have | [`BySet`], [`Set`] |
//! | know whether threads have room | [`JamReport`], [`Sett`], [`Relief`], [`Tightness`] |
//! | place single ends and picks anew | [`Loom`] |
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
    BySet, Crimp, Draft, Drawdown, JamReport, Loom, NO_CROSSING, Pitch, Relief, Sett, Shape, Shedding,
    Stretch, Thread, ThreadError, Tightness, Weave, Woven, WovenDesign, WovenError,
};
