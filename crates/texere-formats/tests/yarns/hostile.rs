//! Broken files of yarns: each is refused by name, in memory that grows only with the file.

use std::error::Error;

use texere_core::Section;
use texere_formats::read::yarns_from;
use texere_formats::{ReadError, read, write};

use crate::HEAP;
use crate::clothes::{bent, odd};

/// Length of the header in bytes, and the places of its fields.
const HEADER: usize = 60;
const LENGTH_AT: usize = 16;
const COUNTS_AT: [usize; 3] = [24, 32, 40];
const TENSION_AT: usize = 48;
const REPEAT_AT: usize = 52;

/// Bytes of the materials of [`odd`]: 20 for each, and their names.
const MATERIALS: usize = 3 * 20 + 14 + 4;
/// Bytes of the sections of [`odd`]: 12 for each, and five corners.
const SECTIONS: usize = 6 * 12 + 5 * 8;
const SECTIONS_AT: usize = HEADER + MATERIALS;
const YARNS_AT: usize = SECTIONS_AT + SECTIONS;
const YARN: usize = 44;
const POINTS_AT: usize = YARNS_AT + 6 * YARN;

fn file() -> Vec<u8> {
    let (yarns, boundary) = odd();
    let mut file = Vec::new();
    write::repeat_to(&bent(&yarns), &boundary, &mut file).unwrap();
    file
}

/// The CRC-32 of zip, PNG and Ethernet, bit by bit.
fn crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |sum, &byte| {
        (0..8).fold(sum ^ u32::from(byte), |sum, _| (sum >> 1) ^ (0xedb8_8320 * (sum & 1)))
    })
}

/// `file` with other bytes at `at`, and with a fitting length and checksum.
fn changed(mut file: Vec<u8>, at: usize, bytes: &[u8]) -> Vec<u8> {
    file[at..at + bytes.len()].copy_from_slice(bytes);
    sealed(file)
}

fn sealed(mut file: Vec<u8>) -> Vec<u8> {
    let end = file.len() - 4;
    let length = (file.len() as u64).to_le_bytes();
    file[LENGTH_AT..LENGTH_AT + 8].copy_from_slice(&length);
    let sum = crc(&file[..end]).to_le_bytes();
    file[end..].copy_from_slice(&sum);
    file
}

/// An error with all its causes. Checks that each is one short line.
fn said(error: &dyn Error) -> String {
    let mut said = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        said = format!("{said}: {error}");
        cause = error.source();
    }
    assert!(!said.contains(char::is_control) && said.len() < 400, "{said:?}");
    said
}

fn refused(file: &[u8]) -> String {
    let error = yarns_from("dir/cloth.yarns", file).expect_err("it was taken");
    let said = said(&error);
    assert!(said.starts_with("dir/cloth.yarns"), "{said}");
    said
}

#[test]
fn the_layout_is_the_documented_one() {
    let file = file();
    assert_eq!(crc(b"123456789"), 0xcbf4_3926);
    assert!(sealed(file.clone()) == file, "its length and its checksum are others");
    let (yarns, _) = odd();
    let points = yarns.points().len();
    assert_eq!(file.len(), POINTS_AT + points * (16 + 12 + 4) + 4);
    assert_eq!(file[..12], *b"\x89YARNS\r\n\x01\0\0\0");
    assert_eq!(file[file.len() - 8..][..4], yarns.sources().unwrap()[points - 1].to_le_bytes());
}

#[test]
fn a_file_cut_short_is_refused_at_every_length() {
    let file = file();
    for length in 0..file.len() {
        let said = refused(&file[..length]);
        assert!(
            said.contains(if length < 24 { "cut off after" } else { "the length in bytes is" }),
            "{said}"
        );
        // A cut file is refused, even with a fitting length and checksum.
        if length >= 28 {
            refused(&sealed(file[..length].to_vec()));
        }
    }
    refused(&[&file[..], &[0]].concat());
    let longer = sealed([&file[..], &[0; 3]].concat());
    assert!(refused(&longer).contains("what follows the last list is 3 bytes, expected 0"));
}

#[test]
fn each_bit_that_flips_is_found() {
    let file = file();
    for bit in 0..8 * file.len() {
        let mut other = file.clone();
        other[bit / 8] ^= 1 << (bit % 8);
        let said = refused(&other);
        let named = match bit / 8 {
            0..8 => "the beginning is",
            8..12 => "the version is",
            16..24 => "the length in bytes is",
            _ => "the checksum is",
        };
        assert!(said.contains(named), "byte {}: {said}", bit / 8);
    }
}

/// Each value is changed, and the checksum fits. The refusal names the file and the reason.
#[test]
fn every_field_is_checked() {
    let nan = f32::NAN.to_le_bytes();
    let word = |word: u32| word.to_le_bytes();
    let float = |float: f32| float.to_le_bytes();
    let long = |long: u64| long.to_le_bytes();
    let cases: &[(usize, &[u8], &str)] = &[
        (0, b"PK", "byte 0: the beginning is PK"),
        (8, &word(2), "byte 8: the version is 2, expected 1, the only version that this program reads"),
        (8, &word(0), "the version is 0"),
        (12, &word(15), "byte 12: the word of flags is 15, expected 0 to 7"),
        (COUNTS_AT[0], &long(1 << 63), "byte 24: the number of materials is 9223372036854775808, expected"),
        (COUNTS_AT[1], &long(1 << 63), "byte 32: the number of sections is 9223372036854775808, expected"),
        (COUNTS_AT[2], &long(u64::MAX), "byte 40: the number of yarns is 18446744073709551615, expected"),
        (COUNTS_AT[2], &long(0), "no yarns"),
        (TENSION_AT, &float(1.0), "byte 48: the tension is 1, expected 0 to below 1"),
        (TENSION_AT, &nan, "byte 48: the tension is NaN, expected 0 to below 1"),
        (REPEAT_AT, &float(-1.0), "the repeat along x is -1 mm, outside 0 to 1000000000 mm"),
        (REPEAT_AT + 4, &nan, "the repeat along y is NaN"),
        (REPEAT_AT, &float(0.0), "goes on along x, where there is no repeat"),
        (HEADER, &long(1 << 63), "byte 60: the length of a material's name is 9223372036854775808, expected"),
        (HEADER + 11, &[2], "byte 71: whether a material has tex is 2, expected 0 or 1"),
        (HEADER + 12, &float(1.0), "the tex of a material without tex is"),
        (HEADER + 20 + 26, &float(-30.5), "material 1 has -30.5 tex, which is no positive number"),
        (HEADER + 20 + 26, &nan, "material 1 has NaN tex"),
        (HEADER + 16, &float(31.0), "a hairiness of 31"),
        (HEADER + 16, &nan, "a hairiness of NaN"),
        (HEADER + 20 + 8, &[0xff], "a material's name is \\xffolle"),
        (SECTIONS_AT, &word(6), "the kind of a section is 6, expected 0 to 5"),
        (SECTIONS_AT + 8, &word(1), "a number that a section of its kind does not have is 1, expected 0"),
        (SECTIONS_AT + 16, &float(21.0), "section 1 is not sound: aspect is 21, outside 0.05 to 20"),
        (SECTIONS_AT + 16, &nan, "section 1 is not sound: aspect is NaN"),
        (SECTIONS_AT + 4 * 12 + 4, &word(13), "section 4 is not sound: plies is 13"),
        (SECTIONS_AT + 4 * 12 + 8, &float(0.4), "section 4 is not sound: valley is 0.4, outside 0.5 to 1"),
        (SECTIONS_AT + 4 * 12 + 8, &nan, "section 4 is not sound: valley is NaN"),
        (SECTIONS_AT + 4 * 12 + 8, &float(-0.0), "section 4 is not sound: valley is -0, outside 0.5 to 1"),
        (
            SECTIONS_AT + 5 * 12 + 4,
            &word(u32::MAX),
            "the number of a section's corners is 4294967295, expected",
        ),
        (SECTIONS_AT + 6 * 12, &nan, "section 5 is not sound: corner is NaN"),
        (YARNS_AT, &long(1 << 63), "the number of control points of a yarn is 9223372036854775808, expected"),
        (YARNS_AT, &long(1), "yarn 0 has 1 control point, needs 2"),
        (YARNS_AT + 8, &word(3), "yarn 0 is of material 3, but there are 3"),
        (YARNS_AT + 12, &word(6), "yarn 0 has section 6, but there are 6"),
        (YARNS_AT + 16, &nan, "yarn 0 has a twist of NaN"),
        (YARNS_AT + 16, &float(1001.0), "yarn 0 has a twist of 1001 rad/mm, beyond ±1000"),
        (YARNS_AT + 20, &word(3), "how a yarn ends is 3, expected 0 to 2"),
        (YARNS_AT + 24, &word(1), "a repeat of a yarn that does not go on is 1, expected 0"),
        (YARNS_AT + 2 * YARN + 24, &[0; 8], "yarn 2 goes on by no repeat"),
        (YARNS_AT + 32, &word(6), "the kind of a yarn's origin is 6, expected 0 to 5"),
        (YARNS_AT + 36, &word(1), "a number that an origin of its kind does not have is 1, expected 0"),
        (POINTS_AT, &nan, "x of point 0 of yarn 0 is NaN"),
        (POINTS_AT + 4, &float(f32::INFINITY), "y of point 0 of yarn 0 is inf"),
        (POINTS_AT + 16 + 8, &float(-1.1e9), "z of point 1 of yarn 0 is -1100000000 mm, beyond ±1000000000"),
        (POINTS_AT + 12, &[0, 0], "half width of point 0 of yarn 0 is 0 mm, outside 0.0001 to 30000 mm"),
        (POINTS_AT + 14, &[0x00, 0x7e], "half height of point 0 of yarn 0 is NaN"),
        (POINTS_AT + 39 * 16, &[0; 12], "the up direction of point 0 of yarn 0 is [0.0, 0.0, 0.0]"),
        (POINTS_AT + 39 * 16, &float(2.0), "an up direction is [2.0"),
    ];
    for &(at, bytes, why) in cases {
        let said = refused(&changed(file(), at, bytes));
        assert!(said.contains(why), "byte {at}: {said}");
    }
}

/// 0 and the number that it stands for are one valley.
#[test]
fn the_valley_of_plies_that_nothing_presses_may_be_a_number() {
    let plied = Section::plied(5);
    let Section::Lobed { valley, .. } = plied else { panic!("{plied:?}") };
    let named = changed(file(), SECTIONS_AT + 4 * 12 + 8, &valley.to_le_bytes());
    assert!(named != file());
    assert_eq!(yarns_from("cloth.yarns", &named).unwrap().yarns.layout().sections()[4], plied);
}

/// A reader takes little memory for counts of more items than the file can hold.
#[test]
fn memory_grows_with_the_file_alone() {
    let file = file();
    let claimed = |claim: u64| {
        let long = COUNTS_AT.into_iter().chain([HEADER, YARNS_AT, YARNS_AT + YARN]);
        let long = long.map(move |at| (at, claim.to_le_bytes().to_vec()));
        let word = (claim as u32).to_le_bytes().to_vec();
        long.chain([(SECTIONS_AT + 5 * 12 + 4, word)])
    };
    for claim in [u64::MAX, 1 << 63, 1 << 40, (1 << 32) - 1, 1 << 28, file.len() as u64, 200] {
        for (at, bytes) in claimed(claim) {
            let bytes = changed(file.clone(), at, &bytes);
            let before = HEAP.current_usage();
            HEAP.reset_peak_usage();
            let read = yarns_from("cloth.yarns", &bytes);
            let taken = HEAP.peak_usage().saturating_sub(before);
            // The file has less than two kilobytes. The larger limit leaves room for tests that run
            // at the same time.
            assert!(taken < 1 << 26, "{claim} at byte {at} takes {taken} bytes: {read:?}");
        }
    }
}

#[test]
fn a_reader_of_designs_says_that_it_needs_one() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("cloth.yarns");
    write::yarns(&odd().0, &path).unwrap();
    let error = read(&path).unwrap_err();
    assert!(matches!(error, ReadError::WithoutDesign { .. }), "{error:?}");
    assert!(said(&error).contains("holds saved yarns alone, and this needs the design that they are of"));
    let missing = read::yarns(folder.path().join("none.yarns"));
    assert!(matches!(missing, Err(ReadError::Io { .. })), "{missing:?}");
    let folder = read::yarns(folder.path());
    assert!(matches!(folder, Err(ReadError::NotAFile { kind: "a folder", .. })), "{folder:?}");
}
