//! A mesh format with the attributes of vertices in it.

use super::{Format, WriteError};

/// A property that the vertices of a mesh file may have beside positions and normals.
///
/// ```
/// use texere_formats::write::VertexAttribute;
/// assert_eq!(VertexAttribute::ALL.map(VertexAttribute::name), ["uv", "tangent", "yarn"]);
/// assert_eq!(VertexAttribute::named("uv"), Some(VertexAttribute::Uv));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum VertexAttribute {
    /// Texture coordinates. The first is the share of a turn round the yarn, the second the
    /// distance along the yarn, mm. A ring has one vertex more for them, because the turn begins at
    /// 0 and ends at 1. A cap takes the circle that touches the texture's edges.
    Uv,
    /// The unit direction along the yarn on its surface, at right angles to the normal, and a sign.
    /// The bitangent is normal × tangent × sign. On a tube the sign is -1, so that the bitangent
    /// runs round the yarn with the growing turn. On a cap the tangent runs with the growing first
    /// texture coordinate, and the bitangent with the second. PLY and USD hold no sign.
    Tangent,
    /// The number of the yarn among all yarns of the cloth, counted from 0.
    Yarn,
}

impl VertexAttribute {
    /// All attributes.
    pub const ALL: [Self; 3] = [Self::Uv, Self::Tangent, Self::Yarn];

    /// The name on the command line and in Python.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Uv => "uv",
            Self::Tangent => "tangent",
            Self::Yarn => "yarn",
        }
    }

    /// The attribute of that [name](Self::name).
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|attribute| attribute.name() == name)
    }
}

/// A mesh format, and the attributes that vertices have in it.
///
/// ```
/// use std::io::Cursor;
/// use texere_core::{ControlPoint, Pipeline, Yarn, Yarns};
/// use texere_cpu::ParallelBackend;
/// use texere_formats::write::{self, Format, VertexAttribute};
/// let mut yarns = Yarns::builder();
/// yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
/// let mesh = Pipeline::new(&yarns.build()?).mesh(&ParallelBackend::open()?)?;
/// let mut glb = Cursor::new(Vec::new());
/// write::mesh_to(&mesh, Format::Glb.with([VertexAttribute::Uv]), &mut glb)?;
/// assert!(String::from_utf8_lossy(glb.get_ref()).contains("TEXCOORD_0"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MeshForm {
    pub(super) format: Format,
    pub(super) attributes: Attributes,
}

/// Which attributes vertices have.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Attributes {
    pub(super) uv: bool,
    pub(super) tangent: bool,
    pub(super) yarn: bool,
}

impl Attributes {
    /// Adds `attributes`.
    pub(super) fn add(&mut self, attributes: impl IntoIterator<Item = VertexAttribute>) {
        for attribute in attributes {
            match attribute {
                VertexAttribute::Uv => self.uv = true,
                VertexAttribute::Tangent => self.tangent = true,
                VertexAttribute::Yarn => self.yarn = true,
            }
        }
    }

    /// Whether there is any.
    pub(super) fn any(self) -> bool {
        self != Self::default()
    }
}

impl Format {
    /// The format with `attributes` of vertices. Not every format holds each of them: STL and
    /// instanced GLB hold none, and OBJ texture coordinates alone, which it always has.
    pub fn with(self, attributes: impl IntoIterator<Item = VertexAttribute>) -> MeshForm {
        let mut form = MeshForm::from(self);
        form.attributes.add(attributes);
        form
    }

    /// Checks that the format holds `attributes`.
    ///
    /// **Errors**: [`WriteError::Unheld`], which names the first that it can't hold.
    pub(super) fn check_holds(self, attributes: Attributes) -> Result<(), WriteError> {
        let Attributes { uv, tangent, yarn } = attributes;
        let (format, unheld) = match self {
            Self::Stl => ("STL", [uv, tangent, yarn]),
            Self::InstancedGlb => ("instanced GLB", [uv, tangent, yarn]),
            Self::Obj => ("OBJ", [false, tangent, yarn]),
            Self::Glb
            | Self::PackedGlb
            | Self::CompressedGlb
            | Self::KhrCompressedGlb
            | Self::Ply
            | Self::Usda => return Ok(()),
        };
        let names = ["texture coordinates", "tangents of vertices", "numbers of yarns"];
        match unheld.iter().position(|unheld| *unheld) {
            Some(place) => Err(WriteError::Unheld { format, what: names[place].into() }),
            None => Ok(()),
        }
    }
}

impl From<Format> for MeshForm {
    fn from(format: Format) -> Self {
        Self { format, attributes: Attributes::default() }
    }
}

impl MeshForm {
    /// Whether a ring has a vertex more than sides, at which the turn round the yarn ends. OBJ has
    /// a pair of texture coordinates more instead.
    pub(super) fn has_seam(self) -> bool {
        self.attributes.uv && self.format != Format::Obj
    }
}
