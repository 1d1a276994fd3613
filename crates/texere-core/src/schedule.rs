//! How work is mapped onto a GPU, and what a mapping leaves out.

use std::fmt;

use crate::{BackendError, Frame, Plan};

/// How a GPU backend maps the work onto its device: fixed when the backend is opened.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Schedule {
    /// A lane a ring, a workgroup a block: ours, which does everything.
    #[default]
    PerRing,
    /// A lane a yarn, the paper's algorithms 2 and 4: the yardstick. Upright, untwisted, open, uncapped yarns only.
    PerYarn,
}

impl fmt::Display for Schedule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::PerRing => "per-ring",
            Self::PerYarn => "per-yarn",
        })
    }
}

impl Schedule {
    /// Whether it does all that `plan` asks for. `name` is the device's, for the error.
    ///
    /// ```
    /// use texere_core::{BackendError, ControlPoint, Plan, Schedule, Settings, Yarn, Yarns};
    /// # let mut yarns = Yarns::builder();
    /// # yarns.yarn(Yarn::default(), &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
    /// # let yarns = yarns.build()?;
    /// let plan = Plan::new(yarns.layout().clone(), Settings { caps: true, ..Settings::default() })?;
    /// Schedule::PerRing.check(&plan, "mine:0")?;
    /// let refused = Schedule::PerYarn.check(&plan, "mine:0/per-yarn").unwrap_err();
    /// assert_eq!(refused.to_string(), "mine:0/per-yarn does not do caps");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// **Errors**: [`BackendError::Unsupported`] with the first thing that it leaves out.
    pub fn check(self, plan: &Plan, name: &str) -> Result<(), BackendError> {
        match self.left_out(plan) {
            Some(what) => Err(BackendError::Unsupported { schedule: name.into(), what }),
            None => Ok(()),
        }
    }

    fn left_out(self, plan: &Plan) -> Option<String> {
        if self == Self::PerRing {
            return None;
        }
        if plan.settings().frame != Frame::Upright {
            return Some("rotation-minimising frames".into());
        }
        if plan.settings().caps {
            return Some("caps".into());
        }
        plan.layout().yarns().iter().enumerate().find_map(|(number, yarn)| match yarn {
            _ if yarn.closed => Some(format!("closed yarns, such as yarn {number}")),
            _ if yarn.twist != 0.0 => Some(format!("twist, such as that of yarn {number}")),
            _ => None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ControlPoint, Settings, Yarn, Yarns};

    /// What `schedule` says to a plain yarn and after it `yarn`.
    fn asked(schedule: Schedule, yarn: Yarn, settings: Settings) -> Option<String> {
        let mut yarns = Yarns::builder();
        for yarn in [Yarn::default(), yarn] {
            yarns.yarn(yarn, &[0.0, 1.0, 2.0].map(|x| ControlPoint::new(x, x * x, 0.0, 0.1)));
        }
        let plan = Plan::new(yarns.build().unwrap().layout().clone(), settings).unwrap();
        match schedule.check(&plan, "mine:0") {
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
        }
    }
}
