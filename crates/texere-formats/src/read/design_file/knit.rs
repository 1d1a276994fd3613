//! The `[knit]` table: a weft knit, from a chart or a picture, or from a knitout file.

use std::ops::Range;
use std::path::Path;

use texere_fabric::Thread;
use texere_fabric::weft::{Backing, Beds, Chart, ChartError, Gauge};
use toml::Spanned;

use super::limits::{LOOP_MM, PER_CM, PER_INCH};
use super::schema::{DesignFile, KnitTable};
use super::source::Source;
use super::threads::{Named, YarnTable};
use super::{colors, knit_keys};
use crate::read::error::first_few;
use crate::read::file::file_name;
use crate::read::knit::Knit;
use crate::read::knitted_from::{Drawn, Legend};
use crate::read::point_paper::{PointPaper, RowOrder};
use crate::read::{Design, FilePlace, ReadError};

/// The greatest value of `float_max`, the number of needles that a yarn may float past without a
/// warning.
const FLOAT_MAX: i64 = 1_000_000;

/// Reads the knit that `table` describes.
pub(super) fn read(
    source: &Source<'_>,
    file: &DesignFile,
    table: &KnitTable,
    yarns: &YarnTable,
) -> Result<Design, ReadError> {
    without_weaving(source, file)?;
    let name = file.name.clone().unwrap_or_else(|| file_name(source.path));
    let reader = Reader { source, table, yarns };
    match (&table.chart, &table.image, &table.knitout) {
        (Some(chart), None, None) => reader.chart(name, chart),
        (None, Some(image), None) => reader.image(name, image),
        (None, None, Some(knitout)) => reader.knitout(name, knitout),
        _ => {
            let keys = "knit.chart, knit.image and knit.knitout";
            Err(ReadError::ExactlyOne { file: source.path.into(), keys })
        }
    }
}

/// Refuses keys that are about weaving.
pub(super) fn without_weaving(source: &Source<'_>, file: &DesignFile) -> Result<(), ReadError> {
    let cloth = &file.cloth;
    let spans = [
        ("warp", file.warp.as_ref().map(|set| set.yarns.span())),
        ("weft", file.weft.as_ref().map(|set| set.yarns.span())),
        ("cloth.shape", cloth.shape.as_ref().map(Spanned::span)),
        ("cloth.warp_crimp", cloth.warp_crimp.as_ref().map(Spanned::span)),
        ("cloth.selvedge", cloth.selvedge.as_ref().map(Spanned::span)),
        ("cloth.jam", cloth.jam.as_ref().map(Spanned::span)),
    ];
    match spans.into_iter().find_map(|(field, span)| Some((field, span?))) {
        Some((field, span)) => Err(ReadError::Without { place: source.place(field, span), needs: "[weave]" }),
        None => Ok(()),
    }
}

/// What a chart was read from: the text of a design file, or an image.
pub(super) struct Drawing<'a> {
    pub(super) file: &'a Path,
    /// The key that gives the chart.
    pub(super) place: FilePlace,
    pub(super) legend: Legend,
    /// Whether the row on top is knitted first.
    pub(super) upside_down: bool,
}

pub(super) struct Reader<'a> {
    pub(super) source: &'a Source<'a>,
    pub(super) table: &'a KnitTable,
    pub(super) yarns: &'a YarnTable,
}

impl Reader<'_> {
    /// Refuses a knitout file by name, in a build without knitout.
    #[cfg(not(feature = "knitout"))]
    fn knitout(&self, _: String, knitout: &Spanned<String>) -> Result<Design, ReadError> {
        let file = self.source.beside(knitout);
        Err(ReadError::Feature { file, what: "knitout files", feature: "knitout" }
            .named(self.source.place("knit.knitout", knitout.span())))
    }

    fn chart(&self, name: String, text: &Spanned<String>) -> Result<Design, ReadError> {
        let table = self.table;
        self.belongs("knit.image", &[("knit.rows", table.rows.as_ref().map(Spanned::span))])?;
        self.without_stitch_lengths()?;
        if let Some(colors) = &table.colors {
            return self.letters(name, text, colors.as_ref());
        }
        self.belongs("knit.colors", &[("knit.backing", table.backing.as_ref().map(Spanned::span))])?;
        let refused = |error| self.refused("knit.chart", text.span(), error);
        let chart = Chart::parse(text.as_ref(), self.beds()?).map_err(refused)?;
        let (turn, yarns) = self.yarns_in_turn()?;
        let chart = chart.with_yarns(&turn).map_err(refused)?;
        let drawing = Drawing {
            file: self.source.path,
            place: self.source.place("knit.chart", text.span()),
            legend: Legend::Stitches,
            upside_down: false,
        };
        self.charted(name, chart, yarns, drawing, Vec::new())
    }

    fn image(&self, name: String, image: &Spanned<String>) -> Result<Design, ReadError> {
        let (source, table) = (self.source, self.table);
        self.without_stitch_lengths()?;
        let path = source.beside(image);
        let rows = table.rows.as_ref().map(|rows| *rows.as_ref()).unwrap_or_default();
        let upside_down = rows == RowOrder::FirstPickFirst;
        let refused = |error: ReadError| error.named(source.place("knit.image", image.span()));
        let paper = PointPaper::read(&path, source.files, rows).map_err(refused)?;
        let Some(colors) = &table.colors else {
            return Err(ReadError::MissingKey {
                file: source.path.into(),
                field: "knit.colors".into(),
                needed_for: "it says which yarn, or which symbol of a chart, each colour of the image is",
            });
        };
        let mut warnings = Vec::new();
        let meant = colors::of_paper(source, &paper, "knit.colors", colors.as_ref(), &mut warnings)?
            .map_err(refused)?;
        let meant: Vec<_> = meant.into_iter().map(|meant| meant.as_ref().clone()).collect();
        let fault = |error: ChartError| {
            // Rows of a chart count from its top row, which may be the bottom row of the image.
            let error = if upside_down { error.from_below(paper.picks) } else { error };
            self.refused("knit.image", image.span(), error)
        };
        let is_yarn = |text: &String| self.yarns.thread(text).is_some();
        let place = || source.place("knit.image", image.span());
        let (columns, rows) = (paper.ends, paper.picks);
        if meant.iter().all(is_yarn) {
            self.without_symbols("symbols in [knit.colors]")?;
            let (yarns, numbers) = self.by_name(&meant);
            let yarn = |column, row| numbers[paper.color(column, row)];
            let backing = self.backing()?;
            let chart = Chart::jacquard(columns, rows, backing, yarn).map_err(fault)?;
            let drawing =
                Drawing { file: &path, place: place(), legend: Legend::Yarns(backing), upside_down };
            self.charted(name, chart, yarns, drawing, warnings)
        } else {
            if let Some(backing) = &table.backing {
                let place = source.place("knit.backing", backing.span());
                return Err(ReadError::Without { place, needs: "yarns in [knit.colors]" });
            }
            let mut symbols = Vec::new();
            for (text, color) in meant.iter().zip(&paper.colors) {
                let mut letters = text.chars();
                match (letters.next(), letters.next()) {
                    (Some(symbol), None) => symbols.push(symbol),
                    _ => {
                        let known = first_few(self.yarns.names().map(|name| format!("\"{name}\"")));
                        let expected = format!(
                            "of all colours a symbol of a chart, or of all of them a yarn: {known}; it stands for \"{text}\""
                        );
                        return Err(refused(color.refused(&paper.file, expected)));
                    }
                }
            }
            let symbol = |column, row| symbols[paper.color(column, rows - 1 - row)];
            let chart = Chart::from_symbols(columns, rows, self.beds()?, symbol).map_err(fault)?;
            let (turn, yarns) = self.yarns_in_turn()?;
            let chart = chart.with_yarns(&turn).map_err(fault)?;
            let drawing = Drawing { file: &path, place: place(), legend: Legend::Stitches, upside_down };
            self.charted(name, chart, yarns, drawing, warnings)
        }
    }

    /// The design of a knit whose repeat is `chart`.
    pub(super) fn charted(
        &self,
        name: String,
        chart: Chart,
        yarns: Vec<Named>,
        drawing: Drawing<'_>,
        warnings: Vec<String>,
    ) -> Result<Design, ReadError> {
        let Drawing { file, place, legend, upside_down } = drawing;
        let mut program = chart.program().map_err(|error| chart_refused(place, error))?;
        let (names, threads): (Vec<_>, Vec<_>) = yarns.into_iter().unzip();
        // The program names its carriers by the numbers of their yarns. Here they get the yarns'
        // names. Yarns that the chart does not reach have no carrier.
        program.carriers.iter_mut().zip(names).for_each(|(carrier, name)| *carrier = name);
        let knit = self.knit(self.gauge(None)?, threads)?;
        let drawn = Drawn::Cells { file: file.into(), chart, legend, upside_down };
        knit.design(self.source.path, name, program, drawn, warnings)
    }

    /// The settings of a knit whose carriers have the yarns `threads`.
    pub(super) fn knit(&self, gauge: Gauge, threads: Vec<Thread>) -> Result<Knit, ReadError> {
        let (source, table) = (self.source, self.table);
        let compression = knit_keys::compression(source, "knit.compression", table.compression.as_ref())?;
        let copies = knit_keys::copies(source, "knit.repeat", table.repeat.as_ref())?;
        let cells = knit_keys::cells(source, "knit.cells", table.cells.as_ref())?;
        let float_max = table
            .float_max
            .as_ref()
            .map(|most| source.integer("knit.float_max", most, 1, FLOAT_MAX))
            .transpose()?;
        let (yarns, materials, sections) =
            Knit::yarns_of(threads, compression, &self.yarns.materials, &self.yarns.sections);
        Ok(Knit { gauge, yarns, materials, sections, copies, cells, float_max })
    }

    /// The gauge: how close stitches lie. `needles` is the number of needles to the inch in the
    /// knitout file, if any.
    pub(super) fn gauge(&self, needles: Option<f64>) -> Result<Gauge, ReadError> {
        let (source, table) = (self.source, self.table);
        let wales = source.optional("knit.wales_per_cm", &table.wales_per_cm, PER_CM)?;
        let courses = source.optional("knit.courses_per_cm", &table.courses_per_cm, PER_CM)?;
        let per_inch = source.optional("knit.needles_per_inch", &table.needles_per_inch, PER_INCH)?;
        let loop_mm = source.optional("knit.loop_length_mm", &table.loop_length_mm, LOOP_MM)?;
        let gauge = match (wales, per_inch, courses) {
            (Some(_), Some(_), _) => {
                let keys = "knit.wales_per_cm and knit.needles_per_inch";
                return Err(ReadError::ExactlyOne { file: source.path.into(), keys });
            }
            (Some(wales), None, Some(courses)) => Gauge::new(10.0 / wales, 10.0 / courses),
            (None, Some(needles), Some(courses)) => Gauge::per_inch(needles, courses),
            (None, None, None) => match (loop_mm, needles) {
                (Some(loop_mm), _) => Gauge::munden(loop_mm),
                (None, Some(needles)) => Gauge::plain(needles),
                (None, None) => {
                    return Err(ReadError::MissingKey {
                        file: source.path.into(),
                        field: "knit.wales_per_cm".into(),
                        needed_for: "with knit.courses_per_cm it says how close stitches lie; so does knit.loop_length_mm",
                    });
                }
            },
            (None, None, Some(_)) | (_, _, None) => {
                let field = if courses.is_none() { "knit.courses_per_cm" } else { "knit.wales_per_cm" };
                return Err(ReadError::MissingKey {
                    file: source.path.into(),
                    field: field.into(),
                    needed_for: "wales and courses are given together",
                });
            }
        };
        Ok(Gauge { loop_length_mm: loop_mm, ..gauge })
    }

    fn beds(&self) -> Result<Beds, ReadError> {
        match &self.table.beds {
            None => Ok(Beds::One),
            Some(beds) if *beds.as_ref() == 1 => Ok(Beds::One),
            Some(beds) if *beds.as_ref() == 2 => Ok(Beds::Two),
            Some(beds) => Err(self.source.bad("knit.beds", beds, "1 or 2")),
        }
    }

    pub(super) fn backing(&self) -> Result<Option<Backing>, ReadError> {
        match &self.table.backing {
            None => Ok(None),
            Some(backing) => match backing.as_ref().as_str() {
                "birdseye" => Ok(Some(Backing::Birdseye)),
                "ladder" => Ok(Some(Backing::Ladder)),
                _ => Err(self.source.bad("knit.backing", backing, "\"birdseye\" or \"ladder\"")),
            },
        }
    }

    /// The yarns of `knit.yarns` one after another, as numbers, and the named yarns that the
    /// numbers stand for. Without the key, both lists hold the only yarn of the design.
    pub(super) fn yarns_in_turn(&self) -> Result<(Vec<u32>, Vec<Named>), ReadError> {
        let Some(list) = &self.table.yarns else {
            return match self.yarns.only() {
                Some(only) => Ok((vec![0], vec![only])),
                None => Err(ReadError::MissingKey {
                    file: self.source.path.into(),
                    field: "knit.yarns".into(),
                    needed_for: "it says which of the yarns are knitted",
                }),
            };
        };
        self.yarns.in_turn(self.source, "knit.yarns", list)
    }

    /// Refuses keys that have no effect without the key `needs`.
    pub(super) fn belongs(
        &self,
        needs: &'static str,
        keys: &[(&str, Option<Range<usize>>)],
    ) -> Result<(), ReadError> {
        match keys.iter().find_map(|(field, span)| Some((field, span.clone()?))) {
            Some((field, span)) => Err(ReadError::Without { place: self.source.place(field, span), needs }),
            None => Ok(()),
        }
    }

    fn without_stitch_lengths(&self) -> Result<(), ReadError> {
        let first = self.table.stitch_lengths_mm.keys().next().map(Spanned::span);
        self.belongs("knit.knitout", &[("knit.stitch_lengths_mm", first)])
    }

    pub(super) fn refused(&self, field: &str, span: Range<usize>, error: ChartError) -> ReadError {
        chart_refused(self.source.place(field, span), error)
    }
}

/// The error of a chart that is given at `place`.
fn chart_refused(place: FilePlace, error: ChartError) -> ReadError {
    match error {
        ChartError::OutOfMemory(error) => error.into(),
        source => ReadError::Chart { place, source },
    }
}
