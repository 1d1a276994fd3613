//! GLB files, read back by the gltf crate, which validates them on the way.

use std::collections::{BTreeMap, BTreeSet};

use gltf::Gltf;
use texere_core::{Limits, Mesh, Topology, Yarns};
use texere_cpu::SerialBackend;
use texere_formats::write;

use crate::fabric::{Triangle, fabric, long_yarn, pipeline, region, triangles, ways, whole};

/// One yarn, as a reader gets it.
struct ReadYarn {
    name: String,
    material: String,
    colour: [f32; 4],
    triangles: Vec<Triangle>,
}

/// The yarns of a file. Properties of every file are checked first.
fn read(bytes: &[u8]) -> Vec<ReadYarn> {
    assert_eq!(
        u32::from_le_bytes(bytes[8..12].try_into().unwrap()) as usize,
        bytes.len(),
        "length in header"
    );
    let gltf = Gltf::from_slice(bytes).unwrap();
    let blob = gltf.blob.as_deref().unwrap();
    assert_eq!(gltf.buffers().next().unwrap().length(), blob.len(), "no byte that nothing describes");
    let root = gltf.default_scene().unwrap().nodes().next().unwrap();
    assert_eq!(root.transform().decomposed(), ([0.0; 3], [0.0, 0.0, 0.0, 1.0], [0.001; 3]));
    root.children().map(|node| read_yarn(&node, blob)).collect()
}

fn read_yarn(node: &gltf::Node<'_>, blob: &[u8]) -> ReadYarn {
    assert_eq!(node.transform().decomposed(), ([0.0; 3], [0.0, 0.0, 0.0, 1.0], [1.0; 3]));
    let mesh = node.mesh().unwrap();
    let (mut triangles, mut looks) = (Vec::new(), BTreeMap::new());
    for primitive in mesh.primitives() {
        let reader = primitive.reader(|_| Some(blob));
        let positions: Vec<[f32; 3]> = reader.read_positions().unwrap().collect();
        let normals: Vec<[f32; 3]> = reader.read_normals().unwrap().collect();
        let indices: Vec<u32> = reader.read_indices().unwrap().into_u32().collect();
        let vertices: Vec<[u32; 6]> = positions
            .iter()
            .zip(&normals)
            .map(|([x, y, z], [nx, ny, nz])| [x, y, z, nx, ny, nz].map(|float| float.to_bits()))
            .collect();
        // Every vertex belongs to a triangle, so that readers load nothing needless.
        let used: BTreeSet<u32> = indices.iter().copied().collect();
        assert!(used.iter().copied().eq(0..vertices.len() as u32), "vertices of {:?}", node.name());
        let bounds = primitive.bounding_box();
        for axis in 0..3 {
            let values = || positions.iter().map(|position| position[axis]);
            assert_eq!(bounds.min[axis], values().fold(f32::INFINITY, f32::min));
            assert_eq!(bounds.max[axis], values().fold(f32::NEG_INFINITY, f32::max));
        }
        triangles
            .extend(indices.chunks_exact(3).map(|corners| [0, 1, 2].map(|k| vertices[corners[k] as usize])));
        let surface = primitive.material().pbr_metallic_roughness();
        assert_eq!(surface.metallic_factor(), 0.0);
        looks.insert(primitive.material().name().unwrap().to_owned(), surface.base_color_factor());
    }
    assert_eq!(looks.len(), 1, "one look per yarn");
    let (material, colour) = looks.pop_first().unwrap();
    triangles.sort_unstable();
    let name = node.name().unwrap().to_owned();
    assert_eq!(mesh.name(), Some(name.as_str()));
    ReadYarn { name, material, colour, triangles }
}

/// Checks that a file holds every triangle of `mesh`, yarn by yarn, and no other.
fn assert_holds(bytes: &[u8], mesh: &Mesh, what: &str) {
    let (read, expected) = (read(bytes), triangles(mesh));
    assert_eq!(read.len(), expected.len(), "yarns, {what}");
    for (read, (&yarn, triangles)) in read.iter().zip(&expected) {
        assert!(read.triangles == *triangles, "triangles of yarn {yarn}, {what}");
        let material = &mesh.materials[mesh.plan.yarn(yarn as usize).material as usize];
        let [red, green, blue] = material.linear_rgb();
        assert_eq!((&read.material, read.colour), (&material.name, [red, green, blue, 1.0]), "{what}");
    }
}

/// Writes `yarns` in each of the [`ways`], whole and as a stream, and calls `check` with each file
/// and its description.
fn each_way(yarns: &Yarns, caps: bool, check: impl Fn(&[u8], &str)) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fabric.glb");
    for way in ways() {
        let mesh = pipeline(yarns, caps, way).mesh(&SerialBackend::new()).unwrap();
        write::mesh(&mesh, &path).unwrap();
        let from_memory = std::fs::read(&path).unwrap();
        check(&from_memory, &format!("caps {caps}, {way:?}"));

        let written = write::stream(pipeline(yarns, caps, way), &SerialBackend::new(), &path).unwrap();
        let streamed = std::fs::read(&path).unwrap();
        assert_eq!(written.bytes, streamed.len() as u64);
        assert_eq!(written.triangles, mesh.plan.counts().triangles);
        check(&streamed, &format!("streamed, caps {caps}, {way:?}"));
    }
}

#[test]
fn every_triangle_is_read_back() {
    let yarns = fabric();
    for caps in [false, true] {
        let mesh = whole(&yarns, caps);
        each_way(&yarns, caps, |bytes, what| assert_holds(bytes, &mesh, what));
    }
}

#[test]
fn a_yarn_longer_than_the_pattern_is_read_back() {
    let yarns = long_yarn();
    let mesh = whole(&yarns, true);
    each_way(&yarns, true, |bytes, what| assert_holds(bytes, &mesh, what));
}

#[test]
fn yarns_are_named_by_their_origin() {
    each_way(&fabric(), false, |bytes, what| {
        let names: Vec<_> = read(bytes).into_iter().map(|yarn| yarn.name).collect();
        assert_eq!(names, ["end 1", "end 2", "course 7", "yarn 4", "pick 1"], "{what}");
    });
}

#[test]
fn yarns_of_one_length_share_their_indices() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fabric.glb");
    let yarns = fabric();
    write::mesh(&whole(&yarns, false), &path).unwrap();
    let gltf = Gltf::from_slice(&std::fs::read(&path).unwrap()).unwrap();
    let indices: Vec<_> = gltf
        .meshes()
        .flat_map(|mesh| mesh.primitives().map(|each| each.indices().unwrap().index()).collect::<Vec<_>>())
        .collect();
    assert_eq!(indices[0], indices[1], "two ends of 40 points");
    assert_eq!(indices.iter().collect::<BTreeSet<_>>().len(), 4, "four lengths");
    // The indices are the pattern of the longest yarn, 260 gaps of five sides. They are stored
    // once.
    assert_eq!(gltf.views().next().unwrap().length(), 260 * 5 * 6 * 4);
}

#[test]
fn a_mesh_and_a_stream_give_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let (one, other) = (folder.path().join("one.glb"), folder.path().join("other.glb"));
    let yarns = fabric();
    let way = (Topology::Shared, Limits { blocks: 3, ..Limits::NONE });
    write::mesh(&pipeline(&yarns, true, way).mesh(&SerialBackend::new()).unwrap(), &one).unwrap();
    write::stream(pipeline(&yarns, true, way), &SerialBackend::new(), &other).unwrap();
    assert!(std::fs::read(one).unwrap() == std::fs::read(other).unwrap());
}

#[test]
fn a_region_is_read_back() {
    let yarns = fabric();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("region.glb");
    for way in ways() {
        let part = || pipeline(&yarns, true, way).within(region());
        let mesh = part().topology(Topology::Indexed).mesh(&SerialBackend::new()).unwrap();
        write::stream(part(), &SerialBackend::new(), &path).unwrap();
        assert_holds(&std::fs::read(&path).unwrap(), &mesh, &format!("{way:?}"));
    }
}
