//! Gates, judged in a run.

use std::path::Path;

use super::{Run, RunError};
use crate::fit::Spec;
use crate::gate::{self, Check, GateError, Sources};
use crate::project::SpecFile;

impl Run {
    /// The verdicts on the project, by the gates in the file `gates` or its own.
    ///
    /// # Errors
    /// If gates, specs or results are unusable, as opposed to failing.
    pub fn check(&self, gates: Option<&Path>, prove: bool) -> Result<Check, RunError> {
        let Self { project, device, atlas, scenes, fits, counter, .. } = self;
        let gates = gate::read(gates.unwrap_or(&project.gates())).map_err(GateError::from)?;
        let sources = Sources { project, atlas, scenes, fits, counter };
        Ok(Check::of(sources, &gates, &self.specs()?, device, prove)?)
    }

    /// The verdicts on the project by its own gates, for a report, which says so where nothing is held:
    /// without `fits/gates.toml` there is none, and specs are fitted again all the same.
    ///
    /// # Errors
    /// As [`Run::check`].
    pub fn check_if_gated(&self) -> Result<Check, RunError> {
        if self.project.gates().is_file() {
            return self.check(None, false);
        }
        let Self { project, device, atlas, scenes, fits, counter, .. } = self;
        let sources = Sources { project, atlas, scenes, fits, counter };
        Ok(Check::of(sources, &[], &self.specs()?, device, false)?)
    }

    fn specs(&self) -> Result<Vec<Spec>, RunError> {
        let read = |file: &SpecFile| Ok(Spec::read(&file.path)?);
        self.project.specs()?.iter().map(read).collect()
    }
}
