//! The thread that makes cloth: it reads the design, takes orders, and sends scenes to the window.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};

use eframe::egui;
use texere::mesh::Undersampled;
use texere::picture::{Camera, Quality, RenderError, Renderer, Scene};
use texere::read::Refusal;
use texere::rest::{FinishError, RestReport, stand_in};
use texere::write::Output;
use texere::{Backend, Design, Settings, Structure, Yarns};

use crate::error::said;
use crate::messages::{Cloth, News, Order};
use crate::watch::Watch;
use crate::{Event, View};

/// The time between two looks at the design's files.
const POLL: Duration = Duration::from_millis(150);

/// How long a file has to stay unchanged before it is read, because an editor may be writing it.
const WRITING: Duration = Duration::from_millis(40);

/// The longest wait for a file that keeps changing. After that time the file is read as it is.
const PATIENCE: Duration = Duration::from_secs(1);

/// The work that an order makes necessary, least first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Change {
    Nothing,
    Scene,
    Yarns,
}

/// The state of the thread that makes cloth.
pub(crate) struct Workshop {
    pub(crate) orders: Receiver<Order>,
    /// Whether the window is being closed, so that all work can stop.
    pub(crate) is_closing: Arc<AtomicBool>,
    pub(crate) news: Sender<News>,
    /// The window, which is asked to repaint for news.
    pub(crate) window: egui::Context,
    pub(crate) renderer: Renderer,
    pub(crate) view: View,
    pub(crate) watch: Watch,
    pub(crate) design: Design,
    /// Materials whose colours were changed.
    pub(crate) colors: BTreeMap<usize, [u8; 3]>,
    /// Lifts as they were before they were changed: end and pick, counted from 0, and whether the
    /// warp was up.
    pub(crate) lifts: Vec<(usize, usize, bool)>,
    /// The device on which yarns settle. It is opened only once, because drivers do not free all
    /// memory of a device.
    pub(crate) settler: Option<Box<dyn Backend>>,
    /// The yarns that are shown, and whether they have settled.
    pub(crate) yarns: Option<(Arc<Yarns>, bool)>,
}

impl Workshop {
    /// Works until the window is closed.
    pub(crate) fn run(mut self) {
        let mut change = Change::Yarns;
        let mut waiting = None;
        while !self.is_closing() {
            match change {
                Change::Nothing => {}
                Change::Scene => self.show(),
                Change::Yarns => waiting = self.weave(),
            }
            change = match waiting.take().map_or_else(|| self.orders.recv_timeout(POLL), Ok) {
                Ok(first) => {
                    // A slider sends many orders, and only the last cloth is seen.
                    let mut change = self.take(first);
                    while let Ok(next) = self.orders.try_recv() {
                        change = change.max(self.take(next));
                    }
                    change
                }
                Err(RecvTimeoutError::Timeout) => self.reload(),
                Err(RecvTimeoutError::Disconnected) => return,
            };
        }
    }

    fn is_closing(&self) -> bool {
        self.is_closing.load(Ordering::Relaxed)
    }

    fn tell(&self, news: News) {
        // If the window is gone, the news is of no use.
        let _ = self.news.send(news);
        self.window.request_repaint();
    }

    fn fail(&self, what: String) {
        self.tell(News::Event(Event::Failed(what)));
    }

    /// Carries out an order, except for the yarns and the scene. Returns what has to be made again.
    fn take(&mut self, order: Order) -> Change {
        match order {
            Order::Lift { end, pick, up } => {
                let before = self.up(end, pick);
                if !self.lift(end, pick, up) {
                    return Change::Nothing;
                }
                self.lifts.push((end, pick, before));
                Change::Yarns
            }
            Order::Undo => match self.lifts.pop() {
                Some((end, pick, up)) if self.lift(end, pick, up) => Change::Yarns,
                _ => Change::Nothing,
            },
            Order::Color { material, srgb } => {
                self.colors.insert(material, srgb);
                self.paint();
                Change::Scene
            }
            Order::Settings(settings) => {
                self.view.settings = settings;
                self.view.sides = Some(settings.sides);
                self.view.subdivisions = Some(settings.subdivisions);
                Change::Scene
            }
            // The slider sends an order in every frame until the cloth has the tension that the
            // slider shows.
            Order::Tension(tension) if tension == self.view.tension => Change::Nothing,
            Order::Tension(tension) => {
                self.view.tension = tension;
                Change::Yarns
            }
            Order::Settle(settle) => {
                self.view.settle = Some(settle);
                Change::Yarns
            }
            Order::Save => {
                match self.save() {
                    Ok(saved) => self.tell(News::Event(saved)),
                    Err(error) => self.fail(error),
                }
                Change::Nothing
            }
        }
    }

    fn settles(&self) -> bool {
        self.view.settle.unwrap_or(self.design.settle)
    }

    fn up(&self, end: usize, pick: usize) -> bool {
        self.design.structure.woven().is_some_and(|design| design.cloth().drawdown().up(end, pick))
    }

    fn lift(&mut self, end: usize, pick: usize, up: bool) -> bool {
        let Structure::Woven(design) = &mut self.design.structure else { return false };
        match design.set_lift(end, pick, up) {
            Ok(()) => {
                let crossing = texere::check::Crossing { end: end as u32 + 1, pick: pick as u32 + 1 };
                self.tell(News::Event(Event::Lifted { crossing, up }));
                true
            }
            Err(error) => {
                self.fail(said(&error));
                false
            }
        }
    }

    /// Writes the design as it is now beside the file that it was read from. No existing file is
    /// replaced.
    fn save(&self) -> Result<Event, String> {
        let mut design = self.design.clone();
        if let Structure::Woven(woven) = &mut design.structure {
            for (&number, &srgb) in &self.colors {
                woven.set_color(number, srgb).map_err(|error| said(&error))?;
            }
        }
        let path = free_beside(&self.view.design);
        let output = Output::to(&path).sparing(design.files());
        let left_out = texere::write::toml(&design, output).map_err(|error| said(&error))?;
        Ok(Event::Saved { path, left_out })
    }

    /// Reads the design again if one of its files has changed. A file that can't be read changes
    /// nothing.
    fn reload(&mut self) -> Change {
        if !self.watch.changed() {
            return Change::Nothing;
        }
        let seen = Instant::now();
        loop {
            thread::sleep(WRITING);
            if !self.watch.changed() || seen.elapsed() > PATIENCE {
                break;
            }
        }
        match self.view.read() {
            Ok(design) => {
                self.watch.follow(design.files().iter().cloned());
                self.design = design;
                self.colors.clear();
                self.lifts.clear();
                Change::Yarns
            }
            Err(error) => {
                self.fail(said(&error));
                Change::Nothing
            }
        }
    }

    /// Makes the yarns and shows them, and shows them again once they have settled. Returns an
    /// order that came meanwhile.
    fn weave(&mut self) -> Option<Order> {
        let placed = self.design.yarns();
        match placed.and_then(|yarns| Ok(yarns.with_tension(self.view.tension)?)) {
            Ok(yarns) => self.take_yarns(yarns, false),
            Err(error) => {
                self.fail(said(&self.design.refused(error)));
                return None;
            }
        }
        if !self.settles() || self.is_closing() {
            return None;
        }
        let mut order = None;
        match self.at_rest(&mut order) {
            Ok(cloth) => {
                let report = [cloth.report().to_string()].into_iter();
                let said = report.chain(cloth.report().warnings()).collect::<Vec<_>>().join("; ");
                if matches!(cloth.report(), RestReport::Finished(_)) {
                    self.take_yarns(cloth.into_parts().1, true);
                }
                self.tell(News::Settled(said));
            }
            // Settling was stopped for an order or a changed file.
            Err(_) if order.is_some() || self.watch.is_stale() => self.tell(News::Settled(String::new())),
            Err(error) => {
                // The device may be lost.
                self.settler = None;
                self.tell(News::Settled(said(&error)));
            }
        }
        order
    }

    /// Lets the yarns come to rest. Stops early if an order comes, if a file changes, or if the
    /// window is closed. An order that comes is put into `order`.
    fn at_rest(&mut self, order: &mut Option<Order>) -> Result<texere::Cloth, Refusal> {
        let mut design = self.design.clone();
        design.settle = true;
        let Self { orders, is_closing, news, window, watch, view, settler, .. } = self;
        let device = match settler {
            Some(device) => device,
            None => settler.insert(texere::open(&view.device).map_err(FinishError::from)?),
        };
        let cpu = stand_in(design.finish.by, &**device).map_err(FinishError::from)?;
        let device: &dyn Backend = cpu.as_deref().unwrap_or(&**device);
        // The closure owns the references, because a receiver can be sent to other threads but not
        // shared with them.
        let progress = move |share| {
            let is_open = news.send(News::Settling(share)).is_ok() && !is_closing.load(Ordering::Relaxed);
            window.request_repaint();
            if order.is_none() {
                *order = orders.try_recv().ok();
            }
            if !is_open || order.is_some() || watch.is_stale() {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        design.rest(device).tension(view.tension).progress(progress).run()
    }

    /// Shows other yarns, in the colours that were chosen.
    fn take_yarns(&mut self, yarns: Yarns, is_settled: bool) {
        self.yarns = Some((Arc::new(yarns), is_settled));
        self.paint();
        self.show();
    }

    /// Gives the yarns the colours that were chosen, if any. Yarns that the window still shows are
    /// copied first.
    fn paint(&mut self) {
        let Some((yarns, _)) = self.yarns.as_mut().filter(|_| !self.colors.is_empty()) else { return };
        let mut materials = yarns.materials().to_vec();
        for (&number, &srgb) in &self.colors {
            if let Some(material) = materials.get_mut(number) {
                material.srgb = srgb;
            }
        }
        if let Err(error) = Arc::make_mut(yarns).set_materials(materials) {
            self.fail(said(&error));
        }
    }

    /// Sends the yarns as they are now to the device and the window.
    fn show(&self) {
        if self.is_closing() {
            return;
        }
        let Some((yarns, is_settled)) = &self.yarns else { return };
        let mut settings = self.view.settings;
        let lies_close = *is_settled && self.design.structure.woven().is_some();
        let sides = yarns.layout().corners().or(self.view.sides);
        settings.sides = sides.unwrap_or_else(|| texere::picture::picture_sides(yarns, lies_close));
        settings = match self.view.subdivisions {
            Some(subdivisions) => Settings { subdivisions, ..settings },
            None => settings.following_fibres(yarns),
        };
        match scene(&self.renderer, yarns, &settings) {
            Ok(scene) => {
                self.tell(News::Cloth(Box::new(Cloth {
                    design: Arc::new(self.design.clone()),
                    yarns: yarns.clone(),
                    settings,
                    extent: *scene.extent(),
                    triangles: scene.plan().counts().triangles,
                    scene: Arc::new(Mutex::new(scene)),
                    is_settled: *is_settled,
                    is_edited: !self.lifts.is_empty(),
                    apart: self.design.structure.pieces().said(),
                    undersampled: Undersampled::of(yarns, &settings),
                })));
            }
            Err(error) => self.fail(said(&error)),
        }
    }
}

/// `cloth-edited.toml` for `cloth.wif`, with a number if that file exists already.
fn free_beside(design: &Path) -> PathBuf {
    let named = |number: u32| {
        let mut name = design.file_stem().unwrap_or_default().to_owned();
        name.push(if number == 1 { "-edited.toml".into() } else { format!("-edited-{number}.toml") });
        design.with_file_name(name)
    };
    let first_free = (1..u32::MAX).map(named).find(|path| path.symlink_metadata().is_err());
    first_free.unwrap_or_else(|| named(u32::MAX))
}

/// A scene that is ready to be drawn. A small picture is drawn here, so that the window need not
/// wait for the work that only a first picture needs.
fn scene(renderer: &Renderer, yarns: &Yarns, settings: &Settings) -> Result<Scene, RenderError> {
    let mut scene = renderer.scene(yarns, settings)?;
    let camera = Camera::face(scene.extent(), [8, 8]);
    scene.frame(&camera, Quality { supersampling: 1, ..Quality::default() })?;
    Ok(scene)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may panic")]

    use super::*;

    #[test]
    fn a_copy_replaces_no_file() {
        let folder = std::env::temp_dir().join(format!("texere-copies-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let design = folder.join("cloth.wif");
        for name in ["cloth-edited.toml", "cloth-edited-2.toml", "cloth-edited-3.toml"] {
            let free = free_beside(&design);
            assert_eq!(free, folder.join(name));
            std::fs::write(free, name).unwrap();
        }
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
