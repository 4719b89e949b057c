// approximates: sinusoid_first_order
// about: a^2/4, no constants
// cites: toisoul2017 §3.1, first order of Stam's BRDF

// exp(-i phi) = 1 - i phi: half of the amplitude of the phase to either side.

fn sinusoid_first_order(phase: f32) -> f32 {
    return 0.25 * phase * phase;
}
