//! Measures that designers and mills ask for: yarn consumption, weight, thickness, crimp and cover
//! of woven cloth, loops of knits.

use std::ops::Range;

use rayon::prelude::*;
use texere_contact::lengths_mm;
use texere_core::definitions::{Segment, neighbours, tangent_factor};
use texere_core::{ControlPoint, Material, Yarns};

use crate::own::Own;
use crate::reach::{Reach, mean_reach};
use crate::woven::Sample;
use crate::yarn_size::INCH_MM;
use crate::{BySet, FabricError, Thread, Woven, tex_from_cotton_count};

/// Number of steps in each control interval at which the height is measured. The spline's height is
/// a cubic. A step lies within 1/64 of an interval of each turning point, and the error of the
/// height there grows with the square of that distance. With half the value, and with twice, no
/// test is red.
const SAMPLES: u32 = 32;

/// Number of cotton yarns of count Ne 1 that lie side by side in an inch.
///
/// **Source**: Peirce, "The geometry of cloth structure", Journal of the Textile Institute 28,
/// 1937.
const PEIRCE: f64 = 28.0;

/// Measures of a cloth and its yarns.
///
/// ```
/// use texere_core::{Material, Section};
/// use texere_fabric::{Measures, Thread, Weave, Woven};
/// let (thread, plain) = (Thread::new(0.5, 0.1), Weave::parse("plain")?.drawdown(20, 20)?);
/// let cotton = Material { tex: Some(30.0), ..Material::default() };
/// let cloth = Woven::new(plain, vec![thread; 20], vec![thread; 20], vec![cotton], vec![Section::Circle])?;
/// let measures = Measures::new(&cloth, &cloth.yarns()?)?;
/// // 20 threads a cm of 30 tex, both ways, and the crimp: 0.1 × 2 × 20 × 30 g/m² and a little more.
/// assert!((120.0..140.0).contains(&measures.areal_weight.unwrap_or(0.0)));
/// // Widths of control points are half floats, good to 2.5e-4.
/// assert!((measures.cover.unwrap().cloth / 0.64 - 1.0).abs() < 2.5e-4);
/// # Ok::<(), texere_fabric::FabricError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Measures {
    /// Length of yarn of each material, mm, in the order of the materials. Yarn beyond the edges of
    /// a knit does not count.
    pub length_mm: Vec<f64>,
    /// Crimp of woven cloth: length of yarn over length of cloth, less 1, in whole repeats. None
    /// for any other fabric. Turns at a selvedge count as weft. The crimp of a weft that turns
    /// therefore tells how much yarn the mill has to wind, and is more than the crimp of a pick
    /// without its turns.
    ///
    /// **Source**: BS 2863 and ISO 7211-3 define crimp in this way.
    pub crimp: Option<BySet<f64>>,
    /// The cover of woven cloth. None for any other fabric.
    pub cover: Option<Cover>,
    /// Measures of a knit. None for any other fabric.
    pub knit: Option<KnitMeasures>,
    /// Weight, g/m²: length × tex over the cloth's area. None if a material that is used has no
    /// tex, and for yarns that no structure made, whose cloth has no known area.
    pub areal_weight: Option<f64>,
    /// Thickness of the cloth without load, mm: from the lowest point of its yarns' surfaces to the
    /// highest.
    pub thickness_mm: f64,
}

/// Measures that only a knit has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KnitMeasures {
    /// Loops of the whole cloth.
    pub loops: u64,
    /// Wales and courses of the whole cloth.
    pub size: [u32; 2],
    /// Mean length of yarn in a loop, mm: the length of all yarn, floats included, over the number
    /// of loops.
    pub loop_length_mm: f64,
    /// Loops to the square centimetre.
    pub stitch_density: f64,
    /// The tightness factor: √tex over the loop length in cm. None if one of the yarns that are
    /// used has no tex, or if the yarns do not all have the same tex.
    ///
    /// **Source**: the tightness factor of the International Wool Secretariat; plain jersey has 11
    /// to 17, usually 14 to 15.
    pub tightness: Option<f64>,
}

/// The share of the cloth that its threads cover, seen from the face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cover {
    /// Peirce's cover factors: threads to the inch over √Ne. A factor is 28 times the share of the
    /// width that round cotton yarns of the same weight would cover. None if a material that is
    /// used has no tex.
    ///
    /// **Source**: Peirce 1937: K = n/√N, with n threads to the inch of the cotton count N (Ne).
    /// With K = 28, cotton threads touch side by side.
    pub factor: Option<BySet<f64>>,
    /// Peirce's cover factor of the cloth: K₁ + K₂ - K₁ K₂ / 28, with K₁ and K₂ the factors of warp
    /// and weft. None if [`Cover::factor`] is none.
    pub cloth_factor: Option<f64>,
    /// Share of the width that ends cover, and share of the length that picks cover: widths of
    /// sections over spacings, 1 at most.
    pub fraction: BySet<f64>,
    /// Share of the area that the two sets cover together: c₁ + c₂ - c₁ c₂, with c₁ and c₂ the
    /// [fractions](Cover::fraction) of warp and weft.
    pub cloth: f64,
}

impl Measures {
    /// Measures of a knit with `loops` loops, `size` wales and courses, and a width and height of
    /// `size_mm`. `own` gives the part of each yarn that counts for the cloth.
    pub(crate) fn of_knit(
        yarns: &Yarns,
        own: impl Fn(usize) -> Own + Sync,
        loops: u64,
        size: [u32; 2],
        size_mm: [f64; 2],
    ) -> Self {
        let all = 0..yarns.layout().yarns().len();
        let lengths: Vec<f64> = all.into_par_iter().map(|yarn| own(yarn).length_mm(yarns, yarn)).collect();
        let length_mm = lengths_by_material(yarns, &lengths);
        let area = size_mm[0] * size_mm[1];
        let loop_length_mm = length_mm.iter().sum::<f64>() / loops as f64;
        Self {
            crimp: None,
            cover: None,
            knit: Some(KnitMeasures {
                loops,
                size,
                loop_length_mm,
                stitch_density: loops as f64 / (area * 0.01),
                tightness: tex(&length_mm, yarns.materials()).map(|tex| tex.sqrt() / (loop_length_mm * 0.1)),
            }),
            areal_weight: weight_g(&length_mm, yarns.materials()).map(|grams| grams / (area * 1e-6)),
            length_mm,
            thickness_mm: thickness_within(yarns, |yarn| own(yarn).intervals()),
        }
    }

    /// Measures of yarns that no structure made: their lengths, and the thickness of all together.
    pub(crate) fn of_yarns(yarns: &Yarns) -> Self {
        Self {
            length_mm: lengths_by_material(yarns, &lengths_mm(yarns)),
            crimp: None,
            cover: None,
            knit: None,
            areal_weight: None,
            thickness_mm: thickness_mm(yarns),
        }
    }

    /// Measures a woven `cloth` and its `yarns`, which may be as woven or at rest. Crimp, cover and
    /// weight are measured in whole repeats, and the thickness from the lowest yarn to the highest.
    /// A small cloth whose yarns are as woven, and whose weft does not turn at selvedges, is
    /// measured as if more repeats lay around it. Its numbers are then those of a cloth of many
    /// repeats. Values that depend on tex are measured in repeats after which the tex of the yarns
    /// repeats, too. If the cloth has no whole repeat, all of it is measured.
    ///
    /// **Errors**: [`WovenError::OtherCloth`](crate::WovenError::OtherCloth) if `yarns` are not the
    /// cloth's yarns, and the errors of [`Woven::new`] and [`Woven::yarns`], because a small cloth
    /// is woven again with more repeats.
    pub fn new(cloth: &Woven, yarns: &Yarns) -> Result<Self, FabricError> {
        cloth.owns(yarns)?;
        let ratios = Sample::new(cloth, yarns)?.ratios();
        let (whole, size, sets) = (cloth.whole(), cloth.size_mm(), [cloth.warp(), cloth.weft()]);
        let mut length_mm = vec![0.0; yarns.materials().len()];
        for set in [0, 1] {
            for (thread, ratio) in sets[set].iter().zip(&ratios[set]) {
                length_mm[thread.material as usize] += ratio * size[1 - set];
            }
        }
        let crimp = |set: usize| {
            let (count, _) = whole[set];
            ratios[set][..count].iter().sum::<f64>() / count as f64 - 1.0
        };
        // tex is g/km, so that a thread of one tex in each mm weighs a gram in each m².
        let by_weight = cloth.whole_by_weight();
        let weights = [0, 1].map(|set| {
            let (count, extent) = by_weight[set];
            let threads = sets[set].iter().zip(&ratios[set]).take(count);
            let tex = |thread: &Thread| yarns.materials()[thread.material as usize].tex.map(f64::from);
            threads.map(|(thread, ratio)| Some(tex(thread)? * ratio / extent)).sum::<Option<f64>>()
        });
        Ok(Self {
            crimp: Some(BySet { warp: crimp(0), weft: crimp(1) }),
            cover: Some(Cover::of(cloth, yarns, whole, by_weight)),
            knit: None,
            areal_weight: weights.into_iter().sum(),
            length_mm,
            thickness_mm: thickness_mm(yarns),
        })
    }
}

impl Cover {
    /// The cover of `cloth`, from the mean widths of `yarns` and the spacings of the cloth's
    /// threads.
    ///
    /// **Errors**: [`WovenError::OtherCloth`](crate::WovenError::OtherCloth) if `yarns` are not the
    /// cloth's yarns.
    pub fn new(cloth: &Woven, yarns: &Yarns) -> Result<Self, FabricError> {
        cloth.owns(yarns)?;
        Ok(Self::of(cloth, yarns, cloth.whole(), cloth.whole_by_weight()))
    }

    /// The cover, measured in the numbers of threads that [`Woven::whole`] and
    /// [`Woven::whole_by_weight`] give.
    fn of(cloth: &Woven, yarns: &Yarns, whole: [(usize, f64); 2], by_weight: [(usize, f64); 2]) -> Self {
        let sets = [(cloth.warp(), whole[0]), (cloth.weft(), whole[1])]
            .map(|(set, (count, mm))| (&set[..count], mm));
        let turns = |threads: &[Thread], section: usize| {
            threads.iter().any(|thread| thread.twist != 0.0 && thread.section as usize == section)
        };
        // For each section, half its width when it lies level and, if twisted threads have this
        // section, its mean half width over all directions. A twisted thread shows one side of its
        // section after another.
        let widths: Vec<[f32; 2]> = (0..)
            .zip(yarns.layout().sections())
            .map(|(number, section)| {
                let twisted = sets.iter().any(|(threads, _)| turns(threads, number));
                [section.half_width(), if twisted { mean_reach(section) } else { 0.0 }]
            })
            .collect();
        let (mut taken, mut counted) = ([0.0; 2], [0; 2]);
        for (set, yarn) in cloth.yarns_of_threads() {
            counted[set] += 1;
            if counted[set] > whole[set].0 {
                continue;
            }
            let what = &yarns.layout().yarns()[yarn];
            let wide = widths[what.section as usize][usize::from(what.twist != 0.0)];
            let points = yarns.yarn_points(yarn).unwrap_or(&[]);
            taken[set] += 2.0 * f64::from(wide) * mean_half_width(points);
        }
        let fraction = [0, 1].map(|set| f64::min(taken[set] / sets[set].1, 1.0));
        // n / √N is added up thread by thread, because each thread has its own count.
        let factors =
            [(cloth.warp(), by_weight[0]), (cloth.weft(), by_weight[1])].map(|(set, (count, across))| {
                let threads = &set[..count];
                let root = |thread: &Thread| {
                    let tex = f64::from(cloth.materials()[thread.material as usize].tex?);
                    Some(1.0 / (tex_from_cotton_count(1.0) / tex).sqrt())
                };
                let sum: Option<f64> = threads.iter().map(root).sum();
                sum.map(|sum| sum / (across / INCH_MM))
            });
        let factor = if let [Some(warp), Some(weft)] = factors { Some(BySet { warp, weft }) } else { None };
        Self {
            factor,
            cloth_factor: factor.map(|BySet { warp, weft }| warp + weft - warp * weft / PEIRCE),
            cloth: fraction[0] + fraction[1] - fraction[0] * fraction[1],
            fraction: BySet::of(fraction),
        }
    }
}

/// Mean half width of a yarn over its length, mm. The length of an interval is taken as its chord.
fn mean_half_width(points: &[ControlPoint]) -> f64 {
    let add = |[sum, length]: [f64; 2], pair: &[ControlPoint]| {
        let chord = f64::from(pair[0].position().distance(pair[1].position()));
        let both = f64::from(pair[0].half_width()) + f64::from(pair[1].half_width());
        [sum + chord * both / 2.0, length + chord]
    };
    let [sum, length] = points.windows(2).fold([0.0; 2], add);
    if length > 0.0 {
        sum / length
    } else {
        points.first().map_or(0.0, |point| f64::from(point.half_width()))
    }
}

/// Length of yarn of each material, mm, in the materials' order. `lengths` are the yarns' lengths,
/// mm (see [`lengths_mm`]).
#[must_use]
pub fn lengths_by_material(yarns: &Yarns, lengths: &[f64]) -> Vec<f64> {
    let mut sums = vec![0.0; yarns.materials().len()];
    for (yarn, length) in yarns.layout().yarns().iter().zip(lengths) {
        sums[yarn.material as usize] += length;
    }
    sums
}

/// Weight (g) of the given lengths (mm) of materials. None if a material that is used has no tex.
#[must_use]
pub fn weight_g(lengths_mm: &[f64], materials: &[Material]) -> Option<f64> {
    let used = lengths_mm.iter().zip(materials).filter(|(length, _)| **length > 0.0);
    // tex is g/km: 1e6 mm.
    used.map(|(length, material)| Some(length * 1e-6 * f64::from(material.tex?))).sum()
}

/// Thickness from the lowest point of the yarns' surfaces to the highest, mm. A section without
/// twist stands upright. A twisted section turns through every direction, so its furthest reach
/// counts.
#[must_use]
pub fn thickness_mm(yarns: &Yarns) -> f64 {
    thickness_within(yarns, |_| 0..usize::MAX)
}

/// Width and height (along x and y) of the box round the control points of yarns and their half
/// widths, mm. Both are 0 without yarns.
pub(crate) fn size_mm(yarns: &Yarns) -> [f64; 2] {
    let sections = yarns.layout().sections();
    let mut box_mm = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    for (number, yarn) in yarns.layout().yarns().iter().enumerate() {
        let wide = f64::from(sections[yarn.section as usize].half_width());
        for point in yarns.yarn_points(number).unwrap_or(&[]) {
            let half = wide * f64::from(point.half_width());
            for (axis, place) in [point.x, point.y].map(f64::from).into_iter().enumerate() {
                box_mm[0][axis] = f64::min(box_mm[0][axis], place - half);
                box_mm[1][axis] = f64::max(box_mm[1][axis], place + half);
            }
        }
    }
    let [low, high] = box_mm;
    [0, 1].map(|axis| f64::max(high[axis] - low[axis], 0.0))
}

/// Thickness from the lowest point to the highest of the surfaces of a part of each yarn, mm. `own`
/// gives the numbers of the control points at which the intervals of the part begin.
fn thickness_within(yarns: &Yarns, own: impl Fn(usize) -> Range<usize> + Sync) -> f64 {
    let reaches: Vec<Reach> = yarns.layout().sections().iter().map(Reach::new).collect();
    let s = tangent_factor(yarns.tension());
    let extent = |yarn: usize| {
        let what = yarns.layout().yarns()[yarn];
        let reach = &reaches[what.section as usize];
        let [below, above] = if what.twist == 0.0 { reach.heights } else { [reach.furthest; 2] };
        let points = yarns.yarn_points(yarn).unwrap_or(&[]);
        let count = points.len();
        let intervals = if what.closed { count } else { count.saturating_sub(1) };
        let mut extent = [f64::INFINITY, f64::NEG_INFINITY];
        let own = own(yarn);
        for first in own.start..own.end.min(intervals) {
            let four = neighbours(points, what.closed, first);
            // The spline does not go beyond its Bézier polygon. Most intervals are skipped, because
            // by their polygon they can be neither the lowest nor the highest.
            let heights = bezier(&four.map(|point| point.z), s);
            let thickest = bezier(&four.map(|point| point.half_height()), s).into_iter().fold(0.0, f32::max);
            let lowest = heights.into_iter().fold(f32::INFINITY, f32::min) - thickest * below;
            let highest = heights.into_iter().fold(f32::NEG_INFINITY, f32::max) + thickest * above;
            if f64::from(lowest) >= extent[0] && f64::from(highest) <= extent[1] {
                continue;
            }
            let segment = Segment::new(&four, s);
            for k in 0..=SAMPLES {
                let sample = segment.sample(k as f32 / SAMPLES as f32);
                // A section stands at right angles to the centreline. Where the centreline climbs,
                // the section reaches less far up.
                let level = sample.tangent.truncate().length() * sample.half_height;
                extent[0] = extent[0].min(f64::from(sample.centre.z - level * below));
                extent[1] = extent[1].max(f64::from(sample.centre.z + level * above));
            }
        }
        extent
    };
    let [low, high] = (0..yarns.layout().yarns().len())
        .into_par_iter()
        .map(extent)
        .reduce(|| [f64::INFINITY, f64::NEG_INFINITY], |a, b| [a[0].min(b[0]), a[1].max(b[1])]);
    (high - low).max(0.0)
}

/// The Bézier polygon of one component of the spline between the middle two of four points.
fn bezier([before, start, end, after]: &[f32; 4], s: f32) -> [f32; 4] {
    [*start, start + (end - before) * s / 3.0, end - (after - start) * s / 3.0, *end]
}

/// The tex of the materials that are used, if they all have the same tex.
fn tex(length_mm: &[f64], materials: &[Material]) -> Option<f64> {
    let used = materials.iter().zip(length_mm).filter(|(_, length)| **length > 0.0);
    let mut tex = used.map(|(material, _)| material.tex.map(f64::from));
    let first = tex.next()??;
    tex.all(|other| other == Some(first)).then_some(first)
}
