//! U3M 1.1 documents, which fashion programs open.

use serde_json::{Value, json};
use texere_core::Material;

use crate::Maps;

/// One side of a material, for its document.
pub(crate) struct Visual<'a> {
    pub(crate) maps: &'a Maps,
    /// `front` or `back`.
    pub(crate) name: &'static str,
    /// The least and the greatest height of both sides, mm.
    pub(crate) heights: [f32; 2],
    pub(crate) preview: Value,
}

/// What a material is apart from its looks.
pub(crate) struct About<'a> {
    pub(crate) id: String,
    pub(crate) name: &'a str,
    /// The time at which the material was made, in the format of RFC 3339.
    pub(crate) time: &'a str,
    pub(crate) thickness_mm: f64,
    /// Weight, g/m², if it is known.
    pub(crate) weight: Option<f64>,
    /// `Woven` or `Knit`.
    pub(crate) kind: &'static str,
}

/// The document of a material.
pub(crate) fn document(about: &About<'_>, [front, back]: [Visual<'_>; 2]) -> Value {
    json!({
        "schema": "1.1",
        "material": {
            "id": about.id,
            "name": about.name,
            "description": "",
            "created": about.time,
            "modified": about.time,
            "front": front.json(),
            "back": back.json(),
            "side": null,
            "physics": {
                "thickness": about.thickness_mm,
                "weight": about.weight,
                "devices": { "fab": "null" },
                "composition": null,
                "material_type": { "type": about.kind, "name": null },
                "construction": null,
            },
            "metadata": null,
        },
        "custom": null,
    })
}

/// An image in a document: its size, resolution and path.
pub(crate) fn image(size: [u32; 2], size_mm: [f64; 2], path: &str) -> Value {
    let dpi = [0, 1].map(|axis| f64::from(size[axis]) * 25.4 / size_mm[axis]);
    json!({
        "width": size_mm[0],
        "height": size_mm[1],
        "dpi": { "x": dpi[0], "y": dpi[1] },
        "path": path,
    })
}

impl Visual<'_> {
    fn json(&self) -> Value {
        let [low, high] = self.heights.map(f64::from);
        let number = |constant: f64| json!({ "constant": constant, "texture": null });
        let white = json!({ "r": 1.0, "g": 1.0, "b": 1.0 });
        let level = json!({ "x": 0.0, "y": 0.0, "z": 1.0 });
        json!({
            "basecolor": {
                "constant": self.mean_color(),
                "texture": { "mode": "multiply", "factor": white, "image": self.image("basecolor") },
            },
            "alpha": self.scalar("alpha", mean(&self.maps.alpha), [0.0, 1.0]),
            "normal": { "constant": level, "texture": { "scale": 1.0, "image": self.image("normal") } },
            "displacement": self.scalar("displacement", mean(&self.maps.height), [low, high]),
            "roughness": self.scalar("roughness", mean(&self.maps.roughness), [0.0, 1.0]),
            "anisotropy_value": number(0.0),
            "anisotropy_rotation": number(0.0),
            "clearcoat_value": number(0.0),
            "clearcoat_normal": { "constant": level, "texture": null },
            "clearcoat_roughness": number(0.0),
            // Fibres of cellulose and of polyester have refractive indices of 1.53 to 1.6 (Morton
            // and Hearle 2008).
            "ior": number(1.55),
            "metalness": number(0.0),
            "sheen_value": number(0.0),
            "sheen_tint": number(0.0),
            "specular_value": number(0.5),
            "specular_tint": number(0.0),
            "subsurface_radius": number(0.0),
            "subsurface_value": number(0.0),
            "subsurface_color": { "constant": white, "texture": null },
            "transmission": number(0.0),
            "shader": "principled",
            "preview": self.preview,
        })
    }

    /// A map of numbers. `low` and `high` are the numbers that its PNG shows as black and as white.
    fn scalar(&self, map: &str, constant: f64, [low, high]: [f64; 2]) -> Value {
        let texture = json!({ "factor": high - low, "offset": low, "image": self.image(map) });
        json!({ "constant": constant, "texture": texture })
    }

    fn image(&self, map: &str) -> Value {
        let path = format!("textures/{}_{map}.png", self.name);
        let mut image = image(self.maps.size, self.maps.size_mm, &path);
        image["repeat"] = json!({ "rotation": 0.0, "mode": "normal" });
        image
    }

    /// The mean colour in sRGB, the colour space of U3M.
    fn mean_color(&self) -> Value {
        let mean = [0, 1, 2].map(|channel| {
            let shown = self.maps.color.iter().zip(&self.maps.alpha);
            let (sum, share) = shown.fold((0.0, 0.0), |(sum, share), (color, alpha)| {
                (sum + f64::from(color[channel] * alpha), share + f64::from(*alpha))
            });
            Material::encoded(if share > 0.0 { (sum / share) as f32 } else { 0.0 })
        });
        json!({ "r": mean[0].clamp(0.0, 1.0), "g": mean[1].clamp(0.0, 1.0), "b": mean[2].clamp(0.0, 1.0) })
    }
}

fn mean(values: &[f32]) -> f64 {
    values.iter().map(|value| f64::from(*value)).sum::<f64>() / values.len().max(1) as f64
}
