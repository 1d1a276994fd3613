//! Which yarns lie under a point, and what made them.

use std::fmt;

use serde::Serialize;
use texere_contact::yarns_under;
use texere_core::{YarnPlace, Yarns};

use crate::{Design, NamedPlace};

/// A yarn under the point. In JSON, the names of these fields are the keys.
#[derive(Debug, Serialize)]
pub(crate) struct YarnUnder {
    /// The yarn's name in a designer's words: `course 3`, `end 12`, `guide bar 1, guide 5`.
    yarn: String,
    material: String,
    /// The height of the yarn's centreline, mm.
    z_mm: f64,
    /// What made the yarn under the point: a line of a knitout file, a cell of a chart, or a course
    /// of a warp knit.
    #[serde(skip_serializing_if = "Option::is_none")]
    place: Option<String>,
    /// The instructions in that line or cell.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    instructions: Vec<String>,
}

/// The yarns under `point`, the topmost first.
pub(crate) fn under(design: &Design, yarns: &Yarns, point: [f32; 2]) -> Vec<YarnUnder> {
    let said = |place: &YarnPlace| {
        let NamedPlace { thread, material, program } = design.named(yarns, place);
        let (place_of, instructions) = program.map(|program| (program.place, program.instructions)).unzip();
        // A guide of a warp knit lays yarn in all courses, so the course is named separately.
        let course =
            || design.structure.warp_knitted().and(place.source).map(|course| format!("course {course}"));
        YarnUnder {
            yarn: thread.thread_name(),
            material,
            z_mm: place.position[2],
            place: place_of.or_else(course),
            instructions: instructions.unwrap_or_default(),
        }
    };
    yarns_under(yarns, point.map(f64::from)).iter().map(said).collect()
}

impl fmt::Display for YarnUnder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, {}, z {:.3} mm", self.yarn, self.material, self.z_mm)?;
        if let Some(place) = &self.place {
            write!(f, ": {place}")?;
        }
        if !self.instructions.is_empty() {
            write!(f, ": {}", self.instructions.join("; "))?;
        }
        Ok(())
    }
}
