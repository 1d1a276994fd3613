//! The cases of the suite.

mod covering;
mod designs;
mod fabrics;
mod factors;
mod shapes;

pub use designs::{design, small_designs};
pub use factors::{pairwise, product};

use std::fmt;
use std::sync::Arc;

use texere_core::definitions::SIDES_MAX;
use texere_core::{Frame, Quantum, Section, Settings, Topology, Yarn, Yarns};

use crate::limits::Tight;

/// A case: yarns, settings and limits, with a name.
#[derive(Clone)]
pub struct Case {
    /// The case's subject and its frame, such as `helix-closed::rotation-minimizing`.
    pub name: String,
    /// The settings of the case's plan.
    pub settings: Settings,
    /// The limit that the case's chunks are cut to.
    pub tight: Tight,
    build: Arc<dyn Fn() -> Yarns + Send + Sync>,
}

impl fmt::Debug for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Case")
            .field("name", &self.name)
            .field("settings", &self.settings)
            .field("tight", &self.tight)
            .finish_non_exhaustive()
    }
}

/// Both frames, with the words for them in the names of cases.
const FRAMES: [(&str, Frame); 2] =
    [("upright", Frame::Upright), ("rotation-minimizing", Frame::RotationMinimizing)];

/// The settings of cases that are not about settings.
const USUAL: Settings = Settings {
    subdivisions: 3,
    sides: 6,
    frame: Frame::Upright,
    topology: Topology::Indexed,
    caps: true,
    quantum: Quantum::USUAL,
};

impl Case {
    /// A case whose chunks are cut to a few blocks.
    fn new(name: String, settings: Settings, build: impl Fn() -> Yarns + Send + Sync + 'static) -> Self {
        Self { name, settings, tight: Tight::Blocks, build: Arc::new(build) }
    }

    /// A case for each frame.
    fn framed(
        name: impl fmt::Display,
        settings: Settings,
        build: impl Fn() -> Yarns + Send + Sync + 'static,
    ) -> [Self; 2] {
        let case = Self::new(String::new(), settings, build);
        FRAMES.map(|(frame_name, frame)| Self {
            name: format!("{name}::{frame_name}"),
            settings: Settings { frame, ..settings },
            ..case.clone()
        })
    }

    /// The yarns. They are built on each call, so that listing cases takes little time.
    #[must_use]
    pub fn yarns(&self) -> Yarns {
        (self.build)()
    }
}

/// All cases, except those of [`product`].
#[must_use]
pub fn all() -> Vec<Case> {
    let mut cases = each_shape();
    cases.extend(settings_swept());
    cases.extend(ups_swept());
    cases.extend(sections_swept());
    cases.extend(long_and_many());
    cases.extend(papers());
    cases.extend(designs::each_design());
    cases.extend(pairwise());
    cases
}

/// Every shape in one fabric of round sections: yarns that are open and closed, twisted and
/// untwisted, long and short.
#[must_use]
pub fn menagerie() -> Yarns {
    fabrics::menagerie(Section::Circle)
}

/// [`menagerie`] with several materials and sections.
#[must_use]
pub fn mixed() -> Yarns {
    fabrics::mixed()
}

/// Flattened yarns with up directions that turn along them.
#[must_use]
pub fn leaning() -> Yarns {
    fabrics::leaning()
}

/// One open or closed yarn of `points` points, without any difficulty.
#[must_use]
pub fn winding(points: u32, yarn: Yarn) -> Yarns {
    fabrics::winding(points, yarn)
}

/// Every section that takes any number of sides, with its name.
#[must_use]
pub fn sections() -> Vec<(&'static str, Section)> {
    fabrics::sections()
}

/// Every shape alone.
fn each_shape() -> Vec<Case> {
    shapes::all()
        .into_iter()
        .flat_map(|shape| Case::framed(shape.name, USUAL, move || fabrics::alone(&shape)))
        .collect()
}

/// All shapes in one fabric, with many values of sides, subdivisions and tension, and with every
/// topology, capped and uncapped.
fn settings_swept() -> Vec<Case> {
    let mut cases = Vec::new();
    for sides in [3, 4, 5, 7, 8, 9, 12, 15, 16, 17, 24, 31, 32, 33, 48, 63, 64, 128, 192, 193, 255, 256] {
        let settings = Settings { sides, ..USUAL };
        cases.extend(Case::framed(format!("sides-{sides}"), settings, menagerie));
    }
    for subdivisions in 0..=8 {
        let settings = Settings { subdivisions, ..USUAL };
        cases.extend(Case::framed(format!("subdivisions-{subdivisions}"), settings, menagerie));
    }
    for tenths in 0..=9u8 {
        let build = move || menagerie().with_tension(f32::from(tenths) / 10.0).unwrap();
        cases.extend(Case::framed(format!("tension-0.{tenths}"), USUAL, build));
    }
    for (name, topology) in
        [("indexed", Topology::Indexed), ("shared", Topology::Shared), ("unindexed", Topology::None)]
    {
        for (caps_name, caps) in [("capped", true), ("uncapped", false)] {
            let settings = Settings { topology, caps, ..USUAL };
            cases.extend(Case::framed(format!("{name}-{caps_name}"), settings, mixed));
        }
    }
    cases
}

/// Yarns with up directions in both frames, with three pairs of subdivisions and tension.
fn ups_swept() -> Vec<Case> {
    let mut cases = Vec::new();
    for (subdivisions, tension) in [(0, 0.0), (3, 0.0), (8, 0.4)] {
        let settings = Settings { subdivisions, ..USUAL };
        let build = move || leaning().with_tension(tension).unwrap();
        cases.extend(Case::framed(format!("ups-{subdivisions}"), settings, build));
    }
    cases
}

/// Every section on every shape.
fn sections_swept() -> Vec<Case> {
    let mut cases = Vec::new();
    for (name, section) in sections() {
        for sides in [3, 8, 21] {
            let (settings, section) = (Settings { sides, ..USUAL }, section.clone());
            let build = move || fabrics::menagerie(section.clone());
            cases.extend(Case::framed(format!("section-{name}-{sides}"), settings, build));
        }
    }
    for (name, corners) in fabrics::polygons() {
        let settings = Settings { sides: corners.len() as u32, ..USUAL };
        let build = move || fabrics::menagerie(Section::Polygon(corners.clone()));
        cases.extend(Case::framed(format!("section-polygon-{name}"), settings, build));
    }
    cases
}

/// Cases that the paper's own algorithms cover: open, untwisted, upright yarns without caps.
fn papers() -> Vec<Case> {
    let mut cases = Vec::new();
    for (topology_name, topology) in
        [("indexed", Topology::Indexed), ("shared", Topology::Shared), ("unindexed", Topology::None)]
    {
        for (subdivisions, sides) in [(0, 64), (1, 6), (2, 3), (3, 16), (5, 7), (8, 4)] {
            let settings = Settings { subdivisions, sides, topology, caps: false, ..USUAL };
            let name = format!("paper-k{subdivisions}-n{sides}-{topology_name}::upright");
            cases.push(Case::new(name, settings, fabrics::standing));
        }
    }
    for points in [2, 63, 64, 65, 66, 129, 1_000] {
        let settings = Settings { subdivisions: 0, caps: false, ..USUAL };
        let build = move || fabrics::winding(points, Yarn::default());
        cases.push(Case::new(format!("paper-rings-{points}::upright"), settings, build));
    }
    // In the paper's schedule one lane makes all vertices of a yarn. Here these are more than
    // 65,535, by many rings (`long`) and by many sides (`wide`).
    for (name, sides, points) in [("long", 24, 1_000), ("wide", SIDES_MAX, 66)] {
        let settings = Settings { sides, caps: false, ..USUAL };
        let build = move || fabrics::winding(points, Yarn::default());
        cases.push(Case::new(format!("paper-{name}::upright"), settings, build));
    }
    cases
}

fn long_and_many() -> Vec<Case> {
    let mut cases = Vec::new();
    // Yarns of about one, two or three blocks, with a ring more or less.
    for points in [63, 64, 65, 66, 128, 129, 193] {
        let settings = Settings { subdivisions: 0, ..USUAL };
        let open = move || fabrics::winding(points, Yarn { twist: 0.3, ..Yarn::default() });
        let closed = move || fabrics::winding(points, Yarn { closed: true, twist: 0.3, ..Yarn::default() });
        cases.extend(Case::framed(format!("rings-{points}"), settings, open));
        cases.extend(Case::framed(format!("rings-{}-closed", points + 1), settings, closed));
    }
    let million = Settings { subdivisions: 999, sides: 3, caps: false, ..USUAL };
    let yarn = Yarn { twist: 2.0, ..Yarn::default() };
    cases.extend(Case::framed("million-rings", million, move || fabrics::winding(1001, yarn)));
    let yarn = Yarn { closed: true, ..yarn };
    cases.extend(Case::framed("million-rings-closed", million, move || fabrics::winding(1000, yarn)));
    let short = Settings { subdivisions: 1, ..USUAL };
    cases.extend(Case::framed("many-short", short, fabrics::many_short));
    cases.extend(Case::framed("wandering", USUAL, fabrics::wandering));
    cases.extend(Case::framed("mixed", Settings { sides: 10, ..USUAL }, mixed));
    for (name, scale) in [("micrometres", 1e-3), ("metres", 1e3)] {
        let build = move || fabrics::scaled(&fabrics::winding(50, Yarn::default()), scale);
        cases.extend(Case::framed(format!("scale-{name}"), USUAL, build));
    }
    cases
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oracle::Oracle;
    use std::collections::BTreeSet;

    #[test]
    fn names_are_unique() {
        let cases = all();
        let names: BTreeSet<_> = cases.iter().map(|case| &case.name).collect();
        assert_eq!(names.len(), cases.len());
    }

    /// If a closed yarn's excess over whole turns were near half a turn, rounding would decide in
    /// which direction the excess is spread, and backends would disagree.
    #[test]
    fn no_closed_yarn_is_near_half_a_turn_off() {
        for case in all() {
            let excess = Oracle::new(&case.yarns(), &case.settings).yarns.into_iter().map(|yarn| yarn.excess);
            for (yarn, excess) in excess.enumerate() {
                assert!(excess.abs() < 0.499, "{}, yarn {yarn}: {excess}", case.name);
            }
        }
    }
}
