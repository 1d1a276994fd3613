//! Cloths at setts that mills weave.

use texere_core::crossings::{CrossingThread, Crossings};

/// A cloth, its yarns in tex, and the values that it must reach: crimp in per cent (within four
/// points), weight in g/m² (within a tenth), and a lower bound of the mean area of sections, as a
/// share of the area of the round yarn's section.
pub(crate) struct Cloth {
    pub(crate) name: &'static str,
    pub(crate) problem: Crossings,
    pub(crate) tex: [f64; 2],
    pub(crate) crimp: [f64; 2],
    pub(crate) area: [f64; 2],
    pub(crate) grams: Option<f64>,
}

/// The tex of an English cotton count.
fn tex(count: f64) -> f64 {
    590.5 / count
}

fn diameter(tex: f64) -> f64 {
    0.0373 * tex.sqrt()
}

fn cloth(
    name: &'static str,
    tex: [f64; 2],
    pitch: [f64; 2],
    [ends, picks]: [usize; 2],
    up: impl Fn(usize, usize) -> bool,
    (crimp, area, grams): ([f64; 2], [f64; 2], Option<f64>),
) -> Cloth {
    let threads = [0, 1].map(|set: usize| CrossingThread::new(pitch[set] as f32, diameter(tex[set]) as f32));
    let ups = (0..ends * picks).map(|number| up(number % ends, number / ends)).collect();
    let problem = Crossings::new(ups, vec![threads[0]; ends], vec![threads[1]; picks]);
    Cloth { name, problem, tex, crimp, area, grams }
}

fn per_inch(ends: f64, picks: f64) -> [f64; 2] {
    [25.4 / ends, 25.4 / picks]
}

/// All cloths, each with the crimp that is expected of it. For poplin, 14 % in the warp and 2 % in
/// the weft are published. For denim and all other cloths, the expected crimp is what the cloth
/// reached before. In the warp of denim that is too much: mills find 10 to 14 %.
pub(crate) fn cloths() -> Vec<Cloth> {
    let twill = |end: usize, pick: usize| !(end + 4 - pick % 4).is_multiple_of(4);
    let plain = |end: usize, pick: usize| (end + pick).is_multiple_of(2);
    let satin = |end: usize, pick: usize| !(end + 64 - 3 * (pick % 8)).is_multiple_of(8);
    let [t16, t20, t30, t40, t60] = [16.0, 20.0, 20.0 / 1.5, 40.0, 60.0].map(tex);
    let square = |tex: f64, pitch: f64| [diameter(tex) * pitch; 2];
    vec![
        cloth(
            "denim",
            [tex(7.0), tex(10.0)],
            per_inch(72.0, 56.0),
            [4; 2],
            twill,
            ([24.0, 3.0], [0.76, 0.78], None),
        ),
        cloth(
            "poplin",
            [t40; 2],
            per_inch(133.0, 72.0),
            [2; 2],
            plain,
            ([14.0, 2.0], [0.9, 0.92], Some(131.0)),
        ),
        cloth("sheeting", [t20; 2], per_inch(60.0, 60.0), [2; 2], plain, ([6.0; 2], [0.93; 2], Some(148.0))),
        cloth(
            "drill",
            [t20, t16],
            per_inch(108.0, 56.0),
            [4; 2],
            twill,
            ([11.5, 2.5], [0.9; 2], Some(227.0)),
        ),
        cloth(
            "sateen",
            [t60; 2],
            per_inch(173.0, 120.0),
            [5; 2],
            |end, pick| (end + 25 - 2 * (pick % 5)).is_multiple_of(5),
            ([6.0, 4.0], [0.92; 2], Some(120.0)),
        ),
        cloth("satin of 8", [t30; 2], square(t30, 1.25), [8; 2], satin, ([4.5; 2], [0.89; 2], None)),
        cloth(
            "twill 2/2",
            [t20; 2],
            square(t20, 1.5),
            [4; 2],
            |end, pick| (end + 4 - pick % 4) % 4 < 2,
            ([10.5, 5.5], [0.75; 2], None),
        ),
        cloth(
            "plain, jam",
            [t20; 2],
            square(t20, 3.0_f64.sqrt()),
            [2; 2],
            plain,
            ([11.0; 2], [0.85; 2], None),
        ),
        cloth("plain, 2 d", [t20; 2], square(t20, 2.0), [2; 2], plain, ([7.0; 2], [0.9; 2], None)),
        cloth(
            "Jacquard",
            [t20; 2],
            square(t20, 1.75),
            [32; 2],
            |end, pick| if end < 16 || pick < 16 { satin(end, pick) } else { plain(end, pick) },
            ([4.0; 2], [0.9; 2], None),
        ),
    ]
}
