//! Compressed GLB files, decoded and compared with packed and plain ones.

use std::io::Cursor;

use glam::Vec3;
use gltf::accessor::Iter;
use gltf::{Accessor, Gltf, Semantic};
use texere_core::Mesh;
use texere_cpu::SerialBackend;
use texere_formats::WriteError;
use texere_formats::write::{self, Format, Output};

use crate::fabric::{each_mesh, fabric, long_yarn, pipeline, region, ways, whole};
use crate::unpack::{Unpacked, unpack};

fn written(mesh: &Mesh, format: Format) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    write::mesh_to(mesh, format, &mut bytes).unwrap();
    bytes.into_inner()
}

/// The triangles of an accessor of indices, each with its smallest corner first.
fn triangles(indices: Accessor<'_>, buffer: &[u8]) -> Vec<[u32; 3]> {
    let indices: Vec<u32> = Iter::new(indices, |_| Some(buffer)).unwrap().collect();
    let turned = |corners: &[u32; 3]| {
        let mut corners = *corners;
        let smallest = (0..3).min_by_key(|&corner| corners[corner]).unwrap();
        corners.rotate_left(smallest);
        corners
    };
    indices.as_chunks().0.iter().map(turned).collect()
}

/// Checks that the compressed file of `mesh` holds the positions and triangles of the packed one.
/// Its normals may differ by up to 0.9 degrees from those of the plain one.
fn assert_compresses(mesh: &Mesh, what: &str) {
    let [plain, packed] = [Format::Glb, Format::PackedGlb]
        .map(|format| Gltf::from_slice_without_validation(&written(mesh, format)).unwrap());
    let [ext, khr] = [Format::CompressedGlb, Format::KhrCompressedGlb].map(|format| written(mesh, format));
    assert!(khr.len() < ext.len(), "{} and {} bytes, {what}", khr.len(), ext.len());
    let Unpacked { gltf: compressed, buffer } = unpack(&ext, Format::CompressedGlb);
    assert!(unpack(&khr, Format::KhrCompressedGlb).buffer == buffer, "{what}");
    let [plain_blob, packed_blob] = [&plain, &packed].map(|file| file.blob.as_deref().unwrap());
    let nodes = |file: &Gltf| {
        let nodes = file.nodes().map(|node| (node.name().map(String::from), node.transform().matrix()));
        nodes.collect::<Vec<_>>()
    };
    assert_eq!(nodes(&compressed), nodes(&packed), "{what}");
    for ((plain, packed), own) in plain.meshes().zip(packed.meshes()).zip(compressed.meshes()) {
        assert_eq!(own.primitives().len(), packed.primitives().len());
        for ((plain, packed), own) in plain.primitives().zip(packed.primitives()).zip(own.primitives()) {
            assert_eq!(own.material().index(), packed.material().index());
            assert_eq!(
                triangles(own.indices().unwrap(), &buffer),
                triangles(packed.indices().unwrap(), packed_blob),
                "{what}"
            );
            let [positions, packed_positions] =
                [&own, &packed].map(|each| each.get(&Semantic::Positions).unwrap());
            assert_eq!(positions.min(), packed_positions.min());
            assert_eq!(positions.max(), packed_positions.max());
            let positions = Iter::<[i16; 3]>::new(positions, |_| Some(&buffer[..])).unwrap();
            assert!(
                positions.eq(Iter::<[i16; 3]>::new(packed_positions, |_| Some(packed_blob)).unwrap()),
                "{what}"
            );
            let normals = own.get(&Semantic::Normals).unwrap();
            let exact = plain.reader(|_| Some(plain_blob)).read_normals().unwrap();
            assert_eq!(normals.count(), exact.len());
            for (shares, exact) in Iter::<[i8; 3]>::new(normals, |_| Some(&buffer[..])).unwrap().zip(exact) {
                let stored = Vec3::from_array(shares.map(|share| f32::from(share) / 127.0));
                let angle = stored.angle_between(Vec3::from_array(exact)).to_degrees();
                assert!(angle < 0.9, "a normal is off by {angle} degrees, {what}");
            }
        }
    }
}

#[test]
fn a_compressed_file_holds_the_vertices_of_a_packed_one() {
    each_mesh(assert_compresses);
    let (yarns, way) = (fabric(), ways()[0]);
    let part = pipeline(&yarns, false, way).within(region()).mesh(&SerialBackend::new()).unwrap();
    assert_compresses(&part, "a region");
}

/// The compressed file is larger than what a spool keeps in memory.
#[test]
fn a_large_file_is_smaller_by_more_than_half() {
    let folder = tempfile::tempdir().unwrap();
    let yarns = long_yarn();
    let pipeline = || texere_core::Pipeline::new(&yarns).sides(60).subdivisions(4).caps(true);
    let mesh = pipeline().mesh(&SerialBackend::new()).unwrap();
    assert_compresses(&mesh, "large");
    let paths = ["packed.glb", "compressed.glb"].map(|name| folder.path().join(name));
    write::mesh(&mesh, Output::to(&paths[0]).packed()).unwrap();
    let written =
        write::stream(pipeline(), &SerialBackend::new(), Output::to(&paths[1]).compressed()).unwrap();
    let [packed, compressed] = paths.map(|path| std::fs::metadata(path).unwrap().len());
    assert_eq!(written.bytes, compressed);
    assert!(compressed > 4 << 20, "it would not leave memory");
    assert!(2 * compressed < packed, "{compressed} of {packed} bytes");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2);
}

#[test]
fn only_glb_is_compressed() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = whole(&fabric(), true);
    for name in ["yarn.ply", "yarn.stl", "yarn.obj", "yarn.yarns"] {
        for form in [Output::compressed, Output::khr_compressed] {
            let output = || form(Output::to(folder.path().join(name)));
            for error in [output().check().unwrap_err(), write::mesh(&mesh, output()).unwrap_err()] {
                assert!(matches!(error, WriteError::NotEnding { expected: "glb", .. }), "{error:?}");
            }
        }
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}
