//! How far the constants in a shipped file are from the fitted ones.

use std::collections::BTreeMap;
use std::path::Path;

use super::subject::{Instance, Subject};
use super::{Gate, Reached, ShippedConstants};
use crate::numeric::ulp::ulp_distance_f32;

/// The largest distance over all constants, in ulp of f32; or why it cannot be told.
pub(super) fn drift(gate: &Gate, root: &Path, subject: &Subject) -> Result<Reached, String> {
    let [Instance { candidate, .. }] = subject.instances.as_slice() else {
        return Err("a family ships no single set of constants; name a member".to_owned());
    };
    let file = gate.shipped.as_deref().unwrap_or(Path::new(""));
    let shown = file.display().to_string();
    let text = std::fs::read_to_string(root.join(file)).map_err(|e| format!("{shown}: {e}"))?;
    let shipped = ShippedConstants::read(&shown, &text);
    let names = candidate.form.parameters().iter().map(|parameter| parameter.name.as_str());
    let fitted = names.zip(candidate.constants_f32.iter().copied());
    distance(&shipped, fitted)
}

/// The same for constants given by name.
pub(super) fn distance<'a>(
    shipped: &ShippedConstants,
    fitted: impl Iterator<Item = (&'a str, f32)>,
) -> Result<Reached, String> {
    let mut farthest = Reached { value: 0.0, at: BTreeMap::new(), of: None, count: 0 };
    for (name, fitted) in fitted {
        let there = shipped.value(name).map_err(|error| error.to_string())?;
        let distance = f64::from(ulp_distance_f32(there, fitted));
        farthest.count += 1;
        if farthest.of.is_none() || distance > farthest.value {
            farthest.value = distance;
            farthest.of = Some(format!("{name} = {there} there, {fitted} fitted"));
        }
    }
    if farthest.count == 0 { Err("the fit has no constants".to_owned()) } else { Ok(farthest) }
}
