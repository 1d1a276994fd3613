//! Tests that a file whose format this build leaves out is refused with the name of the missing
//! feature. Another package of the same build may turn on more features than this package asks for.

use std::io::Cursor;

use crate::backend::NullBackend;
use crate::read::{CurveScale, curves_from};
use crate::write::{Format, mesh_to};
use crate::{ControlPoint, Pipeline, ReadError, WriteError, Yarn, Yarns, read};

#[test]
fn a_design_that_this_build_cannot_read_is_said_to_need_its_feature() {
    for (file, feature, is_there) in [
        ("twill.wif", "wif", cfg!(feature = "wif")),
        ("twill.wifw", "wif", cfg!(feature = "wif")),
        ("twill.dtx", "wif", cfg!(feature = "wif")),
        ("twill.wpo", "wif", cfg!(feature = "wif")),
        ("twill.toml", "toml", cfg!(feature = "toml")),
        ("jersey.k", "knitout", cfg!(feature = "knitout")),
        ("jersey.KNITOUT", "knitout", cfg!(feature = "knitout")),
    ] {
        match read(file) {
            // There is no such file.
            Err(ReadError::Io { .. }) => {}
            Err(error @ ReadError::Feature { .. }) => {
                assert!(!is_there && error.to_string().contains(&format!("`{feature}`")), "{file}: {error}");
            }
            other => panic!("{file}: {other:?}"),
        }
    }
}

#[test]
fn curves_that_this_build_cannot_read_are_said_to_need_their_feature() {
    let is_there = cfg!(feature = "texgen");
    match curves_from("yarns.tg3", b"no XML", CurveScale::default()) {
        Err(error @ ReadError::Feature { .. }) => {
            assert!(!is_there && error.to_string().contains("`texgen`"), "{error}");
        }
        Err(error) => assert!(error.to_string().starts_with("yarns.tg3"), "{error}"),
        Ok(yarns) => panic!("{yarns:?}"),
    }
}

#[cfg(all(feature = "toml", not(feature = "knitout")))]
#[test]
fn a_design_file_that_names_a_knitting_program_is_said_to_need_its_feature() {
    let path = std::env::temp_dir().join(format!("texere-knitout-{}.toml", std::process::id()));
    std::fs::write(&path, "knit.knitout = \"jersey.k\"\nyarns.wool.tex = 50\n").unwrap();
    let error = read(&path).unwrap_err();
    std::fs::remove_file(&path).unwrap();
    let innermost = error.innermost();
    assert!(
        matches!(innermost, ReadError::Feature { feature: "knitout", .. } | ReadError::Io { .. }),
        "{error:?}"
    );
    assert!(error.to_string().contains("line 1: knit.knitout"), "{error}");
}

#[test]
fn a_mesh_that_this_build_cannot_write_is_said_to_need_its_feature() {
    let mut yarns = Yarns::builder();
    yarns.yarn(Yarn::default(), &[0.0, 1.0].map(|x| ControlPoint::new(x, 0.0, 0.0, 0.1)));
    let mesh = Pipeline::new(yarns.build().unwrap()).mesh(&NullBackend::default()).unwrap();
    for (format, is_there) in [
        (Format::Glb, cfg!(feature = "glb")),
        (Format::Ply, cfg!(feature = "ply")),
        (Format::Stl, cfg!(feature = "stl")),
        (Format::Obj, cfg!(feature = "obj")),
    ] {
        let mut out = Cursor::new(Vec::new());
        match mesh_to(&mesh, format, &mut out) {
            Ok(()) => assert!(!out.into_inner().is_empty(), "{format:?}"),
            Err(error @ WriteError::Feature { .. }) => {
                let said = error.to_string();
                assert!(!is_there && said.contains(&format!("`{}`", format.extension())), "{said}");
                assert!(out.into_inner().is_empty());
            }
            Err(error) => panic!("{format:?}: {error}"),
        }
    }
}
