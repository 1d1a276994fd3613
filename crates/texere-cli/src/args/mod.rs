//! The command line.

mod bake;
mod curves;
mod numbers;
mod path;
mod render;
mod settings;
mod settling;
#[cfg(feature = "view")]
mod view;

use std::path::PathBuf;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Parser, Subcommand, ValueEnum};
use texere::rest::Along;
use texere::write::VertexAttribute;

pub(crate) use bake::BakeArgs;
pub(crate) use curves::CurveArgs;
use numbers::point;
use path::{file_of, mesh_file};
pub(crate) use path::{is_curves, is_read_as_curves, is_yarns, says_thickness};
pub(crate) use render::{RenderArgs, View};
pub(crate) use settings::{SettingsArgs, undersampled};
pub(crate) use settling::SettlingArgs;
#[cfg(feature = "view")]
pub(crate) use view::ViewArgs;

/// Textile designs to yarn-level 3D geometry.
#[derive(Debug, Parser)]
#[command(name = "texere", version, after_help = EXIT_CODES)]
pub(crate) struct Args {
    #[command(subcommand)]
    pub(crate) command: Command,
}

const EXIT_CODES: &str = "Exit codes: 0 done; 1 a device, a file or memory failed; 2 the command line or the \
                          variable TEXERE_SIMD is wrong; 3 the design is wrong; 4 check found faults.";

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// List the devices that can do the work
    Devices(DevicesArgs),
    /// Say what a design makes: counts, sizes, yarn, weight, clearance, bends, warnings
    Inspect(InspectArgs),
    /// Say which faults a cloth has, where, and what would cure them
    Check(CheckArgs),
    /// Write a design's mesh to a .glb, .ply, .stl or .obj file, or its cloth at rest to a .yarns
    /// file
    Mesh(MeshArgs),
    /// Draw or print a design's draft, stitch chart or lappings
    Draft(DraftArgs),
    /// Write a design as a design file, a WIF draft or a knitout file
    Convert(ConvertArgs),
    /// Bake a design's cloth to maps that tile, with U3M and MaterialX documents
    Bake(BakeArgs),
    /// Make a picture of a design's cloth
    Render(RenderArgs),
    /// Strain a knit: how it pulls, how it gets narrower, and how thick it is
    Test(TestArgs),
    /// Show a design's cloth in a window, to turn, to edit, and to watch while its file changes
    #[cfg(feature = "view")]
    View(ViewArgs),
}

#[derive(Debug, clap::Args)]
pub(crate) struct DevicesArgs {
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, clap::Args)]
pub(crate) struct InspectArgs {
    /// A .toml design, a draft (.wif, .dtx, .wpo), a .k program of a knitting machine, a .yarns
    /// file of saved cloth, or a .bcc, .obj, .usda or .tg3 file of curves that another program
    /// wrote
    pub(crate) design: PathBuf,
    #[command(flatten)]
    pub(crate) curves: CurveArgs,
    #[command(flatten)]
    pub(crate) settings: SettingsArgs,
    #[command(flatten)]
    pub(crate) settling: SettlingArgs,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
    /// Only count, without measures, clearance and bends, which take seconds for millions of
    /// control points. Yarns do not settle
    #[arg(long, conflicts_with_all = ["settle", "settling_plot"])]
    pub(crate) counts: bool,
    /// Say which yarns lie under a point, the topmost first, and what made them. The point is given
    /// in mm from the cloth's left and lower edges
    #[arg(long, value_name = "X,Y", value_parser = point, allow_hyphen_values = true)]
    pub(crate) at: Option<[f32; 2]>,
}

#[derive(Debug, clap::Args)]
pub(crate) struct CheckArgs {
    /// A .toml design, a draft (.wif, .dtx, .wpo), a .k program of a knitting machine, a .yarns
    /// file of saved cloth, or a .bcc, .obj, .usda or .tg3 file of curves that another program
    /// wrote
    pub(crate) design: PathBuf,
    #[command(flatten)]
    pub(crate) curves: CurveArgs,
    /// How much nearer than touching two yarns may come before they count as piercing, as a share
    /// of the distance at which they touch. Between control points that are placed to touch, yarns
    /// come as near as 0.99 of that distance
    #[arg(long, value_name = "SHARE", default_value_t = 0.015, value_parser = share)]
    pub(crate) accuracy: f64,
    #[command(flatten)]
    pub(crate) settling: SettlingArgs,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// The extension of glTF that a file is compressed with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Meshopt {
    /// EXT_meshopt_compression, which most programs know
    Ext,
    /// KHR_meshopt_compression, whose files are smaller
    Khr,
}

#[derive(Debug, clap::Args)]
pub(crate) struct MeshArgs {
    /// A .toml design, a draft (.wif, .dtx, .wpo), a .k program of a knitting machine, a .yarns
    /// file of saved cloth, or a .bcc, .obj, .usda or .tg3 file of curves that another program
    /// wrote
    pub(crate) design: PathBuf,
    /// The file to write: .glb, .ply, .stl or .obj for a mesh, .usda with --triangles; .bcc or
    /// .usda for the yarns' centrelines, as curves for other programs; .yarns saves the cloth at
    /// rest, which need not settle again
    #[arg(short, long, value_name = "FILE", value_parser = mesh_file())]
    pub(crate) output: PathBuf,
    /// The device that does the work: a name that `texere devices` lists, or auto, cpu, opencl,
    /// wgpu:nvidia, opencl:0/per-yarn
    #[arg(long, default_value = "auto")]
    pub(crate) device: String,
    /// Write a .glb with half the bytes for a vertex: whole numbers, as the extension
    /// KHR_mesh_quantization allows. Positions are off by 1/131068 of the largest side of the
    /// yarn's box at most
    #[arg(long)]
    pub(crate) packed: bool,
    /// Write a packed .glb that is compressed to about half of its bytes with the extension
    /// EXT_meshopt_compression, or with --compressed=khr to a little less with
    /// KHR_meshopt_compression. Programs that don't know the extension refuse the file
    #[arg(long, value_name = "EXTENSION", num_args = 0..=1, require_equals = true, default_missing_value = "ext")]
    #[arg(conflicts_with = "packed")]
    pub(crate) compressed: Option<Meshopt>,
    /// Write a .glb that holds each part of a yarn once, and the places at which the part recurs,
    /// as the extension EXT_mesh_gpu_instancing says. A part is a cap, or at most 16 intervals
    /// between control points long. Programs that don't know the extension refuse the file
    #[arg(long, conflicts_with_all = ["packed", "compressed", "attributes"])]
    pub(crate) instanced: bool,
    /// Give the vertices of a .glb, a .ply or a .usda mesh attributes, with commas between: uv is
    /// the share of a turn round the yarn and the mm along it, tangent the direction along the
    /// yarn, yarn the yarn's number, counted from 0. An .obj holds uv alone, which it always has
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = vertex_attribute())]
    pub(crate) attributes: Vec<VertexAttribute>,
    /// Write the curves of a .usda file as straight lines between control points, with thickness
    /// and mass, for simulators that read no other curves
    #[arg(long, conflicts_with_all = ["packed", "compressed", "instanced", "triangles"])]
    pub(crate) linear: bool,
    /// Write triangles into a .usda file, a mesh for each yarn, instead of curves. Other files of
    /// meshes always hold triangles
    #[arg(long)]
    pub(crate) triangles: bool,
    #[command(flatten)]
    pub(crate) curves: CurveArgs,
    #[command(flatten)]
    pub(crate) settings: SettingsArgs,
    #[command(flatten)]
    pub(crate) settling: SettlingArgs,
}

#[derive(Debug, clap::Args)]
pub(crate) struct DraftArgs {
    /// A .toml design, a draft (.wif, .dtx, .wpo), or a .k program of a knitting machine
    pub(crate) design: PathBuf,
    /// The picture to write, a .png file. It shows threading, tie-up, treadling and drawdown of a
    /// woven design, or the point paper if there is no shaft draft. It shows stitch chart and
    /// needle diagram of a weft knit, and the lappings of a warp knit
    #[arg(short, long, value_name = "FILE", value_parser = file_of(&["png"]))]
    pub(crate) output: Option<PathBuf>,
    /// Print a row for each pick, the last pick first: 1 where the warp is on top, 0 where the weft
    /// is, end 1 on the left. A weft knit has a row for each course, in the symbols of its charts,
    /// and a warp knit a row for each guide bar
    #[arg(long, required_unless_present = "output")]
    pub(crate) text: bool,
    /// Show the back of the cloth, turned over sideways: end 1 on the right
    #[arg(long)]
    pub(crate) back: bool,
}

#[derive(Debug, clap::Args)]
pub(crate) struct ConvertArgs {
    /// A .toml design, a draft (.wif, .dtx, .wpo) or a knitout program (.k)
    pub(crate) design: PathBuf,
    /// The file to write: .toml, which holds woven cloth without its shaft draft, knits from charts
    /// and pictures, and warp knits without a Jacquard bar; .wif, which other weaving programs
    /// read; or .k, for knits that came from a knitout program
    #[arg(value_name = "OUTPUT", value_parser = file_of(&["wif", "toml", "k", "knitout"]))]
    pub(crate) output: PathBuf,
}

#[derive(Debug, clap::Args)]
pub(crate) struct TestArgs {
    /// A .toml design of a knit or a warp knit that repeats
    pub(crate) design: PathBuf,
    /// The ways to strain it, with commas between: courses makes it wider, wales makes it longer,
    /// and both does both by the same strain
    #[arg(long, value_name = "WAYS", value_delimiter = ',', default_value = "courses,wales", value_parser = along)]
    pub(crate) along: Vec<Along>,
    /// The greatest strain, as a share of the size at rest
    #[arg(long, value_name = "STRAIN", default_value_t = 0.4, value_parser = strain)]
    pub(crate) to: f64,
    /// How many strained states are measured, up to the greatest strain, beside the one at rest
    #[arg(long, value_name = "COUNT", default_value_t = 8, value_parser = clap::value_parser!(u16).range(1..=1000))]
    pub(crate) states: u16,
    /// Write all states to a .csv file, too
    #[arg(short, long, value_name = "FILE", value_parser = file_of(&["csv"]))]
    pub(crate) output: Option<PathBuf>,
    /// Draw the forces over the strains to a .svg file, too
    #[arg(long, value_name = "FILE", value_parser = file_of(&["svg"]))]
    pub(crate) plot: Option<PathBuf>,
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// A way along which a knit is strained, from its name.
fn along(text: &str) -> Result<Along, String> {
    Along::named(text).ok_or_else(|| "expected courses, wales or both".into())
}

/// A greatest strain from its number.
fn strain(text: &str) -> Result<f64, String> {
    let strain = text.parse().ok().filter(|strain| *strain > 0.0 && *strain <= 5.0);
    strain.ok_or_else(|| "expected a number above 0 and up to 5".into())
}

/// The parser of a vertex attribute's name.
fn vertex_attribute() -> impl TypedValueParser<Value = VertexAttribute> {
    let unknown = "there is no such attribute";
    PossibleValuesParser::new(VertexAttribute::ALL.map(VertexAttribute::name))
        .try_map(move |name| VertexAttribute::named(&name).ok_or(unknown))
}

/// A number from 0 to below 1.
fn share(text: &str) -> Result<f64, String> {
    let share = text.parse().ok().filter(|share| (0.0..1.0).contains(share));
    share.ok_or_else(|| "expected a number from 0 to below 1".into())
}
