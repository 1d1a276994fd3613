//! Prints the yarns under a grid of points, seen from above: `cargo run --example picker [DESIGN]`.

use std::sync::Arc;

use texere::backend::Plan;
use texere::mesh::Ray;
use texere::yarn::YarnPlace;
use texere::{Picker, Settings};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "designs/denim.toml".into());
    let design = texere::read(path)?;
    let yarns = design.yarns()?;
    let settings = Settings::default();
    let plan = Plan::new(yarns.layout().clone(), settings)?;
    let picker = Picker::new(Arc::new(plan), yarns.points())?;

    let bounds = picker.bounds();
    let above = f64::from(bounds.high[2]) + 1.0;
    let steps = 4;
    for row in (0..steps).rev() {
        for column in 0..steps {
            let at = |axis: usize, step: i32| {
                let [low, high] = [bounds.low[axis], bounds.high[axis]].map(f64::from);
                low + (high - low) * (f64::from(step) + 0.5) / f64::from(steps)
            };
            let (x, y) = (at(0, column), at(1, row));
            print!("({x:.2} mm, {y:.2} mm): ");
            let Some(hit) = picker.pick(&Ray { origin: [x, y, above], direction: [0.0, 0.0, -1.0] }) else {
                println!("nothing");
                continue;
            };
            let (yarn, interval) = (hit.place.yarn as usize, hit.interval as usize);
            let place = YarnPlace::at(&yarns, yarn, interval, hit.t).ok_or("no such place")?;
            println!("{}, {:.3} mm high", design.named(&yarns, &place), hit.position[2]);
        }
    }
    Ok(())
}
