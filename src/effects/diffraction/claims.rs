//! Claims of toisoul2017 on the table and its use, recomputed.

use std::f64::consts::{PI, TAU};

use nalgebra::Vector3;

use super::exhibits::{
    GREEN_NM, PAPER, cosine_error, disc_in_white_sky, even_table, fixed_cosine_error,
    mirror_by_stam, rule_errors, zero_order_error,
};
use super::preparation::{USUAL, prepared};
use super::surfaces::{Patch, holographic_paper};
use super::table::{NORMAL, TableShape, of_surface, relative_l2};
use super::{DiffractionError, sinusoid_order_power};
use crate::effect::claim::ClaimCheck;
use crate::effect::{Candidates, ClaimError, Found};
use crate::factor::Decomposition;
use crate::measured::spectra::Spectra;

/// Checks of the claims, by name.
pub(super) const CLAIMS: &[(&str, ClaimCheck<Candidates>)] = &[
    ("prefactor", prefactor),
    ("one_wavelength", one_wavelength),
    ("white_sky", white_sky),
    ("mirror", mirror),
    ("fixed_cosine", fixed_cosine),
    ("reflection", reflection),
    ("cross_terms", cross_terms),
    ("fresnel", fresnel),
];

fn percent(values: [f64; 3]) -> String {
    values.map(|v| format!("{:.1}", 100.0 * v)).join(", ")
}

fn prefactor(_: &Candidates) -> Result<Found, ClaimError> {
    let phase = TAU / GREEN_NM * NORMAL * 20.0;
    let shallow = 0.25 * phase * phase;
    let exact = sinusoid_order_power(1, phase)?;
    let found = format!(
        "if I is the power spectrum |P|²/A of the phase screen, which is what a camera records, the \
         prefactor is F² G/(w² λ²) and 4π² = {:.1} is too much; if I is that of the heights, |H|²/A, \
         it is 4π² F² G/λ⁴, with two more powers of λ. With k² w² |H|² a sinusoid of 20 nm at \
         {GREEN_NM} nm has {shallow:.4} in a first order (J_1² = {exact:.4})",
        4.0 * PI.powi(2)
    );
    Ok(Found::new(found, "does not hold"))
}

fn one_wavelength(_: &Candidates) -> Result<Found, ClaimError> {
    let spectra = Spectra::built_in()?;
    let (shallow, deep) = (rule_errors(20.0, &spectra)?, rule_errors(120.0, &spectra)?);
    let found = format!(
        "exact for an amplitude grating only. Rectangular gratings of 1.6 µm recorded at {GREEN_NM} \
         nm, relative L2 error of the orders in R, G, B: 20 nm deep {} % by λ⁻² and {} % by λ⁻⁴; \
         120 nm deep {} % and {} %",
        percent(shallow.square),
        percent(shallow.fourth),
        percent(deep.square),
        percent(deep.fourth)
    );
    Ok(Found::new(found, "differs"))
}

fn white_sky(_: &Candidates) -> Result<Found, ClaimError> {
    let shares: Vec<String> = disc_in_white_sky(&[0.5, 0.9])?
        .into_iter()
        .map(|disc| {
            let even = even_table(disc.half_width);
            format!(
                "{:.3} of an even table and {:.3} of a disc's up to {}, by eq. 3 {:.3} and {:.3}",
                even.printed,
                disc.printed,
                disc.half_width,
                even.with_solid_angle,
                disc.with_solid_angle
            )
        })
        .collect();
    let found = format!(
        "Σ S_d ΔA comes back of a white sky. The printed sum, which has neither the area of a texel nor \
         dω_i = dh_x dh_y/cos θ_i, gives {}. Alg. 1 divides by the sum of the weights, which hides it in \
         a white sky and nowhere else",
        shares.join("; ")
    );
    Ok(Found::new(found, "does not hold"))
}

fn mirror(_: &Candidates) -> Result<Found, ClaimError> {
    let at = |degrees: f64| format!("{:.3} at {degrees}°", mirror_by_stam(degrees.to_radians()));
    let found = format!(
        "beside a table at w = 2 the factor is cos²θ for the mirror, which loses nothing at any angle: \
         {}, {}. With w² in place of 4 it is 1; over all directions it does not conserve either",
        at(45.0),
        at(51.7)
    );
    Ok(Found::new(found, "does not hold"))
}

fn fixed_cosine(_: &Candidates) -> Result<Found, ClaimError> {
    let rings: Vec<String> = fixed_cosine_error()?
        .iter()
        .map(|r| format!("{:.1} % for |h| from {} to {}", 100.0 * r.2, r.0, r.1))
        .collect();
    let found = format!(
        "w² for a shallow relief only. Pits 120 nm deep at {GREEN_NM} nm: {:.1} % in every order but the \
         zero order at 43.4°, {:.1} % at 60°; in the zero order of half duty {:.1} % and {:.1} %; a disc's table at w = 2 against one with each texel's own w, relative \
         L2 error: {}",
        100.0 * cosine_error(120.0, 43.4_f64.to_radians()),
        100.0 * cosine_error(120.0, 60.0_f64.to_radians()),
        100.0 * zero_order_error(120.0, 43.4_f64.to_radians()),
        100.0 * zero_order_error(120.0, 60.0_f64.to_radians()),
        rings.join(", ")
    );
    Ok(Found::new(found, "differs"))
}

fn reflection(_: &Candidates) -> Result<Found, ClaimError> {
    let eye = Vector3::new(0.0, 0.0, 1.0);
    let (hx, hy) = (0.3_f64, 0.2_f64);
    let half = Vector3::new(hx, hy, 1.0 + (1.0 - hx * hx - hy * hy).sqrt()).normalize();
    let printed = eye - half * (2.0 * eye.dot(&half));
    let mirrored = -printed;
    let found = format!(
        "for h = ({hx}, {hy}) the printed ω_i is ({:.3}, {:.3}, {:.3}), below the surface; \
         2(ω_o·h)h − ω_o is ({:.3}, {:.3}, {:.3}), whose projection is h",
        printed.x, printed.y, printed.z, mirrored.x, mirrored.y, mirrored.z
    );
    Ok(Found::new(found, "does not hold"))
}

/// Eq. 10 sums over ranks outside and eq. 11 again inside: (Σ_m u_m)(Σ_n v_n)ᵀ in place of Σ_m u_m v_mᵀ.
fn cross_terms(_: &Candidates) -> Result<Found, ClaimError> {
    let patch = Patch { samples: 128, side_um: 25.6, line: false };
    let surface = prepared(&holographic_paper(PAPER, patch), USUAL)?;
    let shape = TableShape::at(GREEN_NM, [65, 65], 1.0);
    let grid = of_surface(&surface, &shape, 2, NORMAL, &Spectra::built_in()?)?.grid;
    let decomposition = Decomposition::of(&grid).map_err(DiffractionError::from)?;
    // Both kernels are of the same orthogonal terms, so that the share of the table's norm in one is
    // what it leaves of the table: 1 − e².
    let error = |rank: usize| -> Result<f64, DiffractionError> {
        let wanted = decomposition.low_rank(rank)?;
        let left: f64 = wanted.relative_errors(&grid)?.into_iter().sum();
        let printed = wanted.cross_rank_printed().product()?;
        Ok(relative_l2(&printed, &wanted.product()?) * (1.0 - left * left).sqrt())
    };
    let found = format!(
        "both sums run over all ranks, which gives (Σ_m f_v,m)(Σ_n f_h,n) and terms of mixed ranks; \
         the inner one belongs inside, one intermediate picture per rank. For the table of a \
         simulated holographic paper they are {:.2} of its norm at rank 2 and {:.2} at rank 3",
        error(2)?,
        error(3)?
    );
    Ok(Found::new(found, "does not hold"))
}

fn fresnel(_: &Candidates) -> Result<Found, ClaimError> {
    let found = "Stam's F multiplies amplitudes; Schlick's F_0 is a reflectance and enters once. \
                 Squared, a dielectric of F_0 = 0.04 reflects 0.0016, a 25th, and aluminium of 0.91 \
                 reflects 0.83";
    Ok(Found::new(found, "differs"))
}
