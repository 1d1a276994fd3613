//! The command line of `texere render`.

use std::path::PathBuf;

use clap::ValueEnum;
use texere::picture::{Background, Quality};

use super::numbers::{millimetres, point};
use super::path::file_of;
use super::{CurveArgs, SettingsArgs, SettlingArgs};

#[derive(Debug, clap::Args)]
pub(crate) struct RenderArgs {
    /// A .toml design, a draft (.wif, .dtx, .wpo), a .k program of a knitting machine, a .yarns
    /// file of saved cloth, or a .bcc, .obj, .usda or .tg3 file of curves that another program
    /// wrote
    pub(crate) design: PathBuf,
    /// The picture to write, a .png file; a turntable numbers its pictures: OUT-001.png and so on
    #[arg(short, long, value_name = "FILE", value_parser = file_of(&["png"]))]
    pub(crate) output: PathBuf,
    /// Width and height, pixels
    #[arg(long, value_name = "WxH", default_value = "1600x1200", value_parser = size)]
    pub(crate) size: [u32; 2],
    /// From where the cloth is seen
    #[arg(long, value_enum, default_value_t = View::Face)]
    pub(crate) view: View,
    /// The point that a close-up or a cut shows: its x and y in the cloth, mm. If left out, the
    /// middle of the cloth; a cut of woven cloth goes through the thread nearest to the middle
    #[arg(long, value_name = "X,Y", value_parser = point, allow_hyphen_values = true)]
    pub(crate) at: Option<[f32; 2]>,
    /// The width of cloth that a close-up or a cut shows, mm. If left out, forty times the mean
    /// radius of the yarns
    #[arg(long, value_name = "MM", value_parser = millimetres, allow_negative_numbers = true)]
    pub(crate) width: Option<f32>,
    /// Show face or back at true scale, with this many millimetres to a pixel. The picture is as
    /// large as the cloth needs
    #[arg(long, value_name = "MM", conflicts_with = "size", value_parser = millimetres, allow_negative_numbers = true)]
    pub(crate) mm_per_pixel: Option<f32>,
    /// Number of pictures of a turntable
    #[arg(long, value_name = "N", default_value_t = 36, value_parser = clap::value_parser!(u32).range(1..=9999))]
    pub(crate) frames: u32,
    /// How many pixels are drawn for each pixel of the picture, across and down. Each drawn pixel
    /// has four samples
    #[arg(long, value_name = "N", default_value_t = Quality::default().supersampling, value_parser = clap::value_parser!(u32).range(1..=8))]
    pub(crate) supersampling: u32,
    /// What is seen where no yarn is: ground, none for a transparent picture, or a colour as
    /// #rrggbb
    #[arg(long, default_value = "ground", value_parser = background)]
    pub(crate) background: Background,
    /// The device that draws: auto, wgpu, wgpu:1, wgpu:nvidia
    #[arg(long, default_value = "auto")]
    pub(crate) device: String,
    /// Do everything N times, to see how long it takes on a warm device
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) repeat: u32,
    #[command(flatten)]
    pub(crate) curves: CurveArgs,
    #[command(flatten)]
    pub(crate) settings: SettingsArgs,
    #[command(flatten)]
    pub(crate) settling: SettlingArgs,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum View {
    /// Straight onto the face
    Face,
    /// Straight onto the back: the cloth is turned over sideways, end 1 at the right
    Back,
    /// The whole cloth from above its lower edge
    Oblique,
    /// Some yarns, from near
    CloseUp,
    /// A cut through the ends, along a pick
    CutWarp,
    /// A cut through the picks, along an end
    CutWeft,
    /// The oblique view from all sides, as numbered pictures
    Turntable,
}

/// A size from its numbers.
pub(super) fn size(text: &str) -> Result<[u32; 2], String> {
    let (width, height) = text.split_once('x').ok_or("expected a width and a height, such as 1600x1200")?;
    let number = |text: &str| match text.parse() {
        Ok(number) if number > 0 => Ok(number),
        _ => Err(format!("\"{text}\" is not a number of pixels")),
    };
    Ok([number(width)?, number(height)?])
}

/// A background from its name or its colour.
fn background(text: &str) -> Result<Background, String> {
    let is_hexadecimal =
        |digits: &&str| digits.len() == 6 && digits.bytes().all(|byte| byte.is_ascii_hexdigit());
    let digits = text.strip_prefix('#').filter(is_hexadecimal);
    match (text, digits.and_then(|digits| u32::from_str_radix(digits, 16).ok())) {
        ("ground", _) => Ok(Background::Ground),
        ("none", _) => Ok(Background::Nothing),
        (_, Some(color)) => {
            let [_, red, green, blue] = color.to_be_bytes();
            Ok(Background::Color([red, green, blue]))
        }
        _ => Err("expected ground, none, or a colour such as #f4f1ea".into()),
    }
}
