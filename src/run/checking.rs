//! Gates, judged in a run.

use std::path::Path;

use super::{Run, RunError};
use crate::fit::Spec;
use crate::gate::{self, Check, GateError, Sources};

impl Run {
    /// The verdicts on the project, by the gates in the file `gates` or its own.
    ///
    /// # Errors
    /// If gates, specs or results are unusable, as opposed to failing.
    pub fn check(&self, gates: Option<&Path>, prove: bool) -> Result<Check, RunError> {
        let Self { project, device, atlas, scenes, fits } = self;
        let gates = gate::read(gates.unwrap_or(&project.gates())).map_err(GateError::from)?;
        let specs = project.specs()?;
        let specs =
            specs.iter().map(|file| Spec::read(&file.path)).collect::<Result<Vec<_>, _>>()?;
        Ok(Check::of(Sources { project, atlas, scenes, fits }, &gates, &specs, device, prove)?)
    }
}
