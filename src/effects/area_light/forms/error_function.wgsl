// Abramowitz & Stegun 7.1.26, maximal error 1.5e-7.
fn error_function(t: f32) -> f32 {
    let u = abs(t);
    let v = 1.0 / (1.0 + 0.3275911 * u);
    let tail = v * (0.254829592 + v * (-0.284496736 + v * (1.421413741
        + v * (-1.453152027 + v * 1.061405429))));
    return sign(t) * (1.0 - tail * exp(-min(u * u, 80.0)));
}
