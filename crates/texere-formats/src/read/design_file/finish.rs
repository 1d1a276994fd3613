//! The `[finish]` table: how yarns come to rest.

use texere_core::crossings::Set;
use texere_core::settling::Length;
use texere_fabric::{Along, BySet, Finish, RestBy, Stretch};
use toml::Spanned;

use super::any::Any;
use super::limits::{LENGTHS, PRESS_MM, STRETCH, TENSION_MOST, TIMES_MOST};
use super::schema::FinishTable;
use super::source::Source;
use crate::read::ReadError;

impl FinishTable {
    /// Whether yarns settle (none if the table does not say), and the settings of their finish.
    /// Woven cloth has other keys than knits.
    pub(super) fn read(&self, source: &Source<'_>, woven: bool) -> Result<(Option<bool>, Finish), ReadError> {
        let knits = [
            ("finish.rest", &self.rest),
            ("finish.hold", &self.hold),
            ("finish.length", &self.length),
            ("finish.tension", &self.tension),
            ("finish.press", &self.press),
        ];
        let wovens = [
            ("finish.warp_tension", &self.warp_tension),
            ("finish.weft_tension", &self.weft_tension),
            ("finish.calender", &self.calender),
            ("finish.stretch_warp", &self.stretch_warp),
            ("finish.stretch_weft", &self.stretch_weft),
        ];
        let (others, expected) = if woven {
            (
                &knits[..],
                "only in a knit: woven cloth has warp_tension, weft_tension, calender, stretch_warp and stretch_weft",
            )
        } else {
            (&wovens[..], "only in woven cloth: a knit has rest, hold, length, tension and press")
        };
        if let Some((field, value)) = others.iter().find_map(|(field, value)| Some((field, value.as_ref()?)))
        {
            return Err(source.odd(field, value, expected));
        }
        let times = |(field, value): (&str, &Option<Spanned<Any>>)| {
            let Some(value) = value else { return Ok(1.0) };
            let expected = "a number, 1 where the cloth is relaxed";
            let number = source.float(field, value, expected)?;
            Ok::<_, ReadError>(source.number(field, &number, [0.0, TIMES_MOST])? as f32)
        };
        let said = |settle: &Spanned<Any>| {
            settle.as_ref().truth().ok_or_else(|| source.odd("finish.settle", settle, "true or false"))
        };
        let settle = self.settle.as_ref().map(said).transpose()?;
        let [warp, weft, calender, ..] = wovens;
        let mut finish = Finish {
            by: self.by(source)?,
            hold: self.hold(source)?,
            length: self.length(source)?,
            taut: BySet { warp: times(warp)?, weft: times(weft)? },
            calender: times(calender)?,
            ..Finish::default()
        };
        if let Some(press) = &self.press {
            let field = "finish.press";
            let gap = source.float(field, press, "the distance of two plates, a number of mm")?;
            finish.press_mm = Some(source.number(field, &gap, PRESS_MM)? as f32);
        }
        Ok((settle, finish))
    }

    /// Whether a knit comes to rest by contact or by its energy. Rest by energy knows no plates,
    /// and no lengths that are free.
    fn by(&self, source: &Source<'_>) -> Result<RestBy, ReadError> {
        let Some(given) = &self.rest else { return Ok(RestBy::Contact) };
        match given.as_ref().text() {
            Some("clear") => return Ok(RestBy::Contact),
            Some("energy") => {}
            _ => return Err(source.odd("finish.rest", given, "\"clear\" or \"energy\"")),
        }
        if let Some(press) = &self.press {
            return Err(source.odd("finish.press", press, "only with finish.rest = \"clear\""));
        }
        match &self.length {
            Some(length) if length.as_ref().text() == Some("free") => {
                let expected = "\"held\" or a number: lengths are free only with finish.rest = \"clear\"";
                Err(source.odd("finish.length", length, expected))
            }
            _ => Ok(RestBy::Energy),
        }
    }

    /// The way along which a knit is held while it comes to rest by its energy. None if the table
    /// does not say.
    fn hold(&self, source: &Source<'_>) -> Result<Option<Along>, ReadError> {
        let Some(given) = &self.hold else { return Ok(None) };
        let field = "finish.hold";
        if self.by(source)? != RestBy::Energy {
            return Err(source.odd(field, given, "only with finish.rest = \"energy\""));
        }
        let found = given.as_ref().text().and_then(Along::named);
        found.map(Some).ok_or_else(|| source.odd(field, given, "\"courses\", \"wales\" or \"both\""))
    }

    /// How woven cloth is stretched, or none if the table does not say.
    pub(super) fn stretch(&self, source: &Source<'_>) -> Result<Option<Stretch>, ReadError> {
        let (along, field, given) = match (&self.stretch_warp, &self.stretch_weft) {
            (None, None) => return Ok(None),
            (Some(given), None) => (Set::Warp, "finish.stretch_warp", given),
            (None, Some(given)) => (Set::Weft, "finish.stretch_weft", given),
            (Some(_), Some(given)) => {
                let expected = "it or finish.stretch_warp, not both: the other direction follows by itself";
                return Err(source.odd("finish.stretch_weft", given, expected));
            }
        };
        let number = source.float(field, given, "a number, how many times as long the cloth becomes")?;
        let by = source.number(field, &number, STRETCH)?;
        Ok(Some(Stretch { along, by }))
    }

    /// The treatment of yarns' lengths, or none if the table does not say.
    fn length(&self, source: &Source<'_>) -> Result<Option<Length>, ReadError> {
        let field = "finish.length";
        let mut length = match &self.length {
            None => None,
            Some(given) => Some(match (given.as_ref().text(), given.as_ref().number()) {
                (Some("held"), _) => Length::Held,
                (Some("free"), _) => Length::Free { tension: 0.0 },
                (None, Some(factor)) => {
                    let factor = Spanned::new(given.span(), factor);
                    Length::Given(source.number(field, &factor, LENGTHS)? as f32)
                }
                _ => {
                    let expected = "\"held\", \"free\" or how many times its length each yarn is to have";
                    return Err(source.odd(field, given, expected));
                }
            }),
        };
        if let Some(given) = &self.tension {
            let field = "finish.tension";
            let number =
                source.float(field, given, "the tension that draws yarns in, a number from 0 to 0.1")?;
            let number = source.number(field, &number, [0.0, TENSION_MOST])? as f32;
            let Some(Length::Free { tension }) = &mut length else {
                let place = source.place(field, given.span());
                return Err(ReadError::Without { place, needs: "finish.length = \"free\"" });
            };
            *tension = number;
        }
        Ok(length)
    }
}
