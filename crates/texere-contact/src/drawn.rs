//! Tubes as a mesh draws them: their width between rings, and triangles that are inside out.

use glam::{DQuat, DVec3};
use rayon::prelude::*;
use texere_core::backend::{PaddedPoints, Plan};
use texere_core::definitions::{Ring, Sample, Turn};
use texere_core::{Settings, TWIST_SUBDIVISIONS_MAX, YarnPlace, Yarns};

use crate::ContactError;

/// A tube is *wrung* if its width between two rings falls below this share of its width on the
/// rings. The two rings are then turned against one another by more than 120 degrees, two thirds of
/// the turn that leaves no width. With twice the value, `a_knit_is_told_as_woven_cloth_is` is red;
/// with half, no test is.
pub const WRUNG: f64 = 0.5;

/// Quality of a fabric's tubes between neighbouring rings of a mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drawn {
    /// The least width half way between two rings, as a share of the width on the rings, with bends
    /// straightened. It is the cosine of half the turn between neighbouring rings, so it is 1 if
    /// both have the same roll. Below [`WRUNG`] the tube is wrung.
    pub width: f64,
    /// The place of the least width.
    pub width_at: Option<YarnPlace>,
    /// Number of triangles that face inwards. They come from bends tighter than the section
    /// reaches.
    pub inwards: u64,
    /// The place of the first triangle that faces inwards.
    pub inwards_at: Option<YarnPlace>,
}

/// Measures the tubes of a mesh of `yarns` with `settings`, without caps. The measurement needs as
/// much memory as the yarns take.
///
/// **Errors**: [`ContactError::Settings`] for settings with which no mesh of `yarns` can be made,
/// and [`ContactError::OutOfMemory`].
///
/// ```
/// use texere_core::{ControlPoint, Settings, Yarn, Yarns};
/// // Three turns per mm and rings half a millimetre apart: each is turned by a turn and a half.
/// let mut yarns = Yarns::builder();
/// let twist = 3.0 * std::f32::consts::TAU;
/// yarns.yarn(Yarn { twist, ..Yarn::default() }, &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
/// let yarns = yarns.build()?;
/// let few = texere_contact::drawn(&yarns, &Settings::default())?;
/// assert!(few.width < 1e-3 && few.is_wrung());
/// let many = texere_contact::drawn(&yarns, &Settings { subdivisions: 15, ..Settings::default() })?;
/// assert!(many.width > 0.8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn drawn(yarns: &Yarns, settings: &Settings) -> Result<Drawn, ContactError> {
    // A polygon is drawn with its own number of sides.
    let settings = &Settings { sides: yarns.layout().corners().unwrap_or(settings.sides), ..*settings };
    let plan = Plan::new(yarns.layout().clone(), *settings)?;
    let mut points = PaddedPoints::new(&plan)?;
    points.upload(&plan, 0, yarns.points());
    let each = (0..yarns.layout().yarns().len()).into_par_iter().map(|yarn| along(&plan, &points, yarn));
    let worst = each.reduce(Found::default, Found::and);
    let place = |(yarn, ring): (usize, u32)| {
        let per_interval = settings.subdivisions + 1;
        let t = f64::from(ring % per_interval) / f64::from(per_interval);
        YarnPlace::at(yarns, yarn, (ring / per_interval) as usize, t)
    };
    Ok(Drawn {
        width: worst.width,
        width_at: worst.width_at.and_then(place),
        inwards: worst.inwards,
        inwards_at: worst.inwards_at.and_then(place),
    })
}

impl Drawn {
    /// Whether a tube is [wrung](WRUNG) anywhere.
    #[must_use]
    pub fn is_wrung(&self) -> bool {
        self.width < WRUNG
    }

    /// Whether no tube is wrung and no triangle faces inwards.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        !self.is_wrung() && self.inwards == 0
    }
}

/// The number of points between control points with which a mesh of `yarns` is
/// [sound](Drawn::is_sound), and the mesh's measures. The numbers that are tried are larger than
/// that of `settings`, and each halves the distance of the rings, up to [`TWIST_SUBDIVISIONS_MAX`]
/// points. The first that helps is returned, and none if no number does.
///
/// **Errors**: the errors of [`drawn`].
pub fn finer(yarns: &Yarns, settings: &Settings) -> Result<Option<(u32, Drawn)>, ContactError> {
    let mut subdivisions = settings.subdivisions;
    while subdivisions < TWIST_SUBDIVISIONS_MAX {
        // This many points halve the distance of the rings.
        subdivisions = (2 * subdivisions + 1).min(TWIST_SUBDIVISIONS_MAX);
        let found = drawn(yarns, &Settings { subdivisions, ..*settings })?;
        if found.is_sound() {
            return Ok(Some((subdivisions, found)));
        }
    }
    Ok(None)
}

/// Measures of part of the yarns, with places by yarn and ring.
#[derive(Debug, Clone, Copy)]
struct Found {
    width: f64,
    width_at: Option<(usize, u32)>,
    inwards: u64,
    inwards_at: Option<(usize, u32)>,
}

impl Default for Found {
    fn default() -> Self {
        Self { width: 1.0, width_at: None, inwards: 0, inwards_at: None }
    }
}

impl Found {
    /// Both measures together. If widths are equal, the lower yarn's place is kept.
    fn and(self, other: Self) -> Self {
        let narrower = if other.width < self.width { other } else { self };
        Self {
            width: narrower.width,
            width_at: narrower.width_at,
            inwards: self.inwards + other.inwards,
            inwards_at: self.inwards_at.or(other.inwards_at),
        }
    }
}

/// A ring with its vertices, relative to its centre.
struct Standing {
    centre: DVec3,
    tangent: DVec3,
    arms: Vec<DVec3>,
}

/// Measures all rings of a yarn.
fn along(plan: &Plan, points: &PaddedPoints, yarn: usize) -> Found {
    let outline = plan.outline(plan.yarn(yarn).section as usize);
    let mut found = Found::default();
    let mut before: Option<Standing> = None;
    each_ring(plan, points, yarn, |number, ring| {
        let (stance, [centre, tangent]) = (ring.stance(), [ring.centre, ring.tangent].map(wide));
        let arms = outline.iter().map(|point| wide(ring.vertex(&stance, point).position) - centre).collect();
        let here = Standing { centre, tangent, arms };
        if let Some(before) = &before {
            let (width, inwards) = between(before, &here);
            let at = Some((yarn, number - 1));
            let own = Found { width, width_at: at, inwards, inwards_at: at.filter(|_| inwards > 0) };
            found = found.and(own);
        }
        before = Some(here);
    });
    found
}

/// Calls `see` with each ring of a yarn, in order.
fn each_ring(plan: &Plan, points: &PaddedPoints, yarn: usize, mut see: impl FnMut(u32, &Ring)) {
    let (padded, rings, closed) = (points.yarn(plan, yarn), plan.rings(yarn), plan.yarn(yarn).closed);
    let (frame, twist) = (plan.frame(yarn), plan.turns_per_mm(yarn));
    let at = |ring| plan.sampling().sample(padded, ring, rings, closed);
    let walk = |see: &mut dyn FnMut(u32, &Sample, Turn)| {
        let (mut here, mut roll) = (at(0), Turn::ZERO);
        for ring in 0..rings {
            see(ring, &here.sample, roll);
            if ring + 1 < rings {
                let next = at(ring + 1);
                roll =
                    roll + frame.step(here.sample.tangent, next.sample.tangent, here.chord_to(&next), twist);
                here = next;
            }
        }
        roll
    };
    // The total turn of a closed yarn is spread over its rings, so that its last ring meets its
    // first.
    let whole = if closed && plan.turns(yarn) { walk(&mut |_, _, _| ()) } else { Turn::ZERO };
    walk(&mut |number, sample, roll| {
        let roll =
            if number + 1 == rings && closed { Turn::ZERO } else { roll - whole.share(number, rings - 1) };
        see(number, &plan.ring(yarn, number, sample, roll));
    });
}

/// The tube's width half way between two rings, and the number of its triangles that face inwards.
///
/// A triangle has an edge of the outline in the plane of one ring, and its third corner on the
/// other ring. Outlines go counter-clockwise about the tangent, so an edge crossed with the tangent
/// points out of the outline, wherever the axis lies. The triangle's normal is that edge crossed
/// with a vector between the rings: to the third corner if it lies on the next ring, and from it if
/// it lies on this ring. The triangle faces outwards if this vector and the tangent point to the
/// same side.
fn between(here: &Standing, next: &Standing) -> (f64, u64) {
    let carry = DQuat::from_rotation_arc(here.tangent, next.tangent);
    let (mut width, mut inwards) = (1.0_f64, 0);
    let sides = here.arms.len();
    for (point, (arm, other)) in here.arms.iter().zip(&next.arms).enumerate() {
        width = width.min((carry * *arm + *other).length() / (arm.length() + other.length()));
        let further = (point + 1) % sides;
        let to_next = next.centre - here.centre + *other;
        // The two triangles of a quad: one has its edge on this ring, the other on the next one.
        for (along, tangent) in [(to_next - *arm, here.tangent), (to_next - here.arms[further], next.tangent)]
        {
            inwards += u64::from(along.dot(tangent) < 0.0);
        }
    }
    (width, inwards)
}

fn wide(v: [f32; 3]) -> DVec3 {
    DVec3::from_array(v.map(f64::from))
}
