//! Reads files of curves (BCC, OBJ's polylines, USD, TexGen): yarns that other programs made.

use std::path::Path;

use texere_core::backend::room;
use texere_core::{ControlPoint, Layout, Material, Section, Yarn, Yarns};

use super::ReadError;
use super::bytes::Bytes;
use super::curve_scale::CurveScale;
use super::file::{bytes_of, open, small};
use super::polylines::polylines;
#[cfg(feature = "texgen")]
use super::texgen::texgen;
use super::usd::usd;
use crate::bcc_file::{INFO_BYTES, SIGN, Spline, Z_UP};
use crate::yarns_file::BYTES_MAX;

/// Reads a file of curves. Each curve becomes a yarn. If nothing else is said below, the yarn is
/// round, and a spline of tension 0 through the curve's points. If the file's unit is 1 mm,
/// coordinates are kept to the bit.
///
/// A file that ends in `.obj` is read as Wavefront OBJ. Its polylines (statements `l`) are the
/// curves, and all else in it, such as faces, is passed over. A polyline that begins where the one
/// before it ended belongs to the same yarn. A yarn that ends at its first vertex is closed. The
/// axis z is taken to be up.
///
/// A file that ends in `.usda` or `.usd` is read as Universal Scene Description in its text form.
/// Its prims of the type `BasisCurves` are the curves: linear ones, Catmull-Rom, Bézier and
/// B-spline curves of any wrap, where translations, rotations and scales place them. A yarn has the
/// widths of its curve, and the colour of a prim or a curve becomes that of its material. Bézier
/// and B-spline curves become splines, with as many points as keep a spline within a hundredth of
/// the radius beside its curve; corners become round. If all curves are splines of one tension, as
/// those that texere writes, their own points are kept, and the yarns have that tension. texere
/// makes the points beyond the ends of a Catmull-Rom curve itself. One file is read: stages that
/// refer to others, or have variants, are refused.
///
/// A file that ends in `.tg3` (feature `texgen`) is read as one of TexGen, the University of
/// Nottingham's modeller of textiles. Each yarn of the file becomes one yarn, whole and once:
/// repeats and the domain are passed over. The path of a yarn runs between master nodes by Bézier
/// curves, cubic splines or straight lines, and becomes a spline as the curves of USD do. At each
/// node the yarn has the width and the height of its section there. The yarn has the shape of its
/// sections, or is elliptic if they have several shapes.
///
/// Any other file is read as BCC, Binary Curve Collection. If a BCC or a USD file says that x or y
/// is up, the curves are turned so that this axis becomes z.
///
/// **Errors**: [`ReadError::Bytes`], which names the byte, for a BCC file that is cut short, goes
/// on after its last curve, has counts that do not fit one another, or is of another kind, and for
/// a USD or TexGen file that is not text; [`ReadError::Word`], which names line and column, for a
/// word that OBJ, USD or TexGen does not allow at its place; [`ReadError::Syntax`] for what is no
/// XML; [`ReadError::Section`] for a section that no yarn may have; [`ReadError::MissingKey`] for
/// an OBJ or USD file without curves, for a TexGen file without a textile, and for a BCC or an OBJ
/// file if `scale` has no diameter; [`ReadError::Yarns`] for a BCC file without curves, and for
/// coordinates or a diameter that no yarn may have; [`ReadError::TooLarge`] for a file beyond 16
/// GiB;
/// [`ReadError::Feature`] for a kind of file that this build was made without;
/// [`ReadError::OutOfMemory`], [`ReadError::NotAFile`], [`ReadError::Io`].
///
/// ```
/// use texere_core::{ControlPoint, Yarn, Yarns};
/// use texere_formats::read::{self, CurveScale};
/// use texere_formats::write;
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("yarn.bcc");
/// let mut yarns = Yarns::builder();
/// yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
/// let yarns = yarns.build()?;
/// write::curves(&yarns, &path)?;
/// let again = read::curves(&path, CurveScale { diameter_mm: Some(0.2), ..CurveScale::default() })?;
/// assert_eq!(again.points(), yarns.points());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn curves(path: impl AsRef<Path>, scale: CurveScale) -> Result<Yarns, ReadError> {
    let path = path.as_ref();
    curves_from(path, &bytes_of(&open, path, BYTES_MAX)?, scale)
}

/// Reads the bytes of a file of curves that a program has in memory. Errors call the file `name`.
/// The ending of `name` says which kind of file it is.
///
/// **Errors**: the errors of [`curves`].
///
/// ```
/// use texere_formats::read::{self, CurveScale};
/// let hat = b"#usda 1.0\ndef BasisCurves \"rim\" { int[] curveVertexCounts = [2] }\n";
/// let error = read::curves_from("hat.usda", hat, CurveScale::default()).unwrap_err();
/// assert!(error.to_string().starts_with("hat.usda, line 2, column 5: "), "{error}");
/// ```
pub fn curves_from(name: impl AsRef<Path>, bytes: &[u8], scale: CurveScale) -> Result<Yarns, ReadError> {
    let file = name.as_ref();
    small(file, bytes.len() as u64, BYTES_MAX)?;
    let is = |endings: &[&str]| {
        let ending = file.extension().unwrap_or_default();
        endings.iter().any(|known| ending.eq_ignore_ascii_case(known))
    };
    if is(&["obj"]) {
        return polylines(file, bytes, scale);
    }
    #[cfg(feature = "texgen")]
    if is(&["tg3"]) {
        return texgen(file, bytes, scale);
    }
    #[cfg(not(feature = "texgen"))]
    if is(&["tg3"]) {
        return Err(ReadError::Feature { file: file.into(), what: "yarns of TexGen", feature: "texgen" });
    }
    // The binary form is refused by its sign.
    if is(&["usd", "usda", "usdc", "usdz"]) {
        return usd(file, bytes, scale);
    }
    let scale = scale.given(file)?;
    let mut bytes = Bytes::new(file, bytes);
    let Header { curves, points: planned, up } = header(&mut bytes)?;
    let mut yarns: Vec<Yarn> = room("yarns", curves)?;
    let mut offsets: Vec<u64> = room("offsets", curves + 1)?;
    let mut points: Vec<ControlPoint> = room("control points", planned)?;
    offsets.push(0);
    for _ in 0..curves {
        let (count, closed) = count(&mut bytes, planned - points.len())?;
        yarns.push(Yarn { closed, ..Yarn::default() });
        for _ in 0..count {
            points.push(point(&mut bytes, up, scale)?);
        }
        offsets.push(points.len() as u64);
    }
    if points.len() < planned {
        let expected = format_args!("{planned}, as the header says");
        return Err(bytes.refused(
            bytes.at(),
            "the number of control points of all curves",
            points.len(),
            expected,
        ));
    }
    bytes.end()?;
    let unsound = |source| ReadError::Yarns { file: file.into(), source };
    let layout = Layout::new(yarns, offsets, vec![Section::Circle]).map_err(unsound)?;
    Yarns::new(layout, vec![Material::default()], points).map_err(unsound)
}

/// What the header says.
struct Header {
    curves: usize,
    /// Control points of all curves together.
    points: usize,
    /// The axis that points up: 0 for x, 1 for y, 2 for z.
    up: u8,
}

fn header(bytes: &mut Bytes<'_>) -> Result<Header, ReadError> {
    let sign: [u8; 4] = bytes.take("the sign")?;
    if sign != SIGN {
        let expected = format_args!("{}, curves with integers and floats of 4 bytes", SIGN.escape_ascii());
        return Err(bytes.refused(0, "the sign", sign.escape_ascii(), expected));
    }
    let spline: [u8; 2] = bytes.take("the kind of curve")?;
    if ![Spline::CatmullRom, Spline::Polyline].iter().any(|known| known.letters() == spline) {
        let expected = "C0 for uniform Catmull-Rom curves, or PL for polylines";
        return Err(bytes.refused(4, "the kind of curve", spline.escape_ascii(), expected));
    }
    let [dimensions] = bytes.take("the number of dimensions")?;
    if dimensions != 3 {
        return Err(bytes.refused(6, "the number of dimensions", dimensions, 3));
    }
    let [up] = bytes.take("the axis that points up")?;
    if up > Z_UP {
        return Err(bytes.refused(7, "the axis that points up", up, "0 for x, 1 for y or 2 for z"));
    }
    let (curves_at, curves) = (bytes.at(), bytes.long("the number of curves")?);
    let (points_at, points) = (bytes.at(), bytes.long("the number of control points of all curves")?);
    let _: [u8; INFO_BYTES] = bytes.take("the text about the file")?;
    Ok(Header {
        curves: bytes.room_for(curves_at, "the number of curves", curves, COUNT_BYTES)?,
        points: bytes.room_for(
            points_at,
            "the number of control points of all curves",
            points,
            POINT_BYTES,
        )?,
        up,
    })
}

/// Bytes of the number of a curve's control points.
const COUNT_BYTES: u64 = 4;

/// Bytes of a control point.
const POINT_BYTES: u64 = 12;

/// Number of control points of the next curve, `left` at most, and whether the curve is closed.
fn count(bytes: &mut Bytes<'_>, left: usize) -> Result<(usize, bool), ReadError> {
    let field = "the number of control points of a curve";
    let (at, count) = (bytes.at(), i32::from_le_bytes(bytes.take(field)?));
    let least = if count < 0 { 3 } else { 2 };
    let points = count.unsigned_abs() as usize;
    if points < least || points > left {
        let expected = format_args!(
            "2 to {left}, or for a closed curve -3 to -{left}, because the header counts so many more"
        );
        return Err(bytes.refused(at, field, count, expected));
    }
    Ok((points, count < 0))
}

fn point(bytes: &mut Bytes<'_>, up: u8, [unit, diameter]: [f32; 2]) -> Result<ControlPoint, ReadError> {
    let mut axis = || Ok::<_, ReadError>(bytes.float("a coordinate of a control point")? * unit);
    let [x, y, z] = [axis()?, axis()?, axis()?];
    // These are turns by 90 degrees, so no curve is mirrored.
    let [x, y, z] = match up {
        0 => [-z, y, x],
        1 => [x, -z, y],
        _ => [x, y, z],
    };
    Ok(ControlPoint::new(x, y, z, diameter / 2.0))
}
