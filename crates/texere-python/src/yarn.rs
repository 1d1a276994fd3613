//! Yarns as they lie on the bobbin: thickness, twist, section, colour.

use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use texere::weft::KnitYarn;
use texere::woven::Thread;
use texere::yarn::{
    Fibre, Material, PACKING, PACKING_LIMITS, Section, diameter_mm, firmness_from_twist,
    twist_from_turns_per_m,
};

/// A yarn as it lies on the bobbin: what a design in code is made of.
///
/// ``diameter_mm`` is the diameter of the round yarn. If it is not given, it is computed from
/// ``tex`` (g/km) and ``density`` (g/cm³, by default that of a yarn of the fibre). ``twist_per_m``
/// is turns per metre, above 0 for Z twist. ``color`` is ``"#rrggbb"`` or three numbers from 0 to
/// 255, sRGB. ``section`` is ``"circle"``, ``("ellipse", aspect)``, ``("lenticular", aspect,
/// distortion)``, ``("power-ellipse", aspect, exponent)``, ``("lobed", plies)`` or ``("lobed",
/// plies, valley)``, where the valley between two plies lies 0.5 to 1 times as far from the axis as
/// a ply reaches. ``fibre`` is ``"cotton"``, ``"linen"``, ``"nylon"``, ``"polyester"``,
/// ``"silk"``, ``"viscose"`` or ``"wool"``. ``hairiness``, 0 to 30, is the H of Uster testers;
/// pictures show it.
///
/// Four arguments count in woven cloth alone. ``flatness`` is the width over the height in the
/// cloth, 0.1 to 10. ``stiffness`` is 0.01 to 100, 1 for cotton. ``firmness`` is how firmly the
/// section keeps its shape at rest, 0.01 to 100, 1 for cotton of ordinary twist. If ``firmness`` is
/// not given, it follows from ``twist_per_m``, or is 1 without ``twist_per_m``. ``packing`` is the
/// largest share of a squeezed yarn's section that fibre fills, 0.1 to 0.91.
///
/// ``bending_stiffness``, 1e-9 to 1e6 N mm², counts in knits that rest by their energy. If it is
/// not given, it follows from ``fibre`` and ``tex``.
///
/// >>> texere.Yarn(tex=50, color="#2b3f6b", twist_per_m=500)
/// <texere.Yarn 'yarn', 0.265 mm>
///
/// Raises ValueError if the colour, the section, the thickness, ``fibre`` or ``packing`` is not
/// valid. All other limits are checked when cloth is made of the yarn.
#[pyclass(frozen, module = "texere", name = "Yarn")]
#[derive(Debug)]
pub(crate) struct YarnSpec {
    material: Material,
    section: Section,
    /// Diameter of the round yarn, mm.
    ///
    /// >>> texere.Yarn(diameter_mm=0.3).diameter_mm
    /// 0.3
    #[pyo3(get)]
    diameter_mm: f64,
    twist: f32,
    flatness: f32,
    stiffness: f32,
    firmness: f32,
    least_area: f32,
}

#[pymethods]
impl YarnSpec {
    #[new]
    #[pyo3(signature = (*, diameter_mm=None, tex=None, density=None, color=None, name="yarn", twist_per_m=None, section=None, flatness=1.0, stiffness=1.0, firmness=None, hairiness=0.0, fibre="cotton", packing=PACKING, bending_stiffness=None))]
    #[allow(clippy::too_many_arguments, reason = "each is an argument by name in Python")]
    fn new(
        diameter_mm: Option<f64>,
        tex: Option<f32>,
        density: Option<f64>,
        color: Option<&Bound<'_, PyAny>>,
        name: &str,
        twist_per_m: Option<f64>,
        section: Option<&Bound<'_, PyAny>>,
        flatness: f32,
        stiffness: f32,
        firmness: Option<f32>,
        hairiness: f32,
        fibre: &str,
        packing: f64,
        bending_stiffness: Option<f32>,
    ) -> PyResult<Self> {
        let Some(fibre) = Fibre::named(fibre) else {
            let names = Fibre::ALL.map(Fibre::name).join(", ");
            return Err(PyValueError::new_err(format!("fibre {fibre:?} is none of {names}")));
        };
        let [low, high] = PACKING_LIMITS;
        if !(low..=high).contains(&packing) {
            return Err(PyValueError::new_err(format!("packing is {packing}, outside {low} to {high}")));
        }
        let density = fibre.spun_density(density, tex.map(f64::from), diameter_mm);
        let of_tex = |tex| self::diameter_mm(f64::from(tex), density);
        let Some(diameter_mm) = diameter_mm.or(tex.map(of_tex)) else {
            return Err(PyValueError::new_err("a yarn needs diameter_mm or tex"));
        };
        if !(diameter_mm.is_finite() && diameter_mm > 0.0) {
            return Err(PyValueError::new_err(format!(
                "the yarn is {diameter_mm} mm thick, expected above 0"
            )));
        }
        let srgb = color.map_or(Ok(Material::default().srgb), srgb)?;
        let section = section.map_or(Ok(Section::Circle), self::section)?;
        section.validate().map_err(|error| PyValueError::new_err(format!("section: {error}")))?;
        let of_fibre = fibre.bending_of(tex.map(f64::from)).map(|bending| bending as f32);
        let bending = bending_stiffness.or(of_fibre);
        let material = Material { name: name.into(), srgb, tex, hairiness, bending };
        let twist = twist_from_turns_per_m(twist_per_m.unwrap_or(0.0)) as f32;
        let of_twist = twist_per_m.map(|_| firmness_from_twist(twist, (diameter_mm / 2.0) as f32));
        let firmness = firmness.or(of_twist).unwrap_or(1.0);
        let least_area = fibre.least_area(density, packing);
        Ok(Self { material, section, diameter_mm, twist, flatness, stiffness, firmness, least_area })
    }

    /// The name of the yarn's material.
    ///
    /// >>> texere.Yarn(diameter_mm=0.3, name="cotton").name
    /// 'cotton'
    #[getter]
    fn name(&self) -> &str {
        &self.material.name
    }

    fn __repr__(&self) -> String {
        format!("<texere.Yarn '{}', {:.3} mm>", self.material.name, self.diameter_mm)
    }
}

/// A colour: `"#rrggbb"`, or three numbers.
pub(crate) fn srgb(value: &Bound<'_, PyAny>) -> PyResult<[u8; 3]> {
    let Ok(text) = value.extract::<String>() else { return value.extract() };
    let is_hex = |hex: &&str| hex.len() == 6 && hex.bytes().all(|digit| digit.is_ascii_hexdigit());
    let hex = text.strip_prefix('#').filter(is_hex);
    hex.and_then(|hex| u32::from_str_radix(hex, 16).ok())
        .map(|number| [16, 8, 0].map(|shift| (number >> shift) as u8))
        .ok_or_else(|| PyValueError::new_err(format!("color is {text:?}, expected \"#rrggbb\"")))
}

/// A section by its name and its numbers.
fn section(value: &Bound<'_, PyAny>) -> PyResult<Section> {
    if let Ok(name) = value.extract::<String>()
        && name == "circle"
    {
        return Ok(Section::Circle);
    }
    if let Ok((name, plies)) = value.extract::<(String, u32)>()
        && name == "lobed"
    {
        return Ok(Section::plied(plies));
    }
    if let Ok((name, plies, valley)) = value.extract::<(String, u32, f32)>()
        && name == "lobed"
    {
        return Ok(Section::Lobed { plies, valley });
    }
    if let Ok((name, aspect)) = value.extract::<(String, f32)>()
        && name == "ellipse"
    {
        return Ok(Section::Ellipse { aspect });
    }
    match value.extract::<(String, f32, f32)>() {
        Ok((name, aspect, distortion)) if name == "lenticular" => {
            Ok(Section::Lenticular { aspect, distortion })
        }
        Ok((name, aspect, exponent)) if name == "power-ellipse" => {
            Ok(Section::PowerEllipse { aspect, exponent })
        }
        _ => Err(PyValueError::new_err(format!(
            "section is {}, expected \"circle\", (\"ellipse\", aspect), (\"lenticular\", aspect, distortion), \
             (\"power-ellipse\", aspect, exponent), (\"lobed\", plies) or (\"lobed\", plies, valley)",
            value.repr()?
        ))),
    }
}

/// The yarns of a design, each with the numbers of its material and its section.
#[derive(Debug, Default)]
pub(crate) struct Bobbins {
    pub(crate) materials: Vec<Material>,
    pub(crate) sections: Vec<Section>,
    yarns: Vec<(KnitYarn, [f32; 4])>,
}

impl Bobbins {
    /// Adds a yarn, or a sequence of yarns. Returns their numbers.
    ///
    /// **Errors**: `TypeError` for what is no yarn, `ValueError` for no yarn at all.
    pub(crate) fn add(&mut self, name: &str, value: &Bound<'_, PyAny>) -> PyResult<Vec<usize>> {
        let yarns = match value.extract::<PyRef<'_, YarnSpec>>() {
            Ok(one) => vec![one],
            Err(_) => value.extract::<Vec<PyRef<'_, YarnSpec>>>().map_err(|_| {
                PyTypeError::new_err(format!("{name} is neither a texere.Yarn nor a sequence of them"))
            })?,
        };
        if yarns.is_empty() {
            return Err(PyValueError::new_err(format!("{name} has no yarn")));
        }
        let first = self.yarns.len();
        for yarn in &yarns {
            let known = self.sections.iter().position(|section| *section == yarn.section);
            let section = known.unwrap_or_else(|| {
                self.sections.push(yarn.section.clone());
                self.sections.len() - 1
            });
            let own = KnitYarn {
                radius_mm: (yarn.diameter_mm / 2.0) as f32,
                material: self.materials.len() as u32,
                section: section as u32,
                twist: yarn.twist,
            };
            self.materials.push(yarn.material.clone());
            self.yarns.push((own, [yarn.flatness, yarn.stiffness, yarn.firmness, yarn.least_area]));
        }
        Ok((first..self.yarns.len()).collect())
    }

    /// The yarns of a knit.
    pub(crate) fn knit(&self) -> Vec<KnitYarn> {
        self.yarns.iter().map(|(yarn, _)| *yarn).collect()
    }

    /// A thread of the yarn with number `number`, in a column of the cloth `spacing_mm` wide.
    pub(crate) fn thread(&self, number: usize, spacing_mm: f64) -> Thread {
        let (KnitYarn { radius_mm, material, section, twist }, sizes) = self.yarns[number];
        let [flatness, stiffness, firmness, least_area] = sizes;
        Thread { spacing_mm, radius_mm, flatness, stiffness, firmness, least_area, material, section, twist }
    }
}
