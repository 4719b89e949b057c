//! Records of refractiveindex.info: YAML with tabulated n, k or nk, or a dispersion formula.
//!
//! Source of the format: refractiveindex.info database (M. N. Polyanskiy, Sci. Data 11, 94
//! (2024)). The records give wavelengths in µm; everything here is in nm.

use std::path::Path;

use serde::Deserialize;
use serde_saphyr::Spanned;

use super::error::require;
use super::tabulation::{self, Tabulation, ends};
use super::{Content, Dispersion, Imported, MeasuredError};
use crate::table::{Column, Table, store};

/// Spacing of the wavelengths of a record that is a formula, nm; see [`RefractiveIndex::to_table`].
const FORMULA_STEP_NM: f64 = 5.0;

/// What a record may hold, in the order in which it is kept.
const QUANTITIES: [&str; 2] = ["n", "k"];

/// Places of n and of k among the [`QUANTITIES`].
const N: usize = 0;
const K: usize = 1;

/// Most wavelengths that a formula is written out at.
const MOST_FORMULA_ROWS: f64 = 4096.0;

/// Optical constants n and k over the wavelength, from one record. Where a record gives n both as
/// a table and as a formula fitted to it, the table counts.
#[derive(Debug, Clone, PartialEq)]
pub struct RefractiveIndex {
    origin: String,
    /// Publications, and remarks on sample and temperature, as the record gives them (may hold HTML).
    references: String,
    comments: String,
    /// By quantity.
    curves: [Option<Curve>; 2],
    merged_rows: usize,
    formula_unused: bool,
}

#[derive(Debug, Clone, PartialEq)]
enum Curve {
    Tabulated(Tabulation),
    Formula { dispersion: Dispersion, from_nm: f64, to_nm: f64 },
}

#[derive(Deserialize)]
struct Record {
    #[serde(rename = "REFERENCES")]
    references: Option<String>,
    #[serde(rename = "COMMENTS")]
    comments: Option<String>,
    #[serde(rename = "DATA")]
    data: Vec<Entry>,
}

#[derive(Deserialize)]
struct Entry {
    #[serde(rename = "type")]
    kind: Spanned<String>,
    data: Option<Spanned<String>>,
    #[serde(alias = "range")]
    wavelength_range: Option<Spanned<String>>,
    coefficients: Option<Spanned<String>>,
}

impl RefractiveIndex {
    /// Reads a record.
    ///
    /// # Errors
    /// [`MeasuredError`] naming file and line: unreadable or not UTF-8, not YAML of this shape, an
    /// unknown type of data, rows that are not numbers, a quantity given twice, a formula with
    /// more coefficients than it has or without a range.
    pub fn read(path: &Path) -> Result<Self, MeasuredError> {
        let origin = path.display().to_string();
        let bytes = store::read(path)?;
        let mut record = Self::parse(&origin, store::text(&origin, &bytes)?)?;
        record.origin = store::origin(path, &bytes);
        Ok(record)
    }

    /// Reads the text of a record; `origin` names it in messages.
    ///
    /// # Errors
    /// As [`RefractiveIndex::read`].
    pub fn parse(origin: &str, text: &str) -> Result<Self, MeasuredError> {
        let record: Record = serde_saphyr::from_str(text).map_err(|e| {
            let message = e.without_snippet().to_string();
            MeasuredError::Malformed {
                origin: origin.into(),
                line: e.location().map_or(1, |l| l.line()),
                reason: message.lines().next().unwrap_or("not YAML").to_owned(),
            }
        })?;
        let mut parsed = Self {
            origin: origin.into(),
            references: record.references.unwrap_or_default(),
            comments: record.comments.unwrap_or_default(),
            curves: [None, None],
            merged_rows: 0,
            formula_unused: false,
        };
        for entry in &record.data {
            parsed.add(entry)?;
        }
        if parsed.curves.iter().all(Option::is_none) {
            let reason = "DATA holds neither n nor k".into();
            return Err(MeasuredError::Malformed { origin: origin.into(), line: 1, reason });
        }
        Ok(parsed)
    }

    fn add(&mut self, entry: &Entry) -> Result<(), MeasuredError> {
        let kind = entry.kind.value.as_str();
        match kind.split_whitespace().collect::<Vec<_>>().as_slice() {
            ["tabulated", "n"] => return self.add_tabulated(entry, &[N]),
            ["tabulated", "k"] => return self.add_tabulated(entry, &[K]),
            ["tabulated", "nk"] => return self.add_tabulated(entry, &[N, K]),
            ["formula", number] => {
                if let Some(number) = number.parse().ok().filter(|number| (1..=9).contains(number))
                {
                    return self.add_formula(entry, number);
                }
            }
            _ => {}
        }
        let known = "tabulated n, tabulated k, tabulated nk, formula 1 to formula 9";
        Err(self.fault(&entry.kind, format!("expected {known}, got type {kind:?}")))
    }

    fn add_tabulated(&mut self, entry: &Entry, quantities: &[usize]) -> Result<(), MeasuredError> {
        let rows = self.field(entry, entry.data.as_ref(), "data")?;
        let line = rows.referenced.line();
        let (tabulations, merged) =
            tabulation::parse(&self.origin, line, &rows.value, quantities.len())?;
        self.merged_rows += merged;
        for (quantity, tabulation) in quantities.iter().zip(tabulations) {
            self.set(entry, *quantity, Curve::Tabulated(tabulation))?;
        }
        Ok(())
    }

    fn add_formula(&mut self, entry: &Entry, number: u32) -> Result<(), MeasuredError> {
        let text = self.field(entry, entry.coefficients.as_ref(), "coefficients")?;
        let coefficients: Result<Vec<f64>, String> =
            text.value.split_whitespace().map(tabulation::number).collect();
        let dispersion = coefficients
            .and_then(|list| Dispersion::new(number, list))
            .map_err(|reason| self.fault(text, reason))?;

        let range = self.field(entry, entry.wavelength_range.as_ref(), "wavelength_range")?;
        let ends: Result<Vec<f64>, String> =
            range.value.split_whitespace().map(tabulation::micrometres_as_nm).collect();
        match ends.map_err(|reason| self.fault(range, reason))?.as_slice() {
            &[from_nm, to_nm] if from_nm < to_nm => {
                self.set(entry, N, Curve::Formula { dispersion, from_nm, to_nm })
            }
            _ => Err(self.fault(
                range,
                format!("expected two increasing wavelengths in µm, got {:?}", range.value),
            )),
        }
    }

    fn field<'e>(
        &self,
        entry: &Entry,
        field: Option<&'e Spanned<String>>,
        name: &str,
    ) -> Result<&'e Spanned<String>, MeasuredError> {
        field.ok_or_else(|| {
            self.fault(&entry.kind, format!("{:?} without {name}", entry.kind.value))
        })
    }

    fn set(&mut self, entry: &Entry, quantity: usize, curve: Curve) -> Result<(), MeasuredError> {
        let slot = &mut self.curves[quantity];
        match (slot.as_ref(), &curve) {
            (None, _) => *slot = Some(curve),
            (Some(Curve::Formula { .. }), Curve::Tabulated(_)) => {
                *slot = Some(curve);
                self.formula_unused = true;
            }
            (Some(Curve::Tabulated(_)), Curve::Formula { .. }) => self.formula_unused = true,
            _ => {
                let reason = format!("{} is given a second time", QUANTITIES[quantity]);
                return Err(self.fault(&entry.kind, reason));
            }
        }
        Ok(())
    }

    fn fault(&self, at: &Spanned<String>, reason: String) -> MeasuredError {
        let line = at.referenced.line();
        MeasuredError::Malformed { origin: self.origin.clone(), line, reason }
    }

    /// First and last wavelength, nm, at which everything that the record holds is known.
    ///
    /// # Errors
    /// [`MeasuredError::Unusable`] if n and k have no wavelength in common.
    pub fn range_nm(&self) -> Result<(f64, f64), MeasuredError> {
        let (mut from, mut to) = (f64::NEG_INFINITY, f64::INFINITY);
        for curve in self.curves.iter().flatten() {
            let (first, last) = curve.range_nm();
            from = from.max(first);
            to = to.min(last);
        }
        require(from <= to, &self.origin, || {
            format!("n and k have no wavelength in common ({from} nm, {to} nm)")
        })?;
        Ok((from, to))
    }

    /// Real part of the refractive index at a wavelength in nm: the formula, or linear between the
    /// measured wavelengths.
    ///
    /// # Errors
    /// [`MeasuredError::Unusable`] without n, outside the range, and where a formula has no finite
    /// real value.
    pub fn n(&self, wavelength_nm: f64) -> Result<f64, MeasuredError> {
        self.value(N, wavelength_nm)
    }

    /// Extinction coefficient at a wavelength in nm, linear between the measured wavelengths.
    ///
    /// # Errors
    /// As [`RefractiveIndex::n`].
    pub fn k(&self, wavelength_nm: f64) -> Result<f64, MeasuredError> {
        self.value(K, wavelength_nm)
    }

    fn value(&self, quantity: usize, at_nm: f64) -> Result<f64, MeasuredError> {
        let name = QUANTITIES[quantity];
        let fault = |reason: String| MeasuredError::unusable(&self.origin, reason);
        let Some(curve) = &self.curves[quantity] else {
            return Err(fault(format!("the record has no {name}")));
        };
        let range_nm = curve.range_nm();
        if !(range_nm.0..=range_nm.1).contains(&at_nm) {
            return Err(MeasuredError::out_of_range(&self.origin, name, range_nm, at_nm));
        }
        match curve {
            Curve::Tabulated(tabulation) => tabulation.at(at_nm),
            Curve::Formula { dispersion, .. } => Some(dispersion.index(at_nm / 1000.0)),
        }
        .filter(|value| value.is_finite())
        .ok_or_else(|| {
            fault(format!("the dispersion formula has no finite real value at {at_nm} nm"))
        })
    }

    /// The wavelengths of [`RefractiveIndex::to_table`], nm, and how they were chosen, in words.
    fn wavelengths_nm(&self) -> Result<(Vec<f64>, String), MeasuredError> {
        let (from, to) = self.range_nm()?;
        let mut measured = Vec::new();
        for curve in self.curves.iter().flatten() {
            match curve {
                Curve::Tabulated(t) => measured.extend_from_slice(&t.wavelength_nm),
                Curve::Formula { .. } => return Ok(regular_wavelengths(from, to)),
            }
        }
        measured.retain(|w| (from..=to).contains(w));
        measured.sort_by(f64::total_cmp);
        measured.dedup();
        Ok((measured, "at the measured wavelengths".into()))
    }

    /// Columns `wavelength [nm]` and, as far as the record holds them, `n` and `k`.
    ///
    /// A tabulated record is written at its measured wavelengths. A record with a formula is
    /// written at the multiples of [`FORMULA_STEP_NM`] inside its range, of the next of 10, 20,
    /// 50 … nm that keeps it to 4096 rows, or, where the range holds fewer than two multiples, at
    /// 17 equally spaced wavelengths; a tabulated k beside it is interpolated there.
    ///
    /// # Errors
    /// As [`RefractiveIndex::range_nm`] and [`RefractiveIndex::n`].
    pub fn to_table(&self) -> Result<Table, MeasuredError> {
        let (wavelengths, _) = self.wavelengths_nm()?;
        let mut columns = Vec::new();
        for quantity in [N, K].into_iter().filter(|quantity| self.curves[*quantity].is_some()) {
            let values: Result<Vec<f64>, _> =
                wavelengths.iter().map(|w| self.value(quantity, *w)).collect();
            columns.push(Column::new(QUANTITIES[quantity], "1", values?));
        }
        columns.insert(0, Column::new("wavelength", "nm", wavelengths));
        Ok(Table { columns, origin: self.origin.clone() })
    }

    /// Where the record comes from and how [`RefractiveIndex::to_table`] wrote it, one line each.
    ///
    /// # Errors
    /// As [`RefractiveIndex::range_nm`].
    pub fn notes(&self) -> Result<Vec<String>, MeasuredError> {
        let mut notes = Vec::new();
        for (label, text) in [("reference", &self.references), ("comment", &self.comments)] {
            let lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
            notes.extend(lines.map(|line| format!("{label}: {line}")));
        }
        notes.push(self.wavelengths_nm()?.1);
        if self.formula_unused {
            notes.push("n is tabulated; the record's formula for it is not used".into());
        }
        if self.merged_rows > 0 {
            notes.push(format!("{} rows at repeated wavelengths averaged", self.merged_rows));
        }
        Ok(notes)
    }
}

impl Curve {
    fn range_nm(&self) -> (f64, f64) {
        match self {
            Self::Tabulated(t) => ends(&t.wavelength_nm),
            Self::Formula { from_nm, to_nm, .. } => (*from_nm, *to_nm),
        }
    }
}

fn regular_wavelengths(from: f64, to: f64) -> (Vec<f64>, String) {
    let mut step = FORMULA_STEP_NM;
    for growth in [2.0, 2.0, 2.5].into_iter().cycle() {
        if (to - from) / step <= MOST_FORMULA_ROWS || !step.is_finite() {
            break;
        }
        step *= growth;
    }
    let (first, last) = ((from / step).ceil(), (to / step).floor());
    if last - first < 1.0 {
        let intervals = 16;
        let at = |i: usize| from + (to - from) * (i as f64 / intervals as f64);
        let wavelengths: Vec<f64> = (0..=intervals).map(at).collect();
        return (wavelengths, "dispersion formula at 17 equally spaced wavelengths".into());
    }
    let count = (last - first) as usize;
    let wavelengths = (0..=count).map(|i| (first + i as f64) * step).collect();
    (wavelengths, format!("dispersion formula at the multiples of {step} nm"))
}

/// Reads a record for [`super::import`].
pub(super) fn import(path: &Path) -> Result<Imported, MeasuredError> {
    let record = RefractiveIndex::read(path)?;
    let (table, notes) = (record.to_table()?, record.notes()?);
    Ok(Imported { content: Content::Table(table), format: "refractiveindex.info YAML", notes })
}
