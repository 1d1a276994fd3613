//! A design comes to rest with splines of the given tension.
#![cfg(feature = "toml")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use texere_contact::clearance;
use texere_core::{Settings, YarnError};
use texere_cpu::ParallelBackend;
use texere_fabric::{FabricError, FinishError};
use texere_formats::{Design, Refusal, RestReport, read};

const CLOTH: &str = "weave = { notation = \"2/1\", ends = 9, picks = 9 }\nyarns.white.diameter_mm = 0.14\n\
    warp = { yarns = [\"white\"], spacing_mm = 0.25 }\nweft = { yarns = [\"white\"], spacing_mm = 0.35 }\n";
const JERSEY: &str =
    "knit = { chart = \"k\", repeat = [4, 4], loop_length_mm = 3.2 }\nyarns.ecru.tex = 20.0\n";
const TRICOT: &str = "yarns.white.diameter_mm = 0.1\n[warp_knit]\nwales = 2\ncourses = 2\nwales_per_cm = 10.0\n\
    courses_per_cm = 13.333\n[[warp_knit.bars]]\nlapping = \"tricot\"\n";

fn design(text: &str) -> Design {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("design.toml");
    std::fs::write(&path, text).unwrap();
    read(&path).unwrap()
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
