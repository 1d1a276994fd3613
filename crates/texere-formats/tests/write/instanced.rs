//! Instanced GLB files, drawn out and compared with plain ones, triangle by triangle.

use std::collections::{BTreeSet, HashMap};
use std::io::{Cursor, ErrorKind};

use gltf::accessor::Iter;
use gltf::{Gltf, Semantic};
use serde_json::Value;
use texere_core::{ControlPoint, Mesh, Origin, Pipeline, Yarn, Yarns};
use texere_cpu::{ParallelBackend, SerialBackend};
use texere_formats::write::{self, Format, Output, VertexAttribute};
use texere_formats::{WriteError, read_from};

use crate::fabric::{each_mesh, fabric, pipeline, region, ways, whole};

/// A triangle: its material, and the positions (mm) and normals of its corners.
#[derive(Debug, Clone, Copy)]
struct Triangle {
    material: Option<usize>,
    corners: [[[f32; 3]; 2]; 3],
}

/// A GLB file, and its JSON document. The document is kept because the gltf crate leaves out
/// extensions that it does not know.
struct File {
    gltf: Gltf,
    json: Value,
}

impl File {
    fn of(mesh: &Mesh, format: Format) -> Self {
        let mut bytes = Cursor::new(Vec::new());
        write::mesh_to(mesh, format, &mut bytes).unwrap();
        let bytes = bytes.into_inner();
        let json = serde_json::from_slice(&gltf::Glb::from_slice(&bytes).unwrap().json).unwrap();
        // The gltf crate refuses files that need an extension.
        Self { gltf: Gltf::from_slice_without_validation(&bytes).unwrap(), json }
    }

    fn blob(&self) -> &[u8] {
        self.gltf.blob.as_deref().unwrap()
    }

    /// The places of a node in its parent: those of its instances, if it has some.
    fn places(&self, node: usize) -> Vec<[f32; 3]> {
        let node = &self.json["nodes"][node];
        let place = |value: &Value| [0, 1, 2].map(|axis| value[axis].as_f64().unwrap_or(0.0) as f32);
        let instances = &node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
        let Some(accessor) = instances["TRANSLATION"].as_u64() else {
            return vec![place(&node["translation"])];
        };
        assert!(node["translation"].is_null() && instances.as_object().unwrap().len() == 1);
        let accessor = self.gltf.accessors().nth(accessor as usize).unwrap();
        Iter::<[f32; 3]>::new(accessor, |_| Some(self.blob())).unwrap().collect()
    }

    /// All triangles that a viewer draws, mm.
    fn drawn(&self) -> Vec<Triangle> {
        let mut drawn = Vec::new();
        let root = self.gltf.default_scene().unwrap().nodes().next().unwrap();
        for node in root.children() {
            let places = self.places(node.index());
            for primitive in node.mesh().unwrap().primitives() {
                let reader = primitive.reader(|_| Some(self.blob()));
                let [positions, normals]: [Vec<_>; 2] =
                    [reader.read_positions().unwrap().collect(), reader.read_normals().unwrap().collect()];
                let indices: Vec<_> = reader.read_indices().unwrap().into_u32().collect();
                let material = primitive.material().index();
                for place in &places {
                    drawn.extend(indices.as_chunks::<3>().0.iter().map(|corners| Triangle {
                        material,
                        corners: corners.map(|corner| {
                            let position: [f32; 3] = positions[corner as usize];
                            [[0, 1, 2].map(|axis| position[axis] + place[axis]), normals[corner as usize]]
                        }),
                    }));
                }
            }
        }
        drawn
    }

    /// Checks what the document says of positions: the least and the greatest of each part.
    fn assert_bounds(&self) {
        for primitive in self.gltf.meshes().flat_map(|mesh| mesh.primitives().collect::<Vec<_>>()) {
            let positions = primitive.get(&Semantic::Positions).unwrap();
            let said = [positions.min(), positions.max()].map(|bound| {
                let bound = bound.unwrap();
                [0, 1, 2].map(|axis| bound[axis].as_f64().unwrap() as f32)
            });
            let all: Vec<_> = Iter::<[f32; 3]>::new(positions, |_| Some(self.blob())).unwrap().collect();
            let fold = |pick: fn(f32, f32) -> f32| {
                all.iter().copied().reduce(|a, b| [0, 1, 2].map(|axis| pick(a[axis], b[axis]))).unwrap()
            };
            assert_eq!(said, [fold(f32::min), fold(f32::max)]);
        }
    }
}

/// Checks that each triangle of `plain` has one of `own` that is off by `off` mm at most in each
/// coordinate, with normals within a degree, and that there are no others.
fn assert_same(plain: &[Triangle], own: &[Triangle], off: f32, what: &str) {
    assert_eq!(plain.len(), own.len(), "{what}");
    let cell = 0.05;
    let of = |triangle: &Triangle, moved: f32| {
        [0, 1, 2].map(|axis| {
            let middle: f32 = triangle.corners.iter().map(|[position, _]| position[axis] / 3.0).sum();
            ((middle + moved) / cell).floor() as i32
        })
    };
    let mut cells: HashMap<[i32; 3], Vec<Triangle>> = HashMap::new();
    for triangle in own {
        cells.entry(of(triangle, 0.0)).or_default().push(*triangle);
    }
    for triangle in plain {
        let [low, high] = [-1.0, 1.0].map(|side| of(triangle, side * 3.0 * off));
        let near = (low[0]..=high[0])
            .flat_map(|x| (low[1]..=high[1]).map(move |y| (x, y)))
            .flat_map(|(x, y)| (low[2]..=high[2]).map(move |z| [x, y, z]));
        let found = near.into_iter().any(|cell| {
            let Some(held) = cells.get_mut(&cell) else { return false };
            let Some(at) = held.iter().position(|held| are_near(triangle, held, off)) else { return false };
            held.swap_remove(at);
            true
        });
        assert!(found, "{what}: no triangle is near {triangle:?}");
    }
}

fn are_near(one: &Triangle, other: &Triangle, off: f32) -> bool {
    one.material == other.material
        && (0..3).any(|turn| {
            (0..3).all(|corner| {
                let [[place, normal], [other_place, other_normal]] =
                    [one.corners[corner], other.corners[(corner + turn) % 3]];
                let far = (0..3).map(|axis| (place[axis] - other_place[axis]).abs()).fold(0.0, f32::max);
                let cosine: f32 = (0..3).map(|axis| normal[axis] * other_normal[axis]).sum();
                far <= off && cosine >= 1f32.to_radians().cos()
            })
        })
}

/// The largest coordinate of a mesh, mm.
fn reach(mesh: &Mesh) -> f32 {
    mesh.vertices.iter().flat_map(|vertex| vertex.position).fold(0.0, |most, place| most.max(place.abs()))
}

/// Checks that a file of `mesh` draws the plain file's triangles. Returns the numbers of meshes and
/// of places.
fn assert_draws(mesh: &Mesh, what: &str) -> [usize; 2] {
    let [plain, own] = [Format::Glb, Format::InstancedGlb].map(|format| File::of(mesh, format));
    // A millionth of the largest coordinate, and the rounding of a place and of a sum.
    assert_same(&plain.drawn(), &own.drawn(), reach(mesh) * 1.3e-6, what);
    own.assert_bounds();
    let places = (1..own.gltf.nodes().len()).map(|node| own.places(node).len());
    let recurs = places.clone().any(|places| places > 1);
    let used = own.gltf.extensions_used().collect::<Vec<_>>();
    assert_eq!(used, if recurs { vec!["EXT_mesh_gpu_instancing"] } else { Vec::new() });
    assert_eq!(own.gltf.extensions_required().collect::<Vec<_>>(), used);
    [own.gltf.meshes().len(), places.sum()]
}

#[test]
fn an_instanced_file_draws_the_triangles_of_a_plain_one() {
    each_mesh(|mesh, what| {
        assert_draws(mesh, what);
    });
    let yarns = fabric();
    for (caps, way) in ways().into_iter().flat_map(|way| [false, true].map(|caps| (caps, way))) {
        let part = pipeline(&yarns, caps, way).within(region()).mesh(&SerialBackend::new()).unwrap();
        assert_draws(&part, "a region");
    }
}

fn placed(design: &str) -> Yarns {
    read_from("cloth.toml", design, |_| Err(ErrorKind::NotFound.into())).unwrap().yarns().unwrap()
}

/// Threads of a plain weave recur every second pick or end, and loops of a jersey with each wale.
/// A larger weave or knit has hardly more different parts than a smaller one.
#[test]
fn parts_that_recur_are_held_once() {
    let weave = |threads: usize| {
        format!(
            "weave = {{ notation = \"plain\", ends = {threads}, picks = {threads} }}\n\
             finish.settle = false\nyarns.a.diameter_mm = 0.3\nyarns.b.diameter_mm = 0.3\n\
             warp = {{ yarns = [\"a\"], spacing_mm = 0.7 }}\nweft = {{ yarns = [\"b\"], spacing_mm = 0.7 }}\n"
        )
    };
    let knit = |wales: usize| {
        format!(
            "knit = {{ chart = \"k\", repeat = [{wales}, 24], loop_length_mm = 5 }}\nfinish.settle = false\nyarns.a.tex = 50\n"
        )
    };
    for make in [&weave as &dyn Fn(usize) -> String, &knit] {
        let [small, large] = [64, 128].map(|count| {
            let yarns = placed(&make(count));
            let mesh = Pipeline::new(&yarns).sides(5).caps(true).mesh(&ParallelBackend::open().unwrap());
            assert_draws(&mesh.unwrap(), &make(count))
        });
        assert!(small[0] < 200 && large[0] < small[0] + 20, "{small:?}, {large:?}");
        assert!(large[1] > 19 * small[1] / 10, "{small:?}, {large:?}");
    }
}

/// A yarn that bends a little more in one place, by far less than its thickness, has a part of its
/// own there.
#[test]
fn parts_that_differ_a_little_are_held_each() {
    let mesh = |moved: f32| {
        let mut yarns = Yarns::builder();
        for end in 0..20 {
            let points: Vec<_> = (0..160)
                .map(|pick| {
                    let height = if (end, pick) == (7, 88) { moved } else { 0.0 };
                    ControlPoint::new(end as f32, pick as f32, height, 0.25)
                })
                .collect();
            yarns.yarn(Yarn { origin: Origin::End(end + 1), ..Yarn::default() }, &points);
        }
        Pipeline::new(yarns.build().unwrap()).sides(6).mesh(&SerialBackend::new()).unwrap()
    };
    let held = [0.0, 0.005, 0.002].map(|moved| assert_draws(&mesh(moved), "straight ends")[0]);
    assert!(held[1] > held[0] && held[2] > held[0], "{held:?}");
}

/// Far from the origin, neighbouring numbers of type `f32` lie 0.008 mm apart. Ends that differ in
/// thickness by ten times that are two parts nevertheless.
#[test]
fn parts_far_away_are_held_each() {
    let mut yarns = Yarns::builder();
    for (end, radius) in [(0, 0.1), (1, 0.14)] {
        let points = [0.0, 1.0, 2.0].map(|pick| ControlPoint::new(1e5 + end as f32, pick, 0.0, radius));
        yarns.yarn(Yarn { origin: Origin::End(end + 1), ..Yarn::default() }, &points);
    }
    let mesh = Pipeline::new(yarns.build().unwrap()).sides(6).mesh(&SerialBackend::new()).unwrap();
    assert_eq!(assert_draws(&mesh, "two ends"), [2, 2]);
}

#[test]
fn a_coordinate_without_differences_is_refused() {
    let mut mesh = whole(&fabric(), false);
    mesh.vertices[7].position[0] = 3e38;
    let mut out = Cursor::new(Vec::new());
    let error = write::mesh_to(&mesh, Format::InstancedGlb, &mut out).unwrap_err();
    assert!(matches!(error, WriteError::Unheld { format: "instanced GLB", .. }), "{error:?}");
    assert!(out.into_inner().is_empty());
}

#[test]
fn a_cloth_that_never_recurs_is_refused() {
    let mut yarns = Yarns::builder();
    for end in 0..60 {
        let place = |pick: u32| {
            let height = f64::from(pick * pick + end).sin() as f32 / 4.0;
            ControlPoint::new(end as f32, pick as f32, height, 0.25)
        };
        yarns.yarn(Yarn::default(), &(0..6000).map(place).collect::<Vec<_>>());
    }
    let yarns = yarns.build().unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("cloth.glb");
    let pipeline = || Pipeline::new(&yarns).sides(24).subdivisions(2);
    let error = write::stream(pipeline(), &ParallelBackend::open().unwrap(), Output::to(&path).instanced());
    let error = error.unwrap_err();
    assert!(matches!(error, WriteError::TooFewRepeats { .. }), "{error:?}");
    assert!(error.to_string().ends_with("write packed or compressed GLB"), "{error}");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    let (mut out, device) = (Cursor::new(Vec::new()), ParallelBackend::open().unwrap());
    write::stream_to(pipeline(), &device, Format::InstancedGlb, &mut out).unwrap_err();
    assert!(out.into_inner().is_empty());
}

#[test]
fn only_glb_without_attributes_is_instanced() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = whole(&fabric(), true);
    for name in ["yarn.ply", "yarn.stl", "yarn.obj", "yarn.usda", "yarn.yarns"] {
        let output = || Output::to(folder.path().join(name)).instanced();
        for error in [output().check().unwrap_err(), write::mesh(&mesh, output()).unwrap_err()] {
            assert!(matches!(error, WriteError::NotEnding { expected: "glb", .. }), "{error:?}");
        }
    }
    for attribute in VertexAttribute::ALL {
        let output = || Output::to(folder.path().join("yarn.glb")).instanced().attributes([attribute]);
        let errors = [output().check().unwrap_err(), write::mesh(&mesh, output()).unwrap_err()];
        let said: BTreeSet<_> = errors.iter().map(ToString::to_string).collect();
        assert!(said.len() == 1 && said.first().unwrap().contains("instanced GLB can't hold"), "{said:?}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}
