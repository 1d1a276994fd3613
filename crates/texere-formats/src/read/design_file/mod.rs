//! texere's own design file, in TOML.
//!
//! ```toml
//! name = "Denim"
//!
//! [weave]                         # a notation with a size, or else a drawdown, image = "motif.png" or wif = "draft.wif"
//! notation = "3/1"
//! ends = 120
//! picks = 80
//!
//! [cloth]                         # how threads lie; all of it may be left out
//! selvedge = true
//!
//! [finish]                        # how yarns come to rest; all of it may be left out
//! calender = 2.0
//!
//! [yarns.indigo]
//! tex = 60.0                      # or cotton_count = 10, or diameter_mm
//! color = "#26406e"
//! section = { shape = "ellipse", aspect = 1.4 }
//! twist_per_m = 550.0             # turns per metre; Z is positive, S negative
//!
//! [yarns.ecru]
//! diameter_mm = 0.3
//! plies = 2
//!
//! [warp]
//! yarns = ["3 indigo", "ecru"]    # repeated over all ends
//! per_cm = 12.0                   # or per_inch, or spacing_mm, one number or a list: [2.0, 1.0] for thick and thin ends
//!
//! [weft]
//! yarns = ["ecru"]
//! spacing_mm = 1.0
//! ```
//!
//! Every key of `[weave]`, which has exactly one of the first four:
//!
//! | key | value |
//! |---|---|
//! | `notation` | a weave by notation or name, as [`Weave`] reads it; `ends` and `picks` say how large the cloth is |
//! | `drawdown` | a row for each pick, the last one on top: `1` where the warp is up, `0` where it is not; repeated over `ends` and `picks` |
//! | `image` | point paper, each pixel a crossing: a PNG, BMP or TIFF file beside the design |
//! | `wif` | a draft beside the design: a WIF file, or one of Fiberworks or WeavePoint |
//! | `ends`, `picks` | the size of the cloth. A notation needs them. With a drawdown they are the drawdown's own size if left out. With an image they are left out, or are the image's size times `repeat`. With `wif` they are refused |
//! | `rows` | which pick the image's top row is: `"last-pick-first"`, as weavers draw, or `"first-pick-first"` |
//! | `repeat` | `[2, 3]`: the image twice across the ends and three times along the picks; `[1, 1]` if not given |
//! | `[weave.colors]` | what each colour of the image is woven in: `"#203040" = "satin 8(3)"` |
//!
//! The weaves of an image are counted from the cloth's first end and first pick, not from the edges
//! of their areas. Areas of one weave therefore join up, also from one repeat of the image to the
//! next. Each colour of the image has to be in `[weave.colors]`. Without that table the image has
//! two colours, and the darker one is warp up. Pixels are opaque or wholly transparent; transparent
//! pixels are one colour, lighter than any other. The colour space of an image is not read.
//!
//! The picks of a Jacquard cloth take the yarns of `[weft]` in turn: `["2 red", "white"]` are two
//! red picks and one white pick.
//!
//! Every key of `[cloth]`, which says how threads lie:
//!
//! | key | value |
//! |---|---|
//! | `shape` | `"round"` ([`Shape::Round`], if not given) or `"crossing"` ([`Shape::Crossing`]) |
//! | `warp_crimp` | the warp's share of the crimp, 0 to 1 ([`Crimp::WarpShare`]); by stiffness if not given |
//! | `selvedge` | `true`: the weft turns back round the edge ends, one yarn; `false` if not given |
//! | `jam` | what is done where threads are jammed: `"report"`, if not given, `"flatten"` or `"shrink"` ([`Relief`]) |
//!
//! Instead of `[weave]`, `[cloth]`, `[warp]` and `[weft]` a design may have `[knit]`, a weft knit:
//!
//! | key | value |
//! |---|---|
//! | `chart` | symbols, a line for each row, the last on top ([`Chart::parse`]); with `[knit.colors]` letters, each of which is a yarn ([`Chart::jacquard`]) |
//! | `image`, `[knit.colors]`, `rows` | a picture beside the design: each colour a yarn ([`Chart::jacquard`]) or a symbol |
//! | `knitout` | a program of a knitting machine beside the design |
//! | `beds`, `backing` | 1 or 2 ([`Beds`]); `"birdseye"` or `"ladder"` ([`Backing`]) |
//! | `yarns` | the yarns of courses, or of carriers, in turn |
//! | `repeat` | `[20, 16]`: copies across the wales and along the courses |
//! | `wales_per_cm` or `needles_per_inch`, `courses_per_cm`, `loop_length_mm` | how close stitches lie ([`Gauge`]) |
//! | `[knit.stitch_lengths_mm]` | yarn in a loop for each stitch size of a knitout file |
//! | `compression` | the share of its diameter that a yarn keeps between other yarns, 0.8 to 1 |
//! | `cells` | `"round"` or `"even"` ([`Cells`]) |
//! | `float_max` | how many needles a yarn may float past before it is warned of |
//!
//! A warp knit has `[warp_knit]` in place of `[knit]`:
//!
//! | key | value |
//! |---|---|
//! | `wales`, `courses`, `repeat` | wales and courses of a piece, each a multiple of the number after which all bars repeat; and how many copies of the piece lie across the wales and along the courses: `[4, 2]` |
//! | `wales_per_cm`, or `needles_per_inch` with `draw_in`; `courses_per_cm` | how close loops lie when finished |
//! | `compression`, `cells` | as in `[knit]` |
//! | `[[warp_knit.bars]]` | a guide bar, the front one first |
//!
//! Every key of a bar:
//!
//! | key | value |
//! |---|---|
//! | `lapping`, `step` | `lapping` is chain notation ([`Chain`]) or a name ([`LAPPINGS`]); `step` is 2 where only every second number of the chain is a needle space |
//! | `threading` | yarns of guides in turn, `out` for an empty one: `["2 white", "out"]` |
//! | `offset` | needles by which the bar stands further to the right |
//! | `run_in_mm` | the yarn that a guide takes for a rack of 480 courses, mm |
//! | `image`, `rows`, `colors` | of a Jacquard bar: a pixel of the image is a guide at one round of the chain, and its colour says by how many needles the laps are displaced: `"0-0/1-1"` |
//!
//! Every key of `[finish]`, which says how yarns come to rest ([`Finish`], [`Structure::settle`]).
//! `rest`, `hold`, `length`, `tension` and `press` are for knits, the rows below them for woven
//! cloth:
//!
//! | key | value |
//! |---|---|
//! | `settle` | whether yarns settle at all; `true` if not given |
//! | `rest` | of knits: `"clear"`, or `"energy"` for the least energy of bending and contact ([`RestBy`](texere_fabric::RestBy)); `"clear"` if not given |
//! | `hold` | of knits that rest by their energy: `"courses"`, `"wales"` or `"both"`, the way along which the cloth keeps the size of its gauge ([`Along`](texere_fabric::Along)) |
//! | `length` | `"held"`, `"free"`, or a number: how many times its length each yarn is to have ([`Length`]); if not given, as loop lengths or run-ins ask for, see [`Finish`] |
//! | `tension` | with `length = "free"`: what draws yarns in, 0 to 0.1; 0 if not given |
//! | `press` | the distance of two plates that press the cloth while its yarns settle, mm |
//! | `warp_tension`, `weft_tension` | how taut the cloth is held, 1 for relaxed cloth, 0 to 10 |
//! | `calender` | how strongly the cloth is pressed flat, 1 for relaxed cloth, 0 to 10 |
//! | `stretch_warp` or `stretch_weft` | how many times as long the cloth becomes that way, its threads keeping their length ([`Stretch`](texere_fabric::Stretch)) |
//!
//! With `wif`, `[warp]` and `[weft]` are optional. If given, they replace the threads of the draft.

mod any;
mod cloth;
mod colors;
mod design;
mod finish;
mod jacquard;
mod knit;
mod knit_keys;
#[cfg(feature = "knitout")]
mod knitout;
pub(crate) mod limits;
mod schema;
mod source;
mod threads;
mod value;
mod warp_knit;
mod weave;

pub(super) use design::read;
#[cfg(doc)]
use texere_core::settling::Length;
#[cfg(doc)]
use texere_fabric::warp::{Chain, LAPPINGS};
#[cfg(doc)]
use texere_fabric::weft::{Backing, Beds, Cells, Chart, Gauge};
#[cfg(doc)]
use texere_fabric::{Crimp, Finish, Relief, Shape, Structure, Weave};
pub(crate) use warp_knit::OUT;
