//! The window: what it shows, and what it sends to the workshop.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use eframe::egui::{self, Key, Modifiers, ViewportBuilder};
use eframe::wgpu;
use texere::backend::Schedule;
use texere::gpu::WgpuBackend;
use texere::picture::Renderer;
use texere::read::NamedPlace;

use crate::canvas::{Canvas, Pointed};
use crate::messages::{Cloth, News, Order};
use crate::orbit::Side;
use crate::watch::Watch;
use crate::workshop::Workshop;
use crate::{Event, View, ViewError, device};

/// The time after which a picture that the device refused is tried again.
const AGAIN: Duration = Duration::from_millis(50);

/// How long a window that closes waits for the workshop. A device can't be dropped while the
/// workshop uses it.
const LEAVING: Duration = Duration::from_millis(500);

impl View {
    /// Opens the window and waits until it is closed. `tell` is called for each event of the
    /// window.
    ///
    /// ```no_run
    /// texere_view::View::of("designs/herringbone.wif").open(|event| println!("{event}"))?;
    /// # Ok::<(), texere_view::ViewError>(())
    /// ```
    ///
    /// Call this on the program's main thread, because some systems let no other thread open
    /// windows.
    ///
    /// **Errors**: [`ViewError`].
    pub fn open(self, tell: impl FnMut(&Event)) -> Result<(), ViewError> {
        let mut watch = Watch::new([self.design.clone()]);
        let design = self.read()?;
        watch.follow(design.files().iter().cloned());
        // eframe does not say why a wrong name fails, so the name is checked first.
        texere::picture::picture_device(&self.device, &WgpuBackend::devices()?)?;
        let options = eframe::NativeOptions {
            viewport: ViewportBuilder::default()
                .with_title(format!("{} - texere", design.name))
                .with_inner_size(self.size.map(|points| points as f32)),
            renderer: eframe::Renderer::Wgpu,
            wgpu_options: device::configuration(self.device.clone()),
            ..Default::default()
        };
        let start = |context: &eframe::CreationContext<'_>| -> Result<Box<dyn eframe::App>, _> {
            let render = context.wgpu_render_state.clone().ok_or("no device")?;
            // A device does its work in order. If the device is a CPU, a cloth takes it seconds, in
            // which the window would wait and could not be closed. In that case the cloth has a
            // device of its own, from which pictures are copied in negligible time.
            let is_apart = render.adapter.get_info().device_type == wgpu::DeviceType::Cpu;
            let renderer = if is_apart {
                texere::picture::open_renderer(&self.device)?
            } else {
                let (device, queue) = (render.device.clone(), render.queue.clone());
                Renderer::new(WgpuBackend::from_device(device, queue, Schedule::PerRing)?)?
            };
            // The surface can't be resized while the workshop gives the device work, and drawing at
            // the new size then fails on the old surface. texere's own calls are in error scopes,
            // so only that failure comes here. The next picture tries again.
            let window = context.egui_ctx.clone();
            render.device.on_uncaptured_error(Arc::new(move |_| window.request_repaint_after(AGAIN)));
            let ((orders, taken), (news, told)) = (channel(), channel());
            let is_closing = Arc::new(AtomicBool::new(false));
            let workshop = Workshop {
                orders: taken,
                is_closing: is_closing.clone(),
                news,
                window: context.egui_ctx.clone(),
                renderer,
                view: self,
                watch,
                design,
                colors: BTreeMap::new(),
                lifts: Vec::new(),
                settler: None,
                yarns: None,
            };
            let workshop = thread::Builder::new().name("workshop".into()).spawn(|| workshop.run())?;
            Ok(Box::new(Window {
                canvas: Canvas::new(render, is_apart),
                orders,
                is_closing,
                workshop,
                news: told,
                cloth: None,
                settling: None,
                said: None,
                lifts: false,
                place: None,
                tell,
            }))
        };
        eframe::run_native("texere", options, Box::new(start))
            .map_err(|error| ViewError::Window(error.into()))
    }
}

/// All that the window shows.
pub(crate) struct Window<T> {
    pub(crate) canvas: Canvas,
    orders: Sender<Order>,
    /// Whether the window is being closed. The workshop reads it while it works.
    is_closing: Arc<AtomicBool>,
    workshop: JoinHandle<()>,
    news: Receiver<News>,
    /// The cloth that is shown. None until the first cloth is made.
    pub(crate) cloth: Option<Box<Cloth>>,
    /// The share of the work that is done, while yarns settle.
    pub(crate) settling: Option<f64>,
    /// The result of settling, or the last failure.
    pub(crate) said: Option<String>,
    /// Whether a click changes a lift.
    pub(crate) lifts: bool,
    /// The place on a yarn under the pointer, if there is one.
    pub(crate) place: Option<NamedPlace>,
    tell: T,
}

impl<T: FnMut(&Event)> eframe::App for Window<T> {
    fn logic(&mut self, window: &egui::Context, _: &mut eframe::Frame) {
        let is_closed = window.input(|input| input.viewport().close_requested());
        if is_closed && !self.is_closing.swap(true, Ordering::Relaxed) {
            (self.tell)(&Event::Closed);
        }
    }

    fn ui(&mut self, ui: &mut egui::Ui, _: &mut eframe::Frame) {
        if self.is_closing.load(Ordering::Relaxed) {
            // No further picture would be seen.
            return;
        }
        while let Ok(news) = self.news.try_recv() {
            self.take(news);
        }
        self.keys(ui);
        self.panel(ui);
        egui::CentralPanel::default().frame(egui::Frame::NONE).show(ui, |ui| {
            let Some(cloth) = &self.cloth else {
                // The label does not move. A spinner would be drawn again and again, and each
                // drawing would wait for the workshop's work on the device.
                ui.centered_and_justified(|ui| ui.label("The cloth is being made."));
                return;
            };
            let Pointed { place, clicked } = self.canvas.show(ui, cloth);
            self.place = place;
            if let Some(place) = clicked {
                self.click(&place);
            }
        });
    }

    fn on_exit(&mut self) {
        self.is_closing.store(true, Ordering::Relaxed);
        let start = Instant::now();
        while !self.workshop.is_finished() && start.elapsed() < LEAVING {
            thread::sleep(Duration::from_millis(5));
        }
    }
}

impl<T: FnMut(&Event)> Window<T> {
    pub(crate) fn order(&self, order: Order) {
        // The workshop lives as long as the window.
        let _ = self.orders.send(order);
    }

    fn take(&mut self, news: News) {
        match news {
            News::Cloth(cloth) => {
                let event = Event::Shown {
                    name: cloth.design.name.clone(),
                    yarns: cloth.yarns.layout().yarns().len(),
                    triangles: cloth.triangles,
                    settled: cloth.is_settled,
                };
                self.cloth = Some(cloth);
                self.canvas.redraw();
                self.said = None;
                (self.tell)(&event);
            }
            News::Settling(share) => self.settling = Some(share),
            News::Settled(said) => {
                self.settling = None;
                self.said = Some(said);
            }
            News::Event(event) => {
                if let Event::Failed(what) = &event {
                    self.said = Some(what.clone());
                }
                (self.tell)(&event);
            }
        }
    }

    /// Reports a click on a place of a yarn, and changes the lift there if clicks change lifts.
    fn click(&mut self, place: &NamedPlace) {
        let Some(cloth) = &self.cloth else { return };
        (self.tell)(&Event::Picked(place.clone()));
        let (Some(crossing), Some(woven)) = (place.thread.crossing, cloth.design.structure.woven()) else {
            return;
        };
        if self.lifts {
            let (end, pick) = (crossing.end as usize - 1, crossing.pick as usize - 1);
            let up = !woven.cloth().drawdown().up(end, pick);
            self.order(Order::Lift { end, pick, up });
        }
    }

    /// Shows the whole cloth from a side.
    pub(crate) fn look_from(&mut self, side: Side) {
        if let Some(cloth) = &self.cloth {
            self.canvas.look_from(cloth, side);
        }
    }

    fn keys(&mut self, ui: &egui::Ui) {
        // A text field has the keyboard.
        if ui.ctx().egui_wants_keyboard_input() {
            return;
        }
        let pressed = |wanted: Key, with: Modifiers| {
            ui.input(|input| {
                input.events.iter().any(|event| {
                    // A key that is held down counts once.
                    matches!(event, egui::Event::Key { key, pressed: true, repeat: false, modifiers, .. }
                        if *key == wanted && modifiers.matches_exact(with))
                })
            })
        };
        for (key, side) in [(Key::F, Side::Face), (Key::B, Side::Back), (Key::O, Side::Oblique)] {
            if pressed(key, Modifiers::NONE) {
                self.look_from(side);
            }
        }
        if pressed(Key::L, Modifiers::NONE) {
            self.lifts = !self.lifts;
        }
        if pressed(Key::S, Modifiers::COMMAND) {
            self.order(Order::Save);
        }
        if pressed(Key::Z, Modifiers::COMMAND) {
            self.order(Order::Undo);
        }
    }
}
