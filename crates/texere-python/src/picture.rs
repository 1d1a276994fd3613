//! Pictures of cloth and their layers, as arrays.

use std::collections::BTreeMap;
use std::io::Cursor;
use std::sync::{Mutex, MutexGuard, PoisonError};

use numpy::{IntoPyArray, PyArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use texere::picture::{
    Background, Camera, Cut, Layers, Picture, Pose, Quality, RenderError, Renderer, Scene, picture_sides,
};
use texere::yarn::Origin;
use texere::{BackendError, PipelineError, Settings};

use crate::crossing::crossings;
use crate::error::Raise;
use crate::watch;
use crate::yarn::srgb;

/// Where a picture is seen from, and which part of the cloth it shows.
#[derive(Debug)]
pub(crate) enum View {
    Face,
    Back,
    Oblique { turn: f32 },
    CloseUp { at: [f32; 2], width_mm: f32 },
    Cut { cut: Cut, at: [f32; 2], width_mm: f32 },
    Eye { pose: Pose, field_of_view: f32 },
}

/// What a caller asks of a picture.
#[derive(Debug)]
pub(crate) struct Asked {
    pub(crate) size: [u32; 2],
    pub(crate) view: View,
    pub(crate) background: Background,
    pub(crate) quality: Quality,
}

/// The names of the layers that callers can ask for in addition to the picture itself.
const LAYERS: [&str; 7] = ["depth", "normal", "tangent", "yarn", "uv", "position", "crossing"];

/// The most pixels that a picture may have. Devices also limit the width and the height.
const PIXELS_MOST: u64 = 1 << 28;

impl View {
    /// The view that is called `name`. `place` is a point of the cloth and the width of the cloth
    /// that is shown round it, mm. `eye` is the eye, the point that it looks at, and the direction
    /// that is up in the picture.
    ///
    /// **Errors**: `ValueError` if there is no view of this name, or if the view needs `place` or
    /// `eye` and it is missing.
    pub(crate) fn new(
        name: &str,
        turn: f32,
        place: Option<((f32, f32), f32)>,
        eye: Option<([f32; 3], [f32; 3], [f32; 3])>,
        field_of_view: f32,
    ) -> PyResult<Self> {
        let place = || {
            let place = place.map(|((x, y), width_mm)| ([x, y], width_mm));
            place.ok_or_else(|| PyValueError::new_err(format!("view {name:?} needs at=(x, y) and width_mm")))
        };
        let cut = |cut| place().map(|(at, width_mm)| Self::Cut { cut, at, width_mm });
        match (name, eye) {
            ("face", _) => Ok(Self::Face),
            ("back", _) => Ok(Self::Back),
            ("oblique", _) => Ok(Self::Oblique { turn }),
            ("close-up", _) => place().map(|(at, width_mm)| Self::CloseUp { at, width_mm }),
            ("cut-warp", _) => cut(Cut::Warp),
            ("cut-weft", _) => cut(Cut::Weft),
            ("eye", Some((eye, target, up))) => {
                Ok(Self::Eye { pose: Pose { eye, target, up }, field_of_view })
            }
            ("eye", None) => Err(PyValueError::new_err("view \"eye\" needs eye=(eye, target, up)")),
            _ => Err(PyValueError::new_err(format!(
                "view is {name:?}, expected one of face, back, oblique, close-up, cut-warp, cut-weft, eye"
            ))),
        }
    }
}

/// The background that a caller asks for: `ground`, `nothing` or a colour.
pub(crate) fn background(value: &Bound<'_, PyAny>) -> PyResult<Background> {
    match value.extract::<String>().as_deref() {
        Ok("ground") => Ok(Background::Ground),
        Ok("nothing") => Ok(Background::Nothing),
        _ => Ok(Background::Color(srgb(value)?)),
    }
}

impl Asked {
    fn camera(&self, scene: &Scene) -> Result<Camera, RenderError> {
        let (extent, size) = (scene.extent(), self.size);
        match self.view {
            View::Face => Ok(Camera::face(extent, size)),
            View::Back => Ok(Camera::face(extent, size).turned_over()),
            View::Oblique { turn } => Camera::oblique(extent, turn, size),
            View::CloseUp { at, width_mm } => Camera::close_up(extent, at, width_mm, size),
            View::Cut { cut, at, width_mm } => Camera::cut(extent, cut, at, width_mm, size),
            View::Eye { pose, field_of_view } => Camera::perspective(extent, &pose, field_of_view, size),
        }
    }
}

/// The open devices that make pictures, by the names under which callers asked for them.
fn renderers() -> MutexGuard<'static, BTreeMap<String, Renderer>> {
    static OPEN: Mutex<BTreeMap<String, Renderer>> = Mutex::new(BTreeMap::new());
    OPEN.lock().unwrap_or_else(PoisonError::into_inner)
}

fn renderer(device: &str) -> Result<Renderer, BackendError> {
    let mut open = renderers();
    if let Some(renderer) = open.get(device) {
        return Ok(renderer.clone());
    }
    let renderer = texere::picture::open_renderer(device)?;
    open.insert(device.into(), renderer.clone());
    Ok(renderer)
}

/// The mesh settings for a picture of `yarns`. Threads of woven cloth lie so close together that
/// their tubes get more sides.
fn settings(yarns: &texere::Yarns) -> Settings {
    let origins = || yarns.layout().yarns().iter().map(|yarn| yarn.origin);
    let is_woven = origins().any(|origin| matches!(origin, Origin::End(_)))
        && origins().any(|origin| matches!(origin, Origin::Pick(_)));
    Settings { sides: picture_sides(yarns, is_woven), ..Settings::default() }.following_fibres(yarns)
}

/// The scene that was made for a cloth's last picture, and the name of the device that holds it.
/// Later pictures of the cloth on that device use the scene again.
pub(crate) type Kept = Mutex<Option<(String, Scene)>>;

/// Whether this machine has a device that makes pictures.
pub(crate) fn has_device(py: Python<'_>) -> bool {
    py.detach(|| renderer("auto").is_ok())
}

/// Makes a picture of `yarns` as a PNG file.
pub(crate) fn png(py: Python<'_>, yarns: &texere::Yarns, kept: &Kept, asked: &Asked) -> PyResult<Vec<u8>> {
    let (made, _) = drawn(py, yarns, kept, asked, "auto", false)?;
    let mut png = Cursor::new(Vec::new());
    texere::write::picture_to(made.size, &made.rgb, &mut png).raise(py)?;
    Ok(png.into_inner())
}

/// Makes a picture of a cloth, and returns its pixels as an array. If `layers` is given, returns a
/// dict of the pixels and of the layers that it names.
pub(crate) fn picture<'py>(
    py: Python<'py>,
    cloth: &texere::Cloth,
    kept: &Kept,
    asked: &Asked,
    device: &str,
    layers: Option<Vec<String>>,
) -> PyResult<Bound<'py, PyAny>> {
    if let Some(unknown) = layers.iter().flatten().find(|layer| !LAYERS.contains(&layer.as_str())) {
        let known = LAYERS.join(", ");
        return Err(PyValueError::new_err(format!("there is no layer {unknown:?}, only {known}")));
    }
    let (made, shown) = drawn(py, cloth.yarns(), kept, asked, device, layers.is_some())?;
    let color = pixels(py, asked, made)?;
    let Some((layers, shown)) = layers.zip(shown) else { return Ok(color) };
    let all = PyDict::new(py);
    all.set_item("color", color)?;
    if layers.iter().any(|layer| layer == "crossing") {
        let subdivisions = settings(cloth.yarns()).subdivisions;
        let crossings = watch::quietly(py, |run| {
            crossings(cloth, subdivisions, &shown, run).ok_or(PipelineError::Cancelled)
        })?;
        let [width, height] = shown.size.map(|side| side as usize);
        let flat = crossings.into_flattened().into_pyarray(py);
        all.set_item("crossing", flat.reshape([height, width, 2])?)?;
    }
    add(&all, shown, &layers)?;
    Ok(all.into_any())
}

/// Draws a picture, and reads its layers if `wants_layers` is true. `kept` holds the scene for the
/// next picture.
fn drawn(
    py: Python<'_>,
    yarns: &texere::Yarns,
    kept: &Kept,
    asked: &Asked,
    device: &str,
    wants_layers: bool,
) -> PyResult<(Picture, Option<Layers>)> {
    let [width, height] = asked.size;
    if u64::from(width) * u64::from(height) > PIXELS_MOST {
        let most = format!("more than {PIXELS_MOST} pixels");
        return Err(PyValueError::new_err(format!("size is {width} x {height}, {most}")));
    }
    let taken = kept.lock().unwrap_or_else(PoisonError::into_inner).take();
    let mut scene = match taken.filter(|(name, _)| name == device) {
        Some((_, scene)) => scene,
        None => {
            let renderer = watch::quietly(py, |_| renderer(device))?;
            let settings = settings(yarns);
            watch::quietly(py, |run| renderer.scene_with_progress(yarns, &settings, |share| run.tell(share)))?
        }
    };
    let drawn = {
        let scene = &mut scene;
        watch::quietly(py, move |run| {
            scene.set_background(asked.background);
            let camera = asked.camera(scene)?;
            let made = scene.picture_with_progress(&camera, asked.quality, |share| run.tell(share))?;
            let shown = if wants_layers { scene.layers()? } else { None };
            Ok::<_, RenderError>((made, shown))
        })?
    };
    *kept.lock().unwrap_or_else(PoisonError::into_inner) = Some((device.into(), scene));
    Ok(drawn)
}

/// The pixels of a picture as an array. If the background is `nothing`, they have an alpha channel.
fn pixels<'py>(py: Python<'py>, asked: &Asked, made: Picture) -> PyResult<Bound<'py, PyAny>> {
    let [width, height] = made.size.map(|side| side as usize);
    let (channels, bytes) = match asked.background {
        Background::Nothing => (4, made.rgba()),
        _ => (3, made.rgb),
    };
    Ok(bytes.into_pyarray(py).reshape([height, width, channels])?.into_any())
}

/// Adds the layers that `asked` names to `all`, except `crossing`, which `picture` adds.
fn add(all: &Bound<'_, PyDict>, shown: Layers, asked: &[String]) -> PyResult<()> {
    let py = all.py();
    let [width, height] = shown.size.map(|side| side as usize);
    let wanted = |name: &str| asked.iter().any(|layer| layer == name);
    if wanted("depth") {
        all.set_item("depth", shown.depth.into_pyarray(py).reshape([height, width])?)?;
    }
    if wanted("yarn") {
        let yarn: Vec<i32> = shown.yarn.iter().map(|yarn| i32::try_from(*yarn).unwrap_or(-1)).collect();
        all.set_item("yarn", yarn.into_pyarray(py).reshape([height, width])?)?;
    }
    if wanted("uv") {
        let uv = shown.uv.into_flattened().into_pyarray(py);
        all.set_item("uv", uv.reshape([height, width, 2])?)?;
    }
    let vectors = [("position", shown.position), ("normal", shown.normal), ("tangent", shown.tangent)];
    for (name, vectors) in vectors {
        if wanted(name) {
            let flat = vectors.into_flattened().into_pyarray(py);
            all.set_item(name, flat.reshape([height, width, 3])?)?;
        }
    }
    Ok(())
}
