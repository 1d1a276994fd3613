//! What devices reach: against their floor, and beside the paper's tables.

use std::error::Error;
use std::path::PathBuf;
use std::str::FromStr;

use clap::Parser;
use texere_bench::{floor, tables};

/// Measures devices.
#[derive(Debug, Parser)]
#[command(name = "texere-bench")]
enum Args {
    /// The mesh stage of GPU devices against a plain fill of the same bytes, side by side
    Floor {
        /// GPU devices, such as opencl:0 or wgpu:0
        #[arg(required = true)]
        devices: Vec<String>,
        #[command(flatten)]
        work: Work,
    },
    /// The paper's tables and figures, with ours beside them
    Tables {
        /// Devices [default: all that `texere devices` lists, GPUs with either schedule; the first is compared with]
        #[arg(long = "device")]
        devices: Vec<String>,
        #[command(flatten)]
        work: Work,
        /// The folder to write to
        #[arg(short, long, default_value = "target/tables")]
        output: PathBuf,
    },
}

#[derive(Debug, clap::Args)]
struct Work {
    /// Cloths, ends x picks
    #[arg(long, value_delimiter = ',', default_value = "163x150,489x450,815x750,1141x1050,1630x1500")]
    sizes: Vec<Size>,
    /// Runs of each
    #[arg(long, default_value_t = 5)]
    rounds: usize,
}

/// Ends and picks.
#[derive(Debug, Clone, Copy)]
struct Size(usize, usize);

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parsed =
            text.split_once('x').and_then(|(ends, picks)| Some((ends.parse().ok()?, picks.parse().ok()?)));
        parsed.map(|(ends, picks)| Self(ends, picks)).ok_or_else(|| format!("{text} is not ENDSxPICKS"))
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let sizes = |work: &Work| work.sizes.iter().map(|size| (size.0, size.1)).collect::<Vec<_>>();
    match Args::parse() {
        Args::Floor { devices, work } => floor::print(&devices, &sizes(&work), work.rounds),
        Args::Tables { devices, work, output } => {
            let devices = if devices.is_empty() { all_devices() } else { devices };
            tables::write(&devices, &sizes(&work), work.rounds, &output)
        }
    }
}

/// The serial reference first, then all others; GPUs with either schedule.
fn all_devices() -> Vec<String> {
    let mut names = vec!["cpu-serial".to_owned(), "cpu".to_owned()];
    for device in texere::devices().found {
        if !names.contains(&device.name) {
            names.extend([device.name.clone(), format!("{}/per-yarn", device.name)]);
        }
    }
    names
}
