//! Faults of a knitting program: operations that a machine can't carry out, and results that a
//! knitter would not want.

use std::fmt;

use super::super::Needle;
use texere_core::counted;

/// A kind of fault, and what the machine does instead.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum FaultKind {
    /// A carrier that is not in makes a stitch. The machine brings it in before the stitch.
    CarrierNotIn,
    /// A carrier that is already in is brought in. The machine leaves it as it is.
    CarrierIn,
    /// The hook brings a carrier in, or takes it out, while it still holds the yarn of the named
    /// carrier. The machine goes on as if the hook could do both.
    HookHolds(String),
    /// The hook releases a carrier that it does not hold. The machine does nothing.
    HookWithout,
    /// A carrier that is not in is taken out. In a repeat its next stitch begins a new yarn. In any
    /// other program the machine does nothing.
    OutWithoutIn,
    /// The beds are racked further than the machine's limit. The program goes on with that rack. A
    /// rack of more than [`NEEDLE_MAX`](super::super::NEEDLE_MAX) needles is left out.
    Racked {
        /// The rack, in needles.
        rack: f64,
        /// The furthest rack of the machine, in needles.
        limit: f64,
    },
    /// Loops go to another needle of the same bed. The machine moves them.
    SameBed(Needle),
    /// Loops go to a needle that does not lie opposite at the present rack. The machine moves them.
    NotAligned {
        /// The needle that the loops go to.
        to: Needle,
        /// The rack, in needles.
        rack: f64,
    },
    /// A stitch is made on a slider, which can only hold loops. The machine makes it there.
    OnSlider,
    /// In a repeat, a needle holds loops and never knits, so that loops pile up.
    NeverKnits,
    /// Loops fall off a needle without being knitted. The value is the number of loops.
    Dropped(u32),
    /// Loops hang on needles at the end. The value is the number of loops. The fault names the
    /// first needle that holds any.
    LeftOnNeedles(u32),
    /// A yarn floats past more needles than it should.
    LongFloat {
        /// Number of needles that the yarn passes.
        needles: u32,
        /// The most that the machine's limits allow.
        limit: u32,
    },
    /// A carrier is brought in and passes needles, but no loop holds its yarn. The yarn is left out
    /// of the cloth.
    Loose,
    /// Two empty needles next to each other take a yarn one after the other. Until the next course
    /// the yarn runs straight through their hooks, and may slip off. A program gets this fault
    /// once, for its first pair of needles.
    CastOn {
        /// The needle that takes the yarn first.
        beside: Needle,
        /// Number of further pairs.
        others: u32,
    },
    /// A carrier is taken out after a single loop, from which its yarn may slip. A program gets
    /// this fault once, for the first carrier.
    OnlyLoop {
        /// Number of further carriers that are taken out after a single loop.
        others: u32,
    },
    /// A needle holds more loops than it should.
    Piled {
        /// Number of loops on the needle.
        loops: u32,
        /// The most that the machine's limits allow.
        limit: u32,
    },
    /// A carrier waits between needles, while the named carrier lays its yarn on both sides of the
    /// waiting one. When the waiting carrier goes on, its yarn is caught behind the other yarn.
    Tangled(String),
}

impl FaultKind {
    /// Whether a real machine can't carry out the operation. A program with any other fault can be
    /// knitted, but the cloth may not be what was meant.
    #[must_use]
    pub const fn is_error(&self) -> bool {
        !matches!(
            self,
            Self::Dropped(_)
                | Self::LeftOnNeedles(_)
                | Self::LongFloat { .. }
                | Self::Loose
                | Self::CastOn { .. }
                | Self::OnlyLoop { .. }
                | Self::Piled { .. }
                | Self::Tangled(_)
        )
    }
}

/// A fault of a knitting program, and its place. No fault stops the machine. If a real machine
/// can't carry out the operation, the kind says what happens instead.
#[derive(Debug, Clone, PartialEq)]
pub struct Fault {
    /// The kind of the fault.
    pub kind: FaultKind,
    /// The operation's [`source`](super::super::Operation::source): a line, or a cell of a chart.
    pub source: u32,
    /// The needle, if the fault concerns one.
    pub needle: Option<Needle>,
    /// The name of the carrier, if the fault concerns one.
    pub carrier: Option<String>,
}

impl fmt::Display for Fault {
    /// Writes the fault as a sentence, without its place. Only the reader of the design knows
    /// whether sources are lines or cells.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let carrier = self.carrier.as_deref().unwrap_or("?");
        let needle = self.needle.map_or_else(String::new, |needle| format!(" {needle}"));
        match &self.kind {
            FaultKind::CarrierNotIn => {
                write!(f, "carrier {carrier} makes a stitch on needle{needle}, but is not in")
            }
            FaultKind::CarrierIn => write!(f, "carrier {carrier} is brought in, but is in already"),
            FaultKind::HookHolds(other) => {
                write!(f, "the hook takes carrier {carrier}, but still holds carrier {other}")
            }
            FaultKind::HookWithout => {
                write!(f, "the hook lets go of carrier {carrier}, but does not hold it")
            }
            FaultKind::OutWithoutIn => write!(f, "carrier {carrier} is taken out, but is not in"),
            FaultKind::Racked { rack, limit } => write!(f, "rack {rack}; the machine reaches ±{limit}"),
            FaultKind::SameBed(to) => {
                write!(f, "loops of needle{needle} go to {to}, which is on the same bed")
            }
            FaultKind::NotAligned { to, rack } => {
                write!(f, "loops of needle{needle} go to {to}, which does not lie opposite at rack {rack}")
            }
            FaultKind::OnSlider => write!(f, "a stitch on slider{needle}, which can only hold loops"),
            FaultKind::NeverKnits => write!(f, "needle{needle} holds loops and never knits them"),
            FaultKind::Dropped(1) => write!(f, "a loop falls off needle{needle} without being knitted"),
            FaultKind::Dropped(loops) => {
                write!(f, "{loops} loops fall off needle{needle} without being knitted")
            }
            FaultKind::LeftOnNeedles(1) => write!(f, "at the end 1 loop hangs on needle{needle}"),
            FaultKind::LeftOnNeedles(loops) => {
                write!(f, "at the end {loops} loops hang on needles, the first on{needle}")
            }
            FaultKind::LongFloat { needles, limit } => {
                write!(
                    f,
                    "carrier {carrier} floats past {}; more than {limit} {} a long float",
                    counted(*needles, "needle"),
                    if *limit == 1 { "is" } else { "are" }
                )
            }
            FaultKind::Loose => {
                write!(f, "no loop holds the yarn of carrier {carrier}, which is left out of the cloth")
            }
            FaultKind::CastOn { beside, others } => {
                write!(
                    f,
                    "needles {beside} and{needle} hold nothing and take the yarn of carrier {carrier} one after the other, \
                     straight through their hooks: it may slip off; every other needle first, and the rest on the way \
                     back, hold it{}",
                    more(*others, "more pair")
                )
            }
            FaultKind::OnlyLoop { others } => {
                write!(
                    f,
                    "carrier {carrier} is taken out after a single loop, from which its yarn may slip{}",
                    more(*others, "more carrier")
                )
            }
            FaultKind::Piled { loops, limit } => {
                write!(
                    f,
                    "needle{needle} holds {}; more than {limit} may not knit well",
                    counted(*loops, "loop")
                )
            }
            FaultKind::Tangled(other) => {
                write!(f, "the yarn of carrier {carrier} is caught behind that of carrier {other}")
            }
        }
    }
}

/// Words for `others` further faults of a kind; empty if there are none.
fn more(others: u32, one: &str) -> String {
    if others == 0 { String::new() } else { format!("; {} like that", counted(others, one)) }
}
