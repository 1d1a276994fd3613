//! Makes a texel from its samples.

use std::collections::HashMap;
use std::f32::consts::TAU;
use std::sync::OnceLock;

use glam::{DVec3, Vec3};
use texere_core::{Origin, Settings, YarnPlace, Yarns};
use texere_render::{Layers, surface_width};

use crate::Side;

/// The number of samples of a texel across, and the number down.
pub(crate) const SAMPLES: u32 = 4;

/// The number of rings of a yarn after which [`Layers::uv`] counts from 0 again.
const RINGS_COUNTED: usize = 8_192;

/// The sums over the samples of a texel that show yarn.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Texel {
    /// The number of samples that show yarn.
    pub(crate) seen: u32,
    color: Vec3,
    normal: Vec3,
    height: f32,
    /// The sum of α², where α is the width of the highlight of the yarn that a sample shows.
    width: f32,
    /// The number of the yarn in the texel's middle, plus 1. 0 stands for no yarn.
    pub(crate) yarn: u32,
    /// The place on the yarn in the texel's middle, as in [`Maps::uv`](crate::Maps::uv).
    pub(crate) uv: [f32; 2],
}

impl Texel {
    fn share(&self) -> f32 {
        1.0 / self.seen.max(1) as f32
    }

    pub(crate) fn color(&self) -> Vec3 {
        self.color * self.share()
    }

    /// The mean normal. Its length is below 1 if the normals differ.
    pub(crate) fn normal(&self) -> Vec3 {
        self.normal * self.share()
    }

    pub(crate) fn height(&self) -> f32 {
        self.height * self.share()
    }

    /// The width α of the texel's highlight. α² is the sum of the mean α² of the yarns that the
    /// texel shows, and of twice the variance of the texel's normals.
    pub(crate) fn width(&self) -> f32 {
        let length = self.normal().length().clamp(1e-3, 1.0);
        (self.width * self.share() + 2.0 * (1.0 - length) / length).sqrt()
    }
}

/// The looks of all yarns.
pub(crate) struct Look<'a> {
    yarns: &'a Yarns,
    subdivisions: usize,
    /// The sign of x and z: 1 for the face, and -1 for the back, which is turned over.
    over: f32,
    /// For each yarn: the place of its origin and material in `numbered`, its colour, and α², where
    /// α is the width of its highlight.
    each: Vec<(u32, Vec3, f32)>,
    /// The origin and material that each number stands for.
    numbered: Vec<(Origin, u32)>,
    /// The middle of each ring of each yarn, and its distance along the yarn, mm. Yarns that are
    /// not seen are not measured.
    rings: Vec<OnceLock<Vec<(DVec3, f32)>>>,
}

impl<'a> Look<'a> {
    pub(crate) fn new(
        yarns: &'a Yarns,
        settings: &Settings,
        side: Side,
        origin: impl Fn(Origin) -> Origin,
    ) -> Self {
        let (mut numbers, mut numbered) = (HashMap::new(), Vec::new());
        let each = yarns.layout().yarns().iter().enumerate().map(|(number, yarn)| {
            let made = (origin(yarn.origin), yarn.material);
            // Each yarn of unknown origin gets a number of its own.
            let known = if made.0 == Origin::Unknown { Some(number) } else { None };
            let number = *numbers.entry((made, known)).or_insert_with(|| {
                numbered.push(made);
                numbered.len() as u32 - 1
            });
            let color = Vec3::from(yarns.materials()[yarn.material as usize].linear_rgb());
            // `surface_width` is the root of the mean square slope, and α² is twice that mean.
            (number, color, 2.0 * surface_width(yarn).powi(2))
        });
        let each = each.collect();
        let rings = yarns.layout().yarns().iter().map(|_| OnceLock::new()).collect();
        let over = if side == Side::Front { 1.0 } else { -1.0 };
        Self { yarns, subdivisions: settings.subdivisions as usize, over, each, numbered, rings }
    }

    pub(crate) fn into_yarns(self) -> Vec<(Origin, u32)> {
        self.numbered
    }

    /// The texel at a column and a row of the piece that `layers` show.
    pub(crate) fn texel(&self, layers: &Layers, [column, row]: [u32; 2]) -> Texel {
        let mut texel = Texel::default();
        for y in 0..SAMPLES {
            for x in 0..SAMPLES {
                let [across, down] = [column * SAMPLES + x, row * SAMPLES + y];
                let at = down as usize * layers.size[0] as usize + across as usize;
                let yarn = layers.yarn[at];
                if yarn == Layers::NO_YARN {
                    continue;
                }
                let (number, color, width) = self.each[yarn as usize];
                let [right, up, toward] = layers.normal[at];
                texel.seen += 1;
                texel.color += color;
                texel.normal += Vec3::new(right * self.over, up, toward * self.over);
                texel.height += layers.position[at][2] * self.over;
                texel.width += width;
                if [x, y] == [SAMPLES / 2; 2] {
                    texel.yarn = number + 1;
                    texel.uv = self.uv(yarn as usize, layers.uv[at], layers.position[at]);
                }
            }
        }
        texel
    }

    /// The place on a yarn: the angle round it as a share of a turn, and the distance along it, mm.
    fn uv(&self, yarn: usize, [angle, along]: [f32; 2], position: [f32; 3]) -> [f32; 2] {
        let rings = self.rings[yarn].get_or_init(|| self.measured(yarn));
        let (whole, part) = (along.floor() as usize, along.fract());
        let position = DVec3::from(position.map(f64::from));
        let off = |ring: &usize| rings[*ring].0.distance_squared(position);
        let counted = (whole..rings.len()).step_by(RINGS_COUNTED);
        let Some(ring) = counted.min_by(|one, other| off(one).total_cmp(&off(other))) else {
            return [0.0; 2];
        };
        let (from, to) = (rings[ring].1, rings[(ring + 1).min(rings.len() - 1)].1);
        [angle / TAU, from + (to - from) * part]
    }

    /// The middle of each ring of a yarn, and its distance along the yarn, mm.
    fn measured(&self, yarn: usize) -> Vec<(DVec3, f32)> {
        let points = self.yarns.yarn_points(yarn).unwrap_or_default().len();
        let closed = self.yarns.layout().yarns()[yarn].closed;
        let intervals = if closed { points } else { points.saturating_sub(1) };
        let steps = self.subdivisions + 1;
        let place = |ring: usize| {
            let interval = (ring / steps).min(intervals.saturating_sub(1));
            let t = (ring - interval * steps) as f64 / steps as f64;
            YarnPlace::at(self.yarns, yarn, interval, t).map_or(DVec3::ZERO, |place| place.position.into())
        };
        let (mut along, mut before) = (0.0, None);
        (0..=intervals * steps)
            .map(|ring| {
                let middle = place(ring);
                along += before.map_or(0.0, |before: DVec3| before.distance(middle));
                before = Some(middle);
                (middle, along as f32)
            })
            .collect()
    }
}
