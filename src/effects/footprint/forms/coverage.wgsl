const COVERAGE_ASYMPTOTE: f32 = 2.5464790894703255;

// The mean of exp(-s^2/2) tends to sqrt(8/pi) sqrt(h^2 - s^2) / h^2.
fn footprint_coverage(h: f32, s: f32) -> f32 {
    return soft_chord(h, s, COVERAGE_ASYMPTOTE);
}
