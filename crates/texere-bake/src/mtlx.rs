//! MaterialX documents, which renderers and studios open.

use std::fmt::Write;

use crate::Maps;

/// The document of a material whose face has `maps`. `heights` are the two heights that the PNG of
/// displacement shows as black and as white, mm. Texture coordinates are those of a plane in its
/// true size: one unit is one metre of cloth. The map of occlusion is not connected to the surface,
/// because renderers work out for themselves what takes light away. The document names the map for
/// programs that do not work this out.
pub(crate) fn document(name: &str, maps: &Maps, heights: [f32; 2]) -> String {
    let [width, height] = maps.size_mm.map(|mm| mm / 1000.0);
    let mut text = String::from("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n");
    // Writing to a string does not fail.
    let _ = writeln!(
        text,
        "<materialx version=\"1.38\" colorspace=\"lin_rec709\">\n  <!-- {}: {} by {} mm. One unit of texture \
         coordinates is one metre. -->",
        comment(name),
        maps.size_mm[0],
        maps.size_mm[1]
    );
    for (map, kind, space) in [
        ("basecolor", "color3", " colorspace=\"srgb_texture\""),
        ("alpha", "float", ""),
        ("normal", "vector3", ""),
        ("displacement", "float", ""),
        ("roughness", "float", ""),
        ("occlusion", "float", ""),
    ] {
        let _ = writeln!(
            text,
            "  <tiledimage name=\"{map}\" type=\"{kind}\">\n    <input name=\"file\" type=\"filename\" \
             value=\"textures/front_{map}.png\"{space} />\n    <input name=\"realworldimagesize\" type=\"vector2\" \
             value=\"{width}, {height}\" />\n    <input name=\"realworldtilesize\" type=\"vector2\" value=\"1, 1\" \
             />\n  </tiledimage>"
        );
    }
    let [low, high] = heights.map(|mm| f64::from(mm) / 1000.0);
    text.push_str(SURFACE);
    let _ = write!(
        text,
        "  <multiply name=\"range\" type=\"float\">\n    <input name=\"in1\" type=\"float\" \
         nodename=\"displacement\" />\n    <input name=\"in2\" type=\"float\" value=\"{}\" />\n  </multiply>\n  \
         <add name=\"height\" type=\"float\">\n    <input name=\"in1\" type=\"float\" nodename=\"range\" />\n    \
         <input name=\"in2\" type=\"float\" value=\"{low}\" />\n  </add>\n",
        high - low
    );
    text.push_str(MATERIAL);
    text
}

/// The surface, from the nodes that read the maps.
const SURFACE: &str = r#"  <normalmap name="bumps" type="vector3">
    <input name="in" type="vector3" nodename="normal" />
  </normalmap>
  <convert name="opacity" type="color3">
    <input name="in" type="float" nodename="alpha" />
  </convert>
  <standard_surface name="surface" type="surfaceshader">
    <input name="base" type="float" value="1" />
    <input name="base_color" type="color3" nodename="basecolor" />
    <input name="specular_roughness" type="float" nodename="roughness" />
    <input name="specular_IOR" type="float" value="1.55" />
    <input name="opacity" type="color3" nodename="opacity" />
    <input name="normal" type="vector3" nodename="bumps" />
  </standard_surface>
"#;

/// The displacement and the material, and the end of the document.
const MATERIAL: &str = r#"  <displacement name="relief" type="displacementshader">
    <input name="displacement" type="float" nodename="height" />
    <input name="scale" type="float" value="1" />
  </displacement>
  <surfacematerial name="cloth" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="surface" />
    <input name="displacementshader" type="displacementshader" nodename="relief" />
  </surfacematerial>
</materialx>
"#;

/// A name for use within an XML comment, which may not have two hyphens in a row.
fn comment(name: &str) -> String {
    let name = name.replace('-', "\u{2010}").replace('&', "&amp;").replace('<', "&lt;");
    name.chars().filter(|letter| !letter.is_control()).collect()
}
