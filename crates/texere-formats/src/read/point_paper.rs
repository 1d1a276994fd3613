//! Point paper: an image of which each pixel is a crossing.

use std::collections::HashMap;
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};

use image::{GenericImageView, ImageDecoder, ImageReader, Limits, Rgba};
use serde::Deserialize;
use texere_fabric::THREADS_MAX;

use super::ReadError;

/// The most pixels of an image: 16,384 hooks by as many picks, beyond any Jacquard loom.
const PIXELS_MAX: u64 = 1 << 28;

/// The most memory for decoding an image, bytes: four for each pixel.
const MEMORY_MAX: u64 = 4 * PIXELS_MAX;

/// The most colours of a point paper: what a byte numbers. A weaver tells far fewer apart.
const COLORS_MAX: usize = 256;

/// Which pick the first (top) row of an image is.
#[derive(Debug, Clone, Copy, Default, Deserialize)]
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
        let image = decode(path)?;
        let (ends, picks) = (image.width() as usize, image.height() as usize);
        let mut numbers: HashMap<[u8; 4], u8> = HashMap::new();
        let (mut colors, mut pixels) = (Vec::new(), Vec::with_capacity(ends * picks));
        for (row, column) in (0..picks).flat_map(|row| (0..ends).map(move |column| (row, column))) {
            let Rgba(rgba) = image.get_pixel(column as u32, row as u32);
            if let Some(&number) = numbers.get(&rgba) {
                pixels.push(number);
                continue;
            }
            let color = PaperColor { rgba, column: column + 1, row: row + 1 };
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

/// The pixels of an image that is not too large.
fn decode(path: &Path) -> Result<image::DynamicImage, ReadError> {
    let io = |source| ReadError::Io { file: path.into(), source };
    let undecodable = |source| ReadError::Image { file: path.into(), source: Box::new(source) };
    let file = BufReader::new(File::open(path).map_err(io)?);
    let mut reader = ImageReader::new(file).with_guessed_format().map_err(io)?;
    let mut limits = Limits::default();
    limits.max_alloc = Some(MEMORY_MAX);
    reader.limits(limits.clone());
    let mut decoder = reader.into_decoder().map_err(undecodable)?;
    let (width, height) = decoder.dimensions();
    let side_limit = THREADS_MAX as u32;
    if width.max(height) > side_limit || u64::from(width) * u64::from(height) > PIXELS_MAX {
        let file = path.into();
        return Err(ReadError::ImageTooLarge { file, width, height, side_limit, limit: PIXELS_MAX });
    }
    limits.reserve(decoder.total_bytes()).map_err(undecodable)?;
    decoder.set_limits(limits).map_err(undecodable)?;
    image::DynamicImage::from_decoder(decoder).map_err(undecodable)
}
