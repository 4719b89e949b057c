//! The forms of the effect: what renderers ship, its repairs, and the soft chords.

use super::{COVERAGE, END, RESPONSE};
use crate::effect::{FormEntry, Source};

/// Forms, the baseline of each reference first.
pub(super) const FORMS: &[FormEntry] = &[
    FormEntry {
        name: "footprint/eq16",
        description: "velinov2018 eq. 16 with the factor pi that its second term lacks: chord and centre value blended by A_P/A_C",
        citation: "velinov2018 eq. 16, corrected",
        path: "src/effects/footprint/forms/eq16.wgsl",
        source: Source::Written(concat!(
            include_str!("forms/eq16.wgsl"),
            include_str!("forms/chord.wgsl")
        )),
        function: RESPONSE.name,
        reference: RESPONSE.name,
    },
    FormEntry {
        name: "footprint/eq16_printed",
        description: "velinov2018 eq. 16 as printed",
        citation: "velinov2018 eq. 16",
        path: "src/effects/footprint/forms/eq16_printed.wgsl",
        source: Source::Written(concat!(
            include_str!("forms/eq16_printed.wgsl"),
            include_str!("forms/chord.wgsl")
        )),
        function: RESPONSE.name,
        reference: RESPONSE.name,
    },
    FormEntry {
        name: "footprint/blend_area",
        description: "eq. 16 with another blending factor of A_P/A_C, 1 constant",
        citation: "striae",
        path: "src/effects/footprint/forms/blend_area.wgsl",
        source: Source::Written(concat!(
            include_str!("forms/blend_area.wgsl"),
            include_str!("forms/chord.wgsl")
        )),
        function: RESPONSE.name,
        reference: RESPONSE.name,
    },
    FormEntry {
        name: "footprint/blend_half_extent",
        description: "eq. 16 blended by the half-extent across the scratch, 1 constant",
        citation: "striae",
        path: "src/effects/footprint/forms/blend_half_extent.wgsl",
        source: Source::Written(concat!(
            include_str!("forms/blend_half_extent.wgsl"),
            include_str!("forms/chord.wgsl")
        )),
        function: RESPONSE.name,
        reference: RESPONSE.name,
    },
    FormEntry {
        name: "footprint/matched_gaussian",
        description: "Gaussian of the exact integral and variance, no constants",
        citation: "striae",
        path: "src/effects/footprint/forms/matched_gaussian.wgsl",
        source: Source::Written(include_str!("forms/matched_gaussian.wgsl")),
        function: RESPONSE.name,
        reference: RESPONSE.name,
    },
    FormEntry {
        name: "footprint/softplus_chord",
        description: "chord with a soft rim, square root of a softplus of a parabola, 9 constants",
        citation: "striae",
        path: "src/effects/footprint/forms/softplus_chord.wgsl",
        source: Source::Written(concat!(
            include_str!("forms/softplus_chord.wgsl"),
            include_str!("forms/response.wgsl")
        )),
        function: RESPONSE.name,
        reference: RESPONSE.name,
    },
    FormEntry {
        name: "footprint/soft_chord",
        description: "chord with a soft rim, one exponential and no logarithm, 10 constants",
        citation: "striae",
        path: "src/effects/footprint/forms/soft_chord.wgsl",
        source: Source::Written(concat!(
            include_str!("forms/soft_chord.wgsl"),
            include_str!("forms/response.wgsl")
        )),
        function: RESPONSE.name,
        reference: RESPONSE.name,
    },
    FormEntry {
        name: "footprint/coverage_blend_area",
        description: "eq. 18 with the correction of eq. 16 for small footprints",
        citation: "velinov2018 eq. 18, corrected as eq. 16",
        path: "src/effects/footprint/forms/coverage_blend_area.wgsl",
        source: Source::Written(concat!(
            include_str!("forms/coverage_blend_area.wgsl"),
            include_str!("forms/chord.wgsl")
        )),
        function: COVERAGE.name,
        reference: COVERAGE.name,
    },
    FormEntry {
        name: "footprint/coverage_eq18",
        description: "velinov2018 eq. 18 as printed: the contained length",
        citation: "velinov2018 eq. 18",
        path: "src/effects/footprint/forms/coverage_eq18.wgsl",
        source: Source::Written(concat!(
            include_str!("forms/coverage_eq18.wgsl"),
            include_str!("forms/chord.wgsl")
        )),
        function: COVERAGE.name,
        reference: COVERAGE.name,
    },
    FormEntry {
        name: "footprint/coverage_blend_half_extent",
        description: "eq. 18 corrected by the half-extent across the scratch, 1 constant",
        citation: "striae",
        path: "src/effects/footprint/forms/coverage_blend_half_extent.wgsl",
        source: Source::Written(concat!(
            include_str!("forms/coverage_blend_half_extent.wgsl"),
            include_str!("forms/chord.wgsl")
        )),
        function: COVERAGE.name,
        reference: COVERAGE.name,
    },
    FormEntry {
        name: "footprint/coverage_matched_gaussian",
        description: "Gaussian of the exact integral and variance, no constants",
        citation: "striae",
        path: "src/effects/footprint/forms/coverage_matched_gaussian.wgsl",
        source: Source::Written(include_str!("forms/coverage_matched_gaussian.wgsl")),
        function: COVERAGE.name,
        reference: COVERAGE.name,
    },
    FormEntry {
        name: "footprint/coverage_soft_chord",
        description: "chord with a soft rim, one exponential and no logarithm, 10 constants",
        citation: "striae",
        path: "src/effects/footprint/forms/soft_chord.wgsl",
        source: Source::Written(concat!(
            include_str!("forms/soft_chord.wgsl"),
            include_str!("forms/coverage.wgsl")
        )),
        function: COVERAGE.name,
        reference: COVERAGE.name,
    },
    FormEntry {
        name: "footprint/end_contained",
        description: "eq. 16 with the part of the chord past the end",
        citation: "velinov2018 eq. 16, corrected",
        path: "src/effects/footprint/forms/end_contained.wgsl",
        source: Source::Written(concat!(
            include_str!("forms/end_contained.wgsl"),
            include_str!("forms/chord.wgsl")
        )),
        function: END.name,
        reference: END.name,
    },
    FormEntry {
        name: "footprint/end_ramp",
        description: "soft chord times a ramp of two square roots, 2 constants of its own",
        citation: "striae",
        path: "src/effects/footprint/forms/end_ramp.wgsl",
        source: Source::Written(concat!(
            include_str!("forms/end_ramp.wgsl"),
            include_str!("forms/soft_chord.wgsl"),
            include_str!("forms/response.wgsl")
        )),
        function: END.name,
        reference: END.name,
    },
];
