//! `cargo xtask demo` and `cargo xtask gallery`: pictures of the repository's designs.

mod gallery;
pub(crate) mod vulkan;

use crate::build::Build;
use crate::steps::Steps;

pub(crate) use gallery::gallery;

/// The path of the demo's picture, from the repository's root.
const DEMO: &str = "target/demo.png";

/// Draws a close-up of denim at rest, on a device of this machine that can draw. If there is no
/// driver of Vulkan, one that draws on the CPU is installed first.
pub(crate) fn demo(steps: &mut Steps, build: Build) {
    vulkan::install(steps);
    render(
        steps,
        build,
        "the demo",
        &["designs/denim.toml", "-o", DEMO, "--view", "close-up", "--sides", "16"],
    );
    if steps.succeed() {
        println!("\nThe picture is {DEMO}. There are more in docs/gallery.");
    }
}

/// Draws a picture. Its yarns have more sides and more rings than by default, unless `args` says
/// how many sides.
fn render(steps: &mut Steps, build: Build, name: &str, args: &[&str]) {
    let smooth: &[&str] =
        if args.contains(&"--sides") { &[] } else { &["--sides", "12", "--subdivisions", "4"] };
    let args = [&["render"][..], args, smooth].concat();
    match build {
        Build::Released => {
            // The feature `view`, a window, is left out, because it takes as long to build as
            // everything else.
            let run = ["run", "--quiet", "--release", "--package", "texere-cli", "--no-default-features"];
            steps.cargo(name, &[&run[..], &["--"], &args].concat(), &[]);
        }
        Build::Tested => {
            build.libraries(steps);
            steps.run(name, &[&[&*format!("{}/texere", build.folder())], &args[..]].concat(), &[]);
        }
    }
}
