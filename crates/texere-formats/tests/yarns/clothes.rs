//! Yarns of every kind.

use std::io::ErrorKind;

use texere_core::{Boundary, ControlPoint, Ends, Material, Origin, Section, Yarn, Yarns};
use texere_cpu::ParallelBackend;
use texere_formats::{Design, read_from};

/// A poplin of two-ply and lenticular yarns, so dense that its threads flatten.
pub(crate) const POPLIN: &str = "weave = { notation = \"plain\", ends = 6, picks = 5 }\n\
    yarns.white = { diameter_mm = 0.143, plies = 2, twist_per_m = 800, color = \"#f0ede4\" }\n\
    yarns.blue = { tex = 14.0, section = { shape = \"lenticular\", aspect = 1.5 } }\n\
    warp = { yarns = [\"white\", \"blue\"], spacing_mm = 0.19 }\nweft = { yarns = [\"white\"], spacing_mm = 0.35 }\n";

pub(crate) const JERSEY: &str = "[knit]\nchart = \"\"\"\nkktk\nkkkk\n\"\"\"\nrepeat = [2, 1]\nyarns = [\"a\"]\n\
    wales_per_cm = 8\ncourses_per_cm = 10\n[finish]\nsettle = false\n[yarns.a]\ndiameter_mm = 0.2\n";

pub(crate) const TRICOT: &str = "[warp_knit]\nwales = 4\ncourses = 4\nwales_per_cm = 10\ncourses_per_cm = 13\n\
    [[warp_knit.bars]]\nlapping = \"1-0/1-2//\"\n[[warp_knit.bars]]\nlapping = \"2-3/1-0//\"\n\
    [finish]\nsettle = false\n[yarns.a]\ndiameter_mm = 0.1\n";

pub(crate) fn design(text: &str) -> Design {
    read_from("cloth.toml", text, |_| Err(ErrorKind::NotFound.into())).unwrap()
}

/// The yarns of a design: at rest, or as placed if the design does not settle.
pub(crate) fn cloth(text: &str) -> Yarns {
    design(text).rest(&ParallelBackend::open().unwrap()).run().unwrap().into_parts().1
}

/// One repeat of a knit, with its boundary.
pub(crate) fn repeat(text: &str) -> (Yarns, Boundary) {
    let piece = design(text).structure.repeat().unwrap().piece;
    (piece.yarns, piece.boundary)
}

/// Yarns with every kind of origin, section and end, odd materials, and sources. Among them are a
/// ring, a ribbon with its own outline, and a loop that goes on in the next repeat.
pub(crate) fn odd() -> (Yarns, Boundary) {
    let mut yarns = Yarns::builder();
    for (name, tex, hairiness) in [
        ("", None, 0.0),
        ("Wolle \u{1f411}\n\"x\"", Some(30.5), 6.25),
        ("nul\0", Some(f32::from_bits(1)), 30.0),
    ] {
        let srgb = [0, 127, 255];
        yarns.material(Material { name: name.into(), srgb, tex, hairiness, bending: None });
    }
    for section in [
        Section::Circle,
        Section::Ellipse { aspect: 0.1 + 0.2 },
        Section::Lenticular { aspect: 2.0, distortion: -0.3 },
        Section::PowerEllipse { aspect: 1.7, exponent: 0.6 },
        Section::plied(5),
        Section::Polygon(vec![[1.0, -0.5], [1.0, 0.5], [-1.0, 0.5], [-1.0, -0.5], [-0.0, -0.7]]),
    ] {
        yarns.section(section);
    }
    let origins = [
        Origin::Unknown,
        Origin::End(1),
        Origin::Pick(u32::MAX),
        Origin::Course(7),
        Origin::Carrier(3),
        Origin::Guide { bar: 2, guide: 40 },
    ];
    let mut ends = Vec::new();
    for (number, origin) in (0..).zip(origins) {
        let how = [Ends::Open, Ends::Closed, Ends::Repeats([1, -2])][number as usize % 3];
        let count = 4 + number;
        let points: Vec<_> = (0..count)
            .map(|point| {
                let (sin, cos) = (point as f32 / count as f32 * std::f32::consts::TAU).sin_cos();
                let z = if point == 0 { -0.0 } else { number as f32 + 0.1 * sin };
                ControlPoint::new(cos, sin, z, 0.1).flattened(0.15, 0.07 + 0.01 * cos)
            })
            .collect();
        let (closed, twist) = (how == Ends::Closed, [0.0, -0.0, 4.75][number as usize % 3]);
        yarns.yarn(Yarn { material: number % 3, section: number, closed, twist, origin }, &points);
        ends.push(how);
    }
    let yarns = yarns.build().unwrap();
    let sources = (0..yarns.points().len() as u32).map(|point| point.wrapping_mul(0x9e37_79b9)).collect();
    let yarns = yarns.with_sources(sources).unwrap();
    let boundary = Boundary::new(yarns.layout(), [3.25, 2.5], ends).unwrap();
    (yarns, boundary)
}

/// `yarns`, bent around a cylinder, so that each point has an up direction of its own.
pub(crate) fn bent(yarns: &Yarns) -> Yarns {
    let round = |[x, y, z]: [f64; 3]| {
        let (sin, cos) = (x / 9.0).sin_cos();
        [(9.0 + z) * sin, y, (9.0 + z) * cos]
    };
    yarns.mapped(round).unwrap()
}
