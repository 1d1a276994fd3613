//! Cloths at which rays are shot.

use texere_conformance::cases;
use texere_core::{ControlPoint, Frame, Section, Settings, Yarn, Yarns};

/// Flat yarns with a polygon as section, which turn and cross over and under one another.
pub(crate) fn twisted() -> Yarns {
    let mut yarns = Yarns::builder();
    yarns.section(Section::Polygon(vec![[1.5, -0.4], [1.2, 0.5], [-0.2, 0.6], [-1.4, 0.1], [-0.9, -0.6]]));
    for number in 0..12 {
        let points: Vec<_> = (0..40)
            .map(|k| {
                let (along, beside) = (k as f32 * 0.5, (number / 2) as f32 * 3.0 + 1.0);
                let height = ((k + number) as f32 * 0.8).sin() * 0.6;
                let (x, y) = if number % 2 == 0 { (along, beside) } else { (beside, along) };
                let wide = 0.4 + 0.1 * (k as f32).cos();
                ControlPoint::new(x, y, height, 0.1).flattened(wide, 0.2)
            })
            .collect();
        yarns.yarn(Yarn { twist: 1.0 - 0.3 * number as f32, ..Yarn::default() }, &points);
    }
    yarns.build().unwrap()
}

/// A cloth at which rays are shot.
pub(crate) struct Cloth {
    pub(crate) name: &'static str,
    pub(crate) yarns: Yarns,
    pub(crate) settings: Settings,
    /// Number of rays that are compared with all triangles of the cloth.
    pub(crate) rays: usize,
}

/// Cloths that together have every case that a picker treats differently. They get 100,000 rays in
/// all.
pub(crate) fn clothes() -> Vec<Cloth> {
    let capped = Settings { caps: true, ..Settings::default() };
    let turning = Settings { frame: Frame::RotationMinimizing, ..capped };
    let case = |name: &str| {
        let case = cases::all().into_iter().find(|case| case.name == name).unwrap();
        (case.yarns(), case.settings)
    };
    let (denim, _) = case("design-denim::upright");
    let (jersey, _) = case("design-jersey::upright");
    let (jacquard, _) = case("design-warp-jacquard::upright");
    let closed = Yarn { closed: true, twist: 0.7, ..Yarn::default() };
    let bare = Settings { subdivisions: 0, ..capped };
    let cloth = |name, yarns, settings, rays| Cloth { name, yarns, settings, rays };
    vec![
        cloth("woven", denim, Settings { caps: false, ..bare }, 12_000),
        cloth("twisted", twisted(), Settings { sides: 5, subdivisions: 2, ..turning }, 20_000),
        cloth("weft knit", jersey, bare, 3_000),
        cloth("warp knit", jacquard, Settings { subdivisions: 0, ..turning }, 3_000),
        cloth("all shapes", cases::mixed(), Settings { subdivisions: 0, ..turning }, 12_000),
        cloth(
            "closed",
            cases::winding(150, closed).with_tension(0.4).unwrap(),
            Settings { subdivisions: 5, ..turning },
            26_000,
        ),
        cloth("long", cases::winding(1_000, Yarn { twist: 2.0, ..Yarn::default() }), turning, 8_000),
        cloth(
            "round",
            cases::winding(500, Yarn::default()),
            Settings { subdivisions: 3, sides: 4, ..capped },
            16_000,
        ),
    ]
}
