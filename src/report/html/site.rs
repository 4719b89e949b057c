//! The report as a folder: pages, JSON, text, and every figure as a file.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::shell::render_page;
use crate::document::{Colophon, Page, json, text};
use crate::table::TableError;
use crate::table::store::atomic_write;

/// What lists the figures that the last run wrote.
const MANIFEST: &str = "figures/manifest.json";

/// Why a report cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum SiteError {
    /// A name that cannot be a file name everywhere.
    #[error("{what} {got:?}: expected lower-case letters, digits, `-` and `_`")]
    Name {
        /// `page slug` or `figure stem`.
        what: &'static str,
        /// The name.
        got: String,
    },
    /// Two pages or two figures of the same name.
    #[error("{what} {name:?} is used twice")]
    Twice {
        /// `page slug` or `figure stem`.
        what: &'static str,
        /// The name.
        name: String,
    },
    /// A figure holds no plot.
    #[error("page {page}: figure {figure}: expected at least one plot, got none")]
    Plot {
        /// Slug of its page.
        page: String,
        /// Its file stem.
        figure: String,
    },
    /// The model cannot be written as JSON.
    #[error("report.json: {0}")]
    Json(#[from] serde_json::Error),
    /// A file cannot be written.
    #[error(transparent)]
    Unwritable(#[from] TableError),
    /// A folder cannot be made, or an old figure not removed.
    #[error("{}: {source}", path.display())]
    Io {
        /// Which.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
}

/// What a run wrote.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Written {
    /// Every file of the report, whether or not its bytes changed, in the order written.
    pub files: Vec<PathBuf>,
    /// Figures of an earlier run that are no longer part of the report and were removed.
    pub removed: Vec<PathBuf>,
}

#[derive(Serialize, Deserialize)]
struct Manifest {
    figures: BTreeSet<String>,
}

/// Writes `index.html`, `<slug>.html` for every page, `report.json`, `report.txt`,
/// `figures/<stem>.svg` and `figures/<stem>.png` into `dir`, which is made if it is not there.
///
/// Without a page `index`, one is made that lists the others. Everything is rendered before the
/// first file is written; each file is written beside its place and renamed, so that an interrupted
/// run leaves whole files. A file whose bytes would not change is not touched. Only figures that an
/// earlier run listed in `figures/manifest.json` are ever removed; without a readable manifest,
/// none.
///
/// # Errors
/// [`SiteError`] if a name is unusable or used twice, a figure cannot be drawn, or a file cannot be
/// written.
pub fn write_site(dir: &Path, pages: &[Page], provenance: &Colophon) -> Result<Written, SiteError> {
    unique("page slug", pages.iter().map(|p| p.slug.as_str()))?;
    let figures = pages.iter().flat_map(|p| p.figures().map(|f| f.file_stem.as_str()));
    let pictures = pages.iter().flat_map(|p| p.pictures().map(|f| f.file_stem.as_str()));
    unique("figure stem", figures.chain(pictures))?;
    let mut pages = pages.to_vec();
    if !pages.iter().any(|p| p.slug == "index") {
        let summary = "What was fitted to what, how wrong it is, and what it costs.";
        pages.insert(0, Page::new("index", "Report", summary));
    }

    let mut files: Vec<(String, Vec<u8>)> = Vec::new();
    for page in &pages {
        if let Some(empty) = page.figures().find(|figure| figure.plots.is_empty()) {
            let (page, figure) = (page.slug.clone(), empty.file_stem.clone());
            return Err(SiteError::Plot { page, figure });
        }
        let rendered = render_page(page, &pages, provenance);
        for (stem, drawing) in rendered.drawings {
            files.push((format!("figures/{stem}.svg"), drawing.standalone().into_bytes()));
        }
        for picture in page.pictures() {
            files.push((format!("figures/{}.png", picture.file_stem), picture.png.clone()));
        }
        files.push((format!("{}.html", page.slug), rendered.html.into_bytes()));
    }
    files.push(("report.json".to_owned(), json::report(&pages, provenance)?.into_bytes()));
    files.push(("report.txt".to_owned(), text::report(&pages, provenance).into_bytes()));
    let figures = files.iter().filter_map(|(name, _)| name.strip_prefix("figures/"));
    let manifest = Manifest { figures: figures.map(str::to_owned).collect() };
    let manifest_text = serde_json::to_string_pretty(&manifest)? + "\n";

    let (mut written, mut removed) = (Vec::new(), Vec::new());
    let folder = dir.join("figures");
    std::fs::create_dir_all(&folder).map_err(|source| SiteError::Io { path: folder, source })?;
    let mut put = |name: &str, content: &[u8]| -> Result<(), SiteError> {
        let path = dir.join(name);
        if !std::fs::read(&path).is_ok_and(|old| old == content) {
            atomic_write(&path, content)?;
        }
        written.push(path);
        Ok(())
    };
    for (name, content) in &files {
        put(name, content)?;
    }
    for stale in old_figures(dir).difference(&manifest.figures) {
        let path = dir.join("figures").join(stale);
        if path.is_file() {
            std::fs::remove_file(&path)
                .map_err(|source| SiteError::Io { path: path.clone(), source })?;
            removed.push(path);
        }
    }
    // Last, so that what an interrupted run leaves behind is still listed for the next.
    put(MANIFEST, manifest_text.as_bytes())?;
    Ok(Written { files: written, removed })
}

fn usable(name: &str) -> bool {
    let allowed = |b: u8| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'-' || b == b'_';
    !name.is_empty() && name.bytes().all(allowed)
}

fn unique<'a>(what: &'static str, names: impl Iterator<Item = &'a str>) -> Result<(), SiteError> {
    let mut seen = BTreeSet::new();
    for name in names {
        if !usable(name) {
            return Err(SiteError::Name { what, got: name.to_owned() });
        }
        if !seen.insert(name) {
            return Err(SiteError::Twice { what, name: name.to_owned() });
        }
    }
    Ok(())
}

/// The figures that an earlier run wrote into `dir`, as its manifest says; names that this module
/// would not have written are left out, so that nothing else can be removed through it.
fn old_figures(dir: &Path) -> BTreeSet<String> {
    let manifest = std::fs::read_to_string(dir.join(MANIFEST))
        .ok()
        .and_then(|text| serde_json::from_str::<Manifest>(&text).ok());
    let mut figures = manifest.map(|m| m.figures).unwrap_or_default();
    let stem = |name: &str| {
        let stem = [".svg", ".png"].iter().find_map(|extension| name.strip_suffix(extension));
        stem.is_some_and(usable)
    };
    figures.retain(|name| stem(name));
    figures
}
