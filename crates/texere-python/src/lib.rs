//! texere for Python: the module `texere._texere`, whose names the package `texere` exports again.
//!
//! ```text
//! texere.read ──> Design.rest ──> Cloth.mesh ──> numpy arrays | Mesh.write
//! ```
//!
//! # How calls work
//!
//! - Python objects hold values of the crate `texere`. The values are shared and never change,
//!   except those of `texere.Live`, which one thread at a time may use. So any thread may use the
//!   other objects, and objects may be freed in any order.
//! - Arrays are read-only views of memory that a Python object owns. The `base` of an array is that
//!   object.
//! - While Rust works, the calling thread lets other Python threads go on ([`watch`]). Every 50 ms
//!   it checks whether Python asks to stop.
//! - Errors of texere raise [`error::Error`], with the place in the design's file. Arguments of the
//!   wrong type or shape raise Python's own `TypeError` and `ValueError`.

mod arrays;
mod change;
mod check;
mod cloth;
mod crossing;
mod design;
mod device;
mod drawdown;
mod edit;
mod error;
mod knit;
mod measures;
mod mesh;
mod peers;
mod pick;
mod picture;
mod progress;
mod shared;
mod strain;
mod watch;
mod whole;
mod woven;
mod yarn;
mod yarns;

use pyo3::prelude::*;

#[pymodule]
mod _texere {
    use pyo3::prelude::*;

    #[pymodule_export]
    use crate::change::Change;
    #[pymodule_export]
    use crate::check::{Clearance, Contact, Diagnosis};
    #[pymodule_export]
    use crate::cloth::Cloth;
    #[pymodule_export]
    use crate::design::{Design, read};
    #[pymodule_export]
    use crate::device::{Device, devices};
    #[pymodule_export]
    use crate::drawdown::weave;
    #[pymodule_export]
    use crate::edit::Editing;
    #[pymodule_export]
    use crate::error::Error;
    #[pymodule_export]
    use crate::knit::{Bar, warp_knit, weft_knit};
    #[pymodule_export]
    use crate::measures::Measures;
    #[pymodule_export]
    use crate::mesh::Mesh;
    #[pymodule_export]
    use crate::pick::Hit;
    #[pymodule_export]
    use crate::strain::StrainTest;
    #[pymodule_export]
    use crate::woven::woven;
    #[pymodule_export]
    use crate::yarn::YarnSpec;
    #[pymodule_export]
    use crate::yarns::{Yarns, read_curves, read_yarns};

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))?;
        crate::error::complete(module.py())
    }
}
