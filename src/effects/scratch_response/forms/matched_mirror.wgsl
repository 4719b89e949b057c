// approximates: scratched_mirror_reflectance
// function: matched_mirror
// about: finite scratch as a Gaussian of the exact peak and energy, the mirror dimmed by |D|^2 rho_c/2
// cites: striae
// uses: matched, mirror, lobe, infinite_density

// Ours, all together: a finite scratch by real error functions and the mirror dimmed by
// |D|^2 rho_c/2 of the finite scratch, which is the cross term at the peak.
fn matched_mirror(width_um: f32, depth_um: f32, wavelength_um: f32, sigma_um: f32, xi_along: f32,
    xi_across: f32, offset_um: f32, begin_um: f32, end_um: f32, mu_sum: f32) -> f32 {
    let p = amplitude_share(sigma_um, begin_um, end_um);
    let depth = depth_square(depth_um, wavelength_um, mu_sum);
    return mirror_reflectance(wavelength_um, sigma_um, xi_along, xi_across)
            * (1.0 - 0.5 * depth * p * infinite_density(width_um, sigma_um, offset_um))
        + profile(width_um, wavelength_um, xi_across, depth) * gaussian(offset_um / sigma_um)
            * matched_along(p, wavelength_um, sigma_um, xi_along, begin_um, end_um);
}
