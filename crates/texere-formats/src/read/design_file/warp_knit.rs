//! The `[warp_knit]` table: guide bars, the front one first, and how close their loops lie.

use texere_fabric::warp::{
    Bar, Chain, ChainError, Displacements, LAPPINGS, Threading, WarpError, WarpKnitted,
};
use texere_fabric::weft::Gauge;
use texere_fabric::{FabricError, SPACING_MAX, SPACING_MIN, Structure, Thread};
use toml::Spanned;

use super::knit::without_weaving;
use super::limits::{DRAW_IN, GUIDES_MAX, OFFSET_MAX, PER_CM, PER_INCH, SIDE_MAX};
use super::schema::{BarTable, DesignFile, WarpKnitTable};
use super::source::Source;
use super::threads::YarnTable;
use super::{colors, knit_keys};
use crate::read::file::file_name;
use crate::read::knit::Knit;
use crate::read::point_paper::PointPaper;
use crate::read::{Design, ReadError};

/// The word of a threading for a guide without yarn.
pub(crate) const OUT: &str = "out";

/// Reads the warp knit that `table` describes.
pub(super) fn read(
    source: &Source<'_>,
    file: &DesignFile,
    table: &WarpKnitTable,
    yarns: &YarnTable,
) -> Result<Design, ReadError> {
    without_weaving(source, file)?;
    let mut reader = Reader { source, yarns, threads: Vec::new(), warnings: Vec::new() };
    let bars = (1..).zip(&table.bars).map(|(number, bar)| reader.bar(number, bar));
    let bars = bars.collect::<Result<Vec<_>, _>>()?;
    let size = [("wales", &table.wales), ("courses", &table.courses)];
    let [wales, courses] =
        size.map(|(key, side)| source.integer(&format!("warp_knit.{key}"), side, 1, SIDE_MAX));
    let gauge = gauge(source, table)?;
    let copies = knit_keys::copies(source, "warp_knit.repeat", table.repeat.as_ref())?;
    let compression = knit_keys::compression(source, "warp_knit.compression", table.compression.as_ref())?;
    let cells = knit_keys::cells(source, "warp_knit.cells", table.cells.as_ref())?;
    let threads = reader.threads.iter().map(|(_, thread)| *thread).collect();
    let (knit_yarns, materials, sections) =
        Knit::yarns_of(threads, compression, &yarns.materials, &yarns.sections);
    let made = WarpKnitted::new(bars, gauge, wales?, courses?, knit_yarns, materials, sections, copies);
    let knit = made.map_err(|error| match error {
        FabricError::Warp(WarpError::WarpRepeat { what, multiple, .. }) => {
            let side = if what == "wale" { &table.wales } else { &table.courses };
            let expected = format!("a multiple of {multiple}, after which all bars repeat");
            source.bad(&format!("warp_knit.{what}s"), side, &expected)
        }
        error => source.fabric(error),
    })?;
    let name = file.name.clone().unwrap_or_else(|| file_name(source.path));
    Ok(Design::new(name, Structure::Warp(knit.with_cells(cells)), reader.warnings))
}

/// The gauge: how close loops lie.
fn gauge(source: &Source<'_>, table: &WarpKnitTable) -> Result<Gauge, ReadError> {
    let number =
        |key: &str, value: &Spanned<f64>, range| source.number(&format!("warp_knit.{key}"), value, range);
    let wale_mm = match (&table.wales_per_cm, &table.needles_per_inch, &table.draw_in) {
        (Some(wales), None, None) => 10.0 / number("wales_per_cm", wales, PER_CM)?,
        (None, Some(needles), draw_in) => {
            let drawn_in = draw_in.as_ref().map_or(Ok(1.0), |share| number("draw_in", share, DRAW_IN))?;
            25.4 / number("needles_per_inch", needles, PER_INCH)? * drawn_in
        }
        (Some(_), None, Some(draw_in)) => {
            let place = source.place("warp_knit.draw_in", draw_in.span());
            return Err(ReadError::Without { place, needs: "warp_knit.needles_per_inch" });
        }
        _ => {
            let keys = "warp_knit.wales_per_cm and warp_knit.needles_per_inch";
            return Err(ReadError::ExactlyOne { file: source.path.into(), keys });
        }
    };
    Ok(Gauge::new(wale_mm, 10.0 / number("courses_per_cm", &table.courses_per_cm, PER_CM)?))
}

struct Reader<'a> {
    source: &'a Source<'a>,
    yarns: &'a YarnTable,
    /// The yarns that bars hold, in the order of their first guides.
    threads: Vec<(&'a str, Thread)>,
    warnings: Vec<String>,
}

impl<'a> Reader<'a> {
    /// The bar of `table`. `number` is its number, counted from 1.
    fn bar(&mut self, number: usize, table: &'a BarTable) -> Result<Bar, ReadError> {
        let source = self.source;
        let field = |key: &str| format!("warp_knit.bars, bar {number}: {key}");
        let step = match &table.step {
            None => 1,
            Some(step) => source.integer(&field("step"), step, 1, 2)?,
        };
        let chain = self.lapping(&field("lapping"), &table.lapping, step)?;
        let offset =
            table.offset.as_ref().map_or(Ok(0), |needles| offset(source, &field("offset"), needles))?;
        let run_in_mm = source.optional(&field("run_in_mm"), &table.run_in_mm, [SPACING_MIN, SPACING_MAX])?;
        let threading = self.threading(&field("threading"), table)?;
        let jacquard = self.jacquard(&field, table, &chain)?;
        Ok(Bar { chain, threading, offset, run_in_mm, jacquard })
    }

    /// A lapping by its name, or else in chain notation.
    fn lapping(&self, field: &str, text: &Spanned<String>, step: u32) -> Result<Chain, ReadError> {
        if let Some(chain) = Chain::named(text.as_ref()) {
            return Ok(chain);
        }
        if text.as_ref().trim_start().starts_with(char::is_alphabetic) {
            let expected = format!("a chain as in 1-0/1-2//, or a lapping: {}", LAPPINGS.join(", "));
            return Err(self.source.bad(field, text, &expected));
        }
        Chain::parse(text.as_ref(), step).map_err(|error| self.no_chain(field, text, error))
    }

    fn no_chain(&self, field: &str, text: &Spanned<String>, source: ChainError) -> ReadError {
        ReadError::Chain { place: self.source.place(field, text.span()), source }
    }

    fn threading(&mut self, field: &str, table: &'a BarTable) -> Result<Threading, ReadError> {
        let yarns = self.yarns;
        let Some(list) = &table.threading else {
            let Some((name, thread)) = yarns.names().next().zip(yarns.only()).map(|(n, (_, t))| (n, t))
            else {
                return Err(ReadError::MissingKey {
                    file: self.source.path.into(),
                    field: field.into(),
                    needed_for: "it says which of the yarns the guides hold",
                });
            };
            return Ok(Threading::full(self.number(name, thread)));
        };
        let mut guides = Vec::new();
        for item in list.as_ref() {
            let (times, yarn) = match out(item.as_ref()) {
                Some(times) => (times, None),
                None => {
                    let (times, name, thread) = yarns.item(self.source, field, item)?;
                    (times, Some(self.number(name, thread)))
                }
            };
            if guides.len() + times as usize > GUIDES_MAX {
                return Err(self.source.bad(field, item, &format!("{GUIDES_MAX} guides at most")));
            }
            guides.extend(std::iter::repeat_n(yarn, times as usize));
        }
        if guides.iter().all(Option::is_none) {
            return Err(self.source.unfit(field, list.span(), "at least one yarn"));
        }
        Ok(Threading::of(guides))
    }

    /// The number of a yarn in `threads`. A yarn that is not in the list yet is added.
    fn number(&mut self, name: &'a str, thread: Thread) -> u32 {
        let known = self.threads.iter().position(|(other, _)| *other == name);
        if known.is_none() {
            self.threads.push((name, thread));
        }
        known.unwrap_or(self.threads.len() - 1) as u32
    }

    /// The displacements of guides, or none if the bar has no image.
    fn jacquard(
        &mut self,
        field: &impl Fn(&str) -> String,
        table: &BarTable,
        chain: &Chain,
    ) -> Result<Option<Displacements>, ReadError> {
        let source = self.source;
        let (image, colors) = match (&table.image, &table.colors) {
            (None, None) if table.rows.is_none() => return Ok(None),
            (Some(image), Some(colors)) => (image, colors),
            _ => {
                return Err(ReadError::MissingKey {
                    file: source.path.into(),
                    field: field("image and colors"),
                    needed_for: "a Jacquard bar has an image, and says what its colours displace",
                });
            }
        };
        let path = source.beside(image);
        let refused = |error: ReadError| error.named(source.place(&field("image"), image.span()));
        let rows = table.rows.as_ref().map(|rows| *rows.as_ref()).unwrap_or_default();
        let paper = PointPaper::read(&path, source.files, rows).map_err(refused)?;
        let meant =
            colors::of_paper(source, &paper, "warp_knit.bars.colors", colors.as_ref(), &mut self.warnings)?
                .map_err(refused)?;
        let palette = meant.into_iter().map(|shifts| self.shifts(&field("colors"), shifts, chain));
        let palette = palette.collect::<Result<Vec<_>, _>>()?;
        let size = [paper.ends, paper.picks].map(|side| side as u32);
        let cell = |guide: u32, round: u32| paper.color(guide as usize, round as usize) as u8;
        let displacements = Displacements::new(size, palette, cell);
        displacements.map(Some).ok_or_else(|| source.bad(&field("image"), image, "an image of fewer pixels"))
    }

    /// The displacements that a colour stands for: no needle or one, at the beginning and at the
    /// end of each lap of the chain.
    fn shifts(&self, field: &str, text: &Spanned<String>, chain: &Chain) -> Result<Vec<[u8; 2]>, ReadError> {
        let shifts = Chain::parse(text.as_ref(), 1).map_err(|error| self.no_chain(field, text, error))?;
        let shifts: Option<Vec<_>> =
            shifts.laps().iter().map(|lap| shift(lap.from).zip(shift(lap.to))).collect();
        match shifts {
            Some(shifts) if shifts.len() == chain.courses() => {
                Ok(shifts.into_iter().map(|(from, to)| [from, to]).collect())
            }
            _ => {
                let courses = chain.courses();
                let expected =
                    format!("0 or 1 needle for the beginning and the end of {courses} laps, as in 0-0/1-1");
                Err(self.source.bad(field, text, &expected))
            }
        }
    }
}

/// A displacement by 0 or 1 needle. None for any other number.
fn shift(needles: i32) -> Option<u8> {
    u8::try_from(needles).ok().filter(|needles| *needles <= 1)
}

/// The number of guides that an item such as `out` or `3 out` leaves empty.
fn out(item: &str) -> Option<u32> {
    let words: Vec<_> = item.split_whitespace().collect();
    match words[..] {
        [OUT] => Some(1),
        [times, OUT] => times.parse().ok().filter(|times| (1..=GUIDES_MAX as u32).contains(times)),
        _ => None,
    }
}

/// A number of needles, of either sign.
fn offset(source: &Source<'_>, field: &str, needles: &Spanned<i64>) -> Result<i32, ReadError> {
    let value = Spanned::new(needles.span(), *needles.as_ref() as f64);
    source.number(field, &value, [-OFFSET_MAX as f64, OFFSET_MAX as f64]).map(|needles| needles as i32)
}
