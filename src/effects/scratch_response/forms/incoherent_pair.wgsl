// approximates: scratch_pair_reflectance
// function: incoherent_pair
// about: no mutual interference
// cites: velinov2018 eq. 7
// uses: lobe

// Two infinite scratches without mutual interference, eq. 7, the depth phase at their angles.
fn incoherent_pair(width_um: f32, depth_um: f32, wavelength_um: f32, sigma_um: f32, xi_along: f32,
    xi_across: f32, offset_um: f32, mu_sum: f32, second_width_um: f32, second_depth_um: f32,
    second_offset_um: f32, turn_rad: f32) -> f32 {
    let across = xi_across * cos(turn_rad) - xi_along * sin(turn_rad);
    let along = xi_along * cos(turn_rad) + xi_across * sin(turn_rad);
    let wave = 2.0 * PI * sigma_um / wavelength_um;
    return profile(width_um, wavelength_um, xi_across, depth_square(depth_um, wavelength_um, mu_sum))
            * gaussian(offset_um / sigma_um) * gaussian(wave * xi_along)
        + profile(second_width_um, wavelength_um, across,
                depth_square(second_depth_um, wavelength_um, mu_sum))
            * gaussian(second_offset_um / sigma_um) * gaussian(wave * along);
}
