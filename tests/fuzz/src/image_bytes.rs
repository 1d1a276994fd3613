//! Mutations of image files that respect the files' chunks and fields.

use std::io::Cursor;

use fastrand::Rng;
use image::{DynamicImage, GrayImage, ImageFormat, Luma, Rgb, RgbImage, Rgba, RgbaImage};

use crate::text::scrambled;

/// Values of fields that readers treat differently from their neighbours.
const FIELDS: &[u32] = &[
    0,
    1,
    2,
    3,
    4,
    7,
    8,
    9,
    15,
    16,
    24,
    31,
    32,
    33,
    64,
    255,
    256,
    4096,
    16_384,
    16_385,
    65_535,
    65_536,
    0x00ff_ffff,
    1 << 28,
    i32::MAX as u32,
    1 << 31,
    u32::MAX - 1,
    u32::MAX,
];

pub(crate) fn mutated(random: &mut Rng) -> Vec<u8> {
    let (format, mut bytes) = seed(random);
    for _ in 0..random.usize(0..4) {
        match format {
            ImageFormat::Png if random.u8(0..4) > 0 => chunks(&mut bytes, random),
            _ if random.bool() => field(&mut bytes, random),
            _ => scrambled(&mut bytes, random),
        }
    }
    bytes
}

/// A small picture, which is mutated only one time in four, so that inputs more often reach the
/// code that uses its colours.
pub(crate) fn plain(random: &mut Rng) -> Vec<u8> {
    if random.u8(0..4) == 0 { mutated(random) } else { seed(random).1 }
}

/// A small picture in one of the formats.
fn seed(random: &mut Rng) -> (ImageFormat, Vec<u8>) {
    const COLORS: [[u8; 3]; 3] = [[0, 0, 0], [255, 255, 255], [200, 16, 32]];
    let (width, height, colors) = (random.u32(1..9), random.u32(1..9), random.usize(1..4));
    let mut color = |_, _| COLORS[random.usize(..colors)];
    let picture: DynamicImage = match (width + height) % 4 {
        0 => RgbImage::from_fn(width, height, |x, y| Rgb(color(x, y))).into(),
        1 => GrayImage::from_fn(width, height, |x, y| Luma([color(x, y)[0]])).into(),
        2 => {
            DynamicImage::from(RgbImage::from_fn(width, height, |x, y| Rgb(color(x, y)))).into_rgb16().into()
        }
        _ => RgbaImage::from_fn(width, height, |x, y| {
            let [red, green, blue] = color(x, y);
            Rgba([red, green, blue, 255])
        })
        .into(),
    };
    let format = [ImageFormat::Png, ImageFormat::Bmp, ImageFormat::Tiff][random.usize(..3)];
    // BMP has no 16 bits per channel.
    let picture = if format == ImageFormat::Bmp { picture.into_rgb8().into() } else { picture };
    let mut bytes = Cursor::new(Vec::new());
    if format == ImageFormat::Png && random.bool() {
        return (format, palette(width, height, random));
    }
    picture.write_to(&mut bytes, format).expect("a picture in memory");
    (format, bytes.into_inner())
}

/// A PNG whose pixels are palette numbers of a few bits each.
fn palette(width: u32, height: u32, random: &mut Rng) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_palette(vec![0, 0, 0, 255, 255, 255]);
    let bits = if random.bool() { 1 } else { 4 };
    encoder.set_depth(if bits == 1 { png::BitDepth::One } else { png::BitDepth::Four });
    let row = (width as usize * bits).div_ceil(8);
    let mask = if bits == 1 { 0xff } else { 0x11 };
    let data: Vec<u8> = (0..row * height as usize).map(|_| random.u8(..) & mask).collect();
    let mut writer = encoder.write_header().expect("a header in memory");
    writer.write_image_data(&data).expect("a picture in memory");
    drop(writer);
    bytes
}

/// Sets a field of two or four bytes to one of [`FIELDS`], in either byte order.
pub(crate) fn field(bytes: &mut [u8], random: &mut Rng) {
    let value = FIELDS[random.usize(..FIELDS.len())];
    let wide = if random.bool() { 4 } else { 2 };
    if bytes.len() < wide {
        return;
    }
    // Most fields lie in headers, which come first.
    let most = if random.bool() { bytes.len().min(64) } else { bytes.len() };
    let at = random.usize(..=most.max(wide) - wide);
    let written = if random.bool() { value.to_le_bytes() } else { value.to_be_bytes() };
    let part = if random.bool() { &written[..wide] } else { &written[4 - wide..] };
    bytes[at..at + wide].copy_from_slice(part);
}

/// Takes a PNG apart, changes, adds, removes or moves one of its chunks, and gives each chunk a
/// fitting checksum.
fn chunks(bytes: &mut Vec<u8>, random: &mut Rng) {
    let Some((magic, mut rest)) = bytes.split_at_checked(8) else { return };
    let mut chunks: Vec<([u8; 4], Vec<u8>)> = Vec::new();
    while let Some((head, after)) = rest.split_first_chunk::<8>() {
        let length = u32::from_be_bytes([head[0], head[1], head[2], head[3]]) as usize;
        let Some(data) = after.get(..length) else { break };
        chunks.push(([head[4], head[5], head[6], head[7]], data.to_vec()));
        rest = after.get(length + 4..).unwrap_or_default();
    }
    if chunks.is_empty() {
        return;
    }
    let at = random.usize(..chunks.len());
    match random.u8(0..8) {
        0 => drop(chunks.remove(at)),
        1 => chunks.insert(at, chunks[random.usize(..chunks.len())].clone()),
        2 => chunks.swap(at, 0),
        3 => {
            let kinds = [
                b"iCCP", b"zTXt", b"tEXt", b"iTXt", b"tRNS", b"PLTE", b"gAMA", b"acTL", b"fcTL", b"fdAT",
                b"eXIf", b"IEND",
            ];
            let data = (0..random.usize(0..64)).map(|_| random.u8(..)).collect();
            chunks.insert(at, (*kinds[random.usize(..kinds.len())], data));
        }
        4 | 5 => field(&mut chunks[at].1, random),
        6 => scrambled(&mut chunks[at].1, random),
        _ => field(&mut chunks[0].1, random),
    }
    let mut whole = magic.to_vec();
    for (kind, data) in chunks {
        let mut checked = kind.to_vec();
        checked.extend(&data);
        whole.extend((data.len() as u32).to_be_bytes());
        whole.extend(&checked);
        whole.extend(crc32fast::hash(&checked).to_be_bytes());
    }
    *bytes = whole;
}
