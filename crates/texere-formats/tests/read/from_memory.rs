//! Designs from memory equal designs from files, with all the files that they name.

use std::cell::RefCell;
use std::io::{self, Cursor, ErrorKind};
use std::path::{Path, PathBuf};

use image::{DynamicImage, ImageFormat, Rgb, RgbImage};
use texere_formats::{Design, ReadError, read, read_from};

use crate::chain;

const YARN: &str = "[yarns.a]\ndiameter_mm = 0.2\n";
const SETS: &str = "[warp]\nyarns = [\"a\"]\nspacing_mm = 0.6\n[weft]\nyarns = [\"a\"]\nspacing_mm = 0.6\n";
const WIF: &str = "[WARP]\nThreads=4\nColor=1\n[WEFT]\nThreads=4\n[THREADING]\n1=1\n2=2\n3=3\n4=4\n[LIFTPLAN]\n1=1,2\n2=2,3\n\
     3=3,4\n4=4,1\n[COLOR TABLE]\n1=200,16,32\n[COLOR PALETTE]\nRange=0,255\n";
const KNITOUT: &str = ";!knitout-2\n;;Carriers: 1 2\n;;Gauge: 12\ninhook 2\ntuck - f2 2\ntuck - f1 2\nknit + f1 2\nknit + f2 2\n\
     releasehook 2\nx-stitch-number 60\nknit - f2 2\nknit - f1 2\nouthook 2\n";
const GAUGE: &str = "wales_per_cm = 10\ncourses_per_cm = 12.5\n";

/// A picture of two colours, 2 × 3 pixels.
fn picture(format: ImageFormat) -> Vec<u8> {
    let color = |x, y| if (x + y) % 3 == 0 { Rgb([0; 3]) } else { Rgb([255; 3]) };
    let mut bytes = Cursor::new(Vec::new());
    DynamicImage::from(RgbImage::from_fn(2, 3, color)).write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

/// A black picture of 2 × 3 pixels, as a TIFF of one channel, which is decoded in another way than
/// colours.
fn grey() -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    DynamicImage::from(DynamicImage::from(RgbImage::new(2, 3)).to_luma8())
        .write_to(&mut bytes, ImageFormat::Tiff)
        .unwrap();
    bytes.into_inner()
}

/// The files that designs name, in one folder.
fn named() -> Vec<(&'static str, Vec<u8>)> {
    vec![
        ("more/a.png", picture(ImageFormat::Png)),
        ("more/a.bmp", picture(ImageFormat::Bmp)),
        ("more/a.tif", picture(ImageFormat::Tiff)),
        ("more/grey.tif", grey()),
        ("more/a.wif", WIF.into()),
        ("more/a.k", KNITOUT.into()),
    ]
}

/// A design of each kind, and the file that it names.
fn designs() -> Vec<(&'static str, String, Option<&'static str>)> {
    let woven = |weave: &str| format!("[weave]\n{weave}\n{YARN}{SETS}");
    let knit = |keys: &str| format!("[knit]\n{GAUGE}{keys}\n{YARN}[yarns.b]\ntex = 30\n");
    let colors = |black: &str, white: &str| {
        format!("colors = {{ \"#000000\" = \"{black}\", \"#ffffff\" = \"{white}\" }}")
    };
    let jacquard = format!(
        "[warp_knit]\n{GAUGE}wales = 4\ncourses = 6\n[[warp_knit.bars]]\nlapping = \"1-0/1-2//\"\nimage = \"more/a.png\"\n{}\n{YARN}",
        colors("0-0/0-0", "0-0/1-1")
    );
    vec![
        ("a.wif", WIF.into(), None),
        ("a.k", KNITOUT.into(), None),
        ("A.KNITOUT", KNITOUT.into(), None),
        ("notation.toml", woven("notation = \"2/2\"\nends = 6\npicks = 5"), None),
        ("drawdown.toml", woven("drawdown = \"10\\n01\""), None),
        ("image.toml", woven("image = \"more/a.png\""), Some("more/a.png")),
        ("bmp.toml", woven("image = \"more/a.bmp\"\nrepeat = [2, 1]"), Some("more/a.bmp")),
        (
            "colors.toml",
            woven(&format!("image = \"more/a.tif\"\n{}", colors("plain", "1/2"))),
            Some("more/a.tif"),
        ),
        (
            "grey.toml",
            woven("image = \"more/grey.tif\"\ncolors = { \"#000000\" = \"plain\" }"),
            Some("more/grey.tif"),
        ),
        ("wif.toml", format!("weave.wif = \"more/a.wif\"\n{YARN}"), Some("more/a.wif")),
        ("chart.toml", knit("chart = \"kk\\nkp\"\nyarns = [\"a\", \"b\"]\nrepeat = [2, 2]"), None),
        (
            "symbols.toml",
            knit(&format!("image = \"more/a.png\"\nyarns = [\"a\"]\n{}", colors("k", "p"))),
            Some("more/a.png"),
        ),
        ("jacquard.toml", knit(&format!("image = \"more/a.png\"\n{}", colors("a", "b"))), Some("more/a.png")),
        (
            "knitout.toml",
            knit("knitout = \"more/a.k\"\nyarns = [\"a\"]\nstitch_lengths_mm = { 60 = 5.5 }"),
            Some("more/a.k"),
        ),
        ("warp.toml", jacquard, Some("more/a.png")),
    ]
}

/// Everything in a design, except its files.
fn known(design: &Design) -> String {
    let Design { name, structure, settle, finish, stretch, .. } = design;
    let places: Vec<_> = (0..20).map(|source| design.program_place(source)).collect();
    let (yarns, faults) = (design.yarns().unwrap(), design.faults());
    format!(
        "{name} {structure:?} {settle} {finish:?} {stretch:?} {yarns:?} {places:?} {faults:?} {:?}",
        design.warnings()
    )
}

fn not_found(_: &Path) -> io::Result<Vec<u8>> {
    Err(ErrorKind::NotFound.into())
}

#[test]
fn each_kind_of_design_is_the_same_from_memory_as_from_its_file() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("more")).unwrap();
    for (name, bytes) in named() {
        std::fs::write(folder.path().join(name), bytes).unwrap();
    }
    for (name, text, names) in designs() {
        std::fs::write(folder.path().join(name), &text).unwrap();
        let from_file = read(folder.path().join(name)).unwrap();
        let files = names.into_iter().fold(vec![name], |files, named| [files, vec![named]].concat());
        assert_eq!(from_file.files(), files.iter().map(|file| folder.path().join(file)).collect::<Vec<_>>());

        // The folder `looms/2026` does not exist.
        let looms = Path::new("looms/2026");
        let asked = RefCell::new(Vec::<PathBuf>::new());
        let from_memory = read_from(looms.join(name), text, |path| {
            asked.borrow_mut().push(path.into());
            let found = named().into_iter().find(|(name, _)| looms.join(name) == path);
            found.map(|(_, bytes)| bytes).ok_or_else(|| ErrorKind::NotFound.into())
        })
        .unwrap();
        let asked = asked.into_inner();
        assert_eq!(asked, names.map(|named| looms.join(named)).into_iter().collect::<Vec<_>>(), "{name}");
        assert!(from_memory.files().is_empty(), "{name}");
        let there = folder.path().display().to_string();
        assert_eq!(known(&from_memory), known(&from_file).replace(&there, "looms/2026"), "{name}");
    }
}

#[test]
fn what_is_refused_of_a_named_file_names_both() {
    for (name, text, named) in designs() {
        let Some(named) = named else { continue };
        let error = read_from(name, text.clone(), not_found).unwrap_err();
        let ReadError::Io { file, source } = error.innermost() else { panic!("{error:?}") };
        assert_eq!((file.as_path(), source.kind()), (Path::new(named), ErrorKind::NotFound));
        let said = chain(&error);
        assert!(said.starts_with(&format!("{name}, line ")) && said.contains(&format!("can't read {named}")));
        assert!(
            read_from(name, text.clone(), |_| Err(io::Error::other("the row is locked")))
                .is_err_and(|error| chain(&error).ends_with("the row is locked"))
        );
        // The named file is of another kind.
        let error = read_from(name, text, |_| Ok(b"\x89 no file at all".to_vec())).unwrap_err();
        assert!(chain(&error).contains(named), "{}", chain(&error));
    }
}

#[test]
fn errors_and_limits_are_those_of_files() {
    let folder = tempfile::tempdir().unwrap();
    let long = vec![b' '; (1 << 24) + 1];
    for (name, bytes) in [
        ("a.toml", &b"weave = 3"[..]),
        ("a.toml", b"[weave"),
        ("a.toml", b"\xff"),
        ("a.toml", &long),
        ("a.wif", b"[WARP]\nThreads=0"),
        ("a.wif", b""),
        ("a.k", b";!knitout-2\nknit + 1 f2"),
        ("a.jpg", b""),
        ("a", b"[WARP]"),
    ] {
        std::fs::write(folder.path().join(name), bytes).unwrap();
        let from_file = chain(&read(folder.path().join(name)).unwrap_err());
        let from_memory = chain(&read_from(name, bytes, not_found).unwrap_err());
        let there = format!("{}{}", folder.path().display(), std::path::MAIN_SEPARATOR);
        assert_eq!(from_memory, from_file.replace(&there, ""));
    }
    // A WIF draft may be longer than a design file, both by itself and when a design names it.
    let comment = [WIF.as_bytes(), &long].concat();
    assert!(read_from("a.wif", comment.clone(), not_found).is_ok());
    let design = format!("weave.wif = \"b.wif\"\n{YARN}");
    assert!(read_from("a.toml", design.clone(), |_| Ok(comment.clone())).is_ok());
    let error = read_from("a.toml", design, |_| Ok(vec![b' '; (1 << 28) + 1])).unwrap_err();
    let ReadError::TooLarge { file, bytes, limit } = error.innermost() else { panic!("{error:?}") };
    assert_eq!((file.as_path(), *bytes, *limit), (Path::new("b.wif"), (1 << 28) + 1, 1 << 28));
}
