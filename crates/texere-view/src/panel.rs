//! The panel beside the cloth: the cloth's name, choices, and how long a picture takes.

use eframe::egui::{Button, Panel, ProgressBar, ScrollArea, Slider, SliderClamping, Ui};
use texere::Settings;
use texere::mesh::TWIST_SUBDIVISIONS_MAX;

use crate::Event;
use crate::messages::{Cloth, Order};
use crate::orbit::Side;
use crate::window::Window;

impl<T: FnMut(&Event)> Window<T> {
    /// Shows the panel at the left.
    pub(crate) fn panel(&mut self, ui: &mut Ui) {
        Panel::left("choices").resizable(false).default_size(230.0).show(ui, |ui| {
            ScrollArea::vertical().show(ui, |ui| {
                let Some(cloth) = self.cloth.take() else { return };
                ui.heading(&cloth.design.name);
                let yarns = cloth.yarns.layout().yarns().len();
                ui.label(format!("{yarns} yarns, {} triangles", cloth.triangles));
                ui.separator();
                let place = self
                    .place
                    .as_ref()
                    .map_or_else(|| "no yarn under the pointer".into(), ToString::to_string);
                ui.label(place);
                ui.separator();
                let mut side = None;
                ui.horizontal(|ui| {
                    for (name, each) in
                        [("Face (F)", Side::Face), ("Back (B)", Side::Back), ("Oblique (O)", Side::Oblique)]
                    {
                        if ui.button(name).clicked() {
                            side = Some(each);
                        }
                    }
                });
                if let Some(orbit) = self.canvas.orbit_mut() {
                    ui.checkbox(&mut orbit.is_parallel, "Parallel lines of sight");
                }
                ui.weak("Drag: turn. Right or Shift: move. Wheel: nearer.");
                ui.separator();
                self.mesh(ui, &cloth);
                ui.separator();
                self.rest(ui, &cloth);
                self.lifts(ui, &cloth);
                ui.separator();
                self.colors(ui, &cloth);
                ui.separator();
                self.figures(ui);
                self.cloth = Some(cloth);
                if let Some(side) = side {
                    self.look_from(side);
                }
            });
        });
    }

    fn mesh(&self, ui: &mut Ui, cloth: &Cloth) {
        let Settings { mut sides, mut subdivisions, .. } = cloth.settings;
        let mut tension = cloth.yarns.tension();
        // The sides of a polygon are fixed.
        let is_round = cloth.yarns.layout().corners().is_none();
        let changed = [
            ui.add_enabled(
                is_round,
                Slider::new(&mut sides, 3..=32).clamping(SliderClamping::Edits).text("sides"),
            ),
            ui.add(Slider::new(&mut subdivisions, 0..=TWIST_SUBDIVISIONS_MAX).text("subdivisions")),
        ];
        if changed.iter().any(|slider| slider.changed()) {
            self.order(Order::Settings(Settings { sides, subdivisions, ..cloth.settings }));
        }
        if ui.add(Slider::new(&mut tension, 0.0..=0.95).text("tension")).changed() {
            self.order(Order::Tension(tension));
        }
        if let Some(undersampled) = cloth.undersampled {
            ui.label(undersampled.to_string());
        }
    }

    fn rest(&self, ui: &mut Ui, cloth: &Cloth) {
        let mut settles = cloth.is_settled || self.settling.is_some();
        if ui.checkbox(&mut settles, "Let yarns come to rest").changed() {
            self.order(Order::Settle(settles));
        }
        if let Some(share) = self.settling {
            ui.add(ProgressBar::new(share as f32).text("settling"));
        }
        if let Some(said) = self.said.as_deref().filter(|said| !said.is_empty()) {
            ui.label(said);
        }
        cloth.apart.iter().for_each(|said| {
            ui.label(said);
        });
    }

    fn lifts(&mut self, ui: &mut Ui, cloth: &Cloth) {
        if cloth.design.structure.woven().is_none() {
            return;
        }
        ui.separator();
        ui.checkbox(&mut self.lifts, "A click changes a lift (L)");
        ui.horizontal_wrapped(|ui| {
            if ui.add_enabled(cloth.is_edited, Button::new("Undo (Ctrl+Z)")).clicked() {
                self.order(Order::Undo);
            }
            if ui.button("Save a copy (Ctrl+S)").on_hover_text("as a design file beside the design").clicked()
            {
                self.order(Order::Save);
            }
        });
    }

    fn colors(&self, ui: &mut Ui, cloth: &Cloth) {
        for (number, material) in cloth.yarns.materials().iter().enumerate() {
            let mut srgb = material.srgb;
            ui.horizontal(|ui| {
                if ui.color_edit_button_srgb(&mut srgb).changed() {
                    self.order(Order::Color { material: number, srgb });
                }
                ui.label(if material.name.is_empty() { "yarn" } else { &material.name });
            });
        }
    }

    fn figures(&self, ui: &mut Ui) {
        let (timings, ([width, height], samples)) = (self.canvas.timings, self.canvas.resolution());
        let milliseconds = |time: std::time::Duration| time.as_secs_f64() * 1e3;
        ui.label(format!("{width} × {height} pixels, {samples} samples each"));
        let (draw, light) = (milliseconds(timings.draw), milliseconds(timings.shade));
        ui.label(format!("drawn in {draw:.1} ms, lit in {light:.1} ms"));
        if let Some(failure) = &self.canvas.failure {
            ui.label(failure);
        }
    }
}
