//! OBJ files and their materials, read back by a reader of the test's own.

use std::collections::BTreeMap;
use std::fs;

use texere_core::{Mesh, Topology};
use texere_cpu::SerialBackend;
use texere_formats::WriteError;
use texere_formats::write::{self, Output};

use crate::fabric::{Triangle, fabric, long_yarn, pipeline, region, triangles, ways, whole};

/// What a file says.
#[derive(Debug, Default)]
pub(crate) struct File {
    pub(crate) positions: Vec<[u32; 3]>,
    normals: Vec<[u32; 3]>,
    pub(crate) coordinates: Vec<[f32; 2]>,
    pub(crate) faces: Vec<Face>,
    library: String,
}

#[derive(Debug)]
pub(crate) struct Face {
    group: String,
    material: String,
    /// Vertex, texture coordinates and normal of each corner, from 0.
    pub(crate) corners: [[usize; 3]; 3],
}

impl File {
    pub(crate) fn of(text: &str) -> Self {
        let (mut file, mut group, mut material) = (Self::default(), String::new(), String::new());
        for line in text.lines() {
            let words: Vec<_> = line.split_whitespace().collect();
            let float = |word: &str| word.parse::<f32>().unwrap();
            let three = || [float(words[1]).to_bits(), float(words[2]).to_bits(), float(words[3]).to_bits()];
            match words[0] {
                "#" => {}
                "mtllib" => file.library = line["mtllib ".len()..].into(),
                "v" => file.positions.push(three()),
                "vn" => file.normals.push(three()),
                "vt" => file.coordinates.push([float(words[1]), float(words[2])]),
                "g" => group = words[1..].join(" "),
                "usemtl" => material = words[1..].join(" "),
                "f" => {
                    assert_eq!(words.len(), 4);
                    let number = |word: &str| word.parse::<usize>().unwrap() - 1;
                    let corner = |word: &str| {
                        let numbers: Vec<_> = word.split('/').map(number).collect();
                        [numbers[0], numbers[1], numbers[2]]
                    };
                    let corners = [corner(words[1]), corner(words[2]), corner(words[3])];
                    file.faces.push(Face { group: group.clone(), material: material.clone(), corners });
                }
                other => panic!("{other}"),
            }
        }
        file
    }
}

/// The colour of each material of a library.
fn colours(text: &str) -> BTreeMap<String, [u8; 3]> {
    let (mut all, mut name) = (BTreeMap::new(), String::new());
    for line in text.lines() {
        if let Some(own) = line.strip_prefix("newmtl ") {
            name = own.into();
        } else if let Some(rest) = line.strip_prefix("Kd ") {
            let channels: Vec<f32> = rest.split(' ').map(|word| word.parse().unwrap()).collect();
            let colour = [0, 1, 2].map(|channel| (channels[channel] * 255.0).round() as u8);
            assert!(all.insert(name.clone(), colour).is_none());
        }
    }
    all
}

type Coloured = (Triangle, [u8; 3]);

fn read(text: &str, library: &str) -> Vec<Coloured> {
    let (file, colours) = (File::of(text), colours(library));
    let corner = |[vertex, _, normal]: [usize; 3]| {
        let ([x, y, z], [nx, ny, nz]) = (file.positions[vertex], file.normals[normal]);
        [x, y, z, nx, ny, nz]
    };
    let mut all: Vec<Coloured> =
        file.faces.iter().map(|face| (face.corners.map(corner), colours[&face.material])).collect();
    all.sort_unstable();
    all
}

fn expected(mesh: &Mesh) -> Vec<Coloured> {
    let mut all: Vec<Coloured> = triangles(mesh)
        .into_iter()
        .flat_map(|(yarn, triangles)| {
            let colour = mesh.materials[mesh.plan.yarn(yarn as usize).material as usize].srgb;
            triangles.into_iter().map(move |triangle| (triangle, colour))
        })
        .collect();
    all.sort_unstable();
    all
}

#[test]
fn every_triangle_is_read_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fabric.obj");
    let files =
        || (fs::read_to_string(&path).unwrap(), fs::read_to_string(path.with_extension("mtl")).unwrap());
    for (yarns, caps) in [(fabric(), false), (fabric(), true), (long_yarn(), true)] {
        let expected = expected(&whole(&yarns, caps));
        for way in ways() {
            let mesh = pipeline(&yarns, caps, way).mesh(&SerialBackend::new()).unwrap();
            write::mesh(&mesh, &path).unwrap();
            let (text, library) = files();
            assert!(read(&text, &library) == expected, "caps {caps}, {way:?}");
            assert_eq!(File::of(&text).library, "fabric.mtl");

            let written = write::stream(pipeline(&yarns, caps, way), &SerialBackend::new(), &path).unwrap();
            let (text, library) = files();
            assert!(read(&text, &library) == expected, "streamed, caps {caps}, {way:?}");
            assert_eq!((written.bytes, written.triangles), (text.len() as u64, expected.len() as u64));
        }
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
}

#[test]
fn a_region_is_read_back() {
    let folder = tempfile::tempdir().unwrap();
    let (yarns, path) = (fabric(), folder.path().join("region.obj"));
    for way in ways() {
        let part = || pipeline(&yarns, true, way).within(region());
        let mesh = part().topology(Topology::Indexed).mesh(&SerialBackend::new()).unwrap();
        write::stream(part(), &SerialBackend::new(), &path).unwrap();
        let library = fs::read_to_string(path.with_extension("mtl")).unwrap();
        assert!(read(&fs::read_to_string(&path).unwrap(), &library) == expected(&mesh), "{way:?}");
    }
}

/// A texture goes once round each yarn, without a jump on any triangle. Along the yarn, its
/// coordinate grows by the distance between rings.
#[test]
fn texture_coordinates_follow_the_yarn() {
    let yarns = long_yarn();
    let mut out = std::io::Cursor::new(Vec::new());
    write::mesh_to(&whole(&yarns, false), write::Format::Obj, &mut out).unwrap();
    let file = File::of(std::str::from_utf8(&out.into_inner()).unwrap());
    assert_eq!(file.library, "materials.mtl");
    let place = |vertex: usize| glam::Vec3::from(file.positions[vertex].map(f32::from_bits));
    let (mut groups, mut furthest) = (BTreeMap::<_, usize>::new(), 0.0_f32);
    for face in &file.faces {
        *groups.entry(face.group.clone()).or_default() += 1;
        let corners = face.corners.map(|[vertex, at, _]| (place(vertex), file.coordinates[at]));
        for (one, other) in [(0, 1), (1, 2), (2, 0)] {
            let [(here, [turn, along]), (there, [other_turn, other_along])] = [corners[one], corners[other]];
            // Corners of a triangle are less than half a turn apart, because a tube has three sides
            // or more.
            assert!((turn - other_turn).abs() < 0.5, "{turn} and {other_turn}");
            // On the inside of a bend, corners lie nearer than the middles of rings.
            assert!((along - other_along).abs() <= here.distance(there) + 0.4);
            furthest = furthest.max(along);
        }
        let both = face.corners.map(|[_, at, _]| file.coordinates[at][0]);
        assert!(both.iter().all(|turn| (0.0..=1.0).contains(turn)));
    }
    assert_eq!(groups.len(), yarns.layout().yarns().len());
    let length = texere_contact::lengths_mm(&yarns)[0] as f32;
    assert!(furthest > 0.9 * length && furthest <= 1.001 * length, "{furthest} of {length} mm");
}

/// Neither the mesh file nor the file of its materials replaces a file that has to stay. If one of
/// the two can't be written, the other isn't either.
#[test]
fn both_files_are_spared() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("cloth.obj");
    let materials = path.with_extension("mtl");
    fs::write(&materials, "kept").unwrap();
    let mesh = whole(&fabric(), false);
    let error = write::mesh(&mesh, Output::to(&path).sparing([&materials])).unwrap_err();
    assert!(matches!(error, WriteError::Spared { .. }), "{error}");
    assert_eq!(fs::read(&materials).unwrap(), b"kept");
    assert!(!path.exists());
    // Where the mesh can't take its place, its materials don't either.
    fs::remove_file(&materials).unwrap();
    fs::create_dir(&path).unwrap();
    assert!(matches!(write::mesh(&mesh, &path).unwrap_err(), WriteError::Io { .. }));
    assert!(!materials.exists());
    fs::remove_dir(&path).unwrap();
    fs::create_dir(&materials).unwrap();
    assert!(matches!(write::mesh(&mesh, &path).unwrap_err(), WriteError::Io { .. }));
    assert!(!path.exists());
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}
