//! Colours of yarns in a chart.

use texere_fabric::weft::Knitted;

use crate::write::draft::sheet::{PAPER, Rgb};

/// The colour of a carrier's yarn.
pub(super) fn yarn_color(cloth: &Knitted, carrier: u32) -> Rgb {
    let yarn = cloth.carriers().get(carrier as usize);
    let material = yarn.and_then(|yarn| cloth.materials().get(yarn.material as usize));
    material.map_or(PAPER, |material| material.srgb)
}
