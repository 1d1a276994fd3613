//! The command line.

use std::path::PathBuf;

use clap::builder::{PathBufValueParser, TypedValueParser};
use clap::{Parser, Subcommand, ValueEnum};
use texere::{Format, Frame, Section, Settings, Topology};

/// Textile designs to yarn-level 3D geometry.
#[derive(Debug, Parser)]
#[command(name = "texere", version, after_help = EXIT_CODES)]
pub(crate) struct Args {
    #[command(subcommand)]
    pub(crate) command: Command,
}

const EXIT_CODES: &str = "Exit codes: 0 done; 1 a device, a file or memory failed; 2 the command line or the \
                          variable TEXERE_SIMD is wrong; 3 the design is wrong; 4 check found that the cloth pierces itself, folds or jams.";

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// List the devices that can do the work
    Devices(DevicesArgs),
    /// Say what a design makes: counts, sizes, yarn, weight, clearance, bends, warnings
    Inspect(InspectArgs),
    /// Say whether a cloth pierces itself, folds or jams, where, and what would cure it
    Check(CheckArgs),
    /// Write a design's mesh to a .glb or .ply file
    Mesh(MeshArgs),
    /// Draw a woven design's draft, or print its drawdown
    Draft(DraftArgs),
    /// Make a picture of a design's cloth
    Render(crate::render::RenderArgs),
}

#[derive(Debug, clap::Args)]
pub(crate) struct DevicesArgs {
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, clap::Args)]
pub(crate) struct InspectArgs {
    /// A .wif draft or a .toml design
    pub(crate) design: PathBuf,
    #[command(flatten)]
    pub(crate) settings: SettingsArgs,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
    /// Count alone, without measures, clearance and bends, which take seconds where there are millions of control points
    #[arg(long)]
    pub(crate) counts: bool,
}

#[derive(Debug, clap::Args)]
pub(crate) struct CheckArgs {
    /// A .wif draft or a .toml design
    pub(crate) design: PathBuf,
    /// How far short of touching, as a share, yarns may come and still count as touching. Where yarns touch by
    /// construction the spline between their control points comes out at 0.99 of it
    #[arg(long, value_name = "SHARE", default_value_t = 0.015, value_parser = share)]
    pub(crate) accuracy: f64,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, clap::Args)]
pub(crate) struct MeshArgs {
    /// A .wif draft or a .toml design
    pub(crate) design: PathBuf,
    /// The file to write: .glb or .ply
    #[arg(short, long, value_name = "FILE", value_parser = PathBufValueParser::new().try_map(mesh_file))]
    pub(crate) output: PathBuf,
    /// The device that does the work: a name that `texere devices` lists, or auto, cpu, opencl, wgpu:nvidia, opencl:0/per-yarn
    #[arg(long, default_value = "auto")]
    pub(crate) device: String,
    #[command(flatten)]
    pub(crate) settings: SettingsArgs,
}

#[derive(Debug, clap::Args)]
pub(crate) struct DraftArgs {
    /// A .wif draft or a .toml design
    pub(crate) design: PathBuf,
    /// The picture to write, a .png file: threading, tie-up, treadling and drawdown, or the point paper where there is no
    /// shaft draft
    #[arg(short, long, value_name = "FILE", value_parser = file_of("png"))]
    pub(crate) output: Option<PathBuf>,
    /// Print a row for each pick, the last pick first: 1 where the warp is on top, 0 where the weft is, end 1 on the left
    #[arg(long, required_unless_present = "output")]
    pub(crate) text: bool,
    /// Show the back of the cloth, turned over sideways: end 1 on the right
    #[arg(long)]
    pub(crate) back: bool,
}

/// What can be chosen about a mesh.
#[derive(Debug, clap::Args)]
pub(crate) struct SettingsArgs {
    /// Points inserted between two control points
    #[arg(long, value_name = "K", default_value_t = Settings::default().subdivisions)]
    subdivisions: u32,
    /// Sides of the tube
    #[arg(long, value_name = "NC", default_value_t = Settings::default().sides)]
    sides: u32,
    /// Tension of the spline, 0 to below 1
    #[arg(long, value_name = "U", default_value_t = Settings::default().tension)]
    tension: f32,
    /// One section for all yarns: circle, ellipse:ASPECT, lenticular:ASPECT, power-ellipse:ASPECT:EXPONENT, lobed:PLIES
    #[arg(long, value_parser = section)]
    pub(crate) section: Option<Section>,
    /// Which way round sections stand along the yarn
    #[arg(long, value_enum, default_value_t = FrameArg::Upright)]
    frame: FrameArg,
    /// How triangles are told in memory, which decides the bytes that `inspect` states; files hold the same triangles
    /// whichever
    #[arg(long, value_enum, default_value_t = TopologyArg::Indexed)]
    topology: TopologyArg,
    /// Close the ends of yarns; pictures always do
    #[arg(long)]
    caps: bool,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum FrameArg {
    Upright,
    RotationMinimizing,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum TopologyArg {
    Indexed,
    Shared,
    None,
}

impl SettingsArgs {
    pub(crate) fn settings(&self) -> Settings {
        Settings {
            tension: self.tension,
            subdivisions: self.subdivisions,
            sides: self.sides,
            frame: match self.frame {
                FrameArg::Upright => Frame::Upright,
                FrameArg::RotationMinimizing => Frame::RotationMinimizing,
            },
            topology: match self.topology {
                TopologyArg::Indexed => Topology::Indexed,
                TopologyArg::Shared => Topology::Shared,
                TopologyArg::None => Topology::None,
            },
            caps: self.caps,
        }
    }
}

/// A path with the ending of a mesh file.
fn mesh_file(path: PathBuf) -> Result<PathBuf, String> {
    Format::from_path(&path).map(|_| path).map_err(|error| error.to_string())
}

/// A path with this `ending`, in upper or lower case.
pub(crate) fn file_of(ending: &'static str) -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().try_map(move |path| {
        if path.extension().is_some_and(|given| given.eq_ignore_ascii_case(ending)) {
            Ok(path)
        } else {
            Err(format!("{} does not end in .{ending}", path.display()))
        }
    })
}

/// A number from 0 to below 1.
fn share(text: &str) -> Result<f64, String> {
    let share = text.parse().ok().filter(|share| (0.0..1.0).contains(share));
    share.ok_or_else(|| "expected a number from 0 to below 1".into())
}

/// A section from its name and its numbers, separated by colons.
fn section(text: &str) -> Result<Section, String> {
    let mut parts = text.split(':');
    let name = parts.next().unwrap_or_default();
    let numbers: Vec<f32> = parts
        .map(|part| part.parse().map_err(|_| format!("\"{part}\" is not a number")))
        .collect::<Result<_, _>>()?;
    let section = match (name, &numbers[..]) {
        ("circle", []) => Section::Circle,
        ("ellipse", &[aspect]) => Section::Ellipse { aspect },
        ("lenticular", &[aspect]) => Section::Lenticular { aspect, distortion: 0.0 },
        ("lenticular", &[aspect, distortion]) => Section::Lenticular { aspect, distortion },
        ("power-ellipse", &[aspect, exponent]) => Section::PowerEllipse { aspect, exponent },
        ("lobed", &[plies]) if plies.fract() == 0.0 && plies >= 0.0 => Section::Lobed { plies: plies as u32 },
        _ => {
            return Err("expected circle, ellipse:ASPECT, lenticular:ASPECT[:DISTORTION], \
                        power-ellipse:ASPECT:EXPONENT or lobed:PLIES"
                .into());
        }
    };
    section.validate().map_err(|error| error.to_string())?;
    Ok(section)
}
