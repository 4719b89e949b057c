//! Simulators: what makes a table from the physics of an effect, with settings as text.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::document;
use crate::measured::spectra::Spectra;
use crate::table::Grid;

/// A setting of a simulator.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Setting {
    /// Name, as in `--set name=value`.
    pub name: &'static str,
    /// Unit of a number, `1` for a pure one; empty for a word or a file.
    #[serde(default)]
    pub unit: &'static str,
    /// Value where it is not set; empty for none.
    #[serde(default)]
    pub default: &'static str,
    /// What it is, and its domain.
    pub description: &'static str,
}

/// Makes a table from settings.
pub type Simulate = fn(&Settings, &Spectra) -> Result<Simulation, SimulationError>;

/// Makes a table of one effect.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Simulator {
    /// Name, as in `striae simulate NAME`.
    pub name: &'static str,
    /// One line.
    pub description: &'static str,
    /// What may be set.
    #[serde(deserialize_with = "super::text::slice")]
    pub parameters: &'static [Setting],
    /// Makes the table.
    #[serde(skip, default = "nothing")]
    pub run: Simulate,
}

/// Of a simulator whose text alone is known.
fn nothing() -> Simulate {
    |_, _| Err(SimulationError("nothing is simulated".into()))
}

/// A simulated table, and what was measured on it.
#[derive(Debug, Clone, PartialEq)]
pub struct Simulation {
    /// The table.
    pub grid: Grid,
    /// What is said of it, one line each.
    pub notes: Vec<String>,
    /// Numbers: orders, energies, what each step changes.
    pub tables: Vec<document::PrintedTable>,
}

/// Why a simulation could not be made.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct SimulationError(pub String);

/// Settings of a simulator: what was given, and the defaults of what was not.
#[derive(Debug, Clone)]
pub struct Settings {
    parameters: &'static [Setting],
    given: BTreeMap<&'static str, String>,
}

/// Why a setting is not accepted.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("setting `{setting}`{fault}")]
pub struct SettingsError {
    /// Its name, or the text that has none.
    pub setting: String,
    /// What is wrong with it, in words that follow its name.
    pub fault: String,
}

impl SettingsError {
    /// `fault` follows the name of `setting`.
    pub fn new(setting: &str, fault: impl Into<String>) -> Self {
        Self { setting: setting.to_owned(), fault: fault.into() }
    }
}

impl Settings {
    /// All defaults.
    pub fn new(parameters: &'static [Setting]) -> Self {
        Self { parameters, given: BTreeMap::new() }
    }

    /// Reads `key=value` texts.
    ///
    /// # Errors
    /// [`SettingsError`] for a text without `=`, an unknown key (listing the known ones) and a key
    /// given twice.
    pub fn parse<S: AsRef<str>>(
        parameters: &'static [Setting],
        assignments: &[S],
    ) -> Result<Self, SettingsError> {
        let mut settings = Self::new(parameters);
        for text in assignments {
            let text = text.as_ref();
            let (key, value) = text
                .split_once('=')
                .map(|(key, value)| (key.trim(), value.trim()))
                .filter(|(key, _)| !key.is_empty())
                .ok_or_else(|| SettingsError::new(text, ": expected key=value"))?;
            let name = settings.known(key)?.name;
            if settings.given.insert(name, value.to_owned()).is_some() {
                return Err(SettingsError::new(key, " is given twice"));
            }
        }
        Ok(settings)
    }

    fn known(&self, key: &str) -> Result<&'static Setting, SettingsError> {
        self.parameters.iter().find(|p| p.name == key).ok_or_else(|| {
            let known: Vec<&str> = self.parameters.iter().map(|p| p.name).collect();
            SettingsError::new(key, format!(" is not known; known: {}", known.join(", ")))
        })
    }

    /// The value of `key` as text, if it was given.
    pub fn given(&self, key: &str) -> Option<&str> {
        self.given.get(key).map(String::as_str)
    }

    /// The value of `key` as text, the default where it was not given.
    ///
    /// # Errors
    /// [`SettingsError`] for a name that is not known.
    pub fn text(&self, key: &str) -> Result<&str, SettingsError> {
        let parameter = self.known(key)?;
        Ok(self.given.get(key).map_or(parameter.default, String::as_str))
    }

    /// The value of `key`, a finite number in [`lowest`, `highest`].
    ///
    /// # Errors
    /// [`SettingsError`] with the range and the unit.
    pub fn number(&self, key: &str, lowest: f64, highest: f64) -> Result<f64, SettingsError> {
        let text = self.text(key)?;
        let number = text.parse::<f64>().ok().filter(|v| (lowest..=highest).contains(v));
        number.ok_or_else(|| self.refused(key, &format!("a number from {lowest} to {highest}")))
    }

    /// The value of `key`, a whole number in [`lowest`, `highest`].
    ///
    /// # Errors
    /// [`SettingsError`] with the range and the unit.
    pub fn count(&self, key: &str, lowest: usize, highest: usize) -> Result<usize, SettingsError> {
        let text = self.text(key)?;
        let number = text.parse::<usize>().ok().filter(|v| (lowest..=highest).contains(v));
        number
            .ok_or_else(|| self.refused(key, &format!("a whole number from {lowest} to {highest}")))
    }

    /// The choice that the value of `key` names.
    ///
    /// # Errors
    /// [`SettingsError`] listing the names.
    pub fn choice<T: Copy>(&self, key: &str, choices: &[(&str, T)]) -> Result<T, SettingsError> {
        let text = self.text(key)?;
        let found = choices.iter().find(|(name, _)| *name == text).map(|(_, choice)| *choice);
        found.ok_or_else(|| {
            let names: Vec<&str> = choices.iter().map(|(name, _)| *name).collect();
            self.refused(key, &format!("one of {}", names.join(", ")))
        })
    }

    /// The error for a value of `key` that is not `expected`.
    pub fn refused(&self, key: &str, expected: &str) -> SettingsError {
        let unit = self.parameters.iter().find(|p| p.name == key).map_or("", |p| p.unit);
        let unit = if unit.is_empty() { String::new() } else { format!(" [{unit}]") };
        let got = self.text(key).unwrap_or_default();
        SettingsError::new(key, format!(": expected {expected}{unit}, got `{got}`"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PARAMETERS: &[Setting] = &[
        Setting { name: "size", unit: "1", default: "3", description: "" },
        Setting { name: "window", unit: "", default: "hann", description: "" },
    ];

    #[test]
    fn settings_are_read_and_defaults_stand_in() {
        let settings = Settings::parse(PARAMETERS, &[" size = 5"]).expect("settings");
        assert_eq!(settings.count("size", 1, 9), Ok(5));
        assert_eq!(settings.text("window"), Ok("hann"));
        assert!(settings.given("size").is_some() && settings.given("window").is_none());
        assert_eq!(Settings::new(PARAMETERS).number("size", 0.0, 9.0), Ok(3.0));
    }

    #[test]
    fn refusals_name_the_key_and_what_is_known() {
        let refused =
            |texts: &[&str]| Settings::parse(PARAMETERS, texts).expect_err("a refusal").to_string();
        assert!(refused(&["size"]).contains("key=value"));
        assert!(refused(&["=1"]).contains("key=value"));
        assert!(refused(&["sise=1"]).contains("known: size, window"));
        assert!(refused(&["size=1", "size=2"]).contains("twice"));
        for text in ["size=x", "size=nan", "size=10", "size=-1", "size=1.5"] {
            let settings = Settings::parse(PARAMETERS, &[text]).expect("settings");
            let error = settings.count("size", 1, 9).expect_err("a refusal").to_string();
            assert!(error.contains("whole number from 1 to 9 [1]"), "{error}");
        }
        let settings = Settings::parse(PARAMETERS, &["window=box"]).expect("settings");
        let error = settings.choice("window", &[("hann", 1)]).expect_err("a refusal").to_string();
        assert!(error.contains("one of hann, got `box`"), "{error}");
    }
}
