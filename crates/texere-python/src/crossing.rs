//! The crossing or the stitch that each pixel of a picture shows.

use rayon::prelude::*;
use texere::Cloth;
use texere::picture::Layers;
use texere::yarn::YarnPlace;

use crate::watch;

/// [`Layers::uv`] counts the rings along a yarn modulo this number.
const RINGS: f64 = 8192.0;

/// How many pixels are done between two checks whether Python asks to stop. They take one core some
/// milliseconds.
const LOOKED: usize = 1 << 14;

/// The value of a pixel that shows no crossing and no stitch.
const NONE: [i32; 2] = [-1; 2];

/// The crossing (end, pick) or the stitch (wale, course) of each pixel, counted from 0. None if
/// `run` was stopped.
///
/// A pixel gets the crossing or the stitch of the control point that is nearest along the yarn. A
/// picked place is named by the same crossing or stitch. `subdivisions` is the setting of the mesh
/// whose rings the layers count.
pub(crate) fn crossings(
    cloth: &Cloth,
    subdivisions: u32,
    shown: &Layers,
    run: &watch::Run,
) -> Option<Vec<[i32; 2]>> {
    let mut crossings = vec![NONE; shown.yarn.len()];
    let is_whole = crossings.par_chunks_mut(LOOKED).enumerate().map(|(number, chunk)| {
        for (pixel, crossing) in (number * LOOKED..).zip(chunk) {
            if let Some(place) = place(cloth, subdivisions, shown, pixel) {
                *crossing = numbers(cloth, &place);
            }
        }
        run.tell(1.0).is_continue()
    });
    is_whole.all(|is_whole| is_whole).then_some(crossings)
}

/// The place on a yarn that a pixel shows. The layers give the number of its ring modulo [`RINGS`],
/// which may be the number of several rings. The one nearest to the pixel's position is taken. Caps
/// and single fibres have no ring. There the whole yarn is searched for the nearest place. None if
/// the pixel shows no yarn.
fn place(cloth: &Cloth, subdivisions: u32, shown: &Layers, pixel: usize) -> Option<YarnPlace> {
    let (yarn, position) = (shown.yarn[pixel], shown.position[pixel].map(f64::from));
    if yarn == Layers::NO_YARN {
        return None;
    }
    let (yarns, yarn, [angle, along]) = (cloth.yarns(), yarn as usize, shown.uv[pixel]);
    if [angle, along] == [0.0; 2] {
        return YarnPlace::nearest(yarns, yarn, position);
    }
    let open = usize::from(!yarns.layout().yarns().get(yarn)?.closed);
    let intervals = yarns.range(yarn)?.len() - open;
    let off = |place: &YarnPlace| {
        place.position.iter().zip(position).map(|(own, shown)| (own - shown).powi(2)).sum::<f64>()
    };
    let wraps = (0..).map(|wrap| (f64::from(along) + RINGS * f64::from(wrap)) / f64::from(subdivisions + 1));
    let places = wraps.take_while(|at| *at < intervals as f64).filter_map(|at| {
        let interval = at as usize;
        YarnPlace::at(yarns, yarn, interval, at - interval as f64)
    });
    let nearest = places.min_by(|one, other| off(one).total_cmp(&off(other)));
    nearest.or_else(|| YarnPlace::nearest(yarns, yarn, position))
}

/// The crossing or the stitch at a place, counted from 0, or [`NONE`].
fn numbers(cloth: &Cloth, place: &YarnPlace) -> [i32; 2] {
    let thread = cloth.design().structure.place(cloth.yarns(), place);
    let crossing = thread.crossing.map(|crossing| [crossing.end, crossing.pick]);
    let stitch = thread.stitch.map(|stitch| [stitch.wale, stitch.course]);
    crossing.or(stitch).map_or(NONE, |numbers| numbers.map(|number| number as i32 - 1))
}
