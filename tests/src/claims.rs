//! The check that a device can do what it claims, and nothing else.

use std::sync::Arc;

use libtest_mimic::Failed;
use texere_core::backend::{LiveMesh, Plan, SessionError};
use texere_core::crossings::{CrossingThread, Crossings, CrossingsPlan};
use texere_core::relaxation::{Elastic, Relaxation, RelaxationPlan};
use texere_core::{Backend, BackendError, Pipeline, PipelineError, Settings, Yarn};

use crate::{cases, rest};

/// Passes if the device has every capability that [`DeviceInfo::can`](texere_core::DeviceInfo::can)
/// claims, and refuses every other one by name. Pictures have tests of their own.
pub(crate) fn claims_hold(device: &dyn Backend) -> Result<(), Failed> {
    let can = device.info().can;
    let yarns = cases::winding(100, Yarn::default());
    let plan = Arc::new(Plan::new(yarns.layout().clone(), Settings::default())?);
    let starts = rest::starts();
    let start = starts.first().ok_or("no start of a settling")?;
    let threads = || vec![CrossingThread::new(0.5, 0.2); 2];
    let plain = CrossingsPlan::new(&Crossings::new(vec![true, false, false, true], threads(), threads()))?;

    let refused = |error: &BackendError| matches!(error, BackendError::NoSettling { .. });
    holds("settle", can.settle, device.settler(rest::settling_plan(start)), refused)?;
    let refused = |error: &BackendError| matches!(error, BackendError::NoCrossings { .. });
    holds("settle_crossings", can.settle_crossings, device.crossings_settler(Arc::new(plain)), refused)?;
    let yarn = Elastic { bending: 0.01, core: 0.1, shell: 0.2, compression: 0.001, extension: 20.0 };
    let elastic = vec![yarn; yarns.layout().yarns().len()];
    let relaxation = RelaxationPlan::new(&Relaxation::new(&yarns, &elastic))?;
    let refused = |error: &BackendError| matches!(error, BackendError::NoRelaxation { .. });
    holds("relax", can.relax, device.relaxer(Arc::new(relaxation)), refused)?;
    let refused = |error: &SessionError| matches!(error, SessionError::Backend(BackendError::NoEditing));
    holds("edit", can.edit, LiveMesh::new(device, plan), refused)?;
    let refused = |error: &PipelineError| matches!(error, PipelineError::Backend(BackendError::NoAttributes));
    holds("attributes", can.attributes, Pipeline::new(&yarns).attributes(device), refused)?;
    let refused = |error: &PipelineError| matches!(error, PipelineError::Backend(BackendError::NoPacking));
    holds("pack", can.pack, Pipeline::new(&yarns).packed(device), refused)
}

/// Passes if the device claims the capability and `done` succeeded, or if the device does not claim
/// it and `done` was refused.
fn holds<T, E: std::error::Error + Send + Sync + 'static>(
    what: &str,
    said: bool,
    done: Result<T, E>,
    refused: impl Fn(&E) -> bool,
) -> Result<(), Failed> {
    match done {
        Ok(_) if said => Ok(()),
        Ok(_) => Err(format!("{what}: the device does not say that it can, and it does").into()),
        Err(error) if refused(&error) && !said => Ok(()),
        Err(error) if refused(&error) => Err(format!("{what}: the device says that it can: {error}").into()),
        Err(error) => Err(error.into()),
    }
}

#[cfg(test)]
mod tests {
    use texere_core::backend::{Engine, NullBackend};
    use texere_core::{Capabilities, DeviceInfo};
    use texere_cpu::SerialBackend;

    use super::*;

    /// A device whose claims may differ from what it does. It settles nothing.
    #[derive(Debug)]
    struct Boasting(DeviceInfo, Box<dyn Backend>);

    impl Backend for Boasting {
        fn info(&self) -> &DeviceInfo {
            &self.0
        }

        fn engine(&self, plan: Arc<Plan>) -> Result<Box<dyn Engine>, BackendError> {
            self.1.engine(plan)
        }
    }

    #[test]
    fn each_wrong_claim_is_found() {
        let serial = SerialBackend::new();
        claims_hold(&serial).unwrap();
        claims_hold(&NullBackend::default()).unwrap();
        let honest =
            Capabilities { settle: false, settle_crossings: false, relax: false, ..serial.info().can };
        let says = |can| {
            let info = DeviceInfo { can, ..serial.info().clone() };
            claims_hold(&Boasting(info, Box::new(SerialBackend::new())))
        };
        says(honest).unwrap();
        for (what, can) in [
            ("settle", Capabilities { settle: true, ..honest }),
            ("settle_crossings", Capabilities { settle_crossings: true, ..honest }),
            ("relax", Capabilities { relax: true, ..honest }),
            ("edit", Capabilities { edit: false, ..honest }),
            ("attributes", Capabilities { attributes: false, ..honest }),
            ("pack", Capabilities { pack: false, ..honest }),
        ] {
            let told = says(can).unwrap_err();
            assert!(told.message().is_some_and(|told| told.starts_with(&format!("{what}: "))), "{told:?}");
        }
    }
}
