//! The words, texts and signs of USD's text form.
//!
//! **Source**: Alliance for OpenUSD, "AOUSD Core Specification", the grammar of USDA.

use std::path::Path;

use crate::read::ReadError;

/// A kind of token.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// A name, a keyword or a number, such as `xformOp:translate`, `def` or `-1.5e-3`.
    Word,
    /// A text in quotes.
    Text,
    /// The name of another file, between signs `@`.
    Asset,
    /// A path of a prim or a property, between `<` and `>`.
    Path,
    /// One of `( ) [ ] { } = , ;`.
    Sign(u8),
    /// The end of the file.
    End,
}

/// A token of a file.
#[derive(Debug, Clone, Copy)]
pub(super) struct Token<'a> {
    pub(super) kind: Kind,
    /// The text, without quotes.
    pub(super) text: &'a str,
    /// The place of its first byte in the file.
    pub(super) at: usize,
}

impl Token<'_> {
    pub(super) fn is(self, word: &str) -> bool {
        self.kind == Kind::Word && self.text == word
    }
}

/// The tokens of a file, in order.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tokens<'a> {
    file: &'a Path,
    text: &'a str,
    /// The place of the next byte in the file.
    at: usize,
}

impl<'a> Tokens<'a> {
    /// The tokens from byte `at` of the file's `text`.
    pub(super) const fn new(file: &'a Path, text: &'a str, at: usize) -> Self {
        Self { file, text, at }
    }

    /// The next token, which stays the next one.
    pub(super) fn peek(&self) -> Result<Token<'a>, ReadError> {
        let mut ahead = *self;
        ahead.next()
    }

    /// Takes the next token.
    pub(super) fn next(&mut self) -> Result<Token<'a>, ReadError> {
        self.pass_over_blanks()?;
        let (left, at) = (&self.text[self.at..], self.at);
        let Some(first) = left.chars().next() else {
            return Ok(Token { kind: Kind::End, text: "", at });
        };
        let (kind, skipped, end) = match first {
            '(' | ')' | '[' | ']' | '{' | '}' | '=' | ',' | ';' => (Kind::Sign(first as u8), 0, 1),
            '"' | '\'' => self.quoted(left, first)?,
            '@' => self.between(left, if left.starts_with("@@@") { "@@@" } else { "@" }, Kind::Asset)?,
            '<' => {
                let end =
                    left.find('>').ok_or_else(|| self.cut_short(at, left, "a path that ends with >"))?;
                (Kind::Path, 1, end)
            }
            _ => {
                let end = left.find(|letter| !is_of_word(letter)).unwrap_or(left.len());
                (Kind::Word, 0, end)
            }
        };
        if end == 0 {
            let token = Token { kind, text: &left[..first.len_utf8()], at };
            return Err(self.refused(token, "a name, a number or a text"));
        }
        self.at += end + skipped;
        Ok(Token { kind, text: &left[skipped..end], at })
    }

    /// A text in quotes, of which three may stand at each end. The letter after a backslash does
    /// not end the text.
    fn quoted(&self, left: &str, quote: char) -> Result<(Kind, usize, usize), ReadError> {
        let three = [quote; 3].iter().collect::<String>();
        let mark = if left.starts_with(&three) { &three[..] } else { &three[..1] };
        let mut at = mark.len();
        loop {
            let rest = &left[at..];
            if rest.starts_with(mark) {
                return Ok((Kind::Text, mark.len(), at));
            }
            let mut letters = rest.chars();
            let letter = letters.next();
            if letter.is_none() || mark.len() == 1 && letter == Some('\n') {
                return Err(self.cut_short(self.at, left, "a text that ends with its quotes"));
            }
            let taken = if letter == Some('\\') { letters.next() } else { None };
            at += [letter, taken].iter().flatten().map(|letter| letter.len_utf8()).sum::<usize>();
        }
    }

    /// A token between two marks.
    fn between(&self, left: &str, mark: &str, kind: Kind) -> Result<(Kind, usize, usize), ReadError> {
        let end = left[mark.len()..].find(mark);
        let end =
            end.ok_or_else(|| self.cut_short(self.at, left, &format!("a name that ends with {mark}")))?;
        Ok((kind, mark.len(), mark.len() + end))
    }

    fn pass_over_blanks(&mut self) -> Result<(), ReadError> {
        loop {
            let left = self.text[self.at..].trim_start_matches([' ', '\t', '\r', '\n']);
            self.at = self.text.len() - left.len();
            if left.starts_with('#') || left.starts_with("//") {
                self.at += left.find('\n').unwrap_or(left.len());
            } else if let Some(remark) = left.strip_prefix("/*") {
                let end = remark.find("*/").map(|end| end + 4);
                self.at += end.ok_or_else(|| self.cut_short(self.at, left, "a remark that ends with */"))?;
            } else {
                return Ok(());
            }
        }
    }

    /// Takes `sign`.
    pub(super) fn sign(&mut self, sign: u8) -> Result<(), ReadError> {
        let token = self.next()?;
        if token.kind == Kind::Sign(sign) {
            return Ok(());
        }
        Err(self.refused(token, format!("\"{}\"", char::from(sign))))
    }

    /// Takes `sign` if it is next. Returns whether it was.
    pub(super) fn took(&mut self, sign: u8) -> Result<bool, ReadError> {
        let is_next = self.peek()?.kind == Kind::Sign(sign);
        if is_next {
            self.next()?;
        }
        Ok(is_next)
    }

    fn cut_short(&self, at: usize, left: &str, expected: &str) -> ReadError {
        let line = left.lines().next().unwrap_or_default();
        self.refused(Token { kind: Kind::Word, text: line, at }, expected)
    }

    /// The refusal of a token.
    pub(super) fn refused(&self, token: Token<'_>, expected: impl Into<String>) -> ReadError {
        ReadError::word(self.file, self.text.as_bytes(), token.at, token.text, expected.into())
    }
}

/// Whether a word may hold a letter. Signs of a number are letters, too, and so are the colons and
/// the full stops of names.
fn is_of_word(letter: char) -> bool {
    letter.is_alphanumeric() || "_:.+-|!".contains(letter)
}
