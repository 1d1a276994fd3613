//! The part of the glTF 2.0 schema that a fabric needs, under the specification's own names.

use super::json::{Json, object, objects};

/// The numbers below are OpenGL's, which glTF uses for kinds of numbers and kinds of buffers. This
/// is the kind of signed 8-bit numbers.
pub(super) const BYTE: u32 = 5120;
/// Signed 16-bit numbers.
pub(super) const SHORT: u32 = 5122;
/// Unsigned 32-bit numbers.
pub(super) const UNSIGNED_INT: u32 = 5125;
/// 32-bit floats.
pub(super) const FLOAT: u32 = 5126;
/// A buffer of vertices.
pub(super) const ARRAY_BUFFER: u32 = 34962;
/// A buffer of indices.
pub(super) const ELEMENT_ARRAY_BUFFER: u32 = 34963;

objects! {
    Gltf {
        "asset" asset: Asset,
        "extensionsUsed" extensions_used: Vec<&'static str>,
        "extensionsRequired" extensions_required: Vec<&'static str>,
        "scene" scene: usize,
        "scenes" scenes: [Scene; 1],
        "nodes" nodes: Vec<Node>,
        "meshes" meshes: Vec<Mesh>,
        "materials" materials: Vec<Material>,
        "accessors" accessors: Vec<Accessor>,
        "bufferViews" buffer_views: Vec<BufferView>,
        "buffers" buffers: Vec<Buffer>,
    }

    Asset {
        "version" version: &'static str,
        "generator" generator: &'static str,
    }

    Scene {
        "nodes" nodes: [usize; 1],
    }

    #[derive(Default)]
    Node {
        "name" name: String,
        "mesh" mesh: Option<usize>,
        "translation" translation: Option<[f32; 3]>,
        "scale" scale: Option<[f32; 3]>,
        "children" children: Vec<usize>,
        "extensions" extensions: Option<NodeExtensions>,
    }

    NodeExtensions {
        "EXT_mesh_gpu_instancing" instancing: Instancing,
    }

    Instancing {
        "attributes" attributes: Attributes,
    }

    Mesh {
        "name" name: String,
        "primitives" primitives: Vec<Primitive>,
    }

    Primitive {
        "attributes" attributes: Attributes,
        "indices" indices: usize,
        "material" material: u32,
    }

    Material {
        "name" name: String,
        "pbrMetallicRoughness" pbr_metallic_roughness: MetallicRoughness,
    }

    MetallicRoughness {
        "baseColorFactor" base_color_factor: [f32; 4],
        "metallicFactor" metallic_factor: f32,
        "roughnessFactor" roughness_factor: f32,
    }

    Accessor {
        "bufferView" buffer_view: usize,
        "byteOffset" byte_offset: u64,
        "componentType" component_type: u32,
        "normalized" normalized: Option<bool>,
        "count" count: u64,
        "type" shape: &'static str,
        "min" min: Option<[f32; 3]>,
        "max" max: Option<[f32; 3]>,
    }

    BufferView {
        "buffer" buffer: usize,
        "byteOffset" byte_offset: u64,
        "byteLength" byte_length: u64,
        "byteStride" byte_stride: Option<u64>,
        "target" target: Option<u32>,
        "extensions" extensions: Option<Extension<Compression>>,
    }

    Compression {
        "buffer" buffer: usize,
        "byteOffset" byte_offset: u64,
        "byteLength" byte_length: u64,
        "byteStride" byte_stride: u64,
        "count" count: u64,
        "mode" mode: &'static str,
        "filter" filter: Option<&'static str>,
    }

    Buffer {
        "byteLength" byte_length: u64,
        "extensions" extensions: Option<Extension<Fallback>>,
    }

    Fallback {
        "fallback" fallback: bool,
    }
}

/// What an extension says of a buffer view or a buffer.
#[derive(Debug)]
pub(super) struct Extension<T> {
    pub(super) name: &'static str,
    pub(super) value: T,
}

impl<T: Json> Json for Extension<T> {
    fn write(&self, text: &mut String) {
        object(&[(self.name, &self.value)], text);
    }
}

/// The accessors of a primitive's vertices, or of a node's instances, by what they hold.
#[derive(Debug)]
pub(super) struct Attributes(pub(super) Vec<(&'static str, usize)>);

impl Json for Attributes {
    fn write(&self, text: &mut String) {
        let fields: Vec<_> =
            self.0.iter().map(|(semantic, accessor)| (*semantic, accessor as &dyn Json)).collect();
        object(&fields, text);
    }
}
