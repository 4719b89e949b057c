// Chord of the ellipse at offset s over 2 A_P / (pi sigma): sqrt(h^2 - s^2) / h^2, 0 outside. As a product, so
// that the rim keeps its digits; the floor makes an empty footprint 0 and not 0/0.
fn chord(h: f32, s: f32) -> f32 {
    return sqrt(max((h - s) * (h + s), 0.0)) / max(h * h, 1e-30);
}
