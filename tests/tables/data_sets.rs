//! The data sets in `data/measured/`: provenance, plausibility, and colour.

use std::path::Path;

use striae::measured::spectra::{Illuminant, Spectra};
use striae::measured::{MeasuredError, optical_constants};
use striae::table::provenance::Provenance;

use crate::{assert_says, repository};

/// Smallest `SOURCE.toml` for the file `a.csv` with the given fingerprint.
fn source(sha256: &str) -> String {
    format!(
        "title = \"t\"\nlicence = \"CC0\"\n[obtained]\npackage = \"p\"\nversion = \"1\"\n\
         command = \"c\"\n[measurement]\nmeasured_by = \"m\"\ninstrument = \"i\"\n\
         reference = \"r\"\n[[file]]\nname = \"a.csv\"\nsha256 = \"{sha256}\"\nrecord = \"a\"\n\
         [file.measurement]\ndoi = \"10.1/1\"\n"
    )
}

#[test]
fn every_data_set_is_what_its_source_says() -> Result<(), Box<dyn std::error::Error>> {
    let mut sets = 0;
    for entry in std::fs::read_dir(repository("data/measured"))? {
        let folder = entry?.path();
        if folder.is_dir() {
            let provenance = Provenance::read(&folder)?;
            provenance.verify(&folder)?;
            assert!(!provenance.files.is_empty(), "{}", folder.display());
            sets += 1;
        }
    }
    assert!(sets >= 2, "{sets} data sets");
    Ok(())
}

#[test]
fn provenance_that_disagrees_with_the_folder_is_refused() -> Result<(), Box<dyn std::error::Error>>
{
    let folder = tempfile::tempdir()?;
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text);
    let verify = || -> String {
        let checked = Provenance::read(&folder).and_then(|p| p.verify(&folder));
        checked.map_or_else(|e| e.to_string(), |()| "verified".into())
    };
    assert_says(&verify(), &["SOURCE.toml", "cannot read"]);
    let good = source(&striae::table::store::sha256_hex(b"x\n1\n"));
    write("SOURCE.toml", &good)?;
    assert_says(&verify(), &["a.csv", "not there"]);
    write("a.csv", "x\n1\n")?;
    assert_eq!(verify(), "verified");
    write("a.csv", "x\n2\n")?;
    assert_says(&verify(), &["a.csv", "sha256", "expected"]);
    write("a.csv", "x\n1\n")?;
    write("b.csv", "x\n1\n")?;
    assert_says(&verify(), &["b.csv", "not listed"]);
    std::fs::remove_file(folder.path().join("b.csv"))?;

    write("SOURCE.toml", &good.replace("name = \"a.csv\"", "name = \"../a.csv\""))?;
    assert_says(&verify(), &["../a.csv", "not a file of this folder"]);
    write("SOURCE.toml", &good.replace("instrument = \"i\"", "instrument = \" \""))?;
    assert_says(&verify(), &["SOURCE.toml", "a.csv", "no instrument"]);
    write("SOURCE.toml", &good.replace("doi =", "dio ="))?;
    assert_says(&verify(), &["SOURCE.toml", "dio", "line"]);
    write("SOURCE.toml", &good.replace("licence = \"CC0\"\n", ""))?;
    assert_says(&verify(), &["SOURCE.toml", "licence"]);
    Ok(())
}

#[test]
fn optical_constants_cover_the_visible() -> Result<(), MeasuredError> {
    let all = optical_constants::load(&repository("data/measured/optical_constants"))?;
    let names: Vec<String> = all.iter().map(|c| c.name()).collect();
    assert!(names.is_sorted());
    for material in ["Au", "Ag", "Cu", "Al"] {
        let sources = all.iter().filter(|c| c.material == material).count();
        assert!(sources >= 2, "{material} has {sources} sources");
    }
    for material in ["Fe", "Cr", "Ti", "Ni", "W", "Brass", "Si", "SiO2", "N-BK7", "PMMA"] {
        assert!(all.iter().any(|c| c.material == material), "{material} is missing");
    }
    for constants in &all {
        let (from, to) = constants.range_nm();
        assert!(from <= 405.0 && to >= 780.0, "{}: {from} to {to} nm", constants.name());
        assert!(constants.at(from - 1.0).is_err() && constants.at(f64::NAN).is_err());
        let (n, k) = constants.at(550.0)?;
        assert!(n > 0.0 && k >= 0.0);
    }
    Ok(())
}

#[test]
fn optical_constants_give_published_values() -> Result<(), MeasuredError> {
    let folder = repository("data/measured/optical_constants");
    // Rows of the publications, and at 550 nm the interpolation between them.
    for (name, wavelength_nm, n, k) in [
        ("Au.Johnson", 548.6, 0.43, 2.455),
        ("Ag.Johnson", 548.6, 0.06, 3.586),
        ("Cu.Johnson", 548.6, 1.02, 2.577),
        ("Al.Rakic", 550.0, 1.0152, 6.6273),
        ("W.Weaver", 550.0, 3.5221, 2.7414),
        ("Brass.Querry", 550.0, 0.527, 2.765),
        ("SiO2.Malitson", 550.0, 1.4599, 0.0),
    ] {
        let read = optical_constants::OpticalConstants::read(&folder.join(format!("{name}.csv")))?;
        let (got_n, got_k) = read.at(wavelength_nm)?;
        assert!((got_n - n).abs() < 6e-5 && (got_k - k).abs() < 6e-5, "{name}: {got_n}, {got_k}");
    }
    Ok(())
}

#[test]
fn implausible_constants_are_refused() -> Result<(), Box<dyn std::error::Error>> {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("Au.Me.csv");
    for (rows, says) in [
        ("500,1,1\n400,1,1\n", "increase"),
        ("500,1,1\n500,1,1\n", "increase"),
        ("500,0,1\n600,1,1\n", "n > 0"),
        ("500,1,-1\n600,1,1\n", "k ≥ 0"),
    ] {
        std::fs::write(&path, format!("wavelength [nm],n,k\n{rows}"))?;
        let message = optical_constants::load(folder.path()).err().ok_or("loaded")?.to_string();
        assert_says(&message, &["Au.Me.csv", says]);
    }
    std::fs::rename(&path, folder.path().join("Au.csv"))?;
    let message = optical_constants::load(folder.path()).err().ok_or("loaded")?.to_string();
    assert_says(&message, &["Au.csv", "<Material>.<Source>.csv"]);
    std::fs::remove_file(folder.path().join("Au.csv"))?;
    let message = optical_constants::load(folder.path()).err().ok_or("loaded")?.to_string();
    assert_says(&message, &["no CSV files"]);
    assert!(optical_constants::load(Path::new("no such folder")).is_err());
    Ok(())
}

fn spectra() -> Result<Spectra, MeasuredError> {
    Spectra::load(&repository("data/measured/spectra"))
}

#[test]
fn observer_and_illuminants_are_those_of_the_cie() -> Result<(), MeasuredError> {
    let spectra = spectra()?;
    let sum: f64 = spectra.observer()[1].iter().sum();
    assert!((sum - 106.8569).abs() < 5e-5, "sum of y_bar {sum}");
    let chromaticity = |illuminant: &Illuminant| {
        let [x, y, z] = spectra.white(illuminant);
        [x / (x + y + z), y / (x + y + z)]
    };
    // CIE 15:2004, table T.3, where the sums go on to 830 nm. The tables here end at 780 nm, which
    // moves the white of A by 1.8e-5 and that of D65 by less than 1e-5.
    for (illuminant, white, near) in
        [(spectra.d65(), [0.31272, 0.32903], 1.1e-5), (spectra.a(), [0.44758, 0.40745], 2.3e-5)]
    {
        let got = chromaticity(illuminant);
        let off = (got[0] - white[0]).abs().max((got[1] - white[1]).abs());
        assert!(off < near, "{got:?}, expected {white:?}");
    }
    assert_eq!(spectra.d65().power(560.0), Some(100.0));
    assert_eq!(spectra.d65().power(781.0), None);
    Ok(())
}

#[test]
fn white_is_white_whatever_the_wavelengths() -> Result<(), MeasuredError> {
    let spectra = spectra()?;
    let regular: Vec<f64> = (0..=80).map(|i| 380.0 + 5.0 * f64::from(i)).collect();
    for nodes in [&regular[..], &[390.0, 401.5, 500.0, 641.0, 700.0, 900.0], &[300.0, 1000.0]] {
        let weights = spectra.linear_srgb_weights(nodes)?;
        let white = weights.linear_srgb(&vec![1.0; nodes.len()]);
        // The weights are normalised to white, so only rounding is left: a few ulp of 1.
        assert!(white.iter().all(|c| (c - 1.0).abs() < 1e-15), "{white:?}");
    }
    Ok(())
}

#[test]
fn gold_is_the_colour_of_gold() -> Result<(), MeasuredError> {
    let folder = repository("data/measured/optical_constants");
    let gold = optical_constants::OpticalConstants::read(&folder.join("Au.Johnson.csv"))?;
    let reflectance: Result<Vec<f64>, MeasuredError> = gold
        .wavelengths_nm()
        .iter()
        .map(|w| {
            let (n, k) = gold.at(*w)?;
            Ok(((n - 1.0).powi(2) + k * k) / ((n + 1.0).powi(2) + k * k))
        })
        .collect();
    let weights = spectra()?.linear_srgb_weights(gold.wavelengths_nm())?;
    let [r, g, b] = weights.linear_srgb(&reflectance?);
    // colour-science 0.4.7 on the same table, tests/tables/gold.py.
    let expected = [1.034_783, 0.727_639, 0.365_377];
    for (got, want) in [r, g, b].into_iter().zip(expected) {
        assert!((got - want).abs() < 2e-4, "({r}, {g}, {b}), expected {expected:?}");
    }
    assert_eq!(weights.outside, 0.0);
    Ok(())
}

#[test]
fn weights_need_wavelengths_that_cover_the_visible() -> Result<(), MeasuredError> {
    let spectra = spectra()?;
    let fault = |nodes: &[f64]| {
        let weights = spectra.linear_srgb_weights(nodes);
        weights.map_or_else(|e| e.to_string(), |w| panic!("{w:?}"))
    };
    assert_says(&fault(&[]), &["no wavelengths"]);
    assert_says(&fault(&[500.0, 400.0]), &["increase"]);
    assert_says(&fault(&[400.0, f64::NAN]), &["increase"]);
    assert_says(&fault(&[500.0, 700.0]), &["500 to 700 nm", "%"]);
    assert_says(&fault(&[550.0]), &["%"]);
    Ok(())
}
