// approximates: scratched_mirror_reflectance
// function: density_blend
// about: no cross term, the mirror dimmed by rho_c
// cites: velinov2018 eq. 6, 17
// uses: mirror, lobe, infinite_density

// Eq. 6 with rho_c of eq. 17, the depth phase at its angles: what the blend alone costs.
fn density_blend(width_um: f32, depth_um: f32, wavelength_um: f32, sigma_um: f32, xi_along: f32,
    xi_across: f32, offset_um: f32, mu_sum: f32) -> f32 {
    let depth = depth_square(depth_um, wavelength_um, mu_sum);
    return mirror_reflectance(wavelength_um, sigma_um, xi_along, xi_across)
            * (1.0 - infinite_density(width_um, sigma_um, offset_um))
        + lobe(width_um, wavelength_um, sigma_um, xi_along, xi_across, offset_um, depth);
}
