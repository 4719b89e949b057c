// approximates: scratch_reflectance
// function: matched_ends
// about: finite scratch as a Gaussian of the exact peak and energy, four real error functions
// cites: striae
// uses: matched, lobe

// A finite scratch by real error functions, the depth phase at its angles.
fn matched_ends(width_um: f32, depth_um: f32, wavelength_um: f32, sigma_um: f32, xi_along: f32,
    xi_across: f32, offset_um: f32, begin_um: f32, end_um: f32, mu_sum: f32) -> f32 {
    let p = amplitude_share(sigma_um, begin_um, end_um);
    return profile(width_um, wavelength_um, xi_across, depth_square(depth_um, wavelength_um, mu_sum))
        * gaussian(offset_um / sigma_um)
        * matched_along(p, wavelength_um, sigma_um, xi_along, begin_um, end_um);
}
