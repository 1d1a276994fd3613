//! `texere inspect`

use texere::backend::Plan;
use texere::check::InspectReport;

use crate::args::InspectArgs;
use crate::fail::Fail;
use crate::{print, progress, reading, settling};

pub(crate) fn run(args: &InspectArgs) -> Result<(), Fail> {
    let (mut design, said) = reading::reported(&args.design, args.curves)?;
    reading::apply(&args.settings, &mut design)?;
    let (name, tension) = (design.name.clone(), args.settings.tension(design.structure.tension()));
    let (cloth, settling) = if args.counts {
        (design.placed(tension)?, None)
    } else {
        settling::cloth(design, &args.settling, tension, || texere::open("cpu"))?
    };
    let plan = Plan::new(cloth.yarns().layout().clone(), args.settings.of(cloth.yarns()))?;
    let clearance = if args.counts {
        None
    } else {
        Some(progress::during("measuring how near yarns come", |bar| {
            cloth.clearance(plan.settings(), progress::share(bar))
        })?)
    };
    let mut report = InspectReport::new(&cloth, settling, &plan, clearance.as_ref())?;
    if let Some(point) = args.at {
        report = report.with_yarns_under(&cloth, point);
    }
    if args.json { print::json(&report) } else { print::lines(&name, 16, &report.lines(&said)) }
}
