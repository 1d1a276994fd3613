//! Pictures made with the crate `texere`: a renderer and the scene that it shows.

use std::ops::ControlFlow;

use texere::picture::{Background, Camera, Cut, Pose, Quality, RenderError, Renderer, Scene, picture_sides};
use texere::yarn::Origin;
use texere::{Settings, Yarns};

use crate::failure::Failure;
use crate::picture::*;
use crate::structure::choice;

/// A renderer, and the yarns that it shows.
#[derive(Debug)]
pub(crate) struct Drawing {
    renderer: Renderer,
    scene: Option<Scene>,
}

impl Drawing {
    pub(crate) fn open(name: &str) -> Result<Self, Failure> {
        Ok(Self { renderer: texere::picture::open_renderer(name)?, scene: None })
    }

    /// Shows `yarns` from now on, meshed with `settings`. `None` stands for settings that suit a
    /// picture.
    pub(crate) fn show(
        &mut self,
        yarns: &Yarns,
        settings: Option<Settings>,
        mut progress: impl FnMut(f64) -> ControlFlow<()>,
    ) -> Result<(), Failure> {
        // The previous scene is dropped first, because the new one may need its memory.
        self.scene = None;
        if progress(0.0).is_break() {
            return Err(RenderError::Cancelled.into());
        }
        let settings = settings.unwrap_or_else(|| usual(yarns));
        self.scene = Some(self.renderer.scene_with_progress(yarns, &settings, progress)?);
        Ok(())
    }

    pub(crate) fn extent(&self) -> Result<texere_extent, Failure> {
        let extent = self.scene.as_ref().ok_or_else(nothing_shown)?.extent();
        Ok(texere_extent { low: extent.low, high: extent.high })
    }

    pub(crate) fn picture(
        &mut self,
        asked: &texere_picture,
        progress: impl FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Pixels, Failure> {
        let scene = self.scene.as_mut().ok_or_else(nothing_shown)?;
        let camera = asked.camera(scene)?;
        let backgrounds = [Background::Ground, Background::Color(asked.color), Background::Nothing];
        scene.set_background(choice("picture.background", asked.background, &backgrounds)?);
        let hairs = choice("picture.hairs", asked.hairs, &[false, true])?;
        let quality = Quality { supersampling: asked.supersampling, hairs };
        let picture = scene.picture_with_progress(&camera, quality, progress)?;
        Ok(Pixels { size: picture.size, rgb: picture.rgb, alpha: picture.alpha })
    }

    pub(crate) fn seen(&self, at: [f32; 2]) -> Result<Option<(usize, [f64; 3])>, Failure> {
        let scene = self.scene.as_ref().ok_or_else(nothing_shown)?;
        Ok(scene.seen_at(at)?.map(|seen| (seen.yarn, seen.position)))
    }
}

fn nothing_shown() -> Failure {
    Failure::argument("the renderer shows no yarns: texere_renderer_show gives it some")
}

/// The usual settings for a picture of `yarns`. Threads of woven cloth lie so close together that
/// they get more sides: with few, the ground would show past their corners.
fn usual(yarns: &Yarns) -> Settings {
    let origins = || yarns.layout().yarns().iter().map(|yarn| yarn.origin);
    let is_woven = origins().any(|origin| matches!(origin, Origin::End(_)))
        && origins().any(|origin| matches!(origin, Origin::Pick(_)));
    Settings { sides: picture_sides(yarns, is_woven), ..Settings::default() }.following_fibres(yarns)
}

impl texere_picture {
    fn camera(&self, scene: &Scene) -> Result<Camera, Failure> {
        let (extent, size) = (scene.extent(), [self.width, self.height]);
        let (at, width) = (self.at, self.width_mm);
        let pose = Pose { eye: self.eye, target: self.target, up: self.up };
        let camera = match self.view {
            TEXERE_VIEW_FACE => Camera::face(extent, size),
            TEXERE_VIEW_OBLIQUE => Camera::oblique(extent, self.turn, size)?,
            TEXERE_VIEW_CLOSE_UP => Camera::close_up(extent, at, width, size)?,
            TEXERE_VIEW_CUT_WARP => Camera::cut(extent, Cut::Warp, at, width, size)?,
            TEXERE_VIEW_CUT_WEFT => Camera::cut(extent, Cut::Weft, at, width, size)?,
            TEXERE_VIEW_EYE => Camera::perspective(extent, &pose, self.field_of_view, size)?,
            TEXERE_VIEW_PARALLEL => Camera::orthographic(extent, &pose, self.height_mm, size)?,
            other => return Err(Failure::argument(format!("picture.view is {other}, expected 0 to 6"))),
        };
        let over = choice("picture.turned_over", self.turned_over, &[false, true])?;
        Ok(if over { camera.turned_over() } else { camera })
    }
}
