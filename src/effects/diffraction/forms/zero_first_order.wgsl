// approximates: sinusoid_zero_order
// about: 1: the mirror is left as it is, no constants
// cites: toisoul2017 §3.1, first order of Stam's BRDF

// exp(-i phi) = 1 - i phi: what goes into the orders is not missed in the mirror.

fn sinusoid_zero_order(phase: f32) -> f32 {
    return 1.0;
}
