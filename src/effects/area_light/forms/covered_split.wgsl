// uses: error_function

const HALF_ROOT_PI: f32 = 0.88622692545275801;
const REACH: f32 = 2.5;
// Three Gauss-Legendre nodes, Abramowitz & Stegun, table 25.4.
const NODE: f32 = 0.7745966692;

// As in covered.wgsl, with three nodes to either side of the vertex at which the slices have a kink, or of
// the middle of what is covered if the vertex is outside.
fn lobe_integral(kw: f32, ks: f32, view: vec2<f32>, light: Light) -> f32 {
    let ends = ks * (extent(light) + view.xx);
    let near = max(max(ends.x, -ends.y), 0.0);
    let reach = sqrt(near * near + REACH * REACH);
    let begin = max(ends.x, -reach);
    let end = min(ends.y, reach);
    if !(begin < end) {
        return 0.0;
    }
    let kink = ks * (middle(light) + view.x);
    let between = select(0.5 * (begin + end), kink, begin < kink && kink < end);
    var panel = vec2<f32>(begin, between);
    var total = 0.0;
    var mass = 0.0;
    for (var i = 0u; i < 6u; i++) {
        let half = 0.5 * (panel.y - panel.x);
        let node = select(i, i - 3u, i > 2u);
        let t = 0.5 * (panel.x + panel.y) + half * (NODE * (f32(node) - 1.0));
        let weight = half * select(0.5555555556, 0.8888888889, node == 1u) * exp(-t * t);
        mass += weight;
        total += weight * slice_band(kw, view.y, light, t / ks - view.x);
        if i == 2u {
            panel = vec2<f32>(between, end);
        }
    }
    let whole = HALF_ROOT_PI * (error_function(ends.y) - error_function(ends.x));
    return select(1.0, whole / max(mass, 1e-30), end - begin > 1.0) * total / ks;
}

// w_x of the vertex between the two others.
fn middle(light: Light) -> f32 {
    let x = vec3<f32>(light.a.x, light.b.x, light.c.x)
        / max(vec3<f32>(length(light.a), length(light.b), length(light.c)), vec3<f32>(1e-20));
    return max(min(x.x, x.y), min(max(x.x, x.y), x.z));
}
