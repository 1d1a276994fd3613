//! The constants of kernels and shaders, taken from the core.

use std::f32::consts::TAU;
use std::fmt::Write;

use texere_core::backend::BLOCK_RINGS;
use texere_core::definitions::{
    ARC_EVEN, ARC_NODES, ARC_PANELS, ARC_WEIGHTS, ARCTANGENT, COSINE, NO_LENGTH, NO_MIRROR, RADIUS_FLOOR,
    SINE, SLOPE_LIMIT, TAN_EIGHTH, Turn, VERTICAL, ZERO_VELOCITY,
};
use texere_core::{ArcLength, Frame, PackedVertex, Quantum, crossings, settling};

use crate::crossings::{CrossingSite, CrossingsParams};
use crate::settling::{SettlingParams, UNSEEN};

/// A language of device code.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Language {
    /// OpenCL C, the language of texere-kernels.
    OpenClC,
    /// WGSL, the language of texere-shaders.
    Wgsl,
}

/// The value of a [`Constant`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Value {
    /// An `f32`.
    Float(f32),
    /// A `u32`.
    Integer(u32),
}

/// A constant that has the same name in kernels and shaders.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constant {
    /// The constant's name in both languages.
    pub name: &'static str,
    /// The constant's value.
    pub value: Value,
}

const fn float(name: &'static str, value: f32) -> Constant {
    Constant { name, value: Value::Float(value) }
}

const fn integer(name: &'static str, value: u32) -> Constant {
    Constant { name, value: Value::Integer(value) }
}

/// The constants of meshes. All but `FULL_TURN`, which is 2π, have values of the core. The number
/// at the end of a name is the power for `SINE`, `COSINE` and `ARCTANGENT`, and counts elements for
/// `ARC_NODE` and `ARC_WEIGHT`.
pub const CONSTANTS: [Constant; 38] = [
    integer("BLOCK_RINGS", BLOCK_RINGS),
    float("TURN_STEPS", Turn::STEPS),
    float("RADIANS_PER_STEP", Turn::RADIANS_PER_STEP),
    float("SINE_3", SINE[0]),
    float("SINE_5", SINE[1]),
    float("SINE_7", SINE[2]),
    float("COSINE_4", COSINE[0]),
    float("COSINE_6", COSINE[1]),
    float("COSINE_8", COSINE[2]),
    float("TAN_EIGHTH", TAN_EIGHTH),
    float("ARCTANGENT_1", ARCTANGENT[0]),
    float("ARCTANGENT_3", ARCTANGENT[1]),
    float("ARCTANGENT_5", ARCTANGENT[2]),
    float("ARCTANGENT_7", ARCTANGENT[3]),
    float("ARCTANGENT_9", ARCTANGENT[4]),
    float("ZERO_VELOCITY", ZERO_VELOCITY),
    float("NO_LENGTH", NO_LENGTH),
    float("SLOPE_LIMIT", SLOPE_LIMIT),
    float("RADIUS_FLOOR", RADIUS_FLOOR),
    float("VERTICAL", VERTICAL),
    float("NO_MIRROR", NO_MIRROR),
    integer("ROTATION_MINIMIZING", Frame::RotationMinimizing as u32),
    float("ARC_NODE_1", ARC_NODES[0]),
    float("ARC_NODE_2", ARC_NODES[1]),
    float("ARC_NODE_3", ARC_NODES[2]),
    float("ARC_NODE_4", ARC_NODES[3]),
    float("ARC_WEIGHT_1", ARC_WEIGHTS[0]),
    float("ARC_WEIGHT_2", ARC_WEIGHTS[1]),
    float("ARC_WEIGHT_3", ARC_WEIGHTS[2]),
    float("ARC_WEIGHT_4", ARC_WEIGHTS[3]),
    float("ARC_EVEN", ARC_EVEN),
    integer("ARC_PANELS", ARC_PANELS),
    float("LENGTH_STEPS", ArcLength::STEPS),
    float("LENGTH_MM_MAX", ArcLength::MM_MAX),
    float("FULL_TURN", TAU),
    integer("COORDINATE_BITS", Quantum::BITS),
    float("QUANTA_WRAP", Quantum::WRAP),
    float("NORMAL_STEPS", PackedVertex::NORMAL_STEPS),
];

/// The constants of settling by contacts, which are also written before all sources. `UNSEEN` and
/// the flags `LENGTHS_FREE` and `PLATES` belong to the tables of settling. All others are constants
/// of the core.
pub const SETTLING_CONSTANTS: [Constant; 41] = [
    float("MARGIN", settling::MARGIN),
    float("NEAR", settling::NEAR),
    float("SHORT", settling::SHORT),
    float("PARALLEL", settling::PARALLEL),
    float("STIFF", settling::STIFF),
    float("SKEW", settling::SKEW),
    float("ONE_PLACE", settling::ONE_PLACE),
    float("SKIN", settling::SKIN),
    float("LEADS_ON", settling::LEADS_ON),
    float("STRIDE", settling::STRIDE),
    float("CONTACT", settling::CONTACT),
    float("BEND", settling::BEND),
    float("BLOCK_BEND", settling::BLOCK_BEND),
    float("BEND_RADIUS", settling::BEND_RADIUS),
    float("BEND_MARGIN", settling::BEND_MARGIN),
    float("SOFT_BEND", settling::SOFT_BEND),
    float("CONTACTS_MIN", settling::CONTACTS_MIN),
    float("BENDS_MIN", settling::BENDS_MIN),
    float("CROSSING", settling::CROSSING),
    float("CROSSING_SHARE", settling::CROSSING_SHARE),
    float("STEP_NEAR", settling::STEP_NEAR),
    float("STEP_DIAMETER", settling::STEP_DIAMETER),
    float("INERTIA", settling::INERTIA),
    float("PRESS", settling::PRESS),
    float("FREED", settling::FREED),
    float("FREE_LEAST", settling::FREE_LEAST),
    float("FREE_MOST", settling::FREE_MOST),
    float("GAUSS_1", settling::GAUSS[0]),
    float("GAUSS_2", settling::GAUSS[1]),
    float("GAUSS_3", settling::GAUSS[2]),
    float("GAUSS_OUTER", settling::GAUSS_WEIGHTS[0]),
    float("GAUSS_MIDDLE", settling::GAUSS_WEIGHTS[1]),
    float("UNSEEN", UNSEEN),
    integer("BEND_PARTS", settling::BEND_PARTS),
    integer("TAG_POINT", settling::tag::POINT),
    integer("TAG_INTERVAL", settling::tag::INTERVAL),
    integer("TAG_OPENS", settling::tag::OPENS),
    integer("TAG_ENDS", settling::tag::ENDS),
    integer("TAG_PINNED", settling::tag::PINNED),
    integer("LENGTHS_FREE", SettlingParams::FREE),
    integer("PLATES", SettlingParams::PLATES),
];

/// The constants of settling by crossings, which are also written before all sources. The flags
/// `REPEATS_ENDS` and `REPEATS_PICKS` belong to [`CrossingsParams`], and those whose names begin
/// with `SITE` to [`CrossingSite`]. All others are constants of the core.
pub const CROSSINGS_CONSTANTS: [Constant; 31] = [
    float("CROSSINGS_AREA_LOSS", crossings::AREA_LOSS),
    float("CROSSINGS_AREA_GAIN", crossings::AREA_GAIN),
    float("CROSSINGS_SOLID", crossings::SOLID),
    float("CROSSINGS_BEND", crossings::BEND),
    float("CROSSINGS_SIDEWAYS_BEND", crossings::SIDEWAYS_BEND),
    float("CROSSINGS_TENSION", crossings::TENSION),
    float("CROSSINGS_SIDEWAYS_TENSION", crossings::SIDEWAYS_TENSION),
    float("CROSSINGS_PRESS", crossings::PRESS),
    float("CROSSINGS_SMOOTH", crossings::SMOOTH),
    float("CROSSINGS_MARGIN", crossings::MARGIN),
    float("CROSSINGS_NEAR", crossings::NEAR),
    float("CROSSINGS_DAMPING", crossings::DAMPING),
    float("CROSSINGS_PIVOT", crossings::PIVOT),
    float("CROSSINGS_TOUCH", crossings::TOUCH),
    float("CROSSINGS_STEEPER", crossings::STEEPER),
    float("CROSSINGS_MOMENTUM", crossings::MOMENTUM),
    float("CROSSINGS_UPHILL", crossings::UPHILL),
    float("CROSSINGS_STEP", crossings::STEP),
    float("CROSSINGS_HALF_WIDTH_LEAST", crossings::HALF_WIDTH[0]),
    float("CROSSINGS_HALF_WIDTH_MOST", crossings::HALF_WIDTH[1]),
    float("CROSSINGS_HALF_HEIGHT_LEAST", crossings::HALF_HEIGHT[0]),
    float("CROSSINGS_HALF_HEIGHT_MOST", crossings::HALF_HEIGHT[1]),
    integer("PASSAGE_STEPS", crossings::STEPS),
    float("PASSAGE_CURVED", crossings::CURVED),
    float("PASSAGE_TURN", crossings::TURN),
    integer("REPEATS_ENDS", CrossingsParams::ENDS),
    integer("REPEATS_PICKS", CrossingsParams::PICKS),
    integer("SITE_STEPS", CrossingSite::STEPS),
    integer("SITE_UP", CrossingSite::UP),
    integer("SITE_TOUCH", CrossingSite::TOUCH),
    integer("SITE_APART", CrossingSite::APART),
];

/// The text that is written before the sources of a program: the definitions of all [`CONSTANTS`],
/// [`SETTLING_CONSTANTS`] and [`CROSSINGS_CONSTANTS`], and of `FLATTENED`. Decimals are the
/// shortest that are read as the same bits.
///
/// With `flattened` the program is right for all yarns. Without it, the program ignores half
/// heights and is faster. It is then right only for yarns that are round at each control point.
///
/// ```
/// use texere_gpu::{Language, prelude};
/// assert!(prelude(Language::OpenClC, false).contains("#define RADIUS_FLOOR 5e-1f\n"));
/// assert!(prelude(Language::Wgsl, true).contains("const RADIUS_FLOOR: f32 = 5e-1f;\n"));
/// assert!(prelude(Language::Wgsl, true).ends_with("const FLATTENED = true;\n"));
/// ```
#[must_use]
pub fn prelude(language: Language, flattened: bool) -> String {
    let mut text = String::new();
    for Constant { name, value } in CONSTANTS.into_iter().chain(SETTLING_CONSTANTS).chain(CROSSINGS_CONSTANTS)
    {
        // Writing to a string does not fail.
        let _ = match (language, value) {
            (Language::OpenClC, Value::Float(value)) if value < 0.0 => {
                writeln!(text, "#define {name} ({value:e}f)")
            }
            (Language::OpenClC, Value::Float(value)) => writeln!(text, "#define {name} {value:e}f"),
            (Language::OpenClC, Value::Integer(value)) => writeln!(text, "#define {name} {value}u"),
            (Language::Wgsl, Value::Float(value)) => writeln!(text, "const {name}: f32 = {value:e}f;"),
            (Language::Wgsl, Value::Integer(value)) => writeln!(text, "const {name} = {value}u;"),
        };
    }
    let _ = match language {
        Language::OpenClC => writeln!(text, "#define FLATTENED {flattened}"),
        Language::Wgsl => writeln!(text, "const FLATTENED = {flattened};"),
    };
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The constants that come from the core, each named once more. The test fails if a value in
    /// the tables above differs.
    const OF_THE_CORE: [(&str, &[f32]); 85] = [
        ("BLOCK_RINGS", &[BLOCK_RINGS as f32]),
        ("TURN_STEPS", &[Turn::STEPS]),
        ("RADIANS_PER_STEP", &[Turn::RADIANS_PER_STEP]),
        ("SINE", &SINE),
        ("COSINE", &COSINE),
        ("TAN_EIGHTH", &[TAN_EIGHTH]),
        ("ARCTANGENT", &ARCTANGENT),
        ("ZERO_VELOCITY", &[ZERO_VELOCITY]),
        ("NO_LENGTH", &[NO_LENGTH]),
        ("SLOPE_LIMIT", &[SLOPE_LIMIT]),
        ("RADIUS_FLOOR", &[RADIUS_FLOOR]),
        ("VERTICAL", &[VERTICAL]),
        ("NO_MIRROR", &[NO_MIRROR]),
        ("ROTATION_MINIMIZING", &[1.0]),
        ("ARC_NODE", &ARC_NODES),
        ("ARC_WEIGHT", &ARC_WEIGHTS),
        ("ARC_EVEN", &[ARC_EVEN]),
        ("ARC_PANELS", &[ARC_PANELS as f32]),
        ("LENGTH_STEPS", &[ArcLength::STEPS]),
        ("LENGTH_MM_MAX", &[ArcLength::MM_MAX]),
        ("FULL_TURN", &[TAU]),
        ("COORDINATE_BITS", &[Quantum::BITS as f32]),
        ("QUANTA_WRAP", &[Quantum::WRAP]),
        ("NORMAL_STEPS", &[PackedVertex::NORMAL_STEPS]),
        ("MARGIN", &[settling::MARGIN]),
        ("NEAR", &[settling::NEAR]),
        ("SHORT", &[settling::SHORT]),
        ("PARALLEL", &[settling::PARALLEL]),
        ("STIFF", &[settling::STIFF]),
        ("SKEW", &[settling::SKEW]),
        ("ONE_PLACE", &[settling::ONE_PLACE]),
        ("SKIN", &[settling::SKIN]),
        ("LEADS_ON", &[settling::LEADS_ON]),
        ("STRIDE", &[settling::STRIDE]),
        ("CONTACT", &[settling::CONTACT]),
        ("BEND", &[settling::BEND]),
        ("BLOCK_BEND", &[settling::BLOCK_BEND]),
        ("BEND_RADIUS", &[settling::BEND_RADIUS]),
        ("BEND_MARGIN", &[settling::BEND_MARGIN]),
        ("SOFT_BEND", &[settling::SOFT_BEND]),
        ("CONTACTS_MIN", &[settling::CONTACTS_MIN]),
        ("BENDS_MIN", &[settling::BENDS_MIN]),
        ("CROSSING", &[settling::CROSSING]),
        ("CROSSING_SHARE", &[settling::CROSSING_SHARE]),
        ("STEP_NEAR", &[settling::STEP_NEAR]),
        ("STEP_DIAMETER", &[settling::STEP_DIAMETER]),
        ("INERTIA", &[settling::INERTIA]),
        ("PRESS", &[settling::PRESS]),
        ("FREED", &[settling::FREED]),
        ("FREE_LEAST", &[settling::FREE_LEAST]),
        ("FREE_MOST", &[settling::FREE_MOST]),
        ("GAUSS", &settling::GAUSS),
        ("GAUSS_OUTER", &[5.0 / 18.0]),
        ("GAUSS_MIDDLE", &[8.0 / 18.0]),
        ("BEND_PARTS", &[settling::BEND_PARTS as f32]),
        ("TAG_POINT", &[settling::tag::POINT as f32]),
        ("TAG_INTERVAL", &[settling::tag::INTERVAL as f32]),
        ("TAG_OPENS", &[settling::tag::OPENS as f32]),
        ("TAG_ENDS", &[settling::tag::ENDS as f32]),
        ("TAG_PINNED", &[settling::tag::PINNED as f32]),
        ("CROSSINGS_AREA_LOSS", &[crossings::AREA_LOSS]),
        ("CROSSINGS_AREA_GAIN", &[crossings::AREA_GAIN]),
        ("CROSSINGS_SOLID", &[crossings::SOLID]),
        ("CROSSINGS_BEND", &[crossings::BEND]),
        ("CROSSINGS_SIDEWAYS_BEND", &[crossings::SIDEWAYS_BEND]),
        ("CROSSINGS_TENSION", &[crossings::TENSION]),
        ("CROSSINGS_SIDEWAYS_TENSION", &[crossings::SIDEWAYS_TENSION]),
        ("CROSSINGS_PRESS", &[crossings::PRESS]),
        ("CROSSINGS_SMOOTH", &[crossings::SMOOTH]),
        ("CROSSINGS_MARGIN", &[crossings::MARGIN]),
        ("CROSSINGS_NEAR", &[crossings::NEAR]),
        ("CROSSINGS_DAMPING", &[crossings::DAMPING]),
        ("CROSSINGS_PIVOT", &[crossings::PIVOT]),
        ("CROSSINGS_TOUCH", &[crossings::TOUCH]),
        ("CROSSINGS_STEEPER", &[crossings::STEEPER]),
        ("CROSSINGS_MOMENTUM", &[crossings::MOMENTUM]),
        ("CROSSINGS_UPHILL", &[crossings::UPHILL]),
        ("CROSSINGS_STEP", &[crossings::STEP]),
        ("CROSSINGS_HALF_WIDTH_LEAST", &[crossings::HALF_WIDTH[0]]),
        ("CROSSINGS_HALF_WIDTH_MOST", &[crossings::HALF_WIDTH[1]]),
        ("CROSSINGS_HALF_HEIGHT_LEAST", &[crossings::HALF_HEIGHT[0]]),
        ("CROSSINGS_HALF_HEIGHT_MOST", &[crossings::HALF_HEIGHT[1]]),
        ("PASSAGE_STEPS", &[5.0]),
        ("PASSAGE_CURVED", &[crossings::CURVED]),
        ("PASSAGE_TURN", &[crossings::TURN]),
    ];

    /// The numbers in the texts of both languages are read back. They must equal the core's.
    #[test]
    fn a_constant_of_the_core_is_the_same_in_both_languages() {
        for (language, define, assign) in
            [(Language::OpenClC, "#define ", " "), (Language::Wgsl, "const ", "= ")]
        {
            let text = prelude(language, false);
            let read: Vec<(&str, f32)> = text
                .lines()
                .filter(|line| !line.contains("FLATTENED"))
                .map(|line| {
                    let rest = line.strip_prefix(define).unwrap();
                    let name = rest.split([' ', ':']).next().unwrap();
                    let literal = rest.rsplit_once(assign).unwrap().1;
                    let digits = literal.trim_matches(['(', ')', ';', 'f', 'u']);
                    (name, digits.parse().unwrap())
                })
                .collect();
            for (name, values) in OF_THE_CORE {
                let found: Vec<f32> = read
                    .iter()
                    .filter(|(read, _)| {
                        read.trim_end_matches(|last: char| last == '_' || last.is_ascii_digit()) == name
                    })
                    .map(|(_, value)| *value)
                    .collect();
                assert_eq!(found, values, "{name} in {language:?}");
            }
        }
    }
}
