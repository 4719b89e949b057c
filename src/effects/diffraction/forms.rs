//! Forms of the powers of orders: what the first order assumes, and what a shader can afford.

use super::{FIRST_ORDER, ZERO_ORDER};
use crate::effect::{FormEntry, Source};

/// Forms, the baseline of each reference first.
pub(super) const FORMS: &[FormEntry] = &[
    FormEntry {
        name: "diffraction/zero_first_order",
        description: "1: the mirror is left as it is, no constants",
        citation: "toisoul2017 §3.1, first order of Stam's BRDF",
        path: "src/effects/diffraction/forms/zero_first_order.wgsl",
        source: Source::Written(include_str!("forms/zero_first_order.wgsl")),
        function: ZERO_ORDER.name,
        reference: ZERO_ORDER.name,
    },
    FormEntry {
        name: "diffraction/zero_gaussian",
        description: "Gaussian of the phase, 1 constant",
        citation: "the coherent reflection of a rough surface, as in Bennett & Porteus 1961",
        path: "src/effects/diffraction/forms/zero_gaussian.wgsl",
        source: Source::Written(include_str!("forms/zero_gaussian.wgsl")),
        function: ZERO_ORDER.name,
        reference: ZERO_ORDER.name,
    },
    FormEntry {
        name: "diffraction/zero_quintic",
        description: "square of a quintic in a^2, 5 constants",
        citation: "striae",
        path: "src/effects/diffraction/forms/zero_quintic.wgsl",
        source: Source::Written(include_str!("forms/zero_quintic.wgsl")),
        function: ZERO_ORDER.name,
        reference: ZERO_ORDER.name,
    },
    FormEntry {
        name: "diffraction/one_first_order",
        description: "a^2/4, no constants",
        citation: "toisoul2017 §3.1, first order of Stam's BRDF",
        path: "src/effects/diffraction/forms/one_first_order.wgsl",
        source: Source::Written(include_str!("forms/one_first_order.wgsl")),
        function: FIRST_ORDER.name,
        reference: FIRST_ORDER.name,
    },
    FormEntry {
        name: "diffraction/one_damped",
        description: "a^2/4 damped by a Gaussian, 1 constant",
        citation: "striae",
        path: "src/effects/diffraction/forms/one_damped.wgsl",
        source: Source::Written(include_str!("forms/one_damped.wgsl")),
        function: FIRST_ORDER.name,
        reference: FIRST_ORDER.name,
    },
    FormEntry {
        name: "diffraction/one_quintic",
        description: "square of a times a quintic in a^2, 5 constants",
        citation: "striae",
        path: "src/effects/diffraction/forms/one_quintic.wgsl",
        source: Source::Written(include_str!("forms/one_quintic.wgsl")),
        function: FIRST_ORDER.name,
        reference: FIRST_ORDER.name,
    },
];
