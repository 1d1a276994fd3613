//! Schedules: the name of a device under each schedule, and what each schedule can't do.

use texere_core::backend::{Plan, Schedule};
use texere_core::{BackendError, Capabilities, Frame};

/// The name of device `index` of `interface` under `schedule`, or of the caller's own device if
/// there is no index.
///
/// ```
/// use texere_core::backend::Schedule;
/// use texere_gpu::device_name;
/// assert_eq!(device_name("opencl", Some(1), Schedule::PerRing), "opencl:1");
/// assert_eq!(device_name("wgpu", None, Schedule::PerYarn), "wgpu/per-yarn");
/// ```
#[must_use]
pub fn device_name(interface: &str, index: Option<usize>, schedule: Schedule) -> String {
    let index = index.map_or_else(String::new, |index| format!(":{index}"));
    let of_schedule = if schedule == Schedule::PerYarn { "/per-yarn" } else { "" };
    format!("{interface}{index}{of_schedule}")
}

/// The capabilities of a GPU under `schedule`. Settling and drawing do not depend on the schedule.
/// Apart from these two, [`Schedule::PerYarn`] only makes meshes. `draw` says whether pictures are
/// drawn through the GPU's interface.
///
/// ```
/// use texere_core::backend::Schedule;
/// use texere_gpu::capabilities;
/// assert!(capabilities(Schedule::PerRing, false).pack);
/// assert!(!capabilities(Schedule::PerYarn, false).pack);
/// ```
#[must_use]
pub const fn capabilities(schedule: Schedule, draw: bool) -> Capabilities {
    let ours = matches!(schedule, Schedule::PerRing);
    Capabilities {
        settle: true,
        settle_crossings: true,
        relax: false,
        edit: ours,
        attributes: ours,
        pack: ours,
        draw,
    }
}

/// The error for [`Schedule::Serial`], which no GPU has. `name` is the device's name.
#[must_use]
pub fn serial_unsupported(name: &str) -> BackendError {
    BackendError::Unsupported { schedule: name.into(), what: "the serial schedule".into() }
}

/// Checks that a GPU has `schedule`, and that the schedule can make the meshes of `plan`.
/// [`Schedule::PerYarn`] makes only open, untwisted yarns without caps, whose sections stand
/// [upright](texere_core::Frame::Upright). `name` is the device's name, for the error.
///
/// ```
/// use texere_core::backend::{Plan, Schedule};
/// use texere_core::{ControlPoint, Settings, Yarn, Yarns};
/// use texere_gpu::check_schedule;
/// # let mut yarns = Yarns::builder();
/// # yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
/// # let yarns = yarns.build()?;
/// let plan = Plan::new(yarns.layout().clone(), Settings { caps: true, ..Settings::default() })?;
/// check_schedule(Schedule::PerRing, &plan, "mine:0")?;
/// let refused = check_schedule(Schedule::PerYarn, &plan, "mine:0/per-yarn").unwrap_err();
/// assert_eq!(refused.to_string(), "mine:0/per-yarn does not do caps");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// **Errors**: [`BackendError::Unsupported`] with the first thing that the schedule can't do.
pub fn check_schedule(schedule: Schedule, plan: &Plan, name: &str) -> Result<(), BackendError> {
    let left_out = match schedule {
        Schedule::Serial => return Err(serial_unsupported(name)),
        Schedule::PerRing => None,
        Schedule::PerYarn => left_out_per_yarn(plan),
    };
    match left_out {
        Some(what) => Err(BackendError::Unsupported { schedule: name.into(), what }),
        None => Ok(()),
    }
}

fn left_out_per_yarn(plan: &Plan) -> Option<String> {
    if plan.layout().leans() {
        return Some("yarns that stand by up directions".into());
    }
    if plan.settings().frame != Frame::Upright {
        return Some("rotation-minimising frames".into());
    }
    if plan.settings().caps {
        return Some("caps".into());
    }
    plan.layout().yarns().iter().enumerate().find_map(|(number, yarn)| match yarn {
        _ if plan.layout().is_steep(number) => Some(format!("steep yarns, such as yarn {number}")),
        _ if yarn.closed => Some(format!("closed yarns, such as yarn {number}")),
        _ if yarn.twist != 0.0 => Some(format!("twist, such as that of yarn {number}")),
        _ => None,
    })
}

#[cfg(test)]
mod tests {
    use texere_core::{ControlPoint, Settings, Yarn, Yarns};

    use super::*;

    /// What `schedule` can't do of a plan with a plain yarn and `yarn`.
    fn asked(schedule: Schedule, yarn: Yarn, settings: Settings) -> Option<String> {
        let mut yarns = Yarns::builder();
        for yarn in [Yarn::default(), yarn] {
            yarns.yarn(yarn, &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, x * x, 0.0, 0.1)));
        }
        let plan = Plan::new(yarns.build().unwrap().layout().clone(), settings).unwrap();
        match check_schedule(schedule, &plan, "mine:0") {
            Ok(()) => None,
            Err(BackendError::Unsupported { schedule, what }) if schedule == "mine:0" => Some(what),
            Err(other) => panic!("{other}"),
        }
    }

    #[test]
    fn per_yarn_does_what_the_paper_does_and_names_the_rest() {
        let (plain, usual) = (Yarn::default(), Settings::default());
        let turning = Settings { frame: Frame::RotationMinimizing, ..usual };
        let capped = Settings { caps: true, ..usual };
        let (closed, twisted) = (Yarn { closed: true, ..plain }, Yarn { twist: -1.0, ..plain });
        for (yarn, settings, left_out) in [
            (plain, usual, None),
            (plain, turning, Some("rotation-minimising frames")),
            (plain, capped, Some("caps")),
            (closed, usual, Some("closed yarns, such as yarn 1")),
            (twisted, usual, Some("twist, such as that of yarn 1")),
        ] {
            assert_eq!(asked(Schedule::PerYarn, yarn, settings).as_deref(), left_out);
            assert_eq!(asked(Schedule::PerRing, yarn, settings), None);
            assert_eq!(asked(Schedule::Serial, yarn, settings).as_deref(), Some("the serial schedule"));
        }
    }
}
