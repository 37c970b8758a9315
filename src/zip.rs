//! ZIP archives (APPNOTE 6.3) whose files are stored as they are, with one fixed date, so that the
//! same files give the same bytes.

/// The first of January 1980, the beginning of dates in archives.
const DATE: u16 = 0x21;
/// Bit 11: names are UTF-8.
const UTF8: u16 = 0x800;
/// Version 2.0 is needed to extract.
const VERSION: u16 = 20;

/// A file for an archive.
#[derive(Clone, Debug, PartialEq)]
pub struct ArchiveFile {
    /// Its path, with `/`.
    pub path: String,
    /// Its contents.
    pub bytes: Vec<u8>,
}

/// Returns the archive of some files.
pub fn zip(files: &[ArchiveFile]) -> Vec<u8> {
    let (mut out, mut directory) = (Vec::new(), Vec::new());
    for file in files {
        let at = size(out.len());
        let entry = entry(file);
        out.extend(b"PK\x03\x04");
        out.extend(&entry);
        out.extend(file.path.as_bytes());
        out.extend(&file.bytes);
        directory.extend(b"PK\x01\x02");
        directory.extend(VERSION.to_le_bytes());
        directory.extend(&entry);
        // No comment, first disk, no attributes.
        directory.extend([0; 10]);
        directory.extend(at.to_le_bytes());
        directory.extend(file.path.as_bytes());
    }
    let begin = size(out.len());
    let count = u16::try_from(files.len()).unwrap_or(u16::MAX).to_le_bytes();
    let length = size(directory.len());
    out.append(&mut directory);
    out.extend(b"PK\x05\x06\0\0\0\0");
    out.extend(count);
    out.extend(count);
    out.extend(length.to_le_bytes());
    out.extend(begin.to_le_bytes());
    out.extend([0; 2]);
    out
}

/// Returns the fields that both headers of a file have.
fn entry(file: &ArchiveFile) -> Vec<u8> {
    let mut out = Vec::new();
    for field in [VERSION, UTF8, 0, 0, DATE] {
        out.extend(field.to_le_bytes());
    }
    let length = size(file.bytes.len());
    for field in [crc32fast::hash(&file.bytes), length, length] {
        out.extend(field.to_le_bytes());
    }
    let name = u16::try_from(file.path.len()).unwrap_or(u16::MAX);
    out.extend(name.to_le_bytes());
    out.extend([0; 2]);
    out
}

/// A length of the archive: two hundred variants take some tens of megabytes.
fn size(bytes: usize) -> u32 {
    u32::try_from(bytes).unwrap_or(u32::MAX)
}
