//! Materials and sections of yarns.

use std::ffi::c_char;

use texere::yarn::{HAIRINESS_LIMIT, Material, Section};

use crate::argument::{check, slice, text};
use crate::error::guard;
use crate::failure::Failure;
use crate::status::texere_status;

/// A material of yarns. Its bending stiffness is that of soft cotton; only design files state
/// another one. The stiffness counts for knits that come to rest by their energy.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_material {
    /// Its name, UTF-8.
    pub name: *const c_char,
    /// Length of the name, bytes.
    pub name_length: usize,
    /// Linear density, tex; 0 if it is not known.
    pub tex: f32,
    /// Length of the fibres that stand off the yarn, cm per cm of yarn, 0 to 30. Only pictures show
    /// them.
    pub hairiness: f32,
    /// Red, green and blue, sRGB.
    pub srgb: [u8; 3],
    /// Zero.
    pub reserved: u8,
}

/// A circle.
pub const TEXERE_SECTION_CIRCLE: u32 = 0;
/// An ellipse whose width over height is `aspect`.
pub const TEXERE_SECTION_ELLIPSE: u32 = 1;
/// Two arcs that meet in two edges. The section has `aspect`; `form` is the height of the edges
/// above the middle, in half heights, -0.9 to 0.9.
pub const TEXERE_SECTION_LENTICULAR: u32 = 2;
/// An ellipse whose height at angle a is in proportion to |sin a|^`form` instead of |sin a|. The
/// section has `aspect`; `form` is 0.1 to 4, and 1 is an ellipse.
pub const TEXERE_SECTION_POWER_ELLIPSE: u32 = 3;
/// The outline of `count` plies twisted together, 2 to 12. `form` is the distance of the valley
/// between two plies from the axis, as a share of the distance to which a ply reaches: 0.5 to 1, or
/// 0 for plies that nothing presses.
pub const TEXERE_SECTION_LOBED: u32 = 4;
/// The outline through `corners`: `count` corners, 3 to 256.
pub const TEXERE_SECTION_POLYGON: u32 = 5;

/// The cross-section of yarns. Every shape except a polygon has the area of the round yarn.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_section {
    /// A constant whose name begins with TEXERE_SECTION.
    pub shape: u32,
    /// How many plies of TEXERE_SECTION_LOBED, or corners of TEXERE_SECTION_POLYGON.
    pub count: u32,
    /// Width over height, 0.05 to 20.
    pub aspect: f32,
    /// A number whose meaning the constant of the shape says.
    pub form: f32,
    /// The corners of a polygon, counter-clockwise: for each corner its x and its y, in radii of
    /// the yarn.
    pub corners: *const f32,
}

/// Materials and sections. Yarns refer to them by their number, counted from 0.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct texere_looks {
    /// The materials. Null with a `material_count` of 0: one material, undyed yarn.
    pub materials: *const texere_material,
    /// How many materials.
    pub material_count: u64,
    /// The sections. Null with a `section_count` of 0: one section, a circle.
    pub sections: *const texere_section,
    /// How many sections.
    pub section_count: u64,
}

/// The `count` values of an array that a struct points to. The pointer may be null if `count` is 0.
///
/// # Safety
///
/// The conditions of `slice` hold.
pub(crate) unsafe fn array<'a, T>(name: &str, pointer: *const T, count: u64) -> Result<&'a [T], Failure> {
    let count = usize::try_from(count)
        .map_err(|_| Failure::argument(format!("{name} has {count} values, more than memory can hold")))?;
    // SAFETY: the caller vouches for it.
    unsafe { slice(name, pointer, count) }
}

impl texere_looks {
    /// The materials and the sections. `name` is the struct's name in error messages.
    ///
    /// # Safety
    ///
    /// Arrays and texts are valid for reads.
    pub(crate) unsafe fn read(&self, name: &str) -> Result<(Vec<Material>, Vec<Section>), Failure> {
        let (materials_name, sections_name) =
            (format!("{name}.looks.materials"), format!("{name}.looks.sections"));
        // SAFETY: the caller vouches for all of them.
        let (materials, sections) = unsafe {
            (
                array(&materials_name, self.materials, self.material_count)?,
                array(&sections_name, self.sections, self.section_count)?,
            )
        };
        let numbered = |name: &str, number: usize| format!("{name}[{number}]");
        let materials = materials.iter().enumerate();
        // SAFETY: as above.
        let materials = materials.map(|(n, each)| unsafe { each.read(&numbered(&materials_name, n)) });
        let mut materials = materials.collect::<Result<Vec<_>, _>>()?;
        let sections = sections.iter().enumerate();
        // SAFETY: as above.
        let sections = sections.map(|(n, each)| unsafe { each.read(&numbered(&sections_name, n)) });
        let mut sections = sections.collect::<Result<Vec<_>, _>>()?;
        if materials.is_empty() {
            materials.push(Material::default());
        }
        if sections.is_empty() {
            sections.push(Section::Circle);
        }
        Ok((materials, sections))
    }
}

impl texere_material {
    /// The material. `name` is the argument's name in error messages.
    ///
    /// # Safety
    ///
    /// The text is valid for reads.
    pub(crate) unsafe fn read(&self, name: &str) -> Result<Material, Failure> {
        let &Self { name: text_at, name_length, tex, hairiness, srgb, .. } = self;
        if !(0.0..=f32::MAX).contains(&tex) {
            return Err(Failure::argument(format!("{name}.tex is {tex}, expected a number from 0")));
        }
        if !(0.0..=HAIRINESS_LIMIT).contains(&hairiness) {
            return Err(Failure::argument(format!(
                "{name}.hairiness is {hairiness}, expected 0 to {HAIRINESS_LIMIT}"
            )));
        }
        // SAFETY: the caller vouches for it.
        let text = unsafe { text(&format!("{name}.name"), text_at, name_length) }?;
        Ok(Material { name: text.into(), srgb, tex: (tex > 0.0).then_some(tex), hairiness, bending: None })
    }
}

impl texere_section {
    unsafe fn read(&self, name: &str) -> Result<Section, Failure> {
        let &Self { shape, count, aspect, form, corners } = self;
        let section = match shape {
            TEXERE_SECTION_CIRCLE => Section::Circle,
            TEXERE_SECTION_ELLIPSE => Section::Ellipse { aspect },
            TEXERE_SECTION_LENTICULAR => Section::Lenticular { aspect, distortion: form },
            TEXERE_SECTION_POWER_ELLIPSE => Section::PowerEllipse { aspect, exponent: form },
            TEXERE_SECTION_LOBED if form == 0.0 => Section::plied(count),
            TEXERE_SECTION_LOBED => Section::Lobed { plies: count, valley: form },
            TEXERE_SECTION_POLYGON => {
                // SAFETY: the caller vouches for it.
                let corners: &[[f32; 2]] =
                    unsafe { array(&format!("{name}.corners"), corners.cast(), count.into()) }?;
                Section::Polygon(corners.to_vec())
            }
            other => {
                return Err(Failure::argument(format!("{name}.shape is {other}, expected 0 to 5")));
            }
        };
        section.validate().map_err(|error| Failure::argument(format!("{name}: {error}")))?;
        Ok(section)
    }
}

/// Writes the diameter, mm, of a yarn with the linear density `tex`, tex, and the density
/// `density`, g/cm³. The density is that of the yarn with the air in it; 0.909 is usual for cotton.
///
/// Fails with TEXERE_ARGUMENT for numbers that are not above 0 and finite.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn texere_diameter(tex: f64, density: f64, diameter_mm: *mut f64) -> texere_status {
    guard(|| {
        check("diameter_mm", diameter_mm)?;
        for (name, value) in [("tex", tex), ("density", density)] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(Failure::argument(format!("{name} is {value}, expected a number above 0")));
            }
        }
        // SAFETY: the pointer is neither null nor misaligned; the caller vouches for the memory.
        unsafe { diameter_mm.write(texere::yarn::diameter_mm(tex, density)) };
        Ok(())
    })
}
