//! The text form of Universal Scene Description. The open yarns of each material are one prim of
//! curves, and its closed yarns another one.
//!
//! A spline of tension 0 is written as a Catmull-Rom curve. By the specification, a nonperiodic
//! curve has a vertex beyond each of its ends, and is drawn from end to end. Blender passes over
//! the wrap, and draws the curve through all vertices. The yarn's first and last point are
//! therefore written twice, so that Blender draws nearly the same curve as readers that follow the
//! specification. The doubled points also shape the first and the last interval of the curve. There
//! the curve is off from the yarn's spline by up to 0.08 of the interval's length, mostly along the
//! yarn. A closed yarn has the wrap `periodic`.
//!
//! A spline of any other tension is written as Bézier curves of the same shape. A closed one ends
//! where it begins.
//!
//! For simulators that read straight lines alone, any spline can be written as the lines between
//! its control points. These linear curves have the attributes of deformable bodies: they collide,
//! and they have a thickness at each point and, if the yarns have a tex, a mass.
//!
//! **Source**: Pixar, "UsdGeomBasisCurves", openusd.org. Alliance for OpenUSD, "Deformable Body
//! Physics" (a proposal).

use std::fmt::Display;
use std::io::Write;

use texere_core::definitions::{neighbours, tangent_factor};
use texere_core::{ControlPoint, Material, Yarns};

use super::super::WriteError;
use super::super::target::Target;
use super::super::usda::{START, quoted, triple};

/// The kinds of curves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Basis {
    CatmullRom,
    Bezier,
    Linear,
}

impl Basis {
    /// The basis that holds the shape of splines of `tension`.
    pub(super) fn of(tension: f32) -> Self {
        if tension == 0.0 { Self::CatmullRom } else { Self::Bezier }
    }
}

/// Writes a stage with all yarns.
pub(super) fn write<W: Write>(
    yarns: &Yarns,
    basis: Basis,
    target: Target<W>,
) -> Result<Target<W>, WriteError> {
    let mut stage = Stage { target };
    stage.text(START)?;
    for (number, material) in yarns.materials().iter().enumerate() {
        for closed in [false, true] {
            let own = Own { yarns, basis, material: number as u32, closed };
            if own.curves().next().is_some() {
                stage.curves(&own, material)?;
            }
        }
    }
    stage.line("}")?;
    Ok(stage.target)
}

/// The open yarns of one material, or its closed ones.
struct Own<'a> {
    yarns: &'a Yarns,
    basis: Basis,
    material: u32,
    closed: bool,
}

impl<'a> Own<'a> {
    fn curves(&self) -> impl Iterator<Item = Curve<'a>> {
        let (yarns, basis, material, closed) = (self.yarns, self.basis, self.material, self.closed);
        let all = yarns.layout().yarns().iter().enumerate();
        all.filter(move |(_, yarn)| yarn.material == material && yarn.closed == closed).map(
            move |(number, yarn)| Curve {
                number,
                points: yarns.yarn_points(number).unwrap_or_default(),
                closed: yarn.closed,
                basis,
                tension: yarns.tension(),
            },
        )
    }
}

/// The spline of one yarn.
#[derive(Clone, Copy)]
struct Curve<'a> {
    number: usize,
    points: &'a [ControlPoint],
    closed: bool,
    basis: Basis,
    tension: f32,
}

impl<'a> Curve<'a> {
    fn intervals(self) -> usize {
        self.points.len() - usize::from(!self.closed)
    }

    /// The yarn's points as the file has them. An open Catmull-Rom curve has its first and its last
    /// point twice. A closed curve of another basis has its first point again at its end.
    fn knots(self) -> impl Iterator<Item = &'a ControlPoint> {
        let is_spline = self.basis == Basis::CatmullRom;
        let before = self.points.first().filter(|_| is_spline && !self.closed);
        let after = match (is_spline, self.closed) {
            (true, false) => self.points.last(),
            (false, true) => self.points.first(),
            _ => None,
        };
        before.into_iter().chain(self.points).chain(after)
    }

    /// Number of the curve's vertices in the file.
    fn count(self) -> usize {
        match self.basis {
            Basis::Bezier => 3 * self.intervals() + 1,
            Basis::CatmullRom | Basis::Linear => self.knots().count(),
        }
    }

    /// The curve's vertices in the file, mm: its knots, and between them the handles of Bézier
    /// curves.
    fn vertices(self) -> impl Iterator<Item = [f32; 3]> + 'a {
        let handled = if self.basis == Basis::Bezier { self.intervals() } else { 0 };
        self.knots().enumerate().flat_map(move |(knot, point)| {
            let handles = (knot < handled).then(|| self.handles(knot));
            std::iter::once(axes(point)).chain(handles.into_iter().flatten())
        })
    }

    /// The two vertices of a Bézier curve within an interval, mm.
    fn handles(self, interval: usize) -> [[f32; 3]; 2] {
        let [before, start, end, after] =
            neighbours(self.points, self.closed, interval).map(|point| axes(&point));
        let third = tangent_factor::<f32>(self.tension) / 3.0;
        let leaving = std::array::from_fn(|axis| start[axis] + third * (end[axis] - before[axis]));
        let arriving = std::array::from_fn(|axis| end[axis] - third * (after[axis] - start[axis]));
        [leaving, arriving]
    }

    /// The mass of the lines between the curve's points, kg. One tex is one gram per kilometre.
    fn mass(self, tex: f32) -> f64 {
        let places = || self.vertices().map(|place| place.map(f64::from));
        let line = |(from, to): ([f64; 3], [f64; 3])| {
            from.iter().zip(to).map(|(from, to)| (to - from).powi(2)).sum::<f64>().sqrt()
        };
        let length: f64 = places().zip(places().skip(1)).map(line).sum();
        f64::from(tex) * 1e-9 * length
    }

    /// The diameter at each knot, mm. It is the diameter of a circle with the area of the ellipse
    /// that is as wide and as high as the yarn.
    fn diameters(self) -> impl Iterator<Item = f32> + 'a {
        self.knots().map(|point| 2.0 * (point.half_width() * point.half_height()).sqrt())
    }
}

/// The place of a point, mm.
fn axes(point: &ControlPoint) -> [f32; 3] {
    [point.x, point.y, point.z]
}

/// The corners of the box round all vertices of the curves, widened by their greatest radius, mm.
fn extent(own: &Own<'_>) -> [[f32; 3]; 2] {
    let mut extent = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];
    for vertex in own.curves().flat_map(Curve::vertices) {
        for axis in 0..3 {
            extent[0][axis] = extent[0][axis].min(vertex[axis]);
            extent[1][axis] = extent[1][axis].max(vertex[axis]);
        }
    }
    let radius = own.curves().flat_map(Curve::diameters).fold(0.0, f32::max) / 2.0;
    [extent[0].map(|low| low - radius), extent[1].map(|high| high + radius)]
}

/// A stage that is being written.
struct Stage<W: Write> {
    target: Target<W>,
}

impl<W: Write> Stage<W> {
    fn text(&mut self, text: impl Display) -> Result<(), WriteError> {
        write!(self.target, "{text}").map_err(|source| self.target.failed(source))
    }

    fn line(&mut self, text: impl Display) -> Result<(), WriteError> {
        self.text(format_args!("{text}\n"))
    }

    /// Writes yarns as one prim.
    fn curves(&mut self, own: &Own<'_>, material: &Material) -> Result<(), WriteError> {
        let (kind, basis, interpolation) = match own.basis {
            // Blender takes a diameter for each vertex.
            Basis::CatmullRom => ("cubic", "catmullRom", "vertex"),
            Basis::Bezier => ("cubic", "bezier", "varying"),
            // Readers of linear curves pass over the basis. `bezier` is the default of the schema.
            Basis::Linear => ("linear", "bezier", "varying"),
        };
        let wrap = if own.basis == Basis::CatmullRom && own.closed { "periodic" } else { "nonperiodic" };
        let schemas = match own.basis {
            Basis::Linear => {
                "        prepend apiSchemas = [\"PhysicsCurvesDeformableSimAPI\", \"PhysicsCollisionAPI\"]\n"
            }
            Basis::CatmullRom | Basis::Bezier => "",
        };
        let [low, high] = extent(own);
        self.line(format_args!(
            "    def BasisCurves \"{}yarns_{}\" (\n{}        displayName = {}\n    )\n    {{",
            if own.closed { "closed_" } else { "" },
            own.material + 1,
            schemas,
            quoted(&material.name)
        ))?;
        self.line(format_args!("        uniform token basis = \"{basis}\""))?;
        self.list("int[] curveVertexCounts", own.curves().map(Curve::count), "")?;
        self.line(format_args!("        float3[] extent = [{}, {}]", triple(low), triple(high)))?;
        self.list("point3f[] points", own.curves().flat_map(Curve::vertices).map(triple), "")?;
        self.list("bool[] primvars:closed", own.curves().map(|curve| curve.closed), "uniform")?;
        self.list("color3f[] primvars:displayColor", [triple(material.linear_rgb())].iter(), "")?;
        self.list("int[] primvars:yarn", own.curves().map(|curve| curve.number), "uniform")?;
        self.line(format_args!("        uniform token type = \"{kind}\""))?;
        self.list("float[] widths", own.curves().flat_map(Curve::diameters), interpolation)?;
        self.line(format_args!("        uniform token wrap = \"{wrap}\""))?;
        if own.basis == Basis::Linear {
            self.physics(own, material)?;
        }
        self.line("    }")
    }

    /// Writes what a simulator needs of the yarns of a material.
    fn physics(&mut self, own: &Own<'_>, material: &Material) -> Result<(), WriteError> {
        self.list("float[] physics:thicknesses", own.curves().flat_map(Curve::diameters), "")?;
        self.line("        uniform token physics:thicknesses:elementType = \"point\"")?;
        let Some(tex) = material.tex else { return Ok(()) };
        self.list("float[] physics:masses", own.curves().map(|curve| curve.mass(tex)), "")?;
        self.line("        uniform token physics:masses:elementType = \"curve\"")
    }

    /// Writes a list of values.
    fn list(
        &mut self,
        attribute: &str,
        values: impl Iterator<Item = impl Display>,
        interpolation: &str,
    ) -> Result<(), WriteError> {
        self.text(format_args!("        {attribute} = ["))?;
        let mut before = "";
        for value in values {
            self.text(format_args!("{before}{value}"))?;
            before = ", ";
        }
        match interpolation {
            "" => self.line("]"),
            _ => self.line(format_args!("] (\n            interpolation = \"{interpolation}\"\n        )")),
        }
    }
}
