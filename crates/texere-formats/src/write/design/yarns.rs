//! The yarns of a design file by name: one for each kind of thread, or for each yarn of a knit.

use std::collections::{HashMap, HashSet};

use texere_core::{Material, Section, SectionPoint};
use texere_fabric::weft::KnitYarn;
use texere_fabric::{
    COTTON_DENSITY, Fibre, PACKING, Thread, Woven, diameter_mm, firmness_from_twist, turns_per_m,
    twist_from_turns_per_m,
};

use super::super::WriteError;
use super::format::DESIGN_FILE as FORMAT;
use super::interlacing::{Kinds, period};
use super::text::{nearest, shortest, within};
use super::toml_text::quoted;
use crate::read::limits;

/// The yarns of a cloth.
pub(super) struct Yarns {
    names: Vec<String>,
    /// The names as a set.
    taken: HashSet<String>,
    /// The yarn of each end, then of each pick.
    kinds: Kinds,
    ends: usize,
    /// The table of each yarn.
    tables: Vec<String>,
    /// The first name that was changed, and its new form.
    pub(super) renamed: Option<[String; 2]>,
}

impl Yarns {
    /// The yarns of woven cloth: one for each kind of thread.
    pub(super) fn of_cloth(cloth: &Woven) -> Result<Self, WriteError> {
        let (warp, weft) = (cloth.warp(), cloth.weft());
        let thread = |number: usize| {
            warp.get(number).or_else(|| weft.get(number - warp.len())).copied().unwrap_or(warp[0])
        };
        let key = |number: usize| {
            let Thread {
                spacing_mm: _,
                radius_mm,
                flatness,
                stiffness,
                firmness,
                least_area,
                material,
                section,
                twist,
            } = thread(number);
            (
                [radius_mm, flatness, stiffness, firmness, least_area, twist].map(f32::to_bits),
                material,
                section,
            )
        };
        let kinds = Kinds::new(warp.len() + weft.len(), key);
        Self::new(kinds, warp.len(), thread, cloth.materials(), cloth.sections(), |_| true)
    }

    /// The yarns of a knit, each with a name of its own. `is_yarn` says whether a text may be the
    /// name of a yarn.
    pub(super) fn of_knit(
        yarns: &[KnitYarn],
        materials: &[Material],
        sections: &[Section],
        is_yarn: fn(&str) -> bool,
    ) -> Result<Self, WriteError> {
        let thread = |number: usize| {
            let KnitYarn { radius_mm, material, section, twist } = yarns[number];
            Thread { material, section, twist, ..Thread::new(0.0, radius_mm) }
        };
        let kinds = Kinds::new(yarns.len(), |number| number);
        Self::new(kinds, 0, thread, materials, sections, is_yarn)
    }

    fn new(
        kinds: Kinds,
        ends: usize,
        thread: impl Fn(usize) -> Thread,
        materials: &[Material],
        sections: &[Section],
        is_yarn: fn(&str) -> bool,
    ) -> Result<Self, WriteError> {
        let (mut names, mut tables, mut renamed) = (Vec::new(), Vec::new(), None);
        let mut given = Names { is_yarn, taken: HashSet::new(), last: HashMap::new() };
        for first in &kinds.firsts {
            let thread = thread(*first);
            let material = &materials[thread.material as usize];
            let name = given.give(&material.name);
            if name != material.name {
                renamed.get_or_insert_with(|| [material.name.clone(), name.clone()]);
            }
            tables.push(table(&name, &thread, material, &sections[thread.section as usize])?);
            names.push(name);
        }
        Ok(Self { names, kinds, ends, tables, renamed, taken: given.taken })
    }

    /// The name of each yarn.
    pub(super) fn names(&self) -> &[String] {
        &self.names
    }

    /// The tables, each with its heading.
    pub(super) fn tables(&self) -> impl Iterator<Item = String> {
        self.names
            .iter()
            .zip(&self.tables)
            .map(|(name, table)| format!("\n[yarns.{}]\n{table}", quoted(name)))
    }

    /// The keys of the warp or the weft: yarns in turn, and spacings.
    ///
    /// **Errors**: [`WriteError::OutOfRange`] for a spacing that no design file may have.
    pub(super) fn set(&self, name: &str, threads: &[Thread]) -> Result<String, WriteError> {
        let (ends, picks) = self.kinds.of.split_at(self.ends);
        let kinds = if name == "warp" { ends } else { picks };
        let items = self.items_of(&kinds[..period(kinds)]);
        for (number, thread) in (1..).zip(threads) {
            let field = || format!("{name}.spacing_mm, number {number},");
            within(FORMAT, field, thread.spacing_mm, limits::LENGTH_MM)?;
        }
        let spacings: Vec<_> = threads.iter().map(|thread| thread.spacing_mm).collect();
        let spacing = match &spacings[..period(&spacings)] {
            [all] => one_spacing(*all),
            list => format!("spacing_mm = {list:?}"),
        };
        Ok(format!("\n[{name}]\nyarns = [{}]\n{spacing}\n", items.join(", ")))
    }

    /// The items of a list of yarns in turn.
    pub(super) fn items_of(&self, yarns: &[u32]) -> Vec<String> {
        yarns.chunk_by(|one, other| one == other).flat_map(|run| self.items(run[0], run.len())).collect()
    }

    /// The items for `times` threads of one yarn: one item with a number, or an item for each
    /// thread if the item with a number is another yarn's name.
    pub(super) fn items(&self, yarn: u32, times: usize) -> Vec<String> {
        let name = &self.names[yarn as usize];
        let counted = format!("{times} {name}");
        if times == 1 || self.taken.contains(&counted) {
            vec![quoted(name); times]
        } else {
            vec![quoted(&counted)]
        }
    }
}

/// The names that have been given, each once.
struct Names {
    /// Whether a text may be the name of a yarn.
    is_yarn: fn(&str) -> bool,
    taken: HashSet<String>,
    /// The last number that was tried behind each name.
    last: HashMap<String, usize>,
}

impl Names {
    /// Returns `name` without space around it, or `yarn` for an empty name. A number follows if
    /// another yarn has that name, or if no yarn may have it.
    fn give(&mut self, name: &str) -> String {
        let name = if name.trim().is_empty() { "yarn" } else { name.trim() };
        let mut own = name.to_owned();
        let last = self.last.entry(own.clone()).or_insert(1);
        while !(self.is_yarn)(&own) || !self.taken.insert(own.clone()) {
            *last += 1;
            own = format!("{name} ({last})");
        }
        own
    }
}

/// The key for one spacing of all threads: `spacing_mm`, or the number of threads to the cm or to
/// the inch if only that number has few digits.
fn one_spacing(spacing_mm: f64) -> String {
    const FEW: usize = 6;
    let keys = [("per_cm", 10.0), ("per_inch", 25.4)];
    let direct = shortest(spacing_mm, FEW, |read| read == spacing_mm);
    let sett = || {
        keys.into_iter().find_map(|(key, mm)| {
            let per = shortest(mm / spacing_mm, FEW, |read| mm / read == spacing_mm)?;
            Some(format!("{key} = {per:?}"))
        })
    };
    match direct {
        Some(spacing) => format!("spacing_mm = {spacing:?}"),
        None => sett().unwrap_or_else(|| format!("spacing_mm = {spacing_mm:?}")),
    }
}

/// The keys of a yarn.
fn table(name: &str, thread: &Thread, material: &Material, section: &Section) -> Result<String, WriteError> {
    let field = |key: &str| format!("yarns.{name}.{key}");
    let mut keys = Vec::new();
    let tex = match material.tex {
        Some(tex) => {
            let value = within(FORMAT, || field("tex"), tex.into(), limits::TEX)?;
            Some(nearest(value, |read| read as f32 == tex).0)
        }
        None => None,
    };
    keys.extend(tex.map(|tex| format!("tex = {tex:?}")));
    let reads = |diameter: f64| (diameter / 2.0) as f32 == thread.radius_mm;
    let known = tex.is_some_and(|tex| reads(diameter_mm(tex, COTTON_DENSITY)));
    let diameter = (!known).then(|| nearest(2.0 * f64::from(thread.radius_mm), reads).0);
    if let Some(diameter) = diameter {
        within(FORMAT, || field("diameter_mm"), diameter, limits::LENGTH_MM)?;
        keys.push(format!("diameter_mm = {diameter:?}"));
    }
    let [red, green, blue] = material.srgb;
    keys.push(format!("color = \"#{red:02x}{green:02x}{blue:02x}\""));
    keys.extend(section_keys(name, section)?);
    let firmness =
        if thread.twist == 0.0 { 1.0 } else { firmness_from_twist(thread.twist, thread.radius_mm) };
    for (key, value, unsaid) in [
        ("flatness", thread.flatness, 1.0),
        ("stiffness", thread.stiffness, 1.0),
        ("firmness", thread.firmness, firmness),
    ] {
        if value != unsaid {
            keys.push(format!("{key} = {:?}", nearest(value.into(), |read| read as f32 == value).0));
        }
    }
    let least_area = thread.least_area;
    let density = Fibre::Cotton.spun_density(None, tex, diameter);
    if least_area != Fibre::Cotton.least_area(density, PACKING) {
        keys.push(format!(
            "least_area = {:?}",
            nearest(least_area.into(), |read| read as f32 == least_area).0
        ));
    }
    if thread.twist != 0.0 {
        let reads = |per_m| twist_from_turns_per_m(per_m) == thread.twist;
        let per_m = nearest(turns_per_m(thread.twist), reads).0;
        let most = limits::TWIST_PER_M;
        within(FORMAT, || field("twist_per_m"), per_m, [-most, most])?;
        keys.push(format!("twist_per_m = {per_m:?}"));
    }
    if material.hairiness != limits::hairiness_of(thread.twist) {
        let value = within(FORMAT, || field("hairiness"), material.hairiness.into(), limits::HAIRINESS)?;
        keys.push(format!("hairiness = {:?}", nearest(value, |read| read as f32 == material.hairiness).0));
    }
    if let Some(bending) = material.bending {
        let value = nearest(bending.into(), |read| read as f32 == bending).0;
        within(FORMAT, || field("bending_stiffness"), value, limits::BENDING)?;
        keys.push(format!("bending_stiffness = {value:?}"));
    }
    Ok(keys.join("\n") + "\n")
}

/// The section of a yarn, unless it is a circle.
fn section_keys(name: &str, section: &Section) -> Result<Option<String>, WriteError> {
    let number = |value: f32| format!("{:?}", nearest(value.into(), |read| read as f32 == value).0);
    let shape = match section {
        Section::Circle => return Ok(None),
        Section::Lobed { plies, valley } => {
            let valley = match *section == Section::plied(*plies) {
                true => String::new(),
                false => format!("\nvalley = {}", number(*valley)),
            };
            return Ok(Some(format!("plies = {plies}{valley}")));
        }
        Section::Ellipse { aspect } => format!("\"ellipse\", aspect = {}", number(*aspect)),
        Section::Lenticular { aspect, distortion } => {
            format!("\"lenticular\", aspect = {}, distortion = {}", number(*aspect), number(*distortion))
        }
        Section::PowerEllipse { aspect, exponent } => {
            format!("\"power-ellipse\", aspect = {}, exponent = {}", number(*aspect), number(*exponent))
        }
        Section::Polygon(corners) if faces(section, corners.len()) => {
            let corners: Vec<_> =
                corners.iter().map(|[x, y]| format!("[{}, {}]", number(*x), number(*y))).collect();
            format!("\"polygon\", corners = [{}]", corners.join(", "))
        }
        _ => {
            let what = format!("yarns.{name}.section, {section:?}");
            return Err(WriteError::Unheld { format: FORMAT, what });
        }
    };
    Ok(Some(format!("section = {{ shape = {shape} }}")))
}

/// Whether all corners of a polygon have a normal, as readers require.
fn faces(section: &Section, corners: usize) -> bool {
    let sound = |corner: &SectionPoint| corner.normal_x.is_finite() && corner.normal_y.is_finite();
    u32::try_from(corners).is_ok_and(|corners| section.outline(corners).iter().all(sound))
}
