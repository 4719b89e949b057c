//! The family `fresnel_materials`: reflectance curves of measured materials.
//!
//! Every record of `data/measured/optical_constants` gives one member per band: seven wavelengths
//! from 400 to 700 nm, and the channels R, G, B of linear sRGB under D65. A channel is the weighted
//! sum of the reflectances at 5 nm steps from 380 to 780 nm; where a record ends earlier its last
//! reflectance stands for the rest, and a record that does not cover 400 to 700 nm has no channels.
//! Channels are not clipped: a saturated metal leaves the gamut of sRGB, and gold reflects more
//! than 1 in R.
//!
//! # Points
//!
//! Fitted: the midpoints of 96 equal intervals of mu. Even in mu is even over the hemisphere of
//! directions, dω = dμ dφ: the weight that an angle has in an integral over half vectors, and a
//! compromise between a convex object seen from afar (∝ μ) and the rims that the eye is drawn to
//! (even in angle). The ends are left out: every form is exact there.
//!
//! Held out: 401 even steps with both ends, none of them fitted, the decades down to mu = 1e-4, and
//! the pseudo-Brewster angle.

use std::path::Path;

use rayon::prelude::*;

use crate::effect::{Family, FamilyError, Member};
use crate::effects::fresnel::reference::{Reflectance, conductor};
use crate::measured::optical_constants::{self, OpticalConstants};
use crate::measured::spectra::Spectra;
use crate::table::{Column, Table};

/// The family, as registered.
pub const FAMILY: Family = Family {
    name: "fresnel_materials",
    description: "reflectance of measured metals, silicon and glasses at seven wavelengths and in \
                  linear sRGB",
    members,
};

const WAVELENGTHS_NM: [u16; 7] = [400, 450, 500, 550, 600, 650, 700];

/// What a record must cover to have colour channels.
const VISIBLE_NM: (f64, f64) = (400.0, 700.0);

/// The channels, with the wavelength whose pseudo-Brewster angle stands for theirs.
const CHANNELS: [(&str, f64); 3] = [("R", 610.0), ("G", 550.0), ("B", 465.0)];

const FITTED_COUNT: u32 = 96;
const HELD_OUT_COUNT: u32 = 400;

/// Cosine of incidence at which Hoffman's edge colour is defined.
const MU_EDGE: f64 = 1.0 / 7.0;

fn members(data: &Path, held_out: bool) -> Result<Vec<Member>, FamilyError> {
    let records = optical_constants::load(&data.join("optical_constants")).map_err(failure)?;
    let spectra = Spectra::load(&data.join("spectra")).map_err(failure)?;
    let of_records = records
        .par_iter()
        .map(|record| {
            let mut members = at_wavelengths(record, held_out)?;
            members.extend(in_channels(record, &spectra, held_out)?);
            Ok(members)
        })
        .collect::<Result<Vec<_>, FamilyError>>()?;
    Ok(of_records.into_iter().flatten().collect())
}

fn failure(error: impl std::fmt::Display) -> FamilyError {
    FamilyError(error.to_string())
}

/// Members at single wavelengths that the record covers.
fn at_wavelengths(record: &OpticalConstants, held_out: bool) -> Result<Vec<Member>, FamilyError> {
    let (first, last) = record.range_nm();
    let covered = WAVELENGTHS_NM.into_iter().filter(|nm| (first..=last).contains(&f64::from(*nm)));
    let at = |nm: u16| {
        let (band, nm) = (format!("{nm}nm"), f64::from(nm));
        let index = index_at(record, nm)?;
        in_bands(record, held_out, &[(&band, nm)], |mu| Ok([reflectance(record, mu, index)?]))
    };
    Ok(covered.map(at).collect::<Result<Vec<_>, _>>()?.concat())
}

/// Members in R, G and B, if the record covers the visible range.
fn in_channels(
    record: &OpticalConstants,
    spectra: &Spectra,
    held_out: bool,
) -> Result<Vec<Member>, FamilyError> {
    let (first, last) = record.range_nm();
    if first > VISIBLE_NM.0 || last < VISIBLE_NM.1 {
        return Ok(Vec::new());
    }
    let nodes: Vec<f64> =
        (380..=780).step_by(5).map(f64::from).filter(|nm| (first..=last).contains(nm)).collect();
    let weights = spectra.linear_srgb_weights(&nodes).map_err(failure)?;
    let at_nodes = nodes.iter().map(|nm| index_at(record, *nm)).collect::<Result<Vec<_>, _>>()?;
    in_bands(record, held_out, &CHANNELS, |mu| {
        let spectrum = at_nodes.iter().map(|index| reflectance(record, mu, *index));
        Ok(weights.linear_srgb(&spectrum.collect::<Result<Vec<_>, _>>()?))
    })
}

/// A member per band, each with the wavelength whose pseudo-Brewster angle is held out; `reflectances` are
/// those of the bands at a cosine.
fn in_bands<const N: usize>(
    record: &OpticalConstants,
    held_out: bool,
    bands: &[(&str, f64); N],
    reflectances: impl Fn(f64) -> Result<[f64; N], FamilyError>,
) -> Result<Vec<Member>, FamilyError> {
    let dip = |(_, nm): &(&str, f64)| Ok(pseudo_brewster(index_at(record, *nm)?));
    let dips = bands.iter().map(dip).collect::<Result<Vec<_>, FamilyError>>()?;
    let mu = cosines(held_out, &dips);
    let curves = mu.iter().map(|mu| reflectances(*mu)).collect::<Result<Vec<_>, _>>()?;
    let (normal, edge) = (reflectances(1.0)?, reflectances(MU_EDGE)?);
    let of = |(at, (band, _)): (usize, &(&str, f64))| {
        let value = curves.iter().map(|values| values[at]).collect();
        member(record, band, mu.clone(), value, [normal[at], edge[at]])
    };
    Ok(bands.iter().enumerate().map(of).collect())
}

/// The index at a wavelength, as (n, k).
fn index_at(record: &OpticalConstants, nm: f64) -> Result<(f64, f64), FamilyError> {
    record.at(nm).map_err(failure)
}

fn reflectance(record: &OpticalConstants, mu: f64, (n, k): (f64, f64)) -> Result<f64, FamilyError> {
    conductor(mu, n, k)
        .map(Reflectance::mean)
        .map_err(|error| FamilyError(format!("{}: {error}", record.table.origin)))
}

/// Angle at which |m² μ| ≈ |w|, near the minimum of R_p, for k = 0 Brewster's: its cosine.
fn pseudo_brewster((n, k): (f64, f64)) -> f64 {
    1.0 / (1.0 + n.mul_add(n, k * k)).sqrt()
}

/// The points, fitted or held out; `dips` are held out too.
fn cosines(held_out: bool, dips: &[f64]) -> Vec<f64> {
    if !held_out {
        let count = f64::from(FITTED_COUNT);
        return (0..FITTED_COUNT).map(|i| (f64::from(i) + 0.5) / count).collect();
    }
    let even = (0..=HELD_OUT_COUNT).map(|i| f64::from(i) / f64::from(HELD_OUT_COUNT));
    let grazing = (0..12).map(|i| 10f64.powf(-4.0 + f64::from(i) / 4.0));
    let mut mu: Vec<f64> = even.chain(grazing).chain(dips.iter().copied()).collect();
    mu.sort_by(f64::total_cmp);
    mu.dedup();
    mu
}

/// A member from its curve and from the reflectances at normal incidence and at the edge.
fn member(
    record: &OpticalConstants,
    band: &str,
    mu: Vec<f64>,
    value: Vec<f64>,
    [f_normal, f_edge]: [f64; 2],
) -> Member {
    let rows = mu.len();
    let column = |name: &str, values| Column::new(name, "1", values);
    Member {
        label: format!("{}@{band}", record.name()),
        group: record.material.clone(),
        source: record.source.clone(),
        band: band.to_owned(),
        table: Table {
            columns: vec![
                column("mu", mu),
                column("f_normal", vec![f_normal; rows]),
                column("f_edge", vec![f_edge; rows]),
                column("value", value),
            ],
            origin: format!("reflectance in {band} of {}", record.table.origin),
        },
    }
}
