//! The report of a knit that was strained.

use std::fmt::Write;

use serde::Serialize;
use texere_fabric::{Along, StrainTest};

use super::strain_plot::{Curve, plot};
use crate::Design;

/// The strains at which the tangent modulus is reported.
const MODULI: [f64; 3] = [0.0, 0.05, 0.1];

/// The forces per width at which the strain is reported, N/mm.
const FORCES: [f64; 2] = [0.05, 0.1];

/// A knit at rest, and its tests of strain. The keys of the JSON are these fields, and those of the
/// lists within.
#[derive(Debug, Serialize)]
pub struct StrainReport {
    /// The name of the design.
    name: String,
    /// The device that worked out energies and forces.
    device: String,
    tests: Vec<Tested>,
}

/// A test along the courses, along the wales or along both.
#[derive(Debug, Serialize)]
struct Tested {
    /// `courses`, `wales` or `both`.
    along: &'static str,
    /// Wales per cm at rest.
    wales_per_cm: f64,
    /// Courses per cm at rest.
    courses_per_cm: f64,
    /// Poisson's ratio at rest.
    poisson: Option<f64>,
    /// Tangent moduli at some strains.
    moduli: [Modulus; MODULI.len()],
    /// The strains at which some forces are reached.
    reached: [Reached; FORCES.len()],
    states: Vec<State>,
}

/// The tangent modulus at a strain.
#[derive(Debug, Serialize)]
struct Modulus {
    strain: f64,
    /// None if the states do not reach the strain.
    n_per_mm: Option<f64>,
}

/// A force per width, and the strain at which it is reached.
#[derive(Debug, Serialize)]
struct Reached {
    n_per_mm: f64,
    /// None if no state reaches the force.
    strain: Option<f64>,
}

/// A strained state.
#[derive(Debug, Serialize)]
struct State {
    /// The strain along the courses.
    strain_courses: f64,
    /// The strain along the wales.
    strain_wales: f64,
    /// The force along the courses for each mm of the cloth's height, N/mm.
    force_courses_n_per_mm: f64,
    /// The force along the wales for each mm of the cloth's width, N/mm.
    force_wales_n_per_mm: f64,
    /// Thickness, mm.
    thickness_mm: f64,
    /// The energy above that at rest, for each mm² of cloth at rest, N mm/mm².
    energy_n_per_mm: f64,
    /// Whether the forces balance.
    balanced: bool,
}

impl StrainReport {
    /// The report of the `tests` that `device` has made of a design.
    #[must_use]
    pub fn new(design: &Design, device: &str, tests: &[StrainTest]) -> Self {
        let tests = tests.iter().map(Tested::new).collect();
        Self { name: design.name.clone(), device: device.to_owned(), tests }
    }

    /// The report as tables, for people.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = String::new();
        // Writing to a string can't fail.
        for test in &self.tests {
            let _ = test.write(&mut text);
        }
        text
    }

    /// The forces over the strains, as SVG. A test along both ways has two curves.
    #[must_use]
    pub fn svg(&self) -> String {
        let courses = |state: &State| [state.strain_courses, state.force_courses_n_per_mm];
        let wales = |state: &State| [state.strain_wales, state.force_wales_n_per_mm];
        let curves = self.tests.iter().flat_map(|test| {
            let curve = |name, of: &dyn Fn(&State) -> [f64; 2]| Curve {
                name,
                points: test.states.iter().map(of).collect(),
            };
            match test.along {
                "courses" => vec![curve("along the courses", &courses)],
                "wales" => vec![curve("along the wales", &wales)],
                _ => vec![curve("along both, courses", &courses), curve("along both, wales", &wales)],
            }
        });
        plot(&curves.collect::<Vec<_>>())
    }

    /// All states as a table of comma-separated values, with the JSON's keys as the first line.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut csv = String::from(
            "along,strain_courses,strain_wales,force_courses_n_per_mm,force_wales_n_per_mm,thickness_mm,energy_n_per_mm,balanced\n",
        );
        for test in &self.tests {
            for state in &test.states {
                let State { strain_courses, strain_wales, thickness_mm, balanced, .. } = state;
                let [courses, wales] = [state.force_courses_n_per_mm, state.force_wales_n_per_mm];
                // Writing to a string can't fail.
                let _ = writeln!(
                    csv,
                    "{},{strain_courses},{strain_wales},{courses},{wales},{thickness_mm},{},{balanced}",
                    test.along, state.energy_n_per_mm
                );
            }
        }
        csv
    }
}

impl Tested {
    fn new(test: &StrainTest) -> Self {
        let states = test.states.iter().map(|state| State {
            strain_courses: state.strain[0],
            strain_wales: state.strain[1],
            force_courses_n_per_mm: state.force[0],
            force_wales_n_per_mm: state.force[1],
            thickness_mm: state.thickness_mm,
            energy_n_per_mm: test.stored(state),
            balanced: state.balanced,
        });
        let moduli = MODULI.map(|strain| Modulus { strain, n_per_mm: test.modulus_at(strain) });
        let reached = FORCES.map(|force| Reached { n_per_mm: force, strain: test.strain_at(force) });
        Self {
            along: test.along.name(),
            wales_per_cm: 10.0 / test.gauge.wale_mm,
            courses_per_cm: 10.0 / test.gauge.course_mm,
            poisson: test.poisson_at(0.0),
            moduli,
            reached,
            states: states.collect(),
        }
    }

    fn write(&self, text: &mut String) -> std::fmt::Result {
        let Self { along, wales_per_cm, courses_per_cm, .. } = self;
        let way = if *along == Along::Both.name() { "courses and wales" } else { along };
        writeln!(
            text,
            "along the {way}, from {wales_per_cm:.2} wales/cm and {courses_per_cm:.2} courses/cm at rest"
        )?;
        writeln!(text, "  strain along          force, N/mm          thickness  energy,")?;
        writeln!(text, "  courses     wales     courses     wales      mm         N mm/mm²")?;
        for state in &self.states {
            let State { strain_courses, strain_wales, thickness_mm, energy_n_per_mm, .. } = state;
            let [courses, wales] =
                [state.force_courses_n_per_mm, state.force_wales_n_per_mm].map(|force| force + 0.0);
            let said = if state.balanced { "" } else { "  forces don't balance" };
            writeln!(
                text,
                "  {strain_courses:<+10.4}  {strain_wales:<+8.4}  {courses:<10.3e}  {wales:<9.3e}  {thickness_mm:<9.4}  {energy_n_per_mm:.3e}{said}"
            )?;
        }
        if let Some(poisson) = self.poisson {
            writeln!(text, "  Poisson's ratio at rest {poisson:.3}")?;
        }
        for Modulus { strain, n_per_mm } in &self.moduli {
            if let Some(modulus) = n_per_mm {
                writeln!(text, "  tangent modulus at a strain of {strain}: {modulus:.4} N/mm")?;
            }
        }
        for Reached { n_per_mm, strain } in &self.reached {
            match strain {
                Some(strain) => writeln!(text, "  {n_per_mm} N/mm at a strain of {strain:.3}")?,
                None => writeln!(text, "  {n_per_mm} N/mm at a strain beyond these")?,
            }
        }
        Ok(())
    }
}
