//! The part of the window that shows the cloth.

use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::sync::{PoisonError, TryLockError};
use std::thread;
use std::time::{Duration, Instant};

use eframe::egui::{
    Color32, ColorImage, PointerButton, Pos2, Rect, Response, Sense, TextureHandle, TextureId,
    TextureOptions, Ui, pos2,
};
use eframe::{egui_wgpu, wgpu};
use texere::picture::{DevicePicture, Picture, PictureTimings, Quality, RenderError, Seen};
use texere::read::NamedPlace;
use texere::yarn::YarnPlace;

use crate::messages::Cloth;
use crate::orbit::{Orbit, Side};

/// How long the view must rest before the finest picture is drawn.
const REST: Duration = Duration::from_millis(200);

/// The time that a picture may take while the view moves. If a picture took longer, the next one
/// has fewer pixels. If it took less than a sixth of that time, the next one has more.
const MOVING: Duration = Duration::from_millis(60);

/// The time that a picture may take when the view rests. If the finest picture would take longer, a
/// picture with fewer samples is drawn.
const RESTING: Duration = Duration::from_secs(1);

/// The most pixels of the window, across and down, for one pixel of the picture.
const COARSEST: u32 = 4;

/// The logarithm of the factor by which one point of scrolling brings the eye nearer.
const NEARER: f32 = 0.0025;

/// The view that a picture shows.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Look {
    orbit: Orbit,
    /// The size of the window's part for the cloth, pixels.
    size: [u32; 2],
}

/// How many pixels and samples a picture has, and whether it has fibres that stand off yarns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Fineness {
    supersampling: u32,
    /// Number of pixels of the window, across and down, for one pixel of the picture.
    coarseness: u32,
    hairs: bool,
}

impl Fineness {
    /// The fastest picture with all pixels.
    const PLAIN: Self = Self { supersampling: 1, coarseness: 1, hairs: false };

    /// The fineness of the next picture while the view moves. The last picture had the fineness
    /// `self`, and was made in the time `took`.
    fn moving(self, took: Duration) -> Self {
        let coarseness = match self.coarseness {
            finer if took > MOVING => (finer * 2).min(COARSEST),
            coarser if took < MOVING / 6 => (coarser / 2).max(1),
            same => same,
        };
        Self { coarseness, ..Self::PLAIN }
    }

    /// The fineness of a picture when the view rests. The last picture had the fineness `self`, and
    /// was made in the time `took`.
    fn resting(self, took: Duration) -> Self {
        let best = Quality::default().supersampling;
        let more = best * self.coarseness / self.supersampling;
        let supersampling = if took * more.pow(2) <= RESTING { best } else { Self::PLAIN.supersampling };
        Self { supersampling, hairs: true, ..Self::PLAIN }
    }
}

/// A picture that is made.
enum Made {
    /// The picture is on the window's device.
    There(DevicePicture),
    /// The picture was made on another device, and was copied from there.
    Copied(Picture),
}

/// What the window shows.
enum Shown {
    /// A texture of the scene. A picture of another size has another texture.
    There(TextureId, wgpu::TextureView),
    Copied(TextureHandle),
}

/// The picture in the window.
pub(crate) struct Canvas {
    render: egui_wgpu::RenderState,
    /// Whether cloth is on another device than the window.
    is_apart: bool,
    /// The eye. None until a cloth has been shown.
    orbit: Option<Orbit>,
    shown: Option<Shown>,
    /// The look of the last picture, or of the one that is under way.
    drawn: Option<Look>,
    /// The picture that is under way. A thread of its own waits for the device, so that the window
    /// can be closed meanwhile.
    under_way: Option<Receiver<Result<Made, RenderError>>>,
    /// The fineness of the last picture.
    fineness: Fineness,
    /// The fineness of the last picture that was drawn while the view moved.
    fineness_moving: Fineness,
    /// Whether the last picture is the finest one of its view.
    rests: bool,
    /// The time since which the view rests.
    rests_since: Instant,
    pub(crate) timings: PictureTimings,
    /// The failure of the last picture.
    pub(crate) failure: Option<String>,
    /// The last place of the pointer that was looked up, and the place on a yarn that was found
    /// there.
    pointed: Option<(Pos2, Option<NamedPlace>)>,
    /// The place of a click that waits for the picture under way.
    clicked: Option<Pos2>,
}

/// The places on yarns under the pointer.
pub(crate) struct Pointed {
    /// The place on a yarn under the pointer, if there is one.
    pub(crate) place: Option<NamedPlace>,
    /// The place on a yarn that was clicked on, if one was.
    pub(crate) clicked: Option<NamedPlace>,
}

impl Canvas {
    pub(crate) fn new(render: egui_wgpu::RenderState, is_apart: bool) -> Self {
        Self {
            render,
            is_apart,
            orbit: None,
            shown: None,
            drawn: None,
            under_way: None,
            fineness: Fineness::PLAIN,
            fineness_moving: Fineness::PLAIN,
            rests: true,
            rests_since: Instant::now(),
            timings: PictureTimings::default(),
            failure: None,
            pointed: None,
            clicked: None,
        }
    }

    /// Shows the whole cloth from `side` in the next picture.
    pub(crate) fn look_from(&mut self, cloth: &Cloth, side: Side) {
        let size = self.drawn.map_or([4, 3], |drawn| drawn.size);
        self.orbit = Some(Orbit::whole(&cloth.extent, side, size));
    }

    /// Makes the next picture anew, because the cloth is another one. The view stays.
    pub(crate) fn redraw(&mut self) {
        self.drawn = None;
        self.under_way = None;
        self.pointed = None;
    }

    /// The eye, or none before a cloth has been shown.
    pub(crate) const fn orbit_mut(&mut self) -> Option<&mut Orbit> {
        self.orbit.as_mut()
    }

    /// Width and height of the last picture in pixels, and the number of samples of each pixel.
    pub(crate) fn resolution(&self) -> ([u32; 2], u32) {
        let Fineness { supersampling, coarseness, .. } = self.fineness;
        let size = self.drawn.map_or([0, 0], |drawn| drawn.size.map(|pixels| pixels / coarseness));
        (size, 4 * supersampling.pow(2))
    }

    /// Shows the cloth in the rest of the window, and lets a pointer move it.
    pub(crate) fn show(&mut self, ui: &mut Ui, cloth: &Cloth) -> Pointed {
        let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        let scale = ui.pixels_per_point();
        let size = [rect.width(), rect.height()].map(|points| ((points * scale) as u32).max(1));
        let orbit = self.orbit.get_or_insert_with(|| Orbit::whole(&cloth.extent, Side::Face, size));
        steer(orbit, ui, &response, rect, size, cloth);
        let look = Look { orbit: *orbit, size };
        self.draw(ui, cloth, look);
        if let Some(shown) = &self.shown {
            let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            let texture = match shown {
                Shown::There(texture, _) => *texture,
                Shown::Copied(texture) => texture.id(),
            };
            ui.painter().image(texture, rect, whole, Color32::WHITE);
        }
        let at = response.hover_pos().filter(|_| !response.dragged());
        let place = at.and_then(|at| self.named(cloth, at, rect, scale));
        if response.clicked() {
            self.clicked = response.interact_pointer_pos();
        }
        let clicked = self.clicked.take_if(|_| self.under_way.is_none());
        Pointed { place, clicked: clicked.and_then(|at| self.named(cloth, at, rect, scale)) }
    }

    /// Draws the cloth if the last picture shows another view or could be finer.
    fn draw(&mut self, ui: &Ui, cloth: &Cloth, look: Look) {
        if self.is_under_way(ui) {
            return;
        }
        let took = self.timings.draw + self.timings.shade;
        if self.drawn != Some(look) {
            // The time of a picture at rest does not predict the time of a picture while the view
            // moves.
            self.fineness = if self.rests { self.fineness_moving } else { self.fineness.moving(took) };
            self.fineness_moving = self.fineness;
            (self.rests, self.rests_since) = (false, Instant::now());
        } else if self.rests {
            return;
        } else if let Some(rest) = REST.checked_sub(self.rests_since.elapsed()) {
            ui.request_repaint_after(rest);
            return;
        } else {
            self.rests = true;
            let finest = self.fineness.resting(took);
            if finest == self.fineness {
                return;
            }
            self.fineness = finest;
        }
        self.drawn = Some(look);
        if let Err(error) = self.begin(ui, cloth, look) {
            self.failure = Some(error);
        }
    }

    /// Starts a thread that makes the picture and asks the window to show it.
    fn begin(&mut self, ui: &Ui, cloth: &Cloth, look: Look) -> Result<(), String> {
        let Fineness { supersampling, coarseness, hairs } = self.fineness;
        let size = look.size.map(|pixels| (pixels / coarseness).max(1));
        let camera = look.orbit.camera(&cloth.extent, size).map_err(|error| crate::error::said(&error))?;
        let (scene, window, is_apart) = (cloth.scene.clone(), ui.ctx().clone(), self.is_apart);
        let (done, picture) = channel();
        let draw = move || {
            let mut scene = scene.lock().unwrap_or_else(PoisonError::into_inner);
            let quality = Quality { supersampling, hairs };
            let picture = if is_apart {
                scene.picture(&camera, quality).map(Made::Copied)
            } else {
                scene.frame(&camera, quality).map(Made::There)
            };
            drop(scene);
            // The receiver is gone if another cloth came meanwhile.
            let _ = done.send(picture);
            window.request_repaint();
        };
        thread::Builder::new()
            .name("picture".into())
            .spawn(draw)
            .map_err(|error| crate::error::said(&error))?;
        self.under_way = Some(picture);
        Ok(())
    }

    /// Whether a picture is under way. A picture that is done is shown first.
    fn is_under_way(&mut self, ui: &Ui) -> bool {
        let Some(picture) = &self.under_way else { return false };
        let done = match picture.try_recv() {
            Ok(done) => done.map_err(|error| crate::error::said(&error)),
            Err(TryRecvError::Empty) => return true,
            Err(TryRecvError::Disconnected) => Err("the picture was not made".into()),
        };
        (self.under_way, self.pointed) = (None, None);
        match done {
            Ok(picture) => self.take(ui, picture),
            Err(error) => self.failure = Some(error),
        }
        false
    }

    /// Shows a picture that is done.
    fn take(&mut self, ui: &Ui, made: Made) {
        self.failure = None;
        match made {
            Made::There(DevicePicture { texture, timings }) => {
                self.timings = timings;
                let (device, filter) = (&self.render.device, wgpu::FilterMode::Linear);
                let mut renderer = self.render.renderer.write();
                let id = match &self.shown {
                    Some(Shown::There(_, shown)) if *shown == texture => return,
                    Some(Shown::There(id, _)) => {
                        renderer.update_egui_texture_from_wgpu_texture(device, &texture, filter, *id);
                        *id
                    }
                    _ => renderer.register_native_texture(device, &texture, filter),
                };
                self.shown = Some(Shown::There(id, texture));
            }
            Made::Copied(Picture { size, rgb, timings, .. }) => {
                self.timings = timings;
                let image = ColorImage::from_rgb(size.map(|pixels| pixels as usize), &rgb);
                match &mut self.shown {
                    Some(Shown::Copied(texture)) => texture.set(image, TextureOptions::LINEAR),
                    _ => {
                        let texture = ui.ctx().load_texture("cloth", image, TextureOptions::LINEAR);
                        self.shown = Some(Shown::Copied(texture));
                    }
                }
            }
        }
    }

    /// The place on a yarn under the pointer, in a designer's words.
    fn named(&mut self, cloth: &Cloth, at: Pos2, rect: Rect, scale: f32) -> Option<NamedPlace> {
        if let Some((before, place)) = &self.pointed
            && *before == at
        {
            return place.clone();
        }
        let scene = match cloth.scene.try_lock() {
            Ok(scene) => scene,
            Err(TryLockError::Poisoned(scene)) => scene.into_inner(),
            // While a picture is under way the last answer stays.
            Err(TryLockError::WouldBlock) => {
                return self.pointed.as_ref().and_then(|(_, place)| place.clone());
            }
        };
        let pixel = (at - rect.min) * (scale / self.fineness.coarseness as f32);
        let place = match scene.seen_at([pixel.x, pixel.y]) {
            Ok(seen) => seen.and_then(|seen| place_of(cloth, &seen)),
            Err(error) => {
                self.failure = Some(crate::error::said(&error));
                None
            }
        };
        self.pointed = Some((at, place.clone()));
        place
    }
}

/// Turns, moves and zooms the cloth by the pointer.
fn steer(orbit: &mut Orbit, ui: &Ui, response: &Response, rect: Rect, size: [u32; 2], cloth: &Cloth) {
    let scale = ui.pixels_per_point();
    let drag = response.drag_delta() * scale;
    let pans = response.dragged_by(PointerButton::Secondary)
        || response.dragged_by(PointerButton::Middle)
        || ui.input(|input| input.modifiers.shift);
    if response.dragged() && pans {
        orbit.pan([drag.x, drag.y], size);
    } else if response.dragged() {
        orbit.turn([drag.x, drag.y]);
    }
    if let Some(at) = response.hover_pos() {
        let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta.y, input.zoom_delta()));
        let factor = pinch * (scroll * NEARER).exp();
        if factor != 1.0 {
            let at = (at - rect.min) * scale;
            orbit.zoom(factor, [at.x, at.y], size, &cloth.extent);
        }
    }
}

fn place_of(cloth: &Cloth, seen: &Seen) -> Option<NamedPlace> {
    let place = YarnPlace::nearest(&cloth.yarns, seen.yarn, seen.position)?;
    Some(cloth.design.named(&cloth.yarns, &place))
}

#[cfg(test)]
mod tests {
    use super::*;

    const MILLISECOND: Duration = Duration::from_millis(1);

    /// The time of a picture on a device that takes `whole` for all pixels with four samples each.
    fn took(fineness: Fineness, whole: Duration) -> Duration {
        whole * fineness.supersampling.pow(2) / fineness.coarseness.pow(2)
    }

    #[test]
    fn a_view_that_moves_is_drawn_in_time_and_as_fine_as_that_allows() {
        for (whole, coarseness) in [(5, 1), (50, 1), (100, 2), (200, 2), (900, 4), (5000, 4)] {
            let whole = whole * MILLISECOND;
            let mut fineness = Fineness::PLAIN;
            for _ in 0..9 {
                fineness = fineness.moving(took(fineness, whole));
            }
            assert_eq!(fineness, Fineness { coarseness, ..Fineness::PLAIN }, "{whole:?}");
        }
    }

    #[test]
    fn a_view_at_rest_has_all_pixels_and_all_samples_where_they_come_in_time() {
        for coarseness in [1, 2, 4] {
            let moved = Fineness { coarseness, ..Fineness::PLAIN };
            for (whole, supersampling) in [(10, 2), (240, 2), (300, 1), (9000, 1)] {
                let rests = moved.resting(took(moved, whole * MILLISECOND));
                assert_eq!(rests, Fineness { supersampling, coarseness: 1, hairs: true }, "{whole} ms");
            }
        }
    }
}
