// exp(-i phi) = 1 - i phi: what goes into the orders is not missed in the mirror.

fn sinusoid_zero_order(phase: f32) -> f32 {
    return 1.0;
}
