//! Cross-sections of TexGen.
//!
//! **Source**: Sherburn, "Geometric and mechanical modelling of textiles", PhD thesis, Nottingham,
//! 2007.

use texere_core::Section;
use texere_core::definitions::SIDES_MAX;

use super::xml::{Element, Xml};
use crate::read::ReadError;

/// The outline of a yarn at one place, mm.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Outline {
    pub(super) section: Section,
    /// Half the width and half the height.
    pub(super) halves: [f64; 2],
}

impl Outline {
    /// An ellipse is a circle that is flattened.
    pub(super) const fn ellipse(halves: [f64; 2]) -> Self {
        Self { section: Section::Circle, halves }
    }

    /// Whether two outlines have one shape, up to their widths and heights.
    pub(super) fn is_alike(&self, other: &Self) -> bool {
        match (&self.section, &other.section) {
            // The arcs of a lens depend on its width over its height, but hardly.
            (Section::Lenticular { distortion: own, .. }, Section::Lenticular { distortion, .. }) => {
                own == distortion
            }
            (own, other) => own == other,
        }
    }
}

/// Reads the section whose start tag has just been read, to its end. `unit` is the length of the
/// file's unit, mm.
pub(super) fn outline<'a>(xml: &mut Xml<'a>, element: &Element<'a>, unit: f64) -> Result<Outline, ReadError> {
    let kind = xml.given(element, "type")?;
    let size = |xml: &Xml<'a>| -> Result<[f64; 2], ReadError> {
        let [[width], [height]] = [xml.all(element, "Width")?, xml.all(element, "Height")?];
        Ok([width * unit / 2.0, height * unit / 2.0])
    };
    let of = |section, halves| Outline { section, halves };
    let found = match kind.text {
        "CSectionEllipse" => Outline::ellipse(size(xml)?),
        "CSectionLenticular" => {
            let halves = size(xml)?;
            let [distortion] = xml.numbers(element, "Distortion")?.unwrap_or_default();
            let aspect = (halves[0] / halves[1]) as f32;
            // TexGen gives the height of the edges above the middle.
            of(Section::Lenticular { aspect, distortion: (distortion * unit / halves[1]) as f32 }, halves)
        }
        "CSectionPowerEllipse" => {
            let [exponent] = xml.all(element, "Power")?;
            if xml.numbers::<1>(element, "XOffset")?.is_some_and(|[offset]| offset != 0.0) {
                return Err(xml.refused(element, "a section with an XOffset of 0"));
            }
            of(Section::PowerEllipse { aspect: 1.0, exponent: exponent as f32 }, size(xml)?)
        }
        "CSectionRectangle" => {
            of(Section::Polygon(vec![[1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]]), size(xml)?)
        }
        "CSectionPolygon" => polygon(xml, element, unit)?,
        _ => {
            let expected = "CSectionEllipse, CSectionLenticular, CSectionPowerEllipse, CSectionRectangle or \
                            CSectionPolygon";
            return Err(xml.unfit(kind, expected));
        }
    };
    if !matches!(found.section, Section::Polygon(_)) || kind.text == "CSectionRectangle" {
        xml.skip(element)?;
    }
    found.section.validate().map_err(|source| xml.no_section(element, source))?;
    Ok(found)
}

/// The corners of a polygon. TexGen's x points to the other side of the yarn than texere's.
fn polygon<'a>(xml: &mut Xml<'a>, element: &Element<'a>, unit: f64) -> Result<Outline, ReadError> {
    let mut corners: Vec<[f64; 2]> = Vec::new();
    while let Some(child) = xml.child()? {
        if child.is("PolygonPoint") {
            if corners.len() == SIDES_MAX as usize {
                return Err(xml.refused(&child, &format!("a polygon of {} corners at most", corners.len())));
            }
            let [x, y] = xml.all(&child, "value")?;
            corners.push([-x * unit, y * unit]);
        }
        xml.skip(&child)?;
    }
    corners.reverse();
    if corners.len() > 1 && corners.first() == corners.last() {
        corners.pop();
    }
    let side = |axis: usize| {
        let all = corners.iter().map(|corner| corner[axis]);
        all.clone().fold(f64::NEG_INFINITY, f64::max) - all.fold(f64::INFINITY, f64::min)
    };
    let halves = [side(0) / 2.0, side(1) / 2.0];
    if !(halves[0] > 0.0 && halves[1] > 0.0) {
        return Err(xml.refused(element, "a polygon with a width and a height"));
    }
    let corners = corners.iter().map(|[x, y]| [(x / halves[0]) as f32, (y / halves[1]) as f32]);
    Ok(Outline { section: Section::Polygon(corners.collect()), halves })
}
