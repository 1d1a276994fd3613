//! What yarns are checked for, whatever structure they are in.

use texere_core::{Material, RADIUS_MAX, RADIUS_MIN, Section, TWIST_LIMIT, Yarn};

use crate::FabricError;

/// Whether the numbers of all sections are sound.
pub(crate) fn sections(sections: &[Section]) -> Result<(), FabricError> {
    for (section, each) in sections.iter().enumerate() {
        each.validate().map_err(|source| FabricError::Section { section, source })?;
    }
    Ok(())
}

/// Whether a yarn's radius (mm) and twist are taken, and whether there are a material and a section of its numbers. Errors name it
/// by its origin.
pub(crate) fn yarn(
    yarn: &Yarn,
    radius_mm: f32,
    materials: &[Material],
    sections: &[Section],
) -> Result<(), FabricError> {
    let Yarn { material, section, twist, origin: thread, closed: _ } = *yarn;
    let (materials, sections) = (materials.len(), sections.len());
    if !(RADIUS_MIN..=RADIUS_MAX).contains(&radius_mm) {
        return Err(FabricError::Radius { thread, radius_mm, low: RADIUS_MIN, high: RADIUS_MAX });
    }
    if !(-TWIST_LIMIT..=TWIST_LIMIT).contains(&twist) {
        return Err(FabricError::Twist { thread, twist, limit: TWIST_LIMIT });
    }
    if material as usize >= materials {
        return Err(FabricError::UnknownMaterial { thread, material, materials });
    }
    if section as usize >= sections {
        return Err(FabricError::UnknownSection { thread, section, sections });
    }
    Ok(())
}
