//! MTL: the materials of an OBJ file.

use std::fmt::Write;
use std::path::Path;

use texere_core::Material;

/// The extension of a file of materials.
pub(in crate::write) const LIBRARY: &str = "mtl";

/// The most letters that a file keeps of a material's own name.
const NAME_MOST: usize = 60;

/// The name of a material in the files: its number, then its own name. The number keeps names
/// apart. Spaces become underscores, because a space would end the name.
pub(super) fn material_name(number: u32, materials: &[Material]) -> String {
    let own = materials.get(number as usize).map_or("", |material| &material.name);
    let plain = |letter: char| if letter.is_whitespace() || letter.is_control() { '_' } else { letter };
    format!("{number}_{}", own.chars().take(NAME_MOST).map(plain).collect::<String>())
}

/// The name of the file of materials that belongs to the OBJ file at `path`. If the OBJ file goes
/// to a caller's writer, the name is `materials.mtl`.
pub(in crate::write) fn library_name(path: Option<&Path>) -> String {
    let own = path.map(|path| path.with_extension(LIBRARY));
    let name = own.as_deref().and_then(Path::file_name).map(|name| name.to_string_lossy());
    // The name may not have line breaks, because it ends with its line.
    name.map_or_else(|| "materials.mtl".into(), |name| name.replace(['\n', '\r'], "_"))
}

/// The text of a file of materials. Colours are sRGB, which readers expect.
pub(in crate::write) fn library(materials: &[Material]) -> String {
    let mut text = format!("# texere {}\n", env!("CARGO_PKG_VERSION"));
    for (number, material) in materials.iter().enumerate() {
        let [red, green, blue] = material.srgb.map(|channel| f32::from(channel) / 255.0);
        let name = material_name(number as u32, materials);
        // Writing to a string does not fail. `Kd` is the diffuse colour. The material mirrors no
        // light (`Ks`) and is opaque (`d`).
        let _ = writeln!(text, "newmtl {name}\nKd {red} {green} {blue}\nKs 0 0 0\nd 1\nillum 1");
    }
    text
}
