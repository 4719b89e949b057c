//! What is registered: effects, and the forms that their texts and those of a project define.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::LazyLock;

use crate::effect::simulator::Simulator;
use crate::effect::{Effect, Family, FormEntry, FormLibrary, FormTextError, Reference};

/// The built-in effects. To add one: its folder, and a line here.
pub static EFFECTS: [&LazyLock<Effect>; 6] = [
    &crate::effects::sine_integral::EFFECT,
    &crate::effects::fresnel::EFFECT,
    &crate::effects::scratch_response::EFFECT,
    &crate::effects::footprint::EFFECT,
    &crate::effects::area_light::EFFECT,
    &crate::effects::diffraction::EFFECT,
];

/// Effects and registered forms, found by name.
#[derive(Debug, Clone)]
pub struct Registry {
    effects: Vec<&'static Effect>,
    forms: FormLibrary,
}

/// Why something could not be registered.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum RegistryError {
    /// Two effects or two references have one name.
    #[error("the {kind} `{name}` is registered already")]
    Taken {
        /// `effect` or `reference`.
        kind: &'static str,
        /// The name.
        name: &'static str,
    },
    /// A text of a form is at fault.
    #[error(transparent)]
    Text(#[from] FormTextError),
}

impl Registry {
    /// The built-in effects.
    ///
    /// # Panics
    /// If one of their texts is at fault, which a test rules out.
    pub fn builtin() -> &'static Self {
        static BUILTIN: LazyLock<Registry> = LazyLock::new(|| {
            let effects = EFFECTS.iter().map(|effect| &***effect).collect();
            Registry::new(effects).unwrap_or_else(|error| panic!("built in: {error}"))
        });
        &BUILTIN
    }

    /// `effects` and their forms, which may use each other's texts.
    ///
    /// # Errors
    /// [`RegistryError`] if a name is there twice or a text is at fault.
    pub fn new(effects: Vec<&'static Effect>) -> Result<Self, RegistryError> {
        distinct_names(&effects)?;
        let forms = FormLibrary::new(&effects)?;
        Ok(Self { effects, forms })
    }

    /// With one effect more, whose forms may use the texts that are registered.
    ///
    /// # Errors
    /// As [`Registry::new`].
    pub fn with_effect(mut self, effect: &'static Effect) -> Result<Self, RegistryError> {
        self.effects.push(effect);
        distinct_names(&self.effects)?;
        self.forms = self.forms.with_last(&self.effects)?;
        Ok(self)
    }

    /// With the forms of a folder on disk, as [`FormLibrary::with_folder`] names them.
    ///
    /// # Errors
    /// [`RegistryError::Text`] if the folder cannot be read or a text is at fault.
    pub fn with_forms_of(mut self, folder: &Path) -> Result<Self, RegistryError> {
        self.forms = self.forms.with_folder(&self.effects, folder)?;
        Ok(self)
    }

    /// Every effect.
    pub fn effects(&self) -> &[&'static Effect] {
        &self.effects
    }

    /// Every form: effect by effect, those of no effect last.
    pub fn forms(&self) -> impl Iterator<Item = &FormEntry> {
        self.forms.iter()
    }

    /// The forms of `effect`, in order.
    pub fn forms_of<'r>(
        &'r self,
        effect: &Effect,
    ) -> impl Iterator<Item = &'r FormEntry> + use<'r> {
        self.forms.of(effect.name)
    }

    /// The effect called `name`.
    pub fn effect(&self, name: &str) -> Option<&'static Effect> {
        self.effects.iter().copied().find(|effect| effect.name == name)
    }

    /// The form called `effect/form`.
    pub fn form(&self, name: &str) -> Option<&FormEntry> {
        self.forms.get(name)
    }

    /// Every reference.
    pub fn references(&self) -> impl Iterator<Item = &'static Reference> {
        self.effects.iter().flat_map(|effect| effect.references)
    }

    /// Every family.
    pub fn families(&self) -> impl Iterator<Item = &'static Family> {
        self.effects.iter().flat_map(|effect| effect.families)
    }

    /// Every simulator.
    pub fn simulators(&self) -> impl Iterator<Item = &'static Simulator> {
        self.effects.iter().flat_map(|effect| effect.simulators)
    }

    /// The reference called `name`, with its effect.
    pub fn reference(&self, name: &str) -> Option<(&'static Effect, &'static Reference)> {
        self.find(|effect| effect.references, |reference| reference.name == name)
    }

    /// The family called `name`, with its effect.
    pub fn family(&self, name: &str) -> Option<(&'static Effect, &'static Family)> {
        self.find(|effect| effect.families, |family| family.name == name)
    }

    /// The simulator called `name`, with its effect.
    pub fn simulator(&self, name: &str) -> Option<(&'static Effect, &'static Simulator)> {
        self.find(|effect| effect.simulators, |simulator| simulator.name == name)
    }

    fn find<T>(
        &self,
        list: fn(&'static Effect) -> &'static [T],
        is_it: impl Fn(&T) -> bool,
    ) -> Option<(&'static Effect, &'static T)> {
        let each =
            self.effects.iter().flat_map(|&effect| list(effect).iter().map(move |t| (effect, t)));
        each.into_iter().find(|(_, item)| is_it(item))
    }
}

fn distinct_names(effects: &[&'static Effect]) -> Result<(), RegistryError> {
    let names = effects.iter().map(|effect| ("effect", effect.name));
    let references = effects.iter().flat_map(|effect| effect.references);
    let mut seen = BTreeSet::new();
    match names.chain(references.map(|r| ("reference", r.name))).find(|item| !seen.insert(*item)) {
        Some((kind, name)) => Err(RegistryError::Taken { kind, name }),
        None => Ok(()),
    }
}
