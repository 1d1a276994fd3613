//! Reads curves of Universal Scene Description, in its text form: yarns that other programs made.
//!
//! The file is read in two steps. First, [`stage`](stage::stage) reads the prims, whose properties
//! may come in any order. Then the curves of each prim become yarns. The transforms of the prim and
//! of the prims that it is in place them.

mod curve;
mod place;
mod stage;
mod tokens;
mod values;

use std::collections::BTreeMap;
use std::path::Path;

use glam::{DMat4, DVec3};
use texere_core::backend::{room, room_for};
use texere_core::{ControlPoint, Layout, Material, Section, Yarn, Yarns};

use curve::{Form, Wrap};
use stage::{Curves, Prim, Stage};
use tokens::{Token, Tokens};

use super::ReadError;
use super::bytes::utf_8;
use super::curve_scale::CurveScale;
use super::spline::{Curve, control_points, tension};

/// How a file of the text form begins.
const SIGN: &str = "#usda ";

/// Types of curves that are not read.
const OTHERS: [&str; 2] = ["HermiteCurves", "NurbsCurves"];

/// Reads the curves of a stage. Each yarn is round.
pub(super) fn usd(file: &Path, bytes: &[u8], scale: CurveScale) -> Result<Yarns, ReadError> {
    if !bytes.starts_with(SIGN.as_bytes()) {
        return Err(sign(file, bytes));
    }
    let text = utf_8(file, bytes)?;
    let mut tokens = Tokens::new(file, text, SIGN.len());
    let version = tokens.next()?;
    if version.text.split('.').next() != Some("1") {
        return Err(tokens.refused(version, "version 1"));
    }
    let stage = stage::stage(&mut tokens)?;
    let mut cloth = Cloth::default();
    let mut worlds: Vec<World<'_>> = Vec::new();
    for prim in &stage.prims {
        let world = World::of(prim, prim.parent.map(|parent| worlds[parent]));
        room_for(&mut worlds, 1, "prims")?;
        worlds.push(world);
        if !world.is_there {
            continue;
        }
        if OTHERS.contains(&prim.kind.text) {
            return Err(tokens.refused(prim.kind, "BasisCurves"));
        }
        if let Some(curves) = &prim.curves {
            if let Some((name, expected)) = world.fault {
                return Err(tokens.refused(name, expected));
            }
            if world.is_instanced {
                return Err(tokens.refused(prim.kind, "curves outside a PointInstancer"));
            }
            let reader =
                Reader { tokens: &tokens, prim, curves, mm: millimetres(&stage, world.matrix, scale), scale };
            reader.take(&mut cloth)?;
        }
    }
    cloth.yarns(file)
}

/// The refusal of a file that does not begin as the text form does.
fn sign(file: &Path, bytes: &[u8]) -> ReadError {
    let sign = &bytes[..bytes.len().min(8)];
    ReadError::Bytes {
        file: file.into(),
        at: 0,
        field: "the sign",
        value: sign.escape_ascii().to_string(),
        expected: "#usda 1.0: the text form, which `usdcat -o cloth.usda` makes of the others".into(),
    }
}

/// Where a prim is in the stage.
#[derive(Debug, Clone, Copy)]
struct World<'a> {
    matrix: DMat4,
    /// An operation that can't be taken, and what was expected.
    fault: Option<(Token<'a>, &'static str)>,
    /// Whether the prim and all prims that it is in are to be read.
    is_there: bool,
    /// Whether the prim is a PointInstancer, or in one.
    is_instanced: bool,
}

impl<'a> World<'a> {
    fn of(prim: &Prim<'a>, parent: Option<Self>) -> Self {
        let stage = Self { matrix: DMat4::IDENTITY, fault: None, is_there: true, is_instanced: false };
        let parent = parent.unwrap_or(stage);
        let (matrix, fault) = match prim.place.as_ref().map(|place| place.matrix()) {
            None => (parent.matrix, parent.fault),
            Some(Ok((matrix, true))) => (parent.matrix * matrix, parent.fault),
            Some(Ok((matrix, false))) => (matrix, None),
            Some(Err(fault)) => (parent.matrix, Some(fault)),
        };
        let is_instanced = parent.is_instanced || prim.kind.text == "PointInstancer";
        Self { matrix, fault, is_there: parent.is_there && prim.is_there, is_instanced }
    }
}

/// The matrix from a prim's coordinates to mm, with z up. None if the coordinates are in mm with z
/// up already. They then keep their bits.
fn millimetres(stage: &Stage<'_>, world: DMat4, scale: CurveScale) -> Option<DMat4> {
    let unit = scale.unit_mm.map_or(stage.unit_m * 1000.0, f64::from);
    // These are turns by 90 degrees, so no curve is mirrored.
    let turn = match stage.up {
        "X" => DMat4::from_cols_array_2d(&[
            [0.0, 0.0, 1.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [-1.0, 0.0, 0.0, 0.0],
            [0.0, 0.0, 0.0, 1.0],
        ]),
        "Y" => DMat4::from_rotation_x(std::f64::consts::FRAC_PI_2),
        _ => DMat4::IDENTITY,
    };
    let matrix = DMat4::from_scale(DVec3::splat(unit)) * turn * world;
    (matrix != DMat4::IDENTITY).then_some(matrix)
}

/// The yarns of a stage.
#[derive(Debug, Default)]
struct Cloth {
    threads: Vec<Thread>,
    palette: Vec<Material>,
}

/// A curve that becomes a yarn.
#[derive(Debug)]
struct Thread {
    curve: Curve,
    material: u32,
    /// The number of the yarn, if the file has one.
    yarn: Option<u32>,
}

impl Cloth {
    fn yarns(mut self, file: &Path) -> Result<Yarns, ReadError> {
        if self.threads.is_empty() {
            let needed_for = "each yarn is a curve";
            return Err(ReadError::MissingKey {
                file: file.into(),
                field: "a prim of the type BasisCurves".into(),
                needed_for,
            });
        }
        let tension = tension(self.threads.iter().map(|thread| &thread.curve));
        if self.is_numbered()? {
            self.threads.sort_by_key(|thread| thread.yarn);
        }
        let (mut yarns, mut offsets, mut points) = (Vec::new(), vec![0], Vec::<ControlPoint>::new());
        room_for(&mut yarns, self.threads.len(), "yarns")?;
        room_for(&mut offsets, self.threads.len(), "yarns")?;
        for Thread { curve, material, .. } in self.threads {
            let closed = curve.is_closed;
            let places = control_points(curve, tension.is_some())?;
            room_for(&mut points, places.len(), "control points")?;
            points.extend(places.iter().map(|place| {
                let [x, y, z, radius] = place.map(|value| value as f32);
                ControlPoint::new(x, y, z, radius)
            }));
            yarns.push(Yarn { closed, material, ..Yarn::default() });
            offsets.push(points.len() as u64);
        }
        let unsound = |source| ReadError::Yarns { file: file.into(), source };
        let layout = Layout::new(yarns, offsets, vec![Section::Circle]).map_err(unsound)?;
        let yarns = Yarns::new(layout, self.palette, points).map_err(unsound)?;
        yarns.with_tension(tension.unwrap_or(0.0)).map_err(unsound)
    }

    /// Whether each thread has a number of its own.
    fn is_numbered(&self) -> Result<bool, ReadError> {
        let mut numbers = room("yarns", self.threads.len())?;
        numbers.extend(self.threads.iter().map(|thread| thread.yarn));
        numbers.sort_unstable();
        // Threads without a number come first.
        Ok(numbers.first().is_some_and(Option::is_some) && numbers.windows(2).all(|pair| pair[0] < pair[1]))
    }
}

/// The curves of a prim that is to be read.
struct Reader<'a> {
    tokens: &'a Tokens<'a>,
    prim: &'a Prim<'a>,
    curves: &'a Curves<'a>,
    mm: Option<DMat4>,
    scale: CurveScale,
}

impl Reader<'_> {
    fn refused(&self, expected: String) -> ReadError {
        self.tokens.refused(self.prim.kind, expected)
    }

    /// The value of a property that may be one of `words`. Without the property it is that of the
    /// first word, which is USD's own choice.
    fn word<T: Copy>(&self, given: Option<Token<'_>>, words: &[(&str, T)]) -> Result<T, ReadError> {
        let Some(given) = given else { return Ok(words[0].1) };
        let found = words.iter().find(|(word, _)| *word == given.text);
        found.map(|(_, value)| *value).ok_or_else(|| {
            let words: Vec<_> = words.iter().map(|(word, _)| *word).collect();
            self.tokens.refused(given, words.join(" or "))
        })
    }

    fn take(&self, cloth: &mut Cloth) -> Result<(), ReadError> {
        let is_linear = self.word(self.curves.form, &[("cubic", false), ("linear", true)])?;
        let bases = [("bezier", Form::Bezier), ("bspline", Form::BSpline), ("catmullRom", Form::CatmullRom)];
        let form = if is_linear { Form::Linear } else { self.word(self.curves.basis, &bases)? };
        let wraps =
            [("nonperiodic", Wrap::Nonperiodic), ("periodic", Wrap::Periodic), ("pinned", Wrap::Pinned)];
        let wrap = self.word(self.curves.wrap, &wraps)?;
        let (points, counts) = (&self.curves.points, &self.curves.counts);
        if let Some(moving) = self.curves.moving.filter(|_| points.is_empty()) {
            let expected = "points at the default time: curves that move are not read";
            return Err(self.tokens.refused(moving, expected));
        }
        if points.is_empty() && counts.is_empty() {
            return Ok(());
        }
        let all: u64 = counts.iter().map(|&count| u64::from(count)).sum();
        if all != points.len() as u64 {
            let expected = format!("{all} points, as curveVertexCounts says; there are {}", points.len());
            return Err(self.refused(expected));
        }
        let mut varying = Vec::new();
        room_for(&mut varying, counts.len(), "curves")?;
        for &count in counts {
            let values = form.varying(wrap, count as usize);
            let expected = || format!("curves of another number of points: one has {count}");
            let values = values.ok_or_else(|| self.refused(expected()))?;
            varying.push(values);
        }
        let widths = self.widths(&varying)?;
        let materials = self.materials(&mut cloth.palette)?;
        room_for(&mut cloth.threads, counts.len(), "curves")?;
        let are_numbered = self.curves.yarns.len() == counts.len();
        let (mut vertex, mut value) = (0, 0);
        for (number, (&count, &values)) in counts.iter().zip(&varying).enumerate() {
            let own = vertex..vertex + count as usize;
            let vertices = own.map(|vertex| {
                let [x, y, z] = points[vertex].map(f64::from);
                let place =
                    self.mm.map_or(DVec3::new(x, y, z), |mm| mm.transform_point3(DVec3::new(x, y, z)));
                [place.x, place.y, place.z, widths.at(number, vertex) / 2.0]
            });
            let radii = match &widths {
                Widths::Varying(widths) => {
                    Some(widths[value..value + values].iter().map(|width| width / 2.0).collect::<Vec<_>>())
                }
                _ => None,
            };
            cloth.threads.push(Thread {
                curve: Curve::new(form, wrap, vertices.collect(), radii.as_deref()),
                material: materials[if materials.len() == 1 { 0 } else { number }],
                yarn: are_numbered.then(|| self.curves.yarns[number]),
            });
            vertex += count as usize;
            value += values;
        }
        Ok(())
    }

    /// The diameters, mm. `varying` is the number of those that vary along each curve.
    fn widths(&self, varying: &[usize]) -> Result<Widths, ReadError> {
        if let Some(diameter) = self.scale.diameter_mm {
            return Ok(Widths::One(f64::from(diameter)));
        }
        let primvars = &self.curves.primvar_widths;
        let given = if primvars.values.is_empty() { &self.curves.widths } else { primvars };
        let factor = self.mm.map_or(1.0, |mm| mm.determinant().abs().cbrt());
        let mut widths = Vec::new();
        room_for(&mut widths, given.values.len(), "widths of curves")?;
        widths.extend(given.values.iter().map(|&width| f64::from(width) * factor));
        let interpolation = given.interpolation.map_or("vertex", |token| token.text);
        let (count, each): (usize, fn(Vec<f64>) -> Widths) = match (interpolation, given.interpolation) {
            _ if widths.len() == 1 => return Ok(Widths::One(widths[0])),
            _ if widths.is_empty() => {
                return Err(self.refused("curves with widths, or a diameter beside the file".into()));
            }
            ("constant", _) => (1, Widths::Curve),
            ("uniform", _) => (self.curves.counts.len(), Widths::Curve),
            ("varying" | "faceVarying", _) => (varying.iter().sum(), Widths::Varying),
            (_, Some(token)) if interpolation != "vertex" => {
                return Err(self.tokens.refused(token, "constant, uniform, varying or vertex"));
            }
            _ => (self.curves.points.len(), Widths::Vertex),
        };
        if widths.len() != count {
            let found = widths.len();
            return Err(self.refused(format!("{count} widths ({interpolation}); there are {found}")));
        }
        Ok(each(widths))
    }

    /// The materials of the curves: one for all, or one for each. Colours that change along a curve
    /// are passed over.
    fn materials(&self, palette: &mut Vec<Material>) -> Result<Vec<u32>, ReadError> {
        let own = &self.curves.colors.values;
        let numbered = self.curves.color_indices.iter().map(|&index| {
            let color = own.get(index as usize).copied();
            color.ok_or_else(|| self.refused(format!("colour {index}; there are {}", own.len())))
        });
        let numbered = numbered.collect::<Result<Vec<_>, _>>()?;
        let colors = if numbered.is_empty() { own } else { &numbered };
        let is_uniform = self.curves.colors.interpolation.is_some_and(|token| token.text == "uniform");
        let counts = is_uniform && colors.len() == self.curves.counts.len();
        let all = match colors.len() {
            1 => vec![Some(colors[0])],
            _ if counts => colors.iter().copied().map(Some).collect(),
            _ => vec![None],
        };
        let mut known = BTreeMap::new();
        let number = |color: Option<[f32; 3]>| {
            let srgb = color.map_or_else(
                || Material::default().srgb,
                |color| color.map(|linear| (Material::encoded(linear) * 255.0).round() as u8),
            );
            *known.entry(srgb).or_insert_with(|| {
                palette.push(Material { name: self.prim.name.clone(), srgb, ..Material::default() });
                palette.len() as u32 - 1
            })
        };
        Ok(all.into_iter().map(number).collect())
    }
}

/// Diameters, mm.
enum Widths {
    One(f64),
    Curve(Vec<f64>),
    Vertex(Vec<f64>),
    Varying(Vec<f64>),
}

impl Widths {
    /// The width at a vertex of a curve. It is 0 if widths vary along the curve: `Curve::new` sets
    /// them afterwards.
    fn at(&self, curve: usize, vertex: usize) -> f64 {
        match self {
            Self::One(width) => *width,
            Self::Curve(widths) => widths[curve],
            Self::Vertex(widths) => widths[vertex],
            Self::Varying(_) => 0.0,
        }
    }
}
