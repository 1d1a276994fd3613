//! A design, read and checked.

use std::path::{self, Path, PathBuf};

use texere_contact::clearance;
use texere_core::{BackendError, Origin, Settings, YarnPlace, Yarns};
use texere_fabric::{FabricError, Finish, FinishError, Piece, Stretch, Structure};

use super::FilePlace;
use super::keys::Keys;
use super::knitted_from::KnittedFrom;
use super::machine_fault::MachineFault;
use super::named_place::NamedPlace;
use super::program_place::ProgramPlace;
use super::refusal::Refusal;

/// In cloth with more control points than this, the most crowded place is not looked for. With this
/// number the search takes up to a second.
const CROWDED_POINTS: usize = 1 << 18;

/// A design, read and checked.
///
/// ```no_run
/// let design = texere_formats::read("designs/herringbone.wif")?;
/// println!("{}: {} yarns", design.name, design.yarns()?.layout().yarns().len());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Design {
    /// The title of the design, or else the name of its file.
    pub name: String,
    /// The structure that the design describes.
    pub structure: Structure,
    /// Whether the yarns come to rest ([`Design::rest`]) before they are used. [`Design::yarns`]
    /// gives the yarns as the structure places them in either case.
    pub settle: bool,
    /// How the yarns settle.
    pub finish: Finish,
    /// How woven cloth is stretched before it comes to rest: [`Structure::stretch`].
    pub stretch: Option<Stretch>,
    remarks: Vec<String>,
    files: Vec<PathBuf>,
    knitted_from: Option<KnittedFrom>,
    faults: Vec<MachineFault>,
    keys: Keys,
}

impl Design {
    /// A design that a program makes itself, without a file. Its yarns settle.
    ///
    /// ```
    /// use texere_core::{Material, Section};
    /// use texere_fabric::{Relief, Structure, Thread, Weave, Woven, WovenDesign};
    /// use texere_formats::Design;
    /// let thread = Thread::new(1.0, 0.2);
    /// let plain = Weave::parse("plain")?.drawdown(8, 6)?;
    /// let cloth =
    ///     Woven::new(plain, vec![thread; 8], vec![thread; 6], vec![Material::default()], vec![Section::Circle])?;
    /// let design = Design::of("Muslin", Structure::Woven(WovenDesign::new(cloth, None, Relief::Report)?));
    /// assert!(design.settle && design.files().is_empty());
    /// # Ok::<(), texere_fabric::FabricError>(())
    /// ```
    #[must_use]
    pub fn of(name: impl Into<String>, structure: Structure) -> Self {
        Self::new(name.into(), structure, Vec::new())
    }

    /// A design of yarns that a file holds, such as saved cloth or curves. Its name is that of the
    /// file. The yarns stay as they are, unless [`Design::settle`] is set.
    ///
    /// ```
    /// use texere_core::{ControlPoint, Yarn, Yarns};
    /// use texere_fabric::Piece;
    /// use texere_formats::Design;
    /// let mut yarns = Yarns::builder();
    /// yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
    /// let design = Design::of_file("scans/braid.bcc", Piece::cut(yarns.build()?));
    /// assert!(design.name == "braid" && !design.settle);
    /// # Ok::<(), texere_core::YarnError>(())
    /// ```
    #[must_use]
    pub fn of_file(path: impl AsRef<Path>, piece: Piece) -> Self {
        let file = path.as_ref();
        let name = file.file_stem().unwrap_or(file.as_os_str()).to_string_lossy().into_owned();
        let keys = Keys { file: file.into(), ..Keys::default() };
        Self::of(name, Structure::Yarns(piece)).left().keyed(keys).read_from(&[file.into()])
    }

    /// A design whose yarns settle.
    pub(super) fn new(name: String, structure: Structure, mut remarks: Vec<String>) -> Self {
        remarks.extend(structure.pieces().said());
        Self {
            name,
            structure,
            settle: true,
            finish: Finish::default(),
            stretch: None,
            remarks,
            files: Vec::new(),
            knitted_from: None,
            faults: Vec::new(),
            keys: Keys::default(),
        }
    }

    /// The design with the settings of its `[finish]`.
    pub(super) fn finished(self, settle: Option<bool>, finish: Finish, stretch: Option<Stretch>) -> Self {
        Self { settle: settle.unwrap_or(self.settle), finish, stretch, ..self }
    }

    /// The design with its yarns left where the structure places them.
    pub(super) fn left(self) -> Self {
        Self { settle: false, ..self }
    }

    /// The design with more remarks.
    pub(super) fn remarking(mut self, remarks: Vec<String>) -> Self {
        self.remarks.extend(remarks);
        self
    }

    /// The design with the program that it is knitted from, and that program's faults.
    pub(super) fn knitted(self, from: KnittedFrom, faults: Vec<MachineFault>) -> Self {
        Self { knitted_from: Some(from), faults, ..self }
    }

    /// The knitting program of a weft knit, with the file that it comes from. None for other
    /// designs, and for a knit that was not read but made with [`Design::of`].
    pub(crate) const fn knitted_from(&self) -> Option<&KnittedFrom> {
        self.knitted_from.as_ref()
    }

    /// The design with the keys of its file. If the design has keys already, they are those of a
    /// draft that the file names.
    pub(super) fn keyed(self, keys: Keys) -> Self {
        let named = (!self.keys.lines.is_empty()).then(|| Box::new(self.keys));
        Self { keys: Keys { named, ..keys }, ..self }
    }

    /// Adds the file, line and key to an error of the structure, or of its coming to rest. Errors
    /// of [`Structure`]'s methods and of [`Design::yarns`] name threads and bars only.
    ///
    /// ```no_run
    /// let design = texere_formats::read("designs/jersey.toml")?;
    /// let yarns = design.yarns().map_err(|error| design.refused(error))?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn refused(&self, error: impl Into<FinishError>) -> Refusal {
        let source = error.into();
        if source.subject().is_none() {
            return Refusal::Other(source);
        }
        let crowded = match &source {
            FinishError::Backend(BackendError::Crowded { .. }) => self.crowded(),
            _ => None,
        };
        let place = crowded.or_else(|| self.keys.place(&source, |thread| self.yarn_of(thread)));
        match (place, self.keys.file()) {
            (Some(place), _) => Refusal::Key { place, source },
            (None, Some(file)) => Refusal::File { file: file.into(), source },
            (None, None) => Refusal::Other(source),
        }
    }

    /// The line of a knitout file that makes the yarn in the most crowded place, or at the worst
    /// contact if no place is crowded. None if the design is not knitted from a knitout file, and
    /// for cloth with more than [`CROWDED_POINTS`] control points.
    fn crowded(&self) -> Option<FilePlace> {
        let (from, yarns) = (self.knitted_from.as_ref()?, self.yarns().ok()?);
        if yarns.points().len() > CROWDED_POINTS {
            return None;
        }
        let found = clearance(&yarns, &Settings::of(&yarns)).ok()?;
        let nearest = || found.worst.first().map(|contact| contact.places[0]);
        from.line(found.crowd.map(|crowd| crowd.place).or_else(nearest)?.source?)
    }

    /// The name of the yarn of a thread.
    fn yarn_of(&self, thread: Origin) -> Option<String> {
        let number = |number: u32| number.checked_sub(1).map(|number| number as usize);
        let (materials, material) = match (&self.structure, thread) {
            (Structure::Woven(woven), Origin::End(end)) => {
                (woven.cloth().materials(), woven.cloth().warp().get(number(end)?)?.material)
            }
            (Structure::Woven(woven), Origin::Pick(pick)) => {
                (woven.cloth().materials(), woven.cloth().weft().get(number(pick)?)?.material)
            }
            (Structure::Weft(knit), Origin::Carrier(carrier)) => {
                (knit.materials(), knit.carriers().get(number(carrier)?)?.material)
            }
            (Structure::Warp(knit), Origin::Guide { bar, guide }) => {
                let yarn = knit.bars().get(number(bar)?)?.threading.yarn(guide.checked_sub(1)?)?;
                (knit.materials(), knit.guide_yarns().get(yarn as usize)?.material)
            }
            _ => return None,
        };
        materials.get(material as usize).map(|material| material.name.clone())
    }

    /// The design with the files that it was read from.
    pub(super) fn read_from(self, files: &[PathBuf]) -> Self {
        // Paths become absolute, because a program may change its folder later. If the present
        // folder is not known, a path stays as it is.
        let absolute = |file: &PathBuf| path::absolute(file).unwrap_or_else(|_| file.clone());
        Self { files: files.iter().map(absolute).collect(), ..self }
    }

    /// The files that the design was read from: its own file, and the images, draft or knitting
    /// program that it names. The list is empty for a design that was read [from
    /// memory](super::read_from). [`Output::sparing`](crate::write::Output::sparing) keeps a writer
    /// from replacing these files.
    #[must_use]
    pub fn files(&self) -> &[PathBuf] {
        &self.files
    }

    /// The faults of the program of a weft knit, at most three of each kind. The
    /// [`remarks`](Design::remarks) have them as well.
    #[must_use]
    pub fn faults(&self) -> &[MachineFault] {
        &self.faults
    }

    /// The place in a weft knit's program from which the yarn at a control point comes. `source` is
    /// that point's [source](Yarns::sources). None if the design has no program.
    #[must_use]
    pub fn program_place(&self, source: u32) -> Option<ProgramPlace> {
        self.knitted_from.as_ref().map(|from| from.program_place(source))
    }

    /// A place on one of `yarns` in a designer's words: thread, crossing or stitch, material, and
    /// place in the knitting program. `yarns` are the design's own, settled or not.
    ///
    /// **Panics** if `place` is past the last yarn.
    ///
    /// ```
    /// use texere_core::{Material, Section};
    /// use texere_core::YarnPlace;
    /// use texere_fabric::{Relief, Structure, Thread, Weave, Woven, WovenDesign};
    /// use texere_formats::Design;
    /// let thread = Thread::new(1.0, 0.2);
    /// let plain = Weave::parse("plain")?.drawdown(8, 6)?;
    /// let cotton = vec![Material { name: "cotton".into(), ..Material::default() }];
    /// let cloth = Woven::new(plain, vec![thread; 8], vec![thread; 6], cotton, vec![Section::Circle])?;
    /// let design = Design::of("Muslin", Structure::Woven(WovenDesign::new(cloth, None, Relief::Report)?));
    /// let yarns = design.yarns()?;
    /// let places = (0..20).filter_map(|interval| YarnPlace::at(&yarns, 2, interval, 0.0));
    /// let said = places.map(|place| design.named(&yarns, &place).to_string()).collect::<Vec<_>>();
    /// assert!(said.contains(&"end 3 at pick 4, cotton".to_owned()));
    /// # Ok::<(), texere_fabric::FabricError>(())
    /// ```
    #[must_use]
    pub fn named(&self, yarns: &Yarns, place: &YarnPlace) -> NamedPlace {
        let material = yarns.layout().yarns()[place.yarn].material as usize;
        NamedPlace {
            thread: self.structure.place(yarns, place),
            material: yarns
                .materials()
                .get(material)
                .map(|material| material.name.clone())
                .unwrap_or_default(),
            program: place.source.and_then(|source| self.program_place(source)),
        }
    }

    /// Remarks of the reader: what it had to assume or leave out.
    #[must_use]
    pub fn remarks(&self) -> &[String] {
        &self.remarks
    }

    /// What a designer should know: the reader's [`remarks`](Design::remarks), and the faults of
    /// the structure as placed ([`Structure::warnings`]).
    #[must_use]
    pub fn warnings(&self) -> Vec<String> {
        let warnings = self.structure.warnings();
        self.remarks.iter().cloned().chain(warnings.iter().map(ToString::to_string)).collect()
    }

    /// The yarns of the structure as it places them: [`Structure::yarns`].
    ///
    /// **Errors**: the errors of [`Structure::yarns`].
    pub fn yarns(&self) -> Result<Yarns, FabricError> {
        self.structure.yarns()
    }
}
