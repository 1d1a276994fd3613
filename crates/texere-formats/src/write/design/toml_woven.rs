//! The tables of a design file that say how cloth is woven.

use std::io::Write;

use texere_fabric::{Drawdown, Relief, Woven, WovenDesign};

use super::super::WriteError;
use super::cloth::cloth_keys;
use super::interlacing::Interlacing;
use super::text::Text;
use super::toml_text::table;
use super::yarns::Yarns;

/// The tables `[weave]` and `[cloth]`, checked.
pub(super) struct WovenTables<'a> {
    cloth: &'a Woven,
    /// The table `[cloth]`, or an empty text if it has no keys.
    laid: String,
}

impl<'a> WovenTables<'a> {
    pub(super) fn new(
        woven: &'a WovenDesign,
        settle: bool,
        left_out: &mut Vec<String>,
    ) -> Result<(Self, Yarns), WriteError> {
        if woven.draft().is_some() {
            left_out.push("the draft: threading, tie-up and treadling, or lift plan, which WIF holds".into());
        }
        let relief = woven.relief();
        // Cloth that comes to rest needs no relief, and in its design file the key of the relief is
        // refused.
        let cloth = if settle && relief != Relief::Report {
            left_out.push("cloth.jam: threads that come to rest are written as they were relieved".into());
            woven.cloth()
        } else {
            woven.as_given()
        };
        let mut keys = cloth_keys(cloth);
        match relief {
            Relief::Flatten if !settle => keys.push("jam = \"flatten\"".into()),
            Relief::Shrink if !settle => keys.push("jam = \"shrink\"".into()),
            _ => {}
        }
        Ok((Self { cloth, laid: table("cloth", &keys) }, Yarns::of_cloth(cloth)?))
    }

    /// The tables `[warp]` and `[weft]`.
    pub(super) fn sets(&self, yarns: &Yarns) -> Result<[String; 2], WriteError> {
        Ok([yarns.set("warp", self.cloth.warp())?, yarns.set("weft", self.cloth.weft())?])
    }

    pub(super) fn write<W: Write>(&self, text: &mut Text<W>) -> Result<(), WriteError> {
        text.line("\n[weave]\ndrawdown = '''")?;
        let drawdown = self.cloth.drawdown();
        rows(text, drawdown)?;
        text.line(&format!("'''\nends = {}\npicks = {}", drawdown.ends(), drawdown.picks()))?;
        text.put(&self.laid)
    }
}

/// Writes a row for each pick of the repeat, the last pick on top.
fn rows<W: Write>(text: &mut Text<W>, drawdown: &Drawdown) -> Result<(), WriteError> {
    let [ends, picks] = Interlacing::new(drawdown).repeat();
    for pick in (0..picks).rev() {
        let row: String = (0..ends).map(|end| if drawdown.up(end, pick) { '1' } else { '0' }).collect();
        text.line(&row)?;
    }
    Ok(())
}
