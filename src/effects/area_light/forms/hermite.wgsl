// Gauss-Hermite quadrature across xi_1 = t/ks.
fn lobe_integral(kw: f32, ks: f32, view: vec2<f32>, light: Light) -> f32 {
    var total = 0.0;
    for (var i = 0u; i < NODE_COUNT; i++) {
        total += WEIGHTS[i] * slice_band(kw, view.y, light, NODES[i] / ks - view.x);
    }
    return total / ks;
}
