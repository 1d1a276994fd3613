//! Designs that tests bake, and the device that draws them.

use std::ops::ControlFlow;
use std::sync::{Mutex, MutexGuard, OnceLock};

use texere_bake::{BakeOptions, BakedCloth, bake};
use texere_cpu::ParallelBackend;
use texere_formats::Design;
use texere_render::Renderer;
use texere_wgpu::{Schedule, WgpuBackend};

pub(crate) const TWILL: &str = "weave = { notation = \"2/1\", ends = 12, picks = 12 }
yarns.red = { tex = 30.0, color = \"#a03020\" }
yarns.ecru = { tex = 40.0, color = \"#e8e2d4\", twist_per_m = 500.0 }
warp = { yarns = [\"red\", \"ecru\"], per_cm = 22.0 }
weft = { yarns = [\"ecru\"], per_cm = 18.0 }
";

pub(crate) const JERSEY: &str = "[knit]
chart = \"k\"
loop_length_mm = 3.2
repeat = [3, 3]
[yarns.blue]
tex = 20.0
color = \"#3050a0\"
";

/// One device for all tests. Maps are drawn one at a time, so that lavapipe has all cores to
/// itself.
pub(crate) fn renderer() -> MutexGuard<'static, Renderer> {
    static RENDERER: OnceLock<Mutex<Renderer>> = OnceLock::new();
    let open = || {
        let device = WgpuBackend::open_named("llvmpipe", Schedule::PerRing)
            .expect("lavapipe; on Debian and Ubuntu install mesa-vulkan-drivers");
        Mutex::new(Renderer::new(device).unwrap())
    };
    RENDERER.get_or_init(open).lock().unwrap_or_else(std::sync::PoisonError::into_inner)
}

pub(crate) fn design(text: &str) -> Design {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("cloth.toml");
    std::fs::write(&path, text).unwrap();
    texere_formats::read(&path).unwrap()
}

pub(crate) fn baked(text: &str, options: &BakeOptions) -> BakedCloth {
    let device = ParallelBackend::open().unwrap();
    bake(design(text), &device, &renderer(), options, |_| ControlFlow::Continue(())).unwrap()
}
