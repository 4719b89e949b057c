// approximates: scratched_mirror_reflectance
// function: energy_blend
// about: no cross term, the mirror dimmed by the energy that the scratch shows
// cites: striae
// uses: mirror, lobe

// The mirror dimmed by the energy of the cross term, |D|^2 times the share of the light that falls
// into the scratch, W exp(-s_b^2/sigma^2)/(sqrt(pi) sigma): energy is kept for every depth,
// wavelength and offset.
fn energy_blend(width_um: f32, depth_um: f32, wavelength_um: f32, sigma_um: f32, xi_along: f32,
    xi_across: f32, offset_um: f32, mu_sum: f32) -> f32 {
    let depth = depth_square(depth_um, wavelength_um, mu_sum);
    return mirror_reflectance(wavelength_um, sigma_um, xi_along, xi_across)
            * (1.0 - depth * 0.5641895835 * width_um / sigma_um * gaussian(offset_um / sigma_um))
        + lobe(width_um, wavelength_um, sigma_um, xi_along, xi_across, offset_um, depth);
}
