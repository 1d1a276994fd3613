//! Settles all starts, and prints what came of them.

use texere_conformance::rest::{check, linking, settle_start, starts};
use texere_core::Form;
use texere_cpu::ParallelBackend;

fn main() {
    let device = ParallelBackend::open().unwrap();
    let only = std::env::args().nth(1);
    let trace = std::env::args().nth(2).is_some();
    for start in starts()
        .into_iter()
        .filter(|start| only.as_ref().is_none_or(|only| start.name.starts_with(only.as_str())))
    {
        let before = check(&start, &start.points());
        let begun = std::time::Instant::now();
        let mut n = 0;
        let (rest, settled) = settle_start(&start, &device, |pass, seen| {
            n += 1;
            if trace && n % 10 == 0 {
                println!(
                    "{n} {} {:.3} {:.3} {seen:.4?}",
                    if pass.form == Form::Block { "B" } else { "A" },
                    pass.growth,
                    pass.ease
                );
            }
        });
        let took = begun.elapsed();
        let after = check(&start, &settled);
        println!("{:?} {:?}", after.sharpest, {
            let y = &settled[after.sharpest.yarn];
            let i = after.sharpest.interval;
            (0..5)
                .map(|k| {
                    let a = y[(i + k + y.len() - 2) % y.len()];
                    let b = y[(i + k + y.len() - 1) % y.len()];
                    ((a.distance(b)) * 100.0).round() / 100.0
                })
                .collect::<Vec<_>>()
        });
        let linked = linking(&start, &start.points(), &settled);
        println!(
            "{:18} {:.3}/{:.3} -> {:.3}/{:.3} seen {:.3}/{:.3}/{:.3} stretch {:+.3} growth {:+.3} thick {:.2} linking {:.2} {} passes {}+{} lists {} {:.2} s",
            start.name,
            before.clearance,
            before.bend,
            after.clearance,
            after.bend,
            rest.end.clearance,
            rest.end.radius,
            rest.end.length,
            after.stretch,
            after.growth,
            after.thickness / (2.0 * start.yarns[0].radius),
            linked.change,
            if rest.at_rest { "rest" } else { "NOT" },
            rest.passes - rest.block_passes,
            rest.block_passes,
            rest.lists,
            took.as_secs_f64()
        );
    }
}
