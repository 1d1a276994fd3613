//! Kernels and shaders take all constants from the core, and have none of their own.

use texere_gpu::{CONSTANTS, CROSSINGS_CONSTANTS, Constant, SETTLING_CONSTANTS};
use texere_kernels::{ATTRIBUTES, CROSSINGS, KernelProgram, PACKING, PER_RING, PER_YARN, SETTLING};

/// The sources that are compiled for meshes, for settling and for crossings, without their
/// preludes, and the constants that they have to use.
fn sources() -> [(&'static str, String, &'static [Constant]); 6] {
    let kernels =
        |programs: &[KernelProgram]| programs.iter().flat_map(|program| program.sources).copied().collect();
    [
        ("kernels of a mesh", kernels(&[PER_RING, PER_YARN, ATTRIBUTES, PACKING]), &CONSTANTS),
        ("shaders of a mesh", texere_shaders::ALL.map(|shader| shader.source).concat(), &CONSTANTS),
        ("kernels of a settling", kernels(&[SETTLING]), &SETTLING_CONSTANTS),
        (
            "shaders of a settling",
            texere_shaders::settling::ALL.map(|shader| shader.source).concat(),
            &SETTLING_CONSTANTS,
        ),
        ("kernels of crossings", kernels(&[CROSSINGS]), &CROSSINGS_CONSTANTS),
        (
            "shaders of crossings",
            texere_shaders::crossings::ALL.map(|shader| shader.source).concat(),
            &CROSSINGS_CONSTANTS,
        ),
    ]
}

/// Words and numbers of the code without comments.
fn words(source: &str) -> impl Iterator<Item = &str> {
    let code = source.lines().map(|line| line.split("//").next().unwrap_or_default());
    code.flat_map(|line| {
        line.split(|letter: char| !(letter.is_alphanumeric() || letter == '_' || letter == '.'))
    })
}

#[test]
fn sources_use_every_constant_and_define_none_of_them() {
    for (what, source, constants) in sources() {
        for Constant { name, .. } in constants {
            assert!(words(&source).any(|word| word == *name), "{name} is not used in {what}");
            for definition in [format!("#define {name} "), format!("const {name} "), format!("const {name}:")]
            {
                assert!(!source.contains(&definition), "{definition} in {what}");
            }
        }
    }
}

/// Numbers with a fraction or an exponent are those of a short list. Any other such number would be
/// a constant that the core does not define.
#[test]
fn formulas_have_no_other_number_than_small_ones() {
    const PLAIN: [f32; 9] = [0.0, 0.125, 0.25, 0.5, 1.0, 2.0, 3.0, 4.0, 6.0];
    for (what, source, _) in sources() {
        for number in words(&source).filter(|word| word.starts_with(|first: char| first.is_ascii_digit())) {
            if number.contains('.') || number.contains('e') && !number.starts_with("0x") {
                let value = number.trim_end_matches('f').parse();
                assert!(value.is_ok_and(|value| PLAIN.contains(&value)), "{number} in {what}");
            }
        }
    }
}
