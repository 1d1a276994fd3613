//! Checks of yarns of any structure.

use texere_core::{Material, Origin, RADIUS_MAX, RADIUS_MIN, Section, SectionError, TWIST_LIMIT, Yarn};
use thiserror::Error;

/// The reason why a thread or a section of any structure is refused.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum ThreadError {
    /// A radius that is not a number, or is outside its limits.
    #[error("radius of {thread} is {radius_mm} mm, outside {low} to {high} mm")]
    Radius {
        /// The thread.
        thread: Origin,
        /// The thread's radius, mm.
        radius_mm: f32,
        /// The least radius allowed, mm.
        low: f32,
        /// The largest radius allowed, mm.
        high: f32,
    },
    /// A twist that is not finite, or is larger than its limit.
    #[error("twist of {thread} is {twist} rad/mm, beyond ±{limit}")]
    Twist {
        /// The thread.
        thread: Origin,
        /// The thread's twist, rad/mm.
        twist: f32,
        /// The largest twist allowed in either direction, rad/mm.
        limit: f32,
    },
    /// A thread refers to a material that is missing.
    #[error("{thread} is of material {material}, but there are {materials}")]
    UnknownMaterial {
        /// The thread.
        thread: Origin,
        /// The number of the thread's material, counted from 0.
        material: u32,
        /// The number of materials.
        materials: usize,
    },
    /// A thread refers to a section that is missing.
    #[error("{thread} has section {section}, but there are {sections}")]
    UnknownSection {
        /// The thread.
        thread: Origin,
        /// The number of the thread's section, counted from 0.
        section: u32,
        /// The number of sections.
        sections: usize,
    },
    /// A section whose numbers are not valid.
    #[error("section {section} is not sound")]
    Section {
        /// The number of the section, counted from 0.
        section: usize,
        /// What is wrong with the section's numbers.
        source: SectionError,
    },
}

/// Checks the numbers of all sections.
pub(crate) fn sections(sections: &[Section]) -> Result<(), ThreadError> {
    for (section, each) in sections.iter().enumerate() {
        each.validate().map_err(|source| ThreadError::Section { section, source })?;
    }
    Ok(())
}

/// Checks a yarn's radius (mm) and twist, and that its material and section exist. Errors name the
/// yarn by its origin.
pub(crate) fn yarn(
    yarn: &Yarn,
    radius_mm: f32,
    materials: &[Material],
    sections: &[Section],
) -> Result<(), ThreadError> {
    let Yarn { material, section, twist, origin: thread, closed: _ } = *yarn;
    let (materials, sections) = (materials.len(), sections.len());
    if !(RADIUS_MIN..=RADIUS_MAX).contains(&radius_mm) {
        return Err(ThreadError::Radius { thread, radius_mm, low: RADIUS_MIN, high: RADIUS_MAX });
    }
    if !(-TWIST_LIMIT..=TWIST_LIMIT).contains(&twist) {
        return Err(ThreadError::Twist { thread, twist, limit: TWIST_LIMIT });
    }
    if material as usize >= materials {
        return Err(ThreadError::UnknownMaterial { thread, material, materials });
    }
    if section as usize >= sections {
        return Err(ThreadError::UnknownSection { thread, section, sections });
    }
    Ok(())
}
