//! Which forms shade which lights.

use crate::effect::Candidate;
use crate::form::ScalarType;
use crate::render::RenderError;

/// A kind of light, by what its forms take.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum LightKind {
    /// `(kw, ks, view, centre, radius)`.
    Sphere,
    /// `(kw, ks, view, a, b, c)`: a triangle of the polygon.
    Polygon,
}

impl LightKind {
    /// As scenes say it.
    pub(super) fn word(self) -> &'static str {
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

    /// That the form of `candidate` takes a light of this kind.
    ///
    /// # Errors
    /// [`RenderError::Unusable`] with the arguments expected and got.
    pub(super) fn suits(self, candidate: &Candidate) -> Result<(), RenderError> {
        let (got, expected) = (candidate.form.arguments(), self.arguments());
        let components = |of: &[(&str, usize)]| of.iter().map(|(_, n)| *n).collect::<Vec<_>>();
        let listed = |of: &[(&str, usize)]| {
            of.iter().map(|(name, n)| format!("{name}: {n}")).collect::<Vec<_>>().join(", ")
        };
        let taken: Vec<(&str, usize)> =
            got.iter().map(|a| (a.name.as_str(), a.components)).collect();
        let fits = components(&taken) == components(expected)
            && got.iter().all(|a| a.scalar == ScalarType::F32)
            && candidate.form.result_components() == 1;
        if fits {
            return Ok(());
        }
        let (taken, expected) = (listed(&taken), listed(expected));
        Err(self.unsuited(
            &candidate.name,
            &format!("its function takes ({taken}), expected ({expected}) and one value returned"),
        ))
    }

    /// That the candidate called `name` shades no light of this kind, and why.
    pub(super) fn unsuited(self, name: &str, why: &str) -> RenderError {
        RenderError::Unusable(format!("{name}: cannot shade a {}: {why}", self.word()))
    }
}
