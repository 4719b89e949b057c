// uses: error_function

const HALF_ROOT_PI: f32 = 0.88622692545275801;

// Gauss-Legendre nodes across the part of the Gaussian that the light covers, t = ks xi_1. Their
// weights are scaled so that a light of even slices gets the integral of the Gaussian over its whole
// extent; over a short part, where that would be a small difference, they are right as they are.
fn lobe_integral(kw: f32, ks: f32, view: vec2<f32>, light: Light) -> f32 {
    let ends = ks * (extent(light) + view.xx);
    let near = max(max(ends.x, -ends.y), 0.0);
    let reach = sqrt(near * near + REACH * REACH);
    let begin = max(ends.x, -reach);
    let to = min(ends.y, reach);
    if !(begin < to) {
        return 0.0;
    }
    let half = 0.5 * (to - begin);
    var total = 0.0;
    var mass = 0.0;
    for (var i = 0u; i < NODE_COUNT; i++) {
        let t = 0.5 * (begin + to) + half * NODES[i];
        let weight = WEIGHTS[i] * exp(-t * t);
        mass += weight;
        total += weight * slice_band(kw, view.y, light, t / ks - view.x);
    }
    let whole = HALF_ROOT_PI * (error_function(ends.y) - error_function(ends.x));
    return select(half, whole / max(mass, 1e-30), half > 0.5) * total / ks;
}
