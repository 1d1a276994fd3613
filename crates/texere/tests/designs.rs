//! The repository's woven designs at rest.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::fs;
use std::path::Path;

use texere::yarn::Origin;
use texere::{Structure, read};

/// The most crossings of a design that comes to rest here. `damask.toml` has more.
const CROSSINGS_MOST: usize = 20_000;

/// Every section of every yarn, as it is drawn, keeps the area that its fibres need. Half widths
/// and half heights of control points are half floats, whose rounding is 1/2048.
#[test]
fn no_yarn_of_a_design_is_denser_than_its_fibres() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../designs");
    let device = texere::open("cpu").unwrap();
    let mut tested = 0;
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|ending| ending != "toml") {
            continue;
        }
        let design = read(&path).unwrap();
        let Structure::Woven(woven) = &design.structure else { continue };
        let (warp, weft) = (woven.cloth().warp(), woven.cloth().weft());
        if !design.settle || warp.len() * weft.len() > CROSSINGS_MOST {
            continue;
        }
        let rest = design.rest(&*device).run().unwrap();
        let Structure::Woven(woven) = &rest.design().structure else { continue };
        let (warp, weft, yarns) = (woven.cloth().warp(), woven.cloth().weft(), rest.yarns());
        println!("{}: {}", path.display(), rest.report());
        for (number, yarn) in yarns.layout().yarns().iter().enumerate() {
            let thread = match yarn.origin {
                Origin::End(end) => warp[end as usize - 1],
                Origin::Pick(pick) => weft[pick as usize - 1],
                _ => unreachable!(),
            };
            let areas =
                yarns.yarn_points(number).unwrap().iter().map(|at| at.half_width() * at.half_height());
            let least = areas.fold(f32::INFINITY, f32::min) / thread.radius_mm.powi(2);
            assert!(least >= thread.least_area - 2e-3, "{}, yarn {number}: {least}", path.display());
        }
        tested += 1;
    }
    assert!(tested >= 9, "{tested} designs");
}
