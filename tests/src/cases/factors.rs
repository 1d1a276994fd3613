//! Cases that combine settings, sections, ends and limits: with every pair of values, or with every
//! combination.

use texere_core::{Frame, Section, Settings, Topology, Yarn};

use super::covering::covering;
use super::{Case, FRAMES, fabrics};
use crate::limits::Tight;

/// A kind of section, made for the number of sides of a tube.
type Sectioned = (&'static str, fn(u32) -> Section);

const SECTIONS: [Sectioned; 6] = [
    ("circle", |_| Section::Circle),
    ("ellipse", |_| Section::Ellipse { aspect: 1.8 }),
    ("lens", |_| Section::Lenticular { aspect: 2.0, distortion: 0.25 }),
    ("power", |_| Section::PowerEllipse { aspect: 1.5, exponent: 0.6 }),
    ("three-ply", |_| Section::plied(3)),
    ("polygon", |sides| Section::Polygon(fabrics::cog(sides))),
];

const ENDS: [(&str, bool); 2] = [("open", false), ("closed", true)];

const CAPS: [(&str, bool); 2] = [("uncapped", false), ("capped", true)];

const TOPOLOGIES: [(&str, Topology); 3] =
    [("indexed", Topology::Indexed), ("shared", Topology::Shared), ("unindexed", Topology::None)];

const TWISTS: [(&str, f32); 3] = [("untwisted", 0.0), ("twist-z", 0.6), ("twist-s", -3.0)];

/// The width of each control point, by its number, divided by its height.
type Flattened = (&'static str, fn(u8) -> f32);

const FLATTENINGS: [Flattened; 3] =
    [("round", |_| 1.0), ("flat", |_| 1.8), ("flat-here-and-there", |k| 1.6 + (f32::from(k) * 0.8).sin())];

const LIMITS: [(&str, Tight); 4] = [
    ("unlimited", Tight::Nothing),
    ("few-blocks", Tight::Blocks),
    ("small-bindings", Tight::Binding),
    ("little-memory", Tight::Memory),
];

/// The factors whose ranges are too long for the product.
struct Counts {
    subdivisions: Vec<u32>,
    sides: Vec<u32>,
}

impl Counts {
    fn all() -> Self {
        Self { subdivisions: (0..=8).collect(), sides: (3..=64).collect() }
    }

    /// A few values of each factor: the least and the most, odd and even numbers, powers of two,
    /// and numbers beside them.
    fn thinned() -> Self {
        Self { subdivisions: vec![0, 1, 2, 4, 8], sides: vec![3, 4, 5, 6, 7, 8, 16, 33, 64] }
    }

    /// Number of values of each factor.
    fn sizes(&self) -> [usize; 10] {
        [
            self.subdivisions.len(),
            self.sides.len(),
            FRAMES.len(),
            SECTIONS.len(),
            ENDS.len(),
            CAPS.len(),
            TOPOLOGIES.len(),
            TWISTS.len(),
            LIMITS.len(),
            FLATTENINGS.len(),
        ]
    }

    /// The case of `row`, which has the number of a value for each factor. The case's name begins
    /// with `set` and has all values.
    fn case(&self, set: &str, row: &[usize]) -> Case {
        let &[subdivisions, sides, frame, section, end, caps, topology, twist, limit, flattening] = row
        else {
            panic!("{row:?} is not a value for each factor");
        };
        let (subdivisions, sides) = (self.subdivisions[subdivisions], self.sides[sides]);
        let (frame_name, frame): (_, Frame) = FRAMES[frame];
        let (section_name, section) = SECTIONS[section];
        let (end_name, closed) = ENDS[end];
        let (caps_name, caps) = CAPS[caps];
        let (topology_name, topology) = TOPOLOGIES[topology];
        let (twist_name, twist) = TWISTS[twist];
        let (limit_name, tight) = LIMITS[limit];
        let (flattening_name, flatten) = FLATTENINGS[flattening];
        let settings = Settings { subdivisions, sides, frame, topology, caps, ..Settings::default() };
        let name = format!(
            "{set}::k{subdivisions}-n{sides}-{section_name}-{end_name}-{caps_name}-{topology_name}-{twist_name}-\
             {limit_name}-{flattening_name}::{frame_name}"
        );
        let build =
            move || fabrics::couple(Yarn { closed, twist, ..Yarn::default() }, section(sides), flatten);
        Case { tight, ..Case::new(name, settings, build) }
    }
}

/// Cases in which every pair of values occurs: of subdivisions 0 to 8, sides 3 to 64, both frames,
/// six kinds of section, open and closed yarns, caps, topologies, twist, limits, and flattening.
#[must_use]
pub fn pairwise() -> Vec<Case> {
    let counts = Counts::all();
    covering(&counts.sizes()).iter().map(|row| counts.case("pairwise", row)).collect()
}

/// Every combination of the values of [`pairwise`], with subdivisions 0, 1, 2, 4 and 8 and with 3
/// to 8, 16, 33 and 64 sides: 233,280 cases.
#[must_use]
pub fn product() -> Vec<Case> {
    let counts = Counts::thinned();
    let sizes = counts.sizes();
    let case = |number: usize| {
        let mut rest = number;
        let row = sizes.map(|size| {
            let value = rest % size;
            rest /= size;
            value
        });
        counts.case("product", &row)
    };
    (0..sizes.iter().product()).map(case).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// A text that differs between two cases exactly if their values of factor `which` differ. It
    /// is read from the case, not from its row.
    fn value(case: &Case, which: usize) -> String {
        let Settings { subdivisions, sides, frame, topology, caps, .. } = case.settings;
        let yarns = case.yarns();
        let yarn = yarns.layout().yarns()[0];
        match which {
            0 => subdivisions.to_string(),
            1 => sides.to_string(),
            2 => format!("{frame:?}"),
            // A polygon has as many corners as there are sides.
            3 => format!("{:?}", std::mem::discriminant(&yarns.layout().sections()[yarn.section as usize])),
            4 => yarn.closed.to_string(),
            5 => caps.to_string(),
            6 => format!("{topology:?}"),
            7 => yarn.twist.to_string(),
            8 => format!("{:?}", case.tight),
            _ => {
                let flatness = |k: usize| yarns.points()[k].half_width() / yarns.points()[k].half_height();
                format!("{:.2} {:.2}", flatness(0), flatness(1))
            }
        }
    }

    #[test]
    fn every_pair_of_values_meets() {
        let counts = [9, 62, 2, 6, 2, 2, 3, 3, 4, 3];
        let values: Vec<[String; 10]> =
            pairwise().iter().map(|case| std::array::from_fn(|which| value(case, which))).collect();
        for one in 0..10 {
            for other in one + 1..10 {
                let met: BTreeSet<_> = values.iter().map(|values| (&values[one], &values[other])).collect();
                assert_eq!(met.len(), counts[one] * counts[other], "factors {one} and {other}");
            }
        }
    }

    #[test]
    fn the_product_has_every_combination_once() {
        let names: BTreeSet<_> = product().into_iter().map(|case| case.name).collect();
        assert_eq!(names.len(), 233_280);
    }
}
