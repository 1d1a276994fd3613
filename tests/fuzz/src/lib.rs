//! Fuzzing of texere's readers with mutated designs. A design that a reader accepts goes on to its
//! yarns, and one in eight to plan, mesh and clearance. A design that it refuses has a short error.
//! Nothing may panic, hang or take much memory.
//!
//! An input depends on a reader and a number only. The number of a failure thus makes its input
//! again:
//!
//! ```
//! use texere_fuzz::{Input, Reader};
//! assert_eq!(Input::new(Reader::Wif, 7), Input::new(Reader::Wif, 7));
//! ```

mod corpus;
mod drive;
mod image_bytes;
mod text;
mod watch;
mod wpo_bytes;
mod yarn_bytes;

pub use drive::{Depth, Outcome, drive};
pub use watch::fuzz;

/// A reader that gets mutated inputs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reader {
    /// WIF drafts.
    Wif,
    /// Drafts of Fiberworks.
    Dtx,
    /// Drafts of WeavePoint.
    Wpo,
    /// Design files with a notation.
    Design,
    /// The notation of a weave, in an otherwise valid design.
    Notation,
    /// Point paper, in an otherwise valid design.
    Image,
    /// Design files with an image or a draft. All files are mutated.
    Paper,
    /// Knitout files.
    Knitout,
    /// Design files of knits, with a chart, an image or a knitout file. The image is mutated only
    /// one time in four, all other files always.
    Knit,
    /// Design files of warp knits, some with an image, which is mutated only one time in four.
    WarpKnit,
    /// Files of saved yarns.
    Yarns,
    /// Files of curves.
    Curves,
    /// OBJ files with polylines.
    Polylines,
    /// USD files with curves.
    Stage,
    /// TexGen files.
    Texgen,
}

impl Reader {
    /// All readers.
    pub const ALL: [Self; 15] = [
        Self::Wif,
        Self::Dtx,
        Self::Wpo,
        Self::Design,
        Self::Notation,
        Self::Image,
        Self::Paper,
        Self::Knitout,
        Self::Knit,
        Self::WarpKnit,
        Self::Yarns,
        Self::Curves,
        Self::Polylines,
        Self::Stage,
        Self::Texgen,
    ];

    /// The name of the reader, in lower case.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Wif => "wif",
            Self::Dtx => "dtx",
            Self::Wpo => "wpo",
            Self::Design => "design",
            Self::Notation => "notation",
            Self::Image => "image",
            Self::Paper => "paper",
            Self::Knitout => "knitout",
            Self::Knit => "knit",
            Self::WarpKnit => "warp-knit",
            Self::Yarns => "yarns",
            Self::Curves => "curves",
            Self::Polylines => "polylines",
            Self::Stage => "stage",
            Self::Texgen => "texgen",
        }
    }
}

/// A mutated design: files of one folder. The first one is the file that is read.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Input {
    /// Names and bytes of the files.
    pub files: Vec<(&'static str, Vec<u8>)>,
}

impl Input {
    /// The input of `reader` with this number.
    #[must_use]
    pub fn new(reader: Reader, number: u64) -> Self {
        let mut random = fastrand::Rng::with_seed(number);
        let random = &mut random;
        let files = match reader {
            Reader::Wif => vec![("design.wif", text::mutated(corpus::WIF, random))],
            Reader::Dtx => vec![("design.dtx", text::mutated(corpus::DTX, random))],
            Reader::Wpo => vec![("design.wpo", wpo_bytes::mutated(random))],
            Reader::Design => vec![("design.toml", text::mutated(corpus::DESIGNS, random))],
            Reader::Notation => {
                let notation = text::notation(random);
                vec![("design.toml", corpus::design_of(&notation).into_bytes())]
            }
            Reader::Image => {
                let design = random.choice(corpus::PAPERS).copied().unwrap_or_default();
                vec![
                    ("design.toml", design.into()),
                    ("motif.png", image_bytes::mutated(random)),
                    ("draft.wif", corpus::WIF[0].into()),
                ]
            }
            Reader::Paper => vec![
                ("design.toml", text::mutated(corpus::PAPERS, random)),
                ("motif.png", image_bytes::mutated(random)),
                ("draft.wif", text::mutated(corpus::WIF, random)),
            ],
            Reader::Knitout => vec![("design.k", text::mutated(corpus::KNITOUT, random))],
            Reader::Knit => vec![
                ("design.toml", text::mutated(corpus::KNITS, random)),
                ("motif.png", image_bytes::plain(random)),
                ("program.k", text::mutated(corpus::KNITOUT, random)),
            ],
            Reader::WarpKnit => vec![
                ("design.toml", text::mutated(corpus::WARPS, random)),
                ("motif.png", image_bytes::plain(random)),
            ],
            Reader::Yarns => vec![("design.yarns", yarn_bytes::mutated(random))],
            Reader::Curves => vec![("design.bcc", yarn_bytes::mutated_curves(random))],
            Reader::Polylines => vec![("design.obj", text::mutated(corpus::POLYLINES, random))],
            Reader::Stage => vec![("design.usda", text::mutated(corpus::STAGES, random))],
            Reader::Texgen => vec![("design.tg3", text::mutated(corpus::TEXGEN, random))],
        };
        Self { files }
    }
}
