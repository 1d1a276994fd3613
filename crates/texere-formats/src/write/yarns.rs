//! Writes `.yarns` files, which are read again to the bit, so that settled cloth need not settle
//! again.

use std::io::Write;

use bytemuck::cast;
use crc32fast::Hasher;
use texere_core::{Boundary, ControlPoint, Ends, Material, Origin, Section, Yarn, Yarns};

use super::target::Target;
use super::{Output, WriteError};
use crate::yarns_file::{
    BENDING_BYTES, BYTES_MAX, CHECKSUM_BYTES, CORNER_BYTES, ENDING, HAS_BENDING, HEADER_BYTES, MAGIC,
    MATERIAL_BYTES, SECTION_BYTES, VERSION, YARN_BYTES, bytes_per_point, ends, flags, origin, section,
};

/// The format's name in errors.
const FORMAT: &str = "a file of yarns";

/// Writes yarns to a `.yarns` file, which [`read::yarns`](crate::read::yarns) reads again to the
/// bit. The file has control points, sections, materials, up directions, sources, and the settings
/// of each yarn. Returns the file's length in bytes.
///
/// Cloth that came to rest can be saved, and need not settle again:
///
/// ```
/// use texere_core::Pipeline;
/// use texere_cpu::ParallelBackend;
/// use texere_formats::{read, write};
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("poplin.toml");
/// # std::fs::write(&path, "weave = { notation = \"plain\", ends = 6, picks = 6 }\nyarns.white.diameter_mm = 0.143\n\
/// #     warp = { yarns = [\"white\"], spacing_mm = 0.19 }\nweft = { yarns = [\"white\"], spacing_mm = 0.35 }\n")?;
/// let device = ParallelBackend::open()?;
/// let cloth = read(&path)?.rest(&device).run()?;
/// let saved = folder.path().join("poplin.yarns");
/// write::yarns(cloth.yarns(), &saved)?;
///
/// let again = read::yarns(&saved)?.yarns;
/// let [mesh, first] = [&again, cloth.yarns()].map(|yarns| Pipeline::new(yarns).mesh(&device));
/// assert_eq!(mesh?.vertices, first?.vertices);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// **Errors**: [`WriteError::NotEnding`] if `output` does not end in `.yarns`,
/// [`WriteError::TextTooLarge`] beyond 16 GiB, [`WriteError::Spared`], [`WriteError::Io`].
pub fn yarns(yarns: &Yarns, output: impl Into<Output>) -> Result<u64, WriteError> {
    repeat(yarns, &Boundary::without_repeat(yarns.layout()), output)
}

/// Writes yarns to `out`: the bytes that [`yarns`](fn@yarns) writes to a file.
///
/// **Errors**: the errors of [`yarns`](fn@yarns), and [`WriteError::Writer`] if `out` refuses
/// bytes.
pub fn yarns_to(yarns: &Yarns, out: impl Write) -> Result<u64, WriteError> {
    repeat_to(yarns, &Boundary::without_repeat(yarns.layout()), out)
}

/// Writes the yarns of a repeat to a `.yarns` file, with the boundary that says how they go on
/// beyond the repeat. Returns the file's length in bytes.
///
/// **Errors**: the errors of [`yarns`](fn@yarns), and [`WriteError::Boundary`] for the boundary of
/// other yarns.
///
/// ```
/// use texere_core::{Boundary, ControlPoint, Ends, Yarn, Yarns};
/// use texere_formats::{read, write};
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("thread.yarns");
/// // A thread that goes on from each repeat of 2 mm to the next.
/// let mut yarns = Yarns::builder();
/// yarns.yarn(Yarn::default(), &[0.0, 0.5, 1.0, 1.5].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
/// let yarns = yarns.build()?;
/// let boundary = Boundary::new(yarns.layout(), [2.0, 0.0], vec![Ends::Repeats([1, 0])])?;
/// write::repeat(&yarns, &boundary, &path)?;
/// assert_eq!(read::yarns(&path)?.boundary, boundary);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn repeat(yarns: &Yarns, boundary: &Boundary, output: impl Into<Output>) -> Result<u64, WriteError> {
    let output = output.into().ending(ENDING)?;
    let file = File::new(yarns, boundary)?;
    file.write(Target::create(output)?)?.commit()
}

/// Writes the yarns of a repeat to `out`: the bytes that [`repeat`](fn@repeat) writes to a file.
///
/// **Errors**: the errors of [`repeat`](fn@repeat), and [`WriteError::Writer`] if `out` refuses
/// bytes.
pub fn repeat_to(yarns: &Yarns, boundary: &Boundary, out: impl Write) -> Result<u64, WriteError> {
    File::new(yarns, boundary)?.write(Target::straight(out))?.done()
}

/// A file of yarns that fits the format.
struct File<'a> {
    yarns: &'a Yarns,
    boundary: &'a Boundary,
    bytes: u64,
}

impl<'a> File<'a> {
    fn new(yarns: &'a Yarns, boundary: &'a Boundary) -> Result<Self, WriteError> {
        boundary.check(yarns.layout())?;
        let bytes = bytes_of(yarns);
        if bytes > BYTES_MAX {
            return Err(WriteError::TextTooLarge { format: FORMAT, bytes, limit: BYTES_MAX });
        }
        Ok(Self { yarns, boundary, bytes })
    }

    fn write<W: Write>(&self, target: Target<W>) -> Result<Target<W>, WriteError> {
        let (yarns, layout) = (self.yarns, self.yarns.layout());
        let mut content = Content { target, checksum: Hasher::new() };
        self.header(&mut content)?;
        yarns.materials().iter().try_for_each(|material| content.material(material))?;
        if flags(yarns) & HAS_BENDING != 0 {
            let bending = yarns.materials().iter().map(|material| material.bending.unwrap_or_default());
            bending.into_iter().try_for_each(|bending| content.float(bending))?;
        }
        layout.sections().iter().try_for_each(|section| content.section(section))?;
        let counts = layout.offsets().windows(2).map(|bounds| bounds[1] - bounds[0]);
        for ((yarn, points), &ends) in layout.yarns().iter().zip(counts).zip(self.boundary.ends()) {
            content.yarn(yarn, points, ends)?;
        }
        yarns.points().iter().try_for_each(|point| content.point(point))?;
        for up in yarns.ups().unwrap_or_default() {
            up.to_array().into_iter().try_for_each(|axis| content.float(axis))?;
        }
        yarns.sources().unwrap_or_default().iter().try_for_each(|&source| content.word(source))?;
        content.finish()
    }

    fn header<W: Write>(&self, content: &mut Content<W>) -> Result<(), WriteError> {
        let (yarns, layout) = (self.yarns, self.yarns.layout());
        content.put(&MAGIC)?;
        content.word(VERSION)?;
        content.word(flags(yarns))?;
        content.long(self.bytes)?;
        for count in [yarns.materials().len(), layout.sections().len(), layout.yarns().len()] {
            content.long(count as u64)?;
        }
        content.float(yarns.tension())?;
        self.boundary.repeat().into_iter().try_for_each(|length| content.float(length))
    }
}

/// The size of the file of `yarns`, bytes.
fn bytes_of(yarns: &Yarns) -> u64 {
    let layout = yarns.layout();
    let bending = if flags(yarns) & HAS_BENDING == 0 { 0 } else { BENDING_BYTES };
    let material = |each: &Material| MATERIAL_BYTES + each.name.len() as u64 + bending;
    let materials = yarns.materials().iter().map(material);
    let sections = layout.sections().iter().map(|section| match section {
        Section::Polygon(corners) => SECTION_BYTES + CORNER_BYTES * corners.len() as u64,
        _ => SECTION_BYTES,
    });
    HEADER_BYTES
        + materials.sum::<u64>()
        + sections.sum::<u64>()
        + YARN_BYTES * layout.yarns().len() as u64
        + bytes_per_point(flags(yarns)) * layout.point_count()
        + CHECKSUM_BYTES
}

/// A target, and the checksum of the bytes written so far.
struct Content<W: Write> {
    target: Target<W>,
    checksum: Hasher,
}

impl<W: Write> Content<W> {
    fn put(&mut self, bytes: &[u8]) -> Result<(), WriteError> {
        self.checksum.update(bytes);
        self.target.write(bytes)
    }

    fn word(&mut self, word: u32) -> Result<(), WriteError> {
        self.put(&word.to_le_bytes())
    }

    fn long(&mut self, long: u64) -> Result<(), WriteError> {
        self.put(&long.to_le_bytes())
    }

    fn float(&mut self, float: f32) -> Result<(), WriteError> {
        self.put(&float.to_le_bytes())
    }

    fn material(&mut self, material: &Material) -> Result<(), WriteError> {
        let Material { name, srgb: [red, green, blue], tex, hairiness, bending: _ } = material;
        self.long(name.len() as u64)?;
        self.put(name.as_bytes())?;
        self.put(&[*red, *green, *blue, u8::from(tex.is_some())])?;
        self.float(tex.unwrap_or_default())?;
        self.float(*hairiness)
    }

    fn section(&mut self, shape: &Section) -> Result<(), WriteError> {
        let (kind, numbers) = match *shape {
            Section::Circle => (section::CIRCLE, [0; 2]),
            Section::Ellipse { aspect } => (section::ELLIPSE, [aspect.to_bits(), 0]),
            Section::Lenticular { aspect, distortion } => {
                (section::LENTICULAR, [aspect.to_bits(), distortion.to_bits()])
            }
            Section::PowerEllipse { aspect, exponent } => {
                (section::POWER_ELLIPSE, [aspect.to_bits(), exponent.to_bits()])
            }
            // 0 stands for the valley of plies that nothing presses.
            Section::Lobed { plies, .. } if *shape == Section::plied(plies) => (section::LOBED, [plies, 0]),
            Section::Lobed { plies, valley } => (section::LOBED, [plies, valley.to_bits()]),
            Section::Polygon(ref corners) => (section::POLYGON, [corners.len() as u32, 0]),
            _ => return Err(WriteError::Unheld { format: FORMAT, what: format!("the section {shape:?}") }),
        };
        self.word(kind)?;
        numbers.into_iter().try_for_each(|number| self.word(number))?;
        match shape {
            Section::Polygon(corners) => corners.as_flattened().iter().try_for_each(|&axis| self.float(axis)),
            _ => Ok(()),
        }
    }

    fn yarn(&mut self, yarn: &Yarn, points: u64, going_on: Ends) -> Result<(), WriteError> {
        let (ends, [along_x, along_y]) = match going_on {
            Ends::Open => (ends::OPEN, [0; 2]),
            Ends::Closed => (ends::CLOSED, [0; 2]),
            Ends::Repeats(repeats) => (ends::REPEATS, repeats),
        };
        let (origin, [first, second]) = match yarn.origin {
            Origin::Unknown => (origin::UNKNOWN, [0; 2]),
            Origin::End(end) => (origin::END, [end, 0]),
            Origin::Pick(pick) => (origin::PICK, [pick, 0]),
            Origin::Course(course) => (origin::COURSE, [course, 0]),
            Origin::Carrier(carrier) => (origin::CARRIER, [carrier, 0]),
            Origin::Guide { bar, guide } => (origin::GUIDE, [bar, guide]),
            other => {
                return Err(WriteError::Unheld { format: FORMAT, what: format!("the origin {other:?}") });
            }
        };
        self.long(points)?;
        self.word(yarn.material)?;
        self.word(yarn.section)?;
        self.float(yarn.twist)?;
        self.word(ends)?;
        self.put(&along_x.to_le_bytes())?;
        self.put(&along_y.to_le_bytes())?;
        [origin, first, second].into_iter().try_for_each(|word| self.word(word))
    }

    fn point(&mut self, point: &ControlPoint) -> Result<(), WriteError> {
        let mut bytes = [0; 16];
        for (place, axis) in bytes.chunks_exact_mut(4).zip([point.x, point.y, point.z]) {
            place.copy_from_slice(&axis.to_le_bytes());
        }
        for (place, half) in bytes[12..].chunks_exact_mut(2).zip(cast::<_, [u16; 2]>(point.halves)) {
            place.copy_from_slice(&half.to_le_bytes());
        }
        self.put(&bytes)
    }

    fn finish(mut self) -> Result<Target<W>, WriteError> {
        let checksum = self.checksum.finalize();
        self.target.write(&checksum.to_le_bytes())?;
        Ok(self.target)
    }
}
