//! Weft knits in code: charts of stitches, and programs of knitting machines.
//!
//! | to | use |
//! |---|---|
//! | write stitches in symbols, or make them one by one | [`Chart`], [`Cell`] |
//! | say what a machine does, needle by needle | [`Program`], [`Instruction`] |
//! | run a program on a simulated knitting machine, and know its faults | [`Machine`], [`Knit`], [`Fault`] |
//! | know which loop is drawn through which | [`Stitches`] |
//! | make a cloth | [`Knitted`], with a [`Gauge`] and a [`KnitYarn`] for each carrier |
//!
//! ```
//! use texere::weft::{Beds, Chart, Gauge, KnitYarn, Knitted, Machine};
//! use texere::yarn::{Material, Section};
//! let garter = Chart::parse("pp\nkk", Beds::One)?; // purl one row, knit the next
//! let stitches = Machine::default().knit(&garter.program()?)?.stitches;
//! let (yarns, materials) = (vec![KnitYarn::new(0.15)], vec![Material::default()]);
//! let cloth = Knitted::new(stitches, Gauge::new(1.5, 1.0), yarns, materials, vec![Section::Circle], [4, 3])?;
//! assert!(!cloth.yarns()?.layout().yarns().is_empty());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub use texere_fabric::weft::{
    Backing, Bed, Beds, CarrierSet, Cell, Cells, Chart, ChartError, Direction, Fate, Fault, FaultKind, Gauge,
    Head, Instruction, Knit, KnitYarn, Knitted, LoopKind, LoopRef, Machine, NEEDLE_MAX, Needle, Operation,
    Parent, Program, STACK_MAX, Step, Stitch, Stitches, Strand, Visit, WeftError,
};
