//! Reports on the cloth of a design: its measures, its faults, how its yarns came to rest, and how
//! it behaves when it is strained. Each report can be serialized, or written as text for people.

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
