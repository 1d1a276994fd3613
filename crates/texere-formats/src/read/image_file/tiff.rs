//! TIFF images of one colour channel: grey, or numbers of a palette. The `image` crate, which
//! decodes all other images, reads few of these correctly. A TIFF decoder reads them here, sample
//! by sample. It is given a header in which all samples are grey.

use std::io::{self, Read, Seek, SeekFrom};
use std::path::Path;

use ::tiff::TiffError;
use ::tiff::decoder::{Decoder, Limits};
use ::tiff::tags::{ByteOrder, Tag};
use texere_core::backend::filled;

use super::bytes::Bytes;
use super::image::{Image, Orientation};
use super::limits::{ASIDE_MAX, check_memory, check_size};
use super::refused::{no_color, undecodable};
use crate::read::ReadError;

/// Values of PhotometricInterpretation, TIFF 6.0, pages 37, 69.
const WHITE_IS_ZERO: u16 = 0;
const BLACK_IS_ZERO: u16 = 1;
const PALETTE: u16 = 3;
const CMYK: u16 = 5;

/// The value of PlanarConfiguration that puts each sample in a plane of its own, TIFF 6.0, page 38.
const IN_PLANES: u16 = 2;

/// How a BigTIFF begins, in either order of bytes.
const BIG: [[u8; 4]; 2] = [*b"II+\0", *b"MM\0+"];

/// Bits of NewSubfileType for a page that is a small copy of another page, or its mask.
const BESIDE: u32 = 0b101;

/// The tags of a TIFF's first page that are read before its pixels.
pub(super) struct Header {
    photometric: u16,
    /// The place of the value of PhotometricInterpretation in the file, bytes from its start.
    photometric_at: u64,
    order: ByteOrder,
}

/// Whether a file that begins with `start` is a BigTIFF. The `image` crate reads BigTIFF but does
/// not recognise it.
pub(super) fn is_big(start: &[u8]) -> bool {
    BIG.iter().any(|big| start.starts_with(big))
}

/// Looks at a TIFF's first page, and refuses a file that can't be read here. `None` for a page that
/// the `image` crate reads correctly.
///
/// **Source**: TIFF revision 6.0, Adobe 1992.
pub(super) fn header(path: &Path, file: &mut impl Bytes) -> Result<Option<Header>, ReadError> {
    let refuse = |why: &str| Err(undecodable(path, why));
    match look(file) {
        Ok(Page { photometric: CMYK, .. }) => {
            refuse("its colours are amounts of ink (CMYK), which no two devices show alike; save it as RGB")
        }
        Ok(Page { fill_order: 2, .. }) => {
            refuse("its FillOrder is 2, the bits of each byte turned round; save it with FillOrder 1")
        }
        // In every plane but the first, the decoder takes the tiles at the bottom edge for whole
        // ones, and panics.
        Ok(Page { in_planes_of_tiles: true, .. }) => refuse(
            "its samples lie in planes of tiles (PlanarConfiguration 2); save it with PlanarConfiguration 1",
        ),
        Ok(Page { others: true, .. }) => refuse("it has several pages; save the one that is meant alone"),
        Ok(Page { header, .. }) => Ok(header),
        Err(error) => refuse(&error.to_string()),
    }
}

/// The tags of the first page that decide how the file is read.
struct Page {
    photometric: u16,
    fill_order: u16,
    /// Whether each sample has a plane of its own, cut into tiles.
    in_planes_of_tiles: bool,
    /// Whether other pages follow.
    others: bool,
    header: Option<Header>,
}

fn look(file: &mut impl Bytes) -> Result<Page, TiffError> {
    let mut decoder = Decoder::new(&mut *file)?.with_limits(limits(0));
    let photometric: u16 = decoder.get_tag_unsigned(Tag::PhotometricInterpretation)?;
    let fill_order = decoder.find_tag_unsigned(Tag::FillOrder)?.unwrap_or(1);
    let in_planes =
        decoder.find_tag_unsigned(Tag::PlanarConfiguration)?.is_some_and(|of: u16| of == IN_PLANES);
    let samples: u16 = decoder.find_tag_unsigned(Tag::SamplesPerPixel)?.unwrap_or(1);
    let in_planes_of_tiles = in_planes && samples > 1 && decoder.find_tag(Tag::TileWidth)?.is_some();
    let (order, at) = (decoder.byte_order(), decoder.ifd_pointer());
    let mut others = false;
    while !others && decoder.more_images() && decoder.next_image().is_ok() {
        others = decoder.find_tag_unsigned::<u32>(Tag::NewSubfileType)?.unwrap_or(0) & BESIDE == 0;
    }
    let mut header = None;
    if [WHITE_IS_ZERO, BLACK_IS_ZERO, PALETTE].contains(&photometric)
        && let Some(at) = at
    {
        let photometric_at = entry_at(file, order, at.0, Tag::PhotometricInterpretation.to_u16())?;
        header = photometric_at.map(|photometric_at| Header { photometric, photometric_at, order });
    }
    Ok(Page { photometric, fill_order, in_planes_of_tiles, others, header })
}

/// The place in the file of the value of a tag in the directory at `at`. `None` if the tag is
/// missing or its value is not a SHORT.
fn entry_at(file: &mut impl Bytes, order: ByteOrder, at: u64, tag: u16) -> io::Result<Option<u64>> {
    let number = |bytes: &[u8]| {
        let digits = |number, byte: &u8| number << 8 | u64::from(*byte);
        match order {
            ByteOrder::LittleEndian => bytes.iter().rev().fold(0, digits),
            ByteOrder::BigEndian => bytes.iter().fold(0, digits),
        }
    };
    let mut head = [0; 4];
    file.rewind()?;
    file.read_exact(&mut head)?;
    // In a BigTIFF, counts and offsets are twice as long, and the number of entries is four times
    // as long.
    let (count_bytes, entry_bytes, value) = if number(&head[2..]) == 43 { (8, 20, 12) } else { (2, 12, 8) };
    file.seek(SeekFrom::Start(at))?;
    let mut entry = [0; 20];
    file.read_exact(&mut entry[..count_bytes])?;
    for place in 0..number(&entry[..count_bytes]) {
        file.read_exact(&mut entry[..entry_bytes])?;
        if number(&entry[..2]) == u64::from(tag) {
            let is_short = number(&entry[2..4]) == 3;
            return Ok(is_short.then(|| at + (count_bytes + value) as u64 + place * entry_bytes as u64));
        }
    }
    Ok(None)
}

/// The most bytes that the decoder may use at a time for pixels, for buffers, and for each tag.
fn limits(pixels: usize) -> Limits {
    let bytes = pixels + ASIDE_MAX as usize;
    let mut limits = Limits::default();
    limits.decoding_buffer_size = bytes;
    limits.intermediate_buffer_size = bytes;
    limits.ifd_value_size = bytes;
    limits
}

/// Reads the pixels of the first page, whose `header` is known, as red, green, blue and opacity.
pub(super) fn decode(path: &Path, file: impl Bytes, header: &Header) -> Result<Image, ReadError> {
    let failed = |error: TiffError| undecodable(path, &error.to_string());
    let mut decoder = Grey::new(file, header)
        .map_err(TiffError::from)
        .and_then(Decoder::new)
        .map_err(failed)?
        .with_limits(limits(0));
    let (width, height) = decoder.dimensions().map_err(failed)?;
    check_size(path, width, height)?;
    let (width, height) = (width as usize, height as usize);
    let samples = Samples::read(&mut decoder, header).map_err(failed)?;
    samples.check().map_err(|why| undecodable(path, &why))?;

    let layout = decoder.image_buffer_layout().map_err(failed)?;
    check_memory(path, samples.count, layout.complete_len as u64)?;
    let mut raw = filled("an image", layout.complete_len, 0)?;
    decoder = decoder.with_limits(limits(raw.len()));
    decoder.read_image_bytes(&mut raw).map_err(failed)?;
    let strides = [layout.row_stride, layout.plane_stride].map(|stride| stride.map_or(0, usize::from));
    let is_planar = layout.planes > 1;
    let mut bytes = filled("an image", 4 * width * height, u8::MAX)?;
    for (place, pixel) in bytes.chunks_exact_mut(4).enumerate() {
        let sample = |of: usize| {
            let (plane, number) =
                if is_planar { (of, place % width) } else { (0, place % width * samples.count + of) };
            samples.sample(&raw, place / width * strides[0] + plane * strides[1], number)
        };
        let number = sample(0);
        let Some(rgb) = samples.rgb(number) else {
            return Err(undecodable(path, &no_color(number, samples.map.len() / 3)));
        };
        pixel[..3].copy_from_slice(&rgb);
        if let Some(alpha) = samples.alpha {
            pixel[3] = samples.of_255(sample(alpha));
        }
    }
    Ok(Image { width, height, channels: 4, bytes, orientation: samples.orientation })
}

/// The meaning of the samples of a pixel.
struct Samples {
    photometric: u16,
    count: usize,
    bits: usize,
    are_numbers: bool,
    /// The number of the sample that is opacity, if any.
    alpha: Option<usize>,
    /// Red of all colours of the palette, then green, then blue, each from 0 to 65,535.
    map: Vec<u16>,
    /// The shift that brings colours of the palette to a range of 255.
    shift: u32,
    orientation: Orientation,
}

impl Samples {
    fn read(decoder: &mut Decoder<Grey<impl Bytes>>, header: &Header) -> Result<Self, TiffError> {
        let mut all = |tag| decoder.find_tag_unsigned_vec::<u16>(tag).map(Option::unwrap_or_default);
        let first = |values: Vec<u16>| values.first().copied();
        let count = first(all(Tag::SamplesPerPixel)?).unwrap_or(1).into();
        let extra = all(Tag::ExtraSamples)?;
        // 1 is opacity by which colours have been multiplied, 2 is opacity by which they have not.
        // Both mean the same for a wholly opaque pixel.
        let alpha = extra.iter().position(|of| [1, 2].contains(of));
        let map = all(Tag::ColorMap)?;
        Ok(Self {
            photometric: header.photometric,
            count,
            bits: first(all(Tag::BitsPerSample)?).unwrap_or(1).into(),
            are_numbers: all(Tag::SampleFormat)?.iter().all(|format| *format == 1),
            alpha: alpha.and_then(|place| (count + place).checked_sub(extra.len())),
            // Some programs write palettes in a range of 255. A palette without greater numbers is
            // read in that range, as libtiff does.
            shift: if map.iter().all(|value| *value < 256) { 0 } else { 8 },
            map,
            orientation: Orientation(first(all(Tag::Orientation)?).unwrap_or(1)),
        })
    }

    fn check(&self) -> Result<(), String> {
        if ![1, 2, 4, 8, 16].contains(&self.bits) || !self.are_numbers {
            return Err(format!(
                "its {} bits a sample are not 1, 2, 4, 8 or 16 of a whole number",
                self.bits
            ));
        }
        if self.photometric == PALETTE && self.map.len() < 3 {
            return Err("it has a palette, but no ColorMap".into());
        }
        Ok(())
    }

    /// Sample number `number` of the row that starts at byte `row`.
    fn sample(&self, raw: &[u8], row: usize, number: usize) -> usize {
        let byte = |at: usize| raw.get(row + at).copied().unwrap_or(0);
        let (at, before) = (number * self.bits / 8, number * self.bits % 8);
        if self.bits == 16 {
            return u16::from_ne_bytes([byte(at), byte(at + 1)]).into();
        }
        usize::from(byte(at)) >> (8 - self.bits - before) & ((1 << self.bits) - 1)
    }

    /// A sample scaled to a range of 255.
    fn of_255(&self, sample: usize) -> u8 {
        let most = (1 << self.bits) - 1;
        ((sample * 255 + most / 2) / most) as u8
    }

    /// The colour of a pixel, or `None` if the palette has no colour for its number.
    fn rgb(&self, sample: usize) -> Option<[u8; 3]> {
        let count = self.map.len() / 3;
        match self.photometric {
            PALETTE if sample >= count => None,
            PALETTE => {
                Some([0, 1, 2].map(|channel| (self.map[channel * count + sample] >> self.shift) as u8))
            }
            WHITE_IS_ZERO => Some([u8::MAX - self.of_255(sample); 3]),
            _ => Some([self.of_255(sample); 3]),
        }
    }
}

/// A TIFF file whose header says that its samples are grey, with 0 as black, whatever they really
/// are. The decoder then gives samples as the file has them.
struct Grey<F> {
    file: F,
    /// The place of the next byte in the file.
    at: u64,
    /// The bytes that are read in place of the file's own, with their places.
    replaced: [(u64, u8); 2],
}

impl<F: Bytes> Grey<F> {
    fn new(mut file: F, header: &Header) -> io::Result<Self> {
        file.rewind()?;
        let [first, second] = match header.order {
            ByteOrder::LittleEndian => BLACK_IS_ZERO.to_le_bytes(),
            ByteOrder::BigEndian => BLACK_IS_ZERO.to_be_bytes(),
        };
        let at = header.photometric_at;
        Ok(Self { file, at: 0, replaced: [(at, first), (at + 1, second)] })
    }
}

impl<F: Read> Read for Grey<F> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let read = self.file.read(buffer)?;
        for (at, replaced) in self.replaced {
            let place = at
                .checked_sub(self.at)
                .and_then(|place| buffer[..read].get_mut(usize::try_from(place).ok()?));
            if let Some(byte) = place {
                *byte = replaced;
            }
        }
        self.at += read as u64;
        Ok(read)
    }
}

impl<F: Seek> Seek for Grey<F> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.at = self.file.seek(to)?;
        Ok(self.at)
    }
}
