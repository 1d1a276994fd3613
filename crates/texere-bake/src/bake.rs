//! Bakes a design to maps.

use std::ops::ControlFlow;

use texere_core::{Backend, Origin, Settings, Yarns};
use texere_fabric::{FabricError, FinishError, Structure, Tile};
use texere_formats::{Cloth, Design, Refusal};
use texere_render::{Camera, Quality, Renderer, Scene};

use crate::{Area, BakeError, BakedCloth, Maps, Side};

/// The number of sides of the yarns' tubes. Polygon sections have a number of sides of their own.
/// The corners of a tube of 24 sides lie .009 radii further out than the middles of its sides. This
/// is less than a tenth of a texel of the usual size. With 6 sides, as in usual meshes, the maps of
/// the twill in the test `maps_look_like_the_geometry` differ from the geometry with 24 sides by a
/// mean FLIP of .15.
const SIDES: u32 = 24;

/// The number of texels across the mean radius of the yarns, if no size of texels is given.
const TEXELS_A_RADIUS: f64 = 8.0;

/// The most texels along the longer side of the maps, if no size of texels is given.
const SIDE_USUAL: f64 = 2048.0;

/// The longer side of the preview, pixels.
const PREVIEW: f64 = 512.0;

/// The share of the progress at which the yarns are at rest.
const RESTED: f64 = 0.4;
/// The share of the progress at which the face is baked.
const FRONT: f64 = 0.7;

/// What is baked, and how finely.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[non_exhaustive]
pub struct BakeOptions {
    /// The size of a texel, mm. If none is given, texels are an eighth of the mean radius of the
    /// yarns, or larger if the maps would otherwise have more than 2,048 texels along their longer
    /// side.
    pub texel_mm: Option<f64>,
    /// A rectangle of the cloth: its lower left corner, and its width and height, mm. The maps of a
    /// rectangle do not tile. If no rectangle is given, one repeat is baked, or the whole of a knit
    /// that does not repeat.
    pub area: Option<[[f64; 2]; 2]>,
    /// The tension of the yarns' splines, from 0 to below 1.
    pub tension: f32,
}

impl BakeOptions {
    /// **Errors**: [`BakeError::Area`], [`BakeError::Texel`].
    fn check(&self) -> Result<(), BakeError> {
        if let Some(mm) = self.texel_mm.filter(|mm| !(mm.is_finite() && *mm > 0.0)) {
            return Err(BakeError::Texel { mm });
        }
        match self.area {
            Some([low, size]) => Area { low, size, tiles: false }.check(),
            None => Ok(()),
        }
    }

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

/// Bakes a design. [`Design::rest`] brings its yarns to rest on `device`, and `renderer` draws
/// them. `progress` gets the share of the work that is done, from 0 to 1. `Break` ends the work.
///
/// **Errors**: [`BakeError`].
pub fn bake(
    design: Design,
    device: &dyn Backend,
    renderer: &Renderer,
    options: &BakeOptions,
    mut progress: impl FnMut(f64) -> ControlFlow<()> + Send,
) -> Result<BakedCloth, BakeError> {
    options.check()?;
    let name = design.name.clone();
    let (design, tile) = tiled(design, options)?;
    let rest = design.rest(device).tension(options.tension).progress(|share| progress(RESTED * share));
    let cloth = rest.run().map_err(stopped)?;
    let area = area(&cloth, tile.as_ref(), options);
    let (design, yarns) = cloth.into_parts();
    let measures = design.structure.measures(&yarns).map_err(|error| design.refused(error))?;

    let sides = yarns.layout().corners().unwrap_or(SIDES);
    let settings = Settings { sides, ..Settings::of(&yarns) }.following_fibres(&yarns);
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
    Ok(BakedCloth {
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

/// Gives the design the structure of a tile, and returns both. If the options ask for a rectangle,
/// or if the structure does not repeat, the design stays as it is, and there is no tile.
fn tiled(mut design: Design, options: &BakeOptions) -> Result<(Design, Option<Tile>), BakeError> {
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

fn area(cloth: &Cloth, tile: Option<&Tile>, options: &BakeOptions) -> Area {
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

/// The area of a whole cloth, with the yarn that reaches beyond its wales and courses.
fn whole(structure: &Structure, yarns: &Yarns) -> Area {
    let extent = texere_render::Extent::of(yarns);
    let [low, high] = [extent.low, extent.high].map(|corner| [0, 1].map(|axis| f64::from(corner[axis])));
    let size = structure.size_mm();
    let [low, high] = [[0, 1].map(|axis| low[axis].min(0.0)), [0, 1].map(|axis| high[axis].max(size[axis]))];
    Area { low, size: [0, 1].map(|axis| high[axis] - low[axis]), tiles: false }
}

/// A lit picture of the face: its width and height in pixels, and the red, green and blue of each
/// pixel.
fn preview(scene: &mut Scene, area: &Area) -> Result<([u32; 2], Vec<u8>), BakeError> {
    let longer = area.size[0].max(area.size[1]);
    let size = area.size.map(|side| (side / longer * PREVIEW).round().max(1.0) as u32);
    let [low, shown] = [area.low, area.size].map(|both| both.map(|mm| mm as f32));
    let camera = Camera::plan(scene.extent(), low, shown, size)?;
    let picture = scene.picture(&camera, Quality::default())?;
    Ok((size, picture.rgb))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test may panic")]

    use super::*;
    use texere_core::{Material, Section};
    use texere_cpu::ParallelBackend;
    use texere_fabric::weft::{Beds, Chart, Gauge, KnitYarn, Knitted, Machine};
    use texere_fabric::{Relief, Thread, Weave, Woven, WovenDesign};
    use texere_wgpu::{Schedule, WgpuBackend};

    fn twill() -> Structure {
        let drawdown = Weave::parse("2/1").unwrap().drawdown(6, 6).unwrap();
        let threads = |spacing: f64| {
            let thread = |number: u32| Thread { material: number % 2, ..Thread::new(spacing, 0.1) };
            (0..6).map(thread).collect::<Vec<_>>()
        };
        let materials =
            [[160, 40, 30], [230, 225, 210]].map(|srgb| Material { srgb, ..Material::default() }).to_vec();
        let cloth =
            Woven::new(drawdown, threads(0.31), threads(0.37), materials, vec![Section::Circle]).unwrap();
        Structure::Woven(WovenDesign::new(cloth, None, Relief::Report).unwrap())
    }

    fn tuck() -> Structure {
        let program = Chart::parse("kt\nkk", Beds::One).unwrap().program().unwrap();
        let stitches = Machine::default().knit(&program).unwrap().stitches;
        let (gauge, yarns) = (Gauge::new(0.9, 0.7), vec![KnitYarn::new(0.1)]);
        let materials = vec![Material::default()];
        Structure::Weft(
            Knitted::new(stitches, gauge, yarns, materials, vec![Section::Circle], [2, 2]).unwrap(),
        )
    }

    /// Bakes a tile twice, the second time with its area moved by `by` texels. Returns the share of
    /// the texels that differ between the two, at equal places of the cloth.
    fn moved(structure: &Structure, texel_mm: f64, by: [u32; 2], side: Side) -> f64 {
        let tile = structure.tile().unwrap().unwrap();
        let design = Design::of("tile", tile.structure.clone());
        let device = ParallelBackend::open().unwrap();
        let yarns = design.rest(&device).run().unwrap().into_parts().1;
        let [low, size] = tile.area_mm(&tile.structure);
        let area = Area { low, size, tiles: true };
        let device = WgpuBackend::open_named("llvmpipe", Schedule::PerRing).unwrap();
        let mut scene = Renderer::new(device).unwrap().scene(&yarns, &Settings::of(&yarns)).unwrap();
        let texels = area.texels(texel_mm).unwrap();
        let mut maps = |area: &Area| {
            let goes_on = |_| ControlFlow::Continue(());
            Maps::bake(&mut scene, &yarns, area, texels, side, |origin| tile.origin(origin), goes_on).unwrap()
        };
        let texel = [0, 1].map(|axis| size[axis] / f64::from(texels[axis]));
        let here = maps(&area);
        let there =
            maps(&Area { low: [0, 1].map(|axis| low[axis] + texel[axis] * f64::from(by[axis])), ..area });
        let [width, height] = texels;
        // Rows go down. Columns of the back go to the left in the cloth.
        let right = if side == Side::Front { by[0] } else { width - by[0] % width };
        let mut off = 0;
        for (at, (x, y)) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).enumerate() {
            let other = ((y + by[1]) % height * width + (x + width - right % width) % width) as usize;
            let angle =
                (0..3).map(|axis| (here.normal[at][axis] - there.normal[other][axis]).abs()).sum::<f32>();
            let is_full = here.alpha[at] == 1.0 && there.alpha[other] == 1.0;
            let is_off = (here.alpha[at] - there.alpha[other]).abs() > 0.07
                || is_full && (here.height[at] - there.height[other]).abs() > 1e-3
                || is_full && (here.occlusion[at] - there.occlusion[other]).abs() > 0.02
                || is_full && angle > 0.02
                || is_full
                    && here.yarns.get(here.yarn[at] as usize) != there.yarns.get(there.yarn[other] as usize);
            off += u32::from(is_off);
        }
        f64::from(off) / f64::from(width * height)
    }

    /// If a tile begins elsewhere, it has the same maps, moved round its edges. No texel shows
    /// where the tile begins. A few texels may differ: a sample on the edge of a yarn may fall to
    /// either side, and gaps take on what lies round them.
    #[test]
    fn a_tile_may_begin_anywhere() {
        // The last maps are drawn in more than one piece, both across and down.
        for (name, structure, texel_mm, side, by) in [
            ("twill", twill(), 0.017, Side::Front, [23, 11]),
            ("tuck", tuck(), 0.017, Side::Front, [23, 11]),
            ("tuck", tuck(), 0.017, Side::Back, [5, 17]),
            ("twill", twill(), 0.006, Side::Back, [5, 17]),
        ] {
            let share = moved(&structure, texel_mm, by, side);
            assert!(share < 0.005, "{name}, {side:?}: {share} of the texels differ");
        }
    }
}
