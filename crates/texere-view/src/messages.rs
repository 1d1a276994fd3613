//! Messages between the window and the workshop, the thread that makes cloth. The window sends
//! orders, and the workshop sends cloth and news.

use std::sync::{Arc, Mutex};

use texere::mesh::Undersampled;
use texere::picture::{Extent, Scene};
use texere::{Design, Settings, Yarns};

use crate::Event;

/// A request of the window to the workshop.
#[derive(Debug)]
pub(crate) enum Order {
    /// Sets whether the warp is up at a crossing. `end` and `pick` are counted from 0.
    Lift { end: usize, pick: usize, up: bool },
    /// Takes back the last lift.
    Undo,
    /// Gives a material another sRGB colour. `material` is its number, counted from 0.
    Color { material: usize, srgb: [u8; 3] },
    /// Draws with other settings.
    Settings(Settings),
    /// Gives the yarns' splines another tension.
    Tension(f32),
    /// Sets whether yarns settle.
    Settle(bool),
    /// Saves a copy of the design as it is now.
    Save,
}

/// A cloth on the device, and what it is made from.
#[derive(Debug)]
pub(crate) struct Cloth {
    pub(crate) design: Arc<Design>,
    pub(crate) yarns: Arc<Yarns>,
    pub(crate) settings: Settings,
    /// The scene on the device. It is locked while a picture is made.
    pub(crate) scene: Arc<Mutex<Scene>>,
    pub(crate) extent: Extent,
    pub(crate) triangles: u64,
    /// Whether its yarns have settled.
    pub(crate) is_settled: bool,
    /// Whether lifts can be taken back.
    pub(crate) is_edited: bool,
    /// Warnings that the cloth does not hang together.
    pub(crate) apart: Vec<String>,
    /// The twist that the mesh does not show, if any.
    pub(crate) undersampled: Option<Undersampled>,
}

/// What the workshop reports to the window.
#[derive(Debug)]
pub(crate) enum News {
    Cloth(Box<Cloth>),
    /// Yarns are settling, and this share of the work is done.
    Settling(f64),
    /// Settling has ended. The text says how. It is empty if settling was stopped for an order or
    /// for a changed file.
    Settled(String),
    Event(Event),
}
