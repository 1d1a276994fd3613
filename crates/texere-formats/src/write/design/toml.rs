//! A design as texere's own design file.

use std::io::Write;

use texere_fabric::Structure;

use super::super::WriteError;
use super::super::target::Target;
use super::cloth::Finished;
use super::finish::{KnitFinish, Setting};
use super::format::DESIGN_FILE as FORMAT;
use super::knitted::knitted;
use super::text::{Text, nearest, within};
use super::toml_text::{quoted, table};
use super::toml_warp::warp_table;
use super::toml_weft::WeftTable;
use super::toml_woven::WovenTables;
use super::woven::woven;
use crate::Design;
use crate::read::limits;

/// The contents of a design file, checked.
pub(super) struct TomlFile<'a> {
    name: &'a str,
    pattern: Pattern<'a>,
    finish: String,
    /// The tables of yarns, and of a warp and a weft.
    tables: Vec<String>,
    /// The parts of the design that the file does not hold.
    pub(super) left_out: Vec<String>,
}

/// The tables that say what is woven or knitted.
enum Pattern<'a> {
    Woven(WovenTables<'a>),
    Weft(WeftTable<'a>),
    Warp(String),
}

impl<'a> TomlFile<'a> {
    pub(super) fn new(design: &'a Design) -> Result<Self, WriteError> {
        let mut left_out = Vec::new();
        let (pattern, yarns, sets) = match &design.structure {
            Structure::Weft(_) => {
                let (knit, from) = knitted(FORMAT, design)?;
                let (table, yarns) = WeftTable::new(knit, from, &mut left_out)?;
                (Pattern::Weft(table), yarns, Vec::new())
            }
            Structure::Warp(knit) => {
                let (table, yarns) = warp_table(knit, &mut left_out)?;
                (Pattern::Warp(table), yarns, Vec::new())
            }
            _ => {
                let woven = woven(FORMAT, design)?;
                let (tables, yarns) = WovenTables::new(woven, design.settle, &mut left_out)?;
                let sets = tables.sets(&yarns)?;
                (Pattern::Woven(tables), yarns, sets.into())
            }
        };
        if let Some([name, other]) = &yarns.renamed {
            left_out.push(format!("names of yarns that can't be kept: {name:?} becomes {other:?}"));
        }
        let finish = table("finish", &finish_keys(design, &mut left_out)?);
        let tables = yarns.tables().chain(sets).collect();
        Ok(Self { name: &design.name, pattern, finish, tables, left_out })
    }

    pub(super) fn write<W: Write>(&self, target: Target<W>) -> Result<Target<W>, WriteError> {
        let mut text = Text::new(target, FORMAT, limits::FILE);
        text.line(&format!("name = {}", quoted(self.name)))?;
        match &self.pattern {
            Pattern::Woven(tables) => tables.write(&mut text)?,
            Pattern::Weft(table) => table.write(&mut text)?,
            Pattern::Warp(table) => text.put(table)?,
        }
        text.put(&self.finish)?;
        for table in &self.tables {
            text.put(table)?;
        }
        Ok(text.end())
    }
}

/// The keys of `[finish]`.
fn finish_keys(design: &Design, left_out: &mut Vec<String>) -> Result<Vec<String>, WriteError> {
    let mut keys = Vec::new();
    if !design.settle {
        keys.push("settle = false".into());
    }
    if design.structure.woven().is_none() {
        let finish = KnitFinish::new(design);
        left_out.extend(finish.unsaid);
        for (key, setting) in finish.keys {
            keys.push(knit_key(key, &setting)?);
        }
        return Ok(keys);
    }
    let finished = Finished::new(design);
    left_out.extend(finished.unsaid);
    for (key, value) in finished.keys {
        let is_stretch = key.starts_with("stretch");
        let range = if is_stretch { limits::STRETCH } else { [0.0, limits::TIMES_MOST] };
        within(FORMAT, || format!("finish.{key}"), value, range)?;
        let reads = |read: f64| if is_stretch { read == value } else { read as f32 == value as f32 };
        keys.push(format!("{key} = {:?}", nearest(value, reads).0));
    }
    Ok(keys)
}

/// A key of a knit's `[finish]` with its value.
fn knit_key(key: &str, setting: &Setting) -> Result<String, WriteError> {
    let number = match *setting {
        Setting::Word(word) => return Ok(format!("{key} = \"{word}\"")),
        Setting::Number(number) => nearest(number.into(), |read| read as f32 == number).0,
    };
    let range = match key {
        "length" => limits::LENGTHS,
        "tension" => [0.0, limits::TENSION_MOST],
        _ => limits::PRESS_MM,
    };
    within(FORMAT, || format!("finish.{key}"), number, range)?;
    Ok(format!("{key} = {number:?}"))
}
