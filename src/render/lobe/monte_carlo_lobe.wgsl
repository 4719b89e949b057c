// exp(-(ks xi_1)^2) sinc^2(kw xi_2 / 2). The phase is reduced by half turns, exactly, since WGSL
// promises nothing for the sine of a large argument.
fn diffraction(kw: f32, ks: f32, xi: vec2<f32>) -> f32 {
    let g = ks * xi.x;
    let half_turns = kw * xi.y * 0.15915494309189535;
    let rest = half_turns - round(half_turns);
    let phase = half_turns * 3.141592653589793;
    let sinc = select(sin(rest * 3.141592653589793) / phase, 1.0, abs(phase) < 1e-4);
    return exp(-g * g) * sinc * sinc;
}
