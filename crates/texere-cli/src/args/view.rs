//! The command line of `texere view`.

use std::path::PathBuf;

use super::SettingsArgs;
use super::render::size;
use super::settling::RestArgs;

#[derive(Debug, clap::Args)]
pub(crate) struct ViewArgs {
    /// A .toml design, a draft (.wif, .dtx, .wpo), or a .k program of a knitting machine. When the
    /// file changes, so does the cloth in the window
    pub(crate) design: PathBuf,
    /// The first width and height of the window, in pixels, or in points if the screen is scaled
    #[arg(long, value_name = "WxH", default_value = "1280x800", value_parser = size)]
    pub(crate) size: [u32; 2],
    /// The device that draws: auto, wgpu, wgpu:1, wgpu:nvidia
    #[arg(long, default_value = "auto")]
    pub(crate) device: String,
    #[command(flatten)]
    pub(crate) settings: SettingsArgs,
    #[command(flatten)]
    pub(crate) rest: RestArgs,
}
