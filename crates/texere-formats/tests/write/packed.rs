//! Packed GLB files, compared with plain ones, vertex by vertex.

use std::collections::BTreeMap;
use std::io::Cursor;

use glam::{DVec3, Vec3};
use gltf::accessor::{DataType, Iter};
use gltf::{Accessor, Gltf, Semantic};
use texere_core::{ControlPoint, Mesh, Yarn, Yarns};
use texere_cpu::SerialBackend;
use texere_formats::WriteError;
use texere_formats::write::{self, Format, Output};

use crate::fabric::{each_mesh, pipeline, ways, whole};

/// Half a step, with room for a rounding of the step and of the middle to `f32`.
const HALF_A_STEP: f64 = 0.5001;

fn written(mesh: &Mesh, format: Format) -> Gltf {
    let mut bytes = Cursor::new(Vec::new());
    write::mesh_to(mesh, format, &mut bytes).unwrap();
    // The gltf crate refuses files that need an extension. Khronos' validator checks packed files
    // in the tests of the Python package.
    Gltf::from_slice_without_validation(&bytes.into_inner()).unwrap()
}

/// Checks that the three numbers of each vertex are of `kind`, and whether they are normalized.
fn assert_kind(accessor: &Accessor<'_>, kind: DataType, normalized: bool) {
    assert_eq!((accessor.data_type(), accessor.normalized()), (kind, normalized));
}

/// Checks that the packed file of `mesh` holds the plain one's vertices and triangles.
fn assert_packs(mesh: &Mesh, what: &str) {
    let (plain, packed) = (written(mesh, Format::Glb), written(mesh, Format::PackedGlb));
    assert_eq!(packed.extensions_required().collect::<Vec<_>>(), ["KHR_mesh_quantization"]);
    assert_eq!(packed.extensions_used().collect::<Vec<_>>(), ["KHR_mesh_quantization"]);
    let [views, packed_views] = [&plain, &packed].map(|file| file.views().map(|view| view.length()));
    let ([pattern, vertices], [packed_pattern, packed_vertices]) = [views, packed_views]
        .map(|lengths| <[usize; 2]>::try_from(lengths.collect::<Vec<_>>()).unwrap())
        .into();
    assert_eq!((pattern, vertices), (packed_pattern, 2 * packed_vertices), "{what}");
    let nodes = |file: &Gltf| {
        let root = file.default_scene().unwrap().nodes().next().unwrap().index();
        file.nodes().filter(|node| node.index() != root).map(|node| node.index()).collect::<Vec<_>>()
    };
    assert_eq!(nodes(&plain), nodes(&packed));
    let [plain_blob, blob] = [&plain, &packed].map(|file| file.blob.as_deref().unwrap());
    for node in nodes(&packed) {
        let (plain, packed) = (plain.nodes().nth(node).unwrap(), packed.nodes().nth(node).unwrap());
        assert_eq!(plain.name(), packed.name());
        let (middle, turn, scale) = packed.transform().decomposed();
        assert_eq!((turn, scale), ([0.0, 0.0, 0.0, 1.0], [scale[0]; 3]));
        let step = f64::from(scale[0]);
        // Equal places of a yarn stay equal, so that caps close tubes.
        let mut places = BTreeMap::new();
        let (mut low, mut high) = (DVec3::MAX, DVec3::MIN);
        let primitives = plain.mesh().unwrap().primitives().zip(packed.mesh().unwrap().primitives());
        for (plain, packed) in primitives {
            let [indices, packed_indices] = [plain.indices(), packed.indices()].map(|each| each.unwrap());
            assert_eq!(indices.index(), packed_indices.index());
            let reader = plain.reader(|_| Some(plain_blob));
            let positions: Vec<_> = reader.read_positions().unwrap().collect();
            let steps = packed.get(&Semantic::Positions).unwrap();
            assert_kind(&steps, DataType::I16, false);
            let steps: Vec<_> = Iter::<[i16; 3]>::new(steps, |_| Some(blob)).unwrap().collect();
            assert_eq!(positions.len(), steps.len());
            for (position, steps) in positions.iter().zip(&steps) {
                let exact = Vec3::from_array(*position).as_dvec3();
                let from = DVec3::from_array(steps.map(f64::from)) * step;
                let off = (from + Vec3::from_array(middle).as_dvec3() - exact).abs().max_element();
                assert!(off <= HALF_A_STEP * step, "{off} mm off, with steps of {step}, {what}");
                let first = *places.entry(position.map(f32::to_bits)).or_insert(*steps);
                assert_eq!(first, *steps);
                (low, high) = (low.min(exact), high.max(exact));
            }
            let bounds = packed.get(&Semantic::Positions).unwrap();
            let bound = |value: Option<gltf::json::Value>| value.unwrap().as_array().unwrap().clone();
            for (axis, (low, high)) in bound(bounds.min()).iter().zip(bound(bounds.max())).enumerate() {
                let values = || steps.iter().map(|steps| f64::from(steps[axis]));
                assert_eq!(low.as_f64().unwrap(), values().fold(f64::INFINITY, f64::min));
                assert_eq!(high.as_f64().unwrap(), values().fold(f64::NEG_INFINITY, f64::max));
            }
            let shares = packed.get(&Semantic::Normals).unwrap();
            assert_kind(&shares, DataType::I8, true);
            let shares = Iter::<[i8; 3]>::new(shares, |_| Some(blob)).unwrap();
            for (normal, shares) in reader.read_normals().unwrap().zip(shares) {
                let stored = Vec3::from_array(shares.map(|share| f32::from(share) / 127.0));
                let angle = stored.angle_between(Vec3::from_array(normal)).to_degrees();
                assert!(angle < 0.4, "a normal is off by {angle} degrees, {what}");
            }
        }
        // No step is longer than it has to be.
        assert!(step <= (high - low).max_element() / 65534.0 * 1.0001, "{step} {low} {high} {what}");
    }
}

#[test]
fn a_packed_file_holds_the_vertices_of_a_plain_one() {
    each_mesh(assert_packs);
}

/// A straight yarn of `length` mm.
fn straight(length: f32) -> Yarns {
    let mut yarns = Yarns::builder();
    yarns.yarn(Yarn::default(), &[0.0, length].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
    yarns.build().unwrap()
}

/// At the limit, a step is 0.01 mm. The yarn's ends are flat, so that its box is as long as its
/// centreline.
#[test]
fn a_yarn_too_long_for_its_steps_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let output = || Output::to(folder.path().join("yarn.glb")).packed();
    let long = straight(655.1);
    for error in [
        write::mesh(&whole(&long, true), output()).unwrap_err(),
        write::stream(pipeline(&long, true, ways()[0]), &SerialBackend::new(), output())
            .map(|_| ())
            .unwrap_err(),
    ] {
        assert!(matches!(error, WriteError::TooLongToPack { yarn: 0, .. }), "{error:?}");
        assert_eq!(
            error.to_string(),
            "yarn 0 takes 655.1 mm of the cloth, but packed GLB holds 655 mm of a yarn; write plain GLB"
        );
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    write::mesh(&whole(&straight(654.9), true), output()).unwrap();
}

#[test]
fn only_glb_is_packed() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["yarn.ply", "yarn.stl", "yarn.obj", "yarn.yarns"] {
        let output = || Output::to(folder.path().join(name)).packed();
        for error in
            [output().check().unwrap_err(), write::mesh(&whole(&straight(1.0), true), output()).unwrap_err()]
        {
            assert!(matches!(error, WriteError::NotEnding { expected: "glb", .. }), "{error:?}");
        }
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}
