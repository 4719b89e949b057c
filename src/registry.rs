//! The list of effects that everything iterates, as a value to which a caller adds.

use std::sync::LazyLock;

use crate::effect::simulator::Simulator;
use crate::effect::{Effect, Family, FormEntry, Reference};

/// Effects, and what they register, by name.
#[derive(Debug, Clone)]
pub struct Registry {
    effects: Vec<&'static Effect>,
}

static BUILTIN: LazyLock<Registry> = LazyLock::new(|| Registry { effects: EFFECTS.to_vec() });

impl Registry {
    /// The effects of striae.
    pub fn builtin() -> &'static Self {
        &BUILTIN
    }

    /// Every effect, in the order of registration.
    pub fn effects(&self) -> &[&'static Effect] {
        &self.effects
    }

    /// The effect called `name`.
    pub fn effect(&self, name: &str) -> Option<&'static Effect> {
        self.effects.iter().copied().find(|effect| effect.name == name)
    }

    /// The forms of an effect.
    pub fn forms_of<'a>(&'a self, effect: &Effect) -> impl Iterator<Item = &'a FormEntry> {
        self.effect(effect.name).into_iter().flat_map(|effect| effect.forms)
    }

    /// Every form.
    pub fn forms(&self) -> impl Iterator<Item = &FormEntry> {
        self.effects.iter().flat_map(|effect| effect.forms)
    }

    /// The form called `effect/form`.
    pub fn form(&self, name: &str) -> Option<&FormEntry> {
        self.forms().find(|form| form.name == name)
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
        self.effects
            .iter()
            .flat_map(|effect| effect.references.iter().map(move |found| (*effect, found)))
            .find(|(_, reference)| reference.name == name)
    }

    /// The family called `name`, with its effect.
    pub fn family(&self, name: &str) -> Option<(&'static Effect, &'static Family)> {
        self.effects
            .iter()
            .flat_map(|effect| effect.families.iter().map(move |family| (*effect, family)))
            .find(|(_, family)| family.name == name)
    }

    /// The simulator called `name`, with its effect.
    pub fn simulator(&self, name: &str) -> Option<(&'static Effect, &'static Simulator)> {
        self.effects
            .iter()
            .flat_map(|effect| effect.simulators.iter().map(move |found| (*effect, found)))
            .find(|(_, simulator)| simulator.name == name)
    }
}

/// Every effect. To add one: its folder, and a line here.
pub const EFFECTS: &[&Effect] = &[
    &crate::effects::sine_integral::EFFECT,
    &crate::effects::fresnel::EFFECT,
    &crate::effects::scratch_response::EFFECT,
    &crate::effects::footprint::EFFECT,
    &crate::effects::area_light::EFFECT,
    &crate::effects::diffraction::EFFECT,
];
