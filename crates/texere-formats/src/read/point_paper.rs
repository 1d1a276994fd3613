//! Point paper: an image of which each pixel is a crossing.

use std::collections::HashMap;
use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use image::{ColorType, ImageDecoder, ImageError, ImageFormat, ImageReader, Limits};
use serde::Deserialize;
use texere_fabric::THREADS_MAX;

use super::error::said;
use super::memory::{filled, room};
use super::{ReadError, file};

/// The most pixels of an image: 16,384 hooks by as many picks, beyond any Jacquard loom.
const PIXELS_MAX: u64 = 1 << 28;

/// The most memory for an image's pixels, bytes: four for each.
const MEMORY_MAX: u64 = 4 * PIXELS_MAX;

/// The most memory for what a decoder needs beside the pixels, bytes: a line or a tile of them, and what the file says of
/// its picture. A colour profile has no more than a few MiB; compressed, one of a gigabyte fits a small file.
const ASIDE_MAX: u64 = 1 << 25;

/// The largest image file that is read: one that is not compressed.
const FILE_LIMIT: u64 = MEMORY_MAX + ASIDE_MAX;

/// The most pixels that a byte of a PNG stands for: DEFLATE makes at most 1,032 bytes of one, and each is eight pixels of
/// one bit. So a short file takes no memory for pixels that it can't have.
const PIXELS_PER_BYTE: u64 = 8 * 1032;

/// The most colours of a point paper: as many as a byte can number, and far more than a weaver uses.
const COLORS_MAX: usize = 256;

/// Which pick the first (top) row of an image is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum RowOrder {
    /// As a weaver draws: the first pick at the bottom.
    #[default]
    LastPickFirst,
    FirstPickFirst,
}

/// An image, read: a colour for each crossing.
#[derive(Debug)]
pub(super) struct PointPaper {
    pub(super) file: PathBuf,
    pub(super) ends: usize,
    pub(super) picks: usize,
    /// The colours, in the order in which they come in the image, row by row from the top.
    pub(super) colors: Vec<PaperColor>,
    /// Numbers of colours, row by row from the top.
    pixels: Vec<u8>,
    rows: RowOrder,
}

/// A colour of a point paper and the first pixel that has it.
#[derive(Debug, Clone, Copy)]
pub(super) struct PaperColor {
    rgba: [u8; 4],
    column: usize,
    row: usize,
}

impl PointPaper {
    pub(super) fn read(path: &Path, rows: RowOrder) -> Result<Self, ReadError> {
        let image = Image::decode(path)?;
        let (ends, picks) = (image.width, image.height);
        let mut numbers: HashMap<[u8; 4], u8> = HashMap::new();
        let mut colors = Vec::new();
        let mut pixels = room("the pixels of an image", ends * picks)?;
        for (place, rgba) in image.pixels().enumerate() {
            if let Some(&number) = numbers.get(&rgba) {
                pixels.push(number);
                continue;
            }
            let color = PaperColor { rgba, column: place % ends + 1, row: place / ends + 1 };
            if colors.len() == COLORS_MAX {
                let expected = format!("one of the {COLORS_MAX} colours before it; it is one too many");
                return Err(color.refused(path, expected));
            }
            let number = colors.len() as u8;
            numbers.insert(rgba, number);
            colors.push(color);
            pixels.push(number);
        }
        Ok(Self { file: path.into(), ends, picks, colors, pixels, rows })
    }

    /// Which of `colors` stands where `end` and `pick` of an endless cloth of this paper cross, both from 0.
    pub(super) fn color(&self, end: usize, pick: usize) -> usize {
        let (end, pick) = (end % self.ends, pick % self.picks);
        let row = match self.rows {
            RowOrder::LastPickFirst => self.picks - 1 - pick,
            RowOrder::FirstPickFirst => pick,
        };
        self.pixels[row * self.ends + end].into()
    }

    /// Which of its two colours, one of them darker, is the darker one.
    pub(super) fn darker(&self) -> Result<usize, ReadError> {
        let expected =
            "two colours, the darker of which is warp up; more of them need a table [weave.colors]";
        match self.colors[..] {
            [first, second] if first.luma() != second.luma() => Ok(usize::from(second.luma() < first.luma())),
            [_, _, odd, ..] | [.., odd] => Err(odd.refused(&self.file, expected.into())),
            // No image has no pixel.
            [] => Ok(0),
        }
    }
}

impl PaperColor {
    /// Its `[red, green, blue]`; `None` where it is not opaque.
    pub(super) fn rgb(&self) -> Option<[u8; 3]> {
        let [red, green, blue, alpha] = self.rgba;
        (alpha == u8::MAX).then_some([red, green, blue])
    }

    /// The refusal of its first pixel.
    pub(super) fn refused(&self, file: &Path, expected: String) -> ReadError {
        let [red, green, blue, alpha] = self.rgba;
        let opacity = if alpha == u8::MAX { String::new() } else { format!("{alpha:02x}") };
        ReadError::Pixel {
            file: file.into(),
            column: self.column,
            row: self.row,
            color: format!("#{red:02x}{green:02x}{blue:02x}{opacity}"),
            expected,
        }
    }

    /// How light it looks, by the weights of ITU-R BT.601, in thousandths.
    fn luma(&self) -> u32 {
        let [red, green, blue, _] = self.rgba.map(u32::from);
        299 * red + 587 * green + 114 * blue
    }
}

/// An image that is not too large, as its decoder gives it.
struct Image {
    width: usize,
    height: usize,
    kind: ColorType,
    bytes: Vec<u8>,
}

impl Image {
    fn decode(path: &Path) -> Result<Self, ReadError> {
        let io = |source| ReadError::Io { file: path.into(), source };
        // Decoders say much, and what a file says, too.
        let undecodable = |error: ImageError| ReadError::Image {
            file: path.into(),
            source: said(&error.to_string()).into(),
        };
        let file = file::open(path, FILE_LIMIT)?;
        let file_bytes = file.metadata().map_err(io)?.len();
        let file = BufReader::new(file);
        let mut reader = ImageReader::new(file).with_guessed_format().map_err(io)?;
        let format = reader.format();
        if format == Some(ImageFormat::Png) {
            let mut file = reader.into_inner();
            if let Some(bytes) = broken_palette(&mut file).map_err(io)? {
                let source =
                    format!("it has a palette of {bytes} bytes, not three for each of 1 to 256 colours");
                return Err(ReadError::Image { file: path.into(), source: source.into() });
            }
            file.rewind().map_err(io)?;
            reader = ImageReader::with_format(file, ImageFormat::Png);
        }
        // These are for what stands before the pixels; a PNG's text and colour profile are not asked for their own.
        let mut limits = Limits::default();
        limits.max_alloc = Some(ASIDE_MAX);
        reader.limits(limits.clone());
        let mut decoder = reader.into_decoder().map_err(undecodable)?;
        let (width, height) = decoder.dimensions();
        let side_limit = THREADS_MAX as u32;
        if width.max(height) > side_limit || u64::from(width) * u64::from(height) > PIXELS_MAX {
            let file = path.into();
            return Err(ReadError::ImageTooLarge { file, width, height, side_limit, limit: PIXELS_MAX });
        }
        let is_png = format == Some(ImageFormat::Png);
        if is_png && u64::from(width) * u64::from(height) > PIXELS_PER_BYTE * file_bytes {
            let source = format!("its {file_bytes} bytes are too few for {width} × {height} pixels");
            return Err(ReadError::Image { file: path.into(), source: source.into() });
        }
        let (kind, size) = (decoder.color_type(), decoder.total_bytes());
        limits.max_alloc = Some(MEMORY_MAX);
        limits.reserve(size).map_err(undecodable)?;
        limits.max_alloc = Some(2 * size + ASIDE_MAX);
        decoder.set_limits(limits).map_err(undecodable)?;

        let mut bytes = filled("an image", size as usize, 0)?;
        // Decoders take up to as much again and do not ask whether it is there.
        drop(room::<u8>("decoding an image", (size + ASIDE_MAX) as usize)?);
        decoder.read_image(&mut bytes).map_err(undecodable)?;
        Ok(Self { width: width as usize, height: height as usize, kind, bytes })
    }

    /// Red, green, blue and opacity of each pixel, row by row from the top.
    fn pixels(&self) -> impl Iterator<Item = [u8; 4]> {
        let channels = usize::from(self.kind.channel_count());
        let width = usize::from(self.kind.bytes_per_pixel()) / channels;
        self.bytes.chunks_exact(width * channels).map(move |pixel| {
            let channel = |number: usize| match pixel[number * width..][..width] {
                [byte] => byte,
                // Of 65,535, rounded.
                [low, high] => ((u32::from(u16::from_ne_bytes([low, high])) + 128) / 257) as u8,
                [a, b, c, d] => (f32::from_ne_bytes([a, b, c, d]).clamp(0.0, 1.0) * 255.0).round() as u8,
                _ => 0,
            };
            match channels {
                1 => [channel(0), channel(0), channel(0), u8::MAX],
                2 => [channel(0), channel(0), channel(0), channel(1)],
                3 => [channel(0), channel(1), channel(2), u8::MAX],
                _ => [channel(0), channel(1), channel(2), channel(3)],
            }
        })
    }
}

/// The bytes of a PNG's palette where they are not those of whole colours, 256 at most: the decoder takes that for granted.
fn broken_palette(file: &mut BufReader<File>) -> io::Result<Option<u32>> {
    // Behind the signature each chunk has its length, its name, its data and a checksum.
    file.seek(SeekFrom::Start(8))?;
    let mut head = [0; 8];
    loop {
        match file.read_exact(&mut head) {
            // What is missing the decoder will miss too.
            Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => return Ok(None),
            other => other?,
        }
        let [a, b, c, d, name @ ..] = head;
        let length = u32::from_be_bytes([a, b, c, d]);
        match &name {
            b"IDAT" | b"IEND" => return Ok(None),
            b"PLTE" if !length.is_multiple_of(3) || !(3..=768).contains(&length) => return Ok(Some(length)),
            _ => file.seek_relative(i64::from(length) + 4)?,
        }
    }
}
