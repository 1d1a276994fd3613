//! Yarns: their materials, sections, thicknesses, ends and lengths.
//!
//! | to | use |
//! |---|---|
//! | build yarns of any origin | [`Yarns::builder`](crate::Yarns::builder), which gives a [`YarnsBuilder`] |
//! | say what a yarn is made of, and what its section is | [`Material`], [`Section`] |
//! | say how a yarn ends, and whether a fabric goes on beyond its edges | [`Ends`], [`Boundary`] |
//! | know which thread of a design a yarn is | [`Origin`] |
//! | turn a yarn count into a diameter, turns per metre into twist, twist into firmness | [`diameter_mm`], [`tex_from_cotton_count`] and the like, [`twist_from_turns_per_m`], [`firmness_from_twist`] |
//! | know how long yarns are | [`length_mm`], [`lengths_mm`] |
//! | know which yarns lie under a point of the cloth | [`yarns_under`], which gives a [`YarnPlace`] for each |
//! | know the limits of control points and yarns | [`COORDINATE_LIMIT`], [`RADIUS_MIN`], [`RADIUS_MAX`], [`TWIST_LIMIT`], [`HAIRINESS_LIMIT`], [`BENDING_LIMITS`] |
//!
//! ```
//! use texere::yarn::twist_from_turns_per_m;
//! use texere::{ControlPoint, Yarn, Yarns};
//! let mut yarns = Yarns::builder();
//! // x, y and z, then the radius, all in mm.
//! let points = [0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1));
//! yarns.yarn(Yarn { twist: twist_from_turns_per_m(500.0), ..Yarn::default() }, &points);
//! let yarns = yarns.build()?;
//! assert_eq!(yarns.layout().yarns().len(), 1);
//! # Ok::<(), texere::yarn::YarnError>(())
//! ```

pub use texere_contact::{length_mm, lengths_mm, yarns_under};
pub use texere_core::{
    BENDING_LIMITS, Boundary, BoundaryError, COORDINATE_LIMIT, Ends, HAIRINESS_LIMIT, Halves, Layout,
    Material, Origin, Placement, RADIUS_MAX, RADIUS_MIN, Section, SectionError, SectionPoint, TWIST_LIMIT,
    YarnError, YarnPlace, YarnsBuilder,
};
pub use texere_fabric::{
    COTTON_DENSITY, COTTON_LEAST_AREA, Fibre, PACKING, PACKING_LIMITS, density_from_tex, diameter_mm,
    firmness_from_twist, tex_from_cotton_count, tex_from_denier, tex_from_diameter, tex_from_metric_count,
    turns_per_m, twist_from_turns_per_m,
};
