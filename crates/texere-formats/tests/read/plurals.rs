//! Messages use the singular for one thing.

use texere_contact::ContactError;
use texere_core::{
    BackendError, CrossingsError, OutOfMemory, PlanError, SectionError, SettlingError, YarnError,
};
use texere_fabric::FabricError as Fabric;
use texere_fabric::WovenError;
use texere_fabric::warp::WarpError;
use texere_fabric::weft::{ChartError, WeftError};
use texere_formats::{ReadError, WriteError};

/// The first words of a message that use the plural after `1`.
fn several(said: &str) -> Option<String> {
    let words: Vec<_> = said.split(|letter: char| !letter.is_alphanumeric() && letter != '\'').collect();
    let ones = words.iter().enumerate().filter(|(_, word)| **word == "1");
    let wrong = |(at, _): (usize, &&str)| {
        // Both `1 control points` and `1 ends` are found. Verbs may end in s, too.
        let next = words[at + 1..]
            .iter()
            .take(2)
            .take_while(|word| !["is", "has", "needs", "crosses"].contains(*word));
        let next: Vec<_> = next.copied().collect();
        let several = |word: &str| word.len() > 2 && word.ends_with('s');
        let noun = ["control", "guide", "up", "loose"].contains(next.first()?);
        let found = next.get(usize::from(noun)).is_some_and(|word| several(word));
        found.then(|| format!("1 {}", next.join(" ")))
    };
    ones.filter_map(wrong).next()
}

#[test]
fn the_judge_knows_one_from_several() {
    assert_eq!(several("cloth of 1 ends and 2 picks").as_deref(), Some("1 ends and"));
    assert_eq!(several("yarn 3 has 1 control points, needs 2").as_deref(), Some("1 control points"));
    assert_eq!(several("cloth of 1 end and 11 picks; the least is 1"), None);
}

#[test]
fn errors_say_one_of_one() {
    let core = [
        SectionError::Corners { corners: 1, low: 3, high: 64 }.to_string(),
        YarnError::OffsetCount { offsets: 1, yarns: 1 }.to_string(),
        YarnError::TooFewPoints { yarn: 0, points: 1, least: 2, closed: false }.to_string(),
        YarnError::PointCount { points: 1, planned: 2 }.to_string(),
        YarnError::SourceCount { sources: 1, points: 1 }.to_string(),
        YarnError::UpCount { ups: 1, points: 1 }.to_string(),
        PlanError::Subdivisions { subdivisions: 1, limit: 0 }.to_string(),
        PlanError::Sides { sides: 1, low: 3, high: 256 }.to_string(),
        PlanError::PolygonSides { section: 0, corners: 1, sides: 1 }.to_string(),
        PlanError::YarnRings { yarn: 0, rings: 1, limit: 0 }.to_string(),
        PlanError::Rings { rings: 1, limit: 0 }.to_string(),
        PlanError::NoRoom { yarn: 0, points: 1, room: 0 }.to_string(),
        PlanError::TooFewPoints { yarn: 0, points: 1, least: 2 }.to_string(),
        PlanError::BlockTooLarge { rings: 1, what: "rings", needed: 1, limit: 1 }.to_string(),
        BackendError::OutOfMemory(OutOfMemory { what: "rings", bytes: 1 }).to_string(),
        BackendError::Crowded { chords: 1, limit: 3 }.to_string(),
        SettlingError::TooFewPoints { yarn: 0, points: 1, least: 2 }.to_string(),
        SettlingError::LongInterval { yarn: 0, axis: 'x', chords: 1, limit: 0 }.to_string(),
        SettlingError::LongYarns { points: 1, chords: 1, limit: 0 }.to_string(),
        SettlingError::OutOfMemory(OutOfMemory { what: "chords", bytes: 1 }).to_string(),
        CrossingsError::Drawdown { ups: 1, ends: 1, picks: 1 }.to_string(),
        CrossingsError::TooFew { what: "end", count: 1, least: 2 }.to_string(),
    ];
    let fabric = [
        WovenError::Size { ends: 1, picks: 1, limit: 9 }.to_string(),
        WovenError::Crossings { ends: 1, picks: 1, crossings: 2, limit: 1 }.to_string(),
        WovenError::Points { ends: 1, picks: 1, points: 1, limit: 0 }.to_string(),
        WeftError::KnitRuns { passed: 9, loops: 1, limit: 2, operation: None }.to_string(),
        Fabric::OutOfMemory(OutOfMemory { what: "loops", bytes: 1 }).to_string(),
        WovenError::NoCrossing { end: 2, pick: 2, ends: 1, picks: 1 }.to_string(),
        WovenError::TieUp { treadles: 1, ends: 1, limit: 0 }.to_string(),
        WovenError::NoSatin { text: "satin".into(), position: 6, ends: 1 }.to_string(),
        WovenError::SatinMove { text: "satin".into(), position: 6, step: 3, ends: 1 }.to_string(),
        WovenError::Repeat { ends: 1, picks: 1, limit: 0 }.to_string(),
        WovenError::ThreadCount { set: "pick", threads: 1, planned: 2 }.to_string(),
        Fabric::OtherYarns { points: 1, planned: 2 }.to_string(),
        WeftError::Copies { loops: 1, limit: 0 }.to_string(),
        WeftError::KnitPoints { points: 9, limit: 1 }.to_string(),
        WeftError::KnitRepeat { points: 9, limit: 1 }.to_string(),
        WarpError::Laps { laps: 1, limit: 0 }.to_string(),
        WarpError::Bars { bars: 1, limit: 0 }.to_string(),
        WarpError::BarOffset { bar: 2, offset: 1, limit: 0 }.to_string(),
        WarpError::JacquardCourses { bar: 2, courses: 1, chain: 2 }.to_string(),
        WarpError::WarpRepeat { what: "wale", size: 1, multiple: 2 }.to_string(),
    ];
    let others = [
        ContactError::ClearancePoints { points: 1, limit: 0 }.to_string(),
        ContactError::LinkingSize { intervals: 1, limit: 0 }.to_string(),
        ChartError::Size { wales: 1, rows: 1, limit: 0 }.to_string(),
        ReadError::TooLarge { file: "a.wif".into(), bytes: 1, limit: 0 }.to_string(),
        ReadError::OutOfMemory(OutOfMemory { what: "a draft", bytes: 1 }).to_string(),
        WriteError::DraftTooLarge { ends: 1, picks: 1, width: 2, height: 2, limit: 0 }.to_string(),
    ];
    for said in core.into_iter().chain(fabric).chain(others) {
        assert_eq!(several(&said), None, "{said}");
    }
}
