//! The result that is committed for a spec, if it still is one.

use std::path::{Path, PathBuf};

use crate::fit::outcome::{FitProvenance, Status};
use crate::fit::{FitError, FitResult, Spec};
use crate::table::store::sha256_hex;

/// Whether a fit that ended so gives the constants that its spec asks for: the optimum, or the
/// optimum under a bound. Every other ending says that there may be better ones.
pub fn stands(status: Status) -> bool {
    matches!(status, Status::Converged | Status::AtBound)
}

/// Where the result of a spec lies.
pub(super) fn path(root: &Path, name: &str) -> PathBuf {
    root.join("fits").join(format!("{name}.json"))
}

/// The committed result, or why it does not stand for the spec any more. `refit` is what the spec
/// gives today, where that is known: with it a change of the data or of the form is noticed too.
pub(super) fn result(
    root: &Path,
    spec: &Spec,
    refit: Option<&FitResult>,
) -> Result<Result<FitResult, String>, FitError> {
    let path = path(root, &spec.name);
    let mend = format!("run `striae fit {}`", spec.name);
    if !path.is_file() {
        return Ok(Err(format!("there is no result: {mend}")));
    }
    let committed = FitResult::read(&path)?;
    let was = provenance(&committed);
    if was.is_none_or(|was| was.spec_sha256 != sha256_hex(spec.text.as_bytes())) {
        return Ok(Err(format!("the result is stale, its spec has changed: {mend}")));
    }
    if let (Some(was), Some(is)) = (was, refit.and_then(provenance))
        && was.data_sha256 != is.data_sha256
    {
        return Ok(Err(format!("the result is stale, its form or data have changed: {mend}")));
    }
    Ok(Ok(committed))
}

fn provenance(result: &FitResult) -> Option<&FitProvenance> {
    match result {
        FitResult::Single(outcome) => Some(&outcome.provenance),
        FitResult::Family(family) => Some(&family.provenance),
    }
}
