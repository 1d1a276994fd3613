//! Moves yarns, puts cloths together, and takes yarns out of a cloth.

use glam::Vec3;

use crate::{ControlPoint, Layout, Material, Section, Yarn, YarnError, Yarns};

/// A placement of a cloth: it is scaled, then turned, then moved.
///
/// A placement turns a cloth only in its own plane. [`Yarns::mapped`] turns a cloth about any axis,
/// and bends it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    /// Turn about z, from x towards y, rad.
    pub turn: f64,
    /// The factor of size, above 0.
    pub scale: f32,
    /// The new position of the cloth's origin, mm.
    pub at: [f32; 3],
}

impl Default for Placement {
    /// The identity.
    fn default() -> Self {
        Self { turn: 0.0, scale: 1.0, at: [0.0; 3] }
    }
}

impl Yarns {
    /// These yarns in another place. Sizes are multiplied by the scale, and twist per mm is divided
    /// by it, so that the mesh differs by the placement alone. If any yarn has [up
    /// directions](Layout::ups), all yarns of the placed cloth get up directions.
    ///
    /// **Errors**: the errors of [`Layout::new`] and [`Yarns::new`] if yarns exceed the limits of
    /// size, twist and position. An invalid scale or turn gives the same errors.
    ///
    /// ```
    /// use texere_core::{ControlPoint, Placement, Yarn, Yarns};
    /// # let mut yarns = Yarns::builder();
    /// # yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.125)));
    /// # let yarns = yarns.build()?;
    /// // A yarn of radius 0.125 mm from the origin to (2, 0, 0), twice as large and along y.
    /// let turn = std::f64::consts::FRAC_PI_2;
    /// let placed = yarns.placed(&Placement { turn, scale: 2.0, at: [5.0, 0.0, 0.0] })?;
    /// let end = placed.points()[2];
    /// assert_eq!((end.x, end.y, end.half_width()), (5.0, 4.0, 0.25));
    /// # Ok::<(), texere_core::YarnError>(())
    /// ```
    pub fn placed(&self, placement: &Placement) -> Result<Self, YarnError> {
        let Placement { turn, scale, at } = *placement;
        let ((sin, cos), scale_exact) = (turn.sin_cos(), f64::from(scale));
        let place = |point: &ControlPoint| {
            let [x, y, z] = [point.x, point.y, point.z].map(|at| f64::from(at) * scale_exact);
            let turned = [cos * x - sin * y, sin * x + cos * y, z];
            let [x, y, z] = [0, 1, 2].map(|axis| (turned[axis] + f64::from(at[axis])) as f32);
            let (half_width, half_height) = (point.half_width() * scale, point.half_height() * scale);
            ControlPoint { x, y, z, ..*point }.flattened(half_width, half_height)
        };
        let layout = self.layout();
        // Untwisted yarns stay untwisted at any scale.
        let twist = |twist: f32| if twist == 0.0 { 0.0 } else { twist / scale };
        let yarns = layout.yarns().iter().map(|yarn| Yarn { twist: twist(yarn.twist), ..*yarn }).collect();
        let layout = Layout::new(yarns, layout.offsets().to_vec(), layout.sections().to_vec())?;
        let layout = layout.with_tension(self.tension())?;
        let placed = Self::new(layout, self.materials().to_vec(), self.points().iter().map(place).collect())?;
        let placed = placed.with_sources_of([self])?;
        let turned = |up: &Vec3| {
            let [x, y] = [up.x, up.y].map(f64::from);
            [(cos * x - sin * y) as f32, (sin * x + cos * y) as f32, up.z]
        };
        // Up directions that the layout has worked out are turned, too. Nothing else says where the
        // height of a flattened yarn points if the yarn goes straight up.
        if self.layout().leans() {
            placed.with_ups(self.standing_ups().iter().map(turned).collect())
        } else {
            Ok(placed)
        }
    }

    /// All yarns of several cloths, one after the other. Equal materials and equal sections are
    /// kept once. [Sources](Yarns::with_sources) are kept if all cloths have them.
    ///
    /// **Errors**: [`YarnError::NoYarns`] for no cloths, [`YarnError::OtherTension`] if their
    /// splines differ in tension.
    ///
    /// ```
    /// use texere_core::{ControlPoint, Placement, Yarn, Yarns};
    /// # let mut yarns = Yarns::builder();
    /// # yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.125)));
    /// # let yarns = yarns.build()?;
    /// let beside = yarns.placed(&Placement { at: [0.0, 1.0, 0.0], ..Placement::default() })?;
    /// let both = Yarns::merged([&yarns, &beside])?;
    /// assert_eq!((both.layout().yarns().len(), both.materials().len()), (2, 1));
    /// assert_eq!(both.only([1])?.points(), beside.points());
    /// # Ok::<(), texere_core::YarnError>(())
    /// ```
    pub fn merged<'a>(cloths: impl IntoIterator<Item = &'a Self>) -> Result<Self, YarnError> {
        let cloths: Vec<_> = cloths.into_iter().collect();
        let tension = cloths.first().map_or(0.0, |cloth| cloth.tension());
        if let Some(other) = cloths.iter().find(|cloth| cloth.tension() != tension) {
            return Err(YarnError::OtherTension { given: other.tension(), tension });
        }
        let (mut materials, mut sections) = (Vec::<Material>::new(), Vec::<Section>::new());
        let (mut yarns, mut offsets, mut points) = (Vec::new(), vec![0], Vec::new());
        for cloth in &cloths {
            let layout = cloth.layout();
            let of_material: Vec<_> =
                cloth.materials().iter().map(|material| number_of(&mut materials, material)).collect();
            let of_section: Vec<_> =
                layout.sections().iter().map(|section| number_of(&mut sections, section)).collect();
            yarns.extend(layout.yarns().iter().map(|yarn| Yarn {
                material: of_material[yarn.material as usize],
                section: of_section[yarn.section as usize],
                ..*yarn
            }));
            let before = points.len() as u64;
            offsets.extend(layout.offsets()[1..].iter().map(|offset| before + offset));
            points.extend_from_slice(cloth.points());
        }
        let layout = Layout::new(yarns, offsets, sections)?.with_tension(tension)?;
        let merged = Self::new(layout, materials, points)?;
        let merged = merged.with_sources_of(cloths.iter().copied())?;
        if cloths.iter().all(|cloth| cloth.ups().is_none()) {
            return Ok(merged);
        }
        // If any cloth has up directions, yarns without any get those of their upright frames.
        let ups = cloths.iter().flat_map(|cloth| cloth.standing_ups());
        merged.with_ups(ups.map(|up| up.to_array()).collect())
    }

    /// A cloth of some of these yarns, in the order of `yarns`. Materials and sections keep their
    /// numbers.
    ///
    /// **Errors**: [`YarnError::UnknownYarn`], and [`YarnError::NoYarns`] for an empty list.
    pub fn only(&self, yarns: impl IntoIterator<Item = usize>) -> Result<Self, YarnError> {
        let (mut table, mut offsets) = (Vec::new(), vec![0]);
        let (mut points, mut sources, mut ups) = (Vec::new(), Vec::new(), Vec::new());
        for yarn in yarns {
            let all = self.layout().yarns();
            let range = self.range(yarn).ok_or(YarnError::UnknownYarn { yarn, yarns: all.len() })?;
            table.push(all[yarn]);
            points.extend_from_slice(&self.points()[range.clone()]);
            offsets.push(points.len() as u64);
            ups.extend(self.ups().iter().flat_map(|ups| &ups[range.clone()]).map(Vec3::to_array));
            sources.extend_from_slice(self.sources().map_or(&[], |sources| &sources[range]));
        }
        let layout = Layout::new(table, offsets, self.layout().sections().to_vec())?;
        let layout = layout.with_tension(self.tension())?;
        let only = Self::new(layout, self.materials().to_vec(), points)?;
        let only = if self.ups().is_some() { only.with_ups(ups)? } else { only };
        if self.sources().is_some() { only.with_sources(sources) } else { Ok(only) }
    }

    /// Adds the [sources](Yarns::with_sources) of the points of several cloths, one cloth after the
    /// other, if all cloths have sources.
    pub(crate) fn with_sources_of<'a>(
        self,
        cloths: impl IntoIterator<Item = &'a Self>,
    ) -> Result<Self, YarnError> {
        let sources: Option<Vec<_>> = cloths.into_iter().map(Self::sources).collect();
        match sources {
            Some(sources) => self.with_sources(sources.concat()),
            None => Ok(self),
        }
    }
}

/// The number of `item` among `items`, counted from 0. If `items` lacks it, it is added.
fn number_of<T: Clone + PartialEq>(items: &mut Vec<T>, item: &T) -> u32 {
    let number = items.iter().position(|known| known == item).unwrap_or_else(|| {
        items.push(item.clone());
        items.len() - 1
    });
    number as u32
}
