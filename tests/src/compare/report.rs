//! The result of a comparison: counts of faults by name, the first few faults in full, and the
//! largest errors.

use std::collections::BTreeMap;
use std::fmt;

use super::bounds::{DIRECTION, POSITION};

/// The kinds of fault that an output can have.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Fault {
    /// A wrong number of rings, vertices, indices or caps, or pieces out of order.
    Count,
    /// Memory that was never written.
    Missing,
    /// NaN or infinity.
    NotFinite,
    /// A ring's centre or a vertex out of place.
    Position,
    /// A vertex normal with a wrong direction.
    Normal,
    /// A wrong half width or half height of a ring, or a wrong growth of either.
    Size,
    /// A ring's tangent with a wrong direction.
    Tangent,
    /// A wrong turn of a ring about its tangent.
    Roll,
    /// A wrong turn of a ring's outline about its tangent.
    Lean,
    /// An index that makes a wrong triangle, or a cap that does not close.
    Index,
    /// Two outputs that should be equal to the bit, and are not.
    Bits,
}

/// A place in a fabric.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct RingPlace {
    /// The number of the yarn, counted from 0.
    pub yarn: u64,
    /// The number of the ring, counted from the yarn's start.
    pub ring: u64,
    /// The point of the section, if the fault is one of a vertex or an index.
    pub point: Option<u64>,
}

impl fmt::Display for RingPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "yarn {}, ring {}", self.yarn, self.ring)?;
        self.point.map_or(Ok(()), |point| write!(f, ", point {point}"))
    }
}

/// One fault, in full.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mismatch {
    /// The kind of fault.
    pub fault: Fault,
    /// The place of the fault.
    pub place: RingPlace,
    /// The expected value.
    pub expected: String,
    /// The value that was found.
    pub actual: String,
}

impl fmt::Display for Mismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { fault, place, expected, actual } = self;
        write!(f, "{fault:?} at {place}: expected {expected}, found {actual}")
    }
}

/// The quantities that are measured against a tolerance.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Quantity {
    /// Ring centres, as a share of the smaller of the ring's half width and half height.
    Centre,
    /// Half widths and half heights, relative.
    Half,
    /// The growth of half widths and half heights, as a share of 1 plus the expected growth.
    Growth,
    /// Tangents, rad.
    Tangent,
    /// Turn about the tangent, rad.
    Roll,
    /// Turn of the outline about the tangent, rad.
    Lean,
    /// Vertex positions, as a share of the smaller of the ring's half width and half height.
    Vertex,
    /// Vertex normals, rad.
    Normal,
}

impl Quantity {
    /// All quantities, in the order of the table.
    pub const ALL: [Self; 8] = [
        Self::Centre,
        Self::Half,
        Self::Growth,
        Self::Tangent,
        Self::Roll,
        Self::Lean,
        Self::Vertex,
        Self::Normal,
    ];

    /// The plain tolerance in the quantity's unit. More is added to it for the rounding of large
    /// coordinates, and for the drift of the roll. The roll has no plain tolerance.
    const fn bound(self) -> f64 {
        match self {
            Self::Centre | Self::Vertex => POSITION,
            Self::Half | Self::Growth | Self::Tangent | Self::Lean | Self::Normal => DIRECTION,
            Self::Roll => f64::INFINITY,
        }
    }

    const fn fault(self) -> Fault {
        match self {
            Self::Centre | Self::Vertex => Fault::Position,
            Self::Half | Self::Growth => Fault::Size,
            Self::Tangent => Fault::Tangent,
            Self::Roll => Fault::Roll,
            Self::Lean => Fault::Lean,
            Self::Normal => Fault::Normal,
        }
    }
}

/// The worst errors of one quantity.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Worst {
    /// The largest error in the quantity's unit, among places whose tolerance is at most twice the
    /// plain one: neither far from the origin nor after much drift.
    pub error: f64,
    /// The largest error as a share of its tolerance. Above 1 it is a fault.
    pub share: f64,
}

/// The result of a comparison.
#[derive(Debug, Clone, Default)]
pub struct Report {
    counts: BTreeMap<Fault, u64>,
    first: Vec<Mismatch>,
    worst: BTreeMap<Quantity, Worst>,
}

/// The most mismatches that a report keeps in full.
const KEPT: usize = 5;

impl Report {
    /// Whether no fault was found.
    #[must_use]
    pub fn is_clean(&self) -> bool {
        self.counts.is_empty()
    }

    /// Number of times that `fault` was found.
    #[must_use]
    pub fn count(&self, fault: Fault) -> u64 {
        self.counts.get(&fault).copied().unwrap_or(0)
    }

    /// The first few mismatches.
    #[must_use]
    pub fn first(&self) -> &[Mismatch] {
        &self.first
    }

    /// The worst of `quantity`; zeros if it was not measured.
    #[must_use]
    pub fn worst(&self, quantity: Quantity) -> Worst {
        self.worst.get(&quantity).copied().unwrap_or_default()
    }

    /// Adds the faults of `other`, but not its measurements.
    pub fn absorb(&mut self, other: Self) {
        for (fault, count) in other.counts {
            *self.counts.entry(fault).or_default() += count;
        }
        let room = KEPT.saturating_sub(self.first.len());
        self.first.extend(other.first.into_iter().take(room));
    }

    /// Adds a fault.
    pub fn note(
        &mut self,
        fault: Fault,
        place: RingPlace,
        expected: impl fmt::Debug,
        actual: impl fmt::Debug,
    ) {
        *self.counts.entry(fault).or_default() += 1;
        if self.first.len() < KEPT {
            let (expected, actual) = (format!("{expected:?}"), format!("{actual:?}"));
            self.first.push(Mismatch { fault, place, expected, actual });
        }
    }

    /// Adds a fault if two counts differ. Returns whether they agree.
    pub fn note_count(&mut self, what: &str, place: RingPlace, expected: u64, actual: u64) -> bool {
        if expected != actual {
            self.note(Fault::Count, place, format_args!("{expected} {what}"), actual);
        }
        expected == actual
    }

    /// Measures `error` in units of `unit`. Returns whether it is within `allowed`.
    fn measure(&mut self, quantity: Quantity, error: f64, allowed: f64, unit: f64) -> bool {
        let worst = self.worst.entry(quantity).or_default();
        if allowed <= 2.0 * quantity.bound() * unit {
            worst.error = worst.error.max(error / unit);
        }
        worst.share = worst.share.max(error / allowed);
        error <= allowed
    }

    /// Measures an error as [`Report::measure`] does, and adds a fault if it is too large. Returns
    /// whether it is small enough.
    pub(super) fn check(
        &mut self,
        quantity: Quantity,
        place: RingPlace,
        [error, allowed, unit]: [f64; 3],
        values: (impl fmt::Debug, impl fmt::Debug),
    ) -> bool {
        let good = self.measure(quantity, error, allowed, unit);
        if !good {
            self.note(quantity.fault(), place, values.0, values.1);
        }
        good
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for mismatch in &self.first {
            writeln!(f, "{mismatch}")?;
        }
        let total: u64 = self.counts.values().sum();
        write!(f, "{total} mismatches:")?;
        for (fault, count) in &self.counts {
            write!(f, " {count} {fault:?}")?;
        }
        Ok(())
    }
}
