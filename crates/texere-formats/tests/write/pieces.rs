//! A yarn is one piece for a reader that does not join equal vertices. For such a reader triangles
//! hang together only if they share the number of a vertex.

use std::collections::{BTreeMap, BTreeSet};

use gltf::{Gltf, Semantic};
use texere_core::{ControlPoint, Limits, Mesh, Pipeline, Topology, Yarn, Yarns};
use texere_cpu::SerialBackend;
use texere_formats::write::{self, Format, Output, VertexAttribute};

use crate::fabric::{fabric, long_yarn, pipeline, region, triangles, ways, whole};
use crate::unpack::unpack;
use crate::{obj, stl, usd_mesh};

/// Union-find: sets are joined when two of their members are.
struct Pieces {
    parents: Vec<usize>,
}

impl Pieces {
    fn of(vertices: usize, triangles: impl IntoIterator<Item = [usize; 3]>) -> Self {
        let mut pieces = Self { parents: (0..vertices).collect() };
        for [a, b, c] in triangles {
            pieces.join(a, b);
            pieces.join(b, c);
        }
        pieces
    }

    fn find(&mut self, mut member: usize) -> usize {
        while self.parents[member] != member {
            self.parents[member] = self.parents[self.parents[member]];
            member = self.parents[member];
        }
        member
    }

    fn join(&mut self, one: usize, other: usize) {
        let (one, other) = (self.find(one), self.find(other));
        self.parents[one] = other;
    }

    fn count(&mut self) -> usize {
        (0..self.parents.len()).map(|member| self.find(member)).collect::<BTreeSet<_>>().len()
    }
}

/// Vertices of a PLY file, and the corners of its triangles.
fn ply_triangles(bytes: &[u8]) -> (usize, impl Iterator<Item = [usize; 3]>) {
    let header = "end_header\n";
    let end = bytes.windows(header.len()).position(|at| at == header.as_bytes()).unwrap() + header.len();
    let text = std::str::from_utf8(&bytes[..end]).unwrap();
    let number = |element: &str| text.split(element).nth(1).unwrap().lines().next().unwrap().parse().unwrap();
    let (vertices, triangles): (usize, usize) = (number("element vertex "), number("element face "));
    // A vertex has six floats and three bytes. With attributes a vertex has five floats and a
    // number more. A triangle has a byte and three numbers.
    let vertex_bytes = if text.contains("yarn") { 51 } else { 27 };
    let faces = bytes[end + vertices * vertex_bytes..].chunks_exact(13);
    assert_eq!((faces.len(), faces.remainder().len()), (triangles, 0));
    let corner =
        |face: &[u8], k: usize| u32::from_le_bytes(face[1 + 4 * k..][..4].try_into().unwrap()) as usize;
    (vertices, faces.map(move |face| [0, 1, 2].map(|k| corner(face, k))))
}

/// Number of pieces in a PLY file.
fn of_ply(bytes: &[u8]) -> usize {
    let (vertices, triangles) = ply_triangles(bytes);
    Pieces::of(vertices, triangles).count()
}

/// Number of pieces in a GLB file. A primitive has vertices of its own, so that two primitives are
/// never joined.
fn of_glb(bytes: &[u8]) -> usize {
    // The gltf crate refuses files that need an extension, such as packed ones.
    let gltf = Gltf::from_slice_without_validation(bytes).unwrap();
    of_primitives(&gltf, gltf.blob.as_deref().unwrap())
}

/// Number of pieces of a GLB file whose buffer views lie in `buffer`.
fn of_primitives(gltf: &Gltf, buffer: &[u8]) -> usize {
    let primitives = gltf.meshes().flat_map(|mesh| mesh.primitives().collect::<Vec<_>>());
    let pieces = primitives.map(|primitive| {
        let reader = primitive.reader(|_| Some(buffer));
        let indices: Vec<_> = reader.read_indices().unwrap().into_u32().map(|index| index as usize).collect();
        let vertices = primitive.get(&Semantic::Positions).unwrap().count();
        Pieces::of(vertices, indices.chunks_exact(3).map(|corners| [0, 1, 2].map(|k| corners[k]))).count()
    });
    pieces.sum()
}

/// Number of pieces in an STL file. It numbers no vertices: corners at one place are one vertex.
fn of_stl(bytes: &[u8]) -> usize {
    let facets = stl::facets(bytes).into_iter();
    of_places(facets.map(|facet| facet.corners.map(|corner| corner.map(f32::to_bits))).collect())
}

/// Number of pieces of triangles that are given by the places of their corners.
fn of_places(triangles: Vec<[[u32; 3]; 3]>) -> usize {
    let mut numbers = BTreeMap::new();
    let mut number = |corner: [u32; 3]| {
        let next = numbers.len();
        *numbers.entry(corner).or_insert(next)
    };
    let corners: Vec<_> = triangles.into_iter().map(|triangle| triangle.map(&mut number)).collect();
    Pieces::of(numbers.len(), corners).count()
}

/// Number of pieces of a mesh whose corners at one place are one vertex. Two ends of the fabric
/// begin at one place.
fn by_place(mesh: &Mesh) -> usize {
    let triangles = triangles(mesh).into_values().flatten();
    let corners = triangles.map(|triangle| triangle.map(|[x, y, z, ..]| [x, y, z]));
    of_places(corners.collect())
}

/// Number of pieces in an OBJ file.
fn of_obj(bytes: &[u8]) -> usize {
    let file = obj::File::of(std::str::from_utf8(bytes).unwrap());
    let corners = file.faces.iter().map(|face| face.corners.map(|[vertex, ..]| vertex));
    Pieces::of(file.positions.len(), corners).count()
}

/// Number of pieces in a USD stage. Prims have vertices of their own.
fn of_usda(bytes: &[u8]) -> usize {
    let prims = usd_mesh::prims(std::str::from_utf8(bytes).unwrap());
    prims.values().map(|prim| Pieces::of(prim.vertices(), prim.corners()).count()).sum()
}

/// The formats in which a yarn is one piece.
const WHOLE: [Format; 8] = [
    Format::Glb,
    Format::PackedGlb,
    Format::CompressedGlb,
    Format::KhrCompressedGlb,
    Format::Ply,
    Format::Stl,
    Format::Obj,
    Format::Usda,
];

/// Calls `check` with the files of `mesh` and of `stream` in each of the `formats`, without
/// attributes, and with all of them if the format holds them.
fn each_file(
    formats: &[Format],
    make: impl Fn() -> Pipeline<'static>,
    check: impl Fn(Format, bool, Vec<u8>),
) {
    let folder = tempfile::tempdir().unwrap();
    for &format in formats {
        let path = folder.path().join("fabric").with_extension(format.extension());
        let holds = !matches!(format, Format::Stl | Format::Obj | Format::InstancedGlb);
        for with in [false, true].into_iter().take(1 + usize::from(holds)) {
            let output = || match format {
                Format::PackedGlb => Output::to(&path).packed(),
                Format::CompressedGlb => Output::to(&path).compressed(),
                Format::KhrCompressedGlb => Output::to(&path).khr_compressed(),
                Format::InstancedGlb => Output::to(&path).instanced(),
                _ => Output::to(&path),
            };
            let attributes = VertexAttribute::ALL.into_iter().filter(|_| with);
            let output = || output().attributes(attributes.clone());
            write::stream(make(), &SerialBackend::new(), output()).unwrap();
            check(format, with, std::fs::read(&path).unwrap());
            write::mesh(&make().mesh(&SerialBackend::new()).unwrap(), output()).unwrap();
            check(format, with, std::fs::read(&path).unwrap());
        }
    }
}

fn pieces(format: Format, bytes: &[u8]) -> usize {
    match format {
        Format::Glb | Format::PackedGlb => of_glb(bytes),
        Format::CompressedGlb | Format::KhrCompressedGlb => {
            let file = unpack(bytes, format);
            of_primitives(&file.gltf, &file.buffer)
        }
        Format::Ply => of_ply(bytes),
        Format::Stl => of_stl(bytes),
        Format::Obj => of_obj(bytes),
        Format::Usda => of_usda(bytes),
        other => panic!("{other:?}"),
    }
}

fn leaked(yarns: Yarns) -> &'static Yarns {
    Box::leak(Box::new(yarns))
}

/// Caps have normals of their own, and can't share vertices with the tube. Each cap is a piece of
/// its own. Files of meshes that are cut in other ways have equal bytes
/// (`a_file_has_the_same_bytes_however_its_mesh_is_cut`).
#[test]
fn a_yarn_is_one_piece() {
    let way = ways()[0];
    for (yarns, open) in [(leaked(fabric()), 4), (leaked(long_yarn()), 1)] {
        for caps in [false, true] {
            let expected = yarns.layout().yarns().len() + if caps { 2 * open } else { 0 };
            each_file(
                &WHOLE,
                || pipeline(yarns, caps, way),
                |format, with, bytes| {
                    let expected =
                        if format == Format::Stl { by_place(&whole(yarns, caps)) } else { expected };
                    assert_eq!(pieces(format, &bytes), expected, "{format:?} {with}, caps {caps}, {way:?}")
                },
            );
        }
    }
}

/// Limits of counts and of devices may cut anywhere. The file does not show where.
#[test]
fn a_file_has_the_same_bytes_however_its_mesh_is_cut() {
    for yarns in [leaked(fabric()), leaked(long_yarn())] {
        for caps in [false, true] {
            let first = std::cell::RefCell::new(BTreeMap::new());
            for way in ways() {
                each_file(
                    &[&WHOLE[..], &[Format::InstancedGlb]].concat(),
                    || pipeline(yarns, caps, way),
                    |format, with, bytes| {
                        let mut first = first.borrow_mut();
                        let first =
                            first.entry(format!("{format:?} {with}")).or_insert_with(|| bytes.clone());
                        assert!(*first == bytes, "{format:?} {with}, caps {caps}, {way:?}");
                    },
                );
            }
            // No vertex occurs twice: the file has as many as the uncut mesh.
            let mesh = whole(yarns, caps);
            let bytes = &first.borrow()["Ply false"];
            assert_eq!(ply_triangles(bytes).0, mesh.vertices.len());
        }
    }
}

#[test]
fn a_region_has_the_same_bytes_however_its_mesh_is_cut() {
    let yarns = leaked(fabric());
    for caps in [false, true] {
        let first = std::cell::RefCell::new(BTreeMap::new());
        for way in ways() {
            each_file(
                &[&WHOLE[..], &[Format::InstancedGlb]].concat(),
                || pipeline(yarns, caps, way).within(region()),
                |format, with, bytes| {
                    let mut first = first.borrow_mut();
                    let first = first.entry(format!("{format:?} {with}")).or_insert_with(|| bytes.clone());
                    assert!(*first == bytes, "{format:?} {with}, caps {caps}, {way:?}");
                },
            );
        }
    }
}

/// A box cuts runs of rings out of yarns. Each run is one piece.
#[test]
fn a_region_has_a_piece_for_each_run_of_rings() {
    let yarns = leaked(fabric());
    let part = |limits| pipeline(yarns, false, (Topology::Indexed, limits)).within(region());
    let uncut = part(Limits::NONE).mesh(&SerialBackend::new()).unwrap();
    let runs = uncut.chunks[0].parts().iter().filter(|part| part.rings > 1).count();
    assert!(runs > 1);
    for (_, limits) in ways() {
        each_file(
            &WHOLE,
            || part(limits),
            |format, with, bytes| {
                let runs = if format == Format::Stl { by_place(&uncut) } else { runs };
                assert_eq!(pieces(format, &bytes), runs, "{format:?} {with}");
            },
        );
    }
}

/// Seventy yarns of 400 points with sixteen sides and six subdivisions. Default limits cut inside a
/// yarn.
#[test]
fn the_default_limits_cut_no_yarn_in_two() {
    let mut yarns = Yarns::builder();
    for end in 0..70 {
        let points: Vec<_> = (0..400)
            .map(|pick| ControlPoint::new(end as f32, pick as f32, (pick % 2) as f32 * 0.3, 0.2))
            .collect();
        yarns.yarn(Yarn::default(), &points);
    }
    let yarns = leaked(yarns.build().unwrap());
    let make = || Pipeline::new(yarns).sides(16).subdivisions(6);
    let plan = make().plan().unwrap();
    assert!(
        plan.chunks(&Limits::default()).unwrap().any(|chunk| chunk.repeats_ring()),
        "it would show nothing"
    );
    let mut ply = std::io::Cursor::new(Vec::new());
    write::stream_to(make(), &texere_cpu::ParallelBackend::open().unwrap(), Format::Ply, &mut ply).unwrap();
    assert_eq!(of_ply(&ply.into_inner()), 70);
}
