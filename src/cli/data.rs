//! The sets of measured data in a project.

use std::path::Path;

use crate::project::entries;
use crate::table::provenance::Provenance;

/// A folder under `data/measured`.
#[derive(Debug)]
pub(super) struct DataSet {
    pub(super) name: String,
    /// Number of data files that `SOURCE.toml` accounts for.
    pub(super) files: usize,
    /// What is wrong with `SOURCE.toml` or with the files that it names, if anything.
    pub(super) fault: Option<String>,
    /// What it is, from `SOURCE.toml`.
    pub(super) title: String,
}

/// Every set, by name, checked against its `SOURCE.toml`; none where the folder is not there.
pub(super) fn sets(data: &Path) -> anyhow::Result<Vec<DataSet>> {
    if !data.is_dir() {
        return Ok(Vec::new());
    }
    let folders = entries(data)?.into_iter().filter(|path| path.is_dir());
    Ok(folders.map(|folder| set(&folder)).collect())
}

fn set(folder: &Path) -> DataSet {
    let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
    match Provenance::read(folder) {
        Err(error) => {
            DataSet { name, files: 0, fault: Some(error.to_string()), title: String::new() }
        }
        Ok(source) => DataSet {
            name,
            files: source.files.len(),
            fault: source.verify(folder).err().map(|error| error.to_string()),
            title: source.title,
        },
    }
}
