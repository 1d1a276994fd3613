//! A `[knit]` table that names a knitout file.

use std::ffi::OsStr;

use toml::Spanned;

use super::knit::Reader;
use super::limits::LOOP_MM;
use crate::read::error::{first_few, named, shown};
use crate::read::knitout::{self, LoopLengths};
use crate::read::knitted_from::Drawn;
use crate::read::{Design, ReadError};

impl Reader<'_> {
    pub(super) fn knitout(&self, name: String, knitout: &Spanned<String>) -> Result<Design, ReadError> {
        let (source, table) = (self.source, self.table);
        self.belongs(
            "knit.chart or knit.image",
            &[
                ("knit.colors", table.colors.as_ref().map(Spanned::span)),
                ("knit.rows", table.rows.as_ref().map(Spanned::span)),
                ("knit.backing", table.backing.as_ref().map(Spanned::span)),
                ("knit.beds", table.beds.as_ref().map(Spanned::span)),
                ("knit.repeat", table.repeat.as_ref().map(Spanned::span)),
            ],
        )?;
        let mut lengths = LoopLengths::new();
        for (size, length) in &table.stitch_lengths_mm {
            let field = format!("knit.stitch_lengths_mm.\"{}\"", shown(size.as_ref()));
            let Some(name) = knitout::size(size.as_ref()) else {
                let expected = "a stitch size: the number behind x-stitch-number, or both behind stitch";
                return Err(source.unfit(&field, size.span(), expected));
            };
            let length = source.number(&field, length, LOOP_MM)?;
            if lengths.insert(name, length).is_some() {
                return Err(source.unfit(&field, size.span(), "each stitch size once, as a number"));
            }
        }
        let path = source.beside(knitout);
        let is_program =
            |ending: &OsStr| ["k", "knitout"].iter().any(|known| ending.eq_ignore_ascii_case(known));
        if !path.extension().is_some_and(is_program) {
            // Errors of a program may show a word of the file, so the key may name only files of
            // programs.
            return Err(source.bad("knit.knitout", knitout, "the path of a .k or .knitout file"));
        }
        let mut read = knitout::read(&path, source.files, &lengths)
            .map_err(|error| error.named(source.place("knit.knitout", knitout.span())))?;
        if !read.unused_sizes.is_empty() {
            let unused = first_few(read.unused_sizes.iter().cloned());
            let said = format!("knit.stitch_lengths_mm has sizes that {} does not: {unused}", named(&path));
            read.warnings.push(said);
        }
        let (turn, yarns) = self.yarns_in_turn()?;
        // Yarns go in turn to the carriers that are used. The yarns of unused carriers are not in
        // the cloth.
        let mut turn = turn.into_iter().cycle();
        let of_carrier = |used| if used { turn.next().unwrap_or(0) } else { 0 };
        let carriers = read.used_carriers().into_iter().map(of_carrier);
        let threads = carriers.map(|yarn| yarns[yarn as usize].1).collect();
        let gauge = self.gauge(read.gauge)?;
        let drawn = Drawn::Lines { file: path, head: read.head };
        let knit = self.knit(gauge, threads)?;
        knit.design(source.path, name, read.program, drawn, read.warnings)
    }
}
