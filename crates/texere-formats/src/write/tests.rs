//! Disks that fill up, at any byte.

use std::fs;
use std::io::{self, Seek, SeekFrom, Write};

use tempfile::NamedTempFile;
use texere_core::{ControlPoint, Mesh, NullBackend, Pipeline, Topology, Yarn, Yarns};

use super::{Feed, Format, Target, WriteError};

/// A file on a disk with room for so many bytes more.
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

/// A tube of 8,001 rings, several times what is buffered. All its vertices lie at the origin.
fn mesh() -> Mesh {
    let mut yarns = Yarns::builder();
    let points: Vec<_> = (0..4001).map(|step| ControlPoint::new(step as f32, 0.0, 0.0, 0.1)).collect();
    yarns.yarn(Yarn::default(), &points);
    let yarns = yarns.build().unwrap();
    Pipeline::new(&yarns).topology(Topology::Shared).mesh(&NullBackend::default()).unwrap()
}

/// Writes `mesh` to `out`, all but the last step: taking the file's place.
fn write(mesh: &Mesh, format: Format, out: Failing) -> Result<Failing, WriteError> {
    let target = Target::over(out, "fabric".as_ref());
    let mut feed = Feed::open(format, target, &mesh.plan, &mesh.chunks, &mesh.materials)?;
    feed.vertices(&mesh.chunks[0], 0, &mesh.vertices)?;
    feed.finish()?.into_inner()
}

#[test]
fn a_full_disk_is_an_error_at_any_byte() {
    let folder = tempfile::tempdir().unwrap();
    let on_disk = |room| Failing { file: NamedTempFile::new_in(folder.path()).unwrap(), room };
    let mesh = mesh();
    for format in Format::ALL {
        let plenty = 1 << 30;
        let needed = plenty - write(&mesh, format, on_disk(plenty)).unwrap().room;
        for room in (0..needed).step_by(100_003).chain([1, 11, 12, needed - 1]) {
            match write(&mesh, format, on_disk(room)) {
                Err(WriteError::Io { action: "write", source, .. }) => {
                    assert_eq!(source.kind(), io::ErrorKind::StorageFull);
                }
                other => panic!("{format:?} with room for {room} of {needed} bytes: {other:?}"),
            }
            assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0, "{format:?}, {room}");
        }
    }
}
