//! U3MA: the files of a U3M material in one file. A U3MA file is a ZIP file that keeps to more
//! rules than ZIP has.

use std::io::{self, Write};

/// The field of an entry that says which version of ZIP wrote it: 6.3, on the file system FAT.
const WRITTEN_BY: u16 = 0x003f;
/// The field of an entry that says which version of ZIP a reader needs: 2.0.
const READ_BY: u16 = 0x14;
/// The flag of an entry that says that its name is UTF-8.
const UTF8: u16 = 1 << 11;

/// A file's entry in the central directory.
struct Entry {
    name: String,
    crc: u32,
    bytes: u32,
    offset: u32,
}

/// Writes `files` (name and content) as U3MA. Files are stored as they are, because maps are
/// compressed already. `time` and `date` are UTC, in the format of MS-DOS.
///
/// **Errors**: the errors of `files` and of `out`, [`io::ErrorKind::FileTooLarge`] for more than
/// 4 GiB, and `io::ErrorKind::Other` for more than 65,535 files.
///
/// **Source**: u3m_additional_spec_u3ma.txt of U3M 1.1: no extra fields, no comments, no
/// attributes.
pub(crate) fn write(
    mut out: impl Write,
    files: impl IntoIterator<Item = io::Result<(String, Vec<u8>)>>,
    [time, date]: [u16; 2],
) -> io::Result<()> {
    let small = |bytes: u64| {
        u32::try_from(bytes).map_err(|_| io::Error::new(io::ErrorKind::FileTooLarge, "U3MA ends at 4 GiB"))
    };
    let (mut entries, mut at) = (Vec::new(), 0_u64);
    for file in files {
        let (name, content) = file?;
        let entry = Entry {
            crc: crc32fast::hash(&content),
            bytes: small(content.len() as u64)?,
            offset: small(at)?,
            name,
        };
        let header = [&0x0403_4b50_u32.to_le_bytes()[..], &entry.both([time, date])].concat();
        out.write_all(&header)?;
        out.write_all(entry.name.as_bytes())?;
        out.write_all(&content)?;
        at += (header.len() + entry.name.len() + content.len()) as u64;
        entries.push(entry);
    }
    let start = small(at)?;
    let mut directory = Vec::new();
    for entry in &entries {
        directory.extend(0x0201_4b50_u32.to_le_bytes());
        directory.extend(WRITTEN_BY.to_le_bytes());
        directory.extend(entry.both([time, date]));
        // No comment, the first disk, no attributes.
        directory.extend([0; 10]);
        directory.extend(entry.offset.to_le_bytes());
        directory.extend(entry.name.as_bytes());
    }
    let count = u16::try_from(entries.len()).map_err(|_| io::Error::other("U3MA holds 65,535 files"))?;
    let length = small(directory.len() as u64)?;
    directory.extend(0x0605_4b50_u32.to_le_bytes());
    directory.extend([0; 4]);
    directory.extend(count.to_le_bytes().repeat(2));
    directory.extend(length.to_le_bytes());
    directory.extend(start.to_le_bytes());
    directory.extend([0; 2]);
    out.write_all(&directory)?;
    out.flush()
}

impl Entry {
    /// The fields that an entry has twice: before its content, and in the directory.
    fn both(&self, [time, date]: [u16; 2]) -> Vec<u8> {
        let stored = 0_u16;
        let mut bytes: Vec<u8> =
            [READ_BY, UTF8, stored, time, date].into_iter().flat_map(u16::to_le_bytes).collect();
        bytes.extend([self.crc, self.bytes, self.bytes].into_iter().flat_map(u32::to_le_bytes));
        // The names are short, because this crate makes them. There is no extra field.
        bytes.extend([self.name.len() as u16, 0].into_iter().flat_map(u16::to_le_bytes));
        bytes
    }
}
