//! The approximations, as registered.

use crate::effect::{FormEntry, Source};

macro_rules! written {
    ($name:literal, $reference:literal, $description:literal, $citation:literal) => {
        FormEntry {
            name: concat!("fresnel/", $name),
            description: $description,
            citation: $citation,
            path: concat!("src/effects/fresnel/forms/", $name, ".wgsl"),
            source: Source::Written(include_str!(concat!("forms/", $name, ".wgsl"))),
            function: $name,
            reference: $reference,
        }
    };
}

pub(super) const FORMS: &[FormEntry] = &[
    written!(
        "schlick",
        "fresnel_conductor",
        "fifth power of 1 - mu; nothing free",
        "Schlick, Computer Graphics Forum 13(3), 1994, eq. 15"
    ),
    written!(
        "schlick_exponent",
        "fresnel_conductor",
        "Schlick with the power fitted",
        "after Schlick 1994"
    ),
    written!(
        "spherical_gaussian",
        "fresnel_conductor",
        "Schlick with a spherical Gaussian for the power",
        "Karis, Real Shading in Unreal Engine 4, SIGGRAPH course 2013"
    ),
    written!(
        "spherical_gaussian_weight",
        "schlick_weight",
        "the spherical Gaussian alone, in place of (1 - mu)^5",
        "Karis, Real Shading in Unreal Engine 4, SIGGRAPH course 2013"
    ),
    written!(
        "lazanyi",
        "fresnel_conductor",
        "Schlick less an error term a mu (1 - mu)^alpha",
        "Lazanyi & Szirmay-Kalos, Fresnel term approximations for metals, WSCG 2005"
    ),
    written!(
        "f_tint",
        "fresnel_conductor",
        "Lazanyi with alpha = 6 and a tint of the value at 82 degrees",
        "Hoffman, Fresnel equations considered harmful, 2019; Kutz, Hasan & Edmondson, \
         Novel aspects of the Adobe Standard Material, 2021"
    ),
    written!(
        "f_edge",
        "fresnel_conductor",
        "Lazanyi with alpha = 6, exact at 82 degrees; nothing free",
        "Hoffman, Fresnel equations considered harmful, 2019"
    ),
    written!(
        "gulbrandsen",
        "fresnel_conductor",
        "reflectivity and edge tint to n and k, high-index conductor formulas, as listed",
        "Gulbrandsen, Artist friendly metallic Fresnel, JCGT 3(4), 2014"
    ),
    written!(
        "gulbrandsen_exact",
        "fresnel_conductor",
        "reflectivity and edge tint to n and k, conductor formulas in full",
        "Gulbrandsen, Artist friendly metallic Fresnel, JCGT 3(4), 2014; Born & Wolf 14.2"
    ),
    written!(
        "rational",
        "fresnel_conductor",
        "(1 - mu)^2 (1 + a mu)/(1 + b mu + c mu^2): one division, no power",
        "striae, from the high-index limit of the conductor formulas"
    ),
    written!(
        "rational_tied",
        "fresnel_conductor",
        "the same with c tied to a and b",
        "striae, from the high-index limit of the conductor formulas"
    ),
];
