// approximates: scratch_reflectance
// function: finite
// about: finite scratch, the depth phase at its angles: the reference in f32
// cites: velinov2018 eq. 3, 5; Weideman 1994 for the error function
// uses: lobe, faddeeva

// A finite scratch, eq. 5, with the depth phase at its angles: nothing left out, in f32.
fn finite(width_um: f32, depth_um: f32, wavelength_um: f32, sigma_um: f32, xi_along: f32,
    xi_across: f32, offset_um: f32, begin_um: f32, end_um: f32, mu_sum: f32) -> f32 {
    return profile(width_um, wavelength_um, xi_across, depth_square(depth_um, wavelength_um, mu_sum))
        * gaussian(offset_um / sigma_um)
        * along_square(wavelength_um, sigma_um, xi_along, begin_um, end_um);
}
