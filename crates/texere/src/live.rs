//! A fabric that is edited while its mesh stays on a device.

mod edits;
mod error;

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::Arc;

use glam::Vec3;
use texere_core::backend::{LiveMesh, Plan, SessionError};
use texere_core::{Backend, Change, ControlPoint, Material, Ray, Section, Settings, Yarn, Yarns};
use texere_cpu::{Hit, Picker};
use texere_fabric::{Loom, Structure, Woven};

pub use self::error::LiveError;

/// A fabric that is being edited, with its whole mesh on a device.
///
/// Lifts, yarns, control points and colours change one by one. [`Live::update`] makes again only
/// what has changed. The mesh is then equal to that of the edited fabric made from scratch. To undo
/// an edit, set the old value again.
///
/// Yarns lie as they are woven or knitted, not at rest. [`Live::set_rest`] takes yarns that have
/// come to rest in the meantime. A thread whose lift is set later lies as it is woven, among the
/// yarns at rest.
///
/// The first update makes the whole mesh. After it, and after any other update that is
/// [`anew`](Update::anew), ask for the mesh's buffers.
///
/// ```
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// use std::sync::Arc;
/// use texere::woven::{Thread, Weave, Woven};
/// use texere::yarn::{Material, Section};
/// use texere::{Live, Settings};
/// let (warp, weft) = (vec![Thread::new(1.0, 0.2); 40], vec![Thread::new(1.0, 0.2); 30]);
/// let twill = Weave::parse("2/2")?.drawdown(40, 30)?;
/// let cloth = Woven::new(twill, warp, weft, vec![Material::default()], vec![Section::Circle])?;
/// let mut live = Live::weave(Arc::from(texere::open("cpu")?), cloth, Settings::default())?;
/// assert!(live.update()?.anew); // the whole mesh
///
/// let up = live.woven().is_some_and(|cloth| cloth.drawdown().up(7, 3));
/// live.set_lift(7, 3, !up)?;
/// // End 8 and pick 4 were made again, and they alone.
/// let update = live.update()?;
/// assert!(!update.anew);
/// assert_eq!(update.changes.len(), 2);
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct Live {
    device: Arc<dyn Backend>,
    settings: Settings,
    source: Source,
    /// Yarns that replace yarns of the source, by number.
    set: BTreeMap<usize, SetYarn>,
    materials: Vec<Material>,
    mesh: LiveMesh,
    /// Whether a new mesh was begun since the last update.
    anew: bool,
    /// The picker. It is made for the first ray, and dropped when a new mesh is begun.
    picker: Option<Picker>,
}

/// A yarn that replaces a yarn of the source.
#[derive(Debug)]
struct SetYarn {
    what: Yarn,
    points: Vec<ControlPoint>,
    /// The sources of its control points, if they were given.
    sources: Option<Vec<u32>>,
    /// Its up direction at each control point, if up directions were given.
    ups: Option<Vec<Vec3>>,
    /// The yarn of the source that is replaced.
    before: Yarn,
}

/// The origin of the yarns.
#[derive(Debug)]
#[allow(clippy::large_enum_variant, reason = "a fabric has one source")]
enum Source {
    Loom(Loom),
    Given(Yarns),
}

/// The parts of a mesh that [`Live::update`] made again.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Update {
    /// The vertices and indices that were made again, chunk by chunk.
    pub changes: Vec<Change>,
    /// Whether a new mesh was made, in other buffers and with other chunks: in the first update,
    /// and for example after a yarn has outgrown its room.
    pub anew: bool,
}

impl Live {
    /// Starts with woven cloth, whose mesh is made on `device`.
    ///
    /// **Errors**: [`LiveError::Fabric`] if the cloth's yarns can't be made, and the errors of
    /// [`Live::given`].
    pub fn weave(device: Arc<dyn Backend>, cloth: Woven, settings: Settings) -> Result<Self, LiveError> {
        let yarns = cloth.yarns()?;
        let mesh = start(&*device, &yarns, settings)?;
        Ok(Self::of(device, settings, mesh, yarns.materials().to_vec(), Source::Loom(Loom::new(cloth))))
    }

    /// Starts with any structure, whose mesh is made on `device`: woven cloth by [`Live::weave`],
    /// knits by [`Live::given`].
    ///
    /// **Errors**: the errors of [`Live::weave`].
    pub fn new(
        device: Arc<dyn Backend>,
        structure: &Structure,
        settings: Settings,
    ) -> Result<Self, LiveError> {
        match structure.woven() {
            Some(design) => Self::weave(device, design.cloth().clone(), settings),
            None => Self::given(device, structure.yarns()?, settings),
        }
    }

    /// Starts with yarns of any origin, whose mesh is made on `device`.
    ///
    /// **Errors**: [`LiveError::Session`] if the mesh can't be planned, if it has no room on the
    /// device or can't be edited there, and for a device that fails.
    pub fn given(device: Arc<dyn Backend>, yarns: Yarns, settings: Settings) -> Result<Self, LiveError> {
        let mesh = start(&*device, &yarns, settings)?;
        Ok(Self::of(device, settings, mesh, yarns.materials().to_vec(), Source::Given(yarns)))
    }

    fn of(
        device: Arc<dyn Backend>,
        settings: Settings,
        mesh: LiveMesh,
        materials: Vec<Material>,
        source: Source,
    ) -> Self {
        let set = BTreeMap::new();
        Self { device, settings, source, set, materials, mesh, anew: true, picker: None }
    }

    /// The cloth as it is now, if the fabric is woven. Yarns that were [set](Live::set_yarn) have
    /// their new material, section and twist in this cloth, but lie as they are woven.
    #[must_use]
    pub const fn woven(&self) -> Option<&Woven> {
        match &self.source {
            Source::Loom(loom) => Some(loom.cloth()),
            Source::Given(_) => None,
        }
    }

    /// The mesh on the device. An edit changes its plan and its chunks at once, and its buffers at
    /// the next [`Live::update`].
    #[must_use]
    pub const fn mesh(&self) -> &LiveMesh {
        &self.mesh
    }

    /// The mesh on the device, to read it. After an edit the mesh can be read only once
    /// [`Live::update`] was called.
    pub const fn mesh_mut(&mut self) -> &mut LiveMesh {
        &mut self.mesh
    }

    /// Tension of the splines of all yarns, from 0 to below 1. Yarns that are edited keep it;
    /// [`Live::set_tension`] changes it.
    #[must_use]
    pub fn tension(&self) -> f32 {
        self.mesh.plan().layout().tension()
    }

    /// The materials that yarns refer to.
    #[must_use]
    pub fn materials(&self) -> &[Material] {
        &self.materials
    }

    /// Makes the parts of the mesh again that have changed since the last update. The call may
    /// return before the device is done. Later reads and draws wait for the device.
    ///
    /// **Errors**: [`LiveError::Session`] of the device. After an error the next update makes the
    /// same parts again.
    pub fn update(&mut self) -> Result<Update, LiveError> {
        let changes = self.mesh.update()?;
        Ok(self.updated(changes))
    }

    /// [`Live::update`], which ends early if `watch` answers `Break`, and returns that answer. The
    /// next update then makes the same parts. `watch` is called several times in each 50 ms.
    ///
    /// **Errors**: the errors of [`Live::update`].
    pub fn update_watched(
        &mut self,
        watch: &mut dyn FnMut() -> ControlFlow<()>,
    ) -> Result<ControlFlow<(), Update>, LiveError> {
        Ok(match self.mesh.update_watched(watch)? {
            ControlFlow::Continue(changes) => ControlFlow::Continue(self.updated(changes)),
            ControlFlow::Break(()) => ControlFlow::Break(()),
        })
    }

    fn updated(&mut self, changes: Vec<Change>) -> Update {
        Update { changes, anew: std::mem::take(&mut self.anew) }
    }

    /// Makes an [`Attribute`](crate::mesh::Attribute) for each vertex from the next update on, for
    /// shaders and textures. [`LiveMesh::read_attributes`] reads them, and GPU backends lend their
    /// buffers.
    pub fn keep_attributes(&mut self) {
        self.mesh.keep_attributes();
    }

    /// The first triangle that `ray` hits, or none. Edits count at once, before an update. The
    /// first ray makes a [`Picker`], which edits then keep up to date.
    ///
    /// **Errors**: the errors of [`Live::yarns`], and [`LiveError::Pick`] if there is no memory for
    /// the picker.
    ///
    /// ```
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// # use std::sync::Arc;
    /// # use texere::woven::{Thread, Weave, Woven};
    /// # use texere::yarn::{Material, Section};
    /// # use texere::{Live, Settings};
    /// use texere::mesh::Ray;
    /// use texere::yarn::YarnPlace;
    /// # let (warp, weft) = (vec![Thread::new(1.0, 0.2); 40], vec![Thread::new(1.0, 0.2); 30]);
    /// # let twill = Weave::parse("2/2")?.drawdown(40, 30)?;
    /// # let cloth = Woven::new(twill, warp, weft, vec![Material::default()], vec![Section::Circle])?;
    /// let mut live = Live::weave(Arc::from(texere::open("cpu")?), cloth, Settings::default())?; // of 40 ends and 30 picks
    /// let above = Ray { origin: [7.5, 3.5, 9.0], direction: [0.0, 0.0, -1.0] }; // end 8 and pick 4
    /// for up in [true, false] {
    ///     live.set_lift(7, 3, up)?;
    ///     let hit = live.pick(&above)?.ok_or("nothing is there")?;
    ///     assert_eq!(hit.place.yarn, if up { 7 } else { 43 });
    /// }
    ///
    /// // What a weaver calls the place; Design::named says it with the line of the design.
    /// let hit = live.pick(&above)?.ok_or("nothing is there")?;
    /// let pick = live.only(hit.place.yarn as usize)?; // its yarn alone, number 0
    /// let place = YarnPlace::at(&pick, 0, hit.interval as usize, hit.t).ok_or("no such place")?;
    /// let place = live.woven().ok_or("not woven")?.place(&pick, &place);
    /// assert_eq!(place.to_string(), "pick 4 at end 8");
    /// # Ok(())
    /// # }
    /// ```
    pub fn pick(&mut self, ray: &Ray) -> Result<Option<Hit>, LiveError> {
        let picker = match self.picker.take() {
            Some(picker) => picker,
            None => Picker::new(self.mesh.plan().clone(), self.yarns()?.points())?,
        };
        Ok(self.picker.insert(picker).pick(ray))
    }

    /// All yarns as they are now, with their [sources](Yarns::sources). Each control point of a
    /// yarn that was [set](Live::set_yarn) has the source of the old point at the same share of the
    /// yarn.
    ///
    /// **Errors**: [`LiveError::Fabric`] and [`LiveError::Yarns`] if the yarns can't be made.
    pub fn yarns(&self) -> Result<Yarns, LiveError> {
        self.yarns_with(self.mesh.plan().layout().sections())
    }

    /// All yarns as they are now, with these sections.
    fn yarns_with(&self, sections: &[Section]) -> Result<Yarns, LiveError> {
        let yarns = match &self.source {
            Source::Loom(loom) => loom.cloth().yarns()?,
            Source::Given(yarns) => yarns.clone(),
        };
        let mut offsets = vec![0];
        let (mut table, mut points) = (Vec::new(), Vec::with_capacity(yarns.points().len()));
        let mut sources = Vec::new();
        for (yarn, what) in yarns.layout().yarns().iter().enumerate() {
            let range = yarns.range(yarn).unwrap_or_default();
            let (own, told) = (&yarns.points()[range.clone()], yarns.sources().map(|all| &all[range]));
            let set = self.set.get(&yarn);
            let (what, own) = set.map_or((*what, own), |set| (set.what, &set.points[..]));
            self.tell(yarn, told, own.len(), &mut sources);
            table.push(what);
            points.extend_from_slice(own);
            offsets.push(points.len() as u64);
        }
        let layout = texere_core::Layout::new(table, offsets, sections.to_vec())?;
        let layout = layout.with_tension(self.tension())?;
        let all = Yarns::new(layout, self.materials.clone(), points)?;
        let all = if sources.len() == all.points().len() { all.with_sources(sources)? } else { all };
        let numbers = 0..all.layout().yarns().len();
        if !numbers.clone().any(|yarn| self.ups(yarn).is_some()) {
            return Ok(all);
        }
        let ups = numbers.flat_map(|yarn| self.standing_ups(yarn, &all, yarn)).collect();
        Ok(all.with_ups(ups)?)
    }

    /// Yarn number `yarn`, counted from 0, alone as it is now, with its sources. No other yarn is
    /// needed to name a place on it.
    ///
    /// **Errors**: [`LiveError::NoYarn`], and the errors of [`Live::yarns`].
    pub fn only(&self, yarn: usize) -> Result<Yarns, LiveError> {
        let layout = self.mesh.plan().layout();
        if yarn >= layout.yarns().len() {
            return Err(LiveError::NoYarn { yarn, yarns: layout.yarns().len() });
        }
        let (mut points, mut sources) = (Vec::new(), Vec::new());
        self.lay(yarn, &mut points);
        let told = match &self.source {
            Source::Loom(loom) => Some(loom.sources(yarn)),
            Source::Given(yarns) => {
                yarns.sources().zip(yarns.range(yarn)).map(|(all, range)| all[range].to_vec())
            }
        };
        self.tell(yarn, told.as_deref(), points.len(), &mut sources);
        let any_ups = (0..layout.yarns().len()).any(|yarn| self.ups(yarn).is_some());
        let (table, offsets) = (vec![self.yarn(yarn)], vec![0, points.len() as u64]);
        let layout = texere_core::Layout::new(table, offsets, layout.sections().to_vec())?;
        let layout = layout.with_tension(self.tension())?;
        let only = Yarns::new(layout, self.materials.clone(), points)?;
        let only = if sources.is_empty() { only } else { only.with_sources(sources)? };
        if !any_ups {
            return Ok(only);
        }
        let ups = self.standing_ups(yarn, &only, 0);
        Ok(only.with_ups(ups)?)
    }

    /// Adds the sources of yarn number `yarn`, which has `count` control points now, to `sources`.
    /// `told` are the sources that the yarn of that number has in `self.source`.
    fn tell(&self, yarn: usize, told: Option<&[u32]>, count: usize, sources: &mut Vec<u32>) {
        match (told, self.set.get(&yarn)) {
            (_, Some(SetYarn { sources: Some(said), .. })) => sources.extend_from_slice(said),
            (Some(told), _) => sources.extend((0..count).map(|point| told[point * told.len() / count])),
            (None, _) => {}
        }
    }

    /// Material, section, twist and origin of yarn number `yarn`.
    fn yarn(&self, yarn: usize) -> Yarn {
        match (self.set.get(&yarn), &self.source) {
            (Some(set), _) => set.what,
            (None, Source::Loom(loom)) => loom.yarn(yarn),
            (None, Source::Given(yarns)) => yarns.layout().yarns()[yarn],
        }
    }

    /// Writes the control points of yarn number `yarn` into `points`.
    fn lay(&self, yarn: usize, points: &mut Vec<ControlPoint>) {
        points.clear();
        match (self.set.get(&yarn), &self.source) {
            (Some(set), _) => points.extend_from_slice(&set.points),
            (None, Source::Loom(loom)) => loom.lay(yarn, points),
            (None, Source::Given(yarns)) => {
                points.extend_from_slice(yarns.yarn_points(yarn).unwrap_or_default());
            }
        }
    }

    /// Up directions of yarn number `yarn`, one for each control point, if it has any of its own.
    fn ups(&self, yarn: usize) -> Option<&[Vec3]> {
        match (self.set.get(&yarn), &self.source) {
            (Some(set), _) => set.ups.as_deref(),
            (None, Source::Loom(_)) => None,
            (None, Source::Given(yarns)) => Some(&yarns.ups()?[yarns.range(yarn)?]),
        }
    }

    /// Up directions of yarn number `yarn`, which is yarn number `number` of `yarns`: its own, else
    /// those that the layout of `yarns` gives it, else along z.
    fn standing_ups(&self, yarn: usize, yarns: &Yarns, number: usize) -> Vec<[f32; 3]> {
        let count = yarns.range(number).unwrap_or_default().len();
        let ups = self.ups(yarn).or_else(|| yarns.layout().ups(number));
        ups.map_or_else(|| vec![Vec3::Z.to_array(); count], |ups| ups.iter().map(Vec3::to_array).collect())
    }

    /// Begins a new mesh, of `yarns`. It has attributes if the mesh before kept them.
    fn begin(&mut self, yarns: &Yarns) -> Result<(), LiveError> {
        let mut mesh = start(&*self.device, yarns, self.settings)?;
        if self.mesh.keeps_attributes() {
            mesh.keep_attributes();
        }
        (self.mesh, self.anew, self.picker) = (mesh, true, None);
        Ok(())
    }
}

/// A mesh of `yarns`. Each yarn has room for an eighth more control points, and for sixteen on top
/// of that.
fn start(device: &dyn Backend, yarns: &Yarns, settings: Settings) -> Result<LiveMesh, LiveError> {
    let offsets = yarns.layout().offsets();
    let room = |yarn: usize| {
        let own = offsets[yarn + 1] - offsets[yarn];
        own + own / 8 + 16
    };
    let plan = Plan::with_room(yarns.layout().clone(), settings, room).map_err(SessionError::from)?;
    let mut mesh = LiveMesh::new(device, Arc::new(plan))?;
    mesh.upload(0, yarns.points())?;
    Ok(mesh)
}
