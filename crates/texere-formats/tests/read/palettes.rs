//! Images of palette numbers. Each pixel has the colour of its number, and a number without a
//! colour is refused by name. The test makes the bytes of the pixels itself.

use std::error::Error;
use std::io::Write;

use crate::images::design;

/// Number of columns and of rows. With 1, 2 or 4 bits a pixel a row needs more than one byte, and
/// does not fill the last one.
const SIZE: [usize; 2] = [11, 9];

/// Checks that the warp is up where pixels are dark.
#[track_caller]
fn shows(name: &str, bytes: &[u8], is_dark: impl Fn(usize, usize) -> bool) {
    let design = design(name, bytes, "").unwrap();
    let drawdown = design.structure.woven().unwrap().cloth().drawdown();
    assert_eq!([drawdown.ends(), drawdown.picks()], SIZE);
    for row in 0..SIZE[1] {
        for column in 0..SIZE[0] {
            let up = drawdown.up(column, SIZE[1] - 1 - row);
            assert_eq!(up, is_dark(column, row), "{name}: column {column}, row {row}");
        }
    }
}

#[track_caller]
fn refuses(name: &str, bytes: &[u8], number: usize, colors: &str) {
    let error = design(name, bytes, "").expect_err("it is taken");
    let error = error.innermost();
    let told = format!("{error}: {}", error.source().map(ToString::to_string).unwrap_or_default());
    let why = format!("number {number} of a palette of {colors}");
    assert!(told.contains(name) && told.contains(&why), "\"{told}\" lacks \"{name}\" or \"{why}\"");
}

/// A row of numbers with this number of bits. Unused bits of the last byte are ones, which are no
/// pixels.
fn packed(bits: usize, row: &[usize]) -> Vec<u8> {
    let mut line = vec![0u8; (row.len() * bits).div_ceil(8)];
    for place in 0..line.len() * 8 / bits {
        let number = row.get(place).copied().unwrap_or((1 << bits) - 1);
        line[place * bits / 8] |= (number as u8) << (8 - bits - place * bits % 8);
    }
    line
}

/// A palette that is dark at number 1 and light at all other numbers.
fn palette(colors: usize) -> Vec<u8> {
    (0..colors).flat_map(|number| if number == 1 { [20, 10, 60] } else { [250, 240, 60] }).collect()
}

/// The seven passes of Adam7: first column and row, and steps between columns and between rows (PNG
/// 1.2, 2.6).
const ADAM7: [[usize; 4]; 7] =
    [[0, 0, 8, 8], [4, 0, 8, 8], [0, 4, 4, 8], [2, 0, 4, 4], [0, 2, 2, 4], [1, 0, 2, 2], [0, 1, 1, 2]];

fn png(bits: usize, colors: usize, interlaced: bool, number: impl Fn(usize, usize) -> usize) -> Vec<u8> {
    let mut info = png::Info::with_size(SIZE[0] as u32, SIZE[1] as u32);
    info.color_type = png::ColorType::Indexed;
    info.bit_depth = png::BitDepth::from_u8(bits as u8).unwrap();
    info.interlaced = interlaced;
    info.palette = Some(palette(colors).into());
    let passes = if interlaced { &ADAM7[..] } else { &[[0, 0, 1, 1]] };
    let mut data = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::fast());
    for &[left, top, across, down] in passes {
        for row in (top..SIZE[1]).step_by(down) {
            let numbers: Vec<_> = (left..SIZE[0]).step_by(across).map(|column| number(column, row)).collect();
            data.write_all(&[&[0], &packed(bits, &numbers)[..]].concat()).unwrap();
        }
    }
    let mut bytes = Vec::new();
    let mut writer = png::Encoder::with_info(&mut bytes, info).unwrap().write_header().unwrap();
    writer.write_chunk(png::chunk::IDAT, &data.finish().unwrap()).unwrap();
    drop(writer);
    bytes
}

/// The coding of a BMP's pixels: rows of numbers from the bottom or from the top, or runs and lists
/// of numbers (RLE).
#[derive(Debug, Clone, Copy, PartialEq)]
enum Bmp {
    Upward,
    Downward,
    Runs,
    Lists,
}

/// A BMP with an info header that states `told` colours. 0 stands for as many colours as its bits
/// can number.
fn bmp(
    bits: usize,
    [colors, told]: [usize; 2],
    kind: Bmp,
    number: impl Fn(usize, usize) -> usize,
) -> Vec<u8> {
    let [width, height] = SIZE;
    let row = |row: usize| (0..width).map(|column| number(column, row)).collect::<Vec<_>>();
    let mut data = Vec::new();
    for line in 0..height {
        let numbers = row(if kind == Bmp::Downward { line } else { height - 1 - line });
        match kind {
            Bmp::Upward | Bmp::Downward => data.extend(packed(bits, &numbers)),
            // Each pixel is a run of its own. With 4 bits the number is in the first half of the
            // byte, and the second half is no pixel.
            Bmp::Runs => data.extend(numbers.iter().flat_map(|&number| [1, packed(bits, &[number])[0]])),
            Bmp::Lists => {
                data.extend([0, width as u8]);
                data.extend(packed(bits, &numbers));
                data.resize(data.len().next_multiple_of(2), u8::MAX);
            }
        }
        match kind {
            Bmp::Upward | Bmp::Downward => data.resize(data.len().next_multiple_of(4), u8::MAX),
            Bmp::Runs | Bmp::Lists => data.extend([0, u8::from(line + 1 == height)]),
        }
    }
    let packing = match kind {
        Bmp::Upward | Bmp::Downward => 0,
        Bmp::Runs | Bmp::Lists => {
            if bits == 8 {
                1
            } else {
                2
            }
        }
    };
    let rows = if kind == Bmp::Downward { (height as u32).wrapping_neg() } else { height as u32 };
    let at = 54 + 4 * colors as u32;
    let mut bytes = b"BM".to_vec();
    let size = [at + data.len() as u32, 0, at, 40, width as u32, rows, 1 | (bits as u32) << 16, packing];
    for word in size.into_iter().chain([data.len() as u32, 0, 0, told as u32, 0]) {
        bytes.extend(word.to_le_bytes());
    }
    let palette = palette(colors);
    bytes.extend(palette.chunks(3).flat_map(|color| [color[2], color[1], color[0], 0]));
    bytes.extend(data);
    bytes
}

/// Bits, number of colours, and a palette number beyond them: the next one or the last one.
const BEYOND: [(usize, usize, usize); 8] =
    [(1, 1, 1), (2, 2, 2), (2, 3, 3), (4, 2, 2), (4, 9, 15), (8, 2, 2), (8, 2, 255), (8, 255, 255)];

fn is_dark(column: usize, row: usize) -> bool {
    (column * column + row).is_multiple_of(3)
}

#[test]
fn a_png_with_a_number_beyond_its_palette_is_refused() {
    for (bits, colors, beyond) in BEYOND {
        for interlaced in [false, true] {
            // The first pixel, one in the middle, the last.
            for odd in [[0, 0], [6, 3], [10, 8]] {
                let number =
                    |column, row| if [column, row] == odd { beyond } else { (column + row) % colors.min(2) };
                let told = if colors == 1 { "1 colour" } else { &format!("{colors} colours") };
                refuses("motif.png", &png(bits, colors, interlaced, number), beyond, told);
            }
        }
    }
}

#[test]
fn a_png_shows_the_colours_of_a_palette_that_is_shorter_than_it_may_be() {
    for (bits, colors) in [(1, 2), (2, 2), (2, 3), (2, 4), (4, 2), (4, 15), (8, 2), (8, 200), (8, 256)] {
        for interlaced in [false, true] {
            let light = if colors > 2 { colors - 1 } else { 0 };
            let number = |column, row| if is_dark(column, row) { 1 } else { light };
            shows("motif.png", &png(bits, colors, interlaced, number), is_dark);
        }
    }
}

/// The codings of a BMP with this number of bits.
fn kinds(bits: usize) -> &'static [Bmp] {
    if bits < 4 {
        &[Bmp::Upward, Bmp::Downward]
    } else {
        &[Bmp::Upward, Bmp::Downward, Bmp::Runs, Bmp::Lists]
    }
}

#[test]
fn a_bmp_with_a_number_beyond_its_palette_is_refused() {
    for (bits, colors, beyond) in BEYOND {
        for &kind in kinds(bits) {
            for odd in [[0, 0], [6, 3], [10, 8]] {
                let number =
                    |column, row| if [column, row] == odd { beyond } else { (column + row) % colors.min(2) };
                let told = if colors == 1 { "1 colour" } else { &format!("{colors} colours") };
                refuses("motif.bmp", &bmp(bits, [colors; 2], kind, number), beyond, told);
            }
        }
    }
}

#[test]
fn a_bmp_shows_the_colours_of_a_palette_that_is_shorter_than_it_may_be() {
    for (bits, colors) in [(1, 2), (4, 2), (4, 15), (4, 16), (8, 2), (8, 200), (8, 256)] {
        for &kind in kinds(bits) {
            let light = if colors > 2 { colors - 1 } else { 0 };
            let number = |column, row| if is_dark(column, row) { 1 } else { light };
            shows("motif.bmp", &bmp(bits, [colors; 2], kind, number), is_dark);
            if colors == 1 << bits {
                shows("motif.bmp", &bmp(bits, [colors, 0], kind, number), is_dark);
            }
        }
    }
}
