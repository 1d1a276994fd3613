//! PLY files, read back by the ply-rs-bw crate.

use ply_rs_bw::parser::Parser;
use ply_rs_bw::ply::{DefaultElement, Property};
use texere_core::{Bounds, Mesh, Topology};
use texere_cpu::SerialBackend;
use texere_formats::{WriteError, write};

use crate::fabric::{Triangle, fabric, long_yarn, pipeline, region, triangles, ways, whole};

/// A triangle and the colours of its corners.
type Coloured = (Triangle, [[u8; 3]; 3]);

fn read(bytes: &[u8]) -> Vec<Coloured> {
    let ply = Parser::<DefaultElement>::new().read_ply(&mut &*bytes).unwrap();
    assert!(ply.header.comments.iter().any(|comment| comment.starts_with("unit mm")));
    let float = |element: &DefaultElement, name: &str| match element[name] {
        Property::Float(value) => value.to_bits(),
        ref other => panic!("{name} is {other:?}"),
    };
    let byte = |element: &DefaultElement, name: &str| match element[name] {
        Property::UChar(value) => value,
        ref other => panic!("{name} is {other:?}"),
    };
    let vertices: Vec<([u32; 6], [u8; 3])> = ply.payload["vertex"]
        .iter()
        .map(|vertex| {
            let floats = ["x", "y", "z", "nx", "ny", "nz"].map(|name| float(vertex, name));
            (floats, ["red", "green", "blue"].map(|name| byte(vertex, name)))
        })
        .collect();
    let mut faces: Vec<Coloured> = ply.payload["face"]
        .iter()
        .map(|face| {
            let Property::ListInt(corners) = &face["vertex_indices"] else { panic!("{face:?}") };
            let corners: [i32; 3] = corners.as_slice().try_into().unwrap();
            let corners = corners.map(|corner| vertices[corner as usize]);
            (corners.map(|corner| corner.0), corners.map(|corner| corner.1))
        })
        .collect();
    faces.sort_unstable();
    faces
}

/// The expected content, from the mesh in memory.
fn expected(mesh: &Mesh) -> Vec<Coloured> {
    let mut all: Vec<Coloured> = triangles(mesh)
        .into_iter()
        .flat_map(|(yarn, triangles)| {
            let colour = mesh.materials[mesh.plan.yarn(yarn as usize).material as usize].srgb;
            triangles.into_iter().map(move |triangle| (triangle, [colour; 3]))
        })
        .collect();
    all.sort_unstable();
    all
}

#[test]
fn every_triangle_is_read_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fabric.ply");
    for (yarns, caps) in [(fabric(), false), (fabric(), true), (long_yarn(), true)] {
        let expected = expected(&whole(&yarns, caps));
        for way in ways() {
            let mesh = pipeline(&yarns, caps, way).mesh(&SerialBackend::new()).unwrap();
            write::mesh(&mesh, &path).unwrap();
            let bytes = std::fs::read(&path).unwrap();
            assert!(read(&bytes) == expected, "caps {caps}, {way:?}");

            let written = write::stream(pipeline(&yarns, caps, way), &SerialBackend::new(), &path).unwrap();
            let bytes = std::fs::read(&path).unwrap();
            assert!(read(&bytes) == expected, "streamed, caps {caps}, {way:?}");
            assert_eq!((written.bytes, written.triangles), (bytes.len() as u64, expected.len() as u64));
        }
    }
}

#[test]
fn a_region_is_read_back() {
    let yarns = fabric();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("region.ply");
    let whole = expected(&whole(&yarns, true));
    for way in ways() {
        let part = || pipeline(&yarns, true, way).within(region());
        let mesh = part().topology(Topology::Indexed).mesh(&SerialBackend::new()).unwrap();
        let expected = expected(&mesh);
        assert!(!expected.is_empty() && expected.len() < whole.len());
        assert!(expected.iter().all(|triangle| whole.binary_search(triangle).is_ok()));
        let written = write::stream(part(), &SerialBackend::new(), &path).unwrap();
        assert_eq!(written.triangles, expected.len() as u64);
        assert!(read(&std::fs::read(&path).unwrap()) == expected, "{way:?}");
    }
    let nothing = pipeline(&yarns, true, ways()[0]).within(Bounds::rectangle([90.0; 2], [91.0; 2]));
    let refused = write::stream(nothing, &SerialBackend::new(), &path);
    assert!(matches!(refused, Err(WriteError::Empty)), "{refused:?}");
    assert!(read(&std::fs::read(&path).unwrap()).len() < whole.len(), "what was there is still there");
}
