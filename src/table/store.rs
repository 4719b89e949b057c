//! Files written whole or not at all, and their fingerprints.

use std::io::Write;
use std::path::Path;

use sha2::{Digest, Sha256};

use super::TableError;

/// Writes `bytes` to `path` through a temporary file in the same folder and a rename: whoever
/// reads `path`, also after an interrupted run, finds the old content or the new, never a part.
///
/// # Errors
/// [`TableError::Unwritable`] if the folder does not exist or cannot be written, or the disk is
/// full.
pub fn atomic_write(path: &Path, bytes: &[u8]) -> Result<(), TableError> {
    let unwritable = |reason: String| TableError::Unwritable { path: path.into(), reason };
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    if path.is_dir() {
        return Err(unwritable("it is a folder".into()));
    }
    if !folder.is_dir() {
        return Err(unwritable(format!("the folder {} does not exist", folder.display())));
    }
    let in_folder = |e: std::io::Error| {
        unwritable(format!("the folder {} cannot be written: {e}", folder.display()))
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".striae-");
    // As a file made in the ordinary way, not private as temporary files are; the umask applies.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = builder.tempfile_in(folder).map_err(in_folder)?;
    file.write_all(bytes).map_err(in_folder)?;
    file.as_file().sync_all().map_err(in_folder)?;
    file.persist(path).map_err(|e| unwritable(e.error.to_string()))?;
    Ok(())
}

/// SHA-256 of `bytes`, 64 lower-case hexadecimal digits.
pub fn sha256_hex(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The bytes of a file.
///
/// # Errors
/// [`TableError::Unreadable`], naming the file.
pub fn read(path: &Path) -> Result<Vec<u8>, TableError> {
    std::fs::read(path).map_err(|source| TableError::Unreadable { path: path.into(), source })
}

/// The text of a file.
///
/// # Errors
/// As [`read`] and [`text`].
pub fn read_text(path: &Path) -> Result<String, TableError> {
    Ok(text(&path.display().to_string(), &read(path)?)?.to_owned())
}

/// Where the content `bytes` of a file comes from: `FILE (sha256 …)`.
pub fn origin(path: &Path, bytes: &[u8]) -> String {
    format!("{} (sha256 {})", path.display(), sha256_hex(bytes))
}

/// `bytes` as text.
///
/// # Errors
/// [`TableError::Content`] with the line of the first byte that is not UTF-8.
pub fn text<'a>(origin: &str, bytes: &'a [u8]) -> Result<&'a str, TableError> {
    std::str::from_utf8(bytes).map_err(|e| {
        let byte = e.valid_up_to();
        let line = bytes[..byte].iter().filter(|b| **b == b'\n').count() + 1;
        let reason = format!("not UTF-8 text (byte {byte} of the file)");
        TableError::content(format!("{origin}:{line}"), reason)
    })
}
