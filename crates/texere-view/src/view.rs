//! What a window is asked to show.

use std::path::PathBuf;

use texere::yarn::Section;
use texere::{Design, Settings};

use crate::ViewError;

/// What a window shows.
#[derive(Debug, Clone)]
pub struct View {
    /// A .toml design, a .wif draft, or a .k program of a knitting machine.
    pub design: PathBuf,
    /// The device that draws, as [`texere::picture::open_renderer`] takes it, and on which yarns
    /// settle.
    pub device: String,
    /// Frames of the mesh; its sides and subdivisions count only in `sides` and `subdivisions`.
    pub settings: Settings,
    /// Tension of the yarns' splines, from 0 to below 1.
    pub tension: f32,
    /// Sides of the tubes; if none as many as [`texere::picture::picture_sides`] says.
    pub sides: Option<u32>,
    /// Points inserted between two control points; if none as many as
    /// [`Settings::following_fibres`] says.
    pub subdivisions: Option<u32>,
    /// One section for all yarns of the design.
    pub section: Option<Section>,
    /// Whether yarns settle; if none, what the design says.
    pub settle: Option<bool>,
    /// The window's width and height at first, in points: pixels, where the screen's scale is one.
    pub size: [u32; 2],
}

impl View {
    /// A window of a design as it comes.
    pub fn of(design: impl Into<PathBuf>) -> Self {
        Self {
            design: design.into(),
            device: "auto".into(),
            settings: Settings::default(),
            tension: 0.0,
            sides: None,
            subdivisions: None,
            section: None,
            settle: None,
            size: [1280, 800],
        }
    }

    /// Reads the design.
    pub(crate) fn read(&self) -> Result<Design, ViewError> {
        let mut design = texere::read(&self.design)?;
        if let Some(section) = &self.section {
            design.structure.set_section(section.clone()).map_err(|error| design.refused(error))?;
        }
        Ok(design)
    }
}
