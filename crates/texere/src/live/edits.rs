//! Edits of a live fabric: its materials, lifts, yarns, tension and structure.

use std::ops::Range;

use texere_core::backend::{Edits, SessionError};
use texere_core::{
    ControlPoint, Layout, Material, PlanError, Section, Yarn, YarnError, Yarns, check_material, check_points,
};
use texere_fabric::{Loom, Structure};

use super::{Live, LiveError, SetYarn, Source};

impl Live {
    /// Changes material number `number`, counted from 0. A mesh holds no colours, so nothing is
    /// made again.
    ///
    /// **Errors**: [`LiveError::NoMaterial`], and [`LiveError::Yarns`] for a material that no yarn
    /// can have. After an error the fabric is unchanged.
    pub fn set_material(&mut self, number: usize, material: Material) -> Result<(), LiveError> {
        let materials = self.materials.len();
        if number >= materials {
            return Err(LiveError::NoMaterial { material: number, materials });
        }
        check_material(number, &material)?;
        if let Source::Loom(loom) = &mut self.source {
            loom.set_material(number, material.clone())?;
        }
        self.materials[number] = material;
        Ok(())
    }

    /// Sets whether the warp is up at a crossing. `end` and `pick` are counted from 0. Errors count
    /// them from 1, as weavers do. If the lift changes, both threads then lie as they are woven,
    /// even if they were [set](Live::set_yarn) before.
    ///
    /// **Errors**: [`LiveError::NotWoven`], [`LiveError::Fabric`] for a crossing outside the cloth,
    /// [`LiveError::Session`] of the device, and the errors of [`Live::yarns`] and [`Live::given`]
    /// if a thread outgrows its room.
    pub fn set_lift(&mut self, end: usize, pick: usize, up: bool) -> Result<(), LiveError> {
        self.set_drawdown(end..end.saturating_add(1), pick..pick.saturating_add(1), |_, _| up)
    }

    /// Sets whether the warp is up at every crossing of `ends` and `picks`, which are counted from
    /// 0: [`Live::set_lift`] of many crossings at once. `up` takes the end and the pick.
    ///
    /// **Errors**: the errors of [`Live::set_lift`].
    pub fn set_drawdown(
        &mut self,
        ends: Range<usize>,
        picks: Range<usize>,
        up: impl Fn(usize, usize) -> bool,
    ) -> Result<(), LiveError> {
        let Source::Loom(loom) = &mut self.source else { return Err(LiveError::NotWoven) };
        let changed = loom.set_lifts(ends, picks, up)?;
        for yarn in &changed {
            if let Some(set) = self.set.remove(yarn) {
                loom.set_yarn(*yarn, &set.before)?;
            }
        }
        self.show_all(&changed)
    }

    /// Replaces yarn number `yarn`, counted from 0. `what` is its material, section and twist, and
    /// `points` are its control points, mm. If the yarn has [up directions of its
    /// own](Yarns::with_ups), it keeps them if it has as many control points as before, and loses
    /// them otherwise.
    ///
    /// **Errors**: [`LiveError::NoYarn`], [`LiveError::NoMaterial`], [`LiveError::Session`] or
    /// [`LiveError::Yarns`] for values that no yarn may have, [`LiveError::Session`] for a device
    /// that fails, and the errors of [`Live::yarns`] and [`Live::given`] if a new mesh is begun.
    pub fn set_yarn(&mut self, yarn: usize, what: Yarn, points: &[ControlPoint]) -> Result<(), LiveError> {
        let yarns = self.mesh.plan().layout().yarns().len();
        if yarn >= yarns {
            return Err(LiveError::NoYarn { yarn, yarns });
        }
        let (material, materials) = (what.material as usize, self.materials.len());
        if material >= materials {
            return Err(LiveError::NoMaterial { material, materials });
        }
        check_points(yarn, points).map_err(SessionError::from)?;
        let ups = self.ups(yarn).filter(|ups| ups.len() == points.len()).map(<[_]>::to_vec);
        let (points, before) = (points.to_vec(), self.before(yarn));
        self.set_all([(yarn, SetYarn { what, points, sources: None, ups, before })], None)
    }

    /// Gives yarn number `yarn`, counted from 0, other control points, mm. There may be more or
    /// fewer than before.
    ///
    /// **Errors**: the errors of [`Live::set_yarn`].
    pub fn set_points(&mut self, yarn: usize, points: &[ControlPoint]) -> Result<(), LiveError> {
        let yarns = self.mesh.plan().layout().yarns().len();
        if yarn >= yarns {
            return Err(LiveError::NoYarn { yarn, yarns });
        }
        self.set_yarn(yarn, self.yarn(yarn), points)
    }

    /// Sets the [tension](Live::tension) of the splines of all yarns, from 0 to below 1. The whole
    /// mesh is made again.
    ///
    /// ```
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// # use std::sync::Arc;
    /// # use texere::woven::{Thread, Weave, Woven};
    /// # use texere::yarn::{Material, Section};
    /// # use texere::{Live, Settings};
    /// # let (warp, weft) = (vec![Thread::new(1.0, 0.2); 40], vec![Thread::new(1.0, 0.2); 30]);
    /// # let twill = Weave::parse("2/2")?.drawdown(40, 30)?;
    /// # let cloth = Woven::new(twill, warp, weft, vec![Material::default()], vec![Section::Circle])?;
    /// let mut live = Live::weave(Arc::from(texere::open("cpu")?), cloth, Settings::default())?;
    /// live.set_tension(0.3)?;
    /// live.set_lift(7, 3, false)?; // its two yarns have splines of that tension, too
    /// assert_eq!(live.yarns()?.tension(), 0.3);
    /// assert!(live.update()?.anew);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// **Errors**: [`LiveError::Yarns`] for a tension outside \[0, 1), and the errors of
    /// [`Live::yarns`] and [`Live::given`]. After an error the fabric is unchanged.
    pub fn set_tension(&mut self, tension: f32) -> Result<(), LiveError> {
        let yarns = self.yarns()?.with_tension(tension)?;
        self.begin(&yarns)
    }

    /// Refuses yarns whose splines have another tension than the fabric's.
    fn check_tension(&self, yarns: &Yarns) -> Result<(), LiveError> {
        let [given, tension] = [yarns.tension(), self.tension()];
        if given == tension { Ok(()) } else { Err(YarnError::OtherTension { given, tension }.into()) }
    }

    /// Replaces the structure, such as by a knit with other stitches or a cloth with other threads.
    /// The tension of splines stays. Yarns that are the same in both structures are not made again.
    ///
    /// **Errors**: the errors of [`Live::new`].
    pub fn set_structure(&mut self, structure: &Structure) -> Result<(), LiveError> {
        self.set_yarns(structure.yarns()?.with_tension(self.tension())?)?;
        if let Some(design) = structure.woven() {
            self.source = Source::Loom(Loom::new(design.cloth().clone()));
        }
        Ok(())
    }

    /// Replaces all yarns. Yarns that do not change are not made again. From then on the fabric has
    /// no weave, and its lifts can't be set.
    ///
    /// **Errors**: [`LiveError::Yarns`] for yarns of another [tension](Live::tension), and the
    /// errors of [`Live::given`].
    pub fn set_yarns(&mut self, yarns: Yarns) -> Result<(), LiveError> {
        self.check_tension(&yarns)?;
        let (before, after) = (self.mesh.plan().layout().clone(), yarns.layout().clone());
        if before.yarns().len() != after.yarns().len() || before.sections() != after.sections() {
            self.begin(&yarns)?;
            self.materials = yarns.materials().to_vec();
            self.source = Source::Given(yarns);
            self.set.clear();
        } else {
            let mut old = Vec::new();
            let differs = |yarn: &usize| {
                self.lay(*yarn, &mut old);
                let ups = yarns.ups().map(|all| &all[yarns.range(*yarn).unwrap_or_default()]);
                (self.yarn(*yarn), Some(&old[..]), self.ups(*yarn))
                    != (after.yarns()[*yarn], yarns.yarn_points(*yarn), ups)
            };
            let changed: Vec<_> = (0..after.yarns().len()).filter(differs).collect();
            self.materials = yarns.materials().to_vec();
            self.source = Source::Given(yarns);
            self.set.clear();
            self.show_all(&changed)?;
        }
        Ok(())
    }

    /// Replaces all yarns by those of the same fabric at rest, and keeps the weave. Threads whose
    /// lifts are set later lie as they are woven, among the yarns at rest, until the next call.
    /// Yarns that do not change are not made again. If sections change, because plies have pressed
    /// into one another, a new mesh is begun.
    ///
    /// ```
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// use std::sync::Arc;
    /// use texere::woven::{Relief, Thread, Weave, Woven, WovenDesign};
    /// use texere::yarn::{Material, Section};
    /// use texere::{Design, Live, Settings, Structure};
    /// # let (warp, weft) = (vec![Thread::new(0.35, 0.15); 12], vec![Thread::new(0.35, 0.15); 8]);
    /// # let plain = Weave::parse("plain")?.drawdown(12, 8)?;
    /// # let cloth = Woven::new(plain, warp, weft, vec![Material::default()], vec![Section::Circle])?;
    /// let structure = Structure::Woven(WovenDesign::new(cloth, None, Relief::default())?);
    /// let design = Design::of("Dense plain weave", structure);
    /// let device = Arc::from(texere::open("cpu")?);
    /// // The cloth as it is woven is seen at once.
    /// let mut live = Live::new(Arc::clone(&device), &design.structure, Settings::default())?;
    /// live.set_rest(design.rest(&*device).run()?.yarns())?;
    /// live.set_lift(3, 2, true)?; // end 4 and pick 3 lie as woven
    /// live.update()?;
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// **Errors**: [`LiveError::OtherYarns`] if the numbers of yarns or of sections differ,
    /// [`LiveError::Yarns`] for yarns of another [tension](Live::tension), and the errors of
    /// [`Live::set_yarn`].
    pub fn set_rest(&mut self, rest: &Yarns) -> Result<(), LiveError> {
        self.check_tension(rest)?;
        let (layout, own) = (rest.layout(), self.mesh.plan().layout());
        let counts = |layout: &Layout| [layout.yarns().len(), layout.sections().len()];
        if counts(layout) != counts(own) {
            return Err(LiveError::OtherYarns {
                given: layout.yarns().len(),
                sections: layout.sections().len(),
                yarns: own.yarns().len(),
                own: own.sections().len(),
            });
        }
        let materials = self.materials.len();
        let (mut old, mut changed) = (Vec::new(), Vec::new());
        for (yarn, what) in layout.yarns().iter().enumerate() {
            let material = what.material as usize;
            if material >= materials {
                return Err(LiveError::NoMaterial { material, materials });
            }
            let range = rest.range(yarn).unwrap_or_default();
            let points = &rest.points()[range.clone()];
            let ups = rest.ups().map(|all| &all[range.clone()]);
            self.lay(yarn, &mut old);
            if (self.yarn(yarn), &old[..], self.ups(yarn)) != (*what, points, ups) {
                let sources = rest.sources().map(|all| all[range].to_vec());
                let (points, ups) = (points.to_vec(), ups.map(<[_]>::to_vec));
                let before = self.before(yarn);
                changed.push((yarn, SetYarn { what: *what, points, sources, ups, before }));
            }
        }
        let sections = (layout.sections() != own.sections()).then(|| layout.sections());
        self.set_all(changed, sections)
    }

    /// Material, section, twist and origin of the source's yarn number `yarn`.
    fn before(&self, yarn: usize) -> Yarn {
        self.set.get(&yarn).map_or_else(|| self.yarn(yarn), |set| set.before)
    }

    /// Replaces yarns of the source, and the sections of all yarns if `sections` are given: all of
    /// them, or none if that fails.
    fn set_all(
        &mut self,
        yarns: impl IntoIterator<Item = (usize, SetYarn)>,
        sections: Option<&[Section]>,
    ) -> Result<(), LiveError> {
        let (mut numbers, mut replaced) = (Vec::new(), Vec::new());
        for (yarn, set) in yarns {
            numbers.push(yarn);
            replaced.push(self.set.insert(yarn, set));
        }
        let shown = match sections {
            Some(sections) => self.yarns_with(sections).and_then(|yarns| self.begin(&yarns)),
            None => self.show_all(&numbers),
        };
        for (yarn, replaced) in numbers.into_iter().zip(replaced) {
            if shown.is_err() {
                match replaced {
                    Some(set) => self.set.insert(yarn, set),
                    None => self.set.remove(&yarn),
                };
            } else if let Source::Loom(loom) = &mut self.source {
                loom.set_yarn(yarn, &self.set[&yarn].what)?;
            }
        }
        shown
    }

    /// Updates `yarns` in the mesh, all at once. A new mesh is begun if the present one has no room
    /// for one of the yarns, or if one of them has up directions of its own.
    fn show_all(&mut self, yarns: &[usize]) -> Result<(), LiveError> {
        let (plan, mut laid) = (self.mesh.plan().clone(), Vec::with_capacity(yarns.len()));
        for &yarn in yarns {
            let (what, mut points) = (self.yarn(yarn), Vec::new());
            self.lay(yarn, &mut points);
            let edit = plan.check_edit(yarn, &what, points.len() as u64);
            // A plan allows no edit of a yarn with up directions of its own.
            if self.ups(yarn).is_some()
                || matches!(edit, Err(PlanError::NoRoom { .. } | PlanError::OtherPlan { .. }))
            {
                return self.begin(&self.yarns()?);
            }
            laid.push((yarn, what, points));
        }
        let edits: Edits<'_> =
            laid.iter().map(|(yarn, what, points)| (*yarn, (*what, &points[..]))).collect();
        self.mesh.set_yarns(&edits)?;
        // A picker that refuses the yarns is dropped, and another one is made for the next ray.
        let (plan, picker) = (self.mesh.plan().clone(), self.picker.take());
        self.picker = picker.and_then(|mut picker| picker.set_yarns(plan, &edits).ok().and(Some(picker)));
        Ok(())
    }
}
