//! From what a draft says of its threads to the cloth.

use std::path::Path;

use texere_core::backend::room;
use texere_core::{Material, Section, counted};
use texere_fabric::{COTTON_LEAST_AREA, Drawdown, FabricError, Thread, Woven};

use crate::read::ReadError;
use crate::read::threads::only_used;

/// The spacing if the file gives none, mm: 10 threads to the centimetre.
const DEFAULT_SPACING_MM: f64 = 1.0;

/// The least distance of neighbouring threads in units of Peirce's least pitch, if the file does
/// not state how thick threads are and all are equal and evenly spaced. The value is 2/√3, the
/// distance in these units of threads whose diameter is half their spacing. The test
/// `what_is_given_room_does_not_pierce` shows that threads so far apart are clear of one another.
const ROOM: f64 = 1.154_700_538_379_251_5;

/// The least distance of neighbouring threads in units of Peirce's least pitch, if the file does
/// not state how thick threads are and they are uneven in spacing or thickness. This distance keeps
/// threads clear beside gaps of up to twelve times their pitch, and beside threads of a twelfth of
/// their diameter, as `what_is_given_room_does_not_pierce` tests.
const ROOM_UNEVEN: f64 = 1.85;

/// The share by which threads may lie closer than [`ROOM`] or [`ROOM_UNEVEN`] asks without becoming
/// thinner, because radii are rounded to `f32`.
const ROUNDING: f64 = 1e-6;

/// The share by which two spacings, two thicknesses, or a thickness and a spacing may differ and
/// still count as equal. Programs round them.
pub(crate) const ALIKE: f64 = 0.01;

/// The number of the material of threads without a colour.
const NO_COLOR: u32 = 0;

/// A colour of a draft, which is a material.
pub(crate) fn color(number: u32, srgb: [u8; 3]) -> Material {
    Material { name: format!("colour {number}"), srgb, ..Material::default() }
}

/// The warp's threads, or the weft's, as far as a file describes them. The lists have an item for
/// each thread.
#[derive(Debug)]
pub(crate) struct ThreadSet {
    /// Where the threads are, as warnings begin: `[WARP]` in WIF, else `in the warp`.
    pub(crate) place: &'static str,
    pub(crate) spacing_mm: Vec<Option<f64>>,
    pub(crate) thickness_mm: Vec<Option<f64>>,
    /// Whether the thicknesses are widths at which a program draws threads. They then give only the
    /// ratios of the diameters.
    pub(crate) drawn: bool,
    /// Numbers of materials.
    pub(crate) material: Vec<Option<u32>>,
}

/// What a draft says of its threads.
#[derive(Debug)]
pub(crate) struct DraftThreads {
    pub(crate) warp: ThreadSet,
    pub(crate) weft: ThreadSet,
    /// The colours. The first is that of threads without a colour.
    pub(crate) materials: Vec<Material>,
}

impl DraftThreads {
    /// The cloth of these threads.
    pub(crate) fn woven(
        self,
        file: &Path,
        drawdown: Drawdown,
        warnings: &mut Vec<String>,
    ) -> Result<Woven, ReadError> {
        let Self { warp, weft, materials } = self;
        // A set without a spacing of its own takes the other set's.
        let [warp_pitch, weft_pitch] = [&warp, &weft].map(|set| mean(&set.spacing_mm));
        let fallback = warp_pitch.or(weft_pitch).unwrap_or(DEFAULT_SPACING_MM);
        for (place, pitch) in [(warp.place, warp_pitch), (weft.place, weft_pitch)] {
            if pitch.is_none() {
                warnings.push(format!("{place} no spacing is given; {fallback:.4} mm is taken"));
            }
        }
        let diameter = warp_pitch.unwrap_or(fallback).min(weft_pitch.unwrap_or(fallback)) / 2.0;
        let is_drawn = warp.drawn || weft.drawn;
        let is_given = [&warp, &weft].iter().any(|set| mean(&set.thickness_mm).is_some());
        let mut warp = warp.threads(fallback, diameter, warnings)?;
        let mut weft = weft.threads(fallback, diameter, warnings)?;
        let (materials, sections) = only_used([&mut warp, &mut weft], &materials, &[Section::Circle]);
        let woven = if is_given && !is_drawn {
            Woven::new(drawdown, warp, weft, materials, sections)
        } else {
            roomy(drawdown, [warp, weft], materials, sections, warnings)
        };
        woven.map_err(|source| ReadError::fabric(file, source))
    }
}

/// The cloth of the threads `warp` and `weft`, for a file that does not state how thick they are.
/// If some threads have no room to cross, all are made thinner by one factor.
///
/// Many programs write the width at which they draw a thread, the whole of its spacing, as its
/// thickness. Threads of that thickness can't be woven, because threads that cross them have to
/// pass between them. A `Thickness` that equals the set's `Spacing`, or threads that together are
/// as wide as the set, therefore give only the ratios of thicknesses. The mean thickness is then
/// that of a file without thickness: half the mean spacing of the set that lies closer. Equal
/// threads, evenly spaced, are then 2/√3 times Peirce's least pitch apart
/// ([`texere_fabric::Pitch`]). Uneven threads may be closer.
fn roomy(
    drawdown: Drawdown,
    [warp, weft]: [Vec<Thread>; 2],
    materials: Vec<Material>,
    sections: Vec<Section>,
    warnings: &mut Vec<String>,
) -> Result<Woven, FabricError> {
    let woven = Woven::new(drawdown, warp, weft, materials, sections)?;
    let sets = woven.pitches().into_array();
    let even = sets.iter().all(|set| are_alike(set.iter().map(|pitch| pitch.pitch_mm)))
        && [woven.warp(), woven.weft()]
            .iter()
            .all(|set| are_alike(set.iter().map(|thread| thread.radius_mm.into())));
    let room = if even { ROOM } else { ROOM_UNEVEN };
    let needed =
        sets.iter().flatten().map(|pitch| (room * pitch.passing_mm).max(pitch.beside_mm) / pitch.pitch_mm);
    let needed = needed.fold(0.0, f64::max);
    if needed <= 1.0 + ROUNDING {
        return Ok(woven);
    }
    let factor = (1.0 / needed) as f32;
    warnings.push(format!(
        "some threads lie closer than most; all diameters are taken {factor:.4} times as large"
    ));
    let thinner = |set: &[Thread]| {
        set.iter().map(|thread| Thread { radius_mm: factor * thread.radius_mm, ..*thread }).collect()
    };
    let (warp, weft) = (thinner(woven.warp()), thinner(woven.weft()));
    Woven::new(woven.drawdown().clone(), warp, weft, woven.materials().to_vec(), woven.sections().to_vec())
}

/// Whether lengths are equal, but for rounding.
fn are_alike(lengths: impl Iterator<Item = f64> + Clone) -> bool {
    lengths.clone().fold(0.0, f64::max) <= (1.0 + ALIKE) * lengths.fold(f64::INFINITY, f64::min)
}

/// The mean of the lengths that are known, or none if none is known.
pub(crate) fn mean(lengths: &[Option<f64>]) -> Option<f64> {
    let (count, sum) =
        lengths.iter().flatten().fold((0, 0.0), |(count, sum), length| (count + 1, sum + length));
    (count > 0).then(|| sum / f64::from(count))
}

impl ThreadSet {
    /// The threads of the set. `spacing` and `diameter`, mm, are used where the file gives none.
    /// Thicknesses at which threads are drawn are scaled so that their mean is `diameter`.
    fn threads(
        self,
        spacing: f64,
        diameter: f64,
        warnings: &mut Vec<String>,
    ) -> Result<Vec<Thread>, ReadError> {
        let Self { place, drawn, .. } = self;
        let count = self.material.len();
        let threads = counted(count, "thread");
        let have = |count| if count == 1 { "has" } else { "have" };
        // Drawn thicknesses still give the ratios of the threads' diameters.
        let scale = mean(&self.thickness_mm).filter(|_| drawn).map_or(1.0, |drawn| diameter / drawn);
        let thin = self.thickness_mm.iter().filter(|thickness| thickness.is_none()).count();
        let plain = self.material.iter().filter(|material| material.is_none()).count();
        if drawn {
            warnings.push(format!(
                "{place} has threads as thick as they are spaced, which leaves those that cross no room; {diameter:.4} mm \
                 is taken, half the mean spacing, for their mean"
            ));
        } else if thin > 0 {
            warnings.push(format!(
                "{place} {thin} of {threads} {} no thickness; {diameter:.4} mm is taken, half the mean spacing", have(thin)
            ));
        }
        if plain > 0 {
            warnings.push(format!("{place} {plain} of {threads} {} no colour; undyed is taken", have(plain)));
        }
        // A thread without a spacing gets the mean of those that have one.
        let spacing = mean(&self.spacing_mm).unwrap_or(spacing);
        let mut all = room("threads", count)?;
        let each = self.spacing_mm.into_iter().zip(self.thickness_mm).zip(self.material);
        all.extend(each.map(|((own_spacing, thickness), material)| Thread {
            spacing_mm: own_spacing.unwrap_or(spacing),
            radius_mm: (thickness.map_or(diameter, |thickness| scale * thickness) / 2.0) as f32,
            flatness: 1.0,
            stiffness: 1.0,
            firmness: 1.0,
            least_area: COTTON_LEAST_AREA,
            material: material.unwrap_or(NO_COLOR),
            section: 0,
            twist: 0.0,
        }));
        Ok(all)
    }
}
