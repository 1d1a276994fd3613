//! A cloth whose lifts are edited, and whose yarns are then placed anew one by one.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::sync::Arc;

use texere_core::{ControlPoint, Material, Yarn};

use super::Woven;
use super::path::Station;
use super::yarns::{Kind, Measured, Pass};
use crate::{FabricError, WovenError, yarn_check};

/// A cloth on the loom. Its lifts are changed one by one or in blocks, and only the yarns that a
/// change affects have to be placed anew.
///
/// The yarns equal those of [`Woven::yarns`] to the bit, and have the same numbers, as long as
/// [`Loom::set_yarn`] has not changed a thread. A lift changes the yarn of the end and the yarn of
/// the pick that cross there, and no other yarn.
///
/// ```
/// use texere_core::{Material, Section};
/// use texere_fabric::{Loom, Thread, Weave, Woven};
/// let (warp, weft) = (vec![Thread::new(1.0, 0.2); 6], vec![Thread::new(1.0, 0.2); 4]);
/// let plain = Weave::parse("plain")?.drawdown(6, 4)?;
/// let cloth = Woven::new(plain, warp, weft, vec![Material::default()], vec![Section::Circle])?;
/// let mut loom = Loom::new(cloth);
/// let up = loom.cloth().drawdown().up(2, 1);
/// // The end is yarn 2, and the picks come after six ends.
/// assert_eq!(loom.set_lift(2, 1, !up)?, [2, 7]);
/// let mut points = Vec::new();
/// loom.lay(7, &mut points);
/// assert_eq!(points, loom.cloth().yarns()?.yarn_points(7).unwrap_or_default());
/// # Ok::<(), texere_fabric::FabricError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Loom {
    cloth: Woven,
    measured: Measured,
    passes: Vec<Pass>,
    /// For each yarn, the range of its passes in `passes`. A pass is one end, or one pick with the
    /// turn that leads to it.
    yarns: Vec<Range<usize>>,
    /// The crossings along the path of the threads of each kind. Threads of one kind have one
    /// height and run in one direction. These tables are computed once, because they do not depend
    /// on lifts.
    paths: BTreeMap<Kind, Arc<[Station]>>,
}

impl Loom {
    /// Puts `cloth` on the loom.
    #[must_use]
    pub fn new(cloth: Woven) -> Self {
        let (measured, passes) = (cloth.measured(), cloth.passes());
        let starts: Vec<_> = (0..passes.len()).filter(|pass| !passes[*pass].turns()).collect();
        let ends = starts.iter().skip(1).copied().chain([passes.len()]);
        let yarns = starts.iter().zip(ends).map(|(start, end)| *start..end).collect();
        let mut paths = BTreeMap::new();
        for pass in &passes {
            let laying = cloth.laying(&measured);
            paths.entry(laying.kind(*pass)).or_insert_with(|| laying.stations(*pass));
        }
        Self { cloth, measured, passes, yarns, paths }
    }

    /// The cloth as it is now.
    #[must_use]
    pub const fn cloth(&self) -> &Woven {
        &self.cloth
    }

    /// Takes the cloth, as it is now, off the loom.
    #[must_use]
    pub fn into_cloth(self) -> Woven {
        self.cloth
    }

    /// Puts the warp up or down at a crossing; `end` and `pick` are counted from 0. Returns the
    /// numbers of the yarns that this changes. The list is empty if the crossing does not change.
    ///
    /// **Errors**: [`WovenError::NoCrossing`] for a crossing outside the cloth.
    pub fn set_lift(&mut self, end: usize, pick: usize, up: bool) -> Result<Vec<usize>, WovenError> {
        self.set_lifts(end..end.saturating_add(1), pick..pick.saturating_add(1), |_, _| up)
    }

    /// Puts the warp up or down at all crossings of some ends and picks, counted from 0. Returns
    /// the numbers of the yarns that this changes, in order.
    ///
    /// **Errors**: [`WovenError::NoCrossing`] if a crossing lies outside the cloth. After an error
    /// the cloth is unchanged.
    pub fn set_lifts(
        &mut self,
        ends: Range<usize>,
        picks: Range<usize>,
        up: impl Fn(usize, usize) -> bool,
    ) -> Result<Vec<usize>, WovenError> {
        let first_pick = self.cloth.warp().len();
        let drawdown = self.cloth.drawdown_mut();
        if ends.end > drawdown.ends() || picks.end > drawdown.picks() {
            // Errors count from 1, as weavers do.
            let (end, pick) = (ends.end, picks.end);
            return Err(WovenError::NoCrossing { end, pick, ends: drawdown.ends(), picks: drawdown.picks() });
        }
        let (mut changed_ends, mut changed_picks) = (BTreeSet::new(), BTreeSet::new());
        for pick in picks {
            for end in ends.clone() {
                let up = up(end, pick);
                if drawdown.up(end, pick) != up {
                    drawdown.set(end, pick, up)?;
                    changed_ends.insert(end);
                    changed_picks.insert(first_pick + pick);
                }
            }
        }
        let yarn = |pass: usize| self.yarns.partition_point(|passes| passes.end <= pass);
        let mut yarns: Vec<_> = changed_ends.into_iter().chain(changed_picks).map(yarn).collect();
        yarns.dedup();
        Ok(yarns)
    }

    /// Replaces the material with number `material`, counted from 0. No yarn moves.
    ///
    /// **Errors**: [`WovenError::NoMaterial`] past the last material.
    pub fn set_material(&mut self, material: usize, with: Material) -> Result<(), WovenError> {
        self.cloth.set_material(material, with)
    }

    /// Gives the threads of yarn number `yarn` the material, the section and the twist of `what`.
    /// No yarn moves.
    ///
    /// **Errors**: [`ThreadError`](crate::ThreadError) for a twist, a material or a section that
    /// [`Woven::new`] refuses. After an error the cloth is unchanged.
    ///
    /// **Panics** for a number past the last yarn.
    pub fn set_yarn(&mut self, yarn: usize, what: &Yarn) -> Result<(), FabricError> {
        for checking in [true, false] {
            for pass in &self.passes[self.yarns[yarn].clone()] {
                let thread = match *pass {
                    Pass::End(end) => &mut self.cloth.warp[end],
                    Pass::Pick(pick, _) => &mut self.cloth.weft[pick],
                };
                if checking {
                    let radius = thread.radius_mm;
                    yarn_check::yarn(what, radius, self.cloth.materials(), self.cloth.sections())?;
                } else {
                    (thread.material, thread.section, thread.twist) =
                        (what.material, what.section, what.twist);
                }
            }
        }
        Ok(())
    }

    /// Yarn number `yarn`, without its control points.
    ///
    /// **Panics** for a number past the last yarn.
    #[must_use]
    pub fn yarn(&self, yarn: usize) -> Yarn {
        self.cloth.yarn(&self.passes[self.yarns[yarn].start]).unwrap_or_default()
    }

    /// Places yarn number `yarn` of [`Woven::yarns`]. The yarn's control points replace the
    /// contents of `points`.
    ///
    /// **Panics** for a number past the last yarn.
    pub fn lay(&self, yarn: usize, points: &mut Vec<ControlPoint>) {
        points.clear();
        self.each_point(yarn, &mut |point, _| points.push(point));
    }

    /// Sources of the control points of yarn number `yarn`, equal to the
    /// [`Yarns::sources`](texere_core::Yarns::sources) of [`Woven::yarns`].
    ///
    /// **Panics** for a number past the last yarn.
    #[must_use]
    pub fn sources(&self, yarn: usize) -> Vec<u32> {
        let mut sources = Vec::new();
        self.each_point(yarn, &mut |_, source| sources.push(source));
        sources
    }

    fn each_point(&self, yarn: usize, take: &mut dyn FnMut(ControlPoint, u32)) {
        let laying = self.cloth.laying(&self.measured);
        for pass in &self.passes[self.yarns[yarn].clone()] {
            let path = laying.path(*pass, self.paths[&laying.kind(*pass)].clone());
            laying.lay(&path, *pass, &mut |point, source| take(point, source));
        }
    }
}
