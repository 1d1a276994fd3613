//! Places: the positions of settling control points in whole units. With whole units, a cloth ten
//! metres from the origin comes to rest in the same way as one at the origin.

use bytemuck::{Pod, Zeroable};
use glam::{DVec3, IVec3, Vec3};

use crate::{ControlPoint, Halves};

/// The place and size of a settling control point.
///
/// Coordinates are whole multiples of a [`Scale`]'s unit. The difference of two places is exact,
/// however far they lie from the origin. A cloth that is moved by whole units comes to rest with
/// the same differences, to the bit.
///
/// **Shape**: three `i32` and two half floats, 16 bytes.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Pod, Zeroable)]
pub struct Place {
    /// x, y and z, in units from the scale's origin.
    pub at: [i32; 3],
    /// Half the yarn's width and half its height.
    pub halves: Halves,
}

impl Place {
    /// The coordinates as a vector of units.
    #[must_use]
    #[inline]
    pub const fn units(&self) -> IVec3 {
        IVec3::from_array(self.at)
    }

    /// This place, moved by `units`.
    #[must_use]
    #[inline]
    pub fn moved(self, units: IVec3) -> Self {
        Self { at: (self.units().wrapping_add(units)).to_array(), ..self }
    }

    /// `2 self - other`, the virtual end of an open yarn (the paper's equations 3 and 4). The
    /// virtual end has the thickness of `self`.
    #[must_use]
    #[inline]
    pub fn reflected(self, other: Self) -> Self {
        self.moved(self.units().wrapping_sub(other.units()))
    }
}

/// The unit of places, and their origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    unit: f32,
    origin: DVec3,
}

/// The finest unit, as a share of the thinnest yarn's diameter: a millionth.
const FINEST: f32 = 1.0 / (1 << 20) as f32;

/// The coarsest unit, as a share of the thinnest yarn's diameter. With this unit, places reach
/// 131,000 diameters to either side of the origin.
const COARSEST: f32 = 1.0 / (1 << 11) as f32;

/// The largest distance of a place from the origin, in units. Virtual ends may lie three times as
/// far, and the vector to them must fit an `i32`.
const REACH: f32 = (1 << 28) as f32;

impl Scale {
    /// The finest scale for places up to `extent` mm from `origin`. `diameter` is that of the
    /// thinnest yarn, mm. The unit is a power of two. `None` if it would be coarser than 1/2048 of
    /// the diameter.
    #[must_use]
    pub fn new(origin: DVec3, extent: f32, diameter: f32) -> Option<Self> {
        let power = |least: f32| least.log2().ceil().exp2();
        let unit = power(extent / REACH).max(power(diameter * FINEST));
        (unit <= diameter * COARSEST).then_some(Self { unit, origin })
    }

    /// The length of a unit, mm: a power of two.
    #[must_use]
    pub const fn unit(&self) -> f32 {
        self.unit
    }

    /// The origin of places, mm.
    #[must_use]
    pub const fn origin(&self) -> DVec3 {
        self.origin
    }

    /// The place of a control point.
    #[must_use]
    pub fn place(&self, point: &ControlPoint) -> Place {
        Place { at: self.units(point.position().as_dvec3() - self.origin).to_array(), halves: point.halves }
    }

    /// The control point at a place.
    #[must_use]
    pub fn point(&self, place: &Place) -> ControlPoint {
        let at = self.position(place.units()).as_vec3();
        ControlPoint { x: at.x, y: at.y, z: at.z, halves: place.halves }
    }

    /// The position `units` from the origin, mm.
    #[must_use]
    pub fn position(&self, units: IVec3) -> DVec3 {
        self.origin + units.as_dvec3() * f64::from(self.unit)
    }

    /// A vector in mm, converted to units and rounded.
    #[must_use]
    pub fn units(&self, way: DVec3) -> IVec3 {
        (way / f64::from(self.unit)).round().as_ivec3()
    }

    /// A step in mm, converted to units and rounded.
    #[must_use]
    #[inline]
    pub fn step(&self, step: Vec3) -> IVec3 {
        let units = step * (1.0 / self.unit);
        IVec3::from_array(units.to_array().map(|units| (units + 0.5).floor() as i32))
    }

    /// A vector in units, converted to mm.
    #[must_use]
    #[inline]
    pub fn length(&self, units: IVec3) -> Vec3 {
        units.as_vec3() * self.unit
    }
}
