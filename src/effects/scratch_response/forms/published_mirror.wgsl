// approximates: scratched_mirror_reflectance
// function: published_mirror
// about: infinite scratch at small angles, the mirror dimmed by rho_c: all together, what ships
// cites: velinov2018 eq. 3, 6, 9-11, 17
// uses: mirror, lobe, infinite_density

// What ships, eq. 3, 6, 9-11, 17: infinite scratch, small angles, density blend.
fn published_mirror(width_um: f32, depth_um: f32, wavelength_um: f32, sigma_um: f32, xi_along: f32,
    xi_across: f32, offset_um: f32) -> f32 {
    let depth = depth_square(depth_um, wavelength_um, 2.0);
    return mirror_reflectance(wavelength_um, sigma_um, xi_along, xi_across)
            * (1.0 - infinite_density(width_um, sigma_um, offset_um))
        + lobe(width_um, wavelength_um, sigma_um, xi_along, xi_across, offset_um, depth);
}
