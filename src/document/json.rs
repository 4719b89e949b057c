//! The report as JSON: the whole model, keys in the order of its fields.
//!
//! Numbers are the shortest that read back exactly; what is not finite is `null` with a reason
//! beside it.

use serde::Serialize;

use super::{Colophon, Page};

/// The report: `schema`, `provenance`, `pages`.
///
/// # Errors
/// [`serde_json::Error`] if the model cannot be written as JSON, which no finite model provokes.
pub fn report(pages: &[Page], provenance: &Colophon) -> Result<String, serde_json::Error> {
    #[derive(Serialize)]
    struct Report<'a> {
        schema: u32,
        provenance: &'a Colophon,
        pages: &'a [Page],
    }
    let mut json = serde_json::to_string(&Report { schema: 1, provenance, pages })?;
    json.push('\n');
    Ok(json)
}
