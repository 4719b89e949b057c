// uses: erfc, lobe

// Share of a scratch under exp(-t^2/2 sigma^2): the peak of its amplitude along itself.
fn amplitude_share(sigma_um: f32, begin_um: f32, end_um: f32) -> f32 {
    let scale = 0.7071067812 / sigma_um;
    return inside(scale * begin_um, scale * end_um);
}

// |eta|^2 of a finite scratch over that of the infinite one at xi_1 = 0, as a Gaussian of the exact
// peak and the exact energy. With p = `amplitude_share` and q = the share under exp(-t^2/sigma^2),
// the peak is p^2 and the energy over xi_1 is q (Parseval), so it is
// p^2 exp(-(p^2/q)^2 sigma^2 k^2 xi_1^2): separable as eq. 10, and eq. 10 itself for p = q = 1.
fn matched_along(p: f32, wavelength_um: f32, sigma_um: f32, xi_along: f32, begin_um: f32,
    end_um: f32) -> f32 {
    let q = inside(begin_um / sigma_um, end_um / sigma_um);
    let narrowing = select(1.0, p * p / select(1.0, q, q > 0.0), q > 0.0);
    return p * p * gaussian(2.0 * PI * narrowing * sigma_um / wavelength_um * xi_along);
}
