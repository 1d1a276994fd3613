//! The pieces into which a cloth falls, and the yarns that nothing holds.

use std::fmt;

use texere_core::{Origin, counted};

use super::joined::Joined;
use crate::{BySet, Drawdown};

/// The most pieces, loose yarns and needles that are listed one by one.
const LISTED: usize = 4;

/// How a whole cloth hangs together: see [`Structure::pieces`](crate::Structure::pieces).
///
/// A piece of woven cloth is a layer that nothing binds to the next one. A piece of a knit consists
/// of yarns whose loops are drawn through one another, and of the yarns that are laid in between.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Pieces {
    /// Number of pieces: 1 for a cloth that hangs together. A loose yarn of a knit is a piece of
    /// its own.
    pub count: u64,
    /// Words for the first pieces, at most 4.
    pub listed: Vec<String>,
    /// Number of loose yarns: yarns that neither another yarn nor a loop of their own holds.
    pub loose: u64,
    /// The first loose yarns, at most 4.
    pub loose_listed: Vec<Origin>,
    /// Number of needles of a knit that never have a loop, over all wales.
    pub empty_needles: u64,
    /// The first of the needles that never have a loop, at most 4, counted from 0 at the left.
    pub empty_listed: Vec<u64>,
    /// Whether the pieces are layers, listed from the face.
    layers: bool,
}

impl Pieces {
    /// Whether there is more than one piece, or a yarn that nothing holds.
    #[must_use]
    pub const fn falls_apart(&self) -> bool {
        self.count > 1 || self.loose > 0
    }

    /// Sentences for a designer. There are none for a cloth that hangs together and has loops on
    /// all needles.
    ///
    /// ```
    /// use texere_core::{Material, Section};
    /// use texere_fabric::warp::{Bar, Chain, WarpKnitted};
    /// use texere_fabric::weft::{Gauge, KnitYarn};
    /// // A pillar bar alone: four chains that nothing joins.
    /// let pillar = vec![Bar::new(Chain::parse("1-0/0-1//", 1)?)];
    /// let (materials, sections) = (vec![Material::default()], vec![Section::Circle]);
    /// let yarns = vec![KnitYarn::new(0.05)];
    /// let cloth = WarpKnitted::new(pillar, Gauge::new(1.0, 0.75), 4, 2, yarns, materials, sections, [1, 1])?;
    /// let pieces = cloth.pieces();
    /// assert_eq!((pieces.count, pieces.loose), (4, 0));
    /// assert!(pieces.said()[0].starts_with("nothing binds all threads into one cloth: there are 4 pieces"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn said(&self) -> Vec<String> {
        let apart = self.falls_apart().then(|| self.to_string());
        apart.into_iter().chain(self.empty()).collect()
    }

    /// Words for the needles that never have a loop; `None` if there are none.
    #[must_use]
    pub fn empty(&self) -> Option<String> {
        let numbers = joined(self.empty_listed.iter().map(u64::to_string), self.empty_needles, ", ");
        (self.empty_needles > 0).then(|| format!("needles that never have a loop, counted from 0: {numbers}"))
    }

    /// The layers of woven cloth, and its loose threads.
    pub(crate) fn of_woven(drawdown: &Drawdown) -> Self {
        let layers = drawdown.layers();
        let size = |layer: &BySet<usize>| match layer.into_array() {
            [1, 0] => "a loose end".to_owned(),
            [0, 1] => "a loose pick".to_owned(),
            [ends, 0] => counted(ends, "loose end"),
            [0, picks] => counted(picks, "loose pick"),
            [ends, picks] => format!("{} with {}", counted(ends, "end"), counted(picks, "pick")),
        };
        // A single layer has both ends and picks, and no loose threads.
        let loose = if layers.len() > 1 { drawdown.loose(&layers) } else { Vec::new() };
        Self {
            count: layers.len() as u64,
            listed: layers.iter().take(LISTED).map(size).collect(),
            loose: loose.len() as u64,
            loose_listed: loose.into_iter().take(LISTED).collect(),
            layers: true,
            ..Self::default()
        }
    }

    /// The pieces of a knit of `copies` copies of one repeat. `joined` has the yarns of the repeat.
    /// `origin` gives the origin of a yarn by its number and its copy along x. `empty` are those of
    /// the repeat's `wales` needles that never have a loop.
    pub(crate) fn of_knit(
        joined: &mut Joined,
        copies: [u32; 2],
        origin: impl Fn(usize, u32) -> Origin,
        empty: &[u64],
        wales: u32,
    ) -> Self {
        let mut pieces = Self { empty_needles: empty.len() as u64 * u64::from(copies[0]), ..Self::default() };
        let needles = (0..u64::from(copies[0])).flat_map(|copy| empty.iter().map(move |own| (copy, own)));
        pieces.empty_listed = needles.map(|(copy, own)| copy * u64::from(wales) + own).take(LISTED).collect();
        for part in joined.parts() {
            let count = part.count(copies);
            pieces.count += count;
            let [first, ..] = part.yarns[..] else { continue };
            let loose = !joined.is_held(first);
            if loose {
                pieces.loose += count;
            }
            for copy in 0..u32::try_from(count.min(u64::from(copies[0]))).unwrap_or(u32::MAX) {
                if pieces.listed.len() < LISTED {
                    let more = if part.yarns.len() > 1 {
                        format!(" and {} more", part.yarns.len() - 1)
                    } else {
                        String::new()
                    };
                    let name = origin(first, copy);
                    pieces.listed.push(format!("{}{name}{more}", if loose { "loose: " } else { "" }));
                }
                if loose && pieces.loose_listed.len() < LISTED {
                    pieces.loose_listed.push(origin(first, copy));
                } else if pieces.listed.len() == LISTED {
                    break;
                }
            }
        }
        pieces
    }
}

/// Joins `listed` with `between`, and adds how many of `count` are not listed.
fn joined(listed: impl Iterator<Item = String>, count: u64, between: &str) -> String {
    let listed: Vec<_> = listed.collect();
    let more = count.saturating_sub(listed.len() as u64);
    let more = if more > 0 { format!("{between}and {more} more") } else { String::new() };
    listed.join(between) + &more
}

impl fmt::Display for Pieces {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let between = if self.layers { ", " } else { "; " };
        let listed = joined(self.listed.iter().cloned(), self.count, between);
        match (self.count, self.layers) {
            (0 | 1, _) if self.loose > 0 => write!(f, "nothing holds {listed}"),
            (0 | 1, _) => write!(f, "one piece"),
            (count, true) => write!(
                f,
                "nothing binds all threads into one cloth: from the face there are {count} layers ({listed})"
            ),
            (count, false) => {
                write!(f, "nothing binds all threads into one cloth: there are {count} pieces ({listed})")
            }
        }
    }
}
