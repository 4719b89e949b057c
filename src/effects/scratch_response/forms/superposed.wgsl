// approximates: scratched_mirror_reflectance
// function: superposed
// about: no cross term and no blend
// cites: velinov2018 eq. 6 without rho_c
// uses: mirror, lobe

// Mirror and infinite scratch added, with neither cross term nor blend: |B|^2 + |S|^2.
fn superposed(width_um: f32, depth_um: f32, wavelength_um: f32, sigma_um: f32, xi_along: f32,
    xi_across: f32, offset_um: f32, mu_sum: f32) -> f32 {
    let depth = depth_square(depth_um, wavelength_um, mu_sum);
    return mirror_reflectance(wavelength_um, sigma_um, xi_along, xi_across)
        + lobe(width_um, wavelength_um, sigma_um, xi_along, xi_across, offset_um, depth);
}
