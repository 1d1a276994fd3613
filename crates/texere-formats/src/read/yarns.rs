//! Reads `.yarns` files. The yarns are equal to the saved ones to the bit.

use std::path::Path;

use bytemuck::cast;
use texere_core::backend::room;
use texere_core::{
    Boundary, ControlPoint, Ends, Layout, Material, Origin, Section, Yarn, YarnError, Yarns, check_tension,
};
use texere_fabric::Piece;

use super::ReadError;
use super::bytes::Bytes;
use super::file::{bytes_of, open, small};
use crate::yarns_file::{
    BYTES_MAX, CORNER_BYTES, HAS_BENDING, HAS_SOURCES, HAS_UPS, MAGIC, MATERIAL_BYTES, SECTION_BYTES,
    VERSION, YARN_BYTES, bytes_per_point, ends, origin, section,
};

/// The contents of a `.yarns` file.
#[derive(Debug, Clone)]
pub struct SavedYarns {
    /// The yarns.
    pub yarns: Yarns,
    /// How the yarns go on beyond a repeat. For yarns that were saved without a repeat, it says
    /// only which are closed and which are open.
    pub boundary: Boundary,
}

impl SavedYarns {
    /// The yarns as a piece of cloth that can settle. A repeat settles as it was saved. Other yarns
    /// are held at their ends.
    #[must_use]
    pub fn into_piece(self) -> Piece {
        let Self { yarns, boundary } = self;
        let goes_on = boundary.ends().iter().any(|ends| matches!(ends, Ends::Repeats(_)));
        if goes_on { Piece::new(yarns, boundary) } else { Piece::cut(yarns) }
    }
}

/// Reads the yarns in a `.yarns` file, which [`write::yarns`](crate::write::yarns) or
/// [`write::repeat`](crate::write::repeat) has written. The yarns are equal to the saved ones to
/// the bit.
///
/// **Errors**: [`ReadError::Bytes`], which names the byte, for a file that is cut short, has
/// changed since it was written, is of another version, or has a value that the format does not
/// allow; [`ReadError::Yarns`] and [`ReadError::Boundary`] for values that no yarns may have;
/// [`ReadError::TooLarge`] beyond 16 GiB; [`ReadError::OutOfMemory`], [`ReadError::NotAFile`],
/// [`ReadError::Io`].
pub fn yarns(path: impl AsRef<Path>) -> Result<SavedYarns, ReadError> {
    let path = path.as_ref();
    yarns_from(path, &bytes_of(&open, path, BYTES_MAX)?)
}

/// Reads the bytes of a `.yarns` file that a program has in memory. Errors call the file `name`.
///
/// **Errors**: the errors of [`yarns`].
///
/// ```
/// use texere_core::{ControlPoint, Yarn, Yarns};
/// use texere_formats::{read, write};
/// let mut yarns = Yarns::builder();
/// yarns.yarn(Yarn::default(), &[0.0, 1.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
/// let (yarns, mut bytes) = (yarns.build()?, Vec::new());
/// write::yarns_to(&yarns, &mut bytes)?;
/// assert_eq!(read::yarns_from("row 7", &bytes)?.yarns.points(), yarns.points());
/// bytes[100] ^= 1;
/// let error = read::yarns_from("row 7", &bytes).unwrap_err();
/// assert!(error.to_string().starts_with("row 7, byte 174: the checksum is"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn yarns_from(name: impl AsRef<Path>, bytes: &[u8]) -> Result<SavedYarns, ReadError> {
    let file = name.as_ref();
    small(file, bytes.len() as u64, BYTES_MAX)?;
    let mut bytes = Bytes::new(file, bytes);
    let flags = start(&mut bytes)?;
    let materials = bytes.count("the number of materials", MATERIAL_BYTES)?;
    let sections = bytes.count("the number of sections", SECTION_BYTES)?;
    let yarns = bytes.count("the number of yarns", YARN_BYTES)?;
    let (at, tension) = (bytes.at(), bytes.float("the tension")?);
    if check_tension(tension).is_err() {
        return Err(bytes.refused(at, "the tension", tension, "0 to below 1"));
    }
    let repeat = [bytes.float("the repeat along x")?, bytes.float("the repeat along y")?];

    let mut materials = list("materials", materials, || material(&mut bytes))?;
    if flags & HAS_BENDING != 0 {
        for material in &mut materials {
            let bending = bytes.float("a bending stiffness")?;
            material.bending = (bending.to_bits() != 0).then_some(bending);
        }
    }
    let sections = list("sections", sections, || section(&mut bytes))?;
    let Table { yarns, offsets, ends } = table(&mut bytes, yarns, bytes_per_point(flags))?;
    let count = offsets[yarns.len()] as usize;
    let points = list("control points", count, || point(&mut bytes))?;

    let unsound = |source| ReadError::Yarns { file: file.into(), source };
    let layout =
        Layout::new(yarns, offsets, sections).map_err(unsound)?.with_tension(tension).map_err(unsound)?;
    let boundary = Boundary::new(&layout, repeat, ends);
    let boundary = boundary.map_err(|source| ReadError::Boundary { file: file.into(), source })?;
    let mut yarns = Yarns::new(layout, materials, points).map_err(unsound)?;
    if flags & HAS_UPS != 0 {
        yarns = with_ups(&mut bytes, yarns, unsound)?;
    }
    if flags & HAS_SOURCES != 0 {
        let sources = list("sources", count, || bytes.word("a source"))?;
        yarns = yarns.with_sources(sources).map_err(unsound)?;
    }
    bytes.end()?;
    Ok(SavedYarns { yarns, boundary })
}

/// Reads the header up to the file's length, and checks the file by that length and by its
/// checksum. Returns the bits that announce optional lists.
fn start(bytes: &mut Bytes<'_>) -> Result<u32, ReadError> {
    let magic: [u8; MAGIC.len()] = bytes.take("the beginning")?;
    if magic != MAGIC {
        return Err(bytes.refused(0, "the beginning", magic.escape_ascii(), MAGIC.escape_ascii()));
    }
    let (at, version) = (bytes.at(), bytes.word("the version")?);
    if version != VERSION {
        let expected = format_args!("{VERSION}, the only version that this program reads");
        return Err(bytes.refused(at, "the version", version, expected));
    }
    let (flags_at, flags) = (bytes.at(), bytes.word("the word of flags")?);
    bytes.check_length("the length in bytes")?;
    bytes.check_sum("the checksum")?;
    let known = HAS_UPS | HAS_SOURCES | HAS_BENDING;
    if flags & !known != 0 {
        let expected = format_args!("0 to {known}");
        return Err(bytes.refused(flags_at, "the word of flags", flags, expected));
    }
    Ok(flags)
}

/// A list of `count` items from `next`. A lack of memory for the list is an error.
fn list<T>(
    what: &'static str,
    count: usize,
    mut next: impl FnMut() -> Result<T, ReadError>,
) -> Result<Vec<T>, ReadError> {
    let mut items = room(what, count)?;
    for _ in 0..count {
        items.push(next()?);
    }
    Ok(items)
}

fn material(bytes: &mut Bytes<'_>) -> Result<Material, ReadError> {
    let letters = bytes.count("the length of a material's name", 1)?;
    let name = bytes.text("a material's name", letters)?;
    let [red, green, blue] = bytes.take("a material's colour")?;
    let (at, [has_tex]) = (bytes.at(), bytes.take("whether a material has tex")?);
    let tex = match has_tex {
        0 => {
            bytes.unused("the tex of a material without tex")?;
            None
        }
        1 => Some(bytes.float("a material's tex")?),
        other => return Err(bytes.refused(at, "whether a material has tex", other, "0 or 1")),
    };
    let hairiness = bytes.float("a material's hairiness")?;
    Ok(Material { name, srgb: [red, green, blue], tex, hairiness, bending: None })
}

fn section(bytes: &mut Bytes<'_>) -> Result<Section, ReadError> {
    const UNUSED: &str = "a number that a section of its kind does not have";
    let (at, kind) = (bytes.at(), bytes.word("the kind of a section")?);
    let aspect = "a section's aspect";
    Ok(match kind {
        section::CIRCLE => {
            bytes.unused(UNUSED)?;
            bytes.unused(UNUSED)?;
            Section::Circle
        }
        section::ELLIPSE => {
            let aspect = bytes.float(aspect)?;
            bytes.unused(UNUSED)?;
            Section::Ellipse { aspect }
        }
        section::LENTICULAR => Section::Lenticular {
            aspect: bytes.float(aspect)?,
            distortion: bytes.float("a section's distortion")?,
        },
        section::POWER_ELLIPSE => Section::PowerEllipse {
            aspect: bytes.float(aspect)?,
            exponent: bytes.float("a section's exponent")?,
        },
        section::LOBED => {
            let plies = bytes.word("a section's plies")?;
            let valley = bytes.float("a section's valley")?;
            // 0 stands for the valley of plies that nothing presses. -0 is no valley.
            if valley.to_bits() == 0 { Section::plied(plies) } else { Section::Lobed { plies, valley } }
        }
        section::POLYGON => {
            let corners = "the number of a section's corners";
            let (at, count) = (bytes.at(), bytes.word(corners)?);
            bytes.unused(UNUSED)?;
            let count = bytes.room_for(at, corners, count.into(), CORNER_BYTES)?;
            let axis = "a corner of a section";
            Section::Polygon(list("corners", count, || Ok([bytes.float(axis)?, bytes.float(axis)?]))?)
        }
        other => return Err(bytes.refused(at, "the kind of a section", other, "0 to 5")),
    })
}

/// The table of yarns.
struct Table {
    yarns: Vec<Yarn>,
    /// The first control point of each yarn, and the number of all control points last.
    offsets: Vec<u64>,
    ends: Vec<Ends>,
}

/// The table of `count` yarns, whose control points take `point_bytes` each.
fn table(bytes: &mut Bytes<'_>, count: usize, point_bytes: u64) -> Result<Table, ReadError> {
    let mut table = Table {
        yarns: room("yarns", count)?,
        offsets: room("offsets", count + 1)?,
        ends: room("ends", count)?,
    };
    table.offsets.push(0);
    let mut total = 0;
    for _ in 0..count {
        let (at, points) = (bytes.at(), bytes.long("the number of control points of a yarn")?);
        // The sum fits into 64 bits, because the size of the file limits each count and the number
        // of yarns.
        total += bytes.room_for(at, "the number of control points of a yarn", points, point_bytes)? as u64;
        table.offsets.push(total);
        let (material, section) = (bytes.word("a yarn's material")?, bytes.word("a yarn's section")?);
        let twist = bytes.float("a yarn's twist")?;
        let ends = ends(bytes)?;
        let origin = origin(bytes)?;
        table.yarns.push(Yarn { material, section, closed: ends == Ends::Closed, twist, origin });
        table.ends.push(ends);
    }
    bytes.room_for(bytes.at(), "the number of control points of all yarns", total, point_bytes)?;
    Ok(table)
}

fn ends(bytes: &mut Bytes<'_>) -> Result<Ends, ReadError> {
    const UNUSED: &str = "a repeat of a yarn that does not go on";
    let (at, kind) = (bytes.at(), bytes.word("how a yarn ends")?);
    let ends = match kind {
        ends::OPEN => Ends::Open,
        ends::CLOSED => Ends::Closed,
        ends::REPEATS => {
            let repeats = [bytes.take("a yarn's repeats along x")?, bytes.take("a yarn's repeats along y")?];
            return Ok(Ends::Repeats(repeats.map(i32::from_le_bytes)));
        }
        other => return Err(bytes.refused(at, "how a yarn ends", other, "0 to 2")),
    };
    bytes.unused(UNUSED)?;
    bytes.unused(UNUSED)?;
    Ok(ends)
}

fn origin(bytes: &mut Bytes<'_>) -> Result<Origin, ReadError> {
    const UNUSED: &str = "a number that an origin of its kind does not have";
    let number = "the number of a yarn's origin";
    let (at, kind) = (bytes.at(), bytes.word("the kind of a yarn's origin")?);
    let origin = match kind {
        origin::UNKNOWN => {
            bytes.unused(UNUSED)?;
            Origin::Unknown
        }
        origin::END => Origin::End(bytes.word(number)?),
        origin::PICK => Origin::Pick(bytes.word(number)?),
        origin::COURSE => Origin::Course(bytes.word(number)?),
        origin::CARRIER => Origin::Carrier(bytes.word(number)?),
        origin::GUIDE => {
            return Ok(Origin::Guide { bar: bytes.word(number)?, guide: bytes.word("a yarn's guide")? });
        }
        other => return Err(bytes.refused(at, "the kind of a yarn's origin", other, "0 to 5")),
    };
    bytes.unused(UNUSED)?;
    Ok(origin)
}

fn point(bytes: &mut Bytes<'_>) -> Result<ControlPoint, ReadError> {
    let mut axis = || bytes.float("a coordinate of a control point");
    let [x, y, z] = [axis()?, axis()?, axis()?];
    let halves = [bytes.take("half a yarn's width")?, bytes.take("half a yarn's height")?];
    Ok(ControlPoint { x, y, z, halves: cast(halves.map(u16::from_le_bytes)) })
}

/// The yarns with the up directions that come next in the file. Each must have length 1, so that
/// `Yarns::with_ups` keeps its bits.
fn with_ups(
    bytes: &mut Bytes<'_>,
    yarns: Yarns,
    unsound: impl Fn(YarnError) -> ReadError,
) -> Result<Yarns, ReadError> {
    let what = "an up direction";
    let (mut given, count) = (*bytes, yarns.points().len());
    let mut next = || Ok([bytes.float(what)?, bytes.float(what)?, bytes.float(what)?]);
    let yarns = yarns.with_ups(list("up directions", count, &mut next)?).map_err(unsound)?;
    for up in yarns.ups().unwrap_or_default() {
        let at = given.at();
        let read = [given.float(what)?, given.float(what)?, given.float(what)?];
        if read.map(f32::to_bits) != up.to_array().map(f32::to_bits) {
            return Err(bytes.refused(at, what, format_args!("{read:?}"), "a vector of length 1"));
        }
    }
    Ok(yarns)
}
