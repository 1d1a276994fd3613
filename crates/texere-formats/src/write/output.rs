//! The target of a write, and the files that it must not replace.

use std::fs::{self, Metadata, OpenOptions};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use same_file::Handle;

use super::curve_format::CurveFormat;
use super::error::WriteError;
use super::format::Format;
use super::mesh_form::{Attributes, MeshForm, VertexAttribute};

/// The target of a write, and the files that it must not replace, such as those that the design was
/// read from.
///
/// A path alone is an output that replaces the file at that path. All writers take an output:
///
/// ```
/// use texere_formats::WriteError;
/// use texere_formats::write::{self, Output};
/// # let folder = tempfile::tempdir()?;
/// # let motif = folder.path().join("motif.png");
/// write::picture([1, 1], &[0; 3], &motif)?;
/// let error = write::picture([1, 1], &[9; 3], Output::to(&motif).sparing([&motif])).unwrap_err();
/// assert!(matches!(error, WriteError::Spared { .. }));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Output {
    path: PathBuf,
    spared: Vec<PathBuf>,
    form: Form,
    attributes: Attributes,
}

/// How a file is written, if its format has several ways.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Form {
    Plain,
    Packed,
    Compressed,
    KhrCompressed,
    Instanced,
    Linear,
}

impl Output {
    /// A file at `path`. If `path` is a symbolic link, the output is the file that the link leads
    /// to.
    pub fn to(path: impl AsRef<Path>) -> Self {
        let path = path.as_ref().to_owned();
        Self { path, spared: Vec::new(), form: Form::Plain, attributes: Attributes::default() }
    }

    /// Does not replace any of `files`, even under another name: another spelling, a hard link or a
    /// symbolic link. The files of a design are [`Design::files`](crate::Design::files). Further
    /// calls add files.
    #[must_use]
    pub fn sparing(mut self, files: impl IntoIterator<Item = impl AsRef<Path>>) -> Self {
        self.spared.extend(files.into_iter().map(|file| file.as_ref().to_owned()));
        self
    }

    /// Packs a mesh as [`Format::PackedGlb`]. The path has to end in `.glb`.
    ///
    /// ```
    /// use texere_core::{ControlPoint, Pipeline, Yarn, Yarns};
    /// use texere_cpu::ParallelBackend;
    /// use texere_formats::write::{self, Output};
    /// # let folder = tempfile::tempdir()?;
    /// # let [plain, packed] = ["plain.glb", "packed.glb"].map(|name| folder.path().join(name));
    /// let mut yarns = Yarns::builder();
    /// let points: Vec<_> = (0..200).map(|step| ControlPoint::new(step as f32, 0.0, 0.0, 0.1)).collect();
    /// yarns.yarn(Yarn::default(), &points);
    /// let mesh = Pipeline::new(&yarns.build()?).sides(12).mesh(&ParallelBackend::open()?)?;
    /// write::mesh(&mesh, &plain)?;
    /// write::mesh(&mesh, Output::to(&packed).packed())?;
    /// let [plain, packed] = [plain, packed].map(|file| std::fs::metadata(file).unwrap().len());
    /// assert!(packed < plain);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn packed(mut self) -> Self {
        self.form = Form::Packed;
        self
    }

    /// Packs and compresses a mesh as [`Format::CompressedGlb`]. The path has to end in `.glb`.
    ///
    /// ```
    /// use texere_core::{ControlPoint, Pipeline, Yarn, Yarns};
    /// use texere_cpu::ParallelBackend;
    /// use texere_formats::write::{self, Output};
    /// # let folder = tempfile::tempdir()?;
    /// # let [packed, compressed] = ["packed.glb", "compressed.glb"].map(|name| folder.path().join(name));
    /// let mut yarns = Yarns::builder();
    /// let points: Vec<_> = (0..200).map(|step| ControlPoint::new(step as f32, 0.0, 0.0, 0.1)).collect();
    /// yarns.yarn(Yarn::default(), &points);
    /// let mesh = Pipeline::new(&yarns.build()?).sides(12).mesh(&ParallelBackend::open()?)?;
    /// write::mesh(&mesh, Output::to(&packed).packed())?;
    /// write::mesh(&mesh, Output::to(&compressed).compressed())?;
    /// let [packed, compressed] = [packed, compressed].map(|file| std::fs::metadata(file).unwrap().len());
    /// assert!(compressed < packed / 3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn compressed(mut self) -> Self {
        self.form = Form::Compressed;
        self
    }

    /// Packs and compresses a mesh as [`Format::KhrCompressedGlb`]. The path has to end in `.glb`.
    ///
    /// ```
    /// use texere_core::{ControlPoint, Pipeline, Yarn, Yarns};
    /// use texere_cpu::ParallelBackend;
    /// use texere_formats::write::{self, Output};
    /// # let folder = tempfile::tempdir()?;
    /// # let [ext, khr] = ["ext.glb", "khr.glb"].map(|name| folder.path().join(name));
    /// let mut yarns = Yarns::builder();
    /// let points: Vec<_> = (0..200).map(|step| ControlPoint::new(step as f32, 0.0, 0.0, 0.1)).collect();
    /// yarns.yarn(Yarn::default(), &points);
    /// let mesh = Pipeline::new(&yarns.build()?).sides(12).mesh(&ParallelBackend::open()?)?;
    /// write::mesh(&mesh, Output::to(&ext).compressed())?;
    /// write::mesh(&mesh, Output::to(&khr).khr_compressed())?;
    /// let [ext, khr] = [ext, khr].map(|file| std::fs::metadata(file).unwrap().len());
    /// assert!(khr < ext);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn khr_compressed(mut self) -> Self {
        self.form = Form::KhrCompressed;
        self
    }

    /// Writes each part of a yarn once, however often it recurs, as [`Format::InstancedGlb`]. The
    /// path has to end in `.glb`.
    ///
    /// ```
    /// use texere_core::{ControlPoint, Pipeline, Yarn, Yarns};
    /// use texere_cpu::ParallelBackend;
    /// use texere_formats::write::{self, Output};
    /// # let folder = tempfile::tempdir()?;
    /// # let [packed, instanced] = ["packed.glb", "instanced.glb"].map(|name| folder.path().join(name));
    /// let mut yarns = Yarns::builder();
    /// let points: Vec<_> = (0..2000).map(|step| ControlPoint::new(step as f32, 0.0, 0.0, 0.1)).collect();
    /// for _ in 0..10 {
    ///     yarns.yarn(Yarn::default(), &points[..400]);
    /// }
    /// let mesh = Pipeline::new(&yarns.build()?).sides(12).mesh(&ParallelBackend::open()?)?;
    /// write::mesh(&mesh, Output::to(&packed).packed())?;
    /// write::mesh(&mesh, Output::to(&instanced).instanced())?;
    /// let [packed, instanced] = [packed, instanced].map(|file| std::fs::metadata(file).unwrap().len());
    /// assert!(instanced < packed / 20);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn instanced(mut self) -> Self {
        self.form = Form::Instanced;
        self
    }

    /// Writes curves as [`CurveFormat::LinearUsda`]. The path has to end in `.usda`.
    ///
    /// ```
    /// use texere_core::{ControlPoint, Yarn, Yarns};
    /// use texere_formats::write::{self, Output};
    /// # let folder = tempfile::tempdir()?;
    /// # let path = folder.path().join("yarn.usda");
    /// let mut yarns = Yarns::builder();
    /// yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
    /// write::curves(&yarns.build()?, Output::to(&path).linear())?;
    /// assert!(std::fs::read_to_string(&path)?.contains("token type = \"linear\""));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn linear(mut self) -> Self {
        self.form = Form::Linear;
        self
    }

    /// Gives vertices of a mesh `attributes`, in a `.glb`, a `.ply` or a `.usda` file. Further
    /// calls add attributes.
    ///
    /// ```
    /// use texere_core::{ControlPoint, Pipeline, Yarn, Yarns};
    /// use texere_cpu::ParallelBackend;
    /// use texere_formats::WriteError;
    /// use texere_formats::write::{self, Output, VertexAttribute};
    /// # let folder = tempfile::tempdir()?;
    /// # let path = folder.path().join("yarn.ply");
    /// let mut yarns = Yarns::builder();
    /// yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
    /// let mesh = Pipeline::new(&yarns.build()?).mesh(&ParallelBackend::open()?)?;
    /// write::mesh(&mesh, Output::to(&path).attributes(VertexAttribute::ALL))?;
    /// assert!(String::from_utf8_lossy(&std::fs::read(&path)?).contains("property float s\n"));
    /// let stl = Output::to(path.with_extension("stl")).attributes([VertexAttribute::Uv]);
    /// let error = write::mesh(&mesh, stl).unwrap_err();
    /// assert_eq!(error.to_string(), "STL can't hold texture coordinates");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn attributes(mut self, attributes: impl IntoIterator<Item = VertexAttribute>) -> Self {
        self.attributes.add(attributes);
        self
    }

    /// The format of a mesh at this output, and the attributes of its vertices.
    ///
    /// **Errors**: [`WriteError::UnknownFormat`], [`WriteError::NotEnding`] if the path lacks the
    /// ending that the output's form needs, and [`WriteError::Unheld`] for straight lines and for
    /// attributes that the format can't hold.
    pub(super) fn mesh_form(&self) -> Result<MeshForm, WriteError> {
        self.check_form()?;
        let format = match self.form {
            Form::Packed => Format::PackedGlb,
            Form::Compressed => Format::CompressedGlb,
            Form::KhrCompressed => Format::KhrCompressedGlb,
            Form::Instanced => Format::InstancedGlb,
            Form::Plain => Format::from_path(&self.path)?,
            Form::Linear => {
                return Err(WriteError::Unheld { format: "a mesh", what: "straight lines".into() });
            }
        };
        Ok(MeshForm { format, attributes: self.attributes })
    }

    /// The format of curves at this output.
    ///
    /// **Errors**: [`WriteError::UnknownFormat`], [`WriteError::NotEnding`] if the path lacks the
    /// ending that the output's form needs, and [`WriteError::Unheld`] if vertices are to have
    /// attributes.
    pub(super) fn curve_format(&self) -> Result<CurveFormat, WriteError> {
        self.check_form()?;
        if self.attributes.any() {
            return Err(WriteError::Unheld {
                format: "a file of curves",
                what: "attributes of vertices".into(),
            });
        }
        match self.form {
            Form::Linear => Ok(CurveFormat::LinearUsda),
            Form::Plain | Form::Packed | Form::Compressed | Form::KhrCompressed | Form::Instanced => {
                CurveFormat::from_path(&self.path)
            }
        }
    }

    /// Checks that the path has the ending that its form needs, and that a mesh of this ending
    /// holds the attributes, if there are any.
    fn check_form(&self) -> Result<(), WriteError> {
        if self.attributes.any() {
            let format = match self.form {
                Form::Instanced => Format::InstancedGlb,
                _ => Format::from_path(&self.path)?,
            };
            format.check_holds(self.attributes)?;
        }
        let expected = match self.form {
            Form::Plain => return Ok(()),
            Form::Packed => Format::PackedGlb.extension(),
            Form::Compressed => Format::CompressedGlb.extension(),
            Form::KhrCompressed => Format::KhrCompressedGlb.extension(),
            Form::Instanced => Format::InstancedGlb.extension(),
            Form::Linear => CurveFormat::LinearUsda.extension(),
        };
        self.clone().ending(expected).map(drop)
    }

    /// The path as it was given.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// A file beside this one, with another `extension`. It does not replace what this one must
    /// not.
    #[cfg(feature = "obj")]
    pub(super) fn beside(&self, extension: &str) -> Self {
        Self { spared: self.spared.clone(), ..Self::to(self.path.with_extension(extension)) }
    }

    /// Checks whether a file may be written at the path now. The check is meant for a program that
    /// has much to do before it writes. Writers make the check themselves, before they begin and
    /// again before the rename.
    ///
    /// **Errors**: [`WriteError::NotEnding`] for an ending that can't be packed, compressed,
    /// instanced or linear; [`WriteError::UnknownFormat`] and [`WriteError::Unheld`] for one that
    /// can't hold the attributes; [`WriteError::Spared`]; and [`WriteError::Io`] if there is no
    /// such folder, if the path is no file that may be replaced, or if a spared file can't be
    /// looked at.
    pub fn check(&self) -> Result<(), WriteError> {
        self.clone().place().map(drop)
    }

    /// Returns the output if its path ends in `expected`, in upper or lower case.
    ///
    /// **Errors**: [`WriteError::NotEnding`].
    pub(super) fn ending(self, expected: &'static str) -> Result<Self, WriteError> {
        if self.path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case(expected)) {
            Ok(self)
        } else {
            Err(WriteError::NotEnding { path: self.path, expected })
        }
    }

    /// The place that the path stands for, checked as by [`Output::check`].
    pub(super) fn place(self) -> Result<FilePlace, WriteError> {
        self.check_form()?;
        let real = follow(&self.path).map_err(|source| WriteError::io("create", &self.path, source))?;
        let place = FilePlace { output: self, real };
        place.check()?;
        Ok(place)
    }
}

impl<P: AsRef<Path>> From<P> for Output {
    fn from(path: P) -> Self {
        Self::to(path)
    }
}

/// The place of an output, with all links followed.
#[derive(Debug)]
pub(super) struct FilePlace {
    output: Output,
    pub(super) real: PathBuf,
}

impl FilePlace {
    /// The path as it was given.
    pub(super) fn path(&self) -> &Path {
        &self.output.path
    }

    /// The file that is to be replaced, if there is one.
    ///
    /// **Errors**: [`WriteError::Spared`], and [`WriteError::Io`] if the path is not a file that
    /// may be replaced, or if a spared file can't be looked at.
    pub(super) fn check(&self) -> Result<Option<Metadata>, WriteError> {
        let refused = |source| WriteError::io("create", self.path(), source);
        let old = match fs::symlink_metadata(&self.real) {
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
            old => old.map_err(refused)?,
        };
        if old.is_file() {
            self.check_spared()?;
        }
        replaceable(&self.real, &old).map_err(refused)?;
        Ok(Some(old))
    }

    fn check_spared(&self) -> Result<(), WriteError> {
        let refused = |source| WriteError::io("create", self.path(), source);
        let old =
            self.output.spared.first().map(|_| Handle::from_path(&self.real)).transpose().map_err(refused)?;
        for spared in &self.output.spared {
            match Handle::from_path(spared) {
                Ok(file) if Some(&file) == old.as_ref() => {
                    return Err(WriteError::Spared { path: self.path().into(), spared: spared.clone() });
                }
                Ok(_) => {}
                // A file that is gone needs no sparing.
                Err(error) if error.kind() == ErrorKind::NotFound => {}
                Err(error) => return Err(WriteError::io("look at", spared, error)),
            }
        }
        Ok(())
    }

    /// Whether the open `file` is one of the files that must not be replaced.
    pub(super) fn spares(&self, file: &Handle) -> bool {
        self.output.spared.iter().any(|spared| Handle::from_path(spared).is_ok_and(|spared| spared == *file))
    }
}

/// Follows symbolic links to the place where a file is, or would be.
fn follow(path: &Path) -> io::Result<PathBuf> {
    match fs::canonicalize(path) {
        Err(error) if fs::symlink_metadata(path).is_ok() => {
            Err(io::Error::new(error.kind(), "a symbolic link that leads nowhere, or in a circle"))
        }
        Err(error) if error.kind() == ErrorKind::NotFound => {
            let name = path.file_name().ok_or(error)?;
            let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
            Ok(fs::canonicalize(folder.unwrap_or(Path::new(".")))?.join(name))
        }
        answer => answer,
    }
}

/// Whether the file at a place may be replaced. Without this check a rename would also replace a
/// device, or a file that the user may not write.
fn replaceable(place: &Path, old: &Metadata) -> io::Result<()> {
    if old.is_dir() {
        Err(ErrorKind::IsADirectory.into())
    } else if !old.is_file() {
        Err(io::Error::new(ErrorKind::InvalidInput, "not a regular file"))
    } else if old.permissions().readonly() {
        // The superuser could write it in spite of its permissions.
        Err(io::Error::new(ErrorKind::PermissionDenied, "read-only file"))
    } else {
        // Only the system knows whether this user may write the file. Opening it changes nothing.
        OpenOptions::new().write(true).open(place).map(drop)
    }
}
