//! Specs, fitted: those that take constants from others after them.

use std::path::PathBuf;

use rayon::prelude::*;

use super::RunError;
use crate::fit::{Context, FitResult, Spec, run_spec};

/// A spec and where its result goes.
#[derive(Debug, Clone)]
pub struct Job {
    /// The spec.
    pub spec: Spec,
    /// The result file; empty to write none.
    pub result: PathBuf,
}

/// Runs and writes every job, in parallel; results in the order of `jobs`. A job that cannot be run does
/// not keep the others from being written. `watch` is called with the name of a fit that begins and, when
/// it is written, with none.
pub fn fit(
    jobs: &[Job],
    context: &Context,
    watch: &(dyn Fn(Option<&str>) + Sync),
) -> Vec<Result<FitResult, RunError>> {
    let run = |job: &Job| -> Result<FitResult, RunError> {
        watch(Some(&job.spec.name));
        let result = run_spec(&job.spec, context)?;
        if !job.result.as_os_str().is_empty() {
            result.write(&job.result)?;
        }
        watch(None);
        Ok(result)
    };
    let mut results: Vec<Option<Result<FitResult, RunError>>> = jobs.iter().map(|_| None).collect();
    let mut failed: Vec<String> = Vec::new();
    for dependent in [false, true] {
        let stage = results.par_iter_mut().zip(jobs);
        stage.filter(|(_, job)| job.spec.constants.is_empty() != dependent).for_each(
            |(place, job)| {
                let source = job.spec.constants.iter().find(|name| failed.contains(name));
                *place = Some(match source {
                    None => run(job),
                    Some(source) => Err(RunError::Source {
                        fit: job.spec.name.clone(),
                        source_fit: source.clone(),
                    }),
                });
            },
        );
        let ran = results.iter().zip(jobs);
        failed = ran
            .filter(|(result, _)| matches!(result, Some(Err(_))))
            .map(|(_, job)| job.spec.name.clone())
            .collect();
    }
    results.into_iter().flatten().collect()
}
