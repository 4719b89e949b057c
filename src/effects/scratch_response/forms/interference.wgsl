// approximates: scratched_mirror_reflectance
// function: interference
// about: infinite scratch, the cross term kept in closed form
// cites: velinov2018 eq. 1, 8
// uses: amplitude, lobe

// The cross term kept: |B - S|^2 of a mirror with an infinite scratch, the depth phase at its angles.
fn interference(width_um: f32, depth_um: f32, wavelength_um: f32, sigma_um: f32, xi_along: f32,
    xi_across: f32, offset_um: f32, mu_sum: f32) -> f32 {
    let wave = sigma_um / wavelength_um;
    let base = 3.544907702 * wave * gaussian(4.442882938 * wave * xi_along)
        * gaussian(4.442882938 * wave * xi_across);
    let scratch = lobe_amplitude(width_um, wavelength_um, sigma_um, xi_along, xi_across, offset_um,
        depth_um, mu_sum);
    let rest = vec2<f32>(base, 0.0) - scratch;
    return dot(rest, rest);
}
