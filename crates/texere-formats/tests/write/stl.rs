//! STL files, read back by a reader of the test's own.

use glam::{DVec3, Vec3};
use texere_core::{Mesh, Topology};
use texere_cpu::SerialBackend;
use texere_formats::write;

use crate::fabric::{fabric, long_yarn, pipeline, region, triangles, ways, whole};

/// A facet of a file.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Facet {
    pub(crate) normal: [f32; 3],
    pub(crate) corners: [[f32; 3]; 3],
}

/// All facets of a file, whose length must be what its count says.
pub(crate) fn facets(bytes: &[u8]) -> Vec<Facet> {
    let count = u32::from_le_bytes(bytes[80..84].try_into().unwrap()) as usize;
    assert_eq!(bytes.len(), 84 + 50 * count);
    // A file that begins so would be taken for the text form.
    assert!(!bytes.starts_with(b"solid"));
    let point = |bytes: &[u8]| {
        [0, 1, 2].map(|axis| f32::from_le_bytes(bytes[4 * axis..4 * axis + 4].try_into().unwrap()))
    };
    let facet = |bytes: &[u8]| {
        assert_eq!(bytes[48..], [0, 0]);
        Facet { normal: point(bytes), corners: [1, 2, 3].map(|corner| point(&bytes[12 * corner..])) }
    };
    bytes[84..].chunks_exact(50).map(facet).collect()
}

/// The places of the corners of each triangle. The triangles are sorted.
fn places(facets: &[Facet]) -> Vec<[[u32; 3]; 3]> {
    let mut all: Vec<_> =
        facets.iter().map(|facet| facet.corners.map(|corner| corner.map(f32::to_bits))).collect();
    all.sort_unstable();
    all
}

fn expected(mesh: &Mesh) -> Vec<[[u32; 3]; 3]> {
    let of_yarns = triangles(mesh).into_values().flatten();
    let mut all: Vec<_> =
        of_yarns.map(|triangle| triangle.map(|corner| [corner[0], corner[1], corner[2]])).collect();
    all.sort_unstable();
    all
}

#[test]
fn every_triangle_is_read_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fabric.stl");
    for (yarns, caps) in [(fabric(), false), (fabric(), true), (long_yarn(), true)] {
        let expected = expected(&whole(&yarns, caps));
        for way in ways() {
            let mesh = pipeline(&yarns, caps, way).mesh(&SerialBackend::new()).unwrap();
            write::mesh(&mesh, &path).unwrap();
            assert!(places(&facets(&std::fs::read(&path).unwrap())) == expected, "caps {caps}, {way:?}");

            let written = write::stream(pipeline(&yarns, caps, way), &SerialBackend::new(), &path).unwrap();
            let bytes = std::fs::read(&path).unwrap();
            assert!(places(&facets(&bytes)) == expected, "streamed, caps {caps}, {way:?}");
            assert_eq!((written.bytes, written.triangles), (bytes.len() as u64, expected.len() as u64));
        }
    }
}

#[test]
fn a_region_is_read_back() {
    let folder = tempfile::tempdir().unwrap();
    let (yarns, path) = (fabric(), folder.path().join("region.stl"));
    for way in ways() {
        let part = || pipeline(&yarns, true, way).within(region());
        let mesh = part().topology(Topology::Indexed).mesh(&SerialBackend::new()).unwrap();
        write::stream(part(), &SerialBackend::new(), &path).unwrap();
        assert!(places(&facets(&std::fs::read(&path).unwrap())) == expected(&mesh), "{way:?}");
    }
}

/// Normals have length 1 and stand upright on their facets, on the side that the right-hand rule
/// gives for the order of the corners. Capped tubes are solids: each edge is used as often in one
/// direction as in the other, and the solids together have a positive volume.
#[test]
fn capped_tubes_are_solids() {
    let mesh = whole(&fabric(), true);
    let mut file = std::io::Cursor::new(Vec::new());
    write::mesh_to(&mesh, write::Format::Stl, &mut file).unwrap();
    let (mut edges, mut volume) = (std::collections::BTreeMap::<_, i32>::new(), 0.0);
    for facet in facets(&file.into_inner()) {
        let [one, two, three] = facet.corners.map(Vec3::from);
        let area = (two - one).cross(three - one);
        let normal = Vec3::from(facet.normal);
        assert!(area.length() == 0.0 || (normal.length() - 1.0).abs() < 1e-5);
        assert!(normal.dot(area) >= 0.999 * area.length());
        let [one, two, three] = facet.corners.map(|corner| DVec3::from(corner.map(f64::from)));
        volume += one.dot(two.cross(three)) / 6.0;
        let bits = facet.corners.map(|corner| corner.map(f32::to_bits));
        for (from, to) in [(0, 1), (1, 2), (2, 0)] {
            *edges.entry([bits[from], bits[to]]).or_default() += 1;
            *edges.entry([bits[to], bits[from]]).or_default() -= 1;
        }
    }
    assert!(edges.values().all(|balance| *balance == 0));
    assert!(volume > 0.0);
}
