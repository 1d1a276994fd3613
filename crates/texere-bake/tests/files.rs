//! The folder of a baked cloth: its documents keep to their specifications, and its maps come back
//! from their files.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test may panic")]

mod cloth;

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::BufReader;
use std::path::Path;

use cloth::{JERSEY, TWILL, baked};
use serde_json::Value;
use texere_bake::{BakeError, BakeOptions};

fn keys(value: &Value) -> Vec<&str> {
    value.as_object().unwrap().keys().map(String::as_str).collect()
}

/// Checks a value against the schema of U3M 1.1: its keys, the keys of its texture (`own`), and the
/// texture's image and file.
fn texture(folder: &Path, value: &Value, own: &[&str]) {
    assert_eq!(keys(value), ["constant", "texture"]);
    let texture = &value["texture"];
    if texture.is_null() {
        return;
    }
    assert_eq!(keys(texture), own);
    let image = &texture["image"];
    assert_eq!(keys(image), ["dpi", "height", "path", "repeat", "width"]);
    assert_eq!(image["repeat"], serde_json::json!({ "mode": "normal", "rotation": 0.0 }));
    let path = image["path"].as_str().unwrap();
    assert!(
        path.chars().all(|letter| letter.is_ascii_alphanumeric() || "/_.".contains(letter))
            && !path.contains("..")
    );
    let decoder = png::Decoder::new(BufReader::new(File::open(folder.join(path)).unwrap()));
    let reader = decoder.read_info().unwrap();
    let info = reader.info();
    // The kind of PNG that every reader of U3M has to know.
    assert_eq!(info.color_type, png::ColorType::Rgb);
    for (side, texels, dpi) in [("width", info.width, "x"), ("height", info.height, "y")] {
        let mm = image[side].as_f64().unwrap();
        let wanted = f64::from(texels) * 25.4 / mm;
        assert!((image["dpi"][dpi].as_f64().unwrap() - wanted).abs() < 1e-6 * wanted);
    }
}

/// The keys that the schema of U3M 1.1 requires for a side of a material. It allows no others.
const VISUAL: [&str; 22] = [
    "alpha",
    "anisotropy_rotation",
    "anisotropy_value",
    "basecolor",
    "clearcoat_normal",
    "clearcoat_roughness",
    "clearcoat_value",
    "displacement",
    "ior",
    "metalness",
    "normal",
    "preview",
    "roughness",
    "shader",
    "sheen_tint",
    "sheen_value",
    "specular_tint",
    "specular_value",
    "subsurface_color",
    "subsurface_radius",
    "subsurface_value",
    "transmission",
];

#[test]
fn u3m_is_as_its_schema_says() {
    let parent = tempfile::tempdir().unwrap();
    for (name, text, kind) in [("twill", TWILL, "Woven"), ("jersey", JERSEY, "Knit")] {
        let folder = parent.path().join(name);
        let material = baked(text, &BakeOptions::default());
        let [u3m, ..] = material.write(&folder).unwrap();
        let document: Value = serde_json::from_slice(&fs::read(folder.join(u3m)).unwrap()).unwrap();
        assert_eq!(keys(&document), ["custom", "material", "schema"]);
        assert_eq!(document["schema"], "1.1");
        let own = &document["material"];
        let all = [
            "back",
            "created",
            "description",
            "front",
            "id",
            "metadata",
            "modified",
            "name",
            "physics",
            "side",
        ];
        assert_eq!(keys(own), all);
        let id: Vec<char> = own["id"].as_str().unwrap().chars().collect();
        assert!(id.len() == 36 && id[14] == '4' && "89ab".contains(id[19]));
        assert!(own["created"].as_str().unwrap().ends_with('Z') && own["side"].is_null());
        let physics = &own["physics"];
        assert_eq!(
            keys(physics),
            ["composition", "construction", "devices", "material_type", "thickness", "weight"]
        );
        assert_eq!(physics["material_type"], serde_json::json!({ "name": null, "type": kind }));
        let thickness = physics["thickness"].as_f64().unwrap();
        assert!((thickness - material.thickness_mm).abs() < 1e-12);
        let [weight, exact] = [physics["weight"].as_f64().unwrap(), material.weight.unwrap()];
        assert!((weight - exact).abs() < 1e-12 * exact);
        for side in ["front", "back"] {
            let visual = &own[side];
            assert_eq!(keys(visual), VISUAL);
            for (map, value) in visual.as_object().unwrap() {
                match map.as_str() {
                    "shader" => assert_eq!(value, "principled"),
                    "preview" => {
                        assert!(value.is_null() || keys(value) == ["dpi", "height", "path", "width"])
                    }
                    "basecolor" | "subsurface_color" => texture(&folder, value, &["factor", "image", "mode"]),
                    "normal" | "clearcoat_normal" => texture(&folder, value, &["image", "scale"]),
                    _ => texture(&folder, value, &["factor", "image", "offset"]),
                }
            }
            // The document's `factor` and `offset` turn the values of the PNG back into heights.
            let height = &visual["displacement"]["texture"];
            let [factor, offset] = ["factor", "offset"].map(|key| height[key].as_f64().unwrap());
            let maps = if side == "front" { &material.front } else { &material.back };
            let values = png_of(&folder.join(height["image"]["path"].as_str().unwrap()));
            for (value, exact) in values.iter().zip(&maps.height) {
                let mm = offset + factor * f64::from(value[0]) / 65_535.0;
                assert!((mm - f64::from(*exact)).abs() < factor / 65_535.0, "{mm} for {exact}");
            }
        }
    }
}

/// The texels of a PNG, each channel as it is stored.
fn png_of(path: &Path) -> Vec<[u16; 3]> {
    let mut reader = png::Decoder::new(BufReader::new(File::open(path).unwrap())).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    let channels: Vec<u16> = match info.bit_depth {
        png::BitDepth::Sixteen => {
            bytes.chunks_exact(2).map(|two| u16::from_be_bytes([two[0], two[1]])).collect()
        }
        _ => bytes.into_iter().map(u16::from).collect(),
    };
    channels.chunks_exact(3).map(|three| [three[0], three[1], three[2]]).collect()
}

#[test]
fn maps_come_back_from_their_files() {
    let parent = tempfile::tempdir().unwrap();
    let folder = parent.path().join("twill");
    let material = baked(TWILL, &BakeOptions::default());
    material.write(&folder).unwrap();
    let maps = &material.back;
    let exr = |map: &str| {
        let image =
            exr::prelude::read_all_flat_layers_from_file(folder.join(format!("textures/back_{map}.exr")))
                .unwrap();
        let layer = &image.layer_data[0];
        assert_eq!([layer.size.0 as u32, layer.size.1 as u32], maps.size);
        layer.channel_data.list.iter().map(|channel| channel.sample_data.clone()).collect::<Vec<_>>()
    };
    use exr::prelude::FlatSamples::{F32, U32};
    // An EXR lists its channels in the order of their names: B, G, R.
    for (map, values) in [("basecolor", &maps.color), ("normal", &maps.normal)] {
        for (number, channel) in exr(map).into_iter().enumerate() {
            let own = values.iter().map(|value| value[2 - number]).collect();
            assert!(channel == F32(own), "{map}");
        }
    }
    for (map, values) in [
        ("alpha", &maps.alpha),
        ("displacement", &maps.height),
        ("roughness", &maps.roughness),
        ("occlusion", &maps.occlusion),
    ] {
        assert!(exr(map)[0] == F32(values.clone()), "{map}");
    }
    assert!(exr("yarn")[0] == U32(maps.yarn.clone()));
    assert!(exr("uv")[1] == F32(maps.uv.iter().map(|uv| uv[1]).collect()));
    // PNG gives normals back within a step of 16 bits, and numbers of yarns exactly.
    for (value, exact) in png_of(&folder.join("textures/back_normal.png")).iter().zip(&maps.normal) {
        for (value, exact) in value.iter().zip(exact) {
            assert!((f32::from(*value) / 65_535.0 * 2.0 - 1.0 - exact).abs() < 2.0 / 65_535.0);
        }
    }
    for (value, exact) in png_of(&folder.join("textures/back_yarn.png")).iter().zip(&maps.yarn) {
        let number = u32::from(value[0]) | u32::from(value[1]) << 8 | u32::from(value[2]) << 16;
        assert_eq!(number, exact.wrapping_add(1));
    }
    let listed: Value = serde_json::from_slice(&fs::read(folder.join("yarns.json")).unwrap()).unwrap();
    for (number, (origin, _)) in maps.yarns.iter().enumerate() {
        assert_eq!(listed["back"][number]["yarn"], origin.to_string());
    }
}

/// Reads U3MA, and accepts only what its specification allows. Returns all files by name.
fn unpacked(bytes: &[u8]) -> BTreeMap<String, Vec<u8>> {
    let short = |at: usize| u16::from_le_bytes([bytes[at], bytes[at + 1]]);
    let long = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
    let end = bytes.len() - 22;
    assert_eq!((long(end), long(end + 4), short(end + 20)), (0x0605_4b50, 0, 0));
    let (count, length, mut at) = (short(end + 8), long(end + 12) as usize, long(end + 16) as usize);
    assert_eq!((count, at + length), (short(end + 10), end));
    let (mut files, mut next) = (BTreeMap::new(), 0);
    for _ in 0..count {
        assert_eq!((long(at), short(at + 4), short(at + 6)), (0x0201_4b50, 0x3f, 0x14));
        // Names are UTF-8, and content is stored without compression.
        assert_eq!((short(at + 8), short(at + 10)), (1 << 11, 0));
        let (crc, packed, size) = (long(at + 16), long(at + 20) as usize, long(at + 24) as usize);
        assert_eq!(packed, size);
        let name = short(at + 28) as usize;
        // No extra field, comment, disk or attributes.
        assert!(bytes[at + 30..at + 42].iter().all(|byte| *byte == 0));
        let offset = long(at + 42) as usize;
        assert_eq!((offset, long(offset)), (next, 0x0403_4b50));
        assert_eq!(bytes[offset + 4..offset + 28], bytes[at + 6..at + 30]);
        assert_eq!(short(offset + 28), 0);
        let names = [&bytes[at + 46..at + 46 + name], &bytes[offset + 30..offset + 30 + name]];
        assert_eq!(names[0], names[1]);
        let content = bytes[offset + 30 + name..][..size].to_vec();
        assert_eq!(crc32fast::hash(&content), crc);
        files.insert(String::from_utf8(names[0].to_vec()).unwrap(), content);
        next = offset + 30 + name + size;
        at += 46 + name;
    }
    assert_eq!(at, end);
    files
}

#[test]
fn u3ma_holds_what_u3m_names() {
    let parent = tempfile::tempdir().unwrap();
    let folder = parent.path().join("jersey");
    let [u3m, u3ma, mtlx] = baked(JERSEY, &BakeOptions::default()).write(&folder).unwrap();
    let files = unpacked(&fs::read(folder.join(&u3ma)).unwrap());
    assert_eq!(files.len(), 18);
    for (name, content) in &files {
        assert!(fs::read(folder.join(name)).unwrap() == *content, "{name}");
    }
    let document = String::from_utf8(files[&u3m].clone()).unwrap();
    for path in document.split('"').filter(|text| text.ends_with(".png")) {
        assert!(files.contains_key(path), "{path}");
    }
    let mtlx = fs::read_to_string(folder.join(mtlx)).unwrap();
    for path in mtlx.split('"').filter(|text| text.ends_with(".png")) {
        assert!(folder.join(path).is_file(), "{path}");
    }
}

#[test]
fn a_folder_with_files_in_it_stays() {
    let parent = tempfile::tempdir().unwrap();
    let folder = parent.path().join("cloth");
    fs::create_dir(&folder).unwrap();
    let material = baked(JERSEY, &BakeOptions::default().texel_mm(0.2));
    // An empty folder is filled.
    material.write(&folder).unwrap();
    let before: Vec<_> = fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    let error = material.write(&folder).unwrap_err();
    assert!(matches!(error, BakeError::Write(_)), "{error}");
    assert!(material.write(parent.path().join("none/cloth")).is_err());
    let after: Vec<_> = fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(before, after);
    // Nothing else is left behind.
    assert_eq!(fs::read_dir(parent.path()).unwrap().count(), 1);
}
