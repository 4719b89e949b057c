//! Records of refractiveindex.info: the nine formulas against an independent evaluation and
//! published values, and what is refused.

use std::path::{Path, PathBuf};

use striae::measured::refractive_index::RefractiveIndex;
use striae::measured::{Dispersion, Imported, MeasuredError, Negative, import};

use crate::{assert_says, repository};

fn record(name: &str) -> Result<RefractiveIndex, MeasuredError> {
    RefractiveIndex::read(&repository(&format!("tests/tables/records/{name}.yml")))
}

fn read(path: &Path) -> Result<Imported, MeasuredError> {
    import(path, Negative::Refused)
}

#[test]
fn formulas_agree_with_an_independent_evaluation() -> Result<(), Box<dyn std::error::Error>> {
    let mut seen = std::collections::BTreeSet::new();
    let mut worst = 0.0f64;
    let mut rows = ::csv::Reader::from_path(repository("tests/tables/formulas.csv"))?;
    for row in rows.deserialize() {
        let (name, formula, wavelength_nm, expected): (String, u32, f64, f64) = row?;
        let got = record(&name)?.n(wavelength_nm)?;
        worst = worst.max((got / expected - 1.0).abs());
        seen.insert(formula);
    }
    // Both sides are correctly computed to a few ulp; 5e-16 is two and a quarter.
    assert!(worst <= 5e-16, "worst relative error {worst:e}");
    assert_eq!(seen.into_iter().collect::<Vec<_>>(), (1..=9).collect::<Vec<_>>());
    Ok(())
}

#[test]
fn formulas_give_published_indices() -> Result<(), MeasuredError> {
    for (name, wavelength_nm, published, digits) in [
        // Schott, N-BK7 data sheet: n_F, n_d, n_C.
        ("N-BK7.Schott", 486.1327, 1.52238, 5e-6),
        ("N-BK7.Schott", 587.5618, 1.51680, 5e-6),
        ("N-BK7.Schott", 656.2725, 1.51432, 5e-6),
        // Malitson 1965, table of computed indices.
        ("SiO2.Malitson", 587.5618, 1.458_46, 1e-5),
        ("SiO2.Malitson", 1060.0, 1.44968, 1e-5),
        // Standard air at the sodium D lines.
        ("air.Ciddor", 589.3, 1.000_277, 5e-7),
    ] {
        let got = record(name)?.n(wavelength_nm)?;
        assert!((got - published).abs() <= digits, "{name} at {wavelength_nm} nm: {got}");
    }
    Ok(())
}

#[test]
fn tabulated_records_are_exact_at_their_rows_and_linear_between() -> Result<(), MeasuredError> {
    let gold = record("Au.Johnson")?;
    assert_eq!(gold.range_nm()?, (187.9, 1937.0));
    assert_eq!((gold.n(187.9)?, gold.k(187.9)?), (1.28, 1.188));
    let halfway = gold.n((187.9 + 191.6) / 2.0)?;
    assert!((halfway - (1.28 + 1.32) / 2.0).abs() < 1e-15);
    let table = gold.to_table()?;
    assert_eq!((table.names(), table.rows()), (vec!["wavelength", "n", "k"], 49));
    assert_eq!(table.columns[0].unit, "nm");
    assert!(table.columns[0].values.iter().all(|w| (w * 10.0).fract() == 0.0));
    Ok(())
}

#[test]
fn a_formula_is_written_on_its_stated_grid() -> Result<(), MeasuredError> {
    let glass = record("N-BK7.Schott")?.to_table()?;
    let wavelengths = &glass.columns[0].values;
    assert_eq!((wavelengths[0], wavelengths[1], wavelengths.len()), (300.0, 305.0, 441));
    assert_eq!(glass.names(), ["wavelength", "n", "k"]);
    let silica = record("SiO2.Malitson")?;
    assert_eq!(silica.to_table()?.names(), ["wavelength", "n"]);
    assert_says(&silica.k(500.0).map_or_else(|e| e.to_string(), |_| String::new()), &["no k"]);

    let formula = |range: &str| {
        let text = format!(
            "DATA:\n  - type: formula 5\n    wavelength_range: {range}\n    coefficients: 1.5\n"
        );
        RefractiveIndex::parse("r.yml", &text)?.to_table()
    };
    let wide = &formula("0.1 1000")?.columns[0].values;
    assert!(wide.len() <= 4097 && wide[1] - wide[0] == 500.0, "{} rows", wide.len());
    let narrow = &formula("0.501 0.502")?.columns[0].values;
    assert_eq!((narrow.len(), narrow[0], narrow[16]), (17, 501.0, 502.0));
    Ok(())
}

#[test]
fn rows_are_sorted_and_repeated_wavelengths_averaged() -> Result<(), MeasuredError> {
    let text = "DATA:\n  - type: tabulated nk\n    data: |\n        0.6 2 1\n        0.5 1 0\n        \
                0.6 4 2\n";
    let record = RefractiveIndex::parse("r.yml", text)?;
    assert_eq!((record.n(600.0)?, record.k(600.0)?, record.n(500.0)?), (3.0, 1.5, 1.0));
    assert_says(&record.notes()?.join("\n"), &["1 rows at repeated wavelengths averaged"]);
    Ok(())
}

#[test]
fn measured_n_counts_before_a_formula_fitted_to_it() -> Result<(), MeasuredError> {
    let text = "DATA:\n  - type: formula 5\n    wavelength_range: 0.4 0.7\n    coefficients: 9\n  \
                - type: tabulated nk\n    data: |\n        0.5 1 0\n        0.6 2 1\n";
    let record = RefractiveIndex::parse("r.yml", text)?;
    assert_eq!(record.n(550.0)?, 1.5);
    assert_says(&record.notes()?.join("\n"), &["formula", "not used"]);
    Ok(())
}

#[test]
fn wavelengths_outside_the_range_are_refused() -> Result<(), MeasuredError> {
    let gold = record("Au.Johnson")?;
    for wavelength in [187.8, 1937.1, -1.0, f64::NAN, f64::INFINITY] {
        let message = gold.n(wavelength).map_or_else(|e| e.to_string(), |n| panic!("{n}"));
        assert_says(&message, &["Au.Johnson.yml", "187.9", "1937", &wavelength.to_string()]);
    }
    Ok(())
}

#[test]
fn faults_are_named_with_file_and_line() {
    let refusal = |text: &str| match RefractiveIndex::parse("r.yml", text) {
        Ok(record) => panic!("{text:?} was read as {record:?}"),
        Err(error) => error.to_string(),
    };
    let table = |kind: &str, rows: &str| {
        refusal(&format!("REFERENCES: x\nDATA:\n  - type: {kind}\n    data: |\n{rows}"))
    };
    assert_says(&refusal(""), &["r.yml:1"]);
    assert_says(&refusal("REFERENCES: [\n"), &["r.yml:"]);
    assert_says(&refusal("REFERENCES: x\n"), &["r.yml:", "DATA"]);
    assert_says(&refusal("DATA: []\n"), &["r.yml:1", "neither n nor k"]);
    assert_says(&table("tabulated n2", "        1 2\n"), &["r.yml:3", "formula 9", "tabulated n2"]);
    assert_says(&table("formula 10", "        1\n"), &["r.yml:3", "formula 10"]);
    let rows = "        0.5 1 2\n        0.6 1 2 3\n";
    assert_says(&table("tabulated nk", rows), &["r.yml:6", "expected 3 numbers", "got 4"]);
    assert_says(&table("tabulated n", "        0.5 x\n"), &["r.yml:5", "number", "\"x\""]);
    assert_says(&table("tabulated n", "        0.5 nan\n"), &["r.yml:5", "finite"]);
    assert_says(&table("tabulated n", "        -0.5 1\n"), &["r.yml:5", "positive", "-0.5"]);
    assert_says(&table("tabulated n", "        0.5e999 1\n"), &["r.yml:5", "positive"]);
    let no_data = "DATA:\n  - type: tabulated n\n    range: 0.3 0.5\n";
    assert_says(&refusal(no_data), &["r.yml:2", "without data"]);
    let twice = "DATA:\n  - type: tabulated k\n    data: 0.5 1\n  - type: tabulated nk\n    \
                 data: 0.5 1 1\n";
    assert_says(&refusal(twice), &["r.yml:4", "k is given a second time"]);

    let formula = |number: u32, range: &str, coefficients: &str| {
        refusal(&format!(
            "DATA:\n  - type: formula {number}\n    wavelength_range: {range}\n    \
             coefficients: {coefficients}\n"
        ))
    };
    assert_says(&formula(1, "0.5 0.3", "1 2 3"), &["r.yml:3", "increasing"]);
    assert_says(&formula(1, "0.5", "1 2 3"), &["r.yml:3", "two"]);
    assert_says(&formula(8, "0.3 0.5", "1 2 3 4 5"), &["r.yml:4", "5 coefficients", "has 4"]);
    assert_says(&formula(1, "0.3 0.5", "1 2 inf"), &["r.yml:4", "finite"]);
    assert_says(&formula(1, "0.3 0.5", "1 two"), &["r.yml:4", "\"two\""]);
}

#[test]
fn a_formula_without_a_real_value_is_an_error() -> Result<(), MeasuredError> {
    // n² = 1 − λ² has no real root from λ = 1 µm on, and 1/0 is no index at the pole.
    let text =
        "DATA:\n  - type: formula 3\n    wavelength_range: 0.5 2\n    coefficients: 1 -1 2\n";
    let record = RefractiveIndex::parse("r.yml", text)?;
    assert!((record.n(600.0)? - 0.8).abs() < 1e-15);
    assert_says(
        &record.n(1500.0).map_or_else(|e| e.to_string(), |n| panic!("{n}")),
        &["r.yml", "1500 nm", "no finite real value"],
    );
    assert!(record.to_table().is_err());
    Ok(())
}

#[test]
fn unused_places_of_a_formula_do_not_divide_by_zero() -> Result<(), String> {
    let formula = Dispersion::new(4, vec![2.25, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])?;
    assert_eq!(formula.index(1.0), 1.5);
    let formula = Dispersion::new(6, vec![0.5, 0.0, 1.0])?;
    assert_eq!(formula.index(1.0), 1.5);
    assert!(Dispersion::new(1, vec![]).is_err());
    assert!(Dispersion::new(5, vec![f64::NAN]).is_err());
    Ok(())
}

#[test]
fn import_tells_formats_by_extension() -> Result<(), Box<dyn std::error::Error>> {
    let folder = tempfile::tempdir()?;
    let imported = read(&repository("tests/tables/records/Au.Johnson.yml"))?;
    assert_eq!(imported.format, "refractiveindex.info YAML");
    assert_says(&imported.notes.join("\n"), &["Johnson", "10.1103/PhysRevB.6.4370", "measured"]);
    let path = folder.path().join("Au.csv");
    imported.write(&path)?;
    let columns = |imported: &Imported| imported.table().map(|table| table.columns.clone());
    assert_eq!(columns(&read(&path)?), columns(&imported));

    let other = folder.path().join("Au.docx");
    let message = read(&other).err().ok_or("imported")?.to_string();
    assert_says(&message, &["Au.docx", "unknown format", ".yml", ".csv"]);
    let message = read(&PathBuf::from("none.yml")).err().ok_or("imported")?.to_string();
    assert_says(&message, &["none.yml", "cannot read"]);
    Ok(())
}

/// The records that stay outside the repository, where they are present.
#[test]
fn records_outside_the_repository_are_read() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::var_os("STRIAE_MEASURED").map_or_else(
        || repository("../shared/measured"),
        |folder| Path::new(&folder).to_path_buf(),
    );
    let folder = folder.join("refractiveindex_nk/yml");
    if !folder.is_dir() {
        eprintln!("skipped: {} is not there", folder.display());
        return Ok(());
    }
    for entry in std::fs::read_dir(&folder)? {
        let path = entry?.path();
        let imported = read(&path)?;
        let table = imported.table().ok_or("no table")?;
        assert!(table.rows() > 10, "{}", path.display());
        table.check()?;
    }
    let at_550 = |name: &str| RefractiveIndex::read(&folder.join(name))?.n(550.0);
    assert!((at_550("Au_Johnson.yml")? - 0.4241).abs() < 5e-5);
    assert!((at_550("Al_Rakic.yml")? - 1.0152).abs() < 5e-5);
    Ok(())
}
