//! Sphere and polygon lights over a scratch: how much of the scratch's lobe a light covers.
//!
//! In the frame of a scratch (t along it, b across it, n the normal) light from ω_i to ω_o is weighted
//! by exp(−(kσ)² ξ₁²) sinc²(kW ξ₂/2), ξ = ((ω_i + ω_o)·t, (ω_i + ω_o)·b) (velinov2018 eq. 10 and 3), and
//! the cosine and the solid angle of the light make dξ₁dξ₂ together (eq. 24). So a light of radiance 1
//! contributes
//!
//! I = ∫∫_Ω exp(−ks² ξ₁²) sinc²(kw ξ₂/2) dξ₁dξ₂, sinc u = sin u/u,
//!
//! Ω its image in the disc of direction cosines. Lights radiate to both sides; what lies below the
//! horizon does not count.
//!
//! | symbol | here | unit | meaning |
//! |---|---|---|---|
//! | kW | `kw` | 1 | wavenumber times scratch width |
//! | kσ | `ks` | 1 | wavenumber times radius of the coherence area |
//! | ω_o·t, ω_o·b | `view` | 1 | tangential parts of the direction to the eye |
//! | p | `centre` | that of the radius | centre of a sphere, from the shaded point, as (t, b, n) |
//! | r | `radius` | that of the centre | radius of a sphere |
//! | V − x | `vertices` | any | vertices of a polygon, from the shaded point, as (t, b, n) |
//!
//! A slice ξ₁ = const of the light is made of intervals of ξ₂, whose ends are known in closed form
//! (`sphere`, `polygon`) and whose integral is the band integral; `across` integrates over the
//! slices, and an integral that does not converge is an error. Monte Carlo over the light is the second method (tests/lights).
//!
//! # Forms
//!
//! A form is a light, what is done across the slices and a band integral. Registered are
//!
//! | across | printed | exact Si | lean | medium |
//! |---|---|---|---|---|
//! | single line (eq. 26) | yes | yes | yes | yes |
//! | 3, 5, 7 Gauss–Hermite nodes | yes | | | yes |
//! | 3 nodes of what is covered | | | yes | yes |
//! | 5, 3 + 3 nodes of what is covered | | | | yes |
//!
//! The others are left out since the band no longer decides once it is not the printed one. Over the eight
//! regions the relative L2 error of the single line is 0.086 to 1.44 and that of three covered nodes
//! 0.014 to 0.15; from `medium` to `lean` or to exact Si either changes by 3.3e-4 at most, from `medium`
//! to `printed` that of the line by up to 0.15 and that of three Gauss–Hermite nodes by up to 0.09
//! (`striae report`, error by region). What exact Si changes near the main lobe, 6e-5 at most, is what
//! `band_large` could. Eq. 29 refitted has the text of eq. 29, so that its constants can be passed to the
//! printed forms. Si of 3, 6 and 8 constants lie between eq. 29 and exact Si, and are compared as bands of
//! eq. 27 ([`super::band`]).
//!
//! # Hard cases
//!
//! f32 against f64 of the same text, relative to the value (above 1e-6 of the lobe) and to the most that the
//! lobe can hold, on 6000 spheres and 7200 triangles (tests/lights). In some worst cases the rounding of
//! the arguments alone may change the value by more, and no form in f32 does better:
//! - two vertices on the origin line to 1e-8, where the single line passes the edge between them on one side
//!   or on the other: relative error 133, by rounding of the arguments 498 (row 1067); a vertex on the
//!   line to 6e-9 and at the crest of the lobe: 7.5e-3 of the lobe (row 6645);
//! - triangles seen edge-on to 1e-7, whose orientation is the sign of a volume that is rounding: relative
//!   error of covered nodes 1, by rounding of the arguments 2.2 (row 3426), 3.5e-4 of the lobe (row 3447);
//! - a limb on the origin line: relative error of the single line 2.5, by rounding of the arguments 7 (row 815).
//!
//! In others the form loses digits itself:
//! - `covered_split` with two vertices on the origin line: rounding says whether the middle vertex lies inside
//!   what is covered, that is whether the light gets 3 nodes or 3 + 3, two rules for one integral: 0.16 of
//!   the lobe (row 849), relative error 89 (row 1005);
//! - a sphere below the horizon that hardly rises above it, sin α − |p_z| being a small difference: relative
//!   error of covered nodes 0.026 (row 3638).

mod across;
mod claims;
mod draws;
mod errors;
mod exhibits;
mod hard_cases;
mod hard_exhibit;
mod laws;
mod polygon;
mod regions;
mod sphere;
mod vector;

pub(super) use claims::CLAIMS;
pub(super) use exhibits::exhibits;
pub(super) use hard_cases::HARD_CASES;
pub(super) use laws::LAWS;
pub(super) use regions::REGIONS;

use crate::effect::{DomainError, Scalar, arguments};

/// Name of the reference of sphere lights.
const SPHERE: &str = "sphere_light";
/// Name of the reference of triangle lights.
const TRIANGLE: &str = "triangle_light";

/// What lights give, by name.
pub(super) const REFERENCES: &[(&str, Scalar)] = &[
    (SPHERE, |point| {
        let [kw, ks, view_x, view_y, x, y, z, radius] = arguments(point)?;
        sphere_light(kw, ks, [view_x, view_y], [x, y, z], radius)
    }),
    (TRIANGLE, |point| {
        let [kw, ks, view_x, view_y, rest @ ..]: [f64; 13] = arguments(point)?;
        let [a, b, c] = [0, 3, 6].map(|at| [rest[at], rest[at + 1], rest[at + 2]]);
        polygon_light(kw, ks, [view_x, view_y], &[a, b, c])
    }),
];

/// What a scratch receives from a sphere light of radiance 1; see [the module](self).
///
/// `kw`, `ks`: kW and kσ, 1, positive. `view`: (ω_o·t, ω_o·b), 1. `centre`, `radius`: of one unit of
/// length, `centre` from the shaded point, `radius` positive. Returns I, 1. A shaded point inside the
/// sphere is lit from everywhere. Relative error ≤ 1e-9, or for what is hardly seen error ≤ 1e-12 of the
/// most that the lobe can hold, √π/ks · 2π/(kw + π) (tests/lights).
///
/// # Errors
/// [`DomainError`] for what is not finite or not positive where it has to be, and where the integral
/// across the scratch is not estimated to be that good.
pub fn sphere_light(
    kw: f64,
    ks: f64,
    view: [f64; 2],
    centre: [f64; 3],
    radius: f64,
) -> Result<f64, DomainError> {
    let lobe = lobe(kw, ks, view)?;
    finite("view_x", view[0])?;
    finite("centre", centre[0] + centre[1] + centre[2])?;
    positive("radius", radius)?;
    let distance = vector::length(centre);
    finite("distance", distance)?;
    if distance <= radius {
        lobe.integral(&sphere::hemisphere(view))
    } else {
        lobe.integral(&sphere::Cone::new(centre, (radius / distance).asin(), view))
    }
}

/// What a scratch receives from a simple polygon of radiance 1; see [the module](self).
///
/// `kw`, `ks`: kW and kσ, 1, positive. `view`: (ω_o·t, ω_o·b), 1. `vertices`: at least three, in one
/// plane, around the polygon either way, from the shaded point; what is inside is said by the even–odd
/// rule. Returns I, 1; 0 if the shaded point lies in the plane of the polygon. Relative error ≤ 1e-9,
/// or for what is hardly seen error ≤ 1e-12 of the most that the lobe can hold, √π/ks · 2π/(kw + π)
/// (tests/lights).
///
/// # Errors
/// [`DomainError`] for less than three vertices, for what is not finite or not positive where it has to
/// be, and where the integral across the scratch is not estimated to be that good.
pub fn polygon_light(
    kw: f64,
    ks: f64,
    view: [f64; 2],
    vertices: &[[f64; 3]],
) -> Result<f64, DomainError> {
    let lobe = lobe(kw, ks, view)?;
    finite("view_x", view[0])?;
    let count = vertices.len();
    DomainError::unless(count >= 3, "number of vertices", count as f64, "at least 3")?;
    for vertex in vertices {
        finite("vertex", vertex[0] + vertex[1] + vertex[2])?;
    }
    lobe.integral(&polygon::Outline::new(vertices, view))
}

fn lobe(kw: f64, ks: f64, view: [f64; 2]) -> Result<across::Lobe, DomainError> {
    positive("kw", kw)?;
    positive("ks", ks)?;
    finite("view_y", view[1])?;
    Ok(across::Lobe { kw, ks, view_y: view[1] })
}

fn positive(quantity: &'static str, got: f64) -> Result<f64, DomainError> {
    DomainError::unless(got > 0.0 && got.is_finite(), quantity, got, "positive finite numbers")
}

fn finite(quantity: &'static str, got: f64) -> Result<f64, DomainError> {
    DomainError::unless(got.is_finite(), quantity, got, "finite numbers")
}

#[cfg(test)]
mod tests;
