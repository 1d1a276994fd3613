//! Measures the clearance of the 3/1 twill of the paper that texere implements (README.md), with
//! three diameters from thread to thread. The arguments are the numbers of ends and picks, `round`
//! for threads that bend round one another, and `flat` for elliptical sections:
//!
//! ```text
//! cargo run --release -p texere-fabric --example clearance -- 1630 1500 round
//! ```

use std::time::Instant;

use texere_contact::clearance;
use texere_core::{Material, Section, Settings};
use texere_fabric::{FabricError, Shape, Thread, Weave, Woven};

fn main() -> Result<(), FabricError> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number = |place: usize| arguments.get(place).and_then(|text| text.parse().ok()).unwrap_or(100);
    let (ends, picks) = (number(0), number(1));
    let thread = Thread::new(0.75, 0.125);
    let drawdown = Weave::parse("3/1")?.drawdown(ends, picks)?;
    let section = match arguments.get(3).map(String::as_str) {
        Some("flat") => Section::Ellipse { aspect: 1.5 },
        _ => Section::Circle,
    };
    let (warp, weft) = (vec![thread; ends], vec![thread; picks]);
    let mut cloth = Woven::new(drawdown, warp, weft, vec![Material::default()], vec![section])?;
    let round = arguments.get(2).is_some_and(|shape| shape == "round");
    cloth.set_shape(if round { Shape::Round } else { Shape::Crossing });
    let yarns = cloth.yarns()?;
    let start = Instant::now();
    let found = clearance(&yarns, &Settings::default())?;
    println!("{} control points, {:.2} s", yarns.points().len(), start.elapsed().as_secs_f64());
    println!("{} contacts, least {:.5}, {} below one", found.contacts, found.min, found.below_one);
    println!("tightest bend {:.3} radii", found.curvature_min);
    if let Some(worst) = found.worst.first() {
        println!("worst contact {worst:?}");
    }
    println!("tightest at {:?}", found.curvature_at);
    Ok(())
}
