//! The one list of effects that everything iterates.

use crate::effect::simulator::Simulator;
use crate::effect::{Effect, Family, FormEntry, Reference};

/// The effect called `name`.
pub fn effect(name: &str) -> Option<&'static Effect> {
    EFFECTS.iter().copied().find(|effect| effect.name == name)
}

/// The form called `effect/form`, with its effect.
pub fn form(name: &str) -> Option<(&'static Effect, &'static FormEntry)> {
    EFFECTS
        .iter()
        .flat_map(|effect| effect.forms.iter().map(move |form| (*effect, form)))
        .find(|(_, form)| form.name == name)
}

/// The reference called `name`, with its effect.
pub fn reference(name: &str) -> Option<(&'static Effect, &'static Reference)> {
    EFFECTS
        .iter()
        .flat_map(|effect| effect.references.iter().map(move |reference| (*effect, reference)))
        .find(|(_, reference)| reference.name == name)
}

/// The family called `name`, with its effect.
pub fn family(name: &str) -> Option<(&'static Effect, &'static Family)> {
    EFFECTS
        .iter()
        .flat_map(|effect| effect.families.iter().map(move |family| (*effect, family)))
        .find(|(_, family)| family.name == name)
}

/// The simulator called `name`, with its effect.
pub fn simulator(name: &str) -> Option<(&'static Effect, &'static Simulator)> {
    EFFECTS
        .iter()
        .flat_map(|effect| effect.simulators.iter().map(move |simulator| (*effect, simulator)))
        .find(|(_, simulator)| simulator.name == name)
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
