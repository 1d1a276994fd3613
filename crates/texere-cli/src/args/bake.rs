//! The command line of `texere bake`.

use std::path::PathBuf;

use super::settling::RestArgs;

#[derive(Debug, clap::Args)]
pub(crate) struct BakeArgs {
    /// A .toml design, a draft (.wif, .dtx, .wpo), or a .k program of a knitting machine
    pub(crate) design: PathBuf,
    /// The folder to make: maps as PNG and EXR, and the material as U3M, U3MA and MaterialX
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: PathBuf,
    /// Size of a texel, mm. If left out, an eighth of the mean radius of the yarns, or larger if
    /// the maps would otherwise have more than 2048 texels along their longer side
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    pub(crate) texel: Option<f64>,
    /// Bake a rectangle of the cloth instead of one repeat: its left and lower edges, and its width
    /// and height, mm. Its maps do not tile
    #[arg(long, value_name = "X,Y,W,H", value_parser = rectangle, allow_hyphen_values = true)]
    pub(crate) area: Option<[[f64; 2]; 2]>,
    /// The device that draws: auto, wgpu, wgpu:1, wgpu:nvidia
    #[arg(long, default_value = "auto")]
    pub(crate) device: String,
    #[command(flatten)]
    pub(crate) rest: RestArgs,
}

/// A rectangle from its four numbers.
fn rectangle(text: &str) -> Result<[[f64; 2]; 2], String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|number| number.trim().parse()).collect();
    match numbers.as_deref() {
        Ok(&[x, y, width, height]) => Ok([[x, y], [width, height]]),
        _ => Err("expected four numbers, such as 0,0,12.5,8".into()),
    }
}
