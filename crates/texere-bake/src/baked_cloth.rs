//! A baked cloth, and its folder.

use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use serde_json::{Value, json};
use texere_core::Material;
use texere_formats::write;

use crate::images::Map;
use crate::u3m::{About, Visual};
use crate::{BakeError, Maps, archive, mtlx, u3m};

/// The most letters of the design's name that the names of its files keep.
const NAME_MOST: usize = 60;

/// A baked cloth: maps of its face and of its back, and what else a program that shows cloth asks
/// for, such as weight and thickness.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct BakedCloth {
    /// The design's name.
    pub name: String,
    /// The face.
    pub front: Maps,
    /// The back, as it is seen from behind.
    pub back: Maps,
    /// Whether the maps tile: what leaves them at one edge comes in at the opposite one.
    pub tiles: bool,
    /// Whether the cloth is woven; otherwise it is a knit.
    pub is_woven: bool,
    /// Weight, g/m², if all yarns' weights are known.
    pub weight: Option<f64>,
    /// Thickness from the lowest yarn to the highest, mm.
    pub thickness_mm: f64,
    /// Width and height of the preview, pixels, and the red, green and blue of each pixel.
    pub preview: ([u32; 2], Vec<u8>),
    /// The materials of the yarns.
    pub(crate) yarns: Vec<Material>,
}

impl BakedCloth {
    /// Writes the material's maps and documents into a new folder at `path`. The folder appears
    /// with all its files, or not at all. Returns the names of the documents: U3M, U3MA and
    /// MaterialX.
    ///
    /// **Errors**: [`BakeError::Write`] if there is something at `path` already that is not an
    /// empty folder, if the preview can't be written, or if the file system refuses, and
    /// [`BakeError::Image`] if a map or a document can't be written.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<[String; 3], BakeError> {
        let name = file_name(&self.name);
        let documents = ["u3m", "u3ma", "mtlx"].map(|ending| format!("{name}.{ending}"));
        write::folder(path.as_ref(), |folder| self.fill(folder, &documents))?;
        Ok(documents)
    }

    fn fill(&self, folder: &Path, [u3m, u3ma, mtlx]: &[String; 3]) -> Result<(), BakeError> {
        let refused = |path: &Path| {
            let path = path.to_owned();
            move |source: io::Error| BakeError::Image { path, source: source.into() }
        };
        let textures = folder.join("textures");
        fs::create_dir(&textures).map_err(refused(&textures))?;
        let (heights, longest) = (self.heights(), self.longest_mm());
        let mut names = vec![u3m.clone()];
        for (side, maps) in [("front", &self.front), ("back", &self.back)] {
            let texel = [0, 1].map(|axis| maps.size_mm[axis] / f64::from(maps.size[axis]));
            for map in Map::all(maps, heights, longest) {
                let name = format!("{side}_{}.png", map.name);
                map.png(&textures.join(&name), maps.size, texel)?;
                map.exr(&textures.join(format!("{side}_{}.exr", map.name)), maps.size)?;
                names.push(format!("textures/{name}"));
            }
        }
        names.push("preview.png".into());
        let preview = folder.join("preview.png");
        write::picture(self.preview.0, &self.preview.1, &preview)?;
        let text = |name: &str, text: String| {
            let path = folder.join(name);
            fs::write(&path, text).map_err(refused(&path))
        };
        let now = jiff::Timestamp::now();
        text(u3m, format!("{:#}\n", self.document(&now.to_string(), heights)))?;
        text(mtlx, mtlx::document(&self.name, &self.front, heights))?;
        text("yarns.json", format!("{:#}\n", self.listed(longest)))?;
        let path = folder.join(u3ma);
        let packed = || {
            let mut out = BufWriter::new(fs::File::create(&path)?);
            let files = names.iter().map(|name| Ok((name.clone(), fs::read(folder.join(name))?)));
            archive::write(&mut out, files, dos_time(now))?;
            out.flush()
        };
        packed().map_err(refused(&path))
    }

    fn document(&self, time: &str, heights: [f32; 2]) -> Value {
        let [preview, none] = [u3m::image(self.preview.0, self.front.size_mm, "preview.png"), Value::Null];
        let about = About {
            id: uuid::Uuid::new_v4().to_string(),
            name: if self.name.is_empty() { "cloth" } else { &self.name },
            time,
            thickness_mm: self.thickness_mm,
            weight: self.weight,
            kind: if self.is_woven { "Woven" } else { "Knit" },
        };
        let visual = |name, maps, preview| Visual { maps, name, heights, preview };
        u3m::document(&about, [visual("front", &self.front, preview), visual("back", &self.back, none)])
    }

    /// The content of `yarns.json`: the yarns that the numbers in the maps of yarns stand for.
    fn listed(&self, longest: f32) -> Value {
        let side = |maps: &Maps| {
            let yarns = maps.yarns.iter().enumerate().map(|(number, (origin, material))| {
                let yarn = &self.yarns[*material as usize];
                let [red, green, blue] = yarn.srgb;
                json!({
                    "number": number,
                    "yarn": origin.to_string(),
                    "material": yarn.name,
                    "color": format!("#{red:02x}{green:02x}{blue:02x}"),
                })
            });
            yarns.collect::<Vec<_>>()
        };
        json!({
            "about": "textures/*_yarn.exr have these numbers, and 4294967295 where no yarn is. The PNG files have the \
                      number plus 1 in 24 bits, red the lowest. textures/*_uv.exr have turns round the yarn (U) and mm \
                      along it (V). The PNG files show U of 1 and V of `white_mm` as white.",
            "white_mm": longest,
            "tiles": self.tiles,
            "size_mm": self.front.size_mm,
            "front": side(&self.front),
            "back": side(&self.back),
        })
    }

    /// The least and the greatest height of both sides, mm.
    fn heights(&self) -> [f32; 2] {
        let [front, back] = [&self.front, &self.back].map(Maps::heights_mm);
        [front[0].min(back[0]), front[1].max(back[1])]
    }

    /// The greatest distance along a yarn, mm.
    fn longest_mm(&self) -> f32 {
        [&self.front, &self.back].into_iter().flat_map(|maps| &maps.uv).fold(0.0, |most, uv| most.max(uv[1]))
    }
}

/// Turns a name into one that every file system takes: ASCII letters, digits and underscores.
fn file_name(name: &str) -> String {
    let plain = |letter: char| if letter.is_ascii_alphanumeric() { letter } else { '_' };
    let name: String = name.chars().take(NAME_MOST).map(plain).collect();
    let name = name.trim_matches('_');
    // Windows reserves names such as CON.
    let kept = ["con", "prn", "aux", "nul", "clock"];
    let is_kept = kept.contains(&name.to_lowercase().as_str())
        || (name.len() == 4 && ["com", "lpt"].iter().any(|port| name.to_lowercase().starts_with(port)));
    if name.is_empty() || is_kept {
        format!("cloth{}{name}", if name.is_empty() { "" } else { "_" })
    } else {
        name.into()
    }
}

/// Time and date in UTC, in the format of MS-DOS. The format holds the years from 1980 to 2107.
fn dos_time(now: jiff::Timestamp) -> [u16; 2] {
    let now = now.to_zoned(jiff::tz::TimeZone::UTC);
    let number = |value: i8| value as u16;
    let year = (now.year().clamp(1980, 2107) - 1980) as u16;
    [
        (number(now.hour()) << 11) | (number(now.minute()) << 5) | (number(now.second()) / 2),
        (year << 9) | (number(now.month()) << 5) | number(now.day()),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_files_are_plain() {
        for (name, plain) in [
            ("Denim 3/1", "Denim_3_1"),
            ("", "cloth"),
            ("../../etc", "etc"),
            ("con", "cloth_con"),
            ("COM1", "cloth_COM1"),
            ("žinilka", "inilka"),
            ("$HOME%", "HOME"),
        ] {
            assert_eq!(file_name(name), plain, "{name}");
        }
        assert!(file_name(&"x".repeat(500)).len() <= NAME_MOST);
    }
}
