//! Named lappings.

use super::{CHAIN_COURSES, Chain, Lap};

/// The names that [`Chain::named`] knows. "open" or "closed" may come before all names but inlay.
/// Atlas and inlay take a number.
pub const LAPPINGS: [&str; 7] = ["pillar", "tricot", "cord", "satin", "velvet", "atlas 4", "inlay 3"];

/// The fewest courses in which an atlas goes one way.
const ATLAS_MIN: i32 = 2;

/// The most courses in which an atlas goes one way, and the most needles that an inlay passes.
const WAY_MAX: i32 = 256;

const _: () = assert!(2 * WAY_MAX as usize <= CHAIN_COURSES, "an atlas is a chain");

impl Chain {
    /// The chain of a named lapping, such as `tricot` or `open tricot`; `None` for other names.
    ///
    /// | name | as a rule | open | closed |
    /// |---|---|---|---|
    /// | `pillar` | open | `0-1/1-0//` | `0-1/0-1//` |
    /// | `tricot` | closed | `0-1/2-1//` | `1-0/1-2//` |
    /// | `cord` | closed | `0-1/3-2//` | `1-0/2-3//` |
    /// | `satin` | closed | `0-1/4-3//` | `1-0/3-4//` |
    /// | `velvet` | closed | `0-1/5-4//` | `1-0/4-5//` |
    /// | `atlas 2` | open, turns closed: `1-0/1-2/2-3/2-1//` | `0-1/1-2/3-2/2-1//` | `1-0/2-1/2-3/1-2//` |
    /// | `inlay 3` | `0-0/3-3//` | | |
    ///
    /// An `atlas n` moves on by one needle at each of n courses, and then back; n is 2 to 256. An
    /// `inlay n` passes n needles one way and then back; n is 0 to 256.
    ///
    /// **Source**: Spencer, Knitting Technology, 3rd edition, 2001, chapter 24; Raz, Warp Knitting
    /// Production, 1987.
    ///
    /// ```
    /// use texere_fabric::warp::Chain;
    /// assert_eq!(Chain::named("open tricot").unwrap().to_string(), "0-1/2-1//");
    /// assert_eq!(Chain::named("atlas 3").unwrap().to_string(), "1-0/1-2/2-3/3-4/3-2/2-1//");
    /// assert!(Chain::named("twill").is_none());
    /// ```
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let mut words = name.split_whitespace().peekable();
        let open = match *words.peek()? {
            "open" => Some(true),
            "closed" => Some(false),
            _ => None,
        };
        if open.is_some() {
            words.next();
        }
        let name = words.next()?;
        let number: Option<i32> = match words.next() {
            Some(word) => Some(word.parse().ok()?),
            None => None,
        };
        if words.next().is_some() {
            return None;
        }
        let laps = match (name, number) {
            ("pillar", None) => pillar(open.unwrap_or(true)),
            ("tricot", None) => there_and_back(1, open),
            ("cord", None) => there_and_back(2, open),
            ("satin", None) => there_and_back(3, open),
            ("velvet", None) => there_and_back(4, open),
            ("atlas", Some(courses)) if (ATLAS_MIN..=WAY_MAX).contains(&courses) => atlas(courses, open),
            ("inlay", Some(needles)) if open.is_none() && (0..=WAY_MAX).contains(&needles) => {
                [0, needles].map(|space| Lap { from: space, to: space }).to_vec()
            }
            _ => return None,
        };
        Self::new(laps)
    }
}

/// A lap round one needle, towards higher numbers if `up` is set.
const fn round(needle: i32, up: bool) -> Lap {
    if up { Lap { from: needle, to: needle + 1 } } else { Lap { from: needle + 1, to: needle } }
}

fn pillar(open: bool) -> Vec<Lap> {
    vec![round(0, true), round(0, !open)]
}

/// A lapping of two courses, `needles` needles apart.
fn there_and_back(needles: i32, open: Option<bool>) -> Vec<Lap> {
    let open = open.unwrap_or(false);
    vec![round(0, open), round(needles, !open)]
}

/// An atlas of `courses` courses one way, and as many back. A lap is open if it goes in the
/// direction of the underlap after it.
fn atlas(courses: i32, open: Option<bool>) -> Vec<Lap> {
    let needles =
        (0..courses).map(|needle| (needle, true)).chain((1..=courses).rev().map(|needle| (needle, false)));
    let lap = |(needle, up): (i32, bool)| match open {
        Some(open) => round(needle, up == open),
        None => round(needle, up != (needle == 0 || needle == courses)),
    };
    needles.map(lap).collect()
}
