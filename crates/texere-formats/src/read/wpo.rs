//! Drafts of WeavePoint (`.wpo`), which are binary.
//!
//! The layout is not published. It is read as Russell Owen's `dtx_to_wif` 4.7 describes it.
//! Integers of two bytes are big-endian.
//!
//! | bytes | what |
//! |---|---|
//! | 1 | 123 |
//! | 1 | version of the layout |
//! | 1 | kind: 100 lift plan, 101 tie-up with a treadle for each pick, 102 tie-up with several |
//! | 1 | passed over |
//! | 2 × 1 | shafts, treadles |
//! | 1 | passed over |
//! | 1 | 0 for a rising shed |
//! | 1 | passed over |
//! | 2 × 1 | ends and picks to the centimetre or the inch, whole |
//! | 2 | passed over |
//! | 2 × 2 | width and height of WeavePoint's page in threads, passed over |
//! | 1 | 1 for centimetres, 0 for inches |
//! | 6 | passed over |
//! | 2, then 1 for each end | number of ends, the shaft of each, 0 for none |
//! | 2, then 1 for each | number of colours of ends, the colour of each, counted from 0 |
//! | 2, then 1 for each | number of colours of picks, the colour of each |
//! | a mask for each treadle | kinds 101 and 102: the shafts that are tied to it |
//! | 2, then 1 for each pick, or a mask | number of picks, the treadle of each; kind 102: its treadles; kind 100: its shafts |
//! | 66 | passed over |
//! | 1, then 3 for each colour | number of colours; red, green and blue, 0 to 255, before version 4 0 to 63 |
//!
//! A mask has as many bytes as its shafts or treadles need. The lowest bit of the first byte stands
//! for shaft or treadle 1. What follows the colours is passed over: titles, notes, and the spacing
//! and thickness of single threads.
//!
//! The description has no unit of the setts. The unit above agrees with all sample files of
//! `dtx_to_wif`.

use std::path::Path;

use texere_core::backend::{filled, room};
use texere_core::{Material, counted};
use texere_fabric::Shedding;

use super::ReadError;
use super::bytes::Bytes;
use super::draft::{DraftThreads, LoomDraft, Plans, ThreadSet, color};
use super::file::file_name;
use super::keys::Keys;

/// The first byte of each file.
const SIGN: u8 = 123;

/// The last version that is known.
const VERSION: u8 = 7;

/// The first version whose colours go up to 255. Those of earlier ones go up to 63.
const FINE_COLORS: u8 = 4;

/// Reads the bytes of a WeavePoint file.
pub(super) fn draft(file: &Path, bytes: &[u8]) -> Result<LoomDraft, ReadError> {
    let mut warnings = Vec::new();
    let mut bytes = Bytes::new(file, bytes);
    let header = header(&mut bytes)?;
    if header.version > VERSION {
        let version = header.version;
        warnings.push(format!("the file is of version {version}; it is read as one of version {VERSION}"));
    }
    let threading = threading(&mut bytes, header.shafts)?;
    let [warp_colors, weft_colors] = [colors(&mut bytes)?, colors(&mut bytes)?];
    let mut stray = 0;
    let shedding = shedding(&mut bytes, &header, &mut stray)?;
    if stray > 0 {
        let times = counted(stray, "time");
        warnings.push(format!(
            "the file names shafts or treadles {times} that the loom lacks; they are left out"
        ));
    }
    let materials = palette(&mut bytes, header.version)?;
    let set = |place, count, colors: Colors<'_>, spacing_mm| {
        Ok::<_, ReadError>(ThreadSet {
            place,
            spacing_mm: filled("lengths of threads", count, spacing_mm)?,
            thickness_mm: filled("lengths of threads", count, None)?,
            drawn: false,
            material: colors.materials(&bytes, count, materials.len() - 1)?,
        })
    };
    let picks = match &shedding {
        Shedding::TieUp { treadling, .. } => treadling.len(),
        Shedding::LiftPlan(lifts) => lifts.len(),
    };
    let [warp_spacing, weft_spacing] = header.spacings_mm;
    let warp = set("in the warp", threading.len(), warp_colors, warp_spacing)?;
    let weft = set("in the weft", picks, weft_colors, weft_spacing)?;
    let plans = Plans { threading, shedding, other: None, rising_shed: header.rising_shed };
    let (draft, drawdown) = plans.draft(file, &mut warnings)?;
    let woven = DraftThreads { warp, weft, materials }.woven(file, drawdown, &mut warnings)?;
    Ok(LoomDraft { name: file_name(file), woven, draft, warnings, keys: Keys::default() })
}

/// How the picks of a file lift shafts.
#[derive(Debug, Clone, Copy)]
enum Kind {
    LiftPlan,
    Treadle,
    Treadles,
}

/// What the header says.
struct Header {
    version: u8,
    kind: Kind,
    shafts: u8,
    treadles: u8,
    rising_shed: bool,
    /// The spacing of ends and of picks, mm.
    spacings_mm: [Option<f64>; 2],
}

fn header(bytes: &mut Bytes<'_>) -> Result<Header, ReadError> {
    const OTHER: &str = "the header";
    let [sign] = bytes.take("the sign")?;
    if sign != SIGN {
        let expected = format_args!("{SIGN}, with which drafts of WeavePoint begin");
        return Err(bytes.refused(0, "the sign", sign, expected));
    }
    let [version] = bytes.take("the version")?;
    let (at, [kind]) = (bytes.at(), bytes.take("the kind of draft")?);
    let kind = match kind {
        100 => Kind::LiftPlan,
        101 => Kind::Treadle,
        102 => Kind::Treadles,
        other => return Err(bytes.refused(at, "the kind of draft", other, "100 to 102")),
    };
    let [_] = bytes.take(OTHER)?;
    let (at, [shafts, treadles]) = (bytes.at(), bytes.take("the numbers of shafts and treadles")?);
    if shafts == 0 {
        return Err(bytes.refused(at, "the number of shafts", shafts, "1 to 255"));
    }
    if treadles == 0 && !matches!(kind, Kind::LiftPlan) {
        return Err(bytes.refused(at + 1, "the number of treadles", treadles, "1 to 255"));
    }
    let [_, sinking, _] = bytes.take(OTHER)?;
    let setts: [u8; 2] = bytes.take("the setts")?;
    let _: [u8; 6] = bytes.take(OTHER)?;
    let [is_metric] = bytes.take("the unit of the setts")?;
    let _: [u8; 6] = bytes.take(OTHER)?;
    let unit_mm = if is_metric == 0 { 25.4 } else { 10.0 };
    let spacings_mm = setts.map(|sett| (sett > 0).then(|| unit_mm / f64::from(sett)));
    Ok(Header { version, kind, shafts, treadles, rising_shed: sinking == 0, spacings_mm })
}

/// A number of two bytes, with its place.
fn count(bytes: &mut Bytes<'_>, field: &'static str) -> Result<(u64, u64), ReadError> {
    let at = bytes.at();
    Ok((at, u16::from_be_bytes(bytes.take(field)?).into()))
}

/// The shafts of each end.
fn threading(bytes: &mut Bytes<'_>, shafts: u8) -> Result<Vec<Vec<u32>>, ReadError> {
    let (field, shaft) = ("the number of ends", "the shaft of an end");
    let (at, ends) = count(bytes, field)?;
    if ends == 0 {
        return Err(bytes.refused(at, field, 0, "1 to 65535"));
    }
    numbers(bytes, [field, shaft], (at, ends), shafts)
}

/// A list of numbers of one byte each, from 0 to `most`, where 0 stands for none. Errors call the
/// count `field`, and a number of the list `item`.
fn numbers(
    bytes: &mut Bytes<'_>,
    [field, item]: [&'static str; 2],
    (at, count): (u64, u64),
    most: u8,
) -> Result<Vec<Vec<u32>>, ReadError> {
    let count = bytes.room_for(at, field, count, 1)?;
    let mut list = room(field, count)?;
    for _ in 0..count {
        let (at, [number]) = (bytes.at(), bytes.take(item)?);
        if number > most {
            return Err(bytes.refused(at, item, number, format_args!("0 to {most}")));
        }
        list.push(Vec::from_iter((number > 0).then_some(number.into())));
    }
    Ok(list)
}

/// A list of `count` masks of `bits` bits, each as the numbers of the bits that are set. `stray`
/// counts the bits beyond, which are left out.
fn masks(
    bytes: &mut Bytes<'_>,
    field: &'static str,
    (at, count): (u64, u64),
    bits: u8,
    stray: &mut u64,
) -> Result<Vec<Vec<u32>>, ReadError> {
    let width = usize::from(bits).div_ceil(8);
    let count = bytes.room_for(at, field, count, width as u64)?;
    let mut list = room(field, count)?;
    for _ in 0..count {
        let mask = bytes.slice(field, width)?;
        let set = (1_u32..).zip(mask.iter().flat_map(|byte| (0..8).map(move |bit| byte >> bit & 1 == 1)));
        let set = set.filter_map(|(number, is_set)| is_set.then_some(number));
        let (known, beyond): (Vec<_>, Vec<_>) = set.partition(|number| *number <= bits.into());
        *stray += beyond.len() as u64;
        list.push(known);
    }
    Ok(list)
}

/// The tie-up and the treadling, or the lift plan. `stray` counts the shafts and treadles that the
/// loom lacks.
fn shedding(bytes: &mut Bytes<'_>, header: &Header, stray: &mut u64) -> Result<Shedding, ReadError> {
    let tie_up = match header.kind {
        Kind::LiftPlan => Vec::new(),
        Kind::Treadle | Kind::Treadles => {
            let all = (bytes.at(), header.treadles.into());
            masks(bytes, "the tie-up", all, header.shafts, stray)?
        }
    };
    let field = "the number of picks";
    let (at, picks) = count(bytes, field)?;
    if picks == 0 {
        return Err(bytes.refused(at, field, 0, "1 to 65535"));
    }
    Ok(match header.kind {
        Kind::LiftPlan => Shedding::LiftPlan(masks(bytes, field, (at, picks), header.shafts, stray)?),
        Kind::Treadle => {
            let treadling = numbers(bytes, [field, "the treadle of a pick"], (at, picks), header.treadles)?;
            Shedding::TieUp { tie_up, treadling }
        }
        Kind::Treadles => {
            let treadling = masks(bytes, field, (at, picks), header.treadles, stray)?;
            Shedding::TieUp { tie_up, treadling }
        }
    })
}

/// The colours of the threads of a set, counted from 0.
struct Colors<'a> {
    /// The place of the first in the file.
    at: u64,
    numbers: &'a [u8],
}

fn colors<'a>(bytes: &mut Bytes<'a>) -> Result<Colors<'a>, ReadError> {
    let field = "the number of colours of threads";
    let (at, count) = count(bytes, field)?;
    let count = bytes.room_for(at, field, count, 1)?;
    Ok(Colors { at: bytes.at(), numbers: bytes.slice(field, count)? })
}

impl Colors<'_> {
    /// The materials of `count` threads, where material 1 is the first of `colors` colours. Threads
    /// beyond the list have none.
    fn materials(
        &self,
        bytes: &Bytes<'_>,
        count: usize,
        colors: usize,
    ) -> Result<Vec<Option<u32>>, ReadError> {
        let mut materials = filled("colours of threads", count, None)?;
        for ((at, number), material) in (self.at..).zip(self.numbers).zip(&mut materials) {
            if usize::from(*number) >= colors {
                let expected = format_args!("below {colors}, the number of colours");
                return Err(bytes.refused(at, "the colour of a thread", number, expected));
            }
            *material = Some(u32::from(*number) + 1);
        }
        Ok(materials)
    }
}

/// The materials of the draft. The first is that of threads without a colour.
fn palette(bytes: &mut Bytes<'_>, version: u8) -> Result<Vec<Material>, ReadError> {
    let _: [u8; 66] = bytes.take("what precedes the colours")?;
    let [count] = bytes.take("the number of colours")?;
    let mut materials = vec![Material::default()];
    for number in 1..=u32::from(count) {
        let rgb: [u8; 3] = bytes.take("a colour")?;
        let fine = |channel: u8| (u32::from(channel.min(63)) * 255 + 31) / 63;
        materials.push(color(number, if version < FINE_COLORS { rgb.map(|c| fine(c) as u8) } else { rgb }));
    }
    Ok(materials)
}
