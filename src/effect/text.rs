//! The text of an effect: what it says of itself, in `effect.toml` beside its code.
//!
//! The text has the prose of references, regions, hard cases, laws, claims, goals and settings; the
//! code has the functions behind them, under the same names and in the same order.

use serde::{Deserialize, Deserializer};

use super::claim::ClaimCheck;
use super::simulator::{Simulate, Simulator};
use super::{
    Candidates, Claim, ClaimError, DomainError, Effect, Evaluate, Family, FormText, Goal, Law,
    Reference, Region, Violation,
};
use crate::document::Section;
use crate::table::Table;

/// Makes the points of a region.
pub(crate) type Points = fn() -> Table;
/// A reference that returns one number.
pub(crate) type Scalar = fn(&[f64]) -> Result<f64, DomainError>;

/// What an effect computes, by the names in its text.
pub(crate) struct Functions<'a> {
    /// Texts of its forms.
    pub(crate) forms: fn() -> Vec<FormText>,
    /// Values of the references.
    pub(crate) references: &'a [(&'a str, Scalar)],
    /// Points that are judged, and those that are fitted, if there are any.
    pub(crate) regions: &'a [(&'a str, Points, Option<Points>)],
    /// Hard points.
    pub(crate) hard_cases: &'a [(&'a str, Points)],
    /// Violations of the laws.
    pub(crate) laws: &'a [(&'a str, Violation)],
    /// Checks of the claims.
    pub(crate) claims: &'a [(&'a str, ClaimCheck<Candidates>)],
    /// Simulators.
    pub(crate) simulators: &'a [(&'a str, Simulate)],
    /// Families of measured tables.
    pub(crate) families: &'static [Family],
    /// What it shows beyond its fits.
    pub(crate) exhibits: fn(&Candidates) -> Result<Vec<Section>, ClaimError>,
}

impl Functions<'_> {
    /// None, for `..Functions::NONE`.
    pub(crate) const NONE: Self = Self {
        forms: Vec::new,
        references: &[],
        regions: &[],
        hard_cases: &[],
        laws: &[],
        claims: &[],
        simulators: &[],
        families: &[],
        exhibits: |_| Ok(Vec::new()),
    };
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct EffectText {
    name: &'static str,
    title: &'static str,
    description: &'static str,
    #[serde(deserialize_with = "slice")]
    baselines: &'static [&'static str],
    reference: Vec<Reference>,
    region: Vec<Region>,
    hard_cases: Vec<Region>,
    law: Vec<Law>,
    #[serde(default, deserialize_with = "slice")]
    goal: &'static [Goal],
    claim: Vec<Claim<Candidates>>,
    #[serde(default)]
    simulator: Vec<Simulator>,
}

impl Effect {
    /// The effect that `text` describes and `functions` compute; lives as long as the program.
    ///
    /// # Panics
    /// If the text is not one, or has other names than the functions; built-in effects, of which
    /// tests are made, rule both out.
    pub(crate) fn of_text(text: &str, functions: Functions<'_>) -> Self {
        // What stands in one piece is borrowed from the text, so lines that go on are joined first.
        let joined: String = text.split("\\\n").map(str::trim_start).collect();
        let text: EffectText =
            toml::from_str(joined.leak()).unwrap_or_else(|error| panic!("effect.toml: {error}"));
        let regions: Vec<_> =
            functions.regions.iter().map(|(name, points, fit)| (*name, (*points, *fit))).collect();
        Self {
            name: text.name,
            title: text.title,
            description: text.description,
            references: told(
                text.reference,
                functions.references,
                |of| of.name,
                |of, value| of.evaluate = Evaluate::Scalar(value),
            ),
            forms: functions.forms,
            simulators: told(
                text.simulator,
                functions.simulators,
                |of| of.name,
                |of, run| of.run = run,
            ),
            families: functions.families,
            regions: told(
                text.region,
                &regions,
                |of| of.name,
                |of, points| (of.points, of.fitted) = points,
            ),
            hard_cases: told(
                text.hard_cases,
                functions.hard_cases,
                |of| of.name,
                |of, points| of.points = points,
            ),
            laws: told(
                text.law,
                functions.laws,
                |of| of.name,
                |of, violation| of.violation = violation,
            ),
            goals: text.goal,
            baselines: text.baselines,
            claims: told(text.claim, functions.claims, |of| of.name, |of, check| of.check = check),
            exhibits: functions.exhibits,
        }
    }

    /// The reference called `name`.
    ///
    /// # Panics
    /// If there is none.
    pub(crate) fn reference(&self, name: &str) -> &'static Reference {
        let found = self.references.iter().find(|reference| reference.name == name);
        found.unwrap_or_else(|| panic!("{} has no reference `{name}`", self.name))
    }
}

/// What the text tells of each, with its function.
fn told<T, F: Copy>(
    mut texts: Vec<T>,
    functions: &[(&str, F)],
    name: fn(&T) -> &str,
    set: fn(&mut T, F),
) -> &'static [T] {
    let in_code: Vec<&str> = functions.iter().map(|(name, _)| *name).collect();
    assert_eq!(texts.iter().map(name).collect::<Vec<_>>(), in_code, "names in text and code");
    texts.iter_mut().zip(functions).for_each(|(text, (_, function))| set(text, *function));
    texts.leak()
}

/// A list that lives as long as the program.
pub(super) fn slice<'de, D, T>(deserializer: D) -> Result<&'static [T], D::Error>
where
    D: Deserializer<'de>,
    T: Deserialize<'de>,
{
    Ok(Vec::deserialize(deserializer)?.leak())
}

/// Forms that violate a law for one reason.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct KnownViolations {
    forms: Vec<&'static str>,
    why: &'static str,
}

/// Known violations by form, from lists of forms that share a reason.
pub(super) fn known_violations<'de: 'static, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<&'static [(&'static str, &'static str)], D::Error> {
    let groups: Vec<KnownViolations> = Vec::deserialize(deserializer)?;
    let each = |of: KnownViolations| of.forms.into_iter().map(move |form| (form, of.why));
    Ok(groups.into_iter().flat_map(each).collect::<Vec<_>>().leak())
}
