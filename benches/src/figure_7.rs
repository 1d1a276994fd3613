//! The paper's figure 7: its three cloths at full size, from the design to the picture.

use std::error::Error;
use std::path::Path;
use std::time::Instant;

use texere::Settings;
use texere::picture::{Camera, Quality};
use texere::write::Output;

use crate::stages::stages;

/// The designs, and the millions of facets that the paper states for each.
const CLOTHS: [(&str, f64); 3] = [("figure-7a", 254.47), ("figure-7b", 331.71), ("figure-7c", 381.71)];
/// The seconds that the paper states for each cloth.
const PAPER_S: f64 = 10.0;

/// Width and height of the pictures, pixels.
const SIZE: [u32; 2] = [1600, 1200];

/// The width of the close-up, as a share of the cloth's.
const CLOSE: f32 = 0.02;

/// Makes the meshes of the three designs in the folder `designs` on `device`, such as `wgpu:0`.
/// Makes each mesh twice, and times the second run, when the device is warm. Draws each whole cloth
/// and a close-up of it to PNG files in the folder `output`. Prints a table of the times beside the
/// paper's.
///
/// # Errors
///
/// The errors of the reader, the structure, the device and the file system.
pub fn print(device: &str, designs: &Path, output: &Path) -> Result<(), Box<dyn Error>> {
    let (backend, renderer) = (texere::open(device)?, texere::picture::open_renderer(device)?);
    std::fs::create_dir_all(output)?;
    println!(
        "| design, on {device} | facets, 10⁶ | the paper's | at rest | to the mesh, s | drawn, s | the paper's, s |"
    );
    println!("|---|---|---|---|---|---|---|");
    for (name, facets) in CLOTHS {
        let path = designs.join(name).with_extension("toml");
        stages(&path, &*backend)?;
        let (row, yarns) = stages(&path, &*backend)?;
        let start = Instant::now();
        let mut scene = renderer.scene(&yarns, &Settings::default())?;
        let extent = *scene.extent();
        let close = CLOSE * (extent.high[0] - extent.low[0]);
        let middle = [0, 1].map(|axis| 0.5 * (extent.low[axis] + extent.high[axis]));
        let face = Camera::face(&extent, SIZE);
        let picture = scene.picture(&face, Quality::default())?;
        let drawn = start.elapsed();
        let near = scene.picture(&Camera::close_up(&extent, middle, close, SIZE)?, Quality::default())?;
        for (picture, file) in [(picture, format!("{name}.png")), (near, format!("{name}-close-up.png"))] {
            texere::write::picture(picture.size, &picture.rgb, Output::to(output.join(file)))?;
        }
        let rest = row.rests.map_or("as placed", |rests| if rests.at_rest { "yes" } else { "no" });
        println!(
            "| {} | {:.2} | {facets:.2} | {rest} | {:.2} | {:.2} | {PAPER_S:.0} |",
            row.name,
            row.triangles as f64 * 1e-6,
            row.whole().as_secs_f64(),
            drawn.as_secs_f64(),
        );
    }
    println!("\nPictures are in {}.", output.display());
    Ok(())
}
