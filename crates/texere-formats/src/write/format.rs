//! The kinds of mesh files.

use std::path::Path;

use super::WriteError;

/// A kind of mesh file.
///
/// ```
/// use texere_formats::write::Format;
/// assert_eq!(Format::from_path("damask.GLB")?, Format::Glb);
/// let error = Format::from_path("damask.fbx").unwrap_err();
/// assert_eq!(error.to_string(), "damask.fbx has no known extension; there are: glb, ply, stl, obj, usda");
/// # Ok::<(), texere_formats::WriteError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Format {
    /// glTF 2.0 binary, up to 4 GiB.
    Glb,
    /// glTF 2.0 binary with 12 bytes for a vertex instead of 24, up to 4 GiB. Positions and normals
    /// are whole numbers, as the extension `KHR_mesh_quantization` allows. Coordinates are off by
    /// half a step at most. There are 65,534 steps in the largest side of the box that a yarn lies
    /// in: a step is 1.5 µm if that side has 10 cm, and a side of more than 655 mm is refused.
    /// Normals are off by 0.4 degrees at most. The mesh is made twice: first to find the boxes of
    /// the yarns.
    ///
    /// No extension stands for this format alone: [`Output::packed`](super::Output::packed) asks
    /// for it.
    PackedGlb,
    /// The packed form of glTF 2.0 binary, compressed: 6 to 7 bytes for a vertex, and a byte or two
    /// for a triangle of the longest yarn instead of 12. `EXT_meshopt_compression` is the
    /// extension. Positions are those of the packed form. Normals are off by 1 degree at most.
    /// Unpacked, the file has up to 4 GiB.
    ///
    /// The bytes are gathered before they are written. Beyond some megabytes they lie in unnamed
    /// files beside the output, or in the system's folder for such files.
    ///
    /// No extension stands for this format alone: [`Output::compressed`](super::Output::compressed)
    /// asks for it.
    CompressedGlb,
    /// [`Format::CompressedGlb`] with the later extension `KHR_meshopt_compression`: the same
    /// vertices and triangles in 2 to 5 % fewer bytes. Coordinates are compressed as 16-bit
    /// numbers, and small differences have shorter codes. Fewer programs know this extension.
    ///
    /// No extension stands for this format alone:
    /// [`Output::khr_compressed`](super::Output::khr_compressed) asks for it.
    KhrCompressedGlb,
    /// glTF 2.0 binary that holds each part of a yarn once, however often it recurs, up to 4 GiB.
    /// `EXT_mesh_gpu_instancing` is the extension. A part is a cap, or a piece of tube as long as
    /// 16 control intervals, or shorter at a yarn's end. Equal parts have the same material. Their
    /// coordinates differ by a millionth of the cloth's largest coordinate at most, and never by
    /// more than 0.005 mm. Their normals differ by half a degree at most. A Jacquard cloth of 254
    /// million triangles takes 15 MB instead of 3 GB. A cloth whose different parts take more than
    /// 256 MiB is refused. The mesh is made twice: first to find its box.
    ///
    /// No extension stands for this format alone: [`Output::instanced`](super::Output::instanced)
    /// asks for it.
    InstancedGlb,
    /// Binary PLY, up to 2³² - 1 vertices.
    Ply,
    /// Binary STL, up to 2³² - 1 triangles, without colours.
    Stl,
    /// OBJ, text, with a file of materials (`.mtl`) beside it.
    Obj,
    /// The text form of Universal Scene Description: a prim for each yarn, of up to 2³¹ - 1
    /// vertices. Where `.usda` may also stand for the curves of yarns, as on the command line and
    /// in Python, triangles have to be asked for.
    Usda,
}

impl Format {
    /// The formats that an extension stands for.
    pub const ALL: [Self; 5] = [Self::Glb, Self::Ply, Self::Stl, Self::Obj, Self::Usda];

    /// The extension of the format's files, without its dot.
    #[must_use]
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Glb
            | Self::PackedGlb
            | Self::CompressedGlb
            | Self::KhrCompressedGlb
            | Self::InstancedGlb => "glb",
            Self::Ply => "ply",
            Self::Stl => "stl",
            Self::Obj => "obj",
            Self::Usda => "usda",
        }
    }

    /// Whether a file is begun only when the boxes of all yarns are known.
    pub(super) const fn needs_bounds(self) -> bool {
        matches!(self, Self::PackedGlb | Self::CompressedGlb | Self::KhrCompressedGlb | Self::InstancedGlb)
    }

    /// The format that the extension of `path` stands for, in upper or lower case.
    ///
    /// **Errors**: [`WriteError::UnknownFormat`], which names all extensions.
    pub fn from_path(path: impl AsRef<Path>) -> Result<Self, WriteError> {
        by_extension(path.as_ref(), Self::ALL, Self::extension)
    }
}

/// The one of `all` formats that the extension of `path` stands for, in upper or lower case.
///
/// **Errors**: [`WriteError::UnknownFormat`], which names all extensions.
pub(super) fn by_extension<F: Copy, const N: usize>(
    path: &Path,
    all: [F; N],
    extension: fn(F) -> &'static str,
) -> Result<F, WriteError> {
    let given = path.extension().unwrap_or_default();
    all.into_iter().find(|format| given.eq_ignore_ascii_case(extension(*format))).ok_or_else(|| {
        WriteError::UnknownFormat { path: path.to_owned(), known: all.map(extension).join(", ") }
    })
}
