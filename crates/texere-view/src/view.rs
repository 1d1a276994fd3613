//! What a window is asked to show.

use std::path::PathBuf;

use texere::yarn::Section;
use texere::{Design, Settings};

use crate::ViewError;

/// What a window shows.
#[derive(Debug, Clone)]
pub struct View {
    /// A .toml design, a draft (.wif, .dtx, .wpo), or a .k program of a knitting machine.
    pub design: PathBuf,
    /// The device that draws, as [`texere::picture::open_renderer`] takes it, and on which yarns
    /// settle.
    pub device: String,
    /// Settings of the mesh, such as its frame. Its `sides` and `subdivisions` are replaced by the
    /// fields of these names below.
    pub settings: Settings,
    /// Tension of the yarns' splines, from 0 to below 1.
    pub tension: f32,
    /// Number of sides of the tubes. If none, that of [`texere::picture::picture_sides`].
    pub sides: Option<u32>,
    /// Number of points inserted between two control points. If none, that of
    /// [`Settings::following_fibres`].
    pub subdivisions: Option<u32>,
    /// One section for all yarns of the design.
    pub section: Option<Section>,
    /// Whether yarns settle. If none, the design decides.
    pub settle: Option<bool>,
    /// The window's first width and height, in points. A point is a pixel if the screen's scale is
    /// 1.
    pub size: [u32; 2],
}

impl View {
    /// A view of `design` with everything else at its default.
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
