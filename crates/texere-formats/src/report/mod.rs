//! Reports of a design's cloth: what it measures, and what is wrong with it. They serialize, and
//! they give lines for people.

mod check;
mod clearance;
mod cures;
mod inspect;
mod measures;
mod settling;
mod setts;
mod strain;
mod strain_plot;
mod under;

pub use check::CheckReport;
pub use inspect::InspectReport;
pub use settling::SettlingReport;
pub use strain::StrainReport;
