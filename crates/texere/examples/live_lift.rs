//! Edits a lift of cloth whose mesh stays on a device, and prints which parts were made again:
//! `cargo run --example live_lift`.

use std::sync::Arc;

use texere::{Live, Settings};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let design = texere::read("designs/denim.toml")?;
    let mut live = Live::new(Arc::from(texere::open("auto")?), &design.structure, Settings::default())?;
    live.update()?; // the whole mesh

    let (end, pick) = (4, 7); // counted from 0
    let before = live.woven().is_some_and(|cloth| cloth.drawdown().up(end, pick));
    for up in [!before, before] {
        live.set_lift(end, pick, up)?;
        let update = live.update()?;
        println!("end {} {} pick {}:", end + 1, if up { "over" } else { "under" }, pick + 1);
        for change in update.changes {
            println!(
                "  chunk {}: vertices {:?}, indices {:?}",
                change.chunk, change.vertices, change.indices
            );
        }
    }
    Ok(())
}
