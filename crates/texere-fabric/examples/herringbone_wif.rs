//! Prints the WIF file `designs/herringbone.wif`, a striped herringbone on four shafts:
//!
//! ```text
//! cargo run -p texere-fabric --example herringbone_wif > designs/herringbone.wif
//! ```

use std::fmt::Write;

use texere_fabric::{Draft, Shedding};

/// Number of ends, and of picks. The cloth is a square of a little more than 19 cm.
const THREADS: usize = 192;

/// Ends between two reversals of the twill.
const STRIPE: usize = 16;

/// The colours of the warp, stripe by stripe: 1 is charcoal, 2 is grey, 3 is rust.
const COLOURS: [usize; 6] = [1, 1, 1, 3, 2, 2];

/// A 2/2 twill that reverses every [`STRIPE`] ends. At each reversal, the shaft of the next end is
/// down when the shaft of the end before is up. This clean cut distinguishes a herringbone from a
/// pointed twill, whose floats are longer at the reversal.
pub(crate) fn draft() -> Draft {
    let forth = [1, 2, 3, 4];
    let back = [2, 1, 4, 3];
    let threading = (0..THREADS).map(|end| {
        let order = if (end / STRIPE).is_multiple_of(2) { forth } else { back };
        vec![order[end % 4]]
    });
    Draft {
        threading: threading.collect(),
        shedding: Shedding::TieUp {
            tie_up: vec![vec![1, 2], vec![2, 3], vec![3, 4], vec![1, 4]],
            treadling: (0..THREADS).map(|pick| vec![forth[pick % 4]]).collect(),
        },
        rising_shed: true,
    }
}

/// Writes the heading `section`, and a line `number=list` for each of `lists`.
fn lines(wif: &mut String, section: &str, lists: &[Vec<u32>]) -> std::fmt::Result {
    writeln!(wif, "\n[{section}]")?;
    for (number, list) in (1..).zip(lists) {
        let list: Vec<_> = list.iter().map(u32::to_string).collect();
        writeln!(wif, "{number}={}", list.join(","))?;
    }
    Ok(())
}

/// The draft with its colours and sizes, as a file in WIF 1.1.
pub(crate) fn wif() -> Result<String, std::fmt::Error> {
    let draft = draft();
    let Shedding::TieUp { tie_up, treadling } = &draft.shedding else { return Err(std::fmt::Error) };
    let mut wif = String::from(
        "[WIF]\nVersion=1.1\nDate=April 20, 1997\nDevelopers=wif@mhsoft.com\nSource Program=texere\n\n[CONTENTS]\n",
    );
    for section in [
        "COLOR PALETTE",
        "TEXT",
        "WEAVING",
        "WARP",
        "WEFT",
        "COLOR TABLE",
        "THREADING",
        "TIEUP",
        "TREADLING",
        "WARP COLORS",
    ] {
        writeln!(wif, "{section}=true")?;
    }
    wif += "\n[TEXT]\nTitle=Striped herringbone\n";
    wif += "\n[COLOR PALETTE]\nEntries=4\nRange=0,255\n";
    wif += "\n[COLOR TABLE]\n1=58,61,66\n2=151,153,150\n3=168,76,43\n4=232,226,212\n";
    wif += "\n[WEAVING]\nShafts=4\nTreadles=4\nRising Shed=true\n";
    // Threads are 0.45 mm thick and 1 mm apart, so that crossing threads have room to pass between
    // them.
    for (set, colour) in [("WARP", 1), ("WEFT", 4)] {
        writeln!(wif, "\n[{set}]\nThreads={THREADS}\nColor={colour}\nUnits=Centimeters")?;
        writeln!(wif, "Spacing=0.1\nThickness=0.045")?;
    }
    lines(&mut wif, "THREADING", &draft.threading)?;
    lines(&mut wif, "TIEUP", tie_up)?;
    lines(&mut wif, "TREADLING", treadling)?;
    wif += "\n[WARP COLORS]\n";
    for end in 0..THREADS {
        writeln!(wif, "{}={}", end + 1, COLOURS[end / STRIPE % COLOURS.len()])?;
    }
    Ok(wif)
}

fn main() -> Result<(), std::fmt::Error> {
    print!("{}", wif()?);
    Ok(())
}
