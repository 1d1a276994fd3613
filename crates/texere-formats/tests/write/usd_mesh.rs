//! USD stages of meshes, read back by a reader of these tests' own. The tests of the Python package
//! open them with Pixar's.

use std::collections::BTreeMap;
use std::io::Cursor;

use glam::Vec3;
use texere_core::{Mesh, Topology};
use texere_cpu::SerialBackend;
use texere_formats::WriteError;
use texere_formats::write::{self, Format, MeshForm, Output, VertexAttribute};

use crate::fabric::{Triangle, fabric, long_yarn, pipeline, region, triangles, ways, whole};
use crate::obj;

/// The prim of a yarn.
#[derive(Debug, Default)]
pub(crate) struct Prim {
    /// The name for people.
    name: String,
    /// Attributes by name, each with the numbers in its value.
    values: BTreeMap<String, Vec<f64>>,
    /// The interpolation of attributes.
    interpolation: BTreeMap<String, String>,
}

/// The prims of a stage by their paths. Each begins with a line `def Mesh`, indented by four
/// spaces.
pub(crate) fn prims(stage: &str) -> BTreeMap<String, Prim> {
    let (head, prims) = stage.split_once("    def Mesh ").unwrap();
    assert!(head.starts_with("#usda 1.0\n(\n    defaultPrim = \"cloth\"\n") && head.ends_with("\n{\n"));
    assert!(prims.ends_with("\n    }\n}\n"));
    prims.split("    def Mesh ").map(prim).collect()
}

/// A prim with its path's last name.
fn prim(text: &str) -> (String, Prim) {
    let mut prim = Prim::default();
    let (path, rest) = text.split_once(" (\n        displayName = ").unwrap();
    let (name, mut rest) = rest.split_once("\n    )\n    {\n").unwrap();
    prim.name = name.trim_matches('"').to_owned();
    while let Some((declared, after)) = rest.trim_start().split_once(" = ") {
        let attribute = declared.split_whitespace().last().unwrap().to_owned();
        let (value, next) = match after.strip_prefix('[') {
            Some(list) => list.split_once(']').unwrap(),
            None => after.split_once('\n').unwrap(),
        };
        let numbers = value.split(['(', ')', ',']).map(str::trim).filter(|text| !text.is_empty());
        let is_token = value.starts_with('"');
        prim.values.insert(
            attribute.clone(),
            numbers.filter(|_| !is_token).map(|number| number.parse().unwrap()).collect(),
        );
        if is_token {
            assert_eq!((attribute.as_str(), value), ("subdivisionScheme", "\"none\""));
        }
        rest = next;
        if let Some((metadata, next)) = rest.strip_prefix(" (").and_then(|rest| rest.split_once(')')) {
            let interpolation = metadata.trim().strip_prefix("interpolation = ").unwrap();
            prim.interpolation.insert(attribute, interpolation.trim_matches('"').to_owned());
            rest = next;
        }
    }
    assert!(rest.trim_matches(['}', '\n', ' ']).is_empty(), "{rest:?}");
    (path.trim_matches('"').to_owned(), prim)
}

impl Prim {
    fn floats(&self, attribute: &str) -> Vec<f32> {
        self.values[attribute].iter().map(|value| *value as f32).collect()
    }

    /// The corners of all triangles.
    pub(crate) fn corners(&self) -> Vec<[usize; 3]> {
        let (counts, corners) = (&self.values["faceVertexCounts"], &self.values["faceVertexIndices"]);
        assert!(counts.iter().all(|count| *count == 3.0));
        assert_eq!(3 * counts.len(), corners.len());
        corners.as_chunks().0.iter().map(|corners| corners.map(|corner| corner as usize)).collect()
    }

    /// The number of the vertices.
    pub(crate) fn vertices(&self) -> usize {
        self.values["points"].len() / 3
    }

    /// The triangles, sorted.
    fn triangles(&self) -> Vec<Triangle> {
        let [points, normals] = ["points", "normals"].map(|list| self.floats(list));
        assert_eq!(points.len(), normals.len());
        let vertex = |corner: usize| {
            let of = |list: &[f32], axis: usize| list[3 * corner + axis].to_bits();
            [0, 1, 2, 3, 4, 5].map(|float| of(if float < 3 { &points } else { &normals }, float % 3))
        };
        let mut triangles: Vec<_> = self.corners().into_iter().map(|corners| corners.map(vertex)).collect();
        triangles.sort_unstable();
        triangles
    }
}

/// The prims of the stage of a mesh.
fn written(mesh: &Mesh, form: impl Into<MeshForm>) -> BTreeMap<String, Prim> {
    let mut bytes = Cursor::new(Vec::new());
    write::mesh_to(mesh, form, &mut bytes).unwrap();
    prims(std::str::from_utf8(bytes.get_ref()).unwrap())
}

/// Checks that a stage has the triangles of `mesh`, each yarn's in a prim of its own. The mesh has
/// the device's indices.
fn assert_holds(stage: &BTreeMap<String, Prim>, mesh: &Mesh, what: &str) {
    let expected = triangles(mesh);
    assert_eq!(stage.len(), expected.len(), "{what}");
    for (path, prim) in stage {
        let yarn = prim.values["primvars:yarn"][0] as u32;
        assert_eq!(*path, format!("yarn_{}", yarn + 1));
        assert!(prim.triangles() == expected[&yarn], "{what}: yarn {yarn}");
        assert_eq!(prim.interpolation, BTreeMap::from([("normals".into(), "vertex".into())]));
        let material = &mesh.materials[mesh.plan.yarn(yarn as usize).material as usize];
        assert_eq!(prim.floats("primvars:displayColor"), material.linear_rgb());
        let points = prim.floats("points");
        for axis in 0..3 {
            let own = || points.iter().skip(axis).step_by(3).copied();
            let extent = prim.floats("extent");
            assert_eq!(own().fold(f32::INFINITY, f32::min), extent[axis], "{what}");
            assert_eq!(own().fold(f32::NEG_INFINITY, f32::max), extent[3 + axis], "{what}");
        }
    }
}

#[test]
fn a_stage_holds_the_triangles_of_each_yarn() {
    for (yarns, caps) in [(fabric(), false), (fabric(), true), (long_yarn(), true)] {
        let mesh = whole(&yarns, caps);
        for way in ways() {
            let cut = pipeline(&yarns, caps, way).mesh(&SerialBackend::new()).unwrap();
            assert_holds(&written(&cut, Format::Usda), &mesh, &format!("caps {caps}, {way:?}"));
        }
    }
    let names = ["end 1", "end 2", "course 7", "yarn 4", "pick 1"];
    let stage = written(&whole(&fabric(), false), Format::Usda);
    assert_eq!(stage.values().map(|prim| &prim.name[..]).collect::<Vec<_>>(), names);
}

/// Yarns outside a box have no prim, and others have several runs of rings.
#[test]
fn a_stage_holds_a_region() {
    let yarns = fabric();
    for (caps, way) in
        [false, true].into_iter().flat_map(|caps| ways().into_iter().map(move |way| (caps, way)))
    {
        let part = || pipeline(&yarns, caps, way).within(region());
        let mesh = part().topology(Topology::Indexed).mesh(&SerialBackend::new()).unwrap();
        let cut = part().mesh(&SerialBackend::new()).unwrap();
        let stage = written(&cut, Format::Usda);
        assert_holds(&stage, &mesh, &format!("caps {caps}, {way:?}"));
        assert!((1..5).contains(&stage.len()));
    }
}

/// Coordinates are those of OBJ, ring by ring. Tangents lead to the next ring.
#[test]
fn vertices_have_texture_coordinates_and_tangents() {
    for yarns in [fabric(), long_yarn()] {
        let mesh = whole(&yarns, false);
        let mut obj = Cursor::new(Vec::new());
        write::mesh_to(&mesh, Format::Obj, &mut obj).unwrap();
        let obj = obj::File::of(std::str::from_utf8(obj.get_ref()).unwrap());
        let stage = written(&mesh, Format::Usda.with(VertexAttribute::ALL));
        let coordinates: Vec<_> = stage.values().flat_map(|prim| prim.floats("primvars:st")).collect();
        assert_eq!(coordinates, obj.coordinates.as_flattened());
        for prim in stage.values() {
            let list = |name: &str| -> Vec<_> {
                prim.floats(name).as_chunks().0.iter().map(|of| Vec3::from_array(*of)).collect()
            };
            let [points, normals, tangents] = ["points", "normals", "primvars:tangents"].map(list);
            assert_eq!((tangents.len(), normals.len()), (points.len(), points.len()));
            // Six corners a ring: five sides and the seam.
            for (corner, tangent) in tangents.iter().enumerate() {
                assert!((tangent.length() - 1.0).abs() < 1e-5 && tangent.dot(normals[corner]).abs() < 1e-5);
                let ahead = points.get(corner + 6).map(|next| *next - points[corner]);
                // The inner side of a sharp bend runs back.
                let is_gentle = prim.name == "course 7";
                assert!(!is_gentle || ahead.is_none_or(|ahead| ahead.dot(*tangent) > 0.0));
            }
            assert_eq!(prim.interpolation.len(), 3);
        }
    }
}

#[test]
fn a_mesh_has_no_straight_lines() {
    let folder = tempfile::tempdir().unwrap();
    let output = Output::to(folder.path().join("cloth.usda")).linear();
    let error = write::mesh(&whole(&fabric(), false), output).unwrap_err();
    assert!(matches!(error, WriteError::Unheld { format: "a mesh", .. }), "{error:?}");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}
