//! Measures crossings on devices: the time of a pass beside a plain fill of the bytes that the pass
//! moves, and the time until cloth is at rest.

use std::error::Error;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::{Duration, Instant};

use texere::Backend;
use texere_core::crossings::{
    CrossingThread, Crossings, CrossingsPass, CrossingsPlan, CrossingsSettler, settle,
};

use crate::fill::Gpu;
use crate::measure::median_time;

/// The bytes of the fill that passes are compared with.
const FILL: u64 = 1 << 30;

/// The number of passes that are started at once.
const PASSES: usize = 10;

/// A Jacquard of `ends` by `picks` that repeats nowhere: satin of 8 with a figure in plain weave,
/// at a pitch of 1.75 diameters.
fn jacquard((ends, picks): (usize, usize), passes: u32) -> Crossings {
    let thread = CrossingThread::new(0.35, 0.2);
    let figure = |end: usize, pick: usize| {
        let [x, y] = [end as f64 / ends as f64, pick as f64 / picks as f64].map(|share| share - 0.5);
        (x * x + y * y < 0.16) && (17.0 * x + 11.0 * y * y).sin() > 0.0
    };
    let up = |end: usize, pick: usize| {
        if figure(end, pick) { (end + pick).is_multiple_of(2) } else { !(end + 5 * pick).is_multiple_of(8) }
    };
    let ups = (0..ends * picks).map(|number| up(number % ends, number / ends)).collect();
    Crossings::new(ups, vec![thread; ends], vec![thread; picks]).repeats(false, false).passes(passes)
}

/// Prints a row for each device and size. It has the time of a pass if ten are started at once, and
/// the time of a pass alone. Both are medians of `rounds` runs by the host's clock, with the wait
/// for the passes' measures. It also has the time and the result of one whole settling of at most
/// `passes` passes.
///
/// # Errors
///
/// The errors of the device.
pub fn print(
    devices: &[String],
    sizes: &[(usize, usize)],
    passes: u32,
    rounds: usize,
) -> Result<(), Box<dyn Error>> {
    println!(
        "| device | ends x picks | crossings | pass, ms | alone, ms | ns a crossing | GB a pass | times the fill | passes | whole, s | at rest | step | clearance |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|---|---|");
    for &size in sizes {
        let plan = Arc::new(CrossingsPlan::new(&jacquard(size, passes))?);
        for name in devices {
            print_row(name, size, &plan, rounds)?;
        }
    }
    Ok(())
}

fn print_row(
    name: &str,
    (ends, picks): (usize, usize),
    plan: &Arc<CrossingsPlan>,
    rounds: usize,
) -> Result<(), Box<dyn Error>> {
    let backend: Box<dyn Backend> = texere::open(name)?;
    let mut settler = backend.crossings_settler(plan.clone())?;
    let began = Instant::now();
    let rest = settle(plan, &mut *settler, |_, _| ControlFlow::Continue(()))?;
    let whole = began.elapsed();
    let pass = time_of(&mut *settler, PASSES, rounds)? / PASSES as u32;
    let alone = time_of(&mut *settler, 1, rounds)?;
    let bytes = texere_gpu::crossings_pass_bytes(plan);
    let fill = match Gpu::open(name).ok() {
        Some(gpu) => {
            let mut fill = gpu.fill(&[FILL])?;
            fill.run()?;
            let times = (0..rounds.max(1)).map(|_| fill.run()).collect::<Result<Vec<_>, _>>()?;
            // The fill is timed by the device's own clock.
            let floor = median_time(&times).as_secs_f64() * bytes as f64 / FILL as f64;
            format!("{:.2}", pass.as_secs_f64() / floor)
        }
        None => "-".into(),
    };
    let ms = |time: Duration| time.as_secs_f64() * 1e3;
    println!(
        "| {name} | {ends} x {picks} | {} | {:.3} | {:.3} | {:.2} | {:.3} | {fill} | {} | {:.2} | {} | {:.0e} | {:.3} |",
        plan.crossings(),
        ms(pass),
        ms(alone),
        pass.as_secs_f64() / plan.crossings() as f64 * 1e9,
        bytes as f64 / 1e9,
        rest.passes,
        whole.as_secs_f64(),
        rest.at_rest,
        rest.seen.step,
        rest.seen.clearance,
    );
    Ok(())
}

/// The median time of `rounds` runs of `passes` passes each, after a run that warms the device up.
/// The passes have the settings of late passes of a settling, when threads have their full area.
fn time_of(
    settler: &mut dyn CrossingsSettler,
    passes: usize,
    rounds: usize,
) -> Result<Duration, Box<dyn Error>> {
    let passes = vec![CrossingsPass::of(u32::MAX); passes];
    let mut times = Vec::new();
    for _ in 0..=rounds.max(1) {
        let start = Instant::now();
        let _ = settler.passes(&passes, &mut |_, _| ControlFlow::Continue(()))?;
        times.push(start.elapsed());
    }
    Ok(median_time(&times[1..]))
}
