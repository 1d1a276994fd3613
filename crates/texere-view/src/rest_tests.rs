//! Tests that the window shows the same yarns at rest as the library gives.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may panic")]

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Sender, channel};
use std::time::Duration;
use std::{fs, thread};

use texere::Yarns;
use texere::picture::open_renderer;
use texere::rest::RestReport;
use texere::write::yarns_to;

use crate::messages::{Cloth, News, Order};
use crate::watch::Watch;
use crate::workshop::Workshop;
use crate::{Event, View};

/// A weave that is stretched before it comes to rest, a knit and a warp knit, small.
const DESIGNS: [(&str, &str); 3] = [
    (
        "weave",
        "weave = { notation = \"2/1\", ends = 6, picks = 6 }\nyarns.a.diameter_mm = 0.143\n\
         warp = { yarns = [\"a\"], spacing_mm = 0.3 }\nweft = { yarns = [\"a\"], spacing_mm = 0.35 }\n\
         finish.stretch_weft = 1.01\n",
    ),
    ("knit", "knit = { chart = \"k\", repeat = [3, 3], loop_length_mm = 5.0 }\nyarns.a.diameter_mm = 0.3\n"),
    (
        "warp-knit",
        "[warp_knit]\nwales = 3\ncourses = 4\nwales_per_cm = 10\ncourses_per_cm = 13\n[[warp_knit.bars]]\n\
         lapping = \"1-0/1-2//\"\n[[warp_knit.bars]]\nlapping = \"1-2/1-0//\"\n[yarns.a]\ndiameter_mm = 0.1\n",
    ),
];

/// How long the test waits for a cloth. On an idle machine a cloth takes a fraction of a second.
const PATIENCE: Duration = Duration::from_secs(300);

/// The cloths that are sent to a window of `view`, up to the first one that has settled. The
/// workshop is a thread, as in the window, and the window is closed once the cloth has come.
fn shown(view: &View) -> Vec<Cloth> {
    let (orders, taken) = channel();
    let (news, told) = channel();
    let is_closing = Arc::new(AtomicBool::new(false));
    let workshop = Workshop {
        orders: taken,
        is_closing: is_closing.clone(),
        news,
        window: eframe::egui::Context::default(),
        renderer: open_renderer("auto").unwrap(),
        view: view.clone(),
        watch: Watch::new([view.design.clone()]),
        design: texere::read(&view.design).unwrap(),
        colors: BTreeMap::new(),
        lifts: Vec::new(),
        settler: None,
        yarns: None,
    };
    let workshop = thread::spawn(move || workshop.run());
    let mut cloths: Vec<Cloth> = Vec::new();
    while cloths.last().is_none_or(|cloth| !cloth.is_settled) {
        match told.recv_timeout(PATIENCE).unwrap() {
            News::Cloth(cloth) => cloths.push(*cloth),
            News::Event(Event::Failed(why)) => panic!("{why}"),
            _ => {}
        }
    }
    is_closing.store(true, Ordering::Relaxed);
    drop::<Sender<Order>>(orders);
    workshop.join().unwrap();
    cloths
}

/// All values of yarns, as the bytes of a file.
fn bytes(yarns: &Yarns) -> Vec<u8> {
    let mut bytes = Vec::new();
    yarns_to(yarns, &mut bytes).unwrap();
    bytes
}

fn in_file(folder: &Path, name: &str, text: &str) -> View {
    let path = folder.join(name).with_extension("toml");
    fs::write(&path, text).unwrap();
    View { device: "cpu".into(), tension: 0.25, ..View::of(path) }
}

#[test]
fn the_window_shows_the_yarns_of_the_library() {
    let folder = std::env::temp_dir().join(format!("texere-rest-{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    for (name, text) in DESIGNS {
        let view = in_file(&folder, name, text);
        let design = texere::read(&view.design).unwrap();
        let placed = design.yarns().unwrap().with_tension(view.tension).unwrap();
        let device = texere::open(&view.device).unwrap();
        let cloth = design.rest(&*device).tension(view.tension).run().unwrap();
        assert!(matches!(cloth.report(), RestReport::Finished(_)), "{name}: {}", cloth.report());
        assert_ne!(placed.points(), cloth.yarns().points(), "{name} has not moved");

        let [first, last] = &shown(&view)[..] else { panic!("{name}: two cloths are shown") };
        assert!(bytes(&first.yarns) == bytes(&placed), "{name}: other yarns as they are placed");
        assert!(bytes(&last.yarns) == bytes(cloth.yarns()), "{name}: other yarns at rest");
    }
    fs::remove_dir_all(&folder).unwrap();
}
