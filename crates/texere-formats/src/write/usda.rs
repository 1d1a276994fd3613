//! What stages in the text form of Universal Scene Description begin with, and how they write
//! values.

/// The lines with which a stage begins, up to its first prim. The stage ends with `}`.
pub(super) const START: &str = concat!(
    "#usda 1.0\n(\n    defaultPrim = \"cloth\"\n    doc = \"texere ",
    env!("CARGO_PKG_VERSION"),
    ": x along the weft or course, y along the warp or wale, z out of the face\"\n    metersPerUnit = \
     0.001\n    upAxis = \"Z\"\n)\n\ndef Xform \"cloth\" (\n    kind = \"component\"\n)\n{\n"
);

/// A point or a colour as the format writes it.
pub(super) fn triple([x, y, z]: [f32; 3]) -> String {
    format!("({x}, {y}, {z})")
}

/// A text in quotes as the format writes it. Control characters become spaces.
pub(super) fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for character in text.chars() {
        match character {
            '"' | '\\' => quoted.extend(['\\', character]),
            other if other.is_control() => quoted.push(' '),
            other => quoted.push(other),
        }
    }
    quoted + "\""
}
