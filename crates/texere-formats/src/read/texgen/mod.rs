//! Reads yarns of TexGen, the University of Nottingham's geometric modeller of textiles (`.tg3`,
//! XML).
//!
//! Each `Yarn` of the file becomes one yarn: once, and whole. Repeats, which say how often TexGen
//! draws a yarn, are passed over. So is the domain, which says where TexGen cuts yarns off.

mod path;
mod section;
mod xml;
mod yarn;

use std::collections::HashMap;
use std::path::Path;

use texere_core::backend::room_for;
use texere_core::{ControlPoint, Layout, Material, Section, Yarn, Yarns};

use path::pieces;
use xml::{Element, Xml};
use yarn::{TexgenYarn, yarn};

use super::ReadError;
use super::curve_scale::CurveScale;
use super::spline::{Curve, Cut, Shape, cut_at, cuts, tension};

/// The lengths of the units that a file may name, mm.
const UNITS_MM: [(&str, f64); 6] =
    [("mm", 1.0), ("cm", 10.0), ("m", 1e3), ("km", 1e6), ("um", 1e-3), ("nm", 1e-6)];

/// The direction of a section's height if the file gives no up direction.
const UP: [f64; 3] = [0.0, 0.0, 1.0];

/// Reads the yarns of all textiles of a file.
pub(super) fn texgen(file: &Path, bytes: &[u8], scale: CurveScale) -> Result<Yarns, ReadError> {
    let mut xml = Xml::new(file, bytes)?;
    let missing = |field: &str| ReadError::MissingKey {
        file: file.into(),
        field: field.into(),
        needed_for: "yarns of TexGen stand in it",
    };
    let root = xml.child()?.ok_or_else(|| missing("the element TexGenModel"))?;
    if !root.is("TexGenModel") {
        return Err(xml.refused(&root, "TexGenModel, with which files of TexGen begin"));
    }
    let mut threads = Vec::new();
    while let Some(child) = xml.child()? {
        if child.is("Textile") {
            textile(&mut xml, &child, scale, &mut threads)?;
        } else {
            xml.skip(&child)?;
        }
    }
    if threads.is_empty() {
        return Err(missing("the element Textile"));
    }
    yarns(file, &threads)
}

/// Adds the yarns of the textile whose start tag has just been read.
fn textile<'a>(
    xml: &mut Xml<'a>,
    element: &Element<'a>,
    scale: CurveScale,
    threads: &mut Vec<Thread>,
) -> Result<(), ReadError> {
    let unit_mm = match (scale.unit_mm, xml.value(element, "GeometryScale")?) {
        (Some(unit_mm), _) => unit_mm.into(),
        (None, None) => 1.0,
        (None, Some(value)) => {
            let known = UNITS_MM.iter().find(|(unit, _)| *unit == value.text);
            known.map(|(_, mm)| *mm).ok_or_else(|| xml.unfit(value, "mm, cm, m, km, um or nm"))?
        }
    };
    let radius = scale.diameter_mm.map(|diameter| f64::from(diameter) / 2.0);
    let before = threads.len();
    while let Some(child) = xml.child()? {
        if child.is("Yarn") {
            let found = yarn(xml, &child, unit_mm, radius)?;
            room_for(threads, 1, "yarns")?;
            threads.push(Thread::of(found));
        } else {
            xml.skip(&child)?;
        }
    }
    if threads.len() == before {
        let expected =
            "a textile with yarns: TexGen leaves them out of minimal files, and writes them to standard ones";
        return Err(xml.refused(element, expected));
    }
    Ok(())
}

/// A yarn of the file, and its path.
struct Thread {
    yarn: TexgenYarn,
    curve: Curve,
    /// The places along the yarn at which each piece of the curve begins and ends: 0 is the first
    /// node, 1 the second.
    spans: Vec<[f64; 2]>,
}

impl Thread {
    fn of(yarn: TexgenYarn) -> Self {
        let nodes = &yarn.nodes;
        let is_closed = yarn.how.periodic
            && nodes.len() > 3
            && nodes.first().map(|node| node.position) == nodes.last().map(|node| node.position);
        // How far a spline may run beside the path is a share of the radius. The radius is taken
        // from the thinnest part of the yarn.
        let halves = yarn.outlines.iter().flat_map(|(_, outline)| outline.halves);
        let whole = pieces(nodes, yarn.how, halves.fold(f64::INFINITY, f64::min));
        let (mut parts, mut spans) = (Vec::new(), Vec::new());
        // A spline runs through the places of all sections. A section between two nodes cuts the
        // piece between them.
        let mut between = yarn.outlines.iter().map(|(at, _)| *at).filter(|at| at.fract() > 0.0).peekable();
        for (start, mut piece) in whole.into_iter().enumerate() {
            let (mut from, to) = (start as f64, start as f64 + 1.0);
            while let Some(at) = between.next_if(|at| *at < to) {
                if at > from {
                    let [first, second] = cut_at(&piece, (at - from) / (to - from));
                    parts.push(first);
                    spans.push([from, at]);
                    (piece, from) = (second, at);
                }
            }
            parts.push(piece);
            spans.push([from, to]);
        }
        let curve = Curve { shape: Shape::Pieces(parts), is_closed, has_radii_at_ends: true };
        Self { yarn, curve, spans }
    }

    /// The section of the yarn. The control points give its width and its height. If the yarn has
    /// sections of several shapes, all of them are read as ellipses.
    fn section(&self) -> Section {
        let outlines = &self.yarn.outlines;
        let first = &outlines[0].1;
        let is_one = outlines.iter().all(|(_, outline)| outline.is_alike(first));
        if is_one { first.section.clone() } else { Section::Circle }
    }

    /// Half the width and half the height of the yarn at a cut, mm, and where its height points.
    fn at(&self, cut: &Cut) -> ([f64; 2], [f64; 3]) {
        let [from, to] = self.spans[cut.piece];
        let place = from + cut.t * (to - from);
        let mixed = |a: f64, b: f64, t: f64| a + (b - a) * t;
        let outlines = &self.yarn.outlines;
        let next = outlines.partition_point(|(at, _)| *at < place);
        let halves = match (next.checked_sub(1).map(|before| &outlines[before]), outlines.get(next)) {
            (Some((start, a)), Some((end, b))) => {
                let t = (place - start) / (end - start);
                [mixed(a.halves[0], b.halves[0], t), mixed(a.halves[1], b.halves[1], t)]
            }
            (_, Some((_, outline))) | (Some((_, outline)), None) => outline.halves,
            (None, None) => [0.0; 2],
        };
        let nodes = &self.yarn.nodes;
        let node = (place as usize).min(nodes.len() - 2);
        let t = place - node as f64;
        let [a, b] = [nodes[node].up, nodes[node + 1].up];
        let up = std::array::from_fn(|axis| mixed(a[axis], b[axis], t));
        // Opposite directions leave none between them.
        (halves, if up == [0.0; 3] { a } else { up })
    }
}

/// The yarns of all threads.
fn yarns(file: &Path, threads: &[Thread]) -> Result<Yarns, ReadError> {
    let tension = tension(threads.iter().map(|thread| &thread.curve));
    let mut sections = Sections::default();
    let (mut yarns, mut offsets, mut points, mut ups) = (Vec::new(), vec![0], Vec::new(), Vec::new());
    room_for(&mut yarns, threads.len(), "yarns")?;
    room_for(&mut offsets, threads.len(), "yarns")?;
    for thread in threads {
        let Shape::Pieces(pieces) = &thread.curve.shape else { continue };
        let closed = thread.curve.is_closed;
        let cuts = cuts(pieces, closed, tension.is_some())?;
        let (section, scale) = sections.number(thread.section());
        room_for(&mut points, cuts.len(), "control points")?;
        room_for(&mut ups, cuts.len(), "up directions")?;
        for cut in &cuts {
            let [x, y, z, _] = cut.place.map(|value| value as f32);
            let (halves, up) = thread.at(cut);
            let [width, height] = [0, 1].map(|side| (halves[side] / scale[side]) as f32);
            points.push(ControlPoint::new(x, y, z, width).flattened(width, height));
            ups.push(up);
        }
        yarns.push(Yarn { closed, section, ..Yarn::default() });
        offsets.push(points.len() as u64);
    }
    let unsound = |source| ReadError::Yarns { file: file.into(), source };
    let layout = Layout::new(yarns, offsets, sections.all).map_err(unsound)?;
    let yarns = Yarns::new(layout, vec![Material::default()], points).map_err(unsound)?;
    let yarns = yarns.with_tension(tension.unwrap_or(0.0)).map_err(unsound)?;
    if ups.iter().all(|up| *up == UP) {
        return Ok(yarns);
    }
    yarns.with_ups(ups.iter().map(|up| up.map(|axis| axis as f32)).collect()).map_err(unsound)
}

/// The sections that yarns share.
#[derive(Debug, Default)]
struct Sections {
    all: Vec<Section>,
    /// For each section, written as text: its number, and half its width and half its height.
    numbers: HashMap<String, (u32, [f64; 2])>,
}

impl Sections {
    /// The number of a section, and half its width and half its height in radii of the yarn.
    fn number(&mut self, section: Section) -> (u32, [f64; 2]) {
        let next = self.all.len() as u32;
        *self.numbers.entry(format!("{section:?}")).or_insert_with(|| {
            // Polygons are read in halves of their widths and heights.
            let halves = match section {
                Section::Polygon(_) => [1.0; 2],
                _ => [section.half_width().into(), section.half_height().into()],
            };
            self.all.push(section);
            (next, halves)
        })
    }
}
