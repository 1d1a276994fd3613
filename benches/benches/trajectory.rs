//! Times stage 1: rings from control points, into the session's own memory.
#![allow(
    missing_docs,
    clippy::unwrap_used,
    reason = "criterion's macros make undocumented items; a bench may panic"
)]

mod stage;

use criterion::{Criterion, criterion_group, criterion_main};
use stage::{Bench, Floor, timed};
use texere::{Settings, Yarns};
use texere_bench::{DEVICES, SWEEP, one_yarn, paper_cloth, plan, session, sizes};

fn trajectory(criterion: &mut Criterion) {
    let mut floor = Floor::new();
    for size in sizes() {
        let yarns = paper_cloth(size.0, size.1).unwrap().yarns().unwrap();
        case(criterion, &mut floor, "paper", size, &yarns, Settings::default());
    }
    let yarns = paper_cloth(SWEEP.0, SWEEP.1).unwrap().yarns().unwrap();
    case(criterion, &mut floor, "one-yarn", SWEEP, &one_yarn(&yarns).unwrap(), Settings::default());
    for subdivisions in [0, 3, 7] {
        let fabric = format!("paper-k{subdivisions}");
        let settings = Settings { subdivisions, ..Settings::default() };
        case(criterion, &mut floor, &fabric, SWEEP, &yarns, settings);
    }
}

fn case(
    criterion: &mut Criterion,
    floor: &mut Floor,
    fabric: &str,
    size: (usize, usize),
    yarns: &Yarns,
    settings: Settings,
) {
    let (plan, chunks) = plan(yarns, settings).unwrap();
    for backend in DEVICES {
        let device = texere::open(backend).unwrap();
        let mut session = session(&*device, &plan, yarns).unwrap();
        let (elements, bytes) = (plan.counts().rings, plan.trajectory_bytes());
        floor.bench(
            criterion,
            &Bench { stage: "trajectory", fabric, size, backend, elements, bytes },
            || {
                // After an upload the session computes its rings, and its rolls if there are any,
                // again. Only one point is uploaded, which takes negligible time.
                session.upload(0, &yarns.points()[..1]).unwrap();
                session.scan().unwrap();
                timed(|| session.trajectory(&chunks[0]).unwrap())
            },
        );
    }
}

criterion_group!(benches, trajectory);
criterion_main!(benches);
