// approximates: scratch_reflectance
// function: small_angle
// about: finite scratch at small angles
// cites: velinov2018 eq. 3-5
// uses: lobe, faddeeva

// A finite scratch, eq. 5, with the depth phase at normal angles, eq. 4: what that alone costs.
fn small_angle(width_um: f32, depth_um: f32, wavelength_um: f32, sigma_um: f32, xi_along: f32,
    xi_across: f32, offset_um: f32, begin_um: f32, end_um: f32) -> f32 {
    return profile(width_um, wavelength_um, xi_across, depth_square(depth_um, wavelength_um, 2.0))
        * gaussian(offset_um / sigma_um)
        * along_square(wavelength_um, sigma_um, xi_along, begin_um, end_um);
}
