//! Measures settling on devices: the time of a pass beside a plain fill of the bytes that the pass
//! moves, and the time until cloth is at rest.

use std::error::Error;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::{Duration, Instant};

use texere::Backend;
use texere_conformance::rest::{Start, lace, random_misses, settling_plan};
use texere_core::settling::{Form, Pass, Place, SettlingPlan, settle, tag};

use crate::fill::Gpu;
use crate::measure::median_time;

/// The bytes of the fill that passes are compared with.
const FILL: u64 = 1 << 30;

/// The cloths that are settled, by their numbers of wales and courses.
#[derive(Debug, Clone)]
pub struct Cloths {
    /// Knits with about every fifth stitch missed at random, which repeat nowhere.
    pub random: Vec<usize>,
    /// Knits with eyelets. Their numbers of wales and courses are rounded down to multiples of
    /// four.
    pub lace: Vec<usize>,
}

/// Prints a row for each device and cloth. It has medians of `rounds` warm passes and lists by the
/// host's clock, with the wait for a pass's measures. It also has the time and the result of one
/// whole settling.
///
/// # Errors
///
/// The errors of the device.
pub fn print(devices: &[String], cloths: &Cloths, rounds: usize) -> Result<(), Box<dyn Error>> {
    println!(
        "| device | cloth | points | neighbours | pass, ms | block, ms | ns a point | GB a pass | times the fill | list, ms | passes (block), lists | whole, s | clearance, radius / d |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|---|---|");
    let starts = cloths.random.iter().map(|&size| random_misses(size, 1));
    let starts = starts.chain(cloths.lace.iter().map(|&size| lace(size / 4)));
    for start in starts {
        let plan = settling_plan(&start);
        for name in devices {
            print_row(name, &start, &plan, rounds)?;
        }
    }
    Ok(())
}

fn print_row(
    name: &str,
    start: &Start,
    plan: &Arc<SettlingPlan>,
    rounds: usize,
) -> Result<(), Box<dyn Error>> {
    let gpu = Gpu::open(name).ok();
    let backend: Box<dyn Backend> = texere::open(name)?;
    let mut settler = backend.settler(plan.clone())?;
    let began = Instant::now();
    let rest = settle(plan, &mut *settler, |_, _| ControlFlow::Continue(()))?;
    let whole = began.elapsed();
    // The places are those of the start again, so that contacts pull as in most passes.
    let at = |tags: &(&Place, &u32)| tags.1 & tag::POINT != 0;
    let places: Vec<Place> =
        plan.places().iter().zip(plan.tags()).filter(at).map(|(place, _)| *place).collect();
    settler.upload(&places)?;
    let (list, neighbours) = median_of(rounds, || settler.list(1.0))?;
    let mut timed = |form| {
        let pass = Pass { form, growth: 1.0, ease: 0.5, momentum: 0.8 };
        median_of(rounds, || settler.pass(&pass)).map(|(time, _)| time)
    };
    let (weighted, block) = (timed(Form::Weighted)?, timed(Form::Block)?);
    let points = plan.counts().points;
    let bytes = texere_gpu::settling_pass_bytes(plan, neighbours);
    let fill = match &gpu {
        Some(gpu) => {
            let mut fill = gpu.fill(&[FILL])?;
            fill.run()?;
            let (_, time) = median_of(rounds, || fill.run())?;
            let share = weighted.as_secs_f64() / (time.as_secs_f64() * bytes as f64 / FILL as f64);
            format!("{share:.2}")
        }
        None => "-".into(),
    };
    let ms = |time: Duration| time.as_secs_f64() * 1e3;
    println!(
        "| {name} | {} | {points} | {neighbours} | {:.3} | {:.3} | {:.1} | {:.3} | {fill} | {:.2} | {} ({}), {} | {:.2} | {:.3}, {:.3} |",
        start.name,
        ms(weighted),
        ms(block),
        weighted.as_secs_f64() / points as f64 * 1e9,
        bytes as f64 / 1e9,
        ms(list),
        rest.passes,
        rest.block_passes,
        rest.lists,
        whole.as_secs_f64(),
        rest.end.clearance,
        rest.end.radius,
    );
    Ok(())
}

/// The median time of `rounds` runs by the host's clock, after a run that warms the device up, and
/// the value of the last run.
fn median_of<T, E>(rounds: usize, mut run: impl FnMut() -> Result<T, E>) -> Result<(Duration, T), E> {
    let mut last = run()?;
    let mut times = Vec::new();
    for _ in 0..rounds.max(1) {
        let start = Instant::now();
        last = run()?;
        times.push(start.elapsed());
    }
    Ok((median_time(&times), last))
}
