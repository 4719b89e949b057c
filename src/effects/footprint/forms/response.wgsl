const RESPONSE_ASYMPTOTE: f32 = 1.2732395447351628;

// The mean of exp(-s^2) tends to 2/sqrt(pi) sqrt(h^2 - s^2) / h^2.
fn footprint_response(h: f32, s: f32) -> f32 {
    return soft_chord(h, s, RESPONSE_ASYMPTOTE);
}
