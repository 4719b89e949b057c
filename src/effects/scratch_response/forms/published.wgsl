// approximates: scratch_reflectance
// function: published
// about: infinite scratch at small angles: both simplifications, what ships
// cites: velinov2018 eq. 3, 9, 10, 11
// uses: lobe

// What ships, velinov2018 eq. 3, 9, 10, 11: an infinite scratch, the depth phase at normal angles.
fn published(width_um: f32, depth_um: f32, wavelength_um: f32, sigma_um: f32, xi_along: f32,
    xi_across: f32, offset_um: f32) -> f32 {
    return profile(width_um, wavelength_um, xi_across, depth_square(depth_um, wavelength_um, 2.0))
        * gaussian(offset_um / sigma_um) * gaussian(2.0 * PI * sigma_um / wavelength_um * xi_along);
}
