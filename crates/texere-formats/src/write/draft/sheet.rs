//! A sheet of squared paper: blocks of squares with a legend below. The sheet is painted one row of
//! pixels at a time.

use std::io::Write;

use super::super::picture::{encoder_room, refused};
use super::super::target::Target;
use super::super::{Output, WriteError};
use super::font::{self, GLYPH_HEIGHT, GLYPH_WIDTH};

/// The colour of a pixel.
pub(super) type Rgb = [u8; 3];

/// The colour of the background.
pub(super) const PAPER: Rgb = [255, 255, 255];

/// The colour of the drawing and of the legend.
pub(super) const INK: Rgb = [0, 0, 0];

/// The colours of a line between squares, and of a line between groups of squares.
const LINES: [Rgb; 2] = [[184, 184, 184], [88, 88, 88]];

/// Number of squares of a group. Point paper is printed in groups of eight.
const GROUP: usize = 8;

/// The shortest side of a square that is drawn with lines round it, pixels. In a smaller square the
/// line, one pixel wide, would take a third of the side or more.
const LINED_MIN: usize = 4;

/// The margin round the sheet, pixels.
const MARGIN: usize = 12;

/// The side of a dot of the legend's letters, pixels.
const DOT: usize = 2;

/// The distance from one line of the legend to the next, in dots of letters.
const LEADING: usize = GLYPH_HEIGHT + 3;

/// A rectangle of squares.
pub(super) struct Block<'a> {
    /// The left and the top of the block, pixels.
    pub(super) place: [usize; 2],
    /// Number of columns and rows.
    pub(super) squares: [usize; 2],
    /// Width and height of a square, pixels.
    pub(super) square: [usize; 2],
    /// The colour of a pixel. The arguments are the column of its square, the square's row from the
    /// top, and the pixel's place in the square.
    pub(super) color: Box<dyn Fn(usize, usize, [usize; 2]) -> Rgb + 'a>,
}

impl Block<'_> {
    fn lined(&self) -> bool {
        self.square[0].min(self.square[1]) >= LINED_MIN
    }

    /// The right and the bottom end of the block, its closing line included.
    fn end(&self) -> [usize; 2] {
        let line = usize::from(self.lined());
        [0, 1].map(|axis| self.place[axis] + self.squares[axis] * self.square[axis] + line)
    }
}

/// Blocks in their places, and a legend.
pub(super) struct Sheet<'a> {
    /// Width and height, pixels.
    pub(super) size: [usize; 2],
    /// The gap between two blocks, pixels.
    gap: usize,
    /// Whether columns are counted from the right.
    mirrored: bool,
    blocks: Vec<Block<'a>>,
    legend: Vec<String>,
    legend_top: usize,
}

impl<'a> Sheet<'a> {
    /// The place of the first block.
    pub(super) const ORIGIN: [usize; 2] = [MARGIN; 2];

    pub(super) const fn new(gap: usize, mirrored: bool) -> Self {
        Self { size: [0; 2], gap, mirrored, blocks: Vec::new(), legend: Vec::new(), legend_top: 0 }
    }

    /// Puts a block in its place. Returns the left of a block beside it and the top of a block
    /// below it, pixels.
    pub(super) fn put(&mut self, block: Block<'a>) -> [usize; 2] {
        let end = block.end();
        self.size = [0, 1].map(|axis| self.size[axis].max(end[axis] + MARGIN));
        self.blocks.push(block);
        end.map(|end| end + self.gap)
    }

    /// Puts lines of text below everything.
    pub(super) fn close(&mut self, legend: Vec<String>) {
        let longest = legend.iter().map(|line| line.chars().count()).max().unwrap_or(0);
        self.legend_top = self.size[1];
        let wide = longest * (GLYPH_WIDTH + 1) * DOT + 2 * MARGIN;
        self.size = [self.size[0].max(wide), self.legend_top + legend.len() * LEADING * DOT + MARGIN];
        self.legend = legend;
    }

    /// Writes the sheet to a PNG file. Returns the sheet's width and height in pixels.
    ///
    /// **Errors**: [`WriteError::Spared`], and [`WriteError::Io`], also for a lack of memory.
    pub(super) fn save(&self, output: Output) -> Result<[u32; 2], WriteError> {
        let target = self.encoded(Target::create(output)?)?;
        target.commit()?;
        Ok(self.size.map(|side| side as u32))
    }

    /// Writes the sheet to `out` as PNG. Returns the sheet's width and height in pixels.
    ///
    /// **Errors**: [`WriteError::Writer`] if `out` refuses bytes, or for a lack of memory.
    pub(super) fn save_to(&self, out: impl Write) -> Result<[u32; 2], WriteError> {
        let target = self.encoded(Target::straight(out))?;
        target.done()?;
        Ok(self.size.map(|side| side as u32))
    }

    fn encoded<W: Write>(&self, mut target: Target<W>) -> Result<Target<W>, WriteError> {
        encoder_room().map_err(|source| target.failed(source))?;
        self.write(&mut target).map_err(|error| target.failed(refused(error)))?;
        Ok(target)
    }

    fn write(&self, out: impl Write) -> Result<(), png::EncodingError> {
        let mut encoder = png::Encoder::new(out, self.size[0] as u32, self.size[1] as u32);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        let mut header = encoder.write_header()?;
        let mut rows = header.stream_writer()?;
        let mut row = vec![PAPER; self.size[0]];
        for y in 0..self.size[1] {
            row.fill(PAPER);
            self.paint(y, &mut row);
            rows.write_all(row.as_flattened())?;
        }
        rows.finish()?;
        header.finish()
    }

    /// Paints row `y` of the sheet, counted from the top, into `pixels`, which are all [`PAPER`]
    /// before the call.
    fn paint(&self, y: usize, pixels: &mut [Rgb]) {
        for block in &self.blocks {
            let [left, top] = block.place;
            let [right, bottom] = block.end();
            if !(top..bottom).contains(&y) {
                continue;
            }
            let across = self.line(block, 1, y - top);
            for (x, pixel) in pixels.iter_mut().enumerate().take(right).skip(left) {
                let line = across.max(self.line(block, 0, x - left));
                *pixel = match line {
                    Some(group) => LINES[usize::from(group)],
                    None => {
                        let [at, down] = [x - left, y - top];
                        let [wide, high] = block.square;
                        (block.color)(at / wide, down / high, [at % wide, down % high])
                    }
                };
            }
        }
        let dots = y.checked_sub(self.legend_top).map(|below| below / DOT);
        if let Some((dots, line)) = dots.and_then(|dots| Some((dots, self.legend.get(dots / LEADING)?))) {
            for (place, letter) in line.chars().enumerate() {
                let bits = font::row(letter, dots % LEADING);
                for dot in (0..GLYPH_WIDTH).filter(|dot| bits >> (GLYPH_WIDTH - 1 - dot) & 1 == 1) {
                    let x = MARGIN + (place * (GLYPH_WIDTH + 1) + dot) * DOT;
                    pixels[x..x + DOT].fill(INK);
                }
            }
        }
    }

    /// The line at pixel `at` of a block along an axis: true for a line between groups or at the
    /// block's edge, false for a line between squares. `None` if there is no line.
    fn line(&self, block: &Block<'_>, axis: usize, at: usize) -> Option<bool> {
        let (squares, square) = (block.squares[axis], block.square[axis]);
        if !block.lined() || !at.is_multiple_of(square) {
            return None;
        }
        let before = at / square;
        // Groups of ends are counted from end 1, which is on the right if the sheet is mirrored.
        // Groups of picks are counted from the bottom.
        let counted = if axis == 1 || self.mirrored { squares - before } else { before };
        Some(counted.is_multiple_of(GROUP) || before == 0 || before == squares)
    }
}
