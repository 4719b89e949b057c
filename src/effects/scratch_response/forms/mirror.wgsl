// uses: lobe

// |B|^2/(pi sigma^2 lambda^2) of the smooth mirror.
fn mirror_reflectance(wavelength_um: f32, sigma_um: f32, xi_along: f32, xi_across: f32) -> f32 {
    let wave = sigma_um / wavelength_um;
    return 4.0 * PI * wave * wave * gaussian(2.0 * PI * wave * xi_along)
        * gaussian(2.0 * PI * wave * xi_across);
}

// |S|^2/(pi sigma^2 lambda^2) of an infinite scratch.
fn lobe(width_um: f32, wavelength_um: f32, sigma_um: f32, xi_along: f32, xi_across: f32,
    offset_um: f32, depth_square: f32) -> f32 {
    return profile(width_um, wavelength_um, xi_across, depth_square)
        * gaussian(offset_um / sigma_um) * gaussian(2.0 * PI * sigma_um / wavelength_um * xi_along);
}
