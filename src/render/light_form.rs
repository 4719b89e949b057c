//! The form that shades one kind of light, with the constants that ship.

use std::path::{Component, Path};

use crate::form::{Form, ScalarType};
use crate::project::Project;
use crate::registry::Registry;

use super::error::RenderError;

/// A kind of light, by what its forms take.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LightKind {
    /// `(kw, ks, view, centre, radius)`.
    Sphere,
    /// `(kw, ks, view, a, b, c)`: a triangle of the polygon.
    Polygon,
}

impl LightKind {
    /// As scenes say it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Sphere => "sphere",
            Self::Polygon => "polygon",
        }
    }

    /// Names and components of the arguments.
    fn arguments(self) -> &'static [(&'static str, usize)] {
        match self {
            Self::Sphere => &[("kw", 1), ("ks", 1), ("view", 2), ("centre", 3), ("radius", 1)],
            Self::Polygon => &[("kw", 1), ("ks", 1), ("view", 2), ("a", 3), ("b", 3), ("c", 3)],
        }
    }
}

/// A form with its constants.
#[derive(Debug, Clone)]
pub struct LightForm {
    /// The fit, `form:effect/name` or `FILE.wgsl#function`.
    pub name: String,
    /// The form.
    pub form: Form,
    /// One value per parameter of the form.
    pub constants: Vec<f32>,
}

impl LightForm {
    /// The form of the fit `effect/name` with its f32 constants; of `form:effect/name`, registered,
    /// or of `FILE.wgsl#function`, relative to the project, with those of their text. `fits` is the
    /// folder of the results, in the project.
    ///
    /// # Errors
    /// [`RenderError::Unsuited`] if there is no such fit, form or file, or it does not take a light
    /// of this kind; [`RenderError::Form`] if it does not load.
    pub fn load(name: &str, kind: LightKind, fits: &Path) -> Result<Self, RenderError> {
        if !is_in_project(name) {
            return Err(unsuited(name, kind, "expected a name inside the project".into()));
        }
        let root = fits.parent().unwrap_or(Path::new("."));
        let found = Project::at(root, Registry::builtin())
            .candidate(name)
            .map_err(|error| unsuited(name, kind, error.to_string()))?;
        let (form, constants) = (found.form, found.constants_f32);
        Self { name: name.to_owned(), form, constants }.suited(kind)
    }

    /// The same, if the form takes a light of this kind.
    ///
    /// # Errors
    /// [`RenderError::Unsuited`] with the arguments expected and got.
    pub fn suited(self, kind: LightKind) -> Result<Self, RenderError> {
        let got = self.form.arguments();
        let expected = kind.arguments();
        let fits = got.len() == expected.len()
            && got.iter().all(|a| a.scalar == ScalarType::F32)
            && got.iter().zip(expected).all(|(a, (_, components))| a.components == *components)
            && self.form.result_components() == 1;
        if fits {
            return Ok(self);
        }
        let listed = |arguments: &mut dyn Iterator<Item = (&str, usize)>| {
            let list: Vec<String> =
                arguments.map(|(name, components)| format!("{name}: {components}")).collect();
            list.join(", ")
        };
        let what = format!(
            "its function takes ({}), expected ({}) and one value returned",
            listed(&mut got.iter().map(|a| (a.name.as_str(), a.components))),
            listed(&mut expected.iter().copied())
        );
        Err(RenderError::Unsuited { name: self.name, kind: kind.word(), what })
    }
}

/// Whether a fit or a file is named by its place in the project: no `..`, no absolute path.
pub(super) fn is_in_project(name: &str) -> bool {
    let plain = |part| matches!(part, Component::Normal(_) | Component::CurDir);
    !name.contains('\\') && Path::new(name).components().all(plain)
}

fn unsuited(name: &str, kind: LightKind, what: String) -> RenderError {
    RenderError::Unsuited { name: name.to_owned(), kind: kind.word(), what }
}
