// approximates: scratch_reflectance
// function: mirror_depth
// about: infinite scratch, the depth phase in the mirror direction of the viewer
// cites: striae
// uses: lobe

// The depth phase in the mirror direction, 2 mu_o in place of mu_i + mu_o: as in eq. 4 it does not
// move with the light, so that the integrals over lights and footprints stay closed; the scratch is
// infinite.
fn mirror_depth(width_um: f32, depth_um: f32, wavelength_um: f32, sigma_um: f32, xi_along: f32,
    xi_across: f32, offset_um: f32, mu_o: f32) -> f32 {
    return profile(width_um, wavelength_um, xi_across,
            depth_square(depth_um, wavelength_um, 2.0 * mu_o))
        * gaussian(offset_um / sigma_um) * gaussian(2.0 * PI * sigma_um / wavelength_um * xi_along);
}
