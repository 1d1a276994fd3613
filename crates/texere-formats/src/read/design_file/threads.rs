//! Makes the threads of a cloth from the yarns and thread sets of a design file.

use std::collections::BTreeMap;

use texere_core::backend::room;
use texere_core::{Material, Section, SectionPoint};
use texere_fabric::{Fibre, PACKING, PACKING_LIMITS, Thread};
use toml::Spanned;

use super::any::Any;
use super::limits::{BENDING, HAIRINESS, LENGTH_MM, TEX, TWIST_PER_M, hairiness_of};
use super::schema::{ThreadSet, YarnSpec};
use super::source::Source;
use crate::read::ReadError;
use crate::read::error::{first_few, shown};

/// The coarsest and the finest yarn by the English cotton count, hanks of 840 yards to the pound.
const COTTON_COUNT: [f64; 2] = [0.01, 10_000.0];

/// The least and the greatest density of a yarn, the air in it included, g/cm³.
const DENSITY: [f64; 2] = [0.05, 20.0];

/// The smallest and the largest value of `least_area`: the area that a yarn's section keeps at rest
/// at least, as a share of the area of the round yarn.
const LEAST_AREA: [f64; 2] = [0.0, 1.0];

/// The deepest and the shallowest valley between two plies.
const VALLEY: [f64; 2] = [0.5, 1.0];

/// The least and the greatest stiffness of a yarn, as a multiple of that of a cotton yarn of its
/// diameter.
const STIFFNESS: [f64; 2] = [0.01, 100.0];

/// The least and the greatest firmness of a yarn's section, as a multiple of that of cotton.
const FIRMNESS: [f64; 2] = [0.01, 100.0];

/// The least and the greatest flatness, width over height: that of yarn that stands on edge, and
/// that of a ribbon. The limits are `f64`, because 0.1 as an `f32` is a little more than 0.1, and
/// such a limit would refuse a flatness of 0.1.
const FLATNESS: [f64; 2] = [0.1, 10.0];

/// The most yarns in the list `knit.yarns`, where `"3 red"` counts as three.
const TURN_MAX: usize = 100_000;

/// A yarn with its name.
pub(super) type Named = (String, Thread);

/// The named yarns, ready to be threaded: yarn k has material k and section k.
#[derive(Debug)]
pub(super) struct YarnTable {
    names: BTreeMap<String, Thread>,
    pub(super) materials: Vec<Material>,
    pub(super) sections: Vec<Section>,
}

impl YarnTable {
    pub(super) fn new(
        source: &Source<'_>,
        specs: &BTreeMap<Spanned<String>, YarnSpec>,
    ) -> Result<Self, ReadError> {
        let mut table = Self { names: BTreeMap::new(), materials: Vec::new(), sections: Vec::new() };
        for (number, (name, spec)) in (0..).zip(specs) {
            let name = name.as_ref();
            let (material, thread) = yarn(source, name, spec, number)?;
            table.materials.push(material);
            table.sections.push(section(source, name, spec)?);
            table.names.insert(name.clone(), thread);
        }
        Ok(table)
    }

    /// `count` threads of a set: the yarns of `spec`, repeated.
    pub(super) fn threads(
        &self,
        source: &Source<'_>,
        set: &str,
        spec: &ThreadSet,
        count: usize,
    ) -> Result<Vec<Thread>, ReadError> {
        let [low, high] = LENGTH_MM;
        let spacing = |key: &str, per: &Spanned<f64>, mm: f64| {
            let per = source.number(&format!("{set}.{key}"), per, [mm / high, mm / low])?;
            Ok::<_, ReadError>(vec![mm / per])
        };
        let spacings_mm = match (&spec.per_cm, &spec.per_inch, &spec.spacing_mm) {
            (Some(per_cm), None, None) => spacing("per_cm", per_cm, 10.0)?,
            (None, Some(per_inch), None) => spacing("per_inch", per_inch, 25.4)?,
            (None, None, Some(spacing)) => spacings(source, &format!("{set}.spacing_mm"), spacing)?,
            _ => {
                let keys = if set == "warp" {
                    "warp.per_cm, warp.per_inch and warp.spacing_mm"
                } else {
                    "weft.per_cm, weft.per_inch and weft.spacing_mm"
                };
                return Err(ReadError::ExactlyOne { file: source.path.into(), keys });
            }
        };
        let mut repeat = Vec::new();
        for item in spec.yarns.as_ref() {
            let (times, _, thread) = self.item(source, &format!("{set}.yarns"), item)?;
            // The part of a repeat that is beyond the cloth is left out.
            let times = count.saturating_sub(repeat.len()).min(times as usize);
            repeat.extend(std::iter::repeat_n(thread, times));
        }
        if repeat.is_empty() {
            let (place, value) = (source.place(&format!("{set}.yarns"), spec.yarns.span()), "[]".into());
            return Err(ReadError::BadValue { place, value, expected: "at least one yarn".into() });
        }
        let mut threads = room("threads", count)?;
        let each = repeat.into_iter().cycle().zip(spacings_mm.into_iter().cycle());
        threads.extend(each.map(|(thread, spacing_mm)| Thread { spacing_mm, ..thread }).take(count));
        Ok(threads)
    }

    /// The yarn called `name`.
    pub(super) fn thread(&self, name: &str) -> Option<Thread> {
        self.names.get(name).copied()
    }

    /// The names of all yarns, sorted.
    pub(super) fn names(&self) -> impl ExactSizeIterator<Item = &String> {
        self.names.keys()
    }

    /// The only yarn of the table, with its name. None if the table has no yarn or several.
    pub(super) fn only(&self) -> Option<Named> {
        let (name, thread) = self.names.first_key_value().filter(|_| self.names.len() == 1)?;
        Some((name.clone(), *thread))
    }

    /// The yarns of a list one after another, as numbers, and the named yarns that the numbers
    /// stand for.
    pub(super) fn in_turn(
        &self,
        source: &Source<'_>,
        field: &str,
        list: &Spanned<Vec<Spanned<String>>>,
    ) -> Result<(Vec<u32>, Vec<Named>), ReadError> {
        let (mut turn, mut yarns) = (Vec::new(), Vec::<Named>::new());
        for item in list.as_ref() {
            let (times, name, thread) = self.item(source, field, item)?;
            let known = yarns.iter().position(|(other, _)| other == name);
            let number = known.unwrap_or(yarns.len());
            if known.is_none() {
                yarns.push((name.into(), thread));
            }
            if turn.len() + times as usize > TURN_MAX {
                return Err(source.bad(field, item, &format!("{TURN_MAX} yarns in turn at most")));
            }
            turn.extend(std::iter::repeat_n(number as u32, times as usize));
        }
        if turn.is_empty() {
            return Err(source.unfit(field, list.span(), "at least one yarn"));
        }
        Ok((turn, yarns))
    }

    /// One item of a repeat: `"indigo"`, or `"3 indigo"` for three in a row.
    pub(super) fn item(
        &self,
        source: &Source<'_>,
        field: &str,
        item: &Spanned<String>,
    ) -> Result<(u32, &str, Thread), ReadError> {
        let text = item.as_ref().trim();
        if let Some((name, thread)) = self.names.get_key_value(text) {
            return Ok((1, name, *thread));
        }
        let (times, name) = text.split_once(char::is_whitespace).unwrap_or(("1", text));
        let Some((name, thread)) = self.names.get_key_value(name.trim()) else {
            let known = first_few(self.names.keys().map(|name| format!("\"{name}\"")));
            let expected = format!("a yarn of [yarns], with a number before it or none; there are: {known}");
            return Err(source.bad(field, item, &expected));
        };
        match times.parse() {
            Ok(times @ 1..=1_000_000) => Ok((times, name, *thread)),
            _ => Err(source.bad(field, item, "a number from 1 to 1000000 before the yarn's name")),
        }
    }
}

/// The material of yarn `number`, and a thread of it.
fn yarn(
    source: &Source<'_>,
    name: &str,
    spec: &YarnSpec,
    number: u32,
) -> Result<(Material, Thread), ReadError> {
    let field = |key: &str| format!("yarns.{name}.{key}");
    let number_of = |key: &str, value, range| source.optional(&field(key), value, range);
    let fibre = fibre(source, name, spec)?;
    let (diameter_mm, tex) = thickness(source, name, spec, fibre)?;
    let flatness = number_of("flatness", &spec.flatness, FLATNESS)?.unwrap_or(1.0);
    let stiffness = number_of("stiffness", &spec.stiffness, STIFFNESS)?.unwrap_or(1.0);
    let twist_per_m = number_of("twist_per_m", &spec.twist_per_m, [-TWIST_PER_M, TWIST_PER_M])?;
    let twist = texere_fabric::twist_from_turns_per_m(twist_per_m.unwrap_or(0.0));
    let radius_mm = (diameter_mm / 2.0) as f32;
    let firmness = match (number_of("firmness", &spec.firmness, FIRMNESS)?, twist_per_m) {
        (Some(firmness), _) => firmness as f32,
        (None, Some(_)) => texere_fabric::firmness_from_twist(twist, radius_mm),
        (None, None) => 1.0,
    };
    let hairiness = number_of("hairiness", &spec.hairiness, HAIRINESS)?;
    let srgb = match &spec.color {
        Some(color) => source.rgb(&field("color"), color)?,
        None => Material::default().srgb,
    };
    let least_area = match number_of("least_area", &spec.least_area, LEAST_AREA)? {
        Some(least_area) => least_area as f32,
        None => {
            let given = number_of("density", &spec.density, DENSITY)?;
            let diameter_mm = spec.diameter_mm.as_ref().map(|_| diameter_mm);
            let density = fibre.spun_density(given, tex, diameter_mm);
            let packing = number_of("packing", &spec.packing, PACKING_LIMITS)?.unwrap_or(PACKING);
            fibre.least_area(density, packing)
        }
    };
    let bending = number_of("bending_stiffness", &spec.bending_stiffness, BENDING)?;
    let bending = bending.or(fibre.bending_of(tex));
    let material = Material {
        name: name.into(),
        srgb,
        tex: tex.map(|tex| tex as f32),
        hairiness: hairiness.map_or_else(|| hairiness_of(twist), |hairiness| hairiness as f32),
        bending: bending.map(|bending| bending as f32),
    };
    let thread = Thread {
        spacing_mm: 0.0,
        radius_mm,
        flatness: flatness as f32,
        stiffness: stiffness as f32,
        firmness,
        least_area,
        material: number,
        section: number,
        twist,
    };
    Ok((material, thread))
}

/// The fibre of a yarn, cotton if the design does not say.
fn fibre(source: &Source<'_>, name: &str, spec: &YarnSpec) -> Result<Fibre, ReadError> {
    let Some(fibre) = &spec.fibre else { return Ok(Fibre::default()) };
    Fibre::named(fibre.as_ref()).ok_or_else(|| {
        let names = Fibre::ALL.map(|fibre| format!("\"{}\"", fibre.name()));
        let expected = format!("one of {}", names.join(", "));
        source.bad(&format!("yarns.{name}.fibre"), fibre, &expected)
    })
}

/// The diameter of a yarn, mm, as given or worked out from its tex or cotton count. Also its tex,
/// if tex or cotton count is given.
fn thickness(
    source: &Source<'_>,
    name: &str,
    spec: &YarnSpec,
    fibre: Fibre,
) -> Result<(f64, Option<f64>), ReadError> {
    let field = |key: &str| format!("yarns.{name}.{key}");
    let number_of = |key: &str, value, range| source.optional(&field(key), value, range);
    if let (Some(_), Some(count)) = (&spec.tex, &spec.cotton_count) {
        return Err(source.bad(&field("cotton_count"), count, "it or tex, not both"));
    }
    let count = number_of("cotton_count", &spec.cotton_count, COTTON_COUNT)?;
    let tex = number_of("tex", &spec.tex, TEX)?.or(count.map(texere_fabric::tex_from_cotton_count));
    let density = number_of("density", &spec.density, DENSITY)?.unwrap_or_else(|| fibre.yarn_density());
    match (number_of("diameter_mm", &spec.diameter_mm, LENGTH_MM)?, tex) {
        (Some(diameter_mm), _) => Ok((diameter_mm, tex)),
        (None, Some(count)) => Ok((texere_fabric::diameter_mm(count, density), tex)),
        (None, None) => Err(ReadError::MissingKey {
            file: source.path.into(),
            field: shown(&field("diameter_mm")),
            needed_for: "a yarn needs a diameter, or tex or cotton_count to work it out from",
        }),
    }
}

/// One spacing for all threads, or a list of spacings, mm.
fn spacings(source: &Source<'_>, field: &str, value: &Spanned<Any>) -> Result<Vec<f64>, ReadError> {
    let expected = "a number of mm, or a list of them such as [2.0, 1.0]";
    let [low, high] = LENGTH_MM;
    let Some(list) = value.as_ref().list() else {
        return Ok(vec![source.number(field, &source.float(field, value, expected)?, [low, high])?]);
    };
    if list.is_empty() {
        return Err(source.odd(field, value, expected));
    }
    let each = list.iter().zip(1..).map(|(item, place)| {
        let number = item.number().ok_or_else(|| source.odd(field, value, expected))?;
        source.number(&format!("{field}, number {place},"), &Spanned::new(value.span(), number), [low, high])
    });
    each.collect()
}

fn section(source: &Source<'_>, name: &str, spec: &YarnSpec) -> Result<Section, ReadError> {
    let plies = spec
        .plies
        .as_ref()
        .map(|plies| source.integer(&format!("yarns.{name}.plies"), plies, 1, 12))
        .transpose()?;
    let field = format!("yarns.{name}.valley");
    let valley = source.optional(&field, &spec.valley, VALLEY)?;
    if let Some(valley) = &spec.valley
        && plies.is_none_or(|plies| plies < 2)
    {
        let place = source.place(&field, valley.span());
        return Err(ReadError::Without { place, needs: "plies of 2 or more" });
    }
    let Some(shape) = &spec.section else {
        return Ok(match (plies.filter(|plies| *plies > 1), valley) {
            (Some(plies), Some(valley)) => Section::Lobed { plies, valley: valley as f32 },
            (Some(plies), None) => Section::plied(plies),
            (None, _) => Section::Circle,
        });
    };
    if plies.is_some() {
        let keys = "section and plies in a table of [yarns]";
        return Err(ReadError::ExactlyOne { file: source.path.into(), keys });
    }
    let place = || source.place(&format!("yarns.{name}.section"), shape.span());
    shape.as_ref().validate().map_err(|error| ReadError::Section { place: place(), source: error })?;
    // The corners of a polygon are the only points of an outline that a design gives itself. A
    // corner without a normal can't be part of a surface.
    let faces = |corner: &SectionPoint| corner.normal_x.is_finite() && corner.normal_y.is_finite();
    if let Section::Polygon(corners) = shape.as_ref()
        && let Some(corner) =
            shape.as_ref().outline(corners.len() as u32).iter().position(|corner| !faces(corner))
    {
        return Err(ReadError::Corner { place: place(), corner: corner + 1 });
    }
    Ok(shape.as_ref().clone())
}
