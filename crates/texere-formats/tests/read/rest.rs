//! Designs come to rest: with splines of the given tension, and knits also by their energy.

use texere_contact::clearance;
use texere_core::{Settings, YarnError};
use texere_cpu::ParallelBackend;
use texere_fabric::{FabricError, FinishError, Finished, RestBy};
use texere_formats::{Design, Refusal, RestReport, read};

use crate::read_file;

const CLOTH: &str = "weave = { notation = \"2/1\", ends = 9, picks = 9 }\nyarns.white.diameter_mm = 0.14\n\
    warp = { yarns = [\"white\"], spacing_mm = 0.25 }\nweft = { yarns = [\"white\"], spacing_mm = 0.35 }\n";
const JERSEY: &str =
    "knit = { chart = \"k\", repeat = [4, 4], loop_length_mm = 3.2 }\nyarns.ecru.tex = 20.0\n";
const TRICOT: &str = "yarns.white.diameter_mm = 0.1\n[warp_knit]\nwales = 2\ncourses = 2\nwales_per_cm = 10.0\n\
    courses_per_cm = 13.333\n[[warp_knit.bars]]\nlapping = \"tricot\"\n";

fn design(text: &str) -> Design {
    read_file("design.toml", text).unwrap()
}

#[test]
fn cloth_has_the_tension_that_is_asked_for() {
    let device = ParallelBackend::open().unwrap();
    for text in [CLOTH, JERSEY, TRICOT] {
        let mut asked = design(text);
        let rested = asked.clone().rest(&device).tension(0.3).run().unwrap();
        assert!(matches!(rested.report(), RestReport::Finished(_)));
        assert_eq!(rested.yarns().tension(), 0.3, "{text}");
        let found = clearance(rested.yarns(), &Settings::default()).unwrap();
        assert!(found.min > 0.97, "{text}: {}", found.min);
        let slack = asked.clone().rest(&device).run().unwrap();
        assert_eq!(slack.yarns().tension(), 0.0, "{text}");
        // Yarns that settle by contact end in other places with another tension. Threads that
        // settle by crossings do not depend on their splines.
        assert!(text == CLOTH || slack.yarns().points() != rested.yarns().points(), "{text}");
        asked.settle = false;
        let placed = asked.clone().rest(&device).tension(0.3).run().unwrap();
        assert!(matches!(placed.report(), RestReport::Placed(_)));
        assert_eq!(placed.yarns().tension(), 0.3, "{text}");
        assert_eq!(asked.placed(0.0).unwrap().yarns().tension(), 0.0, "{text}");
    }
}

/// A knit that comes to rest by its energy finds its own gauge. If it is written as a design file
/// and read again, it comes to rest with nearly that gauge: jersey and rib to a thousandth. Locknit
/// then starts from other underlaps, and gets 2 % longer or shorter.
#[test]
fn a_knit_finds_its_gauge_and_keeps_it() {
    let device = ParallelBackend::open().unwrap();
    let rib = JERSEY.replace("\"k\"", "\"kp\"");
    let locknit =
        TRICOT.replace("\"tricot\"", "\"1-0/2-3//\"") + "[[warp_knit.bars]]\nlapping = \"1-2/1-0//\"\n";
    for text in [JERSEY, &rib, &locknit] {
        let asked = design(&format!("finish.rest = \"energy\"\n{text}"));
        let placed = asked.structure.size_mm();
        let cloth = asked.rest(&device).run().unwrap();
        let found = cloth.design().structure.size_mm();
        let moved = |axis: usize| (found[axis] / placed[axis] - 1.0).abs();
        assert!(moved(0).max(moved(1)) > 0.02, "{found:?} {placed:?}");
        #[cfg(feature = "serde")]
        {
            let report = texere_formats::SettlingReport::new(&cloth, "cpu").unwrap().to_string();
            assert!(report.contains("by energy after") && report.contains("linking unchanged"), "{report}");
        }
        let mut written = Vec::new();
        texere_formats::write::toml_to(cloth.design(), &mut written).unwrap();
        let written = String::from_utf8(written).unwrap();
        let again = design(&written).rest(&device).run().unwrap().design().structure.size_mm();
        for axis in 0..2 {
            assert!((again[axis] / found[axis] - 1.0).abs() < 0.03, "{again:?} {found:?} {written}");
        }
    }
}

/// The knits of the repository's designs that come to rest quickly. Lace, cables, tulle and atlas
/// come to rest, too, in 6 to 22 s each.
const KNITS: [&str; 13] = [
    "jersey",
    "rib",
    "garter",
    "miss",
    "tuck",
    "interlock",
    "milano",
    "tricot",
    "locknit",
    "reverse-locknit",
    "sharkskin",
    "queenscord",
    "net",
];

#[test]
fn the_designs_knits_rest_by_their_energy() {
    let device = ParallelBackend::open().unwrap();
    for name in KNITS {
        let path = format!("{}/../../designs/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        let mut knit = read(&path).unwrap();
        knit.finish.by = RestBy::Energy;
        let cloth = knit.rest(&device).run().unwrap();
        let RestReport::Finished(Finished::Relaxed(rest)) = cloth.report() else { panic!("{name}") };
        assert!(rest.balanced && rest.is_linked(), "{name}: {} of {}", rest.unbalanced, rest.pressed);
        assert!(rest.clearance.min >= 0.98, "{name}: {}", rest.clearance.min);
    }
}

#[test]
fn a_tension_out_of_range_is_refused() {
    let device = ParallelBackend::open().unwrap();
    for tension in [-0.1, 1.0, f32::NAN] {
        for (text, settle) in [(CLOTH, true), (JERSEY, true), (TRICOT, true), (CLOTH, false)] {
            let mut asked = design(text);
            asked.settle = settle;
            let refused = asked.rest(&device).tension(tension).run().unwrap_err();
            assert!(
                matches!(
                    refused,
                    Refusal::Other(FinishError::Fabric(FabricError::Yarns(YarnError::Tension { .. })))
                ),
                "{tension}: {refused}"
            );
        }
    }
}
