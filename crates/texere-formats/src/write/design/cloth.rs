//! The settings of a woven design that differ from the defaults, and the parts of the design that a
//! WIF draft leaves out.

use texere_core::Section;
use texere_core::crossings::Set;
use texere_fabric::{COTTON_LEAST_AREA, Crimp, Finish, Relief, Shape, Thread, Woven, WovenDesign};

use super::text::named;
use crate::Design;

/// The settings of a design's finish that differ from the defaults. Only settings of woven cloth
/// have keys here. Settings of knits, and settings that only a program can ask for, have none.
pub(super) struct Finished {
    /// Keys of woven cloth, each with its value.
    pub(super) keys: Vec<(&'static str, f64)>,
    /// Settings without a key for woven cloth, in words.
    pub(super) unsaid: Vec<String>,
}

impl Finished {
    pub(super) fn new(design: &Design) -> Self {
        let Finish { by, hold, length, press_mm, passes, record, taut, calender } = design.finish;
        let usual = Finish::default();
        let times = [
            ("warp_tension", taut.warp, usual.taut.warp),
            ("weft_tension", taut.weft, usual.taut.weft),
            ("calender", calender, usual.calender),
        ];
        let times = times.into_iter().filter(|(_, value, usual)| value != usual);
        let mut keys: Vec<_> = times.map(|(key, value, _)| (key, f64::from(value))).collect();
        if let Some(stretch) = design.stretch {
            let key = match stretch.along {
                Set::Warp => "stretch_warp",
                Set::Weft => "stretch_weft",
            };
            keys.push((key, stretch.by));
        }
        let unsaid = [
            (by != usual.by, "finish.rest, which only knits have"),
            (hold != usual.hold, "finish.hold, which only knits have"),
            (length != usual.length, "finish.length, which only knits have"),
            (press_mm != usual.press_mm, "finish.press, which only knits have"),
            (passes != usual.passes, "the most passes of settling"),
            (record != usual.record, "whether a record of settling is kept"),
        ];
        Self { keys, unsaid: named(&unsaid) }
    }
}

/// The parts of a woven design, apart from names, that a WIF draft has no keys for.
pub(super) fn beyond_wif(design: &Design, woven: &WovenDesign) -> Vec<String> {
    let cloth = woven.cloth();
    let any = |what: &dyn Fn(&Thread) -> bool| cloth.warp().iter().chain(cloth.weft()).any(what);
    let section = |thread: &Thread| cloth.sections()[thread.section as usize] != Section::Circle;
    let material = |thread: &Thread| &cloth.materials()[thread.material as usize];
    let tex = |thread: &Thread| material(thread).tex.is_some();
    let hairiness = |thread: &Thread| material(thread).hairiness != 0.0;
    let said = [
        (any(&tex), "yarns.tex"),
        (any(&|thread| thread.flatness != 1.0), "yarns.flatness"),
        (any(&|thread| thread.stiffness != 1.0), "yarns.stiffness"),
        (any(&|thread| thread.firmness != 1.0), "yarns.firmness"),
        (any(&|thread| thread.least_area != COTTON_LEAST_AREA), "yarns.least_area"),
        (any(&section), "yarns.section"),
        (any(&|thread| thread.twist != 0.0), "yarns.twist_per_m"),
        (any(&hairiness), "yarns.hairiness"),
        (cloth.shape() != Shape::default(), "cloth.shape"),
        (cloth.crimp() != Crimp::default(), "cloth.warp_crimp"),
        (cloth.selvedge(), "cloth.selvedge"),
        (woven.relief() != Relief::Report, "cloth.jam"),
        (design.settle, "finish.settle: a draft is left as it is woven"),
    ];
    let finished = Finished::new(design);
    let keys = finished.keys.iter().map(|(key, _)| format!("finish.{key}"));
    named(&said).into_iter().chain(keys).chain(finished.unsaid.clone()).collect()
}

/// Keys of `[cloth]` whose values differ from the defaults, with their values. The key `jam` is not
/// among them: the caller adds it.
pub(super) fn cloth_keys(cloth: &Woven) -> Vec<String> {
    let shape = match cloth.shape() {
        Shape::Crossing => Some("shape = \"crossing\"".into()),
        _ => None,
    };
    let crimp = match cloth.crimp() {
        Crimp::WarpShare(share) => {
            let (share, _) = super::text::nearest(f64::from(share), |read| read as f32 == share);
            Some(format!("warp_crimp = {share:?}"))
        }
        _ => None,
    };
    let selvedge = cloth.selvedge().then(|| "selvedge = true".into());
    [shape, crimp, selvedge].into_iter().flatten().collect()
}
