//! Settled knits: against published figures, at their cut edges, and with stitches that charts
//! lack.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test ends at what it did not expect"
)]

mod edges;
mod programs;
mod published;
#[path = "../knits/topology.rs"]
mod topology;

use std::ops::ControlFlow;

use texere_core::settling::Length;
use texere_core::{Material, Section};
use texere_cpu::ParallelBackend;
use texere_fabric::weft::{Gauge, KnitYarn, Knitted, Stitches};
use texere_fabric::{Finish, Piece, Settled, settle};

/// The diameter of all yarns, mm.
const D: f64 = 0.2;

/// A knit of stitches with these distances of wales and courses, in diameters.
fn knitted(stitches: Stitches, wale: f64, course: f64) -> Knitted {
    let (gauge, yarns) = (Gauge::new(wale * D, course * D), vec![KnitYarn::new(D as f32 / 2.0); 2]);
    Knitted::new(stitches, gauge, yarns, vec![Material::default()], vec![Section::Circle], [1, 1]).unwrap()
}

/// A piece at rest, with free lengths.
fn settled(piece: &Piece) -> Settled {
    let finish = Finish { length: Some(Length::Free { tension: 0.0 }), ..Finish::default() };
    let device = ParallelBackend::open().unwrap();
    settle(piece, &finish, &device, |_| ControlFlow::Continue(())).unwrap()
}
