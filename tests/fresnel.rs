//! The Fresnel references against the mpmath oracle (`tests/oracles/fresnel.py`), the measured
//! materials, and the forms where their values are known.

use std::collections::BTreeMap;
use std::path::Path;

use striae::effect::Member;
use striae::effects::fresnel::EFFECT;
use striae::effects::fresnel::materials::FAMILY;
use striae::effects::fresnel::reference::{conductor, dielectric};
use striae::form::Form;
use striae::registry::Registry;

/// Stated accuracy of the references; the largest error on the oracle's points is 1.8e-15.
const RELATIVE_ERROR: f64 = 1e-13;

struct Point {
    mu: f64,
    n: f64,
    k: f64,
    s: f64,
    p: f64,
    mean: f64,
}

fn oracle() -> Vec<Point> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/oracles/fresnel.csv");
    let mut reader = csv::Reader::from_path(path).expect("the oracle is committed");
    reader
        .deserialize::<[f64; 6]>()
        .map(|row| row.expect("six numbers"))
        .map(|[mu, n, k, s, p, mean]| Point { mu, n, k, s, p, mean })
        .collect()
}

fn relative_error(got: f64, exact: f64) -> f64 {
    if got == exact { 0.0 } else { ((got - exact) / exact).abs() }
}

#[test]
fn conductor_agrees_with_the_oracle() {
    let points = oracle();
    assert!(points.len() > 800, "{} points", points.len());
    let mut worst = (0.0, String::new());
    for Point { mu, n, k, s, p, mean } in points {
        let got = conductor(mu, n, k).expect("inside the domain");
        for (part, value, exact) in [("s", got.s, s), ("p", got.p, p), ("mean", got.mean(), mean)] {
            let error = relative_error(value, exact);
            assert!((0.0..=1.0).contains(&value), "{part} at {mu:e}, {n:e}, {k:e}: {value}");
            if error > worst.0 || error.is_nan() {
                worst = (error, format!("{part} at mu = {mu:e}, n = {n:e}, k = {k:e}"));
            }
        }
    }
    println!("largest relative error {:.2e}: {}", worst.0, worst.1);
    assert!(worst.0 <= RELATIVE_ERROR, "{:e}: {}", worst.0, worst.1);
}

#[test]
fn dielectric_agrees_with_the_oracle() {
    let mut checked = 0;
    for Point { mu, n, s, p, mean, .. } in oracle().into_iter().filter(|point| point.k == 0.0) {
        let got = dielectric(mu, n).expect("inside the domain");
        for (value, exact) in [(got.s, s), (got.p, p), (got.mean(), mean)] {
            let error = relative_error(value, exact);
            assert!(error <= RELATIVE_ERROR, "mu = {mu:e}, eta = {n:e}: {value:e}, not {exact:e}");
        }
        checked += 1;
    }
    assert!(checked > 200, "{checked} points");
}

/// The members of `fresnel_materials` from the committed data.
fn members(held_out: bool) -> Vec<Member> {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/measured");
    (FAMILY.members)(&data, held_out).expect("the committed data make the family")
}

fn values<'t>(member: &'t Member, column: &str) -> &'t [f64] {
    &member.table.column(column).expect("a column of every member").values
}

#[test]
fn the_family_covers_every_record_in_every_band() {
    let fitted = members(false);
    let mut bands: BTreeMap<(&str, &str), usize> = BTreeMap::new();
    for member in &fitted {
        *bands.entry((&member.group, &member.source)).or_default() += 1;
    }
    for ((material, source), count) in bands {
        // PMMA is measured from 405 nm: neither 400 nm nor the channels.
        let expected = if material == "PMMA" { 6 } else { 10 };
        assert_eq!(count, expected, "{material}.{source}");
    }
    for material in ["Au", "Ag", "Cu", "Al", "Fe", "Cr", "Ti", "Ni", "W", "Si", "SiO2"] {
        assert!(fitted.iter().any(|member| member.group == material), "{material} is missing");
    }
    let mut labels: Vec<&str> = fitted.iter().map(|member| member.label.as_str()).collect();
    labels.sort_unstable();
    labels.dedup();
    assert_eq!(labels.len(), fitted.len(), "labels are unique");
}

#[test]
fn held_out_points_are_other_points_of_the_same_curves() {
    let (fitted, held_out) = (members(false), members(true));
    assert_eq!(fitted.len(), held_out.len());
    for (fitted, held_out) in fitted.iter().zip(&held_out) {
        assert_eq!(fitted.label, held_out.label);
        let (seen, unseen) = (values(fitted, "mu"), values(held_out, "mu"));
        assert!(unseen.iter().all(|mu| !seen.contains(mu)), "{}", fitted.label);
        assert!(unseen.contains(&0.0) && unseen.contains(&1.0) && unseen.contains(&1e-4));
        assert!(unseen.len() > 4 * seen.len());
        assert_eq!(values(fitted, "f_normal")[0], values(held_out, "f_normal")[0]);
    }
}

#[test]
fn every_curve_begins_and_ends_where_forms_do() {
    for member in members(true) {
        let (mu, value) = (values(&member, "mu"), values(&member, "value"));
        let f_normal = values(&member, "f_normal")[0];
        let last = mu.len() - 1;
        assert!((value[0] - 1.0).abs() < 1e-12, "{}: {}", member.label, value[0]);
        assert!((value[last] - f_normal).abs() < 1e-15, "{}", member.label);
        let in_gamut = !matches!(member.band.as_str(), "R" | "G" | "B");
        if in_gamut {
            assert!(value.iter().all(|v| (0.0..=1.0).contains(v)), "{}", member.label);
        }
    }
}

/// Held-out points must reach into the dips before grazing: aluminium's and silicon's in the violet
/// are 0.079 and 0.053 deep.
#[test]
fn pseudo_brewster_dips_are_held_out() {
    for (label, depth) in [("Al.Rakic@650nm", 0.079), ("Si.Aspnes@400nm", 0.053)] {
        let members = members(true);
        let member = members.iter().find(|member| member.label == label).expect("measured");
        let lowest = values(member, "value").iter().copied().fold(f64::INFINITY, f64::min);
        assert!(lowest < values(member, "f_normal")[0] - depth, "{label}: {lowest}");
    }
}

fn form(name: &str) -> Form {
    let entry = Registry::builtin().form(name).expect("registered");
    entry.load().expect("registered forms load")
}

/// `form` with given constants at points given by column.
fn evaluate(form: &Form, constants: &[f32], inputs: &[Vec<f32>]) -> Vec<f32> {
    let columns: Vec<&[f32]> = inputs.iter().map(Vec::as_slice).collect();
    form.eval_f32(constants, &columns).expect("the form evaluates").swap_remove(0)
}

#[test]
fn every_form_keeps_every_law_that_it_is_not_known_to_break() {
    for entry in Registry::builtin().forms_of(&EFFECT) {
        let candidate = entry.written().expect("every constant has a default");
        for law in EFFECT.laws {
            let violation = (law.violation)(&|points| candidate.values_for_laws(points));
            let known = law.known_violations.iter().any(|(name, _)| *name == entry.name);
            assert!(
                violation <= law.tolerance || known,
                "{} breaks `{}` by {violation:e}",
                entry.name,
                law.name
            );
        }
    }
}

#[test]
fn forms_take_columns_of_the_family() {
    let members = members(false);
    let table = &members[0].table;
    for entry in Registry::builtin()
        .forms_of(&EFFECT)
        .filter(|entry| entry.reference.as_deref() == Some("fresnel_conductor"))
    {
        for column in form(&entry.name).input_columns() {
            assert!(table.column(&column).is_some(), "{}: no column {column}", entry.name);
        }
    }
}

/// g of Gulbrandsen's map for a given index: the inverse of what the form does.
fn edge_tint(n: f64, k: f64) -> (f64, f64) {
    let r = ((n - 1.0).powi(2) + k * k) / ((n + 1.0).powi(2) + k * k);
    let most = (1.0 + r.sqrt()) / (1.0 - r.sqrt());
    let least = (1.0 - r) / (1.0 + r);
    (r, (most - n) / (most - least))
}

/// With the tint of a metal the full formulas must give its reflectance back; what is left is
/// rounding, 3.8e-7 at most.
#[test]
fn the_edge_tint_gives_the_metal_back() {
    let form = form("fresnel/gulbrandsen_exact");
    let mut worst = 0.0_f64;
    for (n, k) in [(0.2, 3.0), (2.9, 3.1), (1.2, 6.5), (1.5, 0.0)] {
        let (r, g) = edge_tint(n, k);
        let mu: Vec<f32> = (0..=100).map(|i| i as f32 / 100.0).collect();
        let f_normal = vec![r as f32; mu.len()];
        let got = evaluate(&form, &[g as f32], &[mu.clone(), f_normal]);
        for (mu, got) in mu.iter().zip(got) {
            let exact = conductor(f64::from(*mu), n, k).expect("inside the domain").mean();
            worst = worst.max((f64::from(got) - exact).abs());
        }
    }
    assert!(worst < 1e-6, "{worst:e}");
}

/// The edge form is defined by being exact at 82 degrees.
#[test]
fn the_edge_form_is_exact_at_its_edge() {
    for member in members(false) {
        let (f_normal, f_edge) = (values(&member, "f_normal")[0], values(&member, "f_edge")[0]);
        let inputs = [vec![1.0 / 7.0], vec![f_normal as f32], vec![f_edge as f32]];
        let got = evaluate(&form("fresnel/f_edge"), &[], &inputs)[0];
        assert!((f64::from(got) - f_edge).abs() < 3e-7, "{}: {got}, {f_edge}", member.label);
        let tint = f_edge / (f_normal + (1.0 - f_normal) * (6.0_f64 / 7.0).powi(5));
        let tinted = evaluate(&form("fresnel/f_tint"), &[tint as f32], &inputs[..2])[0];
        assert!((f64::from(tinted) - f_edge).abs() < 3e-7, "{}: {tinted}, {f_edge}", member.label);
    }
}
