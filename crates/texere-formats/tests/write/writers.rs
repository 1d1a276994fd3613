//! Any writer gets the bytes of the file, from the writer's current position on.

use std::fs;
use std::io::{self, Cursor, ErrorKind, Seek, SeekFrom, Write};

use texere_cpu::SerialBackend;
use texere_fabric::Structure;
use texere_formats::WriteError;
use texere_formats::write::{self, Format, Side};

use crate::fabric::{TINY, fabric, pipeline, ways, whole};

/// The bytes before the file in the writer. They must not change.
const BEFORE: &[u8] = b"what an archive has before it";

/// The bytes that `write` writes to a writer that stands after `BEFORE` and holds old bytes beyond
/// the end of any file.
fn written(write: impl FnOnce(&mut Cursor<Vec<u8>>)) -> Vec<u8> {
    let mut out = Cursor::new([BEFORE, &vec![0xa5; 1 << 20]].concat());
    out.set_position(BEFORE.len() as u64);
    write(&mut out);
    let end = out.position() as usize;
    let bytes = out.into_inner();
    assert!(bytes.starts_with(BEFORE));
    assert!(bytes[end..].iter().all(|byte| *byte == 0xa5), "it reaches beyond where the writer was left");
    bytes[BEFORE.len()..end].to_vec()
}

#[test]
fn a_mesh_has_the_bytes_of_its_file() {
    let (yarns, folder) = (fabric(), tempfile::tempdir().unwrap());
    for format in Format::ALL {
        // A writer gets no path, and the bytes of OBJ name `materials.mtl` then.
        let path = folder.path().join("materials").with_extension(format.extension());
        for (caps, way) in
            [false, true].into_iter().flat_map(|caps| ways().into_iter().map(move |way| (caps, way)))
        {
            let streamed = write::stream(pipeline(&yarns, caps, way), &SerialBackend::new(), &path).unwrap();
            let file = fs::read(&path).unwrap();
            let bytes = written(|out| {
                let made = write::stream_to(pipeline(&yarns, caps, way), &SerialBackend::new(), format, out);
                assert_eq!(made.unwrap(), streamed);
            });
            assert!(bytes == file && file.len() as u64 == streamed.bytes, "{format:?}, {caps}, {way:?}");
            let mesh = pipeline(&yarns, caps, way).mesh(&SerialBackend::new()).unwrap();
            write::mesh(&mesh, &path).unwrap();
            let bytes = written(|out| write::mesh_to(&mesh, format, out).unwrap());
            assert!(bytes == fs::read(&path).unwrap(), "{format:?}, {caps}, {way:?}");
        }
    }
}

#[test]
fn pictures_have_the_bytes_of_their_files() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("picture.png");
    let rgb: Vec<u8> = (0..90 * 70 * 3).map(|place| (place * place % 251) as u8).collect();
    write::picture([90, 70], &rgb, &path).unwrap();
    assert!(written(|out| write::picture_to([90, 70], &rgb, out).unwrap()) == fs::read(&path).unwrap());

    let designs = concat!(env!("CARGO_MANIFEST_DIR"), "/../../designs/");
    for (name, side) in [
        ("herringbone.wif", Side::Face),
        ("herringbone.wif", Side::Back),
        ("rib.toml", Side::Face),
        ("locknit.toml", Side::Back),
    ] {
        let design = texere_formats::read(format!("{designs}{name}")).unwrap();
        let (to_file, mut to_writer, mut out);
        out = Vec::new();
        match &design.structure {
            Structure::Woven(woven) => {
                to_file = write::draft(woven.cloth(), woven.draft(), side, &path);
                to_writer = write::draft_to(woven.cloth(), woven.draft(), side, &mut out);
            }
            Structure::Weft(knit) => {
                to_file = write::knit_draft(knit, side, &path);
                to_writer = write::knit_draft_to(knit, side, &mut out);
            }
            Structure::Warp(knit) => {
                to_file = write::warp_draft(knit, side, &path);
                to_writer = write::warp_draft_to(knit, side, &mut out);
            }
            other => panic!("{other:?}"),
        }
        assert_eq!(to_file.unwrap(), *to_writer.as_mut().unwrap(), "{name}");
        assert!(out == fs::read(&path).unwrap(), "{name}");
    }
}

/// A writer that takes `room` bytes and refuses any more. It also refuses to be flushed.
struct Full {
    room: usize,
}

impl Write for Full {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let taken = bytes.len().min(self.room);
        self.room -= taken;
        if taken == 0 && !bytes.is_empty() { Err(ErrorKind::StorageFull.into()) } else { Ok(taken) }
    }

    fn flush(&mut self) -> io::Result<()> {
        Err(ErrorKind::BrokenPipe.into())
    }
}

impl Seek for Full {
    fn seek(&mut self, _: SeekFrom) -> io::Result<u64> {
        Ok(0)
    }
}

#[test]
fn what_a_writer_refuses_is_said() {
    let mesh = whole(&fabric(), true);
    let noise: Vec<u8> = (0..4800u32).map(|place| (place * place % 251) as u8).collect();
    for (room, kind) in
        [(0, ErrorKind::StorageFull), (100, ErrorKind::StorageFull), (1 << 30, ErrorKind::BrokenPipe)]
    {
        let yarns = fabric();
        let streamed = write::stream_to(
            pipeline(&yarns, true, (mesh.plan.settings().topology, TINY)),
            &SerialBackend::new(),
            Format::Glb,
            Full { room },
        );
        for refused in [
            write::mesh_to(&mesh, Format::Glb, Full { room }),
            write::mesh_to(&mesh, Format::Ply, Full { room }),
            write::mesh_to(&mesh, Format::Stl, Full { room }),
            write::mesh_to(&mesh, Format::Obj, Full { room }),
            streamed.map(drop),
        ] {
            match refused {
                Err(WriteError::Writer { source }) => assert_eq!(source.kind(), kind),
                other => panic!("{other:?} with room for {room}"),
            }
        }
        // The PNG encoder wraps the writer's error.
        let refused = write::picture_to([40, 40], &noise, Full { room });
        assert!(matches!(refused, Err(WriteError::Writer { .. })), "{refused:?}");
    }
}
