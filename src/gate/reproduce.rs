//! Do the committed constants come out again?

use std::collections::BTreeMap;
use std::path::Path;

use rayon::prelude::*;
use serde::Serialize;

use super::Verdict;
use crate::fit::outcome::{FitProvenance, Outcome, Status};
use crate::fit::{Context, FitError, FitResult, Spec, run_spec};
use crate::table::store::sha256_hex;

/// How far an f64 constant may be from the committed one, relative: another machine's libm moves
/// the last digits of an optimum, and f32 constants do not move with them.
const VALUE_TOLERANCE: f64 = 1e-6;

/// Whether a refit gives the constants that are committed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Reproduction {
    /// The fit.
    pub fit: String,
    /// Its result file, relative to the project.
    pub file: String,
    /// Whether they agree.
    pub verdict: Verdict,
    /// What was compared, or what differs.
    pub detail: String,
}

/// What every spec gives today, by name.
pub(super) type Refits = BTreeMap<String, FitResult>;

/// Runs every spec in memory.
///
/// # Errors
/// The [`FitError`] of the first spec, in their order, that cannot be run.
pub(super) fn refit(context: &Context, specs: &[Spec]) -> Result<Refits, FitError> {
    let run = |spec: &Spec| Ok((spec.name.clone(), run_spec(spec, context)?));
    let results: Vec<Result<(String, FitResult), FitError>> = specs.par_iter().map(run).collect();
    results.into_iter().collect()
}

/// Compares every refit with what is committed: the f32 constants must be equal, the f64 ones
/// agree to 1e-6.
///
/// # Errors
/// [`FitError`] for a result file that cannot be read.
pub(super) fn reproduce(
    root: &Path,
    specs: &[Spec],
    refits: &Refits,
) -> Result<Vec<Reproduction>, FitError> {
    specs.iter().map(|spec| one(root, spec, refits.get(&spec.name))).collect()
}

fn one(root: &Path, spec: &Spec, refit: Option<&FitResult>) -> Result<Reproduction, FitError> {
    let compared = match (committed(root, spec, refit)?, refit) {
        (Err(reason), _) => Err(reason),
        (Ok(_), None) => Err("it was not fitted again".to_owned()),
        (Ok(committed), Some(refit)) => compare(committed.outcomes(), refit.outcomes()),
    };
    let (verdict, detail) = match compared {
        Ok(count) => (Verdict::Pass, format!("{count} constants reproduce")),
        Err(reason) => (Verdict::Fail, reason),
    };
    Ok(Reproduction { fit: spec.name.clone(), file: file(spec), verdict, detail })
}

fn compare(committed: &[Outcome], refit: &[Outcome]) -> Result<usize, String> {
    if committed.len() != refit.len() {
        return Err(format!("{} members committed, {} refitted", committed.len(), refit.len()));
    }
    let mut count = 0;
    for (was, is) in committed.iter().zip(refit) {
        let same_names = was.name == is.name && was.parameters.keys().eq(is.parameters.keys());
        if !same_names {
            return Err(format!("{}: the constants have other names", was.name));
        }
        for (name, old) in &was.parameters {
            let Some(new) = is.parameters.get(name) else { continue };
            count += 1;
            if old.f32.to_bits() != new.f32.to_bits() {
                let (old, new) = (old.f32, new.f32);
                return Err(format!("{}: `{name}` is {old} as committed, {new} now", was.name));
            }
            let scale = old.value.abs().max(new.value.abs());
            let near = (old.value - new.value).abs() <= VALUE_TOLERANCE * scale;
            if !near {
                let (old, new) = (old.value, new.value);
                return Err(format!("{}: `{name}` is {old:e} as committed, {new:e} now", was.name));
            }
        }
    }
    Ok(count)
}

/// The result file of a spec, relative to the project.
fn file(spec: &Spec) -> String {
    format!("fits/{}.json", spec.name)
}

/// Whether a fit that ended so gives the constants that its spec asks for: the optimum, or the
/// optimum under a bound. Every other ending says that there may be better ones.
pub fn stands(status: Status) -> bool {
    matches!(status, Status::Converged | Status::AtBound)
}

/// The committed result, or why it does not stand for the spec any more. `refit` is what the spec
/// gives today, where that is known: with it a change of the data or of the form is noticed too.
pub(super) fn committed(
    root: &Path,
    spec: &Spec,
    refit: Option<&FitResult>,
) -> Result<Result<FitResult, String>, FitError> {
    let path = root.join(file(spec));
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
