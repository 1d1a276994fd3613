//! Colours, spacing and thickness of the threads in a WIF file.

use std::collections::{BTreeMap, BTreeSet};
use std::io::Write;

use texere_core::Material;
use texere_fabric::{Thread, Woven};

use super::super::WriteError;
use super::format::WIF_DRAFT as FORMAT;
use super::interlacing::Kinds;
use super::text::{Text, nearest, within};
use crate::read::{WIF_LENGTH_MM, WIF_UNITS_MM};

/// The highest number of a colour that is kept. The table has all numbers up to the highest one, so
/// a high number would make a long table.
const NUMBER_MAX: u32 = 1000;

/// The colours of a cloth by number.
pub(super) struct Colors {
    /// Red, green and blue of each number, counted from 1.
    pub(super) table: BTreeMap<u32, [u8; 3]>,
    /// The number of the colour of each material in use. Undyed materials have none.
    numbers: BTreeMap<u32, u32>,
}

impl Colors {
    /// Numbers the colours of a cloth. Materials with the name of a numbered colour, which come
    /// from WIF, keep the number.
    pub(super) fn new(cloth: &Woven) -> Self {
        let threads = cloth.warp().iter().chain(cloth.weft());
        let used: BTreeSet<u32> = threads.map(|thread| thread.material).collect();
        let material = |number: &u32| &cloth.materials()[*number as usize];
        let used = used.into_iter().filter(|number| *material(number) != Material::default());
        let mut colors = Self { table: BTreeMap::new(), numbers: BTreeMap::new() };
        let mut others = Vec::new();
        for number in used {
            let own = named(&material(&number).name).filter(|own| !colors.table.contains_key(own));
            match own {
                Some(own) => colors.set(own, number, material(&number)),
                None => others.push(number),
            }
        }
        let mut free = 1;
        for number in others {
            while colors.table.contains_key(&free) {
                free += 1;
            }
            colors.set(free, number, material(&number));
        }
        let last = colors.table.keys().next_back().copied().unwrap_or(0);
        // Fills gaps in the table, for programs that count its lines. No thread has these colours.
        for number in 1..last {
            colors.table.entry(number).or_insert([255; 3]);
        }
        colors
    }

    fn set(&mut self, color: u32, number: u32, material: &Material) {
        self.table.insert(color, material.srgb);
        self.numbers.insert(number, color);
    }

    /// A note that names of yarns are left out, or none if no yarn has a name of its own.
    pub(super) fn unnamed(&self, cloth: &Woven) -> Option<String> {
        let name = |(number, color): (&u32, &u32)| {
            let name = &cloth.materials()[*number as usize].name;
            (*name != format!("colour {color}")).then_some(name)
        };
        let name = self.numbers.iter().find_map(name)?;
        Some(format!("names of yarns, such as {name:?}: colours have numbers"))
    }

    /// The number of a thread's colour, or an empty text for an undyed thread.
    fn of(&self, thread: &Thread) -> String {
        self.numbers.get(&thread.material).map_or_else(String::new, u32::to_string)
    }

    pub(super) fn write<W: Write>(&self, text: &mut Text<W>) -> Result<(), WriteError> {
        if self.table.is_empty() {
            return Ok(());
        }
        text.line(&format!("\n[COLOR PALETTE]\nEntries={}\nRange=0,255", self.table.len()))?;
        text.line("\n[COLOR TABLE]")?;
        for (number, [red, green, blue]) in &self.table {
            text.line(&format!("{number}={red},{green},{blue}"))?;
        }
        Ok(())
    }
}

/// The number in the name of a colour that was read from WIF.
fn named(name: &str) -> Option<u32> {
    let number = name.strip_prefix("colour ")?.parse().ok()?;
    ((1..=NUMBER_MAX).contains(&number) && name == format!("colour {number}")).then_some(number)
}

/// A property of the threads of a set: colour, spacing or thickness.
struct Column {
    /// The key in the set's own section, such as `Spacing` in `[WARP]`, and the last word in the
    /// name of the section of single threads, such as `SPACING` in `[WARP SPACING]`.
    keys: [&'static str; 2],
    kinds: Kinds,
    /// The value of each kind. It is empty for threads that have none.
    values: Vec<String>,
    /// The kind whose value is written for the whole set.
    common: usize,
}

impl Column {
    fn new(
        keys: [&'static str; 2],
        threads: &[Thread],
        key: impl Fn(&Thread) -> u64,
        value: impl Fn(usize) -> Result<String, WriteError>,
    ) -> Result<Self, WriteError> {
        let kinds = Kinds::new(threads.len(), |thread| key(&threads[thread]));
        let values = kinds.firsts.iter().map(|first| value(*first)).collect::<Result<Vec<_>, _>>()?;
        // If some threads have no value, the set can't have a value for all.
        let none = values.iter().position(String::is_empty);
        let common = none.unwrap_or_else(|| kinds.commonest());
        Ok(Self { keys, kinds, values, common })
    }

    /// The value for the whole set, which all threads without a value of their own get.
    fn common(&self) -> &str {
        &self.values[self.common]
    }

    /// Whether all threads have the common value.
    fn is_single(&self) -> bool {
        self.values.iter().all(|value| value == self.common())
    }
}

/// The warp or the weft, with the properties of its threads.
pub(super) struct Set {
    name: &'static str,
    threads: usize,
    unit: &'static str,
    columns: [Column; 3],
}

impl Set {
    pub(super) fn new(name: &'static str, threads: &[Thread], colors: &Colors) -> Result<Self, WriteError> {
        // Some spacings can be written to the bit in no unit. A reader then gets another value,
        // which may take fewer digits in another unit. The unit is therefore chosen for the values
        // that will be read, so that a file that is read and written again has the same text.
        let threads = &held(threads, unit(threads).1);
        let (unit, mm) = unit(threads);
        let limits = WIF_LENGTH_MM.map(|limit| limit / mm);
        let length = |what: &'static str, first: usize, value: f64| {
            let field = || format!("[{name} {what}] {}, in {unit}", first + 1);
            within(FORMAT, field, value, limits).map(|value| value.to_string())
        };
        let columns = [
            Column::new(
                ["Color", "COLORS"],
                threads,
                |thread| thread.material.into(),
                |first| Ok(colors.of(&threads[first])),
            )?,
            Column::new(
                ["Spacing", "SPACING"],
                threads,
                |thread| thread.spacing_mm.to_bits(),
                |first| length("SPACING", first, spacing(&threads[first], mm).0),
            )?,
            Column::new(
                ["Thickness", "THICKNESS"],
                threads,
                |thread| thread.radius_mm.to_bits().into(),
                |first| length("THICKNESS", first, thickness(&threads[first], mm).0),
            )?,
        ];
        Ok(Self { name, threads: threads.len(), unit, columns })
    }

    /// The names of the sections for single threads.
    pub(super) fn sections(&self) -> impl Iterator<Item = String> {
        let odd = self.columns.iter().filter(|column| !column.is_single());
        odd.map(|column| format!("{} {}", self.name, column.keys[1]))
    }

    /// Writes the values for the whole set.
    pub(super) fn common<W: Write>(&self, text: &mut Text<W>) -> Result<(), WriteError> {
        text.line(&format!("\n[{}]\nThreads={}\nUnits={}", self.name, self.threads, self.unit))?;
        for column in &self.columns {
            let value = column.common();
            if !value.is_empty() {
                text.line(&format!("{}={value}", column.keys[0]))?;
            }
        }
        Ok(())
    }

    /// Writes the values of single threads.
    pub(super) fn each<W: Write>(&self, text: &mut Text<W>) -> Result<(), WriteError> {
        for column in self.columns.iter().filter(|column| !column.is_single()) {
            text.line(&format!("\n[{} {}]", self.name, column.keys[1]))?;
            for (number, kind) in (1..).zip(&column.kinds.of) {
                let value = &column.values[*kind as usize];
                if value != column.common() {
                    text.line(&format!("{number}={value}"))?;
                }
            }
        }
        Ok(())
    }
}

/// The kinds of threads by their spacing and radius.
fn sizes(threads: &[Thread]) -> Kinds {
    let size = |thread: &Thread| (thread.spacing_mm.to_bits(), thread.radius_mm.to_bits());
    Kinds::new(threads.len(), |thread| size(&threads[thread]))
}

/// The unit that writes most sizes of threads to the bit, and among such units the one with the
/// fewest digits. Also the unit's length in mm.
fn unit(threads: &[Thread]) -> (&'static str, f64) {
    let firsts = sizes(threads).firsts;
    let cost = |(_, mm): &&(&str, f64)| {
        let sizes = firsts.iter().map(|first| &threads[*first]);
        let values = sizes.flat_map(|thread| [spacing(thread, *mm), thickness(thread, *mm)]);
        values.fold((0, 0), |(odd, digits), (value, exact)| {
            (odd + usize::from(!exact), digits + value.to_string().len())
        })
    };
    WIF_UNITS_MM.iter().min_by_key(cost).copied().unwrap_or(("Centimeters", 10.0))
}

/// The threads as a reader gets them from a file in a unit of `mm`.
fn held(threads: &[Thread], mm: f64) -> Vec<Thread> {
    let sizes = sizes(threads);
    let held = |first: &usize| {
        let thread = &threads[*first];
        (spacing_mm(spacing(thread, mm).0, mm), radius_mm(thickness(thread, mm).0, mm))
    };
    let held: Vec<_> = sizes.firsts.iter().map(held).collect();
    let resized = |(thread, kind): (&Thread, &u32)| {
        let (spacing_mm, radius_mm) = held[*kind as usize];
        Thread { spacing_mm, radius_mm, ..*thread }
    };
    threads.iter().zip(&sizes.of).map(resized).collect()
}

/// A thread's spacing in a unit of `mm`, and whether it is read again to the bit.
fn spacing(thread: &Thread, mm: f64) -> (f64, bool) {
    nearest(thread.spacing_mm / mm, |value| spacing_mm(value, mm) == thread.spacing_mm)
}

/// A thread's thickness in a unit of `mm`, and whether its radius is read again to the bit.
fn thickness(thread: &Thread, mm: f64) -> (f64, bool) {
    let diameter = 2.0 * f64::from(thread.radius_mm);
    nearest(diameter / mm, |value| radius_mm(value, mm) == thread.radius_mm)
}

/// The spacing, mm, that is read from a value in a unit of `mm`.
fn spacing_mm(value: f64, mm: f64) -> f64 {
    value * mm
}

/// The radius, mm, that is read from a thickness in a unit of `mm`.
fn radius_mm(value: f64, mm: f64) -> f32 {
    (value * mm / 2.0) as f32
}
