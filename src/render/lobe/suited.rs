//! Which forms shade which lights.

use crate::effect::Candidate;
use crate::form::ScalarType;
use crate::render::RenderError;

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

    /// That the form of `candidate` takes a light of this kind.
    ///
    /// # Errors
    /// [`RenderError::Unsuited`] with the arguments expected and got.
    pub fn suits(self, candidate: &Candidate) -> Result<(), RenderError> {
        let (got, expected) = (candidate.form.arguments(), self.arguments());
        let fits = got.len() == expected.len()
            && got.iter().all(|a| a.scalar == ScalarType::F32)
            && got.iter().zip(expected).all(|(a, (_, components))| a.components == *components)
            && candidate.form.result_components() == 1;
        if fits {
            return Ok(());
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
        Err(RenderError::Unsuited { name: candidate.name.clone(), kind: self.word(), what })
    }
}
