//! Kernels and shaders take the core's constants from one place, and have none of their own.

use texere_gpu::{CONSTANTS, Constant, Language};

const LANGUAGES: [Language; 2] = [Language::OpenClC, Language::Wgsl];

/// All that is compiled for a plan, without what stands before it.
fn source(language: Language) -> String {
    match language {
        Language::OpenClC => [texere_kernels::PER_RING, texere_kernels::PER_YARN]
            .map(|program| program.sources.concat())
            .concat(),
        Language::Wgsl => texere_shaders::ALL.map(|shader| shader.source).concat(),
    }
}

/// Words and numbers of the code, comments left out.
fn words(source: &str) -> impl Iterator<Item = &str> {
    let code = source.lines().map(|line| line.split("//").next().unwrap_or_default());
    code.flat_map(|line| {
        line.split(|letter: char| !(letter.is_alphanumeric() || letter == '_' || letter == '.'))
    })
}

#[test]
fn sources_use_every_constant_and_define_none_of_them() {
    for language in LANGUAGES {
        let source = source(language);
        for Constant { name, .. } in CONSTANTS {
            assert!(words(&source).any(|word| word == name), "{name} is not used in {language:?}");
            for definition in [format!("#define {name} "), format!("const {name} "), format!("const {name}:")]
            {
                assert!(!source.contains(&definition), "{definition} in {language:?}");
            }
        }
    }
}

/// Any other number with a fraction or an exponent would be a constant that the core does not know of.
#[test]
fn formulas_have_no_other_number_than_small_ones() {
    const PLAIN: [f32; 8] = [0.0, 0.125, 0.25, 0.5, 1.0, 2.0, 3.0, 6.0];
    for language in LANGUAGES {
        let source = source(language);
        for number in words(&source).filter(|word| word.starts_with(|first: char| first.is_ascii_digit())) {
            if number.contains('.') || number.contains('e') && !number.starts_with("0x") {
                let value = number.trim_end_matches('f').parse();
                assert!(value.is_ok_and(|value| PLAIN.contains(&value)), "{number} in {language:?}");
            }
        }
    }
}
