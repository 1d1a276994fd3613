//! `texere check`

use texere::Settings;
use texere::check::CheckReport;

use crate::args::CheckArgs;
use crate::fail::Fail;
use crate::{print, progress, reading, settling};

pub(crate) fn run(args: &CheckArgs) -> Result<(), Fail> {
    let (design, _) = reading::reported(&args.design, args.curves)?;
    let name = design.name.clone();
    let tension = design.structure.tension();
    let (cloth, settling) = settling::cloth(design, &args.settling, tension, || texere::open("cpu"))?;
    let settings = Settings::of(cloth.yarns());
    let clearance = progress::during("measuring how near yarns come", |bar| {
        cloth.clearance(&settings, progress::share(bar))
    })?;
    let mut report = CheckReport::new(&cloth, settling, args.accuracy, &settings, clearance);
    if report.verdict().is_some() {
        let device = texere::open("cpu")?;
        progress::during("looking for cures", |bar| {
            report.find_cures(&cloth, &*device, progress::share(bar))
        })?;
    }
    if args.json {
        print::json(&report)?;
    } else {
        print::lines(&name, 10, &report.lines())?;
    }
    match report.verdict() {
        Some(said) => Err(Fail::cloth(&args.design, said)),
        None => Ok(()),
    }
}
