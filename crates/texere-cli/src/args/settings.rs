//! What can be chosen about a mesh.

use clap::ValueEnum;
use texere::mesh::{Frame, Topology, Undersampled};
use texere::yarn::Section;
use texere::{Settings, Yarns};

/// What can be chosen about a mesh.
#[derive(Debug, clap::Args)]
pub(crate) struct SettingsArgs {
    /// Points inserted between two control points. If left out, 1, or up to 63 if twist would turn
    /// a section too far from ring to ring. The limit is 90 degrees for round yarns in meshes, and
    /// 30 degrees for other yarns and in pictures
    #[arg(long, value_name = "K")]
    pub(crate) subdivisions: Option<u32>,
    /// Sides of the tube. If left out, 6, or 16 in a picture of woven cloth at rest with up to four
    /// million control points. The tube of a polygon has a side for each corner
    #[arg(long, value_name = "NC")]
    pub(crate) sides: Option<u32>,
    /// Tension of the spline, 0 to below 1. If left out, 0, or the tension of saved yarns
    #[arg(long, value_name = "U")]
    tension: Option<f32>,
    /// One section for all yarns: circle, ellipse:ASPECT, lenticular:ASPECT,
    /// lenticular:ASPECT:DISTORTION, power-ellipse:ASPECT:EXPONENT, lobed:PLIES,
    /// lobed:PLIES:VALLEY
    #[arg(long, value_parser = section)]
    pub(crate) section: Option<Section>,
    /// How sections stand along the yarn: upright, which is the default, or carried along without
    /// turning. Yarns too steep to stand upright, such as loops of knits, are carried along in
    /// either case
    #[arg(long, value_enum)]
    frame: Option<FrameArg>,
    /// How triangles are encoded in memory, which decides the bytes that `inspect` prints; indexed
    /// if left out. Files hold the same triangles with each encoding
    #[arg(long, value_enum)]
    topology: Option<TopologyArg>,
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
    /// The tension of the yarns' splines, which is their `own` if the command line gives no other.
    pub(crate) fn tension(&self, own: f32) -> f32 {
        self.tension.unwrap_or(own)
    }

    /// The first option given that yarns without a mesh can't show, if there is one.
    pub(crate) fn of_a_mesh(&self) -> Option<&'static str> {
        let given = [
            ("--subdivisions", self.subdivisions.is_some()),
            ("--sides", self.sides.is_some()),
            ("--frame", self.frame.is_some()),
            ("--topology", self.topology.is_some()),
            ("--caps", self.caps),
        ];
        given.into_iter().find_map(|(option, is_given)| is_given.then_some(option))
    }

    /// The settings before the yarns are known.
    pub(crate) fn settings(&self) -> Settings {
        Settings {
            subdivisions: self.subdivisions.unwrap_or(Settings::default().subdivisions),
            sides: self.sides.unwrap_or(Settings::default().sides),
            frame: match self.frame {
                None | Some(FrameArg::Upright) => Frame::Upright,
                Some(FrameArg::RotationMinimizing) => Frame::RotationMinimizing,
            },
            topology: match self.topology {
                None | Some(TopologyArg::Indexed) => Topology::Indexed,
                Some(TopologyArg::Shared) => Topology::Shared,
                Some(TopologyArg::None) => Topology::None,
            },
            caps: self.caps,
            // The quantum is for packed vertices in memory, and no file is written from these.
            ..Settings::default()
        }
    }

    /// The settings for a mesh of `yarns`.
    pub(crate) fn of(&self, yarns: &Yarns) -> Settings {
        let sides = self.sides.or_else(|| yarns.layout().corners());
        let settings = self.settings();
        let settings = Settings { sides: sides.unwrap_or(settings.sides), ..settings };
        if self.subdivisions.is_some() { settings } else { settings.following(yarns) }
    }

    /// The settings for a picture of `yarns`. `lies_close` is whether they are flattened threads of
    /// woven cloth at rest, see [`texere::picture::picture_sides`].
    pub(crate) fn of_picture(&self, yarns: &Yarns, lies_close: bool) -> Settings {
        let sides = self.sides.unwrap_or_else(|| texere::picture::picture_sides(yarns, lies_close));
        let settings = Settings { sides, ..self.settings() };
        if self.subdivisions.is_some() { settings } else { settings.following_fibres(yarns) }
    }
}

/// A warning if a mesh of `yarns` has too few rings to show their twist, otherwise none.
pub(crate) fn undersampled(yarns: &Yarns, settings: &Settings) -> Option<String> {
    Undersampled::of(yarns, settings).map(|found| found.to_string())
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
        ("lobed", &[plies]) if plies.fract() == 0.0 && plies >= 0.0 => Section::plied(plies as u32),
        ("lobed", &[plies, valley]) if plies.fract() == 0.0 && plies >= 0.0 => {
            Section::Lobed { plies: plies as u32, valley }
        }
        _ => {
            return Err("expected circle, ellipse:ASPECT, lenticular:ASPECT[:DISTORTION], \
                        power-ellipse:ASPECT:EXPONENT or lobed:PLIES[:VALLEY]"
                .into());
        }
    };
    section.validate().map_err(|error| error.to_string())?;
    Ok(section)
}
