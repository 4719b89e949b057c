// approximates: scratch_reflectance
// function: infinite
// about: infinite scratch, the depth phase at its angles
// cites: velinov2018 eq. 3, 8; fig. 3 dashed
// uses: lobe

// An infinite scratch, eq. 8, with the depth phase at its angles: what the limit alone costs.
fn infinite(width_um: f32, depth_um: f32, wavelength_um: f32, sigma_um: f32, xi_along: f32,
    xi_across: f32, offset_um: f32, mu_sum: f32) -> f32 {
    return profile(width_um, wavelength_um, xi_across, depth_square(depth_um, wavelength_um, mu_sum))
        * gaussian(offset_um / sigma_um) * gaussian(2.0 * PI * sigma_um / wavelength_um * xi_along);
}
