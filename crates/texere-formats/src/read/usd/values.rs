//! Values in USD's text form.

use std::str::FromStr;

use texere_core::backend::room_for;

use super::tokens::{Kind, Token, Tokens};
use crate::read::ReadError;

impl<'a> Tokens<'a> {
    /// Passes over a value: a word, a text, or all between a bracket and its partner.
    pub(super) fn pass_over_value(&mut self) -> Result<(), ReadError> {
        let first = self.next()?;
        let mut open = match first.kind {
            Kind::Sign(b'(' | b'[' | b'{') => 1_u64,
            Kind::Sign(_) | Kind::End => return Err(self.refused(first, "a value")),
            Kind::Word | Kind::Text | Kind::Path => return Ok(()),
            // A file may be named with a path within it.
            Kind::Asset => {
                if self.peek()?.kind == Kind::Path {
                    self.next()?;
                }
                return Ok(());
            }
        };
        while open > 0 {
            match self.next()? {
                Token { kind: Kind::Sign(b'(' | b'[' | b'{'), .. } => open += 1,
                Token { kind: Kind::Sign(b')' | b']' | b'}'), .. } => open -= 1,
                end @ Token { kind: Kind::End, .. } => {
                    return Err(self.refused(end, "the bracket that ends a value"));
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// A finite number.
    pub(super) fn number<T: FromStr + Copy + Into<f64>>(&mut self) -> Result<T, ReadError> {
        let token = self.next()?;
        let number = token.text.parse().ok().filter(|&number: &T| number.into().is_finite());
        number.filter(|_| token.kind == Kind::Word).ok_or_else(|| self.refused(token, "a number"))
    }

    /// A whole number from 0: a count or an index.
    pub(super) fn count(&mut self) -> Result<u32, ReadError> {
        let token = self.next()?;
        let number = token.text.parse().ok().filter(|_| token.kind == Kind::Word);
        number.ok_or_else(|| self.refused(token, "a whole number"))
    }

    /// Whether something holds.
    pub(super) fn truth(&mut self) -> Result<bool, ReadError> {
        let token = self.next()?;
        match token.text {
            "true" | "1" => Ok(true),
            "false" | "0" => Ok(false),
            _ => Err(self.refused(token, "true or false")),
        }
    }

    /// A text in quotes.
    pub(super) fn text(&mut self) -> Result<Token<'a>, ReadError> {
        let token = self.next()?;
        if token.kind == Kind::Text { Ok(token) } else { Err(self.refused(token, "a text in quotes")) }
    }

    /// Values in round brackets.
    pub(super) fn tuple<T: Copy + Default, const COUNT: usize>(
        &mut self,
        mut value: impl FnMut(&mut Self) -> Result<T, ReadError>,
    ) -> Result<[T; COUNT], ReadError> {
        let mut values = [T::default(); COUNT];
        self.sign(b'(')?;
        for (number, place) in values.iter_mut().enumerate() {
            if number > 0 {
                self.sign(b',')?;
            }
            *place = value(self)?;
        }
        self.sign(b')')?;
        Ok(values)
    }

    /// A list in square brackets. A comma may follow its last value.
    pub(super) fn list<T>(
        &mut self,
        what: &'static str,
        mut value: impl FnMut(&mut Self) -> Result<T, ReadError>,
    ) -> Result<Vec<T>, ReadError> {
        let mut values = Vec::new();
        self.sign(b'[')?;
        while !self.took(b']')? {
            room_for(&mut values, 1, what)?;
            values.push(value(self)?);
            if !self.took(b',')? {
                self.sign(b']')?;
                break;
            }
        }
        Ok(values)
    }
}

/// A text with the letters that its backslashes stand for.
pub(super) fn unescaped(text: &str) -> String {
    let mut letters = text.chars();
    let mut plain = String::new();
    while let Some(letter) = letters.next() {
        if letter != '\\' {
            plain.push(letter);
            continue;
        }
        match letters.next() {
            Some('n') => plain.push('\n'),
            Some('r') => plain.push('\r'),
            Some('t') => plain.push('\t'),
            Some('x') => {
                let digits: String = letters.by_ref().take(2).collect();
                plain.extend(u8::from_str_radix(&digits, 16).map(char::from));
            }
            other => plain.extend(other),
        }
    }
    plain
}
