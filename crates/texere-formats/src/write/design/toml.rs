//! A woven design as texere's own design file.

use std::io::Write;

use texere_fabric::{Drawdown, Relief, Woven};

use super::super::WriteError;
use super::super::target::Target;
use super::cloth::{Finished, cloth_keys};
use super::format::DESIGN_FILE as FORMAT;
use super::interlacing::Interlacing;
use super::text::{Text, nearest, within};
use super::toml_text::quoted;
use super::woven::woven;
use super::yarns::Yarns;
use crate::Design;
use crate::read::limits;

/// The contents of a design file, checked.
pub(super) struct TomlFile<'a> {
    name: &'a str,
    cloth: &'a Woven,
    /// The tables `[cloth]` and `[finish]`, each with its heading. A table without keys is left
    /// out.
    tables: String,
    yarns: Yarns,
    sets: [String; 2],
    /// The parts of the design that the file does not hold.
    pub(super) left_out: Vec<String>,
}

impl<'a> TomlFile<'a> {
    pub(super) fn new(design: &'a Design) -> Result<Self, WriteError> {
        let woven = woven(FORMAT, design)?;
        let mut left_out = Vec::new();
        if woven.draft().is_some() {
            left_out.push("the draft: threading, tie-up and treadling, or lift plan, which WIF holds".into());
        }
        let relief = woven.relief();
        // Cloth that comes to rest needs no relief, and in its design file the key of the relief is
        // refused.
        let cloth = if design.settle && relief != Relief::Report {
            left_out.push("cloth.jam: threads that come to rest are written as they were relieved".into());
            woven.cloth()
        } else {
            woven.as_given()
        };
        let mut keys = cloth_keys(cloth);
        match relief {
            Relief::Flatten if !design.settle => keys.push("jam = \"flatten\"".into()),
            Relief::Shrink if !design.settle => keys.push("jam = \"shrink\"".into()),
            _ => {}
        }
        let mut tables = table("cloth", &keys);
        tables.push_str(&table("finish", &finish_keys(design, &mut left_out)?));
        let yarns = Yarns::new(cloth)?;
        if let Some([name, other]) = &yarns.renamed {
            left_out.push(format!("names of yarns that can't be kept: {name:?} becomes {other:?}"));
        }
        let sets = [yarns.set("warp", cloth.warp())?, yarns.set("weft", cloth.weft())?];
        Ok(Self { name: &design.name, cloth, tables, yarns, sets, left_out })
    }

    pub(super) fn write<W: Write>(&self, target: Target<W>) -> Result<Target<W>, WriteError> {
        let mut text = Text::new(target, FORMAT, limits::FILE);
        text.line(&format!("name = {}", quoted(self.name)))?;
        text.line("\n[weave]\ndrawdown = '''")?;
        let drawdown = self.cloth.drawdown();
        rows(&mut text, drawdown)?;
        text.line(&format!("'''\nends = {}\npicks = {}", drawdown.ends(), drawdown.picks()))?;
        text.put(&self.tables)?;
        for table in self.yarns.tables() {
            text.put(&table)?;
        }
        for set in &self.sets {
            text.put(set)?;
        }
        Ok(text.end())
    }
}

/// Writes a row for each pick of the repeat, the last pick on top.
fn rows<W: Write>(text: &mut Text<W>, drawdown: &Drawdown) -> Result<(), WriteError> {
    let [ends, picks] = Interlacing::new(drawdown).repeat();
    for pick in (0..picks).rev() {
        let row: String = (0..ends).map(|end| if drawdown.up(end, pick) { '1' } else { '0' }).collect();
        text.line(&row)?;
    }
    Ok(())
}

/// The keys of `[finish]`.
fn finish_keys(design: &Design, left_out: &mut Vec<String>) -> Result<Vec<String>, WriteError> {
    let finished = Finished::new(design);
    left_out.extend(finished.unsaid);
    let mut keys = Vec::new();
    if !design.settle {
        keys.push("settle = false".into());
    }
    for (key, value) in finished.keys {
        let is_stretch = key.starts_with("stretch");
        let range = if is_stretch { limits::STRETCH } else { [0.0, limits::TIMES_MOST] };
        within(FORMAT, || format!("finish.{key}"), value, range)?;
        let reads = |read: f64| if is_stretch { read == value } else { read as f32 == value as f32 };
        keys.push(format!("{key} = {:?}", nearest(value, reads).0));
    }
    Ok(keys)
}

/// A table of `keys`, or an empty text if there are none.
fn table(name: &str, keys: &[String]) -> String {
    if keys.is_empty() { String::new() } else { format!("\n[{name}]\n{}\n", keys.join("\n")) }
}
