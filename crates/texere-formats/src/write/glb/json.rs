//! Compact JSON of a length that does not depend on its floats.

use std::fmt::Write;

/// A value that is written as JSON.
pub(super) trait Json {
    /// Whether the key of this value is left out.
    fn is_absent(&self) -> bool {
        false
    }

    fn write(&self, text: &mut String);
}

/// Declares structures that are written as objects, with a key for each field.
macro_rules! objects {
    ($($(#[$about:meta])* $object:ident { $($key:literal $field:ident: $kind:ty,)* })*) => {$(
        #[derive(Debug)]
        $(#[$about])*
        pub(super) struct $object { $(pub(super) $field: $kind,)* }

        impl Json for $object {
            fn write(&self, text: &mut String) {
                let fields: &[(&str, &dyn Json)] = &[$(($key, &self.$field)),*];
                crate::write::glb::json::object(fields, text);
            }
        }
    )*};
}
pub(super) use objects;

/// Writes an object of `fields`, keys with their values.
pub(super) fn object(fields: &[(&str, &dyn Json)], text: &mut String) {
    let fields = fields.iter().filter(|(_, value)| !value.is_absent());
    enclosed(['{', '}'], fields, text, |(key, value), text| {
        key.write(text);
        text.push(':');
        value.write(text);
    });
}

/// Writes items between a pair of brackets, with commas.
fn enclosed<T>(
    [open, close]: [char; 2],
    items: impl Iterator<Item = T>,
    text: &mut String,
    item: impl Fn(T, &mut String),
) {
    text.push(open);
    for (number, each) in items.enumerate() {
        if number > 0 {
            text.push(',');
        }
        item(each, text);
    }
    text.push(close);
}

macro_rules! whole_numbers {
    ($($number:ty),*) => {$(
        impl Json for $number {
            fn write(&self, text: &mut String) {
                text.push_str(&self.to_string());
            }
        }
    )*};
}
whole_numbers!(u32, u64, usize);

impl Json for bool {
    fn write(&self, text: &mut String) {
        text.push_str(if *self { "true" } else { "false" });
    }
}

impl Json for f32 {
    /// Every float takes fifteen bytes, which hold a sign, nine digits, a point, and an exponent of
    /// four bytes. A shorter number gets spaces in front, which JSON allows.
    fn write(&self, text: &mut String) {
        // Writing to a string does not fail.
        let _ = write!(text, "{self:15e}");
    }
}

impl Json for &str {
    fn write(&self, text: &mut String) {
        text.push('"');
        for letter in self.chars() {
            match letter {
                '"' | '\\' => text.extend(['\\', letter]),
                '\0'..' ' => {
                    let _ = write!(text, "\\u{:04x}", u32::from(letter));
                }
                _ => text.push(letter),
            }
        }
        text.push('"');
    }
}

impl Json for String {
    fn write(&self, text: &mut String) {
        self.as_str().write(text);
    }
}

impl<T: Json> Json for Option<T> {
    fn is_absent(&self) -> bool {
        self.is_none()
    }

    fn write(&self, text: &mut String) {
        if let Some(value) = self {
            value.write(text);
        }
    }
}

impl<T: Json> Json for Vec<T> {
    /// glTF has no empty lists.
    fn is_absent(&self) -> bool {
        self.is_empty()
    }

    fn write(&self, text: &mut String) {
        enclosed(['[', ']'], self.iter(), text, T::write);
    }
}

impl<T: Json, const N: usize> Json for [T; N] {
    fn write(&self, text: &mut String) {
        enclosed(['[', ']'], self.iter(), text, T::write);
    }
}
