//! Cloth is woven as an image looks, with transparency, palettes and orientation. Images that can't
//! be shown are refused by name. The test makes the bytes of most TIFF files itself, by TIFF 6.0.

use std::error::Error;
use std::io::Cursor;

use image::{Rgba, RgbaImage};
use texere_formats::{Design, ReadError, read};
use tiff::encoder::TiffEncoder;
use tiff::encoder::colortype::{Gray8, RGB8};

/// Five ends by six picks as an image viewer shows them, with `#` dark.
const SHOWN: [&str; 6] = ["#....", "##..#", "###..", ".###.", "..#.#", "#..#."];

/// Cloth woven as the image `name` with these bytes. `weave` has more keys of its weave.
pub(crate) fn design(name: &str, bytes: &[u8], weave: &str) -> Result<Design, ReadError> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(name), bytes).unwrap();
    let path = folder.path().join("design.toml");
    let text = format!(
        "[weave]\nimage = \"{name}\"\n{weave}[yarns.a]\ndiameter_mm = 0.3\n[warp]\nyarns = [\"a\"]\nspacing_mm = 1\n\
         [weft]\nyarns = [\"a\"]\nspacing_mm = 1\n"
    );
    std::fs::write(&path, text).unwrap();
    read(&path)
}

/// The drawdown as a weaver draws it, with `#` for warp up.
#[track_caller]
fn woven(name: &str, bytes: &[u8]) -> Vec<String> {
    let design =
        design(name, bytes, "").unwrap_or_else(|error| panic!("{error}: {:?}", error.innermost().source()));
    let drawdown = design.structure.woven().unwrap().cloth().drawdown();
    let sign = |end, pick| if drawdown.up(end, pick) { '#' } else { '.' };
    let row = |pick| (0..drawdown.ends()).map(|end| sign(end, pick)).collect();
    (0..drawdown.picks()).rev().map(row).collect()
}

#[track_caller]
fn refused(name: &str, bytes: &[u8], weave: &str, parts: &[&str]) {
    let error = design(name, bytes, weave).expect_err("it is taken");
    let error = error.innermost();
    let told = format!("{error}: {}", error.source().map(ToString::to_string).unwrap_or_default());
    for part in [name].iter().chain(parts) {
        assert!(told.contains(part), "\"{told}\" lacks \"{part}\"");
    }
}

fn is_dark(column: usize, row: usize) -> bool {
    SHOWN[row].as_bytes()[column] == b'#'
}

/// The tags of a page and their values.
type Tags = Vec<(u16, Vec<u32>)>;

/// A TIFF file: the byte order, the tags of its pages with all values as SHORT or LONG, and the
/// pixels of each page in one strip or tile.
struct Tiff {
    big_endian: bool,
    pages: Vec<(Tags, Vec<u8>)>,
}

impl Tiff {
    fn one(tags: &[(u16, &[u32])], data: Vec<u8>) -> Self {
        let tags = tags.iter().map(|(tag, values)| (*tag, values.to_vec())).collect();
        Self { big_endian: false, pages: vec![(tags, data)] }
    }

    fn with(mut self, tag: u16, values: &[u32]) -> Self {
        let tags = &mut self.pages[0].0;
        tags.retain(|(known, _)| *known != tag);
        tags.push((tag, values.to_vec()));
        self
    }

    fn short(&self, value: u16) -> [u8; 2] {
        if self.big_endian { value.to_be_bytes() } else { value.to_le_bytes() }
    }

    fn long(&self, value: u32) -> [u8; 4] {
        if self.big_endian { value.to_be_bytes() } else { value.to_le_bytes() }
    }

    fn bytes(&self) -> Vec<u8> {
        let mut file = if self.big_endian { b"MM".to_vec() } else { b"II".to_vec() };
        file.extend(self.short(42));
        for (tags, data) in &self.pages {
            // The offset of this directory. On the first page these four bytes belong to the
            // file's header. On a later page nothing reads them, because the previous directory has
            // the offset, too.
            let next = file.len() as u32 + 4 + data.len() as u32 + (data.len() % 2) as u32;
            file.extend(self.long(next));
            let strip = file.len() as u32;
            file.extend(data);
            file.resize(next as usize, 0);
            let tiled = tags.iter().any(|(tag, _)| *tag == 322);
            let mut tags = tags.clone();
            tags.push((if tiled { 324 } else { 273 }, vec![strip]));
            tags.push((if tiled { 325 } else { 279 }, vec![data.len() as u32]));
            if tags.iter().any(|(tag, values)| *tag == 284 && values == &[2]) {
                // Planes have equal lengths and follow one another.
                let samples = tags.iter().find(|(tag, _)| *tag == 277).unwrap().1[0];
                let each = data.len() as u32 / samples;
                for (tag, values) in &mut tags {
                    match tag {
                        273 | 324 => *values = (0..samples).map(|plane| strip + plane * each).collect(),
                        279 | 325 => *values = vec![each; samples as usize],
                        _ => {}
                    }
                }
            }
            tags.sort();
            let (mut entries, mut beside) = (self.short(tags.len() as u16).to_vec(), Vec::new());
            let beside_at = file.len() + 2 + 12 * tags.len() + 4;
            for (tag, values) in &tags {
                let is_long = matches!(tag, 273 | 279 | 324 | 325);
                let mut bytes: Vec<u8> = values
                    .iter()
                    .flat_map(|value| {
                        if is_long { self.long(*value).to_vec() } else { self.short(*value as u16).to_vec() }
                    })
                    .collect();
                entries.extend(self.short(*tag));
                entries.extend(self.short(if is_long { 4 } else { 3 }));
                entries.extend(self.long(values.len() as u32));
                if bytes.len() > 4 {
                    entries.extend(self.long((beside_at + beside.len()) as u32));
                    beside.extend(bytes);
                } else {
                    bytes.resize(4, 0);
                    entries.extend(bytes);
                }
            }
            // Values that do not fit into an entry follow the directory.
            file.extend(entries);
            let next_place = file.len();
            file.extend(self.long(0));
            file.extend(beside);
            if self.pages.len() > 1 {
                file.resize(file.len() + file.len() % 2, 0);
                let here = file.len() as u32;
                let is_last = std::ptr::eq(data, &self.pages[self.pages.len() - 1].1);
                if !is_last {
                    // Before the next directory come four bytes, and then the pixels of its page.
                    let (_, following) = &self.pages[1];
                    let directory = here + 4 + following.len() as u32 + (following.len() % 2) as u32;
                    file[next_place..next_place + 4].copy_from_slice(&self.long(directory));
                }
            }
        }
        file
    }
}

/// Rows of samples with this number of bits. Each row has whole bytes.
fn packed(bits: usize, big_endian: bool, rows: &[Vec<u32>]) -> Vec<u8> {
    let mut bytes = Vec::new();
    for row in rows {
        if bits == 16 {
            let sample = |value: &u32| {
                if big_endian { (*value as u16).to_be_bytes() } else { (*value as u16).to_le_bytes() }
            };
            bytes.extend(row.iter().flat_map(sample));
            continue;
        }
        let mut line = vec![0u8; (row.len() * bits).div_ceil(8)];
        for (place, value) in row.iter().enumerate() {
            line[place * bits / 8] |= (*value as u8) << (8 - bits - place * bits % 8);
        }
        bytes.extend(line);
    }
    bytes
}

fn rows(sample: impl Fn(usize, usize) -> Vec<u32>) -> Vec<Vec<u32>> {
    (0..6).map(|row| (0..5).flat_map(|column| sample(column, row)).collect()).collect()
}

/// A palette with dark blue and yellow at these two numbers, and green at numbers that are not
/// used.
fn palette(bits: usize, [dark, light]: [usize; 2]) -> Vec<u32> {
    let color = |number: usize| match number {
        _ if number == dark => [10, 20, 90],
        _ if number == light => [250, 240, 60],
        _ => [0, 255, 0],
    };
    let channel = |channel: usize| (0..1 << bits).map(move |number| color(number)[channel] * 257);
    [0, 1, 2].into_iter().flat_map(channel).collect()
}

fn indexed(bits: usize, numbers: [usize; 2]) -> Tiff {
    let data =
        packed(bits, false, &rows(|column, row| vec![numbers[usize::from(!is_dark(column, row))] as u32]));
    Tiff::one(
        &[
            (256, &[5]),
            (257, &[6]),
            (258, &[bits as u32]),
            (259, &[1]),
            (262, &[3]),
            (277, &[1]),
            (278, &[6]),
        ],
        data,
    )
    .with(320, &palette(bits, numbers))
}

#[test]
fn an_indexed_tiff_shows_the_colours_of_its_palette() {
    for (bits, numbers) in [
        (1, [0, 1]),
        (1, [1, 0]),
        (2, [3, 1]),
        (4, [9, 14]),
        (8, [200, 7]),
        (8, [7, 200]),
        (16, [300, 40_000]),
    ] {
        assert_eq!(woven("a.tif", &indexed(bits, numbers).bytes()), SHOWN, "{bits} {numbers:?}");
        // The same file in the other order of bytes.
        let mut other = indexed(bits, numbers);
        other.big_endian = true;
        other.pages[0].1 =
            packed(bits, true, &rows(|column, row| vec![numbers[usize::from(!is_dark(column, row))] as u32]));
        assert_eq!(woven("a.tif", &other.bytes()), SHOWN, "{bits} {numbers:?}");
    }
    // A palette of values up to 255, as some programs write it.
    let map: Vec<_> = palette(8, [200, 7]).iter().map(|value| value / 257).collect();
    assert_eq!(woven("a.tif", &indexed(8, [200, 7]).with(320, &map).bytes()), SHOWN);
    // A number that the palette lacks, and a missing palette, are refused.
    refused(
        "a.tif",
        &indexed(8, [200, 7]).with(320, &[0; 30]).bytes(),
        "",
        &["number 200 of a palette of 10 colours"],
    );
    let mut none = indexed(8, [200, 7]);
    none.pages[0].0.retain(|(tag, _)| *tag != 320);
    refused("a.tif", &none.bytes(), "", &["ColorMap"]);
    // The palette's colours are found in a table of colours.
    let table = "[weave.colors]\n\"#0a145a\" = \"3/1\"\n\"#faf03c\" = \"1/3\"\n";
    assert!(design("a.tif", &indexed(4, [9, 14]).bytes(), table).is_ok());
}

#[test]
fn an_indexed_tiff_may_be_compressed_tiled_and_in_planes() {
    // Compression by PackBits, with each row as a run of literal bytes.
    let mut compressed = indexed(8, [200, 7]).with(259, &[32_773]);
    compressed.pages[0].1 =
        compressed.pages[0].1.chunks(5).flat_map(|row| [&[4u8][..], row].concat()).collect();
    assert_eq!(woven("a.tif", &compressed.bytes()), SHOWN);
    // One tile of 16 by 16. The picture fills a corner of it.
    for (bits, numbers) in [(8, [200, 7]), (4, [9, 14]), (1, [1, 0])] {
        let within =
            |column, row| if column < 5 && row < 6 { numbers[usize::from(!is_dark(column, row))] } else { 0 };
        let tile: Vec<Vec<u32>> =
            (0..16).map(|row| (0..16).map(|column| within(column, row) as u32).collect()).collect();
        let mut tiled = indexed(bits, numbers).with(322, &[16]).with(323, &[16]);
        tiled.pages[0].0.retain(|(tag, _)| *tag != 278);
        tiled.pages[0].1 = packed(bits, false, &tile);
        assert_eq!(woven("a.tif", &tiled.bytes()), SHOWN, "{bits}");
    }
    // Opacity beside each number, and in a plane of its own. Dark pixels are opaque, and light ones
    // transparent.
    let number = |column, row| if (column + row) % 2 == 0 { 200 } else { 7 };
    let alpha = |column, row| if is_dark(column, row) { 255 } else { 0 };
    let both = indexed(8, [200, 7])
        .with(277, &[2])
        .with(258, &[8, 8])
        .with(338, &[2])
        .with(320, &palette(8, [200, 200]));
    let mut beside = both;
    beside.pages[0].1 = packed(8, false, &rows(|column, row| vec![200, alpha(column, row)]));
    assert_eq!(woven("a.tif", &beside.bytes()), SHOWN);
    let mut planes = beside.with(284, &[2]);
    let [first, second] = [rows(|_, _| vec![200]), rows(|column, row| vec![alpha(column, row)])];
    planes.pages[0].1 = packed(8, false, &[first, second].concat());
    assert_eq!(woven("a.tif", &planes.bytes()), SHOWN);
    // A sample that is not opacity is left out.
    let mut aside = planes.with(284, &[1]).with(338, &[0]).with(320, &palette(8, [200, 7]));
    aside.pages[0].1 = packed(
        8,
        false,
        &rows(|column, row| vec![if is_dark(column, row) { 200 } else { 7 }, number(column, row)]),
    );
    assert_eq!(woven("a.tif", &aside.bytes()), SHOWN);
}

fn grey(bits: usize, white_is_zero: bool) -> Tiff {
    let most = (1 << bits) - 1;
    let data = packed(
        bits,
        false,
        &rows(|column, row| vec![if is_dark(column, row) == white_is_zero { most } else { 0 }]),
    );
    Tiff::one(
        &[
            (256, &[5]),
            (257, &[6]),
            (258, &[bits as u32]),
            (262, &[u32::from(!white_is_zero)]),
            (277, &[1]),
            (278, &[6]),
        ],
        data,
    )
}

#[test]
fn a_grey_tiff_is_dark_where_it_says_so() {
    for bits in [1, 2, 4, 8, 16] {
        for white_is_zero in [false, true] {
            assert_eq!(woven("a.tif", &grey(bits, white_is_zero).bytes()), SHOWN, "{bits} {white_is_zero}");
        }
    }
    let mut alpha = grey(8, true).with(277, &[2]).with(258, &[8, 8]).with(338, &[2]);
    alpha.pages[0].1 =
        packed(8, false, &rows(|column, row| vec![0, if is_dark(column, row) { 255 } else { 0 }]));
    // White pixels on a transparent ground.
    assert_eq!(woven("a.tif", &alpha.bytes()), SHOWN);
}

#[test]
fn a_tiff_that_can_not_be_shown_is_refused_by_name() {
    refused("a.tif", &grey(1, true).with(266, &[2]).bytes(), "", &["FillOrder"]);
    assert_eq!(woven("a.tif", &grey(1, true).with(266, &[1]).bytes()), SHOWN);
    let inks = Tiff::one(
        &[(256, &[5]), (257, &[6]), (258, &[8, 8, 8, 8]), (262, &[5]), (277, &[4]), (278, &[6])],
        packed(8, false, &rows(|column, row| vec![0, 0, 0, if is_dark(column, row) { 255 } else { 0 }])),
    );
    refused("a.tif", &inks.bytes(), "", &["CMYK"]);
    let mut pages = grey(8, false);
    pages.pages.extend(grey(8, true).pages);
    refused("a.tif", &pages.bytes(), "", &["several pages"]);
    // A few bytes that ask for 36 GB.
    let many = grey(8, false).with(256, &[100_000]).with(277, &[60_000]);
    refused("a.tif", &many.bytes(), "", &["60000 samples a pixel", "1073741824"]);
    // A small copy of the page, as cameras and scanners write one, does not count as a page.
    let mut small = grey(8, false);
    small.pages.extend(grey(8, true).with(254, &[1]).pages);
    assert_eq!(woven("a.tif", &small.bytes()), SHOWN);
}

#[test]
fn planes_of_tiles_are_refused_by_name() {
    // Grey with opacity, RGB, and palette numbers with opacity, each in a tile of 16 by 16.
    for (photometric, samples) in [(1, 2), (2, 3), (3, 2)] {
        let planes = Tiff::one(
            &[
                (256, &[5]),
                (257, &[6]),
                (258, &vec![8; samples]),
                (262, &[photometric]),
                (277, &[samples as u32]),
                (284, &[2]),
                (320, &palette(8, [200, 7])),
                (322, &[16]),
                (323, &[16]),
            ],
            vec![200; samples * 16 * 16],
        );
        refused("a.tif", &planes.bytes(), "", &["PlanarConfiguration"]);
    }
    // One sample has one plane, whatever the file states.
    let tile = (0..16 * 16).map(|place| match [place % 16, place / 16] {
        [column, row] if column < 5 && row < 6 && is_dark(column, row) => 0,
        _ => 255,
    });
    let mut single = grey(8, false).with(284, &[2]).with(322, &[16]).with(323, &[16]);
    single.pages[0].0.retain(|(tag, _)| *tag != 278);
    single.pages[0].1 = tile.collect();
    assert_eq!(woven("a.tif", &single.bytes()), SHOWN);
}

#[test]
fn a_bigtiff_is_a_tiff() {
    let grey: Vec<u8> = (0..30).map(|place| if is_dark(place % 5, place / 5) { 0 } else { 255 }).collect();
    let mut file = Cursor::new(Vec::new());
    TiffEncoder::new_big(&mut file).unwrap().write_image::<Gray8>(5, 6, &grey).unwrap();
    assert_eq!(woven("a.tif", file.get_ref()), SHOWN);
    let colors: Vec<u8> = grey.iter().flat_map(|value| [*value, *value, 90]).collect();
    let mut file = Cursor::new(Vec::new());
    TiffEncoder::new_big(&mut file).unwrap().write_image::<RGB8>(5, 6, &colors).unwrap();
    assert_eq!(woven("a.tif", file.get_ref()), SHOWN);
}

/// The picture that a file shows if its rows are `held` and its orientation is `orientation`. TIFF
/// 6.0 defines an orientation by the sides at which row 0 and column 0 lie.
fn turned(held: &[&str], orientation: u32) -> Vec<String> {
    let rows = || held.iter().map(|row| row.chars().collect::<Vec<_>>());
    let columns = || (0..held[0].len()).map(|column| rows().map(|row| row[column]).collect::<Vec<_>>());
    let mut shown: Vec<Vec<char>> = if orientation < 5 { rows().collect() } else { columns().collect() };
    // Row 0 or column 0 is at the right side.
    if [2, 3, 6, 7].contains(&orientation) {
        shown.iter_mut().for_each(|row| row.reverse());
    }
    if [3, 4, 7, 8].contains(&orientation) {
        shown.reverse();
    }
    shown.into_iter().map(|row| row.into_iter().collect()).collect()
}

#[test]
fn an_image_is_turned_as_it_says() {
    // Orientation 6 is a quarter turn clockwise: the bottom comes to the left.
    assert_eq!(turned(&["ab", "cd"], 6), ["ca", "db"]);
    assert_eq!(turned(&["ab", "cd"], 8), ["bd", "ac"]);
    let color = Tiff::one(
        &[(256, &[5]), (257, &[6]), (258, &[8, 8, 8]), (262, &[2]), (277, &[3]), (278, &[6])],
        packed(
            8,
            false,
            &rows(|column, row| if is_dark(column, row) { vec![90, 20, 10] } else { vec![200, 210, 220] }),
        ),
    );
    let mut tiffs = [color, grey(8, true), indexed(2, [3, 1])];
    for orientation in 1..=8 {
        for tiff in &mut tiffs {
            *tiff = Tiff { big_endian: false, pages: tiff.pages.clone() }.with(274, &[orientation]);
            assert_eq!(woven("a.tif", &tiff.bytes()), turned(&SHOWN, orientation), "{orientation}");
        }
        // Exif in a PNG is a TIFF with one tag.
        let mut png = Vec::new();
        let mut encoder = png::Encoder::new(&mut png, 5, 6);
        encoder.set_color(png::ColorType::Grayscale);
        let mut writer = encoder.write_header().unwrap();
        let exif = [
            &b"MM\0\x2a\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0"[..],
            &[orientation as u8],
            b"\0\0\0\0\0\0",
        ]
        .concat();
        writer.write_chunk(png::chunk::ChunkType(*b"eXIf"), &exif).unwrap();
        let data: Vec<u8> =
            (0..30).map(|place| if is_dark(place % 5, place / 5) { 10 } else { 220 }).collect();
        writer.write_image_data(&data).unwrap();
        writer.finish().unwrap();
        assert_eq!(woven("a.png", &png), turned(&SHOWN, orientation), "{orientation}");
    }
}

fn png(color: impl Fn(bool, usize) -> [u8; 4]) -> Vec<u8> {
    let image = RgbaImage::from_fn(5, 6, |column, row| {
        Rgba(color(is_dark(column as usize, row as usize), (column + 5 * row) as usize))
    });
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    bytes.into_inner()
}

#[test]
fn what_is_transparent_is_ground_whatever_colour_hides_there() {
    for motif in [[200, 30, 30, 255], [255, 255, 255, 255], [0, 0, 0, 255]] {
        for hidden in [[0, 0, 0, 0], [255, 255, 255, 0], [200, 30, 30, 0]] {
            assert_eq!(
                woven("a.png", &png(|dark, _| if dark { motif } else { hidden })),
                SHOWN,
                "{motif:?} {hidden:?}"
            );
        }
        // Every pixel has another hidden colour.
        let ground = |place: usize| [place as u8, 7 * place as u8, 3, 0];
        assert_eq!(woven("a.png", &png(|dark, place| if dark { motif } else { ground(place) })), SHOWN);
    }
}

#[test]
fn what_is_half_transparent_or_without_a_weave_is_refused_by_pixel_and_alpha() {
    let half = png(
        |dark, place| if dark { [200, 30, 30, 255] } else { [0, 0, 0, if place == 7 { 128 } else { 0 }] },
    );
    let table = "[weave.colors]\n\"#c81e1e\" = \"3/1\"\n\"#000000\" = \"1/3\"\n";
    for weave in ["", table] {
        refused("a.png", &half, weave, &["column 3, row 2", "alpha 128 of 255"]);
    }
    let none = png(|dark, _| if dark { [200, 30, 30, 255] } else { [0, 0, 0, 0] });
    refused("a.png", &none, table, &["column 2, row 1", "alpha 0", "one of [weave.colors]"]);
}
