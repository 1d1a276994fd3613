//! Fabric structures: how threads interlace, and the control points of every yarn that follow from
//! it.
//!
//! ```text
//! Draft ──┐
//! Weave ──┼──> Drawdown ──> Woven ──> Yarns
//! image ──┘                 (+ threads)
//! ```
//!
//! A [`Drawdown`] says at each crossing whether the warp lies on top. It comes from a weaver's
//! [`Draft`], from a [`Weave`] in its usual notation, or straight from a function. A [`Woven`]
//! cloth adds what each thread is like and where it lies, and makes [`texere_core::Yarns`] of all
//! threads.
//!
//! A [`Structure`] is the fabric of any design: a [`WovenDesign`], a weft knit ([`weft::Knitted`])
//! or a warp knit ([`warp::WarpKnitted`]). It says what is wrong with the fabric
//! ([`Structure::diagnose`]) and which single changes would cure it ([`Structure::cures`]).
//!
//! The yarns of a structure are placed about where they belong, but may pierce one another.
//! [`settle`] lets any yarns come to rest on a device, and [`Structure::settle`] those of a
//! structure. A [`Repeat`] settles once and is copied.
//!
//! [`Measures`] are what designers ask for: yarn consumption, weight, thickness, crimp and cover of
//! woven cloth, loops of knits. [`diameter_mm`] gives the diameter of a yarn of known weight.
//! [`texere_contact`] measures any yarns, also those that belong to no structure.
//!
//! ```
//! use texere_core::{Material, Section};
//! use texere_fabric::{Thread, Weave, Woven};
//! let twill: Weave = "2/2".parse()?;
//! let thread = Thread::new(0.5, 0.1); // 20 threads a cm, 0.2 mm thick
//! let (warp, weft) = (vec![thread; 40], vec![thread; 30]);
//! let cloth = Woven::new(twill.drawdown(40, 30)?, warp, weft, vec![Material::default()], vec![Section::Circle])?;
//! assert_eq!(cloth.yarns()?.layout().yarns().len(), 70);
//! # Ok::<(), texere_fabric::FabricError>(())
//! ```

mod along;
mod diagnosis;
mod error;
mod fibre;
mod look_alike;
mod measures;
mod own;
mod reach;
mod relaxation;
mod settling;
mod structure;
mod subject;
mod tile;
mod warning;
pub mod warp;
pub mod weft;
mod woven;
mod yarn_check;
mod yarn_size;

pub use along::Along;
pub use diagnosis::{
    ClothClearance, ClothFault, Crossing, Cure, Diagnosis, Faults, Jams, Pieces, Remedy, StitchPlace,
    ThreadBend, ThreadContact, ThreadCrowd, ThreadDrawn, ThreadPlace, Verdict,
};
pub use error::FabricError;
pub use fibre::{COTTON_LEAST_AREA, Fibre, PACKING, PACKING_LIMITS};
pub use look_alike::hyphen_look_alike;
pub(crate) use look_alike::slash_look_alike;
pub use measures::{Cover, KnitMeasures, Measures, lengths_by_material, thickness_mm, weight_g};
pub use relaxation::{RelaxedKnit, StrainState, StrainTest, elastic_of_radius};
pub use settling::{Finish, FinishError, Finished, Piece, Press, Repeat, RestBy, Settled, settle};
pub use structure::Structure;
pub use tile::Tile;
pub use warning::FabricWarning;
pub(crate) use woven::POINTS_MAX;
pub use woven::{
    BySet, Crimp, Draft, Drawdown, JamReport, LOOM_MAX, Loom, NO_CROSSING, Pitch, Relief, SPACING_MAX,
    SPACING_MIN, Sett, Shape, Shedding, Stretch, THREADS_MAX, Thread, Tightness, Weave, Woven, WovenDesign,
    WovenError, WovenRest,
};
pub use yarn_check::ThreadError;
pub use yarn_size::{
    COTTON_DENSITY, density_from_tex, diameter_mm, firmness_from_twist, tex_from_cotton_count,
    tex_from_denier, tex_from_diameter, tex_from_metric_count, turns_per_m, twist_from_turns_per_m,
};
