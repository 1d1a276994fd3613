//! The work that texere does on the CPU runs in the pool of the thread that calls it.
#![cfg(all(feature = "glb", feature = "ply", feature = "toml"))]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::io::Cursor;
use std::ops::ControlFlow;
use std::sync::Arc;

use texere::check::{clearance, linking};
use texere::mesh::{Frame, Ray};
use texere::write::{Format, mesh_to, stream_to};
use texere::yarn::{Boundary, lengths_mm, yarns_under};
use texere::{Backend, Design, Live, Pipeline, Settings, read};

const CLOTH: &str = "weave = { notation = \"2/1\", ends = 9, picks = 9 }\ncloth.selvedge = true\n\
    yarns.white = { diameter_mm = 0.143, twist_per_m = 800 }\n\
    warp = { yarns = [\"white\"], spacing_mm = 0.19 }\nweft = { yarns = [\"white\"], spacing_mm = 0.35 }\n";
const JERSEY: &str =
    "knit = { chart = \"k\", repeat = [3, 3], loop_length_mm = 3.2 }\nyarns.ecru.tex = 20.0\n";
const TRICOT: &str = "yarns.white.diameter_mm = 0.1\n[warp_knit]\nwales = 2\ncourses = 2\nwales_per_cm = 10.0\n\
    courses_per_cm = 13.333\n[[warp_knit.bars]]\nlapping = \"tricot\"\n";

/// rayon's global pool can't start in this program, so work outside the caller's pool would panic.
#[test]
fn no_work_leaves_the_pool_that_texere_is_called_in() {
    let never = |_| Err(std::io::Error::other("the global pool is not to be used"));
    rayon::ThreadPoolBuilder::new().spawn_handler(never).build_global().unwrap_err();
    let global = std::panic::catch_unwind(texere::devices);
    assert!(global.is_err(), "work of the global pool would stay unseen");

    let folder = std::env::temp_dir().join(format!("texere-pool-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join("design.toml");
    let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build().unwrap();
    pool.install(|| {
        for found in texere::devices().found {
            let device: Arc<dyn Backend> = Arc::from(texere::open(&found.name).unwrap());
            for text in [CLOTH, JERSEY, TRICOT] {
                std::fs::write(&path, text).unwrap();
                use_all(&read(&path).unwrap(), &device);
            }
        }
    });
    std::fs::remove_dir_all(&folder).unwrap();
}

/// A design comes to rest, is measured, meshed, written and edited.
fn use_all(design: &Design, device: &Arc<dyn Backend>) {
    let settings = Settings { frame: Frame::RotationMinimizing, caps: true, ..Settings::default() };
    let on = |_| ControlFlow::Continue(());
    let (structure, before) = (&design.structure, design.yarns().unwrap());
    let cloth = design.clone().rest(&**device).run().unwrap();
    let yarns = cloth.yarns();

    clearance(yarns, &settings).unwrap();
    linking(yarns, yarns, &Boundary::without_repeat(yarns.layout())).unwrap();
    structure.measures(yarns).unwrap();
    structure.cures(&structure.diagnose(1.0, on).unwrap(), on);
    assert!(lengths_mm(yarns).iter().all(|length| *length > 0.0));
    let middle = structure.size_mm().map(|side| side / 2.0);
    assert!(yarns_under(yarns, middle).len() <= yarns.layout().yarns().len());

    let pipeline = || Pipeline::new(yarns).settings(settings);
    let mesh = pipeline().mesh(&**device).unwrap();
    pipeline().trajectory(&**device).unwrap();
    pipeline().attributes(&**device).unwrap();
    for format in Format::ALL {
        let [mut whole, mut streamed] = [(); 2].map(|()| Cursor::new(Vec::new()));
        mesh_to(&mesh, format, &mut whole).unwrap();
        stream_to(pipeline(), &**device, format, &mut streamed).unwrap();
    }

    let mut live = Live::new(device.clone(), structure, settings).unwrap();
    live.keep_attributes();
    live.update().unwrap();
    if live.woven().is_some() {
        live.set_lift(3, 4, true).unwrap();
    }
    live.set_points(0, before.yarn_points(0).unwrap()).unwrap();
    live.update().unwrap();
    live.pick(&Ray { origin: [middle[0], middle[1], 100.0], direction: [0.0, 0.0, -1.0] }).unwrap();
}
