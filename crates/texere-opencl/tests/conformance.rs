//! The conformance suite on every OpenCL device there is. One that is missing fails: install a driver, such as
//! pocl-opencl-icd, which runs on the CPU.

use std::process::ExitCode;
use std::sync::Arc;

use texere_conformance::{Entry, run};
use texere_core::{Backend, BackendError};
use texere_opencl::{OpenClBackend, Schedule};

fn open() -> Result<Vec<Arc<dyn Backend>>, BackendError> {
    let open = |index| Ok(Arc::new(OpenClBackend::open(index, Schedule::PerRing)?) as Arc<dyn Backend>);
    (0..OpenClBackend::devices()?.len()).map(open).collect()
}

fn main() -> ExitCode {
    assert!(
        OpenClBackend::devices().is_ok_and(|devices| !devices.is_empty()),
        "no OpenCL device: install a driver, such as pocl-opencl-icd"
    );
    run(std::env::args_os(), &[Entry::near("opencl", open)])
}
