//! Gates on scenes: the picture that an approximation makes, against the reference.

use std::collections::BTreeMap;

use super::{Evidence, Gate, GateError, Metric, Precision, Reached};
use crate::gpu::Device;
use crate::render::light_form::LightForm;
use crate::render::surface::{Plan, PreparedSurface};
use crate::render::{AnyScene, Backend, JudgedScene, Metrics, RenderError, Resources, ShadedBy};

/// What the subject of a gate on a scene begins with.
pub const SCENES: &str = "scenes/";

/// A scene and one approximation of it.
#[derive(Debug)]
pub(super) enum SceneSubject<'e> {
    /// The lobe of a scratch.
    Lobe {
        /// The scene with its reference.
        scene: &'e JudgedScene,
        /// What shades it.
        by: ShadedBy,
    },
    /// A surface under an environment.
    Surface {
        /// The scene with its reference.
        scene: &'e PreparedSurface,
        /// What is summed.
        plan: Plan,
    },
}

/// A scene with its reference.
#[derive(Debug)]
enum Known {
    Lobe(Box<JudgedScene>),
    Surface(Box<PreparedSurface>),
}

/// What is moved of a picture without constants: all of its values.
const OUTPUT: &str = "output";

impl Gate {
    /// Scene and approximation, if the subject is `scenes/NAME#approximation`.
    pub(super) fn scene(&self) -> Option<(&str, &str)> {
        let rest = self.subject.strip_prefix(SCENES)?;
        Some(rest.split_once('#').unwrap_or((rest, "")))
    }
}

/// The scenes that gates have named, with their references.
#[derive(Debug, Default)]
pub(super) struct Scenes {
    known: BTreeMap<String, Known>,
}

impl Known {
    fn read(path: &std::path::Path, resources: Resources<'_>) -> Result<Self, RenderError> {
        Ok(match AnyScene::read(path)? {
            AnyScene::Lobe(_) => Self::Lobe(Box::new(JudgedScene::read(path, resources)?)),
            AnyScene::Surface(scene) => {
                Self::Surface(Box::new(PreparedSurface::new(*scene, resources, Backend::Lanes)?))
            }
        })
    }
}

impl Scenes {
    /// Scene and approximation of a gate, the reference rendered when the scene is first named.
    ///
    /// # Errors
    /// [`GateError`] if there is no such scene or approximation, or the scene is unusable.
    pub(super) fn subject(
        &mut self,
        gate: &Gate,
        root: &std::path::Path,
    ) -> Result<SceneSubject<'_>, GateError> {
        let (name, approximation) = gate.scene().unwrap_or_default();
        if !self.known.contains_key(name) {
            let path = root.join("data/scenes").join(format!("{name}.toml"));
            if name.contains("..") || !path.is_file() {
                return Err(gate.fault(format!("there is no scene data/scenes/{name}.toml")));
            }
            let (fits, data) = (root.join("fits"), root.join("data/measured"));
            let known = Known::read(&path, Resources { fits: &fits, data: &data })?;
            self.known.insert(name.to_owned(), known);
        }
        let unknown = |known: Vec<&str>| GateError::UnknownMember {
            gate: gate.index,
            line: gate.line,
            subject: gate.subject.clone(),
            known: known.join(", "),
        };
        match self.known.get(name).ok_or_else(|| gate.fault("no scene".to_owned()))? {
            Known::Lobe(scene) => {
                let all = scene.approximations();
                let by = all.iter().find(|by| by.name == approximation).cloned();
                let names = || all.iter().map(|by| by.name.as_str()).collect();
                Ok(SceneSubject::Lobe { scene, by: by.ok_or_else(|| unknown(names()))? })
            }
            Known::Surface(scene) => {
                let all = &scene.scene.approximations;
                let found = all.iter().find(|found| found.name == approximation);
                let names = || all.iter().map(|found| found.name.as_str()).collect();
                let method = found.ok_or_else(|| unknown(names()))?.method;
                Ok(SceneSubject::Surface { scene, plan: scene.plan(method)? })
            }
        }
    }
}

impl SceneSubject<'_> {
    /// Measures the picture; on lanes without a device.
    pub(super) fn reached(
        &self,
        gate: &Gate,
        device: Option<&Device>,
    ) -> Result<Reached, RenderError> {
        self.moved(gate, None, device)
    }

    /// Names of what can be moved: the constants of the forms, or all values.
    pub(super) fn constants(&self) -> Vec<String> {
        let Self::Lobe { by, .. } = self else { return vec![OUTPUT.to_owned()] };
        let mut names: Vec<String> = Vec::new();
        for form in [&by.sphere, &by.polygon].into_iter().flatten() {
            for parameter in form.form.parameters() {
                if !names.contains(&parameter.name) {
                    names.push(parameter.name.clone());
                }
            }
        }
        names
    }

    /// The same with `constant` moved by the relative step wherever it is.
    pub(super) fn perturbed(
        &self,
        gate: &Gate,
        constant: &str,
        step: f64,
        device: Option<&Device>,
    ) -> Result<Reached, RenderError> {
        self.moved(gate, Some((constant, step)), device)
    }

    fn moved(
        &self,
        gate: &Gate,
        change: Option<(&str, f64)>,
        device: Option<&Device>,
    ) -> Result<Reached, RenderError> {
        let backend = match (gate.precision, device) {
            (Precision::Device, Some(device)) => Backend::Device(device),
            _ => Backend::Lanes,
        };
        let (found, count) = match self {
            Self::Lobe { scene, by } => {
                let mut by = by.clone();
                if let Some((constant, step)) = change {
                    for form in [&mut by.sphere, &mut by.polygon].into_iter().flatten() {
                        move_constant(form, constant, step);
                    }
                }
                (scene.metrics(&by, backend)?, scene.values())
            }
            Self::Surface { scene, plan } => {
                let mut image = scene.picture(plan, backend)?;
                if let Some((_, step)) = change {
                    let values = image.channels.iter_mut().flat_map(|channel| &mut channel.values);
                    values.for_each(|value| *value *= (1.0 + step) as f32);
                }
                (scene.metrics(&image)?, 3 * image.width * image.height)
            }
        };
        let (value, at) = figure(gate.metric, &found);
        Ok(Reached { value, at, of: None, count })
    }
}

fn move_constant(form: &mut LightForm, constant: &str, step: f64) {
    let parameters = form.form.parameters().iter().zip(&mut form.constants);
    for (parameter, value) in parameters {
        if parameter.name == constant {
            let wide = f64::from(*value);
            *value = (if wide == 0.0 { step } else { wide * (1.0 + step) }) as f32;
        }
    }
}

/// The metric's value and its place; not a number for a metric that pictures do not have, which
/// the gate file refuses.
fn figure(metric: Metric, found: &Metrics) -> (f64, BTreeMap<String, f64>) {
    let place = || {
        let (x, y) = (found.at.x as f64, found.at.y as f64);
        BTreeMap::from([("x".to_owned(), x), ("y".to_owned(), y)])
    };
    match metric {
        Metric::RelL2 => (found.relative_rms, BTreeMap::new()),
        Metric::Rms => (found.rms, BTreeMap::new()),
        Metric::MaxAbs => (found.max, place()),
        Metric::Bias => (found.mean.abs(), BTreeMap::new()),
        Metric::Flip => (found.flip, BTreeMap::new()),
        Metric::P50 | Metric::P95 | Metric::P99 | Metric::MaxRel | Metric::Drift => {
            (f64::NAN, BTreeMap::new())
        }
    }
}

impl Evidence<'_> {
    /// The scene and the approximation that the gate names.
    pub(super) fn scene(&mut self, gate: &Gate) -> Result<SceneSubject<'_>, GateError> {
        let (project, scenes) = self.scenes();
        scenes.subject(gate, project.root())
    }
}
