//! A knitout file that is a design of its own.

use std::path::Path;

use texere_core::{Material, Section};
use texere_fabric::Thread;
use texere_fabric::weft::{Cells, Gauge};

use super::knitout_file;
use super::loop_lengths::LoopLengths;
use crate::read::file::{Files, file_name};
use crate::read::knit::Knit;
use crate::read::knitted_from::Drawn;
use crate::read::{Design, ReadError};

/// The number of needles to the inch if the file does not give it.
const GAUGE: f64 = 15.0;

/// The width of a wale of plain jersey, in yarn diameters. The yarns' diameters are worked out from
/// the width of the wales, because a knitout file does not say how thick its yarns are.
const WALE_OF_DIAMETER: f64 = 5.0;

/// Colours of the carriers, since a file has none that can be drawn. They are easy to distinguish,
/// and none is too dark to show a yarn's shape.
const COLORS: [[u8; 3]; 8] = [
    [0xd9, 0xcf, 0xb8],
    [0x9c, 0x3b, 0x2e],
    [0x3d, 0x5a, 0x80],
    [0x5b, 0x8c, 0x5a],
    [0xc9, 0x8b, 0x2b],
    [0x7a, 0x5a, 0x8a],
    [0x4b, 0x9a, 0x9a],
    [0x8a, 0x8a, 0x8a],
];

/// The design of a knitout file alone. It has the proportions of plain jersey, and a colour for
/// each carrier.
pub(crate) fn design(path: &Path, files: &Files<'_>) -> Result<Design, ReadError> {
    let read = knitout_file::read(path, files, &LoopLengths::new())?;
    let gauge = gauge(read.gauge);
    let (threads, materials) = of_carriers(&read.program.carriers, &read.yarns, gauge);
    let (yarns, materials, sections) = Knit::yarns_of(threads, 1.0, &materials, &[Section::Circle]);
    let knit =
        Knit { gauge, yarns, materials, sections, copies: [1, 1], cells: Cells::Round, float_max: None };
    let drawn = Drawn::Lines { file: path.into(), head: read.head };
    let design = knit.design(path, file_name(path), read.program, drawn, read.warnings);
    Ok(read.keys.placed(design)?.keyed(read.keys))
}

/// The gauge of a file alone. `needles` is the number of needles to the inch, if the file gives it.
pub(crate) fn gauge(needles: Option<f64>) -> Gauge {
    Gauge::plain(needles.unwrap_or(GAUGE))
}

/// The thread of each carrier of a file alone, and its material. `yarns` has the text of the header
/// about the yarn in each carrier.
pub(crate) fn of_carriers(
    carriers: &[String],
    yarns: &[Option<String>],
    gauge: Gauge,
) -> (Vec<Thread>, Vec<Material>) {
    let material = |((carrier, yarn), &srgb): ((&String, &Option<String>), _)| {
        let name = yarn.as_ref().map_or_else(|| carrier.clone(), |yarn| format!("{carrier}: {yarn}"));
        Material { name, srgb, ..Material::default() }
    };
    let materials: Vec<_> = carriers.iter().zip(yarns).zip(COLORS.iter().cycle()).map(material).collect();
    let radius_mm = (gauge.wale_mm / WALE_OF_DIAMETER / 2.0) as f32;
    let thread = |material| Thread { material, ..Thread::new(0.0, radius_mm) };
    ((0..materials.len() as u32).map(thread).collect(), materials)
}
