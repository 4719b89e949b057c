// approximates: footprint_coverage
// about: Gaussian of the exact integral and variance, no constants
// cites: striae

// The Gaussian with the integral and the variance of the exact mean: h^2/4 of the ellipse and 1 of exp(-s^2/2).

fn footprint_coverage(h: f32, s: f32) -> f32 {
    let variance = 1.0 + 0.25 * h * h;
    return exp(-0.5 * s * s / variance) * inverseSqrt(variance);
}
