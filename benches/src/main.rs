//! Measures devices. Compares them with their floor, which is a plain fill of as many bytes, times
//! them stage by stage, and sets their times beside the paper's tables and figures.

use std::error::Error;
use std::path::PathBuf;
use std::str::FromStr;

use clap::Parser;
use texere::DeviceKind;
use texere_bench::{crossings, edits, figure_7, floor, pictures, settling, stages, tables};

/// Measures devices.
#[derive(Debug, Parser)]
#[command(name = "texere-bench")]
enum Args {
    /// The mesh stage of GPU devices beside a plain fill of the same bytes
    Floor {
        /// GPU devices, such as opencl:0 or wgpu:0 [default: all that `texere devices` lists]
        devices: Vec<String>,
        #[command(flatten)]
        work: Work,
    },
    /// Settling: passes beside a plain fill of the bytes that they move, lists, and cloth until it
    /// rests
    Settling {
        /// Devices, such as cpu, opencl:0 or wgpu:0 [default: the CPU and all GPUs that
        /// `texere devices` lists]
        devices: Vec<String>,
        /// Wales and courses of knits with stitches missed at random
        #[arg(long, value_delimiter = ',', default_value = "60")]
        random: Vec<usize>,
        /// Wales and courses of lace, multiples of four
        #[arg(long, value_delimiter = ',', default_value = "200")]
        lace: Vec<usize>,
        /// Runs of each measurement
        #[arg(long, default_value_t = 5)]
        rounds: usize,
    },
    /// Crossings of Jacquards: passes beside a plain fill of the bytes that they move, and cloth
    /// until it rests
    Crossings {
        /// Devices, such as cpu, opencl:0 or wgpu:0 [default: all GPUs that `texere devices` lists]
        devices: Vec<String>,
        /// Ends x picks
        #[arg(long, value_delimiter = ',', default_value = "360x230,720x460,1440x920,2880x1840")]
        sizes: Vec<Size>,
        /// The most passes of a settling
        #[arg(long, default_value_t = 400)]
        passes: u32,
        /// Runs of each measurement
        #[arg(long, default_value_t = 5)]
        rounds: usize,
    },
    /// Edits of cloth whose mesh stays on its device, beside the whole mesh
    Edits {
        /// Devices, such as cpu, opencl:0 or wgpu:0 [default: the CPU and all GPUs that
        /// `texere devices` lists]
        devices: Vec<String>,
        /// Ends x picks of the cloth of which a yarn is edited
        #[arg(long, default_value = "489x450")]
        yarns: Size,
        /// Ends x picks of the cloth of which a lift is edited
        #[arg(long, default_value = "815x750")]
        lifts: Size,
        /// Runs of each measurement
        #[arg(long, default_value_t = 21)]
        rounds: usize,
    },
    /// From a design to its mesh in a device's memory, stage by stage
    Stages {
        /// .wif drafts, .toml designs or knitout programs
        #[arg(required = true)]
        designs: Vec<PathBuf>,
        /// The device, such as opencl:0
        #[arg(long, default_value = "wgpu:0")]
        device: String,
    },
    /// Pictures of a cloth, from all of it to some of its yarns
    Pictures {
        /// .wif drafts, .toml designs or knitout programs
        #[arg(required = true)]
        designs: Vec<PathBuf>,
        /// The device that draws, such as wgpu:1
        #[arg(long, default_value = "wgpu:0")]
        device: String,
        /// Width and height, pixels
        #[arg(long, default_value = "1600x1200")]
        size: Size,
        /// How many times nearer than a view of the whole cloth
        #[arg(long, value_delimiter = ',', default_value = "1,4,20,100,400")]
        nearer: Vec<f32>,
        /// Runs of each measurement
        #[arg(long, default_value_t = 11)]
        rounds: usize,
    },
    /// The paper's tables and figures, with texere's beside them
    Tables {
        /// Devices; the first is the reference [default: the CPU and all GPUs that `texere devices`
        /// lists, or software devices if there is none]
        #[arg(long = "device")]
        devices: Vec<String>,
        #[command(flatten)]
        work: Work,
        /// How the report was made, such as the command and the commit
        #[arg(long, default_value = "")]
        heading: String,
        /// The folder to write to
        #[arg(short, long, default_value = "target/tables")]
        output: PathBuf,
    },
    /// The paper's figure 5 of any designs: geometry, buffers and drawing, each alone, as a table
    /// and a plot
    #[command(name = "figure-5")]
    Figure5 {
        /// .wif drafts or .toml designs
        #[arg(required = true)]
        designs: Vec<PathBuf>,
        /// The device that draws, such as wgpu:1
        #[arg(long, default_value = "wgpu:0")]
        device: String,
        /// Width and height of the picture that is drawn, pixels
        #[arg(long, default_value = "1600x1200")]
        size: Size,
        /// The plot, an .svg file
        #[arg(short, long, default_value = "target/figure-5.svg")]
        output: PathBuf,
    },
    /// The paper's figure 7: its three cloths at full size, from the design to the picture, with
    /// the paper's time beside texere's
    #[command(name = "figure-7")]
    Figure7 {
        /// The device that settles, meshes and draws, such as wgpu:1
        #[arg(long, default_value = "wgpu:0")]
        device: String,
        /// The folder with the three designs
        #[arg(long, default_value = "designs/paper")]
        designs: PathBuf,
        /// The folder for pictures
        #[arg(short, long, default_value = "target/figure-7")]
        output: PathBuf,
    },
}

#[derive(Debug, clap::Args)]
struct Work {
    /// Cloths, ends x picks [default: the paper's; the two smallest if no device is a GPU]
    #[arg(long, value_delimiter = ',')]
    sizes: Vec<Size>,
    /// Runs of each measurement
    #[arg(long, default_value_t = 5)]
    rounds: usize,
}

/// Ends and picks, or width and height.
#[derive(Debug, Clone, Copy)]
struct Size(usize, usize);

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parsed =
            text.split_once('x').and_then(|(one, other)| Some((one.parse().ok()?, other.parse().ok()?)));
        parsed
            .map(|(one, other)| Self(one, other))
            .ok_or_else(|| format!("{text} is not two numbers, such as 489x450"))
    }
}

/// The sizes of the paper's cloths: those of its tables, and the largest that it shows.
const SIZES: [(usize, usize); 6] =
    [(163, 150), (489, 450), (815, 750), (1141, 1050), (1630, 1500), (2880, 1840)];

impl Work {
    /// The sizes of the cloths that `devices` are measured with.
    fn sizes(&self, devices: &[String]) -> Vec<(usize, usize)> {
        if !self.sizes.is_empty() {
            return self.sizes.iter().map(|size| (size.0, size.1)).collect();
        }
        let any_gpu = gpus().any(|gpu| devices.iter().any(|name| name.starts_with(&gpu)));
        SIZES[..if any_gpu { SIZES.len() } else { 2 }].to_vec()
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    match Args::parse() {
        Args::Floor { devices, work } => {
            let devices = if devices.is_empty() { gpus().collect() } else { devices };
            floor::print(&devices, &work.sizes(&devices), work.rounds)
        }
        Args::Settling { devices, random, lace, rounds } => {
            let devices = if devices.is_empty() {
                ["cpu".to_owned()].into_iter().chain(gpus()).collect()
            } else {
                devices
            };
            settling::print(&devices, &settling::Cloths { random, lace }, rounds)
        }
        Args::Crossings { devices, sizes, passes, rounds } => {
            let devices = if devices.is_empty() { gpus().collect() } else { devices };
            let sizes: Vec<_> = sizes.iter().map(|size| (size.0, size.1)).collect();
            crossings::print(&devices, &sizes, passes, rounds)
        }
        Args::Edits { devices, yarns, lifts, rounds } => {
            let devices = if devices.is_empty() {
                ["cpu".to_owned()].into_iter().chain(gpus()).collect()
            } else {
                devices
            };
            edits::print(&devices, (yarns.0, yarns.1), (lifts.0, lifts.1), rounds)
        }
        Args::Pictures { designs, device, size: Size(width, height), nearer, rounds } => {
            pictures::print(&designs, &device, [width.try_into()?, height.try_into()?], &nearer, rounds)
        }
        Args::Stages { designs, device } => {
            stages::print(&designs, &device)?;
            stages::print_one_yarn(&designs, &device)
        }
        Args::Tables { devices, work, heading, output } => {
            let devices = if devices.is_empty() { all_devices() } else { devices };
            tables::write(&devices, &work.sizes(&devices), work.rounds, &heading, &output)
        }
        Args::Figure7 { device, designs, output } => figure_7::print(&device, &designs, &output),
        Args::Figure5 { designs, device, size: Size(width, height), output } => {
            tables::figure_5(&designs, &device, [width.try_into()?, height.try_into()?], &output)
        }
    }
}

/// The devices that are GPUs.
fn gpus() -> impl Iterator<Item = String> {
    let is_gpu = |kind| matches!(kind, DeviceKind::DiscreteGpu | DeviceKind::IntegratedGpu);
    texere::devices().found.into_iter().filter(move |device| is_gpu(device.kind)).map(|device| device.name)
}

/// The serial reference, the parallel CPU backend, and each GPU with both schedules. If there is no
/// GPU, the software devices of OpenCL and wgpu take their place.
fn all_devices() -> Vec<String> {
    let mut others: Vec<_> = gpus().collect();
    if others.is_empty() {
        others.extend(texere::devices().found.into_iter().map(|device| device.name));
        others.retain(|name| name.contains(':'));
    }
    let others = others.into_iter().flat_map(|name| [name.clone(), format!("{name}/per-yarn")]);
    ["cpu-serial".to_owned(), "cpu".to_owned()].into_iter().chain(others).collect()
}
