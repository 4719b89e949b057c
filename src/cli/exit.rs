//! How a run ends: the one place that maps outcomes and errors to exit codes.

use std::process::ExitCode;

use crate::gpu::NoDevice;

/// How a run ended, as its exit code says.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u8)]
pub enum Ending {
    /// 0: done, and nothing found wanting.
    Done = 0,
    /// 1: a gate failed.
    GateFailed = 1,
    /// 2: bad usage or bad input.
    BadInput = 2,
    /// 3: a fit did not converge.
    NotConverged = 3,
    /// 4: a GPU was required and none was found.
    NoGpu = 4,
}

impl From<Ending> for ExitCode {
    fn from(ending: Ending) -> Self {
        Self::from(ending as u8)
    }
}

/// Prints `error` with its causes on stderr and returns how the run ends.
pub(super) fn report(error: &anyhow::Error, json: bool) -> Ending {
    let no_gpu = error.chain().any(|cause| cause.is::<NoDevice>());
    let ending = if no_gpu { Ending::NoGpu } else { Ending::BadInput };
    let causes = causes(error);
    if json {
        let text = serde_json::json!({ "error": causes, "exit": ending as u8 });
        super::output::to_stderr(&text.to_string());
    } else {
        let causes: Vec<&str> = causes.iter().map(|cause| cause.trim_end()).collect();
        super::output::to_stderr(&format!("error: {}", causes.join("\n  caused by: ")));
    }
    ending
}

/// The chain of messages, without those that their predecessor already quotes.
fn causes(error: &anyhow::Error) -> Vec<String> {
    let mut messages: Vec<String> = Vec::new();
    for cause in error.chain() {
        let message = cause.to_string();
        if !messages.last().is_some_and(|previous| previous.contains(&message)) {
            messages.push(message);
        }
    }
    messages
}
