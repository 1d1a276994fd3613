//! Compressed GLB files, decoded by meshoptimizer.

use gltf::Gltf;
use meshopt::{decode_filter_oct, decode_index_buffer, decode_vertex_buffer};
use serde_json::Value;
use texere_formats::write::Format;

/// A compressed file.
pub(crate) struct Unpacked {
    pub(crate) gltf: Gltf,
    /// The buffer that the file doesn't hold, to which all buffer views refer.
    pub(crate) buffer: Vec<u8>,
}

/// Decodes a file of a compressed `format`, and checks the rules of its extension on the way.
pub(crate) fn unpack(bytes: &[u8], format: Format) -> Unpacked {
    // A stream of attributes says its version in its first byte.
    let (extension, version) = match format {
        Format::CompressedGlb => ("EXT_meshopt_compression", 0xa0),
        _ => ("KHR_meshopt_compression", 0xa1),
    };
    let length = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
    assert_eq!(length(8), bytes.len());
    let json: Value = serde_json::from_slice(&bytes[20..20 + length(12)]).unwrap();
    // The gltf crate refuses files that need an extension.
    let gltf = Gltf::from_slice_without_validation(bytes).unwrap();
    let blob = gltf.blob.as_deref().unwrap();
    let [own, fallback] = <[Value; 2]>::try_from(json["buffers"].as_array().unwrap().clone()).unwrap();
    assert_eq!((own["byteLength"].as_u64(), own.get("uri")), (Some(blob.len() as u64), None));
    let extensions = serde_json::json!(["KHR_mesh_quantization", extension]);
    assert_eq!((&json["extensionsUsed"], &json["extensionsRequired"]), (&extensions, &extensions));
    let marked = serde_json::json!({ extension: { "fallback": true } });
    assert_eq!((&fallback["extensions"], fallback.get("uri")), (&marked, None));
    let mut buffer = Vec::new();
    let mut end = 0;
    for view in json["bufferViews"].as_array().unwrap() {
        let number = |value: &Value| value.as_u64().unwrap() as usize;
        let compression = &view["extensions"][extension];
        assert_eq!((number(&view["buffer"]), number(&compression["buffer"])), (1, 0));
        let [stride, count] = ["byteStride", "count"].map(|key| number(&compression[key]));
        assert!(view.get("byteStride").is_none_or(|own| number(own) == stride));
        assert_eq!(number(&view["byteLength"]), stride * count);
        // Views follow one another, both compressed and decoded.
        assert_eq!((number(&view["byteOffset"]), number(&compression["byteOffset"])), (buffer.len(), end));
        let stream = &blob[end..end + number(&compression["byteLength"])];
        assert_eq!(stream[0], if compression["mode"] == "ATTRIBUTES" { version } else { 0xe1 });
        end += stream.len();
        buffer.extend(decoded(stream, stride, count, compression));
    }
    assert_eq!(blob.len(), end.next_multiple_of(4));
    assert_eq!(fallback["byteLength"].as_u64(), Some(buffer.len() as u64));
    Unpacked { gltf, buffer }
}

fn decoded(stream: &[u8], stride: usize, count: usize, compression: &Value) -> Vec<u8> {
    let filter = compression.get("filter").map(|filter| filter.as_str().unwrap());
    match (compression["mode"].as_str().unwrap(), stride, filter) {
        ("TRIANGLES", 4, None) => {
            bytemuck::cast_slice(&decode_index_buffer::<u32>(stream, count).unwrap()).to_vec()
        }
        ("ATTRIBUTES", 4, None) => decode_vertex_buffer::<[u8; 4]>(stream, count).unwrap().concat(),
        ("ATTRIBUTES", 8, None) => decode_vertex_buffer::<[u8; 8]>(stream, count).unwrap().concat(),
        ("ATTRIBUTES", 4, Some("OCTAHEDRAL")) => {
            let mut directions = decode_vertex_buffer::<[i8; 4]>(stream, count).unwrap();
            decode_filter_oct(&mut directions);
            bytemuck::cast_slice(&directions).to_vec()
        }
        other => panic!("{other:?}"),
    }
}
