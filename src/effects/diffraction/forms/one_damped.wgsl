// approximates: sinusoid_first_order
// about: a^2/4 damped by a Gaussian, 1 constant
// cites: striae

// The first order, damped as the mirror is: J_1(a)^2 = a^2/4 (1 - a^2/4 + ...).

override rate: f32 = 0.25;

fn sinusoid_first_order(phase: f32) -> f32 {
    let s = phase * phase;
    return 0.25 * s * exp(-rate * s);
}
