//! Tests of disks that fill up, of meshes that come in pieces of several sizes, and of a piece out
//! of order.

use std::fs;
use std::io::{self, Seek, SeekFrom, Write};

use tempfile::NamedTempFile;
use texere_core::{ControlPoint, Limits, Material, Mesh, Pipeline, Topology, Yarn, Yarns};
use texere_cpu::SerialBackend;

use super::bounds::Bounds;
use super::feed::Feed;
use super::target::Target;
use super::{Format, MeshForm, VertexAttribute, WriteError};

/// A file on a disk that is full after `room` bytes more.
#[derive(Debug)]
struct Failing {
    file: NamedTempFile,
    room: usize,
}

impl Write for Failing {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.room == 0 {
            return Err(io::ErrorKind::StorageFull.into());
        }
        let written = self.file.write(&bytes[..bytes.len().min(self.room)])?;
        self.room -= written;
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Seek for Failing {
    fn seek(&mut self, position: SeekFrom) -> io::Result<u64> {
        self.file.seek(position)
    }
}

/// The mesh of two capped yarns, in several chunks. One yarn has 8,001 rings, whose vertices are
/// several times what a target buffers, and is cut over chunks.
fn mesh() -> Mesh {
    let mut yarns = Yarns::builder();
    for (count, material) in [(4001, [200, 30, 30]), (9, [30, 30, 200])] {
        let srgb = material;
        let material = yarns.material(Material { srgb, ..Material::default() });
        let points: Vec<_> = (0..count)
            .map(|step| ControlPoint::new(0.1 * step as f32, 0.1 * (step % 3) as f32, 0.0, 0.1))
            .collect();
        yarns.yarn(Yarn { material, ..Yarn::default() }, &points);
    }
    let yarns = yarns.build().unwrap();
    let limits = Limits { blocks: 50, ..Limits::NONE };
    let pipeline = Pipeline::new(&yarns).topology(Topology::Shared).caps(true).limits(limits);
    pipeline.mesh(&SerialBackend::new()).unwrap()
}

/// Writes `mesh` to `out` in pieces of at most `piece` vertices, some of them empty. The last step,
/// by which the file takes its place, is left out.
fn write(mesh: &Mesh, form: impl Into<MeshForm>, piece: usize, out: Failing) -> Result<Failing, WriteError> {
    let form = form.into();
    let target = Target::over(out, 0, Some("fabric".into()));
    let mut bounds = Bounds::new(&mesh.plan)?;
    for chunk in &mesh.chunks {
        bounds.include(
            chunk,
            0,
            &mesh.vertices[chunk.first_vertex() as usize..][..chunk.vertices() as usize],
        );
    }
    let bounds = form.format.needs_bounds().then_some(&bounds);
    let mut feed = Feed::open(form, target, &mesh.plan, &mesh.chunks, &mesh.materials, bounds)?;
    for chunk in &mesh.chunks {
        let own = &mesh.vertices[chunk.first_vertex() as usize..][..chunk.vertices() as usize];
        for (number, vertices) in own.chunks(piece).enumerate() {
            feed.vertices(chunk, (number * piece) as u32, vertices)?;
        }
        if piece < own.len() {
            feed.vertices(chunk, chunk.vertices(), &[])?;
        }
    }
    feed.finish()?.into_inner()
}

/// The forms of glTF that no ending of a file name stands for.
const GLB_FORMS: [Format; 4] =
    [Format::PackedGlb, Format::CompressedGlb, Format::KhrCompressedGlb, Format::InstancedGlb];

#[test]
fn a_disk_that_is_full_sooner_or_later_is_an_error() {
    let folder = tempfile::tempdir().unwrap();
    let on_disk = |room| Failing { file: NamedTempFile::new_in(folder.path()).unwrap(), room };
    let mesh = mesh();
    for format in Format::ALL.into_iter().chain(GLB_FORMS) {
        let plenty = 1 << 30;
        let needed = plenty - write(&mesh, format, usize::MAX, on_disk(plenty)).unwrap().room;
        for room in (0..needed).step_by(100_003).chain([1, 11, 12, needed - 1]) {
            match write(&mesh, format, usize::MAX, on_disk(room)) {
                Err(WriteError::Io { action: "write", source, .. }) => {
                    assert_eq!(source.kind(), io::ErrorKind::StorageFull);
                }
                other => panic!("{format:?} with room for {room} of {needed} bytes: {other:?}"),
            }
            assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0, "{format:?}, {room}");
        }
    }
}

#[test]
fn pieces_of_any_size_give_the_same_file() {
    let mesh = mesh();
    let folder = tempfile::tempdir().unwrap();
    let formats = Format::ALL.into_iter().chain(GLB_FORMS);
    let with = [
        Format::Glb,
        Format::PackedGlb,
        Format::CompressedGlb,
        Format::KhrCompressedGlb,
        Format::Ply,
        Format::Usda,
    ]
    .map(|format| format.with(VertexAttribute::ALL));
    for form in formats.map(MeshForm::from).chain(with) {
        let file = |piece| {
            let out = Failing { file: NamedTempFile::new_in(folder.path()).unwrap(), room: usize::MAX };
            fs::read(write(&mesh, form, piece, out).unwrap().file.path()).unwrap()
        };
        let whole = file(usize::MAX);
        for piece in [1, 7, 384, 1000] {
            assert!(file(piece) == whole, "{form:?} in pieces of {piece}");
        }
    }
}

#[test]
fn a_piece_out_of_order_is_refused() {
    let mesh = mesh();
    let out = Failing { file: NamedTempFile::new().unwrap(), room: usize::MAX };
    let target = Target::over(out, 0, Some("fabric".into()));
    let mut feed =
        Feed::open(Format::Ply.into(), target, &mesh.plan, &mesh.chunks, &mesh.materials, None).unwrap();
    feed.vertices(&mesh.chunks[0], 0, &mesh.vertices[..6]).unwrap();
    let error = feed.vertices(&mesh.chunks[0], 12, &mesh.vertices[12..18]).unwrap_err();
    assert!(matches!(error, WriteError::VertexCount { given: 6, .. }), "{error:?}");
}
