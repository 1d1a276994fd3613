//! From a design to its maps.

use std::ops::ControlFlow;

use texere_core::{Backend, Origin, Settings, Yarns};
use texere_fabric::{FabricError, FinishError, Finished, Structure, Tile};
use texere_formats::{Cloth, Design, Refusal, RestReport};
use texere_render::{Camera, Quality, Renderer, Scene, picture_sides};

use crate::{Area, BakeError, Maps, Material, Side};

/// Texels across the mean radius of the yarns, if no size is given.
const TEXELS_A_RADIUS: f64 = 8.0;

/// The longest side of maps, texels, if no size is given.
const SIDE_USUAL: f64 = 2048.0;

/// The longest side of the preview, pixels.
const PREVIEW: f64 = 512.0;

/// The shares of the progress at which the yarns are at rest, and the face is baked.
const RESTED: f64 = 0.4;
const FRONT: f64 = 0.7;

/// What is baked, and how finely.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// The size of a texel, mm. If none is given, the mean radius of the yarns has eight texels, and
    /// the maps 2,048 along their longer side at most.
    pub texel_mm: Option<f64>,
    /// A rectangle of the cloth: its lower left corner, and its width and height, mm. It does not
    /// tile. If none is given, one repeat is baked, or the whole of a knit that does not repeat.
    pub area: Option<[[f64; 2]; 2]>,
    /// The tension of the yarns' splines, from 0 to below 1.
    pub tension: f32,
}

impl Options {
    /// These options with texels of about `mm`.
    #[must_use]
    pub const fn texel_mm(mut self, mm: f64) -> Self {
        self.texel_mm = Some(mm);
        self
    }

    /// These options with a rectangle of the cloth instead of a repeat: its lower left corner, and
    /// its width and height, mm.
    #[must_use]
    pub const fn area(mut self, low: [f64; 2], size: [f64; 2]) -> Self {
        self.area = Some([low, size]);
        self
    }
}

/// Bakes a design. Its yarns come to rest on `device`, as [`Design::rest`] does it, and `renderer`
/// draws them. `progress` gets the share of the work that is done, from 0 to 1. `Break` ends it.
///
/// **Errors**: [`BakeError`].
pub fn bake(
    design: Design,
    device: &dyn Backend,
    renderer: &Renderer,
    options: &Options,
    mut progress: impl FnMut(f64) -> ControlFlow<()> + Send,
) -> Result<Material, BakeError> {
    let name = design.name.clone();
    let (design, tile) = tiled(design, options)?;
    let rest = design.rest(device).tension(options.tension).progress(|share| progress(RESTED * share));
    let cloth = rest.run().map_err(stopped)?;
    let area = area(&cloth, tile.as_ref(), options);
    let lies_close = matches!(cloth.report(), RestReport::Finished(Finished::Woven(_)));
    let (design, yarns) = cloth.into_parts();
    let measures = design.structure.measures(&yarns).map_err(|error| design.refused(error))?;

    let settings = Settings { sides: picture_sides(&yarns, lies_close), ..Settings::of(&yarns) };
    let settings = settings.following_fibres(&yarns);
    let mut scene = renderer.scene(&yarns, &settings)?;
    let texel = options.texel_mm.unwrap_or_else(|| {
        let fine = f64::from(scene.extent().radius) / TEXELS_A_RADIUS;
        fine.max(area.size[0].max(area.size[1]) / SIDE_USUAL)
    });
    let size = area.texels(texel)?;
    let origin = |origin: Origin| tile.as_ref().map_or(origin, |tile| tile.origin(origin));
    let on = |from: f64, to: f64| move |share: f64| from + (to - from) * share;
    let (first, second) = (on(RESTED, FRONT), on(FRONT, 1.0));
    let front =
        Maps::bake(&mut scene, &yarns, &area, size, Side::Front, origin, |share| progress(first(share)))?;
    let back =
        Maps::bake(&mut scene, &yarns, &area, size, Side::Back, origin, |share| progress(second(share)))?;
    Ok(Material {
        name,
        front,
        back,
        tiles: area.tiles,
        is_woven: design.structure.woven().is_some(),
        weight: measures.areal_weight,
        thickness_mm: measures.thickness_mm,
        preview: preview(&mut scene, &area)?,
        yarns: yarns.materials().to_vec(),
    })
}

/// The design of a tile, if a tile is wanted and the structure repeats.
fn tiled(mut design: Design, options: &Options) -> Result<(Design, Option<Tile>), BakeError> {
    if options.area.is_some() {
        return Ok((design, None));
    }
    let tile = design.structure.tile().map_err(|error| design.refused(error))?;
    if let Some(tile) = &tile {
        design.structure = tile.structure.clone();
    }
    Ok((design, tile))
}

fn stopped(refusal: Refusal) -> BakeError {
    match refusal {
        Refusal::Other(FinishError::Fabric(FabricError::Cancelled)) => BakeError::Cancelled,
        refusal => refusal.into(),
    }
}

fn area(cloth: &Cloth, tile: Option<&Tile>, options: &Options) -> Area {
    let structure = &cloth.design().structure;
    match (options.area, tile) {
        (Some([low, size]), _) => Area { low, size, tiles: false },
        (None, Some(tile)) => {
            let [low, size] = tile.area_mm(structure);
            Area { low, size, tiles: true }
        }
        (None, None) => whole(structure, cloth.yarns()),
    }
}

/// All of a cloth, with what reaches beyond its wales and courses.
fn whole(structure: &Structure, yarns: &Yarns) -> Area {
    let extent = texere_render::Extent::of(yarns);
    let [low, high] = [extent.low, extent.high].map(|corner| [0, 1].map(|axis| f64::from(corner[axis])));
    let size = structure.size_mm();
    let [low, high] = [[0, 1].map(|axis| low[axis].min(0.0)), [0, 1].map(|axis| high[axis].max(size[axis]))];
    Area { low, size: [0, 1].map(|axis| high[axis] - low[axis]), tiles: false }
}

/// A lit picture of the face: its size in pixels, and red, green and blue of each.
fn preview(scene: &mut Scene, area: &Area) -> Result<([u32; 2], Vec<u8>), BakeError> {
    let longer = area.size[0].max(area.size[1]);
    let size = area.size.map(|side| (side / longer * PREVIEW).round().max(1.0) as u32);
    let [low, shown] = [area.low, area.size].map(|both| both.map(|mm| mm as f32));
    let camera = Camera::plan(scene.extent(), low, shown, size)?;
    let picture = scene.picture(&camera, Quality::default())?;
    Ok((size, picture.rgb))
}
