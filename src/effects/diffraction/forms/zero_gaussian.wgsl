// approximates: sinusoid_zero_order
// about: Gaussian of the phase, 1 constant
// cites: the coherent reflection of a rough surface, as in Bennett & Porteus 1961

// exp(-variance) of the phase, whose variance is phase^2 / 2 for a sinusoid.

override rate: f32 = 0.5;

fn sinusoid_zero_order(phase: f32) -> f32 {
    return exp(-rate * phase * phase);
}
