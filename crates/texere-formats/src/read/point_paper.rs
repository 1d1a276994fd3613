//! Point paper: an image of which each pixel is a crossing of a weave, a stitch of a weft knit, or
//! a guide of a Jacquard bar at one round of the bar's chain.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use texere_core::backend::room;

use super::file::Files;
use super::{ReadError, image_file};

/// The most colours of a point paper. A byte can number them, and a weaver uses far fewer.
const COLORS_MAX: usize = 256;

/// A pixel that is wholly transparent.
const NOTHING: [u8; 4] = [0; 4];

/// The pick that the top row of an image stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum RowOrder {
    /// The first pick is at the bottom, as weavers draw.
    #[default]
    LastPickFirst,
    FirstPickFirst,
}

/// Point paper, read: a colour for each pixel.
#[derive(Debug)]
pub(super) struct PointPaper {
    pub(super) file: PathBuf,
    pub(super) ends: usize,
    pub(super) picks: usize,
    /// The colours in the order of their first pixels, row by row from the top.
    pub(super) colors: Vec<PaperColor>,
    /// The number of each pixel's colour, row by row from the top.
    pixels: Vec<u8>,
    rows: RowOrder,
}

/// A colour of a point paper, and column and row of its first pixel, counted from 1.
#[derive(Debug, Clone, Copy)]
pub(super) struct PaperColor {
    rgba: [u8; 4],
    column: usize,
    row: usize,
}

impl PointPaper {
    pub(super) fn read(path: &Path, files: &Files<'_>, rows: RowOrder) -> Result<Self, ReadError> {
        let image = image_file::decode(path, files)?;
        let [ends, picks] = image.size();
        let mut numbers: HashMap<[u8; 4], u8> = HashMap::new();
        let mut colors = Vec::new();
        let mut pixels = room("the pixels of an image", ends * picks)?;
        for (place, rgba) in image.pixels().enumerate() {
            // Wholly transparent pixels look alike, so their hidden colours do not count.
            let rgba = if rgba[3] == 0 { NOTHING } else { rgba };
            if let Some(&number) = numbers.get(&rgba) {
                pixels.push(number);
                continue;
            }
            let color = PaperColor { rgba, column: place % ends + 1, row: place / ends + 1 };
            if ![0, u8::MAX].contains(&rgba[3]) {
                let expected = "an opaque pixel, or a wholly transparent one; what is half transparent looks otherwise on each ground";
                return Err(color.refused(path, expected.into()));
            }
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

    /// The number of the colour at the crossing of `end` and `pick`, both counted from 0, of a
    /// cloth that repeats this paper without end.
    pub(super) fn color(&self, end: usize, pick: usize) -> usize {
        let (end, pick) = (end % self.ends, pick % self.picks);
        let row = match self.rows {
            RowOrder::LastPickFirst => self.picks - 1 - pick,
            RowOrder::FirstPickFirst => pick,
        };
        self.pixels[row * self.ends + end].into()
    }

    /// The number of the darker one of the paper's two colours. A paper with more or fewer colours,
    /// or with two that are equally light, is refused.
    pub(super) fn darker(&self) -> Result<usize, ReadError> {
        let expected =
            "two colours, the darker of which is warp up; more of them need a table [weave.colors]";
        match self.colors[..] {
            [first, second] if first.luma() != second.luma() => Ok(usize::from(second.luma() < first.luma())),
            [_, _, odd, ..] | [.., odd] => Err(odd.refused(&self.file, expected.into())),
            // Every image has a pixel.
            [] => Ok(0),
        }
    }
}

impl PaperColor {
    /// The colour's `[red, green, blue]`, or `None` if the colour is not opaque.
    pub(super) fn rgb(&self) -> Option<[u8; 3]> {
        let [red, green, blue, alpha] = self.rgba;
        (alpha == u8::MAX).then_some([red, green, blue])
    }

    /// The refusal of the colour's first pixel.
    pub(super) fn refused(&self, file: &Path, expected: String) -> ReadError {
        let [red, green, blue, alpha] = self.rgba;
        let opacity = match alpha {
            u8::MAX => "",
            0 => ", wholly transparent (alpha 0)",
            _ => &format!(", partly transparent (alpha {alpha} of 255)"),
        };
        ReadError::Pixel {
            file: file.into(),
            column: self.column,
            row: self.row,
            color: format!("#{red:02x}{green:02x}{blue:02x}{opacity}"),
            expected,
        }
    }

    /// How light the colour looks: its luma by the weights of ITU-R BT.601, times 1000. A
    /// transparent pixel counts as lighter than any colour.
    fn luma(&self) -> u32 {
        if self.rgba == NOTHING {
            return u32::MAX;
        }
        let [red, green, blue, _] = self.rgba.map(u32::from);
        299 * red + 587 * green + 114 * blue
    }
}
