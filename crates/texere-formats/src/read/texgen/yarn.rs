//! A yarn of TexGen, as the file has it.

use super::path::{Form, Interpolation, Node, unit};
use super::section::{Outline, outline};
use super::xml::{Element, Xml};
use crate::read::ReadError;

/// A yarn of a textile, mm.
#[derive(Debug)]
pub(super) struct TexgenYarn {
    /// Two or more.
    pub(super) nodes: Vec<Node>,
    pub(super) how: Interpolation,
    /// Outlines along the yarn, by their places: 0 is the first node, 1 the second. There is at
    /// least one.
    pub(super) outlines: Vec<(f64, Outline)>,
}

/// Reads the yarn whose start tag has just been read, to its end. `unit_mm` is the length of the
/// file's unit. With a `radius` the yarn is round, whatever its sections are.
pub(super) fn yarn<'a>(
    xml: &mut Xml<'a>,
    element: &Element<'a>,
    unit_mm: f64,
    radius: Option<f64>,
) -> Result<TexgenYarn, ReadError> {
    let (mut nodes, mut outlines) = (Vec::new(), Vec::new());
    let mut how = Interpolation { form: Form::Bezier, periodic: true, in_plane: false };
    let mut constant = true;
    while let Some(child) = xml.child()? {
        if child.is("MasterNode") {
            nodes.push(node(xml, &child, unit_mm)?);
            xml.skip(&child)?;
        } else if child.is("Interpolation") {
            how = interpolation(xml, &child)?;
            xml.skip(&child)?;
        } else if child.is("YarnSection") && radius.is_none() {
            (constant, outlines) = sections(xml, &child, unit_mm)?;
        } else {
            xml.skip(&child)?;
        }
    }
    if nodes.len() < 2 {
        return Err(xml.refused(element, "a yarn of two master nodes or more"));
    }
    outlines.extend(radius.map(|radius| (0.0, Outline::ellipse([radius; 2]))));
    if outlines.is_empty() {
        return Err(xml.refused(element, "a yarn with a section"));
    }
    let of_nodes = outlines.iter().filter(|(at, _)| at.fract() == 0.0).count();
    if !constant && of_nodes != nodes.len() {
        let expected =
            format!("a yarn of as many sections as master nodes; it has {of_nodes} and {}", nodes.len());
        return Err(xml.refused(element, &expected));
    }
    Ok(TexgenYarn { nodes, how, outlines })
}

fn node<'a>(xml: &Xml<'a>, element: &Element<'a>, unit_mm: f64) -> Result<Node, ReadError> {
    let position: [f64; 3] = xml.all(element, "Position")?;
    let tangent = xml.numbers(element, "Tangent")?.unwrap_or_default();
    let up = unit(xml.numbers(element, "Up")?.unwrap_or_default());
    if xml.numbers(element, "Angle")?.is_some_and(|[angle]| angle != 0.0) {
        return Err(xml.refused(
            element,
            "a node with the Angle 0: sections that are turned out of the yarn's own are not read",
        ));
    }
    let up = if up == [0.0; 3] { [0.0, 0.0, 1.0] } else { up };
    Ok(Node { position: position.map(|axis| axis * unit_mm), tangent, up })
}

fn interpolation<'a>(xml: &Xml<'a>, element: &Element<'a>) -> Result<Interpolation, ReadError> {
    let kind = xml.given(element, "type")?;
    let form = match kind.text {
        "CInterpolationBezier" => Form::Bezier,
        "CInterpolationCubic" => Form::Cubic,
        "CInterpolationLinear" => Form::Linear,
        _ => {
            let expected = "CInterpolationBezier, CInterpolationCubic or CInterpolationLinear";
            return Err(xml.unfit(kind, expected));
        }
    };
    // `usual` is the value that TexGen takes if the file does not state one.
    let flag = |name, usual: f64| Ok::<_, ReadError>(xml.numbers(element, name)?.unwrap_or([usual]) != [0.0]);
    let (periodic, in_plane) = (flag("Periodic", 1.0)?, flag("ForceMasterNodeTangent", 0.0)?);
    Ok(Interpolation { form, periodic, in_plane })
}

/// Whether one section is that of the whole yarn, and the sections with their places.
fn sections<'a>(
    xml: &mut Xml<'a>,
    element: &Element<'a>,
    unit_mm: f64,
) -> Result<(bool, Vec<(f64, Outline)>), ReadError> {
    let kind = xml.given(element, "type")?;
    let mut outlines = Vec::new();
    let constant = match kind.text {
        "CYarnSectionConstant" => true,
        "CYarnSectionInterpNode" => false,
        _ => return Err(xml.unfit(kind, "CYarnSectionConstant or CYarnSectionInterpNode")),
    };
    let mut nodes = 0.0;
    while let Some(child) = xml.child()? {
        if constant && child.is("Section") {
            outlines = vec![(0.0, outline(xml, &child, unit_mm)?)];
        } else if !constant && child.is("NodeSection") {
            at_node(xml, nodes, unit_mm, &mut outlines)?;
            nodes += 1.0;
        } else {
            xml.skip(&child)?;
        }
    }
    // Sections between two nodes may come in any order.
    outlines.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    Ok((constant, outlines))
}

/// Adds the section of a node, and those between it and the next one.
fn at_node(
    xml: &mut Xml<'_>,
    node: f64,
    unit_mm: f64,
    outlines: &mut Vec<(f64, Outline)>,
) -> Result<(), ReadError> {
    while let Some(child) = xml.child()? {
        if child.is("Section") {
            outlines.push((node, outline(xml, &child, unit_mm)?));
        } else if child.is("MidNodeSection") {
            let [t] = xml.all(&child, "t")?;
            if !(t > 0.0 && t < 1.0) {
                return Err(xml.unfit(xml.given(&child, "t")?, "a number between 0 and 1"));
            }
            while let Some(section) = xml.child()? {
                if section.is("Section") {
                    outlines.push((node + t, outline(xml, &section, unit_mm)?));
                } else {
                    xml.skip(&section)?;
                }
            }
        } else {
            xml.skip(&child)?;
        }
    }
    Ok(())
}
