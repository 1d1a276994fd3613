//! The gallery: pictures of every design in `designs`, and of woven cloths in `designs/paper`.

use super::{render, vulkan};
use crate::build::Build;
use crate::steps::Steps;

/// A view: its name in the picture's file name, and its options.
type View = (&'static str, &'static [&'static str]);

/// The folder of the pictures, from the repository's root.
const FOLDER: &str = "docs/gallery";

/// The designs, each with its views beside face and back.
const DESIGNS: [(&str, &[View]); 35] = [
    ("plain.toml", &[CLOSE_UP, CUT]),
    ("poplin.toml", &[CLOSE_UP]),
    ("sheeting.toml", &[CLOSE_UP]),
    ("drill.toml", &[CLOSE_UP]),
    ("sateen.toml", &[CLOSE_UP]),
    ("tartan.toml", &[CLOSE_UP]),
    ("honeycomb.toml", &[CLOSE_UP]),
    ("denim.toml", &[CLOSE_UP, CUT]),
    ("satin.toml", &[CLOSE_UP, CUT]),
    ("double-cloth.toml", &[CLOSE_UP, CUT]),
    ("figured-double.toml", &[CLOSE_UP, CUT]),
    ("herringbone.wif", &[CLOSE_UP, ("oblique", &["--view", "oblique"])]),
    ("damask.toml", &[CLOSE_UP]),
    ("two-ply.toml", &[FINE]),
    ("jersey.toml", &[]),
    ("rib.toml", &[]),
    ("interlock.toml", &[]),
    ("garter.toml", &[]),
    ("milano.toml", &[]),
    ("cable.toml", &[]),
    ("lace.toml", &[]),
    ("tuck.toml", &[]),
    ("miss.toml", &[]),
    ("jacquard.toml", &[]),
    ("double-jacquard.toml", &[]),
    ("tricot.toml", &[]),
    ("locknit.toml", &[]),
    ("reverse-locknit.toml", &[]),
    ("warp-satin.toml", &[]),
    ("sharkskin.toml", &[]),
    ("queenscord.toml", &[]),
    ("atlas.toml", &[]),
    ("net.toml", &[]),
    ("tulle.toml", &[]),
    ("warp-jacquard.toml", &[]),
];

const CLOSE_UP: View = ("close-up", &["--view", "close-up"]);
/// A close-up with enough rings and sides for plies that wind.
const FINE: View = ("close-up", &["--view", "close-up", "--subdivisions", "12", "--sides", "48"]);
const CUT: View = ("cut", &["--view", "cut-warp", "--size", "800x260"]);

/// The paper's cloths, whole, with the paper's own sides and subdivisions, so that they have its
/// number of facets.
const PAPER: [&str; 7] =
    ["163x150", "489x450", "815x750", "1141x1050", "1630x1500", "2880x1840", "figure-7a"];

/// Draws all pictures of `docs/gallery`.
pub(crate) fn gallery(steps: &mut Steps) {
    vulkan::install(steps);
    for (design, views) in DESIGNS {
        let path = format!("designs/{design}");
        let name = design.split('.').next().unwrap_or(design);
        let sides: [View; 2] = [("face", &["--view", "face"]), ("back", &["--view", "back"])];
        for (view, options) in sides.iter().chain(views) {
            let picture = format!("{FOLDER}/{name}-{view}.png");
            let size: &[&str] = if options.contains(&"--size") { &[] } else { &["--size", "800x600"] };
            render(steps, Build::Released, &picture, &[&[&path, "-o", &picture], *options, size].concat());
        }
    }
    for name in PAPER {
        let (path, picture) = (format!("designs/paper/{name}.toml"), format!("{FOLDER}/paper-{name}.png"));
        // Threads are as narrow as pixels, so more samples are taken to avoid moiré.
        let options = ["--size", "640x480", "--supersampling", "4"];
        let args = [&["texere", "render", &path, "-o", &picture], &options[..]].concat();
        steps.cargo(&picture, &args, &[]);
    }
}
