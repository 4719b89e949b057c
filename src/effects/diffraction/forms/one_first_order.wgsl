// exp(-i phi) = 1 - i phi: half of the amplitude of the phase to either side.

fn sinusoid_first_order(phase: f32) -> f32 {
    return 0.25 * phase * phase;
}
