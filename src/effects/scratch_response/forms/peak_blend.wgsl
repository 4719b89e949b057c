// approximates: scratched_mirror_reflectance
// function: peak_blend
// about: no cross term, the mirror dimmed by |D|^2 rho_c/2: exact at its peak
// cites: striae
// uses: mirror, lobe, infinite_density

// The mirror dimmed by the cross term as it is at the peak: |D|^2 rho_c/2 in place of rho_c.
fn peak_blend(width_um: f32, depth_um: f32, wavelength_um: f32, sigma_um: f32, xi_along: f32,
    xi_across: f32, offset_um: f32, mu_sum: f32) -> f32 {
    let depth = depth_square(depth_um, wavelength_um, mu_sum);
    return mirror_reflectance(wavelength_um, sigma_um, xi_along, xi_across)
            * (1.0 - 0.5 * depth * infinite_density(width_um, sigma_um, offset_um))
        + lobe(width_um, wavelength_um, sigma_um, xi_along, xi_across, offset_um, depth);
}
