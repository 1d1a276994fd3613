//! What a knitting machine could not do, or a knitter would not want it to.

use std::fmt;

use super::super::Needle;
use texere_core::counted;

/// What is wrong.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum FaultKind {
    /// A carrier makes a stitch that is not in. It is taken to be brought in there.
    CarrierNotIn,
    /// A carrier is brought in that is in already. It stays where it is.
    CarrierIn,
    /// The hook takes a carrier, in or out, while it still holds another, which is named. It is
    /// taken to do both.
    HookHolds(String),
    /// The hook lets go of a carrier that it does not hold.
    HookWithout,
    /// A carrier is taken out that is not in.
    OutWithoutIn,
    /// The beds are racked further than the machine can. They are taken to be racked so all the
    /// same, if there are such needles.
    Racked {
        /// How far.
        rack: f64,
        /// The machine's furthest.
        limit: f64,
    },
    /// Loops go to another needle of the same bed. They are taken to go there.
    SameBed(Needle),
    /// Loops go to a needle that does not lie opposite as the beds are racked. They are taken to go
    /// there.
    NotAligned {
        /// The needle that they go to.
        to: Needle,
        /// How the beds are racked.
        rack: f64,
    },
    /// A stitch is made on a slider, which can only hold loops. It is taken to be made there.
    OnSlider,
    /// In a repeat, a needle holds loops and never knits: they pile up.
    NeverKnits,
    /// So many loops fall off a needle without being knitted.
    Dropped(u32),
    /// So many loops hang on needles at the end; the needle is the first of them.
    LeftOnNeedles(u32),
    /// A yarn floats past more needles than it should.
    LongFloat {
        /// Needles that it passes.
        needles: u32,
        /// The most.
        limit: u32,
    },
    /// A carrier is brought in and laid past needles, but no loop holds its yarn. It is left out of
    /// the cloth.
    Loose,
    /// Two needles that hold nothing, next to each other, take a yarn one after the other: until
    /// the next course it goes straight through their hooks, and may slip off. It is told once for
    /// a program, of the first such pair.
    CastOn {
        /// The needle that takes it first.
        beside: Needle,
        /// How many more such pairs there are.
        others: u32,
    },
    /// A carrier is taken out after a single loop, from which its yarn may slip. It is told once
    /// for a program, of the first such carrier.
    OnlyLoop {
        /// How often it happens again.
        others: u32,
    },
    /// More loops hang on a needle than it should hold.
    Piled {
        /// How many.
        loops: u32,
        /// The most.
        limit: u32,
    },
    /// A carrier waits between needles while the one that is named lays its yarn on both sides of
    /// it, and then goes on: its yarn is caught behind the other.
    Tangled(String),
}

impl FaultKind {
    /// Whether a machine could not do it. Otherwise it can, but the cloth may not be what was
    /// meant.
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

/// Something wrong in a knitting program, and where. None stops the machine; each kind says what is
/// done instead.
#[derive(Debug, Clone, PartialEq)]
pub struct Fault {
    /// What.
    pub kind: FaultKind,
    /// The operation's [`source`](super::super::Operation::source): a line, or a cell of a chart.
    pub source: u32,
    /// The needle, where it is one's.
    pub needle: Option<Needle>,
    /// The carrier's name, where it is one's.
    pub carrier: Option<String>,
}

impl fmt::Display for Fault {
    /// A sentence without where it is: the reader knows whether its sources are lines or cells.
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

/// How many more of a kind there are.
fn more(others: u32, one: &str) -> String {
    if others == 0 { String::new() } else { format!("; {} like that", counted(others, one)) }
}
