// approximates: footprint_response
// about: Gaussian of the exact integral and variance, no constants
// cites: striae

// The Gaussian with the integral and the variance of the exact mean: an ellipse has the variance h^2/4 across the
// scratch and exp(-s^2) the variance 1/2. Nothing to fit; right for small footprints only.

fn footprint_response(h: f32, s: f32) -> f32 {
    let variance = 1.0 + 0.5 * h * h;
    return exp(-s * s / variance) * inverseSqrt(variance);
}
