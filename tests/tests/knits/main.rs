//! Weft knits: what stitches become, and how they settle.

mod letters;

use std::ops::ControlFlow;

use glam::DVec3;
use letters::letters;
use texere_conformance::rest::{Ends, Length, Report, Start, StartYarn, check, linking};
use texere_core::settling;
use texere_core::{Material, Section, Yarns};
use texere_cpu::ParallelBackend;
use texere_fabric::weft::{Gauge, KnitYarn, Knitted, Stitches};
use texere_fabric::{Finish, Piece, settle};

/// The diameter of all yarns, mm.
const D: f64 = 0.2;

fn points(yarns: &Yarns) -> Vec<Vec<DVec3>> {
    let yarn =
        |yarn| yarns.yarn_points(yarn).expect("a yarn").iter().map(|at| at.position().as_dvec3()).collect();
    (0..yarns.layout().yarns().len()).map(yarn).collect()
}

fn start(name: &str, piece: &Piece, length: Length) -> Start {
    let ends = piece.boundary.ends().iter().map(|ends| match ends {
        texere_core::Ends::Open => Ends::Open,
        texere_core::Ends::Closed => Ends::Closed,
        texere_core::Ends::Repeats(shift) => Ends::Repeats(*shift),
    });
    let yarns = points(&piece.yarns).into_iter().zip(ends);
    Start {
        name: name.to_owned(),
        yarns: yarns.map(|(points, ends)| StartYarn { points, radius: D / 2.0, ends }).collect(),
        repeat: piece.boundary.repeat().map(f64::from),
        pinned: Vec::new(),
        length,
    }
}

fn knitted(stitches: Stitches, wale: f64) -> Knitted {
    let gauge = Gauge::new(wale * D, 0.75 * wale * D);
    let yarn = KnitYarn::new(D as f32 / 2.0);
    Knitted::new(stitches, gauge, vec![yarn; 4], vec![Material::default()], vec![Section::Circle], [4, 4])
        .expect("a knit")
}

fn settled(name: &str, knit: &Knitted, length: settling::Length) -> (Report, Report, f64, String) {
    let piece = knit.repeat().expect("a repeat").piece;
    let finish = Finish { length: Some(length), ..Finish::default() };
    let device = ParallelBackend::open().expect("the CPU");
    let settled = settle(&piece, &finish, 0.0, &device, |_| ControlFlow::Continue(())).expect("a settling");
    let start = start(name, &piece, Length::Free);
    let after = points(&settled.yarns);
    let linked = linking(&start, &start.points(), &after);
    (
        check(&start, &start.points()),
        check(&start, &after),
        linked.change,
        format!("{} passes, rest {}", settled.rest.passes, settled.rest.at_rest),
    )
}

#[test]
fn explore() {
    let free = settling::Length::Free { tension: 0.0 };
    let cases: Vec<(&str, Vec<&str>)> = vec![
        ("jersey", vec!["kkkk"; 4]),
        ("rib", vec!["kpkp"; 4]),
        ("garter", vec!["kkkk", "pppp", "kkkk", "pppp"]),
        ("tuck", vec!["kkkk", "ktkt", "kkkk", "tktk"]),
        ("miss", vec!["kkkk", "kmkm", "kkkk", "mkmk"]),
        ("lace", vec![">kkk", "kkkk", "kk>k", "kkkk"]),
    ];
    for (name, chart) in cases {
        for wale in [4.4, 5.0, 8.0] {
            let knit = knitted(letters(&chart), wale);
            let (before, after, linked, rest) = settled(name, &knit, free);
            println!(
                "{name} {wale}: {:.3} {:.2} -> {:.3} {:.3}, grows {:.3}, thick {:.2}, linked {linked:.2}, {rest}",
                before.clearance,
                before.bend,
                after.clearance,
                after.bend,
                after.growth,
                after.thickness / D
            );
        }
    }
}
