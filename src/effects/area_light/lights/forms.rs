//! The approximations, as registered: a light cut into slices, what is done across the slices, and a
//! band integral along them, put together from shared pieces.

use crate::effect::{FormEntry, Source};

/// A band integral: printed with a form of Si, or without cancellation.
macro_rules! band {
    (printed) => {
        concat!(
            include_str!("../band/forms/printed.wgsl"),
            include_str!("../../sine_integral/forms/published.wgsl")
        )
    };
    (exact_si) => {
        concat!(
            include_str!("../band/forms/printed.wgsl"),
            include_str!("../../sine_integral/forms/auxiliary_large.wgsl"),
            include_str!("../../sine_integral/forms/phase.wgsl")
        )
    };
    (lean) => {
        concat!(
            include_str!("../band/forms/band_lean.wgsl"),
            include_str!("../band/forms/complement.wgsl"),
            include_str!("../band/forms/rule_of_four.wgsl"),
            include_str!("../band/forms/band_phase.wgsl")
        )
    };
    (medium) => {
        concat!(
            include_str!("../band/forms/band_medium.wgsl"),
            include_str!("../band/forms/complement.wgsl"),
            include_str!("../band/forms/rule_of_four.wgsl"),
            include_str!("../band/forms/band_phase.wgsl")
        )
    };
}

/// What is done across the slices.
macro_rules! across {
    (line, $light:literal) => {
        include_str!("forms/line.wgsl")
    };
    (hermite_three, $light:literal) => {
        concat!(include_str!("forms/hermite.wgsl"), include_str!("forms/hermite_three.wgsl"))
    };
    (hermite_five, $light:literal) => {
        concat!(include_str!("forms/hermite.wgsl"), include_str!("forms/hermite_five.wgsl"))
    };
    (hermite_seven, $light:literal) => {
        concat!(include_str!("forms/hermite.wgsl"), include_str!("forms/hermite_seven.wgsl"))
    };
    (covered_three, $light:literal) => {
        concat!(
            include_str!("forms/covered.wgsl"),
            include_str!("forms/covered_three.wgsl"),
            include_str!("forms/error_function.wgsl"),
            include_str!(concat!("forms/", $light, "_extent.wgsl"))
        )
    };
    (covered_five, $light:literal) => {
        concat!(
            include_str!("forms/covered.wgsl"),
            include_str!("forms/covered_five.wgsl"),
            include_str!("forms/error_function.wgsl"),
            include_str!(concat!("forms/", $light, "_extent.wgsl"))
        )
    };
    (covered_split, $light:literal) => {
        concat!(
            include_str!("forms/covered_split.wgsl"),
            include_str!("forms/error_function.wgsl"),
            include_str!(concat!("forms/", $light, "_extent.wgsl"))
        )
    };
}

macro_rules! form {
    ($light:literal, $across:ident, $band:ident, $description:literal, $citation:expr) => {
        form!($light, $across, $band, $light, $description, $citation, "_light.wgsl")
    };
    ($light:literal, $across:ident, $band:ident, $prefix:literal, $description:literal,
     $citation:expr, $end:literal) => {
        FormEntry {
            name: concat!("area_light/", $prefix, "_", stringify!($across), "_", stringify!($band)),
            description: $description,
            citation: $citation,
            path: concat!("src/effects/area_light/lights/forms/", $light, $end),
            source: Source::Written(concat!(
                include_str!(concat!("forms/", $light, $end)),
                include_str!(concat!("forms/", $light, ".wgsl")),
                across!($across, $light),
                band!($band)
            )),
            function: concat!($light, "_light"),
            reference: concat!($light, "_light"),
        }
    };
}

const LINE: &str = "velinov2018 eq. 27 with eq. 29; both roots of eq. 35 and 40 right";
const NODES: &str = "striae; Gauss-Hermite quadrature, Abramowitz & Stegun 25.4.46";
const COVERED: &str = "striae; Gauss-Legendre quadrature, Abramowitz & Stegun 25.4.29";

/// Forms of both lights, the published ones first.
pub(in super::super) const FORMS: [FormEntry; 28] = [
    form!("sphere", line, printed, "the slice through the origin line; published Si", LINE),
    form!(
        "sphere",
        line,
        exact_si,
        "the slice through the origin line; Si to the rounding of f32",
        LINE
    ),
    form!(
        "sphere",
        line,
        lean,
        "the slice through the origin line; bands without cancellation, lean",
        LINE
    ),
    form!(
        "sphere",
        line,
        medium,
        "the slice through the origin line; bands without cancellation",
        LINE
    ),
    form!("sphere", hermite_three, printed, "three Gauss-Hermite slices; published Si", NODES),
    form!(
        "sphere",
        hermite_three,
        medium,
        "three Gauss-Hermite slices; bands without cancellation",
        NODES
    ),
    form!("sphere", hermite_five, printed, "five Gauss-Hermite slices; published Si", NODES),
    form!(
        "sphere",
        hermite_five,
        medium,
        "five Gauss-Hermite slices; bands without cancellation",
        NODES
    ),
    form!("sphere", hermite_seven, printed, "seven Gauss-Hermite slices; published Si", NODES),
    form!(
        "sphere",
        hermite_seven,
        medium,
        "seven Gauss-Hermite slices; bands without cancellation",
        NODES
    ),
    form!(
        "sphere",
        covered_three,
        lean,
        "three slices of what the light covers of the lobe; bands without cancellation, lean",
        COVERED
    ),
    form!(
        "sphere",
        covered_three,
        medium,
        "three slices of what the light covers of the lobe; bands without cancellation",
        COVERED
    ),
    form!(
        "sphere",
        covered_five,
        medium,
        "five slices of what the light covers of the lobe; bands without cancellation",
        COVERED
    ),
    form!(
        "sphere",
        line,
        printed,
        "disc",
        "the slice through the origin line, the disc of eq. 31 in place of the silhouette; published Si",
        LINE,
        "_light_disc.wgsl"
    ),
    form!("triangle", line, printed, "the slice through the origin line; published Si", LINE),
    form!(
        "triangle",
        line,
        exact_si,
        "the slice through the origin line; Si to the rounding of f32",
        LINE
    ),
    form!(
        "triangle",
        line,
        lean,
        "the slice through the origin line; bands without cancellation, lean",
        LINE
    ),
    form!(
        "triangle",
        line,
        medium,
        "the slice through the origin line; bands without cancellation",
        LINE
    ),
    form!("triangle", hermite_three, printed, "three Gauss-Hermite slices; published Si", NODES),
    form!(
        "triangle",
        hermite_three,
        medium,
        "three Gauss-Hermite slices; bands without cancellation",
        NODES
    ),
    form!("triangle", hermite_five, printed, "five Gauss-Hermite slices; published Si", NODES),
    form!(
        "triangle",
        hermite_five,
        medium,
        "five Gauss-Hermite slices; bands without cancellation",
        NODES
    ),
    form!("triangle", hermite_seven, printed, "seven Gauss-Hermite slices; published Si", NODES),
    form!(
        "triangle",
        hermite_seven,
        medium,
        "seven Gauss-Hermite slices; bands without cancellation",
        NODES
    ),
    form!(
        "triangle",
        covered_three,
        lean,
        "three slices of what the light covers of the lobe; bands without cancellation, lean",
        COVERED
    ),
    form!(
        "triangle",
        covered_three,
        medium,
        "three slices of what the light covers of the lobe; bands without cancellation",
        COVERED
    ),
    form!(
        "triangle",
        covered_five,
        medium,
        "five slices of what the light covers of the lobe; bands without cancellation",
        COVERED
    ),
    form!(
        "triangle",
        covered_split,
        medium,
        "three slices to either side of the middle vertex of what the light covers of the lobe; bands \
         without cancellation",
        COVERED
    ),
];
