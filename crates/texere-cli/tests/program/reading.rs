//! Every command that reads a design prints the reader's remarks on standard error.

use std::fs;

use crate::{stderr, texere};

/// A lift plan beside `Treadles=0`, with colours whose range is one number.
const LIFTED: &str = "[WIF]\nVersion=1.1\n[WEAVING]\nShafts=2\nTreadles=0\nRising Shed=1\n[WARP]\nThreads=4\nColor=1\n\
                      Units=Centimeters\nSpacing=0.1\nThickness=0.04\n[WEFT]\nThreads=4\nColor=1\nUnits=Centimeters\nSpacing=0.1\n\
                      Thickness=0.04\n[COLOR PALETTE]\nEntries=1\nRange=255\n[COLOR TABLE]\n1=32,32,32\n[THREADING]\n1=1\n2=2\n3=1\n\
                      4=2\n[TIEUP]\n1=1\n[TREADLING]\n1=1\n[LIFTPLAN]\n1=1\n2=2\n3=1\n4=2\n";

/// A knit with a needle in the middle that never has a loop.
const EMPTY: &str = "[knit]\nchart = \"\"\"\nkmk\nkmk\n\"\"\"\nrepeat = [2, 2]\nwales_per_cm = 8\ncourses_per_cm = 10\n[yarns.a]\n\
                     diameter_mm = 0.1\n";

/// A program whose hook can't take a yarn, because it still holds another one. The yarn is then
/// used without having been brought in, and loops are left on needles.
const HOOKED: &str = ";!knitout-2\n;;Carriers: 1 2\ninhook 1\ninhook 2\nknit + f1 1\nknit + f2 1\nknit - f2 1\nknit - f1 1\nouthook 1\n";

/// Two layers that nothing binds.
const LAYERS: &str = "[weave]\ndrawdown = \"\"\"\n0010\n1011\n1110\n1000\n\"\"\"\n[yarns.a]\ndiameter_mm = 0.3\n[warp]\nyarns = [\"a\"]\n\
                      spacing_mm = 0.6\n[weft]\nyarns = [\"a\"]\nspacing_mm = 0.6\n";

/// A terminal shows standard output and standard error together, so neither repeats the other.
#[test]
fn reports_do_not_repeat_what_was_said_as_the_design_was_read() {
    let folder = tempfile::tempdir().unwrap();
    for (name, text, words) in [
        ("lifted.wif", LIFTED, vec!["range", "treadles"]),
        ("empty.toml", EMPTY, vec!["needles that never have a loop"]),
        ("hooked.k", HOOKED, vec!["the hook takes carrier 2", "loops hang on needles"]),
        ("layers.toml", LAYERS, vec!["nothing binds all threads"]),
    ] {
        let path = folder.path().join(name).to_string_lossy().into_owned();
        fs::write(&path, text).unwrap();
        for command in [
            vec!["inspect", &path],
            vec!["inspect", &path, "--counts"],
            vec!["check", &path, "--no-settle"],
            vec!["check", &path],
        ] {
            let output = texere(&command);
            let said = (crate::stdout(&output) + &stderr(&output)).to_lowercase();
            for word in &words {
                assert_eq!(said.matches(word).count(), 1, "{command:?}, {word}: {said}");
            }
        }
        // A report for programs is whole by itself.
        let report = crate::stdout(&texere(&["inspect", &path, "--counts", "--json"])).to_lowercase();
        assert!(words.iter().all(|word| report.contains(word)), "{report}");
    }
}

#[test]
fn every_command_says_what_a_reader_warns_of_once() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    fs::write(at("lifted.wif"), LIFTED).unwrap();
    fs::write(at("empty.toml"), EMPTY).unwrap();
    let (lifted, empty) = (at("lifted.wif"), at("empty.toml"));
    let (cloth, made, picture) = (at("cloth.ply"), at("made.toml"), at("draft.png"));
    for (design, words) in
        [(&lifted, vec!["range", "treadles"]), (&empty, vec!["needles that never have a loop"])]
    {
        let mut commands = vec![
            vec!["inspect", design, "--counts"],
            vec!["inspect", design, "--counts", "--json"],
            vec!["check", design, "--no-settle"],
            vec!["mesh", design, "--no-settle", "-o", &cloth],
            vec!["draft", design, "--text"],
            vec!["draft", design, "-o", &picture],
        ];
        if design == &lifted {
            commands.push(vec!["convert", design, &made]);
        }
        for command in commands {
            let output = texere(&command);
            assert!(matches!(output.status.code(), Some(0 | 4)), "{command:?}: {}", stderr(&output));
            let said = stderr(&output).to_lowercase();
            for word in &words {
                let lines = said.lines().filter(|line| line.starts_with("warning: ") && line.contains(word));
                assert_eq!(lines.count(), 1, "{command:?}, {word}: {said}");
            }
        }
    }
    // Standard output has the drawdown and nothing else.
    let rows = texere(&["draft", &lifted, "--text"]);
    assert_eq!(String::from_utf8(rows.stdout).unwrap(), "0101\n1010\n0101\n1010\n");
    // A report for programs is whole by itself.
    let report = crate::stdout(&texere(&["inspect", &lifted, "--counts", "--json"]));
    let report: serde_json::Value = serde_json::from_str(&report).unwrap();
    assert_eq!(report["warnings"].as_array().unwrap().len(), 2, "{report}");
}
