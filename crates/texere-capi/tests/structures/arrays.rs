//! Designs as arrays, and texts of the same designs.

use std::ptr::null;

use texere_c::texere_status::TEXERE_OK;
use texere_c::*;

use crate::common::sized;

pub(crate) fn diameter(tex: f64, density: f64) -> f64 {
    let mut diameter_mm = 0.0;
    // SAFETY: the place lives as long as the call.
    assert_eq!(unsafe { texere_diameter(tex, density, &mut diameter_mm) }, TEXERE_OK);
    diameter_mm
}

/// Twist of 500 turns per metre, Z, in radians per mm.
pub(crate) const TWIST: f32 = (500.0 * std::f64::consts::TAU / 1000.0) as f32;

pub(crate) fn materials() -> [texere_material; 2] {
    [("a", 30.0, 5.0, [0xff, 0x80, 0x01]), ("bé", 0.0, 0.0, [1, 2, 3])].map(|(name, tex, hairiness, srgb)| {
        texere_material {
            name: name.as_ptr().cast(),
            name_length: name.len(),
            tex,
            hairiness,
            srgb,
            reserved: 0,
        }
    })
}

pub(crate) fn looks(materials: &[texere_material], sections: &[texere_section]) -> texere_looks {
    texere_looks {
        materials: materials.as_ptr(),
        material_count: materials.len() as u64,
        sections: sections.as_ptr(),
        section_count: sections.len() as u64,
    }
}

pub(crate) fn section(shape: u32) -> texere_section {
    texere_section { shape, count: 0, aspect: 1.5, form: 0.0, corners: null() }
}

pub(crate) const YARNS: &str = "[yarns.a]\ntex = 30.0\ndensity = 0.9\ntwist_per_m = 500.0\ncolor = \"#ff8001\"\n\
    [yarns.\"bé\"]\ndiameter_mm = 0.25\ncolor = \"#010203\"\nsection = { shape = \"ellipse\", aspect = 1.5 }\n";

/// Calls `call` with a woven design as arrays, which live as long as the call.
pub(crate) fn with_woven<T>(
    change: impl FnOnce(&mut texere_woven),
    call: impl FnOnce(&texere_woven) -> T,
) -> T {
    let none: texere_thread = texere_thread {
        spacing_mm: 0.6,
        diameter_mm: diameter(30.0, 0.9),
        flatness: 0.0,
        stiffness: 0.0,
        firmness: 0.0,
        twist: TWIST,
        material: 0,
        section: 0,
        // The yarn has 0.9 g/cm3. Cotton fibre of 1.52 g/cm3 fills 0.8 of the least area.
        least_area: (0.9 / (0.8 * 1.52)) as f32,
        reserved: 0,
    };
    let other =
        texere_thread { diameter_mm: 0.25, least_area: 0.0, twist: 0.0, material: 1, section: 1, ..none };
    let warp: Vec<_> = (0..11).map(|end| if end % 3 == 2 { other } else { none }).collect();
    let weft: Vec<_> =
        (0..9).map(|pick| texere_thread { spacing_mm: [0.5, 0.7][pick % 2], ..none }).collect();
    // A 2/2 right-hand twill, in rows of two bytes. Rows begin three bytes apart.
    let up = |end: usize, pick: usize| (end + 4 - pick % 4) % 4 < 2;
    let mut bits = [0xee_u8; 27];
    for (pick, row) in bits.chunks_mut(3).enumerate() {
        let row_bits = (0..11).filter(|&end| up(end, pick)).fold(0_u16, |bits, end| bits | 1 << end);
        row[..2].copy_from_slice(&row_bits.to_le_bytes());
    }
    let (materials, sections) =
        (materials(), [section(TEXERE_SECTION_CIRCLE), section(TEXERE_SECTION_ELLIPSE)]);
    let mut woven = texere_woven {
        selvedge: 1,
        crimp: TEXERE_CRIMP_SHARE,
        warp_share: 0.4,
        name: "twill".as_ptr().cast(),
        name_length: 5,
        ends: 11,
        picks: 9,
        drawdown: texere_view { data: bits.as_mut_ptr().cast(), size: 26, stride: 3 },
        warp: warp.as_ptr(),
        weft: weft.as_ptr(),
        looks: looks(&materials, &sections),
        ..sized()
    };
    change(&mut woven);
    call(&woven)
}

pub(crate) fn woven_text() -> String {
    format!(
        "weave = {{ notation = \"2/2\", ends = 11, picks = 9 }}\n\
         cloth = {{ selvedge = true, warp_crimp = 0.4 }}\n\
         warp = {{ yarns = [\"2 a\", \"bé\"], spacing_mm = 0.6 }}\n\
         weft = {{ yarns = [\"a\"], spacing_mm = [0.5, 0.7] }}\n{YARNS}"
    )
}

/// The chart of the tests: a cable, and below it a tuck and a miss.
pub(crate) const STITCHES: [(u32, i32); 12] = [
    (TEXERE_STITCH_KNIT, 0),
    (TEXERE_STITCH_KNIT, 0),
    (TEXERE_STITCH_KNIT, 0),
    (TEXERE_STITCH_KNIT, 0),
    (TEXERE_STITCH_TUCK, 0),
    (TEXERE_STITCH_MISS, 0),
    (TEXERE_STITCH_MOVED, 2),
    (TEXERE_STITCH_MOVED, 2),
    (TEXERE_STITCH_MOVED_BEHIND, -2),
    (TEXERE_STITCH_MOVED_BEHIND, -2),
    (TEXERE_STITCH_KNIT, 0),
    (TEXERE_STITCH_PURL, 0),
];

pub(crate) fn knit_yarns() -> [texere_knit_yarn; 2] {
    let none = texere_knit_yarn {
        diameter_mm: diameter(30.0, 0.9),
        twist: TWIST,
        material: 0,
        section: 0,
        reserved: 0,
    };
    [none, texere_knit_yarn { diameter_mm: 0.25, twist: 0.0, material: 1, section: 1, ..none }]
}

/// Calls `call` with a weft knit of these stitches as arrays, which live as long as the call.
pub(crate) fn with_weft<T>(
    stitches: &[(u32, i32)],
    change: impl FnOnce(&mut texere_weft_knit),
    call: impl FnOnce(&texere_weft_knit) -> T,
) -> T {
    let stitches: Vec<_> = stitches.iter().map(|&(kind, moved)| texere_stitch { kind, moved }).collect();
    let (materials, sections) =
        (materials(), [section(TEXERE_SECTION_CIRCLE), section(TEXERE_SECTION_ELLIPSE)]);
    let (turn, yarns) = ([0, 1, 1], knit_yarns());
    let mut knit = texere_weft_knit {
        beds: 1,
        copies: [2, 1],
        wales: 6,
        courses: 2,
        stitches: stitches.as_ptr(),
        turn: turn.as_ptr(),
        turn_count: 3,
        yarns: yarns.as_ptr(),
        yarn_count: 2,
        wale_mm: 10.0 / 8.0,
        course_mm: 1.0,
        looks: looks(&materials, &sections),
        ..sized()
    };
    change(&mut knit);
    call(&knit)
}

/// Calls `call` with a warp knit of two bars as arrays, which live as long as the call.
pub(crate) fn with_warp<T>(
    change: impl FnOnce(&mut texere_warp_knit, &mut [texere_bar; 2], &mut [texere_lap; 2]),
    call: impl FnOnce(&texere_warp_knit) -> T,
) -> T {
    let lap = |from, to| texere_lap { from, to };
    let (mut front, back) = ([lap(1, 0), lap(2, 3)], [lap(1, 2), lap(1, 0)]);
    let (threading, yarns) = ([0, TEXERE_NO_YARN, 1], knit_yarns());
    let mut bars =
        [(&[][..], 0.0, 0), (&threading[..], 1500.0, 1)].map(|(threading, run_in_mm, offset)| texere_bar {
            laps: null(),
            lap_count: 2,
            threading: threading.as_ptr(),
            guide_count: threading.len() as u64,
            run_in_mm,
            offset,
            reserved: 0,
        });
    bars[1].laps = back.as_ptr();
    let (materials, sections) =
        (materials(), [section(TEXERE_SECTION_CIRCLE), section(TEXERE_SECTION_ELLIPSE)]);
    let mut knit = texere_warp_knit {
        wales: 6,
        courses: 4,
        copies: [1, 2],
        bar_count: 2,
        yarns: yarns.as_ptr(),
        yarn_count: 2,
        wale_mm: 10.0 / 8.0,
        course_mm: 1.0,
        looks: looks(&materials, &sections),
        ..sized()
    };
    change(&mut knit, &mut bars, &mut front);
    bars[0].laps = front.as_ptr();
    knit.bars = bars.as_ptr();
    call(&knit)
}
