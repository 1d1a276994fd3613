//! Files that are left in the folder after success and failure.

use std::error::Error;
use std::fs;
use std::io::ErrorKind;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;

use tempfile::TempDir;
use texere_core::backend::{NullBackend, Plan, Run};
use texere_core::{ControlPoint, Limits, Pipeline, Settings, Topology, Yarn, Yarns};
use texere_cpu::SerialBackend;
use texere_formats::WriteError;
use texere_formats::write::{self, Format};

use crate::fabric::{TINY, fabric, pipeline, settings, whole};

/// The files of a folder: names and contents.
fn contents(folder: &TempDir) -> Vec<(String, Vec<u8>)> {
    let mut all: Vec<_> = fs::read_dir(folder.path())
        .unwrap()
        .map(|entry| entry.unwrap())
        .map(|entry| (entry.file_name().into_string().unwrap(), fs::read(entry.path()).unwrap()))
        .collect();
    all.sort_unstable();
    all
}

/// Runs `attempt`, which has to fail, towards a new file and over an old one, in each format.
/// Afterwards there may be no new file, and the old file has to be unchanged.
fn leaves_no_trace(attempt: impl Fn(&Path) -> WriteError, expected: impl Fn(&WriteError) -> bool) {
    for format in Format::ALL {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("fabric").with_extension(format.extension());
        for old in [false, true] {
            if old {
                fs::write(&path, "old").unwrap();
            }
            let before = contents(&folder);
            let error = attempt(&path);
            assert!(expected(&error), "{format:?}: {error:?}");
            assert_eq!(contents(&folder), before, "{format:?}");
        }
    }
}

fn stream(pipeline: Pipeline<'_>, path: &Path) -> Result<write::Written, WriteError> {
    write::stream(pipeline, &SerialBackend::new(), path)
}

fn kind(error: &WriteError) -> Option<(&'static str, ErrorKind)> {
    match error {
        WriteError::Io { action, source, .. } => Some((action, source.kind())),
        _ => None,
    }
}

#[test]
fn cancelling_leaves_no_trace() {
    let yarns = fabric();
    for chunk in 0..3 {
        let attempt = |path: &Path| {
            let mut told = 0;
            let cancelling = pipeline(&yarns, true, (Topology::Shared, TINY)).progress(|progress| {
                told += 1;
                assert!(progress.rings < progress.total, "cancelled before the end");
                if told > chunk { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            });
            stream(cancelling, path).unwrap_err()
        };
        leaves_no_trace(attempt, |error| {
            matches!(error, WriteError::Pipeline(_))
                && error.to_string() == "writing was stopped"
                && error.source().unwrap().to_string() == "cancelled"
        });
    }
}

#[test]
fn a_panic_leaves_no_trace() {
    let yarns = fabric();
    let attempt = |path: &Path| {
        let panicking = pipeline(&yarns, false, (Topology::Shared, TINY)).progress(|progress| {
            if progress.rings > 0 { panic!("on purpose") } else { ControlFlow::Continue(()) }
        });
        let run = std::panic::AssertUnwindSafe(|| stream(panicking, path));
        assert!(std::panic::catch_unwind(run).is_err());
        WriteError::UnknownFormat { path: path.to_owned(), known: String::new() }
    };
    leaves_no_trace(attempt, |_| true);
}

#[test]
fn a_device_that_gives_nothing_leaves_no_trace() {
    let yarns = fabric();
    let attempt =
        |path: &Path| write::stream(Pipeline::new(&yarns), &NullBackend::default(), path).unwrap_err();
    leaves_no_trace(attempt, |error| matches!(error, WriteError::VertexCount { given: 0, planned: 2922 }));
}

#[test]
fn a_mesh_that_is_not_what_was_planned_leaves_no_trace() {
    let whole = whole(&fabric(), false);
    let planned = whole.vertices.len() as u64;
    let [mut short, mut long, mut empty] = [whole.clone(), whole.clone(), whole];
    short.vertices.pop();
    long.vertices.push(long.vertices[0]);
    empty.vertices.clear();
    empty.chunks.clear();
    for (mesh, count) in [(short, planned - 1), (long, planned + 1), (empty, 0)] {
        leaves_no_trace(
            |path| write::mesh(&mesh, path).unwrap_err(),
            |error| matches!(error, WriteError::VertexCount { given, planned: all } if (*given, *all) == (count, planned)),
        );
    }
}

/// The chunks of a plan with room have places that no vertex belongs to.
#[test]
fn a_plan_with_room_leaves_no_trace() {
    let yarns = fabric();
    let plan = Plan::with_room(yarns.layout().clone(), settings(true), |_| 200).unwrap();
    let plan = Arc::new(plan.with_topology(Topology::Shared));
    let limits = Limits { blocks: 3, ..Limits::NONE };
    let attempt = |path: &Path| {
        let device = SerialBackend::new();
        let run = Run::start(&device, plan.clone(), yarns.points(), limits, |_| ControlFlow::Continue(()));
        write::run(run.unwrap(), yarns.materials(), path).unwrap_err()
    };
    leaves_no_trace(attempt, |error| matches!(error, WriteError::VertexCount { .. }));
}

#[test]
fn a_vertex_that_is_not_finite_leaves_no_trace() {
    let yarns = fabric();
    for caps in [false, true] {
        let mut mesh = whole(&yarns, caps);
        // The last vertex is of the last tube or of the last cap. Both belong to the pick.
        let last = mesh.vertices.len() - 1;
        mesh.vertices[last].normal[2] = f32::NAN;
        leaves_no_trace(
            |path| write::mesh(&mesh, path).unwrap_err(),
            |error| matches!(error, WriteError::NotFinite { vertex, yarn: 4 } if *vertex == last as u64),
        );
        // The first vertex of the second yarn. The first yarn has 79 rings of five vertices.
        mesh.vertices[395].position[0] = f32::INFINITY;
        let error = write::mesh(&mesh, "never.ply").unwrap_err();
        assert_eq!(error.to_string(), "vertex 395, of yarn 1, is not finite");
    }
}

#[test]
fn a_material_that_is_missing_leaves_no_trace() {
    let mut mesh = whole(&fabric(), false);
    mesh.materials = mesh.materials[..1].into();
    leaves_no_trace(
        |path| write::mesh(&mesh, path).unwrap_err(),
        |error| matches!(error, WriteError::UnknownMaterial { yarn: 4, material: 1, materials: 1 }),
    );
}

#[test]
fn a_mesh_too_large_for_its_format_is_refused_at_once() {
    let mut yarns = Yarns::builder();
    let points: Vec<_> = (0..100_000).map(|step| ControlPoint::new(step as f32, 0.0, 0.0, 0.1)).collect();
    yarns.yarn(Yarn::default(), &points);
    let yarns = yarns.build().unwrap();
    let settings = Settings { subdivisions: 999, sides: 64, ..Settings::default() };
    // 99,999 intervals of 1,000 rings and one ring more, 64 vertices of 24 bytes each.
    let vertices: u64 = (99_999 * 1_000 + 1) * 64;
    let bytes = vertices * 24;
    // 6.4e9 vertices are too many for PLY as well, so the error for OBJ does not name it.
    let obj = stream(Pipeline::new(&yarns).settings(settings), Path::new("never.obj")).unwrap_err();
    assert!(obj.to_string().ends_with("ends at 2147483647; use fewer sides or subdivisions"), "{obj}");
    let settings_of_ply = Settings { sides: 30, ..settings };
    let obj = stream(Pipeline::new(&yarns).settings(settings_of_ply), Path::new("never.obj")).unwrap_err();
    assert!(obj.to_string().ends_with("write a PLY file, or use fewer sides or subdivisions"), "{obj}");
    leaves_no_trace(
        |path| stream(Pipeline::new(&yarns).settings(settings), path).unwrap_err(),
        |error| match *error {
            WriteError::GlbTooLarge { bytes: told, limit } => (told, limit) == (bytes, 4_294_967_295),
            WriteError::TooManyVertices { format: "PLY", vertices: told, limit } => {
                (told, limit) == (vertices, 4_294_967_295)
            }
            // Each ring has one texture coordinate more than it has vertices.
            WriteError::TooManyVertices { format: "OBJ", vertices: told, limit } => {
                (told, limit) == (vertices / 64 * 65, 2_147_483_647)
            }
            WriteError::TooManyVertices { format: "a yarn in USD", vertices: told, limit } => {
                (told, limit) == (vertices, 2_147_483_647)
            }
            WriteError::TooManyFacets { facets, limit } => {
                (facets, limit) == (99_999 * 1_000 * 128, 4_294_967_295)
            }
            _ => false,
        },
    );
}

#[test]
fn a_limit_that_nothing_fits_is_told_with_its_cause() {
    let yarns = fabric();
    let limits = Limits { binding_bytes: 16, ..Limits::NONE };
    leaves_no_trace(
        |path| stream(Pipeline::new(&yarns).limits(limits), path).unwrap_err(),
        |error| error.source().is_some_and(|plan| plan.to_string().contains("limit is 16")),
    );
}

#[test]
fn a_folder_that_is_missing_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("missing").join("fabric.glb");
    let error = write::mesh(&whole(&fabric(), false), &path).unwrap_err();
    assert_eq!(kind(&error), Some(("create", ErrorKind::NotFound)));
    assert_eq!(error.to_string(), format!("can't create {}", path.display()));
    assert!(contents(&folder).is_empty());
}

#[test]
fn a_target_that_is_a_folder_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fabric.ply");
    fs::create_dir(&path).unwrap();
    let error = stream(Pipeline::new(fabric()), &path).unwrap_err();
    assert_eq!(kind(&error), Some(("create", ErrorKind::IsADirectory)));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn a_read_only_file_is_not_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fabric.glb");
    fs::write(&path, "old").unwrap();
    let mut permissions = fs::metadata(&path).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&path, permissions).unwrap();
    let error = write::mesh(&whole(&fabric(), false), &path).unwrap_err();
    assert_eq!(kind(&error), Some(("create", ErrorKind::PermissionDenied)));
    assert_eq!(contents(&folder), [("fabric.glb".to_owned(), b"old".to_vec())]);
}

#[test]
fn an_old_file_is_replaced_and_nothing_else_is_left() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fabric.ply");
    fs::write(&path, "old").unwrap();
    stream(Pipeline::new(fabric()), &path).unwrap();
    let contents = contents(&folder);
    assert_eq!(contents.len(), 1);
    assert!(contents[0].1.starts_with(b"ply\n"));
}

#[test]
fn unknown_extensions_are_refused_before_any_work() {
    for path in ["fabric", "fabric.", ".glb", "fabric.glb.zip", "glb"] {
        let error = stream(Pipeline::new(fabric()), Path::new(path)).unwrap_err();
        assert!(matches!(error, WriteError::UnknownFormat { .. }), "{path}: {error:?}");
    }
}

#[cfg(unix)]
mod unix {
    use std::os::unix::fs::{FileTypeExt, MetadataExt, PermissionsExt, symlink};
    use std::os::unix::net::UnixListener;

    use super::*;

    #[test]
    fn a_new_file_has_the_permissions_of_any_other() {
        let folder = tempfile::tempdir().unwrap();
        let (path, other) = (folder.path().join("fabric.glb"), folder.path().join("other"));
        write::mesh(&whole(&fabric(), false), &path).unwrap();
        fs::write(&other, "").unwrap();
        assert_eq!(fs::metadata(path).unwrap().mode(), fs::metadata(other).unwrap().mode());
    }

    #[test]
    fn a_file_that_is_replaced_keeps_its_permissions() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("fabric.glb");
        fs::write(&path, "old").unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).unwrap();
        write::mesh(&whole(&fabric(), false), &path).unwrap();
        assert_eq!(fs::metadata(&path).unwrap().mode() & 0o777, 0o640);
        assert!(fs::read(path).unwrap().starts_with(b"glTF"));
    }

    #[test]
    fn a_symbolic_link_stays_one() {
        let [folder, elsewhere] = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
        let (path, file) = (folder.path().join("fabric.glb"), elsewhere.path().join("real.glb"));
        fs::write(&file, "old").unwrap();
        symlink(&file, &path).unwrap();
        write::mesh(&whole(&fabric(), false), &path).unwrap();
        assert!(fs::symlink_metadata(&path).unwrap().is_symlink());
        assert!(fs::read(file).unwrap().starts_with(b"glTF"));
    }

    #[test]
    fn what_is_no_regular_file_is_not_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("socket.glb");
        let _socket = UnixListener::bind(&path).unwrap();
        let error = write::mesh(&whole(&fabric(), false), &path).unwrap_err();
        assert_eq!(kind(&error), Some(("create", ErrorKind::InvalidInput)));
        assert!(fs::metadata(&path).unwrap().file_type().is_socket());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }
}
