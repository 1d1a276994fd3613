//! Yarns are read as they were written.

use std::fs;

use texere_core::{Boundary, Mesh, Pipeline, Settings, Yarns};
use texere_cpu::ParallelBackend;
use texere_formats::{WriteError, read, write};

use crate::clothes::{JERSEY, POPLIN, TRICOT, bent, cloth, odd, repeat};

/// Everything that yarns hold, as text with all digits. Values of different bits have different
/// texts, except NaN.
fn all(yarns: &Yarns, boundary: &Boundary) -> String {
    format!("{yarns:?} {boundary:?}")
}

fn mesh(yarns: &Yarns) -> Mesh {
    let settings = Settings::of(yarns);
    Pipeline::new(yarns).settings(settings).mesh(&ParallelBackend::open().unwrap()).unwrap()
}

/// Writes yarns, reads them, and compares. Returns the bytes of the file.
pub(crate) fn same(yarns: &Yarns, boundary: &Boundary) -> Vec<u8> {
    let mut file = Vec::new();
    let length = write::repeat_to(yarns, boundary, &mut file).unwrap();
    assert_eq!(length, file.len() as u64);
    let saved = read::yarns_from("cloth.yarns", &file).unwrap();
    assert_eq!(all(&saved.yarns, &saved.boundary), all(yarns, boundary));
    assert_eq!(saved.yarns.tension().to_bits(), yarns.tension().to_bits());
    let mut again = Vec::new();
    write::repeat_to(&saved.yarns, &saved.boundary, &mut again).unwrap();
    assert!(again == file, "written again it is another file");
    file
}

/// Checks [`same`], and that the mesh of the yarns that were read equals that of the original.
fn same_mesh(yarns: &Yarns, boundary: &Boundary) {
    let read = read::yarns_from("cloth.yarns", &same(yarns, boundary)).unwrap().yarns;
    let [first, again] = [yarns, &read].map(mesh);
    let bits = |mesh: &Mesh| bytemuck::cast_slice::<_, u8>(&mesh.vertices).to_vec();
    assert!(bits(&first) == bits(&again) && first.indices == again.indices, "another mesh");
    assert_eq!(first.materials, again.materials);
}

fn cut(yarns: &Yarns) {
    same_mesh(yarns, &Boundary::without_repeat(yarns.layout()));
}

#[test]
fn woven_cloth_at_rest() {
    let yarns = cloth(POPLIN);
    assert!(yarns.points().iter().any(|point| !point.is_round()), "its threads are to be flat");
    cut(&yarns);
    cut(&yarns.clone().with_tension(0.3).unwrap());
    cut(&bent(&yarns));
}

#[test]
fn knits_and_their_repeats() {
    for design in [JERSEY, TRICOT] {
        cut(&cloth(design));
        let (yarns, boundary) = repeat(design);
        assert!(boundary.repeat()[0] > 0.0);
        same_mesh(&yarns, &boundary);
    }
}

#[test]
fn every_kind_of_section_origin_and_end() {
    let (yarns, boundary) = odd();
    same(&yarns, &boundary);
    let bent = bent(&yarns);
    assert!(bent.ups().is_some());
    same(&bent, &boundary);
    // A polygon needs settings of its own.
    for yarn in 0..5 {
        cut(&yarns.only([yarn]).unwrap());
    }
}

#[test]
fn what_was_edited_is_saved_as_it_is() {
    let (yarns, boundary) = odd();
    for mut yarns in [yarns.clone(), bent(&yarns)] {
        let mut points = yarns.yarn_points(1).unwrap().to_vec();
        points.iter_mut().for_each(|point| point.z = 3.0 * point.x);
        yarns.set_points(1, &points).unwrap();
        same(&yarns, &boundary);
    }
}

/// Up directions so short that the square of their length has few digits, and longer ones.
#[test]
fn up_directions_of_any_length() {
    let (yarns, boundary) = odd();
    let points = yarns.points().len();
    for scale in [1e-22, 3e-21, 1e-20, 1e-19, 1e-3, 0.999_999_5, 1.0, 7.0, 1e17] {
        let up = |point| [1.0 + point as f32, 0.3, 2.0].map(|axis| axis * scale);
        same(&yarns.clone().with_ups((0..points).map(up).collect()).unwrap(), &boundary);
    }
}

#[test]
fn files_are_written_as_all_others_are() {
    let folder = tempfile::tempdir().unwrap();
    let (yarns, boundary) = odd();
    let path = folder.path().join("cloth.YARNS");
    let length = write::repeat(&yarns, &boundary, &path).unwrap();
    let mut bytes = Vec::new();
    write::repeat_to(&yarns, &boundary, &mut bytes).unwrap();
    assert!(fs::read(&path).unwrap() == bytes && bytes.len() as u64 == length);
    let saved = read::yarns(&path).unwrap();
    assert_eq!(all(&saved.yarns, &saved.boundary), all(&yarns, &boundary));

    let other = write::yarns(&yarns, folder.path().join("cloth.glb"));
    assert!(matches!(other, Err(WriteError::NotEnding { expected: "yarns", .. })), "{other:?}");
    let spared = write::yarns(&yarns, write::Output::to(&path).sparing([&path]));
    assert!(matches!(spared, Err(WriteError::Spared { .. })), "{spared:?}");
    let fewer = yarns.only([0]).unwrap();
    let foreign = write::repeat(&fewer, &boundary, folder.path().join("fewer.yarns"));
    assert!(matches!(foreign, Err(WriteError::Boundary(_))), "{foreign:?}");
    let full = write::yarns_to(&yarns, &mut [0; 100][..]);
    assert!(matches!(full, Err(WriteError::Writer { .. })), "{full:?}");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "something is left behind");
    assert!(fs::read(&path).unwrap() == bytes);
}
