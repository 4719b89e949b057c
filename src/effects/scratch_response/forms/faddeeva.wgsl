// uses: lobe

fn product(a: vec2<f32>, b: vec2<f32>) -> vec2<f32> {
    return vec2<f32>(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}

fn reciprocal(a: vec2<f32>) -> vec2<f32> {
    return vec2<f32>(a.x, -a.y) / (a.x * a.x + a.y * a.y);
}

// Faddeeva's w(z) = exp(-z^2) erfc(-iz) for Im z >= 0, error 1.3e-7: Weideman, SIAM J. Numer. Anal.
// 31(5), 1994, eq. 38 with N = 16, a polynomial in (L + iz)/(L - iz) with L = 2^(-1/4) sqrt(N).
fn faddeeva(z: vec2<f32>) -> vec2<f32> {
    let scale = 3.3635856610;
    let inverse = reciprocal(vec2<f32>(scale + z.y, -z.x));
    let mapped = product(vec2<f32>(scale - z.y, z.x), inverse);
    var p = vec2<f32>(9.939322536e-07, 0.0);
    p = product(p, mapped) + vec2<f32>(3.981287575e-06, 0.0);
    p = product(p, mapped) + vec2<f32>(-5.584233411e-06, 0.0);
    p = product(p, mapped) + vec2<f32>(-2.734640462e-05, 0.0);
    p = product(p, mapped) + vec2<f32>(2.170986793e-05, 0.0);
    p = product(p, mapped) + vec2<f32>(2.107105640e-04, 0.0);
    p = product(p, mapped) + vec2<f32>(8.703158428e-05, 0.0);
    p = product(p, mapped) + vec2<f32>(-1.527659740e-03, 0.0);
    p = product(p, mapped) + vec2<f32>(-3.881015189e-03, 0.0);
    p = product(p, mapped) + vec2<f32>(3.682567317e-03, 0.0);
    p = product(p, mapped) + vec2<f32>(5.182240243e-02, 0.0);
    p = product(p, mapped) + vec2<f32>(1.912417267e-01, 0.0);
    p = product(p, mapped) + vec2<f32>(4.692909009e-01, 0.0);
    p = product(p, mapped) + vec2<f32>(8.864478302e-01, 0.0);
    p = product(p, mapped) + vec2<f32>(1.362240822e+00, 0.0);
    p = product(p, mapped) + vec2<f32>(1.748395886e+00, 0.0);
    return product(2.0 * product(p, inverse) + vec2<f32>(0.5641895835, 0.0), inverse);
}

// exp(-b^2) erf(a + ib), a = t/sqrt 2, b = q/sqrt 2: t an end of the scratch over sigma,
// q = sigma k xi_1, `turns` = q t/(2 pi). No factor overflows.
fn scaled_error_function(q: f32, t: f32, turns: f32) -> vec2<f32> {
    let side = select(1.0, -1.0, t < 0.0);
    let phase = -2.0 * PI * (turns - round(turns));
    let rest = gaussian(0.7071067812 * t) * product(vec2<f32>(cos(phase), sin(phase)),
        faddeeva(0.7071067812 * vec2<f32>(-side * q, abs(t))));
    return side * (vec2<f32>(gaussian(0.7071067812 * q), 0.0) - rest);
}

// |eta|^2 of eq. 5 over 2 pi sigma^2 exp(-s_b^2/sigma^2).
fn along_square(wavelength_um: f32, sigma_um: f32, xi_along: f32, begin_um: f32, end_um: f32) -> f32 {
    // Beyond 13 sigma the window is below the smallest f32, and phases need not be known.
    let begin = clamp(begin_um / sigma_um, -14.0, 14.0);
    let end = clamp(end_um / sigma_um, -14.0, 14.0);
    let wave = sigma_um / wavelength_um * xi_along;
    let q = 2.0 * PI * wave;
    let eta = 0.5 * (scaled_error_function(q, end, wave * end)
        - scaled_error_function(q, begin, wave * begin));
    return dot(eta, eta);
}
