//! Mutations of files of saved yarns, half of which get a fitting length and checksum, and of files
//! of curves.

use fastrand::Rng;
use texere_core::{Boundary, ControlPoint, Ends, Material, Origin, Section, Yarn, Yarns};
use texere_formats::write::{self, CurveFormat};

use crate::image_bytes::field;
use crate::text::scrambled;

/// The first byte of the field that holds a file's length, and the number of bytes of the checksum
/// at the file's end.
const LENGTH_AT: usize = 16;
const CHECKSUM: usize = 4;

/// A small file of yarns, mutated.
pub(crate) fn mutated(random: &mut Rng) -> Vec<u8> {
    let (yarns, boundary) = seed(random);
    let mut bytes = Vec::new();
    write::repeat_to(&yarns, &boundary, &mut bytes).expect("a file in memory");
    change(&mut bytes, random);
    if random.bool() {
        seal(&mut bytes);
    }
    bytes
}

/// A small file of curves, mutated.
pub(crate) fn mutated_curves(random: &mut Rng) -> Vec<u8> {
    let mut bytes = Vec::new();
    write::curves_to(&seed(random).0, CurveFormat::Bcc, &mut bytes).expect("a file in memory");
    change(&mut bytes, random);
    bytes
}

/// Changes a file in up to three places.
pub(crate) fn change(bytes: &mut Vec<u8>, random: &mut Rng) {
    for _ in 0..random.usize(0..4) {
        match random.u8(0..8) {
            0 => scrambled(bytes, random),
            1..4 => field(bytes, random),
            // A change of a single bit leaves most numbers valid.
            _ if bytes.is_empty() => {}
            _ => {
                let at = random.usize(..bytes.len());
                bytes[at] ^= 1 << random.u8(0..8);
            }
        }
    }
}

fn seal(bytes: &mut [u8]) {
    let length = (bytes.len() as u64).to_le_bytes();
    if let Some(place) = bytes.get_mut(LENGTH_AT..LENGTH_AT + length.len()) {
        place.copy_from_slice(&length);
    }
    if let Some((content, checksum)) = bytes.split_last_chunk_mut::<CHECKSUM>() {
        *checksum = crc32fast::hash(content).to_le_bytes();
    }
}

/// One to four yarns of random kinds, and how they end.
fn seed(random: &mut Rng) -> (Yarns, Boundary) {
    let mut yarns = Yarns::builder();
    yarns.material(Material { name: "ecru".into(), tex: Some(30.0), hairiness: 5.0, ..Material::default() });
    yarns.material(Material::default());
    for section in [
        Section::Ellipse { aspect: 1.5 },
        Section::Lenticular { aspect: 2.0, distortion: 0.2 },
        Section::PowerEllipse { aspect: 2.0, exponent: 0.6 },
        Section::plied(3),
        Section::Lobed { plies: 2, valley: 0.8 },
        Section::Polygon(vec![[1.0, -0.5], [1.0, 0.5], [-1.0, 0.5], [-1.0, -0.5]]),
    ] {
        if random.bool() {
            yarns.section(section);
        }
    }
    let sections = yarns.section(Section::Circle) + 1;
    let mut ends = Vec::new();
    for number in 0..random.u32(1..5) {
        let how = [Ends::Open, Ends::Closed, Ends::Repeats([1, 0])][random.usize(..3)];
        let origins = [
            Origin::Unknown,
            Origin::End(number),
            Origin::Pick(number),
            Origin::Course(1),
            Origin::Carrier(2),
            Origin::Guide { bar: 1, guide: number },
        ];
        let points: Vec<_> = (0..random.u32(3..7))
            .map(|point| {
                let (sin, cos) = (point as f32).sin_cos();
                ControlPoint::new(cos, sin + number as f32, 0.3 * sin, 0.1).flattened(0.15, 0.1)
            })
            .collect();
        let yarn = Yarn {
            material: random.u32(..2),
            section: random.u32(..sections),
            closed: how == Ends::Closed,
            twist: [0.0, 1.5][random.usize(..2)],
            origin: origins[random.usize(..origins.len())],
        };
        yarns.yarn(yarn, &points);
        ends.push(how);
    }
    let mut yarns = yarns.build().expect("sound yarns");
    let count = yarns.points().len();
    if random.bool() {
        yarns = yarns.with_ups(vec![[0.0, 0.6, 0.8]; count]).expect("an up for each point");
    }
    if random.bool() {
        yarns = yarns.with_sources((0..count as u32).collect()).expect("a source for each point");
    }
    let boundary = Boundary::new(yarns.layout(), [3.0, 0.0], ends).expect("a sound boundary");
    (yarns, boundary)
}
