//! `all`: fit, validate, report and check; what has not changed is not done again.

use clap::Args;
use serde::{Deserialize, Serialize};

use super::context::Context;
use super::{Ending, check, fit, report};
use crate::fit::Spec;
use crate::numeric::measured::Measured;
use crate::project::{Fingerprints, SpecFile};
use crate::run::Job;
use crate::table::store::atomic_write;

const MORE: &str = "\
A spec is fitted again if it, its data, this program or the committed result changed; the report is
written again if any result, the data, the gates, this program or the adapter did. --force does
everything. Exit code 1 if a gate fails, 3 if a fit did not converge.

Example:
  striae all";

/// The main job: fit, validate, report, check
#[derive(Debug, Args)]
#[command(after_help = MORE)]
pub(super) struct Arguments {
    /// Do everything again
    #[arg(long)]
    force: bool,
}

/// What an earlier run did, beside the report.
#[derive(Debug, Default, PartialEq, Serialize, Deserialize)]
struct State {
    /// Per spec: fingerprint of what it was made from and of the result.
    fits: std::collections::BTreeMap<String, String>,
    /// Fingerprint of what the report was made from and of the report.
    report: String,
    /// Verdicts, as printed.
    verdicts: String,
    passed: bool,
    converged: bool,
}

/// Runs the stages and prints what they did and the verdicts.
pub(super) fn run(arguments: &Arguments, context: &Context) -> anyhow::Result<Ending> {
    let project = context.project()?;
    let path = project.report().join("state.json");
    // A state that cannot be read is one that says nothing: everything is done again.
    let known = std::fs::read_to_string(&path).ok().filter(|_| !arguments.force);
    let mut state: State =
        known.and_then(|text| serde_json::from_str(&text).ok()).unwrap_or_default();
    let run = context.run()?;
    let adapter = match &run.device {
        Measured::Value(device) => device.description().to_string(),
        Measured::NotMeasured(reason) => reason.clone(),
    };
    let fingerprints = Fingerprints::new(project)?;

    let files = project.specs()?.into_iter();
    let sources = files.map(|file| Ok((Spec::read(&file.path)?, file)));
    let sources = sources.collect::<anyhow::Result<Vec<(Spec, SpecFile)>>>()?;
    let print = |(spec, file): &(Spec, SpecFile)| fingerprints.of_fit(file, spec, project);
    let changed = |of: &&(Spec, SpecFile)| state.fits.get(&of.1.name) != Some(&print(of));
    let (changed, same): (Vec<_>, Vec<_>) = sources.iter().partition(changed);
    // A fit whose source is fitted again is fitted again too.
    let stale = |name: &String| changed.iter().any(|(spec, _)| spec.name == *name);
    let dependent = same.into_iter().filter(|(spec, _)| spec.constants.iter().any(stale));
    let again = changed.iter().copied().chain(dependent);
    let jobs: Vec<Job> =
        again.map(|(spec, file)| Job { spec: spec.clone(), result: file.result() }).collect();
    let fitted = fit::fit(&jobs, &run.fits, context)?;
    context.output.note(&format!("fit: {} of {} specs", jobs.len(), sources.len()));
    state.fits = sources.iter().map(|of| (of.1.name.clone(), print(of))).collect();
    let unchanged = jobs.is_empty()
        && state.report == fingerprints.of_report(&adapter, &state.fits, project)?;
    if unchanged {
        context.output.note("report: unchanged");
    } else {
        state.converged = fit::ending(&fitted) == Ending::Done
            && (state.converged || jobs.len() == sources.len());
        let check = run.check(None, false)?;
        let written = report::write(&project.report(), &run, &check, context)?;
        let folder = project.shown(&project.report());
        context.output.note(&format!("report: {} files in {folder}", written.files.len()));
        state.verdicts = check::text(&check);
        state.passed = check.passed();
        state.report = fingerprints.of_report(&adapter, &state.fits, project)?;
        atomic_write(&path, format!("{}\n", serde_json::to_string_pretty(&state)?).as_bytes())?;
    }
    let verdicts = &state.verdicts;
    let summary = serde_json::json!({
        "fitted": jobs.iter().map(|job| job.spec.name.as_str()).collect::<Vec<_>>(),
        "report_written": !unchanged,
        "converged": state.converged,
        "passed": state.passed,
        "adapter": adapter,
    });
    context.output.result(&summary, || verdicts.clone())?;
    Ok(match (state.passed, state.converged) {
        (false, _) => Ending::GateFailed,
        (true, false) => Ending::NotConverged,
        (true, true) => Ending::Done,
    })
}
