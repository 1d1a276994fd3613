//! Attributes of vertices in files, compared with those that the backend makes, and with OBJ.

use std::f32::consts::TAU;
use std::io::Cursor;

use glam::Vec3;
use gltf::accessor::{DataType, Iter};
use gltf::{Gltf, Primitive, Semantic};
use ply_rs_bw::parser::Parser;
use ply_rs_bw::ply::{DefaultElement, Property};
use texere_core::{Attribute, Mesh, Topology, Vertex, Yarns};
use texere_cpu::SerialBackend;
use texere_formats::WriteError;
use texere_formats::write::{self, Format, Output, VertexAttribute};

use crate::fabric::{fabric, long_yarn, pipeline, ways, whole};
use crate::obj;
use crate::unpack::unpack;

const FORMATS: [Format; 4] =
    [Format::Glb, Format::PackedGlb, Format::CompressedGlb, Format::KhrCompressedGlb];

/// The lobed yarn of the fabric.
const LOBED: u32 = 3;

/// A vertex as it is read.
#[derive(Debug, Clone, Copy)]
struct Read {
    normal: Vec3,
    uv: [f32; 2],
    tangent: Vec3,
    sign: f32,
    yarn: f32,
}

fn written(mesh: &Mesh, format: Format) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    write::mesh_to(mesh, format.with(VertexAttribute::ALL), &mut bytes).unwrap();
    bytes.into_inner()
}

/// A GLB file and the buffer of its views.
fn opened(bytes: &[u8], format: Format) -> (Gltf, Vec<u8>) {
    if matches!(format, Format::CompressedGlb | Format::KhrCompressedGlb) {
        let file = unpack(bytes, format);
        return (file.gltf, file.buffer);
    }
    let mut gltf = Gltf::from_slice_without_validation(bytes).unwrap();
    let buffer = gltf.blob.take().unwrap();
    (gltf, buffer)
}

/// The four numbers of a tangent, or the three of a normal and 0.
fn directions(primitive: &Primitive<'_>, semantic: &Semantic, buffer: &[u8]) -> Vec<[f32; 4]> {
    let accessor = primitive.get(semantic).unwrap();
    let of = || primitive.get(semantic).unwrap();
    let share = |number: i8| f32::from(number) / 127.0;
    match (accessor.data_type(), *semantic == Semantic::Tangents) {
        (DataType::F32, true) => Iter::new(of(), |_| Some(buffer)).unwrap().collect(),
        (DataType::F32, false) => {
            Iter::<[f32; 3]>::new(of(), |_| Some(buffer)).unwrap().map(|[x, y, z]| [x, y, z, 0.0]).collect()
        }
        (_, true) => {
            Iter::<[i8; 4]>::new(of(), |_| Some(buffer)).unwrap().map(|all| all.map(share)).collect()
        }
        (_, false) => Iter::<[i8; 3]>::new(of(), |_| Some(buffer))
            .unwrap()
            .map(|[x, y, z]| [share(x), share(y), share(z), 0.0])
            .collect(),
    }
}

fn vertices(primitive: &Primitive<'_>, buffer: &[u8]) -> Vec<Read> {
    let uv = primitive.get(&Semantic::TexCoords(0)).unwrap();
    let yarns = primitive.get(&Semantic::Extras("YARN".into())).unwrap();
    let normals = directions(primitive, &Semantic::Normals, buffer);
    let tangents = directions(primitive, &Semantic::Tangents, buffer);
    let all = Iter::<[f32; 2]>::new(uv, |_| Some(buffer))
        .unwrap()
        .zip(Iter::<f32>::new(yarns, |_| Some(buffer)).unwrap())
        .zip(normals.iter().zip(&tangents));
    all.map(|((uv, yarn), (normal, tangent))| {
        let [tangent, normal] = [tangent, normal].map(|[x, y, z, _]| Vec3::new(*x, *y, *z));
        Read { normal, uv, tangent, sign: 0.0, yarn }
    })
    .zip(&tangents)
    .map(|(read, [.., sign])| Read { sign: *sign, ..read })
    .collect()
}

fn place(vertex: &Vertex) -> Vec3 {
    Vec3::from_array(vertex.position)
}

/// Checks one tube of `sides` + 1 vertices a ring against the mesh and the attributes of the tube.
fn assert_tube(read: &[Read], mesh: &[Vertex], attributes: &[Attribute], sides: usize, packed: bool) {
    let accuracy = if packed { 0.9_f32.to_radians() } else { 1e-4 };
    assert_eq!(read.len(), mesh.len() / sides * (sides + 1));
    for (ring, corners) in read.chunks_exact(sides + 1).enumerate() {
        for (corner, read) in corners.iter().enumerate() {
            let own = ring * sides + corner % sides;
            let attribute = attributes[own];
            assert_eq!(read.yarn, attribute.yarn as f32);
            let turn = if corner == sides { 1.0 } else { attribute.angle / TAU };
            assert!((read.uv[0] - turn).abs() < 1e-6, "{} turns instead of {turn}", read.uv[0]);
            // The file has the sum of the distances between the middles of rings, which is less
            // than the length of the spline.
            let (mm, along) = (read.uv[1], attribute.along);
            assert!(mm <= along * 1.0001 + 1e-4 && mm >= 0.9 * along - 1e-4, "{mm} mm instead of {along}");
            assert_eq!(read.sign, -1.0);
            let exact = Vec3::from_array(mesh[own].normal);
            let tangent = Vec3::from_array(attribute.tangent);
            let on_surface = (tangent - exact * exact.dot(tangent)).normalize();
            let off = on_surface.distance(read.tangent.normalize());
            assert!(off <= accuracy, "a tangent is off by {off} rad");
            // The bitangent leads to the next corner. On a lobed yarn the bitangent may point away
            // from the next corner.
            let next = place(&mesh[ring * sides + (corner + 1) % sides]) - place(&mesh[own]);
            let ahead = (exact.cross(read.tangent) * read.sign).dot(next);
            assert!(ahead > 0.0 || attribute.yarn == LOBED);
        }
    }
}

/// Checks the vertices of a cap: texture coordinates and places are alike, except for a rotation
/// and a scale.
fn assert_cap(read: &[Read], mesh: &[Vertex], yarn: u32) {
    let middle = mesh.iter().map(place).sum::<Vec3>() / mesh.len() as f32;
    for (read, vertex) in read.iter().zip(mesh) {
        assert_eq!(read.yarn, yarn as f32);
        let bitangent = read.normal.cross(read.tangent) * read.sign;
        let spoke = place(vertex) - middle;
        let from_middle = read.uv.map(|place| 2.0 * place - 1.0);
        let across = [read.tangent.dot(spoke), bitangent.dot(spoke)].map(|way| way / spoke.length());
        for (own, expected) in across.into_iter().zip(from_middle) {
            assert!((own - expected).abs() < 0.03, "{across:?} instead of {from_middle:?}");
        }
    }
}

fn assert_attributes(yarns: &Yarns, format: Format) {
    let mesh = whole(yarns, true);
    let uncut = pipeline(yarns, true, ways()[0]);
    let attributes = uncut.attributes(&SerialBackend::new()).unwrap();
    let (gltf, buffer) = opened(&written(&mesh, format), format);
    let sides = mesh.plan.settings().sides as usize;
    let [chunk] = &mesh.chunks[..] else { panic!("one chunk") };
    for (of_yarn, part) in gltf.meshes().zip(chunk.parts()) {
        let primitives: Vec<_> = of_yarn.primitives().map(|each| vertices(&each, &buffer)).collect();
        let own = part.first_vertex as usize..(part.first_vertex + part.rings * sides as u32) as usize;
        let packed = format != Format::Glb;
        assert_tube(&primitives[0], &mesh.vertices[own.clone()], &attributes[own], sides, packed);
        let caps: Vec<_> = chunk.caps().iter().filter(|cap| cap.yarn == part.yarn).collect();
        assert_eq!(caps.len(), primitives.len() - 1);
        for (cap, read) in caps.into_iter().zip(&primitives[1..]) {
            // The ends of a lobed yarn are not round.
            if part.yarn != LOBED {
                assert_cap(read, &mesh.vertices[cap.first_vertex as usize..][..sides], part.yarn);
            }
        }
    }
}

#[test]
fn attributes_are_those_of_the_backend() {
    for yarns in [fabric(), long_yarn()] {
        for format in FORMATS {
            assert_attributes(&yarns, format);
        }
    }
}

/// Corners of triangles: places and texture coordinates, as bits.
type Corners = Vec<[[u32; 5]; 3]>;

/// The triangles of a plain GLB file, in the order of their bits.
fn of_glb(bytes: &[u8]) -> Corners {
    let (gltf, buffer) = opened(bytes, Format::Glb);
    let mut all = Corners::new();
    for primitive in gltf.meshes().flat_map(|mesh| mesh.primitives().collect::<Vec<_>>()) {
        let reader = primitive.reader(|_| Some(&buffer[..]));
        let positions: Vec<_> = reader.read_positions().unwrap().collect();
        let uv: Vec<_> = reader.read_tex_coords(0).unwrap().into_f32().collect();
        let indices: Vec<_> = reader.read_indices().unwrap().into_u32().map(|index| index as usize).collect();
        let corner = |index: usize| {
            let ([x, y, z], [u, v]) = (positions[index], uv[index]);
            [x, y, z, u, v].map(f32::to_bits)
        };
        all.extend(indices.as_chunks().0.iter().map(|corners: &[usize; 3]| corners.map(corner)));
    }
    all.sort_unstable();
    all
}

fn of_obj(text: &str) -> Corners {
    let file = obj::File::of(text);
    let corner = |[vertex, at, _]: [usize; 3]| {
        let ([x, y, z], [u, v]) = (file.positions[vertex], file.coordinates[at]);
        [x, y, z, u.to_bits(), v.to_bits()]
    };
    let mut all: Corners = file.faces.iter().map(|face| face.corners.map(corner)).collect();
    all.sort_unstable();
    all
}

fn of_ply(bytes: &[u8]) -> Corners {
    let ply = Parser::<DefaultElement>::new().read_ply(&mut &*bytes).unwrap();
    let corner = |index: i32| {
        let vertex = &ply.payload["vertex"][index as usize];
        ["x", "y", "z", "s", "t"].map(|name| match vertex[name] {
            Property::Float(value) => value.to_bits(),
            ref other => panic!("{name} is {other:?}"),
        })
    };
    let mut all: Corners = ply.payload["face"]
        .iter()
        .map(|face| {
            let Property::ListInt(corners) = &face["vertex_indices"] else { panic!("{face:?}") };
            <[i32; 3]>::try_from(corners.as_slice()).unwrap().map(corner)
        })
        .collect();
    all.sort_unstable();
    all
}

#[test]
fn texture_coordinates_are_those_of_obj() {
    for yarns in [fabric(), long_yarn()] {
        for caps in [false, true] {
            let mesh = whole(&yarns, caps);
            let mut bytes = Cursor::new(Vec::new());
            write::mesh_to(&mesh, Format::Obj, &mut bytes).unwrap();
            let expected = of_obj(std::str::from_utf8(&bytes.into_inner()).unwrap());
            assert!(of_glb(&written(&mesh, Format::Glb)) == expected, "GLB, caps {caps}");
            assert!(of_ply(&written(&mesh, Format::Ply)) == expected, "PLY, caps {caps}");
        }
    }
}

/// PLY has the vertices of GLB in one list.
#[test]
fn ply_has_the_attributes_of_glb() {
    let yarns = fabric();
    let mesh = whole(&yarns, true);
    let (gltf, buffer) = opened(&written(&mesh, Format::Glb), Format::Glb);
    let primitives: Vec<_> = gltf.meshes().flat_map(|mesh| mesh.primitives().collect::<Vec<_>>()).collect();
    let sides = mesh.plan.settings().sides as usize;
    let [tubes, caps] = [true, false].map(|tube| {
        let of_kind = primitives.iter().filter(move |each| {
            let count = each.get(&Semantic::Positions).unwrap().count();
            (count > sides) == tube
        });
        of_kind.flat_map(|each| vertices(each, &buffer)).collect::<Vec<_>>()
    });
    let ply = Parser::<DefaultElement>::new().read_ply(&mut &*written(&mesh, Format::Ply)).unwrap();
    let vertices = &ply.payload["vertex"];
    assert_eq!(vertices.len(), tubes.len() + caps.len());
    for (read, vertex) in tubes.iter().chain(&caps).zip(vertices) {
        let Property::UInt(yarn) = vertex["yarn"] else { panic!("{vertex:?}") };
        assert_eq!(yarn as f32, read.yarn);
        for (name, expected) in ["tx", "ty", "tz"].into_iter().zip(read.tangent.to_array()) {
            assert!(matches!(vertex[name], Property::Float(value) if value == expected), "{name}");
        }
    }
}

#[test]
fn one_attribute_alone_leaves_others_out() {
    let mesh = whole(&fabric(), true);
    let names = ["TEXCOORD_0", "TANGENT", "_YARN"];
    for format in FORMATS {
        for (attribute, own) in VertexAttribute::ALL.into_iter().zip(names) {
            let mut bytes = Cursor::new(Vec::new());
            write::mesh_to(&mesh, format.with([attribute]), &mut bytes).unwrap();
            let text = String::from_utf8_lossy(bytes.get_ref()).into_owned();
            for name in names {
                assert_eq!(text.contains(name), name == own, "{name} with {attribute:?}");
            }
        }
    }
}

#[test]
fn vertices_of_the_seam_are_counted() {
    let yarns = fabric();
    let mesh = whole(&yarns, false);
    let way = (Topology::Shared, ways()[0].1);
    let count = |attributes: &[VertexAttribute]| {
        let form = Format::Ply.with(attributes.iter().copied());
        let out = Cursor::new(Vec::new());
        write::stream_to(pipeline(&yarns, false, way), &SerialBackend::new(), form, out).unwrap().vertices
    };
    assert_eq!(count(&[VertexAttribute::Tangent, VertexAttribute::Yarn]), mesh.vertices.len() as u64);
    assert_eq!(count(&[VertexAttribute::Uv]), mesh.vertices.len() as u64 / 5 * 6);
}

#[test]
fn a_format_that_holds_no_attribute_refuses_it() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = whole(&fabric(), true);
    for (name, attribute, message) in [
        ("yarn.stl", VertexAttribute::Uv, "STL can't hold texture coordinates"),
        ("yarn.stl", VertexAttribute::Tangent, "STL can't hold tangents of vertices"),
        ("yarn.obj", VertexAttribute::Tangent, "OBJ can't hold tangents of vertices"),
        ("yarn.obj", VertexAttribute::Yarn, "OBJ can't hold numbers of yarns"),
    ] {
        let output = || Output::to(folder.path().join(name)).attributes([attribute]);
        let format = Format::from_path(name).unwrap().with([attribute]);
        for error in [
            output().check().unwrap_err(),
            write::mesh(&mesh, output()).unwrap_err(),
            write::mesh_to(&mesh, format, Cursor::new(Vec::new())).unwrap_err(),
        ] {
            assert!(matches!(error, WriteError::Unheld { .. }), "{error:?}");
            assert_eq!(error.to_string(), message);
        }
    }
    let curves = Output::to(folder.path().join("yarn.usda")).attributes(VertexAttribute::ALL);
    for curves in [curves.clone(), curves.linear()] {
        let error = write::curves(&fabric(), curves).unwrap_err();
        assert!(matches!(error, WriteError::Unheld { format: "a file of curves", .. }), "{error:?}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    // OBJ has texture coordinates anyway.
    let output = Output::to(folder.path().join("yarn.obj"));
    write::mesh(&mesh, output.clone()).unwrap();
    let plain = std::fs::read(output.path()).unwrap();
    write::mesh(&mesh, output.clone().attributes([VertexAttribute::Uv])).unwrap();
    assert!(plain == std::fs::read(output.path()).unwrap());
}
