//! What can be chosen about a mesh.

use clap::ValueEnum;
use texere::{Frame, Section, Settings, Topology};

/// What can be chosen about a mesh.
#[derive(Debug, clap::Args)]
pub(crate) struct SettingsArgs {
    /// Points inserted between two control points
    #[arg(long, value_name = "K", default_value_t = Settings::default().subdivisions)]
    subdivisions: u32,
    /// Sides of the tube; if left out 6, or 16 in a picture of woven cloth at rest of up to four million control points
    #[arg(long, value_name = "NC")]
    pub(crate) sides: Option<u32>,
    /// Tension of the spline, 0 to below 1
    #[arg(long, value_name = "U", default_value_t = Settings::default().tension)]
    tension: f32,
    /// One section for all yarns: circle, ellipse:ASPECT, lenticular:ASPECT, power-ellipse:ASPECT:EXPONENT, lobed:PLIES
    #[arg(long, value_parser = section)]
    pub(crate) section: Option<Section>,
    /// Which way round sections stand along the yarn: upright, or carried along without turning; yarns too steep to stand upright, as
    /// those of knits are, are carried along in either case
    #[arg(long, value_enum, default_value_t = FrameArg::Upright)]
    frame: FrameArg,
    /// How triangles are encoded in memory, which decides the bytes that `inspect` states; files hold the same triangles
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
            sides: self.sides.unwrap_or(Settings::default().sides),
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
            // No file has packed vertices.
            ..Settings::default()
        }
    }
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
