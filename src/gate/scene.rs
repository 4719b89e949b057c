//! Gates on scenes: the picture that an approximation makes, against the reference.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::{Evidence, Gate, GateError, Metric, Precision, Reached};
use crate::gpu::Device;
use crate::render::shading::Moved;
use crate::render::{Backend, Metrics, PreparedScene, RenderError};

/// What the subject of a gate on a scene begins with.
pub const SCENES: &str = "scenes/";

/// What is moved of a picture without constants: all of its values.
const OUTPUT: &str = "output";

/// A scene with its reference, and the place of one approximation of it.
#[derive(Debug)]
pub(super) struct Pictured {
    scene: Arc<PreparedScene>,
    at: usize,
}

impl Gate {
    /// Scene and approximation, if the subject is `scenes/NAME#approximation`.
    pub(super) fn scene(&self) -> Option<(&str, &str)> {
        let rest = self.subject.strip_prefix(SCENES)?;
        Some(rest.split_once('#').unwrap_or((rest, "")))
    }
}

impl Evidence<'_> {
    /// The scene and the approximation that the gate names.
    ///
    /// # Errors
    /// [`GateError`] if there is no such scene or approximation, or the scene is unusable.
    pub(super) fn scene(&self, gate: &Gate) -> Result<Pictured, GateError> {
        let (name, approximation) = gate.scene().unwrap_or_default();
        let path = self.of.project.scene_folder().join(format!("{name}.toml"));
        if name.contains("..") || !path.is_file() {
            return Err(gate.fault(format!("there is no scene data/scenes/{name}.toml")));
        }
        let scene = self.of.scenes.prepared(&path, self.of.project)?;
        let names: Vec<&str> =
            scene.scene.approximations.iter().map(|of| of.name.as_str()).collect();
        let at = names.iter().position(|name| *name == approximation);
        let at = at.ok_or_else(|| gate.no_member(&names.join(", ")))?;
        Ok(Pictured { at, scene })
    }
}

impl Pictured {
    /// Measures the picture, with a constant moved wherever it is if one is `moved`; on lanes without
    /// a device.
    pub(super) fn reached(
        &self,
        gate: &Gate,
        moved: Option<Moved<'_>>,
        device: Option<&Device>,
    ) -> Result<Reached, RenderError> {
        let backend = match (gate.precision, device) {
            (Precision::Device, Some(device)) => Backend::Device(device),
            _ => Backend::Lanes,
        };
        let picture = match moved {
            None => self.scene.picture(self.at, backend, &mut |_| ())?,
            Some(moved) => Arc::new(self.scene.moved(self.at, moved, backend)?),
        };
        Ok(self.figure(gate.metric, &picture.metrics))
    }

    /// Names of what can be moved: the constants of the forms, or all values.
    pub(super) fn constants(&self) -> Vec<String> {
        let constants = self.scene.constants(self.at);
        if constants.is_empty() { vec![OUTPUT.to_owned()] } else { constants }
    }

    /// The metric's value and its place; not a number for a metric that pictures do not have, which
    /// the gate file refuses.
    fn figure(&self, metric: Metric, found: &Metrics) -> Reached {
        let (x, y) = (found.at.0 as f64, found.at.1 as f64);
        let place = BTreeMap::from([("x".to_owned(), x), ("y".to_owned(), y)]);
        let nowhere = BTreeMap::new();
        let (value, at) = match metric {
            Metric::RelL2 => (found.relative_rms, nowhere),
            Metric::Rms => (found.rms, nowhere),
            Metric::MaxAbs => (found.max, place),
            Metric::Bias => (found.mean.abs(), nowhere),
            Metric::Flip => (found.flip, nowhere),
            _ => (f64::NAN, nowhere),
        };
        Reached { value, at, of: None, count: self.scene.values() }
    }
}
