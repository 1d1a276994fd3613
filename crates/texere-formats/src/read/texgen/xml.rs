//! The elements of an XML file, from its start to its end.
//!
//! Nothing is nested in memory: elements that are not asked for are passed over as they come.
//! Entities are not expanded.

use std::path::Path;

use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};

use texere_core::SectionError;

use crate::read::bytes::utf_8;
use crate::read::error::said;
use crate::read::{FilePlace, ReadError};

/// An XML file, read up to some tag.
pub(super) struct Xml<'a> {
    file: &'a Path,
    text: &'a str,
    reader: Reader<&'a [u8]>,
    /// How many elements have begun and not ended.
    depth: usize,
}

/// The start tag of an element.
#[derive(Debug, Clone)]
pub(super) struct Element<'a> {
    tag: BytesStart<'a>,
    /// The first byte of the tag in the file.
    at: usize,
}

/// The value of an attribute.
#[derive(Debug, Clone, Copy)]
pub(super) struct Value<'a> {
    pub(super) text: &'a str,
    /// The first byte of the value in the file.
    at: usize,
}

impl<'a> Xml<'a> {
    /// **Errors**: [`ReadError::Bytes`] for bytes that are not UTF-8.
    pub(super) fn new(file: &'a Path, bytes: &'a [u8]) -> Result<Self, ReadError> {
        let text = utf_8(file, bytes)?;
        let mut reader = Reader::from_str(text);
        // An empty element is then read as one that ends at once.
        reader.config_mut().expand_empty_elements = true;
        Ok(Self { file, text, reader, depth: 0 })
    }

    /// The next element within the current one: the element whose start tag, or whose last child,
    /// has just been read. None at the end of the current element, and at the end of the file.
    ///
    /// **Errors**: [`ReadError::Syntax`] for what is no XML; [`ReadError::Word`] for a file that
    /// ends within an element.
    pub(super) fn child(&mut self) -> Result<Option<Element<'a>>, ReadError> {
        loop {
            let at = self.reader.buffer_position() as usize;
            match self.reader.read_event() {
                Ok(Event::Start(tag)) => {
                    self.depth += 1;
                    return Ok(Some(Element { tag, at }));
                }
                Ok(Event::End(_)) => {
                    self.depth -= 1;
                    return Ok(None);
                }
                Ok(Event::Eof) if self.depth == 0 => return Ok(None),
                Ok(Event::Eof) => {
                    let expected = "the end of each element";
                    return Err(ReadError::word(
                        self.file,
                        self.text.as_bytes(),
                        self.text.len(),
                        "",
                        expected.into(),
                    ));
                }
                Ok(_) => {}
                Err(error) => return Err(self.ill_formed(&error)),
            }
        }
    }

    /// Passes over the rest of an element whose start tag has just been read.
    pub(super) fn skip(&mut self, element: &Element<'a>) -> Result<(), ReadError> {
        self.depth -= 1;
        let passed = self.reader.read_to_end(element.tag.name());
        passed.map(drop).map_err(|error| self.ill_formed(&error))
    }

    fn ill_formed(&self, error: &quick_xml::Error) -> ReadError {
        let before = &self.text.as_bytes()[..(self.reader.error_position() as usize).min(self.text.len())];
        let line = before.iter().filter(|&&byte| byte == b'\n').count() + 1;
        ReadError::Syntax { file: self.file.into(), line, message: said(&error.to_string()) }
    }

    /// The line of an element, counted from 1.
    fn line(&self, element: &Element<'_>) -> usize {
        self.text.as_bytes()[..element.at].iter().filter(|&&byte| byte == b'\n').count() + 1
    }

    /// The value of an attribute of `element`, or none if it has none of that name.
    pub(super) fn value(&self, element: &Element<'a>, name: &str) -> Result<Option<Value<'a>>, ReadError> {
        // The check for doubled attributes is off, because it compares each attribute with all
        // others.
        let mut attributes = element.tag.attributes();
        for attribute in attributes.with_checks(false) {
            let attribute = attribute.map_err(|error| {
                let line = self.line(element);
                ReadError::Syntax { file: self.file.into(), line, message: said(&error.to_string()) }
            })?;
            if attribute.key.into_inner() != name {
                continue;
            }
            // Values lie in the text of the file, which the reader does not copy.
            let value: &str = attribute.value.as_ref();
            let at = (value.as_ptr() as usize).wrapping_sub(self.text.as_ptr() as usize);
            let text = self.text.get(at..at.saturating_add(value.len())).unwrap_or_default();
            return Ok(Some(Value { text, at }));
        }
        Ok(None)
    }

    /// The value of an attribute that `element` must have.
    pub(super) fn given(&self, element: &Element<'a>, name: &str) -> Result<Value<'a>, ReadError> {
        let value = self.value(element, name)?;
        value.ok_or_else(|| self.refused(element, &format!("an element with the attribute {name}")))
    }

    /// The numbers of an attribute, separated by commas, or none if `element` has no such
    /// attribute.
    pub(super) fn numbers<const N: usize>(
        &self,
        element: &Element<'a>,
        name: &str,
    ) -> Result<Option<[f64; N]>, ReadError> {
        let Some(value) = self.value(element, name)? else { return Ok(None) };
        let number = |text: &str| text.trim().parse().ok().filter(|number: &f64| number.is_finite());
        let numbers: Option<Vec<_>> = value.text.split(',').take(N + 1).map(number).collect();
        let numbers = numbers.and_then(|numbers| numbers.try_into().ok());
        let expected = if N == 1 { "a number".into() } else { format!("{N} numbers separated by commas") };
        numbers.map(Some).ok_or_else(|| self.unfit(value, &expected))
    }

    /// The numbers of an attribute that `element` must have.
    pub(super) fn all<const N: usize>(
        &self,
        element: &Element<'a>,
        name: &str,
    ) -> Result<[f64; N], ReadError> {
        let numbers = self.numbers(element, name)?;
        numbers.ok_or_else(|| self.refused(element, &format!("an element with the attribute {name}")))
    }

    /// The refusal of an element that stands for no section.
    pub(super) fn no_section(&self, element: &Element<'_>, source: SectionError) -> ReadError {
        let place = FilePlace::new(self.file, self.line(element), "Section");
        ReadError::Section { place, source }
    }

    /// The refusal of an element.
    pub(super) fn refused(&self, element: &Element<'_>, expected: &str) -> ReadError {
        let name = element.tag.name().into_inner();
        ReadError::word(self.file, self.text.as_bytes(), element.at, name, expected.into())
    }

    /// The refusal of a value.
    pub(super) fn unfit(&self, value: Value<'_>, expected: &str) -> ReadError {
        ReadError::word(self.file, self.text.as_bytes(), value.at, value.text, expected.into())
    }
}

impl Element<'_> {
    pub(super) fn is(&self, name: &str) -> bool {
        self.tag.name().into_inner() == name
    }
}
