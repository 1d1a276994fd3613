//! The check of one fabric on one device, in every way through a session.

use std::sync::Arc;

use texere_core::backend::Plan;
use texere_core::{Backend, Limits, Settings, Yarns};
use texere_cpu::SerialBackend;

use crate::compare::{
    Assembled, Report, assemble, compare_bits, compare_closed_ends, compare_counts, compare_with_gold,
    compare_with_oracle,
};
use crate::drive::{DriveError, Way, drive};
use crate::limits::Tight;
use crate::oracle::Oracle;

/// Runs `yarns` with `settings` on `device` in every way through a session. Compares the output
/// with the oracle, within the bounds of [`compare`](crate::compare). Compares the output with the
/// gold reference, the serial CPU backend: to the bit if `exact` is set, and otherwise within the
/// same bounds. Also compares the whole with chunks of a few blocks, and a closed yarn's end with
/// its start, both to the bit.
///
/// ```
/// use texere_conformance::{DeferredBackend, cases, check};
/// let case = &cases::all()[0];
/// let report = check(&case.yarns(), case.settings, &DeferredBackend::new(), true)?;
/// assert!(report.is_clean(), "{report}");
/// # Ok::<(), texere_conformance::drive::DriveError>(())
/// ```
///
/// **Errors**: [`DriveError`] if planning or the device fails.
pub fn check(
    yarns: &Yarns,
    settings: Settings,
    device: &dyn Backend,
    exact: bool,
) -> Result<Report, DriveError> {
    check_within(yarns, settings, Tight::Blocks, device, exact)
}

/// [`check`] with chunks that are cut to the limit `tight`.
///
/// **Errors**: [`DriveError`] if planning or the device fails.
pub fn check_within(
    yarns: &Yarns,
    settings: Settings,
    tight: Tight,
    device: &dyn Backend,
    exact: bool,
) -> Result<Report, DriveError> {
    let oracle = Oracle::new(yarns, &settings);
    let plan = Arc::new(Plan::new(yarns.layout().clone(), settings)?);
    let mut report = Report::default();
    compare_counts(&oracle, &plan, &mut report);

    let mut run = |device: &dyn Backend, limits: &Limits, way| -> Result<Assembled, DriveError> {
        let output = drive(device, &plan, yarns, limits, way, &mut report)?;
        Ok(assemble(&oracle, &output, &mut report))
    };
    let whole = run(device, &Limits::NONE, Way::Into)?;
    let others = [
        run(device, &tight.limits(&plan, 1), Way::Streamed)?,
        run(device, &tight.limits(&plan, 2), Way::Staged)?,
    ];
    let gold = run(&SerialBackend::new(), &Limits::NONE, Way::Into)?;

    compare_with_oracle(&oracle, &whole, &mut report);
    compare_closed_ends(&oracle, &whole, &mut report);
    for other in &others {
        compare_bits(&oracle, &whole, other, &mut report);
    }
    if exact {
        compare_bits(&oracle, &gold, &whole, &mut report);
    } else {
        let mut against_gold = Report::default();
        compare_with_gold(&oracle, &gold, &whole, &mut against_gold);
        report.absorb(against_gold);
    }
    Ok(report)
}
